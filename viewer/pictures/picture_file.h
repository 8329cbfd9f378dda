#ifndef bindpose_pictures_picture_file_h
#define bindpose_pictures_picture_file_h

#include "base/status.h"

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <string>

namespace bindpose
{

/// Report whether read_picture() supports the extension of a file name: png, jpg, jpeg, tif, tiff
/// or bmp.
bool is_picture_file(const std::string& path);

/// Read an image file as vtkPictureFileReader does.
Status read_picture(const std::string& path, vtkSmartPointer<vtkImageData>& image);

} // namespace bindpose

#endif
