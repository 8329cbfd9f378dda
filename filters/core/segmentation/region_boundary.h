#ifndef bindpose_segmentation_region_boundary_h
#define bindpose_segmentation_region_boundary_h

#include "base/execution.h"
#include "geometry/mesh.h"
#include "winding/winding_number.h"

#include <vector>

namespace bindpose
{

/// The region {winding number >= threshold} in the surface's box, and the parts of the surface that
/// bound the region. A triangle does not bound the region if the region is on both sides of the
/// triangle or on neither side, for example if the triangle is inside another solid. All functions
/// are thread-safe. The surface and the winding number must outlive this object.
class RegionBoundary
{
public:
  RegionBoundary(
    PointsView points, TrianglesView triangles, const WindingNumber& winding, double threshold);

  const Box& box() const { return this->box_; }
  bool contains(const Vec3& p) const;
  /// Report whether the surface is closed. If so, all winding numbers are integers, and the
  /// boundary of the region consists of triangles of the surface. The boundary has other parts only
  /// if the surface has openings.
  bool closed() const { return this->closed_; }
  /// Report whether the region is on exactly one side of triangle f at p, a point of the triangle.
  /// The test evaluates points 1e-6 of the diagonal in front of p and behind it.
  bool bounds_region_at(Index f, const Vec3& p) const;
  /// Report whether the region is on exactly one side of triangle f near corner k of the triangle.
  bool bounded_at_corner(Index f, int k) const;
  /// Return the smaller of two lengths at p along the normal of triangle f: the thickness of the
  /// region on one side of f, and the width of the gap on the other side. The triangle must bound
  /// the region at p. The result is approximate: distances from `smallest` to `largest` are tested,
  /// each 1.5 times the previous one. The result is the first distance that exceeds one of the two
  /// lengths, or `largest` if no tested distance does.
  double thickness(Index f, const Vec3& p, double smallest, double largest) const;
  /// Move p along the unit vector n onto the boundary of the region, by at most `reach` in either
  /// direction, in `bisections` steps. The error is 2^-bisections times `reach`. n points outwards.
  /// @return true if p - reach n is inside and p + reach n is outside; otherwise p does not change.
  bool project_to_boundary(Vec3& p, const Vec3& n, double reach, int bisections = 20) const;
  /// Return the unit normal, or zero for a triangle without area.
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

/// Options of sample_boundary().
struct BoundarySampling
{
  double smallest = 0.0; ///< smallest requested edge length (> 0)
  double largest = 0.0; ///< largest requested edge length (>= smallest)
  /// Maximum growth rate: the difference of two edge lengths divided by the distance of their
  /// sites.
  double growth = 0.3;
};

/// Sample points ("sites") on the boundary of a region, with requested edge lengths.
struct BoundarySites
{
  Points points; ///< #S x 3: input vertices on the boundary, then points inside triangles
  /// Requested edge lengths, #S, from `smallest` to `largest`. The length at a point inside a
  /// triangle is that of the triangle's shortest edge, but at most the thickness of the region (or
  /// of the gap next to it). The length at a vertex is the mean of the shortest edges of its
  /// triangles.
  Eigen::VectorXd lengths;
  Eigen::VectorXd areas; ///< #S: area that the site represents, 0 for vertices
  /// #S: thickness of the region, or of the gap next to it, from `smallest` to `largest`; `largest`
  /// for vertices.
  Eigen::VectorXd thickness;
  std::vector<Index> vertices; ///< input ids of the sites that are vertices; these sites come first
};

/// Compute sites on the triangles that bound the region, about `largest` apart. Cost: about 5 us
/// per triangle.
/// @return false when canceled.
bool sample_boundary(ExecutionContext& context, const RegionBoundary& region,
  const BoundarySampling& options, BoundarySites& sites);

} // namespace bindpose

#endif
