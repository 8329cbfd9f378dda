// bindpose-reader PATH FORMAT > record
// reads a dataset or a picture in a separate process, because the readers may crash, hang or take
// all memory on a damaged file. libpng and libtiff read PNG and TIFF files; VTK's readers read all
// other formats. Bindpose starts this program (see guarded_read.h); users do not call it.
#include "vtk_errors.h"

#include "check_tga.h"
#include "dataset_record.h"
#include "read_png.h"
#include "read_tiff.h"

#include "helper/helper_start.h"

#include "vtkAlgorithm.h"
#include "vtkBMPReader.h"
#include "vtkDataSet.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkGenericDataObjectReader.h"
#include "vtkImageData.h"
#include "vtkJPEGReader.h"
#include "vtkNew.h"
#include "vtkTGAReader.h"
#include "vtkXMLImageDataReader.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <cstdio>
#include <exception>
#include <new>
#include <type_traits>

namespace
{
using bindpose::Status;

template <typename Reader>
void watch(bindpose::VtkErrors& errors, Reader* reader)
{
  errors.watch(reader);
  // The executive reports a second error for the same failed request; catch it too.
  errors.watch(reader->GetExecutive());
  if constexpr (std::is_base_of_v<vtkXMLReader, Reader>)
  {
    // Observe the internal reader and parser of an XML reader too.
    reader->SetReaderErrorObserver(errors.command());
    reader->SetParserErrorObserver(errors.command());
  }
}

void print_progress(vtkObject* reader, unsigned long, void*, void*)
{
  std::fprintf(stderr, "progress %.4f\n", vtkAlgorithm::SafeDownCast(reader)->GetProgress());
}

template <typename Reader>
Status read(const std::string& path, int result)
{
  bindpose::VtkErrors errors;
  vtkNew<vtkCallbackCommand> progress;
  progress->SetCallback(&print_progress);
  vtkNew<Reader> reader;
  watch(errors, reader.Get());
  reader->AddObserver(vtkCommand::ProgressEvent, progress);
  if constexpr (std::is_base_of_v<vtkImageReader2, Reader>)
  {
    if (reader->CanReadFile(path.c_str()) == 0)
    {
      return Status::invalid_input(
        "the file is damaged or does not have the format of its extension");
    }
  }
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkDataObject* object = reader->GetOutputDataObject(0);
  if (errors.any() || reader->GetErrorCode() != vtkErrorCode::NoError || !object)
  {
    return Status::invalid_input(errors.any() ? errors.message() : "the file is not valid");
  }
  auto* data = vtkDataSet::SafeDownCast(object);
  return data ? bindpose::write_dataset_record(result, data)
              : Status::invalid_input(std::string("the file contains a ") + object->GetClassName() +
                  ", which is not supported");
}

using PictureReader = Status (*)(const std::string& path, vtkSmartPointer<vtkImageData>& image);

Status read_picture(PictureReader read_file, const std::string& path, int result)
{
  vtkSmartPointer<vtkImageData> image;
  const Status status = read_file(path, image);
  return status.ok() ? bindpose::write_dataset_record(result, image) : status;
}

Status read_format(const std::string& path, const std::string& format, int result)
{
  if (format == "vtp")
  {
    return read<vtkXMLPolyDataReader>(path, result);
  }
  if (format == "vtu")
  {
    return read<vtkXMLUnstructuredGridReader>(path, result);
  }
  if (format == "vti")
  {
    return read<vtkXMLImageDataReader>(path, result);
  }
  if (format == "vtk")
  {
    return read<vtkGenericDataObjectReader>(path, result);
  }
  if (format == "png")
  {
    return read_picture(bindpose::read_png, path, result);
  }
  if (format == "jpg" || format == "jpeg")
  {
    return read<vtkJPEGReader>(path, result);
  }
  if (format == "tif" || format == "tiff")
  {
    return read_picture(bindpose::read_tiff, path, result);
  }
  if (format == "bmp")
  {
    return read<vtkBMPReader>(path, result);
  }
  if (format == "tga")
  {
    const Status status = bindpose::check_tga(path);
    return status.ok() ? read<vtkTGAReader>(path, result) : status;
  }
  return Status::invalid_input("the format " + format +
    " is not supported; expected vtp, vtu, vti, vtk, png, jpg, jpeg, tif, tiff, bmp or tga");
}
} // namespace

int main(int argc, char* argv[])
{
  if (argc < 3)
  {
    bindpose::helper_fail("expected a path and a format");
  }
  const int result = bindpose::start_helper(bindpose::helper_options(argc, argv, 2));
  try
  {
    const Status status = read_format(argv[1], argv[2], result);
    if (!status.ok())
    {
      bindpose::helper_fail(status.message);
    }
  }
  catch (const std::bad_alloc&) // VTK's arrays throw bad_alloc without calling the new handler
  {
    bindpose::helper_fail("out of memory");
  }
  catch (const std::exception& error)
  {
    bindpose::helper_fail(error.what());
  }
  bindpose::end_helper();
}
