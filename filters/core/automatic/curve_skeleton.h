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
  /// Inside is where the winding number is at least this, > 0. Of unclean surfaces only.
  double winding_threshold = 0.5;
  /// About as many even triangles are contracted, of all components together, 100 … 1000000. What
  /// is thinner than their edges may be lost; seconds grow a little faster than their number.
  Index triangles = 10000;
  double time_limit = 120.0; ///< seconds for all of the helper's work, > 0
  Index memory_limit = 0; ///< MiB of address space for the helper, 0: no limit
};

/// A curve through the middle of a shape, in pieces much shorter than bones.
struct CurveSkeleton
{
  Points points; ///< #P x 3
  Segments segments; ///< #S x 2, each pair once
  Eigen::VectorXd radii; ///< #P: distance to the closed surface: half of the thickness there
  /// #P: the component, by the number of its centroid. A component with one point is a ball, or
  /// near one.
  std::vector<Index> part_of;
  std::vector<Vec3> centroids; ///< of the mass of each component
};

/// The curve skeleton of what a surface encloses, by mean curvature flow (Tagliasacchi, Alhashim,
/// Olson, Zhang, Mean Curvature Skeletons, 2012) in the helper executable bindpose-mesher.
///
/// A clean surface (closed, manifold, nothing crosses) with at most 10 times `triangles` is
/// contracted itself. Any other one (open, crossing, doubled, partly inside out, flat) is replaced
/// by the closed surface of what it encloses together with a layer around thin parts
/// (thick_solid.h); parts of an unclean surface that touch or nearly touch become one. Either is
/// brought to `triangles` even triangles first. Hollows are filled; components with less than a
/// 1000th of the largest one's volume are left out, with a warning.
///
/// @param solid  the closed surface that was taken, before it was evened
///
/// Report: surface ("clean" or "lattice"), counts.parts, counts.contracted_triangles,
/// counts.iterations, counts.left_out_parts, the counts of prepare_surface; of a lattice what
/// thick_solid reports.
/// invalid_input: not finite, ids out of range, no triangle with an area, an option out of range.
/// unavailable: no helper. internal_error: the helper failed or ran out of time. cancelled within
/// 20 ms of the flow.
/// Cost: 10,000 triangles contracted take some seconds, whatever the surface's own number.
Status curve_skeleton(PointsView points, TrianglesView triangles,
  const CurveSkeletonOptions& options, CurveSkeleton& skeleton, TriangleMesh& solid,
  ExecutionContext& context);

} // namespace bindpose

#endif
