// Create handles by one of two methods (see automatic_handles.h). The surface is sorted by
// coordinates, so that the result does not depend on its storage order, and passed to the kernel of
// the method. Then the positions of the bones are checked.
#include "automatic/automatic_handles.h"

#include "surface/vertex_order.h"
#include "winding/winding_number.h"

#include <algorithm>
#include <array>
#include <functional>

namespace bindpose
{

const char* to_string(AutomaticMethod method)
{
  return method == AutomaticMethod::points ? "points" : "skeleton";
}

namespace
{
/// A surface in an order that depends only on its geometry. Unused and duplicate vertices are
/// removed, and vertices are sorted by coordinates. Each triangle begins with its lowest vertex id,
/// and triangles are sorted lexicographically by their three vertex ids.
struct SortedSurface
{
  Points points;
  Triangles triangles;
  /// #vertices: original id of each vertex; for duplicate vertices, the lowest of their ids.
  std::vector<Index> original;
};

SortedSurface sort_surface(PointsView points, TrianglesView triangles)
{
  std::vector<char> used(static_cast<std::size_t>(points.rows()), 0);
  for (Index k = 0; k < triangles.size(); ++k)
  {
    used[triangles.data()[k]] = 1;
  }
  const std::vector<Index> order = lexicographic_order(points, used);
  SortedSurface surface;
  std::vector<Index> number(static_cast<std::size_t>(points.rows()), -1);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    if (i == 0 || !are_coincident(points, order[i - 1], order[i]))
    {
      surface.original.push_back(order[i]);
    }
    number[order[i]] = static_cast<Index>(surface.original.size()) - 1;
  }
  surface.points.resize(static_cast<Index>(surface.original.size()), 3);
  for (std::size_t i = 0; i < surface.original.size(); ++i)
  {
    surface.points.row(static_cast<Index>(i)) = points.row(surface.original[i]);
  }
  std::vector<std::array<Index, 3>> faces;
  for (Index f = 0; f < triangles.rows(); ++f)
  {
    std::array<Index, 3> face{ number[triangles(f, 0)], number[triangles(f, 1)],
      number[triangles(f, 2)] };
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    faces.push_back(face);
  }
  std::sort(faces.begin(), faces.end());
  surface.triangles.resize(static_cast<Index>(faces.size()), 3);
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    surface.triangles.row(static_cast<Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
  }
  return surface;
}

Status make_points(ExecutionContext& context, const SortedSurface& surface,
  const SpreadPointsOptions& options, Handles& handles)
{
  SpreadPoints spread_result;
  Status status = spread_points(context, surface.points, surface.triangles, options, spread_result);
  if (!status.ok())
  {
    return status;
  }
  std::vector<Index> vertices;
  for (Index i = 0; i < spread_result.positions.rows(); ++i)
  {
    Handle handle;
    handle.head = handle.tail = spread_result.positions.row(i);
    handle.name = "p" + std::to_string(i + 1);
    handles.push_back(std::move(handle));
    vertices.push_back(surface.original[spread_result.vertices[i]]);
  }
  status.report.set("counts.components", spread_result.components);
  status.report.set("counts.served_components", spread_result.covered_components);
  status.report.set("counts.points_inside", spread_result.inside);
  status.report.set("distance", to_string(options.distance));
  status.report.set("handles[].vertex", vertices);
  return status;
}

/// Count the joints that are outside the shape and the bones that leave it between their ends.
void report_outside(
  const SkeletonBones& bones, const std::function<bool(const Vec3&)>& inside, Status& status)
{
  constexpr int pieces = 16;
  Index joints_outside = 0;
  for (Index j = 0; j < bones.joints.rows(); ++j)
  {
    joints_outside += inside(bones.joints.row(j)) ? 0 : 1;
  }
  Index bones_outside = 0;
  for (const Handle& bone : bones.handles)
  {
    for (int i = 1; i < pieces && bone.kind == HandleKind::bone; ++i)
    {
      const double t = static_cast<double>(i) / pieces;
      if (!inside((1.0 - t) * bone.head + t * bone.tail))
      {
        ++bones_outside;
        break;
      }
    }
  }
  status.report.set("counts.joints_outside", joints_outside);
  status.report.set("counts.bones_outside", bones_outside);
  if (joints_outside > 0)
  {
    status.warnings.push_back(std::to_string(joints_outside) + " of " +
      std::to_string(bones.joints.rows()) + " joints " + (joints_outside == 1 ? "is" : "are") +
      " outside the shape");
  }
}

Status make_bones(ExecutionContext& context, const SortedSurface& surface,
  const AutomaticHandlesOptions& options, Handles& handles)
{
  CurveSkeleton skeleton;
  TriangleMesh solid;
  Status status;
  {
    const Phase phase(context, "skeleton", 0.0, 0.98);
    status =
      curve_skeleton(context, surface.points, surface.triangles, options.skeleton, skeleton, solid);
  }
  if (!status.ok())
  {
    return status;
  }
  const Phase phase(context, "bones", 0.98, 1.0);
  WindingNumber winding;
  Status build_status = winding.build(context, solid.points, solid.triangles);
  if (!build_status.ok())
  {
    return build_status;
  }
  constexpr double half = 0.5;
  SkeletonBonesOptions bones_options = options.bones;
  bones_options.inside = [&winding](const Vec3& p) { return winding.evaluate_at(p) >= half; };
  SkeletonBones bones;
  const double diagonal = bounding_box(solid.points, solid.triangles).diagonal();
  Status simplified = skeleton_bones(skeleton, diagonal, bones_options, bones);
  if (!simplified.ok())
  {
    return simplified;
  }
  status.warnings.insert(
    status.warnings.end(), simplified.warnings.begin(), simplified.warnings.end());
  status.report.set("counts.skeleton_points", skeleton.points.rows());
  status.report.set("counts.joints", bones.joints.rows());
  status.report.set("counts.junctions", bones.junctions);
  status.report.set("counts.cut_cycles", bones.cut_cycles);
  status.report.set("counts.pruned_branches", bones.pruned_branches);
  status.report.set("counts.merged_branches", bones.merged_branches);
  report_outside(bones, bones_options.inside, status);
  handles = std::move(bones.handles);
  return status;
}
} // namespace

