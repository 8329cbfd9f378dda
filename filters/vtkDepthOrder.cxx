// Connects the kernel bindpose::depth_order() to VTK. Points are stored as doubles, because the
// displacements that break ties are only a millionth of the shape's diagonal.
#include "vtkDepthOrder.h"

#include "base/execution.h"
#include "weight_uses/depth_order.h"
#include "weights_input.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cmath>

using namespace bindpose;

vtkStandardNewMacro(vtkDepthOrder);

void vtkDepthOrder::SetArrayName(const std::string& name)
{
  if (this->ArrayName != name)
  {
    this->ArrayName = name;
    this->Modified();
  }
}

void vtkDepthOrder::SetLayerArrayName(const std::string& name)
{
  if (this->LayerArrayName != name)
  {
    this->LayerArrayName = name;
    this->Modified();
  }
}

Status vtkDepthOrder::Execute(
  ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  const Phase phase(context, "order");
  vtkPointSet* mesh = vtkPointSet::GetData(input[0]);
  vtkPolyData* handles = vtkPolyData::GetData(input[1]);
  vtkPointSet* result = vtkPointSet::GetData(output);
  WeightsInput weights;
  Status status = to_weights_input(mesh, this->ArrayName, handles, weights);
  if (!status.ok())
  {
    return status;
  }
  Eigen::VectorXd layers;
  status = to_layers(handles, weights.handles, weights.cells, this->LayerArrayName, layers);
  if (!status.ok())
  {
    return status;
  }
  DepthOrderOptions options;
  options.tie_offset = this->Tie;
  DepthOrder order;
  status = depth_order(context, weights.weights.view(), layers, options, order);
  if (!status.usable())
  {
    return status;
  }
  auto depth = vtkSmartPointer<vtkDoubleArray>::New();
  depth->SetName("Depth");
  depth->SetNumberOfTuples(order.depth.size());
  std::copy(order.depth.data(), order.depth.data() + order.depth.size(), depth->GetPointer(0));
  result->ShallowCopy(mesh);
  result->GetPointData()->AddArray(depth);
  status.report.set("counts.vertices", Report::Value(std::int64_t(mesh->GetNumberOfPoints())));
  status.report.set("counts.handles", layers.size());
  if (this->Displace)
  {
    Points points = to_points(mesh).view();
    const double scale = this->Scale > 0.0 ? this->Scale : 1e-3 * bounding_box(points).diagonal();
    points.col(2) += scale * order.front;
    result->SetPoints(to_vtk_points(points));
    status.report.set("scale", scale);
  }
  return status;
}

void vtkDepthOrder::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "LayerArrayName: " << this->LayerArrayName << "\n";
  os << indent << "Displace: " << (this->Displace ? "on" : "off") << "\n";
  os << indent << "Scale: " << this->Scale << "\n";
  os << indent << "Tie: " << this->Tie << "\n";
}
