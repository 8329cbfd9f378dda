#include "picture_bytes.h"

#include "guarded_read.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

namespace bindpose
{

namespace
{
/// Repeat the value of gray pixels, so that each pixel has red, green and blue. Return null for
/// pixels that are not unsigned chars.
vtkSmartPointer<vtkImageData> with_colors(vtkImageData* picture)
{
  auto* from = vtkUnsignedCharArray::SafeDownCast(picture->GetPointData()->GetScalars());
  if (!from)
  {
    return nullptr;
  }
  const int components = from->GetNumberOfComponents();
  if (components >= 3)
  {
    return picture;
  }
  vtkNew<vtkUnsignedCharArray> pixels;
  pixels->SetNumberOfComponents(components + 2);
  pixels->SetNumberOfTuples(from->GetNumberOfTuples());
  for (vtkIdType k = 0; k < from->GetNumberOfTuples(); ++k)
  {
    for (int c = 0; c < components + 2; ++c)
    {
      pixels->SetTypedComponent(k, c, from->GetTypedComponent(k, c < 3 ? 0 : 1));
    }
  }
  auto result = vtkSmartPointer<vtkImageData>::New();
  result->CopyStructure(picture);
  result->GetPointData()->SetScalars(pixels);
  return result;
}
} // namespace

Status decode_picture(ExecutionContext& context, const std::string& name, const std::string& bytes,
  const std::string& format, vtkSmartPointer<vtkImageData>& picture)
{
  vtkSmartPointer<vtkDataSet> data;
  const Status status = read_guarded(context, name, bytes, format, data);
  auto* image = vtkImageData::SafeDownCast(data);
  picture = image ? with_colors(image) : nullptr;
  return status.ok() && !picture
    ? Status::invalid_input(name + " cannot be read: its pixels are not bytes")
    : status;
}

ConvertPicture png_converter(ExecutionContext& context)
{
  return [&context](const std::string& format, std::string& bytes)
  {
    vtkSmartPointer<vtkImageData> picture;
    if (!decode_picture(context, "picture", bytes, format, picture).ok())
    {
      return false;
    }
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(picture);
    writer->WriteToMemoryOn();
    writer->Write();
    vtkUnsignedCharArray* result = writer->GetResult();
    if (!result || result->GetNumberOfValues() == 0)
    {
      return false;
    }
    bytes.assign(reinterpret_cast<const char*>(result->GetPointer(0)),
      static_cast<std::size_t>(result->GetNumberOfValues()));
    return true;
  };
}

} // namespace bindpose
