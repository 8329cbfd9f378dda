#ifndef bindpose_surface_surface_probe_h
#define bindpose_surface_surface_probe_h

#include "surface/triangle_tree.h"

#include <vector>

namespace bindpose
{

/// Where a line comes in and goes out.
struct LineSpan
{
  Vec3 entry = Vec3::Zero();
  Vec3 exit = Vec3::Zero(); ///< equal to entry where the surface was met once
  Index triangle = -1; ///< at the entry

  Vec3 middle() const { return 0.5 * (this->entry + this->exit); }
};

/// Answers what a hand asks of a surface: what lies under the cursor, how thick the shape is there,
/// what place is nearest. Points and triangles must outlive it. O(n log n) to build, O(log n +
/// hits) an answer. Thread-safe.
class SurfaceProbe
{
public:
  SurfaceProbe(PointsView points, TrianglesView triangles);

  /// Where a ray meets the surface, nearest first. A hit on an edge that triangles share counts
  /// once; triangles seen from their sides do not count.
  struct Hit
  {
    double distance = 0.0; ///< in lengths of the direction
    Index triangle = -1;
    bool enters = true; ///< against the triangle's normal
  };
  std::vector<Hit> hits(const Vec3& origin, const Vec3& direction) const;

  /// The first stretch of a ray inside the surface, by winding number: from the first hit to where
  /// as many hits have gone out as in (or, of a surface that is inside out, in as out). So parts
  /// that overlap or lie within each other are one thickness, and a cavity ends it. Where that
  /// never comes, the surface being open there, the first two hits; where there is one, that.
  /// False when the ray meets nothing.
  bool first_inside(const Vec3& origin, const Vec3& direction, LineSpan& span) const;

  /// The place on the surface nearest to p; false for a surface without triangles.
  bool nearest(const Vec3& p, Vec3& place) const;

private:
  PointsView points_;
  TrianglesView triangles_;
  TriangleTree tree_;
  Box box_;
};

} // namespace bindpose

#endif
