// Connects the kernel bindpose::cut_along_bones() to VTK. The left and right sides of bones become
// labels of vertices and region handles.
#include "vtkCutAlongBones.h"

#include "base/execution.h"
#include "conversion.h"
#include "domain/bone_cut.h"
#include "weights_input.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

using namespace bindpose;

vtkStandardNewMacro(vtkCutAlongBones);

namespace
{
/// Three cell arrays of colors: for the left sides of bones, for the right sides of bones, and for
/// handles that are not bones. Null if absent.
struct ColorArrays
{
  vtkDataArray* left = nullptr;
  vtkDataArray* right = nullptr;
  vtkDataArray* other = nullptr;
};

Status to_color_arrays(vtkPolyData* handles, ColorArrays& colors)
{
  const std::pair<const char*, vtkDataArray**> arrays[] = { { "LeftColor", &colors.left },
    { "RightColor", &colors.right }, { "Color", &colors.other } };
  for (const auto& [name, array] : arrays)
  {
    *array = handles->GetCellData()->GetArray(name);
    if (*array && (*array)->GetNumberOfComponents() != 3)
    {
      return Status::invalid_input(std::string("the handles' array '") + name + "' has " +
        std::to_string((*array)->GetNumberOfComponents()) + " components; expected 3 (RGB)");
    }
  }
  if ((colors.left == nullptr) != (colors.right == nullptr))
  {
    return Status::invalid_input(
      "the handles must have both cell arrays LeftColor and RightColor or neither");
  }
  return {};
}

/// Set first[j] for each handle j. Bones with the same value in the cell array `Curve` form a
/// curve; for these bones, first[j] is the first bone of the curve. For all other handles, first[j]
/// is j.
Status to_curves(vtkPolyData* handle_data, const Handles& handles, const std::vector<Index>& cells,
  std::vector<Index>& first)
{
  vtkDataArray* curves = handle_data->GetCellData()->GetArray("Curve");
  if (curves && curves->GetNumberOfComponents() != 1)
  {
    return Status::invalid_input("the handles' array 'Curve' has " +
      std::to_string(curves->GetNumberOfComponents()) + " components; expected 1");
  }
  std::map<double, Index> first_of;
  for (std::size_t j = 0; j < handles.size(); ++j)
  {
    first.push_back(static_cast<Index>(j));
    if (curves && handles[j].kind == HandleKind::bone)
    {
      first.back() =
        first_of.emplace(curves->GetComponent(cells[j], 0), first.back()).first->second;
    }
  }
  return {};
}

/// The handles of the output, and the color of each handle. A curve has one handle per side.
struct Sides
{
  Handles handles;
  vtkSmartPointer<vtkDoubleArray> colors = vtkSmartPointer<vtkDoubleArray>::New();

  Sides()
  {
    this->colors->SetName("Color");
    this->colors->SetNumberOfComponents(3);
  }
  void add(const Handle& handle, vtkDataArray* color, Index cell)
  {
    this->handles.push_back(handle);
    double rgb[3] = { 0.0, 0.0, 0.0 };
    if (color)
    {
      const double unit = color->GetDataType() == VTK_UNSIGNED_CHAR ? 255.0 : 1.0;
      for (int k = 0; k < 3; ++k)
      {
        rgb[k] = color->GetComponent(cell, k) / unit;
      }
    }
    this->colors->InsertNextTuple(rgb);
  }
};
} // namespace

vtkCutAlongBones::vtkCutAlongBones()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

int vtkCutAlongBones::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  if (port > 0)
  {
    AcceptBlocks(info);
  }
  return 1;
}

int vtkCutAlongBones::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

