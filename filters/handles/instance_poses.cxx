// Reads the poses of the instances of a crowd. An instance is a row of a table, a point of a point
// set, or a handle dataset in a composite. In tables and point sets, arrays named after handles
// contain the transforms. Handles without an array keep the base pose.
#include "instance_poses.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
const char* const placement_name = "Placement";
const char* const mode_name = "Mode";

std::string instance_prefix(std::size_t i)
{
  return "instance " + std::to_string(i) + ": ";
}

Affine affine_of(vtkDataArray* array, vtkIdType tuple)
{
  Affine affine = identity_affine();
  if (array->GetNumberOfComponents() == 12)
  {
    array->GetTuple(tuple, affine.data());
    return affine;
  }
  double translation[3];
  array->GetTuple(tuple, translation);
  affine.col(3) = Vec3(translation);
  return affine;
}

/// Report whether two lists contain the same handles in the same order.
bool same_handles(const Handles& a, const Handles& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](const Handle& x, const Handle& y)
    { return x.name == y.name && x.kind == y.kind && x.head == y.head && x.tail == y.tail; });
}

Status read_handle_poses(
  vtkCompositeDataSet* data, const Handles& handles, InstancePoses& instances)
{
  bool has_placements = false;
  vtkSmartPointer<vtkCompositeDataIterator> block;
  block.TakeReference(data->NewIterator());
  for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
  {
    const std::size_t i = instances.poses.size();
    auto* polydata = vtkPolyData::SafeDownCast(block->GetCurrentDataObject());
    if (!polydata)
    {
      return Status::invalid_input(instance_prefix(i) +
        "expected a vtkPolyData with handles, got a " +
        block->GetCurrentDataObject()->GetClassName());
    }
    Handles instance_handles;
    std::vector<Index> cells;
    Pose pose;
    Status status = to_handles(polydata, instance_handles, &cells);
    if (status.ok() && !same_handles(instance_handles, handles))
    {
      status = Status::invalid_input("its handles differ from the handles of the mesh");
    }
    if (status.ok())
    {
      status = to_pose(polydata, instance_handles, cells, pose);
    }
    vtkDataArray* placement = polydata->GetFieldData()->GetArray(placement_name);
    if (status.ok() && placement &&
      (placement->GetNumberOfTuples() != 1 ||
        (placement->GetNumberOfComponents() != 12 && placement->GetNumberOfComponents() != 3)))
    {
      status =
        Status::invalid_input("its field data array Placement must have one tuple of 12 components "
                              "(3x4, row-major) or of 3 components (a translation)");
    }
    if (!status.ok())
    {
      status.message = instance_prefix(i) + status.message;
      return status;
    }
    has_placements = has_placements || placement;
    instances.poses.push_back(std::move(pose));
    instances.placements.push_back(placement ? affine_of(placement, 0) : identity_affine());
  }
  if (!has_placements)
  {
    instances.placements.clear();
  }
  return {};
}

Status read_row_poses(vtkDataSetAttributes* arrays, vtkIdType rows, vtkPointSet* points,
  const Handles& handles, const Pose& base, InstancePoses& instances)
{
  Status status;
  instances.poses.assign(static_cast<std::size_t>(rows), base);
  bool any = false;
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    vtkDataArray* array = arrays->GetArray(handles[h].name.c_str());
    if (!array)
    {
      continue;
    }
    any = true;
    if (array->GetNumberOfComponents() != 12 && array->GetNumberOfComponents() != 3)
    {
      return Status::invalid_input("the array '" + handles[h].name + "' of the instances has " +
        std::to_string(array->GetNumberOfComponents()) +
        " components; expected 12 (3x4, row-major) or 3 (a translation)");
    }
    for (vtkIdType i = 0; i < rows; ++i)
    {
      instances.poses[static_cast<std::size_t>(i)][h].transform = affine_of(array, i);
    }
  }
  if (vtkDataArray* modes = arrays->GetArray(mode_name))
  {
    any = true;
    if (modes->GetNumberOfComponents() != static_cast<int>(handles.size()))
    {
      return Status::invalid_input("the array Mode of the instances has " +
        std::to_string(modes->GetNumberOfComponents()) + " components, but there are " +
        std::to_string(handles.size()) + " handles");
    }
    for (vtkIdType i = 0; i < rows; ++i)
    {
      for (std::size_t h = 0; h < handles.size(); ++h)
      {
        const double mode = modes->GetComponent(i, static_cast<int>(h));
        if (!(mode >= 0.0 && mode <= static_cast<double>(HandleMode::automatic)) ||
          mode != std::floor(mode))
        {
          return Status::invalid_input(instance_prefix(static_cast<std::size_t>(i)) + "handle '" +
            handles[h].name + "' has an unknown Mode");
        }
        instances.poses[static_cast<std::size_t>(i)][h].mode = static_cast<HandleMode>(int(mode));
      }
    }
  }
  if (!any)
  {
    status.warnings.emplace_back("no array of the instances has the name of a handle: all "
                                 "instances use the pose of the handles");
  }
  vtkDataArray* placements = arrays->GetArray(placement_name);
  if (placements && placements->GetNumberOfComponents() != 12 &&
    placements->GetNumberOfComponents() != 3)
  {
    return Status::invalid_input("the array Placement of the instances has " +
      std::to_string(placements->GetNumberOfComponents()) +
      " components; expected 12 (3x4, row-major) or 3 (a translation)");
  }
  for (vtkIdType i = 0; i < rows && (placements || points); ++i)
  {
    Affine placement = identity_affine();
    if (placements)
    {
      placement = affine_of(placements, i);
    }
    else
    {
      placement.col(3) = Vec3(points->GetPoint(i));
    }
    instances.placements.push_back(placement);
  }
  return status;
}
} // namespace

Status to_instance_poses(
  vtkDataObject* data, const Handles& handles, const Pose& base, InstancePoses& instances)
{
  instances = InstancePoses();
  Status status;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    status = read_handle_poses(composite, handles, instances);
  }
  else if (auto* table = vtkTable::SafeDownCast(data))
  {
    status = read_row_poses(
      table->GetRowData(), table->GetNumberOfRows(), nullptr, handles, base, instances);
  }
  else if (auto* points = vtkPointSet::SafeDownCast(data))
  {
    status = read_row_poses(
      points->GetPointData(), points->GetNumberOfPoints(), points, handles, base, instances);
  }
  if (!status.ok())
  {
    return status;
  }
  if (instances.poses.empty())
  {
    return Status::invalid_input("the crowd has no instances; at least one instance is required");
  }
  for (std::size_t i = 0; i < instances.placements.size(); ++i)
  {
    if (!instances.placements[i].allFinite())
    {
      return Status::invalid_input(
        instance_prefix(i) + "its placement contains a value that is not finite");
    }
  }
  return status;
}

} // namespace bindpose
