#include "read_tiff.h"

#include "make_picture.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include <tiffio.h>

namespace bindpose
{

namespace
{
std::string last_error;

void keep_error(const char* /*function*/, const char* format, std::va_list arguments)
{
  char text[512];
  std::vsnprintf(text, sizeof(text), format, arguments);
  last_error = text;
}
} // namespace

Status read_tiff(const std::string& path, vtkSmartPointer<vtkImageData>& image)
{
  TIFFSetErrorHandler(&keep_error);
  TIFFSetWarningHandler(nullptr);
  const auto failure = [](const std::string& reason)
  { return Status::invalid_input(last_error.empty() ? reason : last_error); };
  const std::unique_ptr<TIFF, void (*)(TIFF*)> file(TIFFOpen(path.c_str(), "r"), &TIFFClose);
  std::uint32_t width = 0, height = 0;
  if (!file || !TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &width) ||
    !TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &height))
  {
    return failure("the file is not a TIFF file");
  }
  char reason[1024] = "";
  if (!TIFFRGBAImageOK(file.get(), reason))
  {
    return failure(reason);
  }
  constexpr std::uint32_t longest_side = 65500; // in pixels, like the limit of JPEG files
  if (width == 0 || height == 0 || width > longest_side || height > longest_side)
  {
    return Status::invalid_input("the picture has " + std::to_string(width) + " x " +
      std::to_string(height) + " pixels; expected 1 to " + std::to_string(longest_side) +
      " along each side");
  }
  std::vector<std::uint32_t> colors(static_cast<std::size_t>(width) * height);
  constexpr int stop_on_error = 1;
  if (!TIFFReadRGBAImageOriented(
        file.get(), width, height, colors.data(), ORIENTATION_BOTLEFT, stop_on_error))
  {
    return failure("the file is damaged");
  }
  std::uint16_t extra_channels = 0;
  std::uint16_t* channel_types = nullptr;
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_EXTRASAMPLES, &extra_channels, &channel_types);
  const bool has_alpha = extra_channels > 0;
  vtkNew<vtkUnsignedCharArray> pixels;
  pixels->SetNumberOfComponents(has_alpha ? 4 : 3);
  pixels->SetNumberOfTuples(static_cast<vtkIdType>(colors.size()));
  unsigned char* bytes = pixels->GetPointer(0);
  for (const std::uint32_t color : colors)
  {
    const std::uint32_t alpha = has_alpha ? TIFFGetA(color) : 255;
    for (const std::uint32_t channel : { TIFFGetR(color), TIFFGetG(color), TIFFGetB(color) })
    {
      // Divide by alpha, because libtiff has multiplied the colors by alpha.
      *bytes++ = static_cast<unsigned char>(
        alpha > 0 ? std::min(255u, (channel * 255 + alpha / 2) / alpha) : 0);
    }
    if (has_alpha)
    {
      *bytes++ = static_cast<unsigned char>(alpha);
    }
  }
  image = make_picture(width, height, pixels);
  return {};
}

} // namespace bindpose
