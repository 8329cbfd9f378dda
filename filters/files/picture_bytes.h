#ifndef picture_bytes_h
#define picture_bytes_h

#include "base/execution.h"
#include "gltf/gltf_images.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

namespace bindpose
{

/// Decode the bytes of a picture in the helper bindpose-reader, because they may be damaged. The
/// scalars are unsigned chars: red, green and blue, and also alpha if the picture has it.
/// @param name what is decoded, for messages
/// @param format png, jpg, bmp, tif or tga
/// @return as read_guarded()
Status decode_picture(ExecutionContext& context, const std::string& name, const std::string& bytes,
  const std::string& format, vtkSmartPointer<vtkImageData>& picture);

/// Return a function that converts pictures to PNG. The context must outlive it.
ConvertPicture png_converter(ExecutionContext& context);

} // namespace bindpose

#endif
