// Converts a text in the format .tgf to a handle dataset.
#include "vtkPlacedHandles.h"

#include "base/execution.h"
#include "conversion.h"
#include "handle_tgf.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

using namespace bindpose;

vtkStandardNewMacro(vtkPlacedHandles);

vtkPlacedHandles::vtkPlacedHandles()
{
  this->SetNumberOfInputPorts(0);
}

void vtkPlacedHandles::SetHandlesText(const std::string& text)
{
  if (this->HandlesText != text)
  {
    this->HandlesText = text;
    this->Modified();
  }
}

int vtkPlacedHandles::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

Status vtkPlacedHandles::Execute(
  ExecutionContext&, vtkInformationVector**, vtkInformationVector* output)
{
  const std::string source = "the text of the handles: ";
  auto* data = vtkPolyData::GetData(output);
  Status status = from_tgf(this->HandlesText, data);
  if (!status.ok())
  {
    status.message = source + status.message;
    return status;
  }
  for (std::string& warning : status.warnings)
  {
    warning = source + warning;
  }
  Handles handles;
  if (data->GetNumberOfCells() > 0)
  {
    to_handles(data, handles);
  }
  status.report.set("counts.handles", static_cast<Index>(handles.size()));
  return status;
}

void vtkPlacedHandles::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HandlesText: " << this->HandlesText << "\n";
}
