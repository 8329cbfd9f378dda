#include "gltf/gltf_file.h"

#include "gltf/gltf_compression.h"
#include "helper/guarded_import.h"
#include "io/text_scanner.h"

#include <filesystem>
#include <new>

namespace bindpose
{

namespace
{
std::string folder_of(const std::string& path)
{
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

/// Call read(), and return its errors as a status.
Status with_errors(const std::string& path, const std::function<Status()>& read)
{
  try
  {
    return read();
  }
  catch (const GltfError& failure)
  {
    return Status::invalid_input(path + ": " + failure.sentence);
  }
  catch (const std::bad_alloc&)
  {
    return Status::invalid_input(path + ": the file needs more memory than is available");
  }
}

/// @param buffer_files files that were read before
Status parse_and_use(const std::string& path, std::string bytes,
  std::vector<std::string> buffer_files,
  const std::function<void(const GltfContent&, Status&)>& use)
{
  GltfContent content;
  content.bytes = std::move(bytes);
  content.files.folder = folder_of(path);
  content.files.paths = std::move(buffer_files);
  content.model = parse_gltf(content.bytes, content.files);
  Status status;
  use(content, status);
  return status;
}
} // namespace

Status read_gltf_file(ExecutionContext& context, const std::string& path,
  const std::function<void(const GltfContent&, Status&)>& use)
{
  return with_errors(path,
    [&]
    {
      std::string bytes;
      Status status = read_file(path, bytes);
      if (!status.ok())
      {
        return status;
      }
      GltfCompression compression = find_compression(bytes, folder_of(path));
      if (compression.is_required)
      {
        status = decompress_guarded(context, path, compression.buffer_files, bytes);
      }
      if (!status.ok())
      {
        return status;
      }
      const std::vector<std::string> warnings = std::move(status.warnings);
      status = parse_and_use(path, std::move(bytes), std::move(compression.buffer_files), use);
      status.warnings.insert(status.warnings.begin(), warnings.begin(), warnings.end());
      return status;
    });
}

Status read_gltf_bytes(const std::string& path, std::string bytes,
  const std::function<void(const GltfContent&, Status&)>& use)
{
  return with_errors(path, [&] { return parse_and_use(path, std::move(bytes), {}, use); });
}

} // namespace bindpose
