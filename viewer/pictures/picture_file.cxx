// Reads image files. libpng reads PNG files, because VTK's reader crashes on damaged files. VTK's
// readers read the other formats.
#include "pictures/picture_file.h"

#include "file_kind.h"

#include "vtkBMPReader.h"
#include "vtkCallbackCommand.h"
#include "vtkJPEGReader.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkTIFFReader.h"
#include "vtkUnsignedCharArray.h"

#include <filesystem>

#include <png.h>

namespace bindpose
{

namespace
{
Status read_failure(const std::string& path, const std::string& reason)
{
  return Status::invalid_input(path + " cannot be read: " + reason);
}

Status read_png(const std::string& path, vtkSmartPointer<vtkImageData>& image)
{
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&png, path.c_str()))
  {
    return read_failure(path, png.message);
  }
  png.format = (png.format & PNG_FORMAT_FLAG_ALPHA) ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  vtkNew<vtkUnsignedCharArray> pixels;
  pixels->SetName("Pixels");
  pixels->SetNumberOfComponents(static_cast<int>(PNG_IMAGE_PIXEL_CHANNELS(png.format)));
  pixels->SetNumberOfTuples(static_cast<vtkIdType>(png.width) * png.height);
  // The negative stride stores the top line of the image last.
  const auto stride = static_cast<png_int_32>(PNG_IMAGE_ROW_STRIDE(png));
  if (!png_image_finish_read(&png, nullptr, pixels->GetPointer(0), -stride, nullptr))
  {
    return read_failure(path, png.message);
  }
  image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(static_cast<int>(png.width), static_cast<int>(png.height), 1);
  image->GetPointData()->SetScalars(pixels);
  return {};
}

void note_error(vtkObject*, unsigned long, void* has_error, void*)
{
  *static_cast<bool*>(has_error) = true;
}

template <typename Reader>
Status read_by_vtk(const std::string& path, vtkSmartPointer<vtkImageData>& image)
{
  vtkNew<Reader> reader;
  bool has_error = false;
  vtkNew<vtkCallbackCommand> listener;
  listener->SetCallback(note_error);
  listener->SetClientData(&has_error);
  reader->AddObserver(vtkCommand::ErrorEvent, listener);
  if (reader->CanReadFile(path.c_str()) != 0)
  {
    reader->SetFileName(path.c_str());
    reader->Update();
    image = reader->GetOutput();
    if (!has_error && reader->GetErrorCode() == 0 && image->GetNumberOfPoints() > 0)
    {
      return {};
    }
  }
  return read_failure(path, "the file is damaged or does not have the format of its extension");
}
} // namespace

bool is_picture_file(const std::string& path)
{
  return is_listed(file_extension(path), "png jpg jpeg tif tiff bmp");
}

Status read_picture(const std::string& path, vtkSmartPointer<vtkImageData>& image)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
  {
    return read_failure(path, "there is no such file");
  }
  const std::string extension = file_extension(path);
  return extension == "png" ? read_png(path, image)
    : extension == "bmp"    ? read_by_vtk<vtkBMPReader>(path, image)
    : extension[0] == 'j'   ? read_by_vtk<vtkJPEGReader>(path, image)
                            : read_by_vtk<vtkTIFFReader>(path, image);
}

} // namespace bindpose
