// Connects the kernels bindpose::image_outline and bindpose::planar_shape to VTK: see
// planar/image_outline.h and planar/planar_shape.h.
#include "vtkPlanarShape.h"

#include "conversion.h"
#include "handle_geometry.h"
#include "planar_input.h"

#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>

vtkStandardNewMacro(vtkPlanarShape);

vtkPlanarShape::vtkPlanarShape()
{
  this->SetNumberOfInputPorts(2);
}

vtkPlanarShape::~vtkPlanarShape() = default;

int vtkPlanarShape::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
    info->Set(INPUT_IS_OPTIONAL(), 1);
    AcceptBlocks(info);
    return 1;
  }
  info->Set(INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Append(INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

int vtkPlanarShape::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

namespace
{
void add_point_arrays(
  const bindpose::PlanarShape& shape, const bindpose::PlanarInput& input, vtkPolyData* out)
{
  const auto count = static_cast<vtkIdType>(shape.points.rows());
  vtkNew<vtkDoubleArray> texture;
  texture->SetName("TCoords");
  texture->SetNumberOfComponents(2);
  texture->SetNumberOfTuples(count);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("OriginalPointIds");
  ids->SetNumberOfValues(count);
  const bindpose::Vec2 size = input.upper - input.lower;
  for (vtkIdType v = 0; v < count; ++v)
  {
    for (int k = 0; k < 2; ++k)
    {
      const double coordinate = (shape.points(v, k) - input.lower[k]) / size[k];
      // Rounding may give texture coordinates slightly outside of 0 to 1.
      texture->SetComponent(v, k, std::clamp(coordinate, 0.0, 1.0));
    }
    ids->SetValue(v, shape.original_vertices[v]);
  }
  out->GetPointData()->SetTCoords(texture);
  out->GetPointData()->AddArray(ids);
}
} // namespace

bindpose::Status vtkPlanarShape::Execute(
  bindpose::ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  vtkPolyData* out = vtkPolyData::GetData(output);
  out->Initialize();
  bindpose::PlanarInput planar;
  bindpose::Status status;
  vtkDataObject* data = vtkDataObject::GetData(input[0]);
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    bindpose::ImageOutlineOptions options;
    options.simplify = this->Simplify;
    status = bindpose::to_planar_input(context, image, this->Rectangle, options, planar);
  }
  else
  {
    auto* curves = vtkPolyData::SafeDownCast(data);
    status = curves
      ? bindpose::to_planar_input(curves, planar)
      : bindpose::Status::invalid_input("the input is missing: an image or curves are required");
  }
  bindpose::HandleGeometry handles;
  vtkPolyData* handle_data = vtkPolyData::GetData(input[1]);
  if (status.ok() && handle_data)
  {
    status = bindpose::to_handle_geometry(handle_data, handles);
  }
  if (!status.ok())
  {
    return status;
  }

  bindpose::PlanarShapeOptions options;
  options.winding_threshold = this->WindingThreshold;
  options.min_angle = this->MinAngle;
  options.edge = this->Edge;
  options.time_limit = this->TimeLimit;
  options.memory_limit = this->MemoryLimit;
  bindpose::PlanarShape shape;
  status = bindpose::planar_shape(
    context, planar.points, planar.segments, bindpose::to_planar_handles(handles), options, shape);
  bindpose::Report report = planar.report;
  report.merge(status.report);
  status.report = report;
  if (!status.usable())
  {
    return status;
  }
  if (!handles.names.empty())
  {
    bindpose::report_handles(handles, shape.handle_vertices, status.report);
  }

  bindpose::Points points(shape.points.rows(), 3);
  points << shape.points, Eigen::VectorXd::Constant(shape.points.rows(), planar.z);
  out->ShallowCopy(bindpose::to_polydata(points, shape.triangles));
  add_point_arrays(shape, planar, out);
  vtkNew<vtkDoubleArray> winding;
  winding->SetName("WindingNumber");
  winding->SetNumberOfValues(shape.winding_numbers.size());
  std::copy(shape.winding_numbers.data(),
    shape.winding_numbers.data() + shape.winding_numbers.size(), winding->GetPointer(0));
  out->GetCellData()->SetScalars(winding);
  return status;
}

void vtkPlanarShape::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Rectangle: " << (this->Rectangle ? "on" : "off") << "\n";
  os << indent << "Simplify: " << this->Simplify << "\n";
  os << indent << "WindingThreshold: " << this->WindingThreshold << "\n";
  os << indent << "MinAngle: " << this->MinAngle << "\n";
  os << indent << "Edge: " << this->Edge << "\n";
  os << indent << "TimeLimit: " << this->TimeLimit << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
}
