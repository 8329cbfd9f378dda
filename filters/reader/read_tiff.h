#ifndef read_tiff_h
#define read_tiff_h

#include "base/status.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

namespace bindpose
{

/// Read the first image of a TIFF file with libtiff, as red, green, blue and, if the file has it,
/// alpha, in bytes. The top line of the image is at the largest y. (VTK's reader turns most images
/// upside down and crashes on some.)
Status read_tiff(const std::string& path, vtkSmartPointer<vtkImageData>& image);

} // namespace bindpose

#endif
