#ifndef bindpose_inside_region_boundary_h
#define bindpose_inside_region_boundary_h

#include "base/execution.h"
#include "base/mesh.h"
#include "winding/winding_number.h"

#include <vector>

namespace bindpose
{

/// {winding number >= threshold} in the surface's box, and where the surface's triangles bound it:
/// what lies within or outside of it, such as the parts of crossing solids that are in each other,
/// does not. All of it is thread-safe. The surface and the winding number must outlive it.
class RegionBoundary
{
public:
  RegionBoundary(
    PointsView points, TrianglesView triangles, const WindingNumber& winding, double threshold);

  const Box& box() const { return this->box_; }
  bool holds(const Vec3& p) const;
  /// The region ends at triangles only: winding numbers are whole.
  bool closed() const { return this->closed_; }
  /// True when the region is on one side of triangle f at p, a point of it: looked at 1e-6 of the
  /// diagonal in front of it and behind it.
  bool bounded_at(Index f, const Vec3& p) const;
  /// The same next to corner k of the triangle.
  bool bounded_at_corner(Index f, int k) const;
  /// How far the region (or what is around it) reaches from p, where triangle f bounds it, along
  /// the normal; looked for in steps from `smallest` to `largest`, which it is at most. The less
  /// of both sides.
  double thickness(Index f, const Vec3& p, double smallest, double largest) const;
  /// Moves p to where the region ends along the unit vector n, outwards, at most `reach` away and
  /// to 2^-20 of that. @return false when it does not begin there inside and end outside.
  bool onto_boundary(Vec3& p, const Vec3& n, double reach) const;
  /// Unit normal, zero for a triangle without area.
  Vec3 normal(Index f) const;
  Vec3 corner(Index f, int k) const { return this->points_.row(this->triangles_(f, k)); }

  PointsView points() const { return this->points_; }
  TrianglesView triangles() const { return this->triangles_; }

private:
  PointsView points_;
  TrianglesView triangles_;
  const WindingNumber& winding_;
  double threshold_;
  Box box_;
  double step_;
  bool closed_;
};

struct BoundarySampling
{
  double smallest = 0.0; ///< length of the shortest edges wanted, > 0
  double largest = 0.0; ///< length of the longest edges wanted, >= smallest
  double growth = 0.3; ///< by how much lengths may differ, relative to the distance
};

/// Where a surface bounds a region, and how long edges should be there.
struct BoundarySites
{
  Points points; ///< #S x 3: input vertices on the boundary, then points of triangles
  /// #S: the mean over the triangles at a vertex of their shortest edges, for a point that of its
  /// triangle, and no more than the region (or the gap beside it) is thick; within the bounds.
  Eigen::VectorXd lengths;
  Eigen::VectorXd areas; ///< #S: share of the boundary's area, 0 for vertices
  std::vector<Index> vertices; ///< input ids of the first sites
};

/// Sites on every triangle, about `largest` apart. Cost about 5 us a triangle.
/// @return false when cancelled.
bool sample_boundary(const RegionBoundary& region, const BoundarySampling& options,
  BoundarySites& sites, ExecutionContext& context);

} // namespace bindpose

#endif