Status vtkCutAlongBones::Execute(
  ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  const Phase phase(context, "cut");
  vtkPolyData* mesh = vtkPolyData::GetData(input[0]);
  vtkPolyData* handle_data = vtkPolyData::GetData(input[1]);
  SurfaceInput surface;
  Status status = to_surface(mesh, surface);
  Handles handles;
  std::vector<Index> cells;
  if (status.ok())
  {
    status = to_handles(handle_data, handles, &cells);
  }
  ColorArrays colors;
  if (status.ok())
  {
    status = to_color_arrays(handle_data, colors);
  }
  std::vector<Index> curves;
  if (status.ok())
  {
    status = to_curves(handle_data, handles, cells, curves);
  }
  std::vector<Index> old_labels;
  if (status.ok())
  {
    status = to_region_ids(mesh, "RegionId", old_labels);
  }
  if (!status.ok())
  {
    return status;
  }
  BoneCut cut;
  status =
    cut_along_bones(context, surface.points.view(), surface.triangles.view(), handles, curves, cut);
  if (!status.usable())
  {
    return status;
  }

  // Labels of the sides start after the mesh's own labels.
  const Index base = std::accumulate(old_labels.begin(), old_labels.end(), Index(0),
    [](Index largest, Index label) { return std::max(largest, label); });
  Sides sides;
  for (std::size_t j = 0; j < handles.size(); ++j)
  {
    if (handles[j].kind != HandleKind::bone)
    {
      if (colors.left && !colors.other)
      {
        return Status::invalid_input("handle '" + handles[j].name +
          "' is not a bone and needs a color; add the cell array Color next to LeftColor and "
          "RightColor");
      }
      sides.add(handles[j], colors.other, cells[j]);
      continue;
    }
    for (const bool left : { true, false })
    {
      const Index side = 2 * static_cast<Index>(j) + (left ? 1 : 2);
      if (std::find(cut.side.begin(), cut.side.end(), side) != cut.side.end())
      {
        Handle region;
        region.name = handles[j].name + (left ? " left" : " right");
        region.kind = HandleKind::region;
        region.head = region.tail = 0.5 * (handles[j].head + handles[j].tail);
        region.region_id = base + side;
        sides.add(region, left ? colors.left : colors.right, cells[j]);
      }
    }
  }
  for (Handle& handle : sides.handles)
  {
    handle.parent = -1; // the parent may be a bone, and the output contains no bones
  }
  const Status checked = check_handles(sides.handles);
  if (!checked.ok())
  {
    return checked;
  }

  vtkPolyData* result = vtkPolyData::GetData(output, 0);
  result->ShallowCopy(to_polydata(cut.points, cut.triangles));
  vtkPointData* data = result->GetPointData();
  data->CopyAllocate(mesh->GetPointData(), cut.points.rows());
  auto originals = vtkSmartPointer<vtkIdTypeArray>::New();
  auto labels = vtkSmartPointer<vtkIdTypeArray>::New();
  originals->SetName("OriginalPointIds");
  labels->SetName("RegionId");
  for (Index v = 0; v < cut.points.rows(); ++v)
  {
    const std::size_t point = static_cast<std::size_t>(v);
    const Index original = cut.original[point];
    data->CopyData(mesh->GetPointData(), original, v);
    originals->InsertNextValue(original);
    const Index old_label = old_labels.empty() ? 0 : old_labels[original];
    labels->InsertNextValue(cut.side[point] > 0 ? base + cut.side[point] : old_label);
  }
  data->AddArray(originals);
  data->AddArray(labels);
  if (surface.cell_of_triangle.empty())
  {
    result->GetCellData()->ShallowCopy(mesh->GetCellData());
  }
  vtkPolyData* handles_out = vtkPolyData::GetData(output, 1);
  handles_out->ShallowCopy(to_polydata(sides.handles));
  if (colors.left || colors.other)
  {
    handles_out->GetCellData()->AddArray(sides.colors);
  }
  status.report.set("counts.vertices", cut.points.rows());
  status.report.set("counts.handles", static_cast<int>(sides.handles.size()));
  return status;
}

void vtkCutAlongBones::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
