// The picture is read when the pipeline asks for its extent, and kept until the file changes.
#include "vtkPictureFileReader.h"

#include "base/execution.h"
#include "file_kind.h"
#include "file_stamp.h"
#include "guarded_read.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

vtkStandardNewMacro(vtkPictureFileReader);

using bindpose::Status;

struct vtkPictureFileReader::Picture
{
  bindpose::FileStamp stamp;
  Status status;
  vtkSmartPointer<vtkImageData> image;
  bool is_new = false; ///< read by RequestInformation(), so that Execute() need not read it again
};

vtkPictureFileReader::vtkPictureFileReader() : Last(std::make_unique<Picture>())
{
  this->SetNumberOfInputPorts(0);
}

vtkPictureFileReader::~vtkPictureFileReader()
{
  this->SetFileName(nullptr);
}

int vtkPictureFileReader::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkImageData");
  return 1;
}

const vtkPictureFileReader::Picture& vtkPictureFileReader::Read(bindpose::ExecutionContext& context)
{
  const std::string path = this->FileName ? this->FileName : "";
  const bindpose::FileStamp stamp(path);
  if (this->Last->image && stamp.has_content_of(this->Last->stamp))
  {
    return *this->Last;
  }
  *this->Last = Picture();
  this->Last->stamp = stamp;
  Status& status = this->Last->status;
  status = bindpose::check_extension(path, GetFileExtensions());
  vtkSmartPointer<vtkDataSet> data;
  if (status.ok())
  {
    status = bindpose::read_guarded(context, path, data);
  }
  if (status.ok())
  {
    this->Last->image = vtkImageData::SafeDownCast(data);
    if (!this->Last->image || this->Last->image->GetNumberOfPoints() == 0)
    {
      this->Last->image = nullptr;
      status = Status::invalid_input(path + " cannot be read: it has no pixels");
    }
  }
  return *this->Last;
}

int vtkPictureFileReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  bindpose::ExecutionContext context;
  vtkImageData* image = this->Read(context).image;
  this->Last->is_new = true;
  if (image)
  {
    vtkInformation* to = output->GetInformationObject(0);
    to->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), image->GetExtent(), 6);
    to->Set(vtkDataObject::ORIGIN(), image->GetOrigin(), 3);
    to->Set(vtkDataObject::SPACING(), image->GetSpacing(), 3);
  }
  return 1;
}

bindpose::Status vtkPictureFileReader::Execute(
  bindpose::ExecutionContext& context, vtkInformationVector**, vtkInformationVector* output)
{
  bindpose::Phase phase(context, "read");
  const Picture& picture = this->Last->is_new ? *this->Last : this->Read(context);
  this->Last->is_new = false;
  Status status = picture.status;
  if (status.ok())
  {
    vtkImageData::GetData(output)->ShallowCopy(picture.image);
    status.report.set("format", bindpose::file_extension(this->FileName));
    status.report.set("counts.columns", picture.image->GetDimensions()[0]);
    status.report.set("counts.rows", picture.image->GetDimensions()[1]);
  }
  return status;
}

void vtkPictureFileReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
