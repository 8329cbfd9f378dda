#ifndef bindpose_scene_picture_file_h
#define bindpose_scene_picture_file_h

#include "base/status.h"

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <string>

namespace bindpose
{

/// Report whether the file name's extension is png, jpg, jpeg, tif, tiff or bmp.
bool is_picture_file(const std::string& path);

/// Read a picture. Its top line is at the largest y. A PNG file gives red, green, blue and, if the
/// file has it, alpha, in bytes. Other formats give the data of VTK's readers. Return invalid_input
/// if the file is missing, damaged or in another format.
Status read_picture(const std::string& path, vtkSmartPointer<vtkImageData>& image);

} // namespace bindpose

#endif
