#ifndef check_tga_h
#define check_tga_h

#include "base/status.h"

#include <string>

namespace bindpose
{

/// Check that a TGA file has the pixels that its header states, in a format that VTK's reader
/// supports. (This reader reads and writes beyond its buffers for damaged files.)
Status check_tga(const std::string& path);

} // namespace bindpose

#endif
