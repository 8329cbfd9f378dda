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

/// Read an image file as vtkPictureFileReader does.
Status read_picture(const std::string& path, vtkSmartPointer<vtkImageData>& image);

} // namespace bindpose

#endif
