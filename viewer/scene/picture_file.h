#ifndef bindpose_scene_picture_file_h
#define bindpose_scene_picture_file_h

#include "base/status.h"

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <string>

namespace bindpose
{

/// By its ending: png, jpg, jpeg, tif, tiff or bmp.
bool is_picture_file(const std::string& path);

/// Reads a picture; its first line is on top, at the largest y. PNG: red, green, blue and, when the
/// file has any, alpha, in bytes; the others as VTK's readers give them. invalid_input: what is not
/// there, is broken or of another kind.
Status read_picture(const std::string& path, vtkSmartPointer<vtkImageData>& image);

} // namespace bindpose

#endif
