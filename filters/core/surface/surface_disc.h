#ifndef bindpose_surface_surface_disc_h
#define bindpose_surface_surface_disc_h

#include "base/mesh.h"

#include <utility>
#include <vector>

namespace bindpose
{

/// Finds the vertices of a surface within a distance of a place on it, along the surface. Points
/// and triangles must outlive it. O(n) to build; a disc costs O(k log k) of its own k vertices. Not
/// for several threads at once: it keeps room for the distances.
class SurfaceDisc
{
public:
  SurfaceDisc(PointsView points, TrianglesView triangles);

  /// A vertex and its distance.
  using Found = std::pair<Index, double>;
  /// Distances from `place`, on triangle `triangle`, grow over the surface from triangle to
  /// triangle as from a point source unfolded into each one's plane: exact where the surface is
  /// flat around the place, and never less than the distance through space. Where the surface is
  /// torn, they do not jump. @return sorted by distance
  std::vector<Found> within(const Vec3& place, Index triangle, double radius) const;

private:
  /// Distance of c when those of a and b are known.
  double carried(Index a, Index b, Index c) const;

  PointsView points_;
  TrianglesView triangles_;
  std::vector<Index> first_; // of each vertex, in around_
  std::vector<Index> around_; // triangles at a vertex
  mutable std::vector<double> distance_; // infinity but while a disc is made
  mutable std::vector<char> done_;
};

} // namespace bindpose

#endif
