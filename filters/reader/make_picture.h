#ifndef make_picture_h
#define make_picture_h

#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <cstdint>

namespace bindpose
{

/// Return an image whose scalars are the pixels, line by line from the bottom.
inline vtkSmartPointer<vtkImageData> make_picture(
  std::uint32_t width, std::uint32_t height, vtkUnsignedCharArray* pixels)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(static_cast<int>(width), static_cast<int>(height), 1);
  pixels->SetName("Pixels");
  image->GetPointData()->SetScalars(pixels);
  return image;
}

} // namespace bindpose

#endif
