#ifndef bindpose_pictures_picture_file_h
#define bindpose_pictures_picture_file_h

#include "base/status.h"

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <string>

namespace bindpose
{

/// Report whether the extension of a file name is that of an image file that read_picture()
/// supports: png, jpg, jpeg, tif, tiff or bmp.
bool is_picture_file(const std::string& path);

/// Read an image file. The top line of the image is at the largest y. A PNG file gives red, green,
/// blue and, if the file has it, alpha, as bytes. For other formats the result is that of VTK's
/// readers. Return invalid_input if the file is missing, damaged or in another format.
Status read_picture(const std::string& path, vtkSmartPointer<vtkImageData>& image);

} // namespace bindpose

#endif
