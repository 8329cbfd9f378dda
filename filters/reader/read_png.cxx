#include "read_png.h"

#include "make_picture.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"

#include <fstream>

#include <png.h>

namespace bindpose
{

namespace
{
/// Report whether a PNG file ends with its last chunk, IEND, which libpng does not read.
bool has_end(const std::string& path)
{
  constexpr char end_chunk[] = "IEND\xae\x42\x60\x82"; // type and checksum of the chunk
  constexpr std::streamoff size = sizeof(end_chunk) - 1;
  std::ifstream file(path, std::ios::binary);
  std::string last(static_cast<std::size_t>(size), '\0');
  file.seekg(-size, std::ios::end);
  file.read(last.data(), size);
  return file && last == end_chunk;
}
} // namespace

Status read_png(const std::string& path, vtkSmartPointer<vtkImageData>& image)
{
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&png, path.c_str()))
  {
    return Status::invalid_input(png.message);
  }
  png.format = (png.format & PNG_FORMAT_FLAG_ALPHA) ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  vtkNew<vtkUnsignedCharArray> pixels;
  pixels->SetNumberOfComponents(static_cast<int>(PNG_IMAGE_PIXEL_CHANNELS(png.format)));
  pixels->SetNumberOfTuples(static_cast<vtkIdType>(png.width) * png.height);
  // The negative stride stores the top line of the image last.
  const auto stride = static_cast<png_int_32>(PNG_IMAGE_ROW_STRIDE(png));
  if (!png_image_finish_read(&png, nullptr, pixels->GetPointer(0), -stride, nullptr))
  {
    return Status::invalid_input(png.message);
  }
  if (!has_end(path))
  {
    return Status::invalid_input("the file is truncated");
  }
  image = make_picture(png.width, png.height, pixels);
  return {};
}

} // namespace bindpose