Status automatic_handles(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const AutomaticHandlesOptions& options, Handles& handles)
{
  handles.clear();
  Status status = check_mesh(points, triangles);
  if (!status.ok())
  {
    return status;
  }
  if (triangles.rows() == 0)
  {
    return Status::invalid_input("the surface has no triangles");
  }
  WorkingFrame frame;
  status = WorkingFrame::choose(points, triangles, "the surface", frame);
  if (!status.ok())
  {
    return status;
  }
  if (!frame.is_identity())
  {
    status = automatic_handles(context, frame.to_frame(points), triangles, options, handles);
    handles = from_frame(frame, handles);
    return status;
  }
  const SortedSurface surface = sort_surface(points, triangles);
  status = options.method == AutomaticMethod::points
    ? make_points(context, surface, options.points, handles)
    : make_bones(context, surface, options, handles);
  if (status.ok())
  {
    const Status checked = check_handles(handles);
    if (!checked.ok())
    {
      status = checked;
    }
  }
  if (!status.ok())
  {
    handles.clear();
    return status;
  }
  std::vector<std::string> names, kinds;
  for (const Handle& handle : handles)
  {
    names.push_back(handle.name);
    kinds.emplace_back(to_string(handle.kind));
  }
  status.report.set("method", to_string(options.method));
  status.report.set("counts.handles", static_cast<Index>(handles.size()));
  status.report.set("handles[].name", names);
  status.report.set("handles[].kind", kinds);
  return status;
}

} // namespace bindpose
