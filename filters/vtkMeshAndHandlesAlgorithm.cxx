#include "vtkMeshAndHandlesAlgorithm.h"

#include "output_type.h"

#include "vtkInformation.h"

vtkMeshAndHandlesAlgorithm::vtkMeshAndHandlesAlgorithm()
{
  this->SetNumberOfInputPorts(2);
}

int vtkMeshAndHandlesAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPointSet" : "vtkPolyData");
  if (port > 0)
  {
    AcceptBlocks(info);
  }
  return 1;
}

int vtkMeshAndHandlesAlgorithm::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPointSet");
  return 1;
}

int vtkMeshAndHandlesAlgorithm::RequestDataObject(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  bindpose::match_output_type(vtkDataObject::GetData(input[0], 0), output);
  return 1;
}
