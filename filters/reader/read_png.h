#ifndef read_png_h
#define read_png_h

#include "base/status.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

namespace bindpose
{

/// Read a PNG file with libpng. The scalars are unsigned chars: red, green and blue, and also alpha
/// if the file has it. The top line of the image is at the largest y. (VTK's reader is not used,
/// because it accepts some damaged files.)
Status read_png(const std::string& path, vtkSmartPointer<vtkImageData>& image);

} // namespace bindpose

#endif
