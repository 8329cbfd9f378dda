#include "helper/helper_file.h"

#include <filesystem>
#include <system_error>

namespace bindpose
{

Status find_for_helper(const std::string& path, std::string& absolute_path, double& size)
{
  std::error_code error;
  const std::filesystem::path full = std::filesystem::absolute(path, error);
  size = error ? 0.0 : static_cast<double>(std::filesystem::file_size(full, error));
  if (error)
  {
    const bool is_missing = error == std::errc::no_such_file_or_directory;
    return Status::invalid_input(
      path + " cannot be read: " + (is_missing ? "there is no such file" : error.message()));
  }
  absolute_path = full.string();
  return {};
}

} // namespace bindpose
