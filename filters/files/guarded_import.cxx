#include "guarded_import.h"

#include "helper/helper_process.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <sys/stat.h>
#include <unistd.h>

namespace bindpose
{

namespace
{
constexpr Helper importer{ "bindpose-importer", "BINDPOSE_IMPORTER",
  "the helper executable bindpose-importer is missing, because Bindpose was built without assimp "
  "(Debian package libassimp-dev)" };

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
/// address space. 3MF files, and arrays of FBX files, are compressed.
Index memory_limit(double size)
{
#if defined(__SANITIZE_ADDRESS__)
  return 0; // The address sanitizer reserves terabytes of address space.
#else
  constexpr double growth = 200.0, mebibyte = 1048576.0;
  return 1000 + static_cast<Index>(growth * size / mebibyte);
#endif
}
} // namespace

Status import_guarded(ExecutionContext& context, const std::string& path, std::string& bytes)
{
  std::error_code error;
  const std::filesystem::path full = std::filesystem::absolute(path, error);
  const auto size = error ? 0 : std::filesystem::file_size(full, error);
  if (error)
  {
    const bool is_missing = error == std::errc::no_such_file_or_directory;
    return Status::invalid_input(
      path + " cannot be read: " + (is_missing ? "there is no such file" : error.message()));
  }
  const FileDescriptor result(anonymous_file("bindpose-import"));
  if (result.get() < 0)
  {
    return Status::failure(StatusCode::internal_error,
      std::string("cannot create memory for a file: ") + std::strerror(errno));
  }
  HelperRequest request;
  request.name = importer.program;
  request.arguments = { full.string() };
  request.memory_limit = memory_limit(static_cast<double>(size));
  constexpr double bytes_per_second = 2e5;
  request.time_limit = 10.0 + static_cast<double>(size) / bytes_per_second;
  HelperRun run;
  Status status = run_helper(context, importer, request, result.get(), run);
  if (status.ok() && !read_whole(result.get(), bytes))
  {
    status = Status::failure(StatusCode::internal_error, "the importer returned no data");
  }
  if (status.code == StatusCode::internal_error)
  {
    return Status::invalid_input(path + " cannot be read: " + status.message);
  }
  return status;
}

} // namespace bindpose
