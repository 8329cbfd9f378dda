// Fill a cage of faces with tets, or a flat cage of edges with triangles (see cage_domain.h).
#include "domain/cage_domain.h"

#include "planar/planar_shape.h"

#include <cmath>
#include <utility>

namespace bindpose
{

namespace
{
/// Orient the edges of a cage, whose given directions are arbitrary. Each edge is reversed if
/// necessary, so that it begins where the previous edge ends. Then all edges are reversed if they
/// enclose a negative area.
void orient_outline(PlanePointsView points, Segments& edges)
{
  std::vector<std::vector<Index>> at(static_cast<std::size_t>(points.rows()));
  for (Index e = 0; e < edges.rows(); ++e)
  {
    at[static_cast<std::size_t>(edges(e, 0))].push_back(e);
    at[static_cast<std::size_t>(edges(e, 1))].push_back(e);
  }
  std::vector<char> done(static_cast<std::size_t>(edges.rows()), 0);
  for (Index first = 0; first < edges.rows(); ++first)
  {
    Index e = first;
    while (e >= 0 && !done[static_cast<std::size_t>(e)])
    {
      done[static_cast<std::size_t>(e)] = 1;
      const Index end = edges(e, 1);
      Index next = -1;
      for (const Index other : at[static_cast<std::size_t>(end)])
      {
        next = next < 0 && !done[static_cast<std::size_t>(other)] ? other : next;
      }
      if (next >= 0 && edges(next, 0) != end)
      {
        std::swap(edges(next, 0), edges(next, 1));
      }
      e = next;
    }
  }
  double area = 0.0;
  for (Index e = 0; e < edges.rows(); ++e)
  {
    const auto a = points.row(edges(e, 0));
    const auto b = points.row(edges(e, 1));
    area += a[0] * b[1] - a[1] * b[0];
  }
  if (area < 0.0)
  {
    edges.col(0).swap(edges.col(1));
  }
}

/// Make tets that fill the region inside the cage's faces.
Status fill_faces(ExecutionContext& context, const std::vector<CageElement>& faces,
  PointsView points, const Handles& handles, const CageOptions& cage, CageDomain& result)
{
  Points corners(static_cast<Index>(handles.size()), 3);
  for (Index i = 0; i < corners.rows(); ++i)
  {
    corners.row(i) = handles[static_cast<std::size_t>(i)].head;
  }
  Triangles triangles(static_cast<Index>(faces.size()), 3);
  for (Index f = 0; f < triangles.rows(); ++f)
  {
    triangles.row(f) << faces[f][0], faces[f][1], faces[f][2];
  }
  TetrahedralizeOptions options;
  options.interior_edge = interior_edge_of_weights(
    std::abs(signed_volume(corners, triangles)), bounding_box(corners).diagonal());
  options.handles.points = cage.handle_elements.points;
  if (points.rows() <= cage.maximum_points)
  {
    const Index count = options.handles.points.rows();
    options.handles.points.conservativeResize(count + points.rows(), 3);
    options.handles.points.bottomRows(points.rows()) = points;
  }
  const Phase phase(context, "tetrahedralize");
  Status status = tetrahedralize(context, corners, triangles, options, result.tets);
  if (!status.usable())
  {
    status.message = "the cage cannot be filled: " + status.message;
    return status;
  }
  result.domain = tet_domain(result.tets.mesh);
  return status;
}

/// Make triangles that fill the region inside the cage's edges, in the plane of a flat shape.
Status fill_edges(ExecutionContext& context, const std::vector<CageElement>& edges,
  PointsView points, TrianglesView triangles, const Handles& handles, const CageOptions& cage,
  CageDomain& result)
{
  const char* requirement = "domain cage needs a closed cage: either of faces, or of edges in "
                            "the plane of a flat shape";
  if (edges.empty())
  {
    return Status::invalid_input(requirement);
  }
  // Rows of `positions`: the heads of all handles, then their tails (for a handle without a tail,
  // the head again), then the points of the shape.
  const auto handle_count = static_cast<Index>(handles.size());
  const Index shape_points = points.rows() <= cage.maximum_points ? points.rows() : 0;
  Points positions(2 * handle_count + points.rows(), 3);
  PlanarHandles inside;
  inside.bones.resize(handle_count, 2);
  Index bones = 0;
  for (Index j = 0; j < handle_count; ++j)
  {
    const Handle& handle = handles[static_cast<std::size_t>(j)];
    const bool bone = handle.kind == HandleKind::bone;
    positions.row(j) = handle.head;
    positions.row(handle_count + j) = bone ? handle.tail : handle.head;
    if (bone)
    {
      inside.bones.row(bones++) << j, handle_count + j;
    }
  }
  inside.bones.conservativeResize(bones, 2);
  positions.bottomRows(points.rows()) = points;
  Vec3 normal;
  if (!is_flat(positions, bounding_box(positions).diagonal(), normal))
  {
    return Status::invalid_input(
      std::string(requirement) + "; these handles and the shape are not flat");
  }
  // Orient the normal so that the shape's triangles are counter-clockwise around it.
  Vec3 area = Vec3::Zero();
  for (Index f = 0; f < triangles.rows(); ++f)
  {
    const auto corner = [&](int k) { return Vec3(points.row(triangles(f, k))); };
    area += (corner(1) - corner(0)).cross(corner(2) - corner(0));
  }
  normal = area.dot(normal) < 0.0 ? Vec3(-normal) : normal;
  const Vec3 origin = positions.colwise().mean();
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = normal.unitOrthogonal();
  axes.col(1) = normal.cross(axes.col(0));
  const PlanePoints flat = (positions.rowwise() - origin.transpose()) * axes;
  inside.points = flat.topRows(2 * handle_count + shape_points);
  const PlanePoints corners = flat.topRows(handle_count);
  Segments outline(static_cast<Index>(edges.size()), 2);
  for (Index e = 0; e < outline.rows(); ++e)
  {
    outline.row(e) << edges[static_cast<std::size_t>(e)][0], edges[static_cast<std::size_t>(e)][1];
  }
  orient_outline(corners, outline);
  PlanarShapeOptions options;
  options.winding_threshold = cage.winding_threshold;
  PlanarShape shape;
  const Phase phase(context, "triangulate");
  Status status = planar_shape(context, corners, outline, inside, options, shape);
  if (!status.usable())
  {
    status.message = "the cage cannot be filled: " + status.message;
    return status;
  }
  if (status.report.number("counts.outside_handles", 0.0) > 0.0)
  {
    // Drop the last warning, which counts handles and points of the shape outside the cage. Later
    // steps report handles and points separately: weights_problem.cpp reports the handles, and the
    // transfer of the weights to the surface reports the points.
    status.warnings.pop_back();
  }
  // Report only the angle and the area, because weights_problem.cpp reports the numbers of vertices
  // and triangles.
  Report report;
  report.set("cage.min_angle", status.report.number("min_angle", 0.0));
  report.set("cage.area", status.report.number("area", 0.0));
  status.report = std::move(report);
  Domain& domain = result.domain;
  domain.points = (shape.points * axes.transpose()).rowwise() + origin.transpose();
  domain.triangles = shape.triangles;
  // Copy the exact coordinates of the handles and of the shape's points, so that later searches
  // find these vertices.
  for (Index i = 0; i < static_cast<Index>(shape.handle_vertices.size()); ++i)
  {
    if (shape.handle_vertices[static_cast<std::size_t>(i)] >= 0)
    {
      domain.points.row(shape.handle_vertices[static_cast<std::size_t>(i)]) = positions.row(i);
    }
  }
  result.plane_cage = { domain.points, domain.triangles };
  return status;
}
} // namespace

Status fill_cage(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const Handles& handles, const CageOptions& options, CageDomain& result)
{
  result = CageDomain();
  std::vector<CageElement> faces;
  std::vector<CageElement> edges;
  for (const Handle& handle : handles)
  {
    for (const CageElement& element : handle.cage)
    {
      (element[2] >= 0 ? faces : edges).push_back(element);
    }
  }
  return faces.empty() ? fill_edges(context, edges, points, triangles, handles, options, result)
                       : fill_faces(context, faces, points, handles, options, result);
}

} // namespace bindpose
