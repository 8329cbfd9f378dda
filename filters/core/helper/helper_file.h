#ifndef bindpose_helper_helper_file_h
#define bindpose_helper_helper_file_h

#include "base/status.h"

#include <string>

namespace bindpose
{

/// Find a file that a helper process will read. The working folder of the helper may be another
/// one, so it needs the absolute path. Return invalid_input if the file does not exist.
/// @param size is set to the size of the file in bytes
Status find_for_helper(const std::string& path, std::string& absolute_path, double& size);

} // namespace bindpose

#endif
