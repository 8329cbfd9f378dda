#ifndef bindpose_surface_surface_disc_h
#define bindpose_surface_surface_disc_h

#include "base/mesh.h"

#include <utility>
#include <vector>

namespace bindpose
{

/// Finds the vertices of a surface within a distance of a point on it, measured along the surface.
/// Points and triangles must outlive this object. O(n) to build; a disc costs O(k log k) for its k
/// vertices. Not thread-safe, because the object stores the distances.
class SurfaceDisc
{
public:
  SurfaceDisc(PointsView points, TrianglesView triangles);

  /// A vertex and its distance.
  using Found = std::pair<Index, double>;
  /// Find the vertices within `radius` of `place`, a point on triangle `triangle`. Distances
  /// propagate from triangle to triangle as from a point source that is unfolded into each
  /// triangle's plane. They are exact if the surface is flat around the point, and never less than
  /// the straight distance. They do not cross tears of the surface. @return sorted by distance
  std::vector<Found> within(const Vec3& place, Index triangle, double radius) const;

private:
  /// Return the distance of c from those of a and b.
  double carried(Index a, Index b, Index c) const;

  PointsView points_;
  TrianglesView triangles_;
  std::vector<Index> first_; // offset of each vertex in around_
  std::vector<Index> around_; // triangles at a vertex
  mutable std::vector<double> distance_; // infinity, except while within() runs
  mutable std::vector<char> done_;
};

} // namespace bindpose

#endif
