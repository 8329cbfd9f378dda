#ifndef check_tga_h
#define check_tga_h

#include "base/status.h"

#include <string>

namespace bindpose
{

/// Check that a TGA file contains all its pixels. (VTK's reader fills missing pixels with any
/// values.)
Status check_tga(const std::string& path);

} // namespace bindpose

#endif
