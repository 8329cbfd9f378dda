#ifndef bindpose_surface_surface_probe_h
#define bindpose_surface_surface_probe_h

#include "surface/triangle_tree.h"

#include <vector>

namespace bindpose
{

/// The first interval of a line inside a shape: the points at which the line enters and leaves.
struct LineSpan
{
  Vec3 entry = Vec3::Zero();
  Vec3 exit = Vec3::Zero(); ///< equal to entry if the line intersects the surface only once
  Index triangle = -1; ///< triangle at the entry

  Vec3 middle() const { return 0.5 * (this->entry + this->exit); }
};

/// Answers the queries of interactive tools: the surface point under the cursor, the thickness of
/// the shape there, the nearest surface point. Points and triangles must outlive this object. Cost:
/// O(n log n) to build, O(log n + hits) per query. Thread-safe.
class SurfaceProbe
{
public:
  SurfaceProbe(PointsView points, TrianglesView triangles);

  /// One intersection of a ray and the surface. An intersection on an edge that several triangles
  /// share counts once. Triangles parallel to the ray do not count.
  struct Hit
  {
    double distance = 0.0; ///< distance from the origin, in units of the direction vector's length
    Index triangle = -1;
    bool enters = true; ///< whether the ray goes against the triangle's normal
  };
  /// Return all intersections of a ray with the surface, sorted by distance.
  std::vector<Hit> hits(const Vec3& origin, const Vec3& direction) const;

  /// Find the first interval of a ray inside the surface, by counting entries and exits. The
  /// interval begins at the first hit and ends at the first later hit at which the numbers of
  /// entries and exits are equal. Empty intervals, as at a silhouette edge, are skipped.
  /// Overlapping or nested parts therefore give one interval, and a cavity ends the interval. The
  /// result is the same if the surface is inside out. If the numbers are never equal, because the
  /// surface is open, the interval lies between the first two hits. If there is only one hit, the
  /// interval is that point. Return false if the ray hits nothing.
  bool first_inside(const Vec3& origin, const Vec3& direction, LineSpan& span) const;

  /// Find the point on the surface nearest to p. Return false if the surface has no triangles.
  bool nearest(const Vec3& p, Vec3& nearest_point) const;

private:
  PointsView points_;
  TrianglesView triangles_;
  TriangleTree tree_;
  Box box_;
};

} // namespace bindpose

#endif
