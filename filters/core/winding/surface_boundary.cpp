// Boundary edges, components and volumes of a welded surface.
//
// The surface and the caps together are closed. Each component together with its caps is also
// closed, because a boundary loop belongs to one component. Therefore the volume of a component
// does not depend on the origin of the sum. The origin is a vertex of the component, which reduces
// round-off if a small component is far from the coordinate origin.
#include "winding/surface_boundary.h"

#include <cstdlib>

namespace bindpose
{

SurfaceBoundary surface_boundary(
  PointsView points, TrianglesView triangles, const std::vector<Edge>& edges, TrianglesView caps)
{
  const Components components = connected_components(points.rows(), triangles);
  SurfaceBoundary boundary;
  boundary.components.resize(static_cast<std::size_t>(components.count));
  std::vector<Index> origin(static_cast<std::size_t>(components.count), -1);
  const auto add = [&](const auto& corners, Index counts)
  {
    const Index component = components.component_of_vertex[corners[0]];
    Index& o = origin[component];
    o = o < 0 ? corners[0] : o;
    const Vec3 a = points.row(corners[0]) - points.row(o);
    const Vec3 b = points.row(corners[1]) - points.row(o);
    const Vec3 c = points.row(corners[2]) - points.row(o);
    boundary.components[component].triangles += counts;
    boundary.components[component].volume += a.dot(b.cross(c)) / 6.0;
  };
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    add(triangles.row(t), 1);
  }
  for (Index t = 0; t < caps.rows(); ++t)
  {
    add(caps.row(t), 0);
  }
  for (const Edge& edge : edges)
  {
    if (edge.net_direction != 0)
    {
      const Index component = components.component_of_vertex[edge.a];
      const Index multiplicity = std::abs(edge.net_direction);
      const bool forwards = edge.net_direction > 0;
      boundary.edges.push_back(
        { forwards ? edge.a : edge.b, forwards ? edge.b : edge.a, multiplicity, component });
      boundary.components[component].open_edges += multiplicity;
    }
  }
  return boundary;
}

} // namespace bindpose
