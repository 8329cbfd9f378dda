#ifndef read_png_h
#define read_png_h

#include "base/status.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

namespace bindpose
{

/// Read a PNG file with libpng, as red, green, blue and, if the file has it, alpha, in bytes. The
/// top line of the image is at the largest y. (VTK's reader accepts some damaged files.)
Status read_png(const std::string& path, vtkSmartPointer<vtkImageData>& image);

} // namespace bindpose

#endif
