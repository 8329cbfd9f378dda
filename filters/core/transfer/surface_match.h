#ifndef bindpose_transfer_surface_match_h
#define bindpose_transfer_surface_match_h

#include "base/execution.h"
#include "domain/domain.h"
#include "geometry/simplex_locator.h"

namespace bindpose
{

/// Options of match_surface().
struct SurfaceMatchOptions
{
  /// A point matches only if its distance from the source is at most this fraction (>= 0) of the
  /// source's diagonal.
  double maximum_distance = 0.05;
  /// A point matches only if the angle between its normal and the normal of the source at the
  /// nearest point is at most this angle, in degrees (0 … 180). At 180 degrees, normals are
  /// ignored.
  double maximum_angle = 30.0;
};

/// The nearest points of a source surface, and the points of the target that match.
struct SurfaceMatch
{
  /// Triangles of the source: its own triangles, or the boundary of its tets.
  Triangles triangles;
  /// #target points: location of the nearest point on `triangles`. The element is -1 if the target
  /// point is not finite.
  std::vector<SimplexLocation> nearest;
  std::vector<char> matched; ///< #target points: 1 if the point matches
  double diagonal = 0.0; ///< bounding-box diagonal of the source

  /// Return the interpolated row of `values` (#source points x #columns) at the nearest point of
  /// a target point; zero if there is no nearest point.
  Eigen::RowVectorXd row(WeightsView values, Index point) const;
};

/// Return the normals of a surface at its vertices: the mean of the normals of the triangles at the
/// vertex, weighted by their angles there. The normal is zero at a vertex without a triangle of
/// positive area, and where the normals cancel. Vertices at the same position are not merged, so a
/// surface that is cut along an edge can have two normals there.
/// @return #V x 3, unit vectors or zero
Points vertex_normals(PointsView points, TrianglesView triangles);

/// Find for each point of the target the nearest point on the surface of the source, and decide by
/// distance and normal whether they match (first step of Abdrashitov et al. 2023, Robust skin
/// weights transfer via weight inpainting). The normal of the source is interpolated in the
/// triangle of the nearest point. Points of the target without a normal, such as the inner vertices
/// of tets, match only if normals are ignored. Cost: O(log
/// #triangles) per point near the source.
/// Return invalid_input if an option is out of range or the source has neither tets nor triangles.
Status match_surface(ExecutionContext& context, const Domain& source, const Domain& target,
  const SurfaceMatchOptions& options, SurfaceMatch& match);

} // namespace bindpose

#endif
