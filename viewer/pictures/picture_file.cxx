#include "pictures/picture_file.h"

#include "base/execution.h"
#include "file_kind.h"
#include "guarded_read.h"
#include "vtkPictureFileReader.h"

#include "vtkImageData.h"

namespace bindpose
{

bool is_picture_file(const std::string& path)
{
  return is_listed(file_extension(path), vtkPictureFileReader::GetFileExtensions());
}

Status read_picture(const std::string& path, vtkSmartPointer<vtkImageData>& image)
{
  ExecutionContext context;
  vtkSmartPointer<vtkDataSet> data;
  const Status status = read_guarded(context, path, data);
  image = vtkImageData::SafeDownCast(data);
  return status.ok() && !image ? Status::invalid_input(path + " does not contain an image")
                               : status;
}

} // namespace bindpose
