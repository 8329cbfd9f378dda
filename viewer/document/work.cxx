#include "document/work.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkVariant.h"

#include <algorithm>
#include <iterator>

namespace
{
bool same_source(const Source& a, const Source& b)
{
  return a.path == b.path && a.checksum == b.checksum;
}

template <typename Part>
void apply_change(const Part& before, const Part& after, Part& current)
{
  if (!(before == after))
  {
    current = after;
  }
}

void apply_change(const Source& before, const Source& after, Source& current)
{
  if (!same_source(before, after))
  {
    current = after;
  }
}

bool same_values(vtkAbstractArray* a, vtkAbstractArray* b)
{
  bool same = a && b && a->GetDataType() == b->GetDataType() &&
    a->GetNumberOfComponents() == b->GetNumberOfComponents() &&
    a->GetNumberOfTuples() == b->GetNumberOfTuples();
  for (vtkIdType i = 0; same && i < a->GetNumberOfValues(); ++i)
  {
    same = a->GetVariantValue(i) == b->GetVariantValue(i);
  }
  return same;
}

bool same_cells(vtkCellArray* a, vtkCellArray* b)
{
  return same_values(a->GetOffsetsArray(), b->GetOffsetsArray()) &&
    same_values(a->GetConnectivityArray(), b->GetConnectivityArray());
}

/// Report whether a cell array of the handles, given by its name, has no effect on a bind. This is
/// true for layers, colors, locks and the arrays of the pose.
bool is_appearance_array(const char* array)
{
  static const char* const appearance_arrays[] = { "Layer", "Color", "Locked", "Transform", "Mode",
    "Stretch", "Twist" };
  return std::any_of(std::begin(appearance_arrays), std::end(appearance_arrays),
    [array](const char* array_name) { return std::string(array_name) == array; });
}

/// Report whether `a` has all cell arrays of `b` with the same values, apart from arrays that have
/// no effect on a bind.
bool has_arrays_of(vtkPolyData* a, vtkPolyData* b)
{
  vtkCellData* arrays = b->GetCellData();
  for (int k = 0; k < arrays->GetNumberOfArrays(); ++k)
  {
    const char* name = arrays->GetArrayName(k);
    if (!name ||
      (!is_appearance_array(name) &&
        !same_values(a->GetCellData()->GetAbstractArray(name), arrays->GetAbstractArray(k))))
    {
      return false;
    }
  }
  return true;
}

/// Report whether two handle datasets differ at most in arrays that have no effect on a bind.
bool differ_only_in_looks(vtkPolyData* a, vtkPolyData* b)
{
  return a && b && a->GetPoints() && b->GetPoints() &&
    same_values(a->GetPoints()->GetData(), b->GetPoints()->GetData()) &&
    same_cells(a->GetVerts(), b->GetVerts()) && same_cells(a->GetLines(), b->GetLines()) &&
    same_cells(a->GetPolys(), b->GetPolys()) && has_arrays_of(a, b) && has_arrays_of(b, a);
}
} // namespace

bool same_mesh(vtkPolyData* a, vtkPolyData* b)
{
  return a == b ||
    (a && b && a->GetPoints() == b->GetPoints() && a->GetPolys() == b->GetPolys() &&
      a->GetStrips() == b->GetStrips());
}

bool same_pose(const bindpose::Pose& a, const bindpose::Pose& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](const bindpose::HandlePose& x, const bindpose::HandlePose& y)
    {
      return x.mode == y.mode && x.transform == y.transform && x.stretch == y.stretch &&
        x.twist == y.twist;
    });
}

int differences(const Work& a, const Work& b)
{
  const bool same_sources = same_source(a.mesh_source, b.mesh_source) &&
    same_source(a.handle_source, b.handle_source) &&
    same_source(a.picture_source, b.picture_source) &&
    same_source(a.volume_source, b.volume_source) && same_source(a.curve_source, b.curve_source);
  const bool mesh = same_mesh(a.surface, b.surface) && a.mesh_tets == b.mesh_tets &&
    a.picture == b.picture && a.look == b.look && a.name == b.name;
  const bool weights = a.surface == b.surface && a.weighted_tets == b.weighted_tets &&
    a.bound_handles == b.bound_handles;
  return (mesh ? 0 : mesh_part) | (weights ? 0 : weights_part) |
    (a.handles == b.handles                          ? 0
        : differ_only_in_looks(a.handles, b.handles) ? handle_looks_part
                                                     : handles_part) |
    (same_pose(a.pose, b.pose) ? 0 : pose_part) |
    (a.stored_poses == b.stored_poses ? 0 : stored_poses_part) |
    (a.options == b.options ? 0 : options_part) | (a.volume == b.volume ? 0 : volume_part) |
    (a.curves == b.curves ? 0 : curves_part) | (same_sources ? 0 : sources_part);
}

void apply_edit(const Work& before, const Work& after, Work& work)
{
  apply_change(before.name, after.name, work.name);
  apply_change(before.surface, after.surface, work.surface);
  apply_change(before.differs_from_file, after.differs_from_file, work.differs_from_file);
  apply_change(before.mesh_tets, after.mesh_tets, work.mesh_tets);
  apply_change(before.weighted_tets, after.weighted_tets, work.weighted_tets);
  apply_change(before.handles, after.handles, work.handles);
  apply_change(before.bound_handles, after.bound_handles, work.bound_handles);
  if (!same_pose(before.pose, after.pose))
  {
    work.pose = after.pose;
  }
  apply_change(before.stored_poses, after.stored_poses, work.stored_poses);
  apply_change(before.picture, after.picture, work.picture);
  apply_change(before.look, after.look, work.look);
  apply_change(before.volume, after.volume, work.volume);
  apply_change(before.volume_name, after.volume_name, work.volume_name);
  apply_change(before.curves, after.curves, work.curves);
  for (auto option = after.options.begin(); option != after.options.end(); ++option)
  {
    if (before.options.value(option.key()) != option.value())
    {
      work.options[option.key()] = option.value();
    }
  }
  apply_change(before.mesh_source, after.mesh_source, work.mesh_source);
  apply_change(before.handle_source, after.handle_source, work.handle_source);
  apply_change(before.picture_source, after.picture_source, work.picture_source);
  apply_change(before.volume_source, after.volume_source, work.volume_source);
  apply_change(before.curve_source, after.curve_source, work.curve_source);
}
