#ifndef bindpose_surface_surface_disc_h
#define bindpose_surface_surface_disc_h

#include "geometry/mesh.h"

#include <utility>
#include <vector>

namespace bindpose
{

/// Finds the vertices of a surface within a geodesic distance of a point on the surface. Points and
/// triangles must outlive this object. Cost: O(n) to build; O(k log k) for a disc of k vertices.
/// Not thread-safe, because the object stores the distances.
class SurfaceDisc
{
public:
  SurfaceDisc(PointsView points, TrianglesView triangles);

  /// A vertex and its geodesic distance.
  using VertexDistance = std::pair<Index, double>;
  /// Find the vertices within `radius` of `point`, a point on triangle `triangle`. Distances are
  /// propagated from triangle to triangle, as if the surface were unfolded into the plane of each
  /// triangle. The distances are exact if the surface is flat around the point, and never less than
  /// the straight-line distance. Distances do not propagate across gaps of the surface.
  /// @return vertices and distances, sorted by distance
  std::vector<VertexDistance> within(const Vec3& point, Index triangle, double radius) const;

private:
  /// Return the geodesic distance of vertex c of the triangle a b c, computed from the distances of
  /// a and b.
  double propagated_distance(Index a, Index b, Index c) const;

  PointsView points_;
  TrianglesView triangles_;
  std::vector<Index> first_; // #V + 1: index in vertex_triangles_ of each vertex's first triangle
  std::vector<Index> vertex_triangles_; // triangles around each vertex
  mutable std::vector<double> distance_; // #V: distances; infinity, except while within() runs
  mutable std::vector<char> done_;
};

} // namespace bindpose

#endif
