#ifndef bindpose_automatic_curve_skeleton_h
#define bindpose_automatic_curve_skeleton_h

#include "base/execution.h"
#include "base/mesh.h"
#include "winding/curve_winding_number.h"

#include <vector>

namespace bindpose
{

struct CurveSkeletonOptions
{
  /// A point is inside if its winding number is at least this, > 0. Used for unclean surfaces only.
  double winding_threshold = 0.5;
  /// Approximate number of even triangles that are contracted, for all components together, 100 …
  /// 1000000. Parts thinner than their edges may be lost. The time grows a little faster than this
  /// number.
  Index triangles = 10000;
  double time_limit = 120.0; ///< time limit for all work of the helper in seconds, > 0
  Index memory_limit = 0; ///< largest address space of the helper in MiB, 0: no limit
};

/// A curve through the middle of a shape, in pieces much shorter than bones.
struct CurveSkeleton
{
  Points points; ///< #P x 3
  Segments segments; ///< #S x 2, each pair of points at most once
  Eigen::VectorXd radii; ///< #P: distance to the closed surface, which is half of the thickness
  /// Component of each point, as an index into centroids, #P. A component with one point is a ball
  /// or nearly one.
  std::vector<Index> part_of;
  std::vector<Vec3> centroids; ///< center of mass of each component
};

/// Compute the curve skeleton of the volume that a surface encloses, by mean curvature flow
/// (Tagliasacchi, Alhashim, Olson, Zhang, Mean Curvature Skeletons, 2012) in the helper executable
/// bindpose-mesher.
///
/// A clean surface (closed, manifold, without crossings) with at most 10 times `triangles` is
/// contracted itself. Any other surface (open, crossing, doubled, partly inside out, flat) is
/// replaced by a closed surface of the enclosed volume and of a layer around thin parts
/// (thick_solid.h). Parts of an unclean surface that touch or nearly touch are joined. The surface
/// is first remeshed to `triangles` even triangles. Hollows are filled. Components with less than a
/// 1000th of the largest component's volume are omitted, with a warning.
///
/// @param solid  the closed surface before remeshing
///
/// Report: surface ("clean" or "lattice"), counts.parts, counts.contracted_triangles,
/// counts.iterations, counts.left_out_parts, the counts of prepare_surface; for a lattice, the
/// report of thick_solid.
/// invalid_input: coordinates not finite, ids out of range, no triangle with an area, an option out
/// of range. unavailable: no helper. internal_error: the helper failed or ran out of time.
/// canceled: within 20 ms during the flow.
/// Cost: some seconds for 10,000 contracted triangles, for any number of triangles of the surface.
Status curve_skeleton(PointsView points, TrianglesView triangles,
  const CurveSkeletonOptions& options, CurveSkeleton& skeleton, TriangleMesh& solid,
  ExecutionContext& context);

} // namespace bindpose

#endif
