#ifndef read_tiff_h
#define read_tiff_h

#include "base/status.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

namespace bindpose
{

/// Read the first image of a TIFF file with libtiff. The scalars are unsigned chars: red, green and
/// blue, and also alpha if the file has it. The top line of the image is at the largest y. (VTK's
/// reader is not used, because it turns most images upside down and crashes on some.)
Status read_tiff(const std::string& path, vtkSmartPointer<vtkImageData>& image);

} // namespace bindpose

#endif
