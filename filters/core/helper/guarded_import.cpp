#include "helper/guarded_import.h"

#include "helper/helper_file.h"
#include "helper/helper_process.h"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

namespace bindpose
{

namespace
{
constexpr Helper importer{ "bindpose-importer", "BINDPOSE_IMPORTER",
  "the helper executable bindpose-importer is missing; reinstall Bindpose or set the environment "
  "variable BINDPOSE_IMPORTER to its path" };

/// Read a memory file from its beginning. Return false if that fails.
bool read_whole(int file, std::string& bytes)
{
  struct stat info;
  if (::fstat(file, &info) != 0 || info.st_size <= 0)
  {
    return false;
  }
  bytes.resize(static_cast<std::size_t>(info.st_size));
  for (std::size_t done = 0; done < bytes.size();)
  {
    const ssize_t count =
      ::pread(file, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
    if (count <= 0)
    {
      return false;
    }
    done += static_cast<std::size_t>(count);
  }
  return true;
}

/// Return the memory limit of the helper in MiB, 0: no limit. The libraries take about 200 MiB of
/// address space. 3MF files, arrays of FBX files and meshes of glTF files are compressed.
Index memory_limit(double size)
{
#if defined(__SANITIZE_ADDRESS__)
  return 0; // The address sanitizer reserves terabytes of address space.
#else
  constexpr double growth = 200.0, mebibyte = 1048576.0;
  return 1000 + static_cast<Index>(growth * size / mebibyte);
#endif
}

/// Run the helper with a command: convert or decompress.
/// @param further_files other files that the helper reads
Status run_importer(ExecutionContext& context, const char* command, const std::string& path,
  const std::vector<std::string>& further_files, std::string& bytes)
{
  std::string full;
  double size = 0.0;
  const Status found = find_for_helper(path, full, size);
  if (!found.ok())
  {
    return found;
  }
  for (const std::string& file : further_files)
  {
    std::error_code error;
    const std::uintmax_t further = std::filesystem::file_size(file, error);
    size += error ? 0.0 : static_cast<double>(further);
  }
  const FileDescriptor result(anonymous_file("bindpose-import"));
  if (result.get() < 0)
  {
    return Status::failure(StatusCode::internal_error,
      std::string("cannot create memory for a file: ") + std::strerror(errno));
  }
  HelperRequest request;
  request.name = importer.program;
  request.arguments = { command, full };
  request.memory_limit = memory_limit(size);
  constexpr double bytes_per_second = 2e5;
  request.time_limit = 10.0 + size / bytes_per_second;
  HelperRun run;
  Status status = run_helper(context, importer, request, result.get(), run);
  if (status.ok() && !read_whole(result.get(), bytes))
  {
    status = Status::failure(StatusCode::internal_error, "the importer returned no data");
  }
  status.warnings = run.warnings;
  if (status.code == StatusCode::internal_error)
  {
    return Status::invalid_input(path + " cannot be read: " + status.message);
  }
  return status;
}
} // namespace

Status import_guarded(ExecutionContext& context, const std::string& path, std::string& bytes)
{
  return run_importer(context, "convert", path, {}, bytes);
}

Status decompress_guarded(ExecutionContext& context, const std::string& path,
  const std::vector<std::string>& buffer_files, std::string& bytes)
{
  return run_importer(context, "decompress", path, buffer_files, bytes);
}

} // namespace bindpose
