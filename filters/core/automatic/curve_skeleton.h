#ifndef bindpose_automatic_curve_skeleton_h
#define bindpose_automatic_curve_skeleton_h

#include "base/execution.h"
#include "geometry/mesh.h"
#include "winding/curve_winding_number.h"

#include <vector>

namespace bindpose
{

/// Options of curve_skeleton().
struct CurveSkeletonOptions
{
  /// Threshold, > 0: a point is inside if its winding number is at least this. Used only if the
  /// surface is replaced by a closed surface (see curve_skeleton).
  double winding_threshold = 0.5;
  /// Approximate number of triangles after remeshing, 100 … 1000000, for all components together.
  /// Before the surface is contracted, it is remeshed to triangles of uniform size. Parts thinner
  /// than the edges of these triangles may be lost. The time grows slightly faster than this
  /// number.
  Index triangles = 10000;
  /// Time limit in seconds, > 0. The helper process gets the time that remains after the closed
  /// surface is computed, but at least 1 second.
  double time_limit = 120.0;
  Index memory_limit = 0; ///< largest address space of the helper process in MiB, 0: no limit
};

/// A curve through the middle of a shape, as segments that are much shorter than bones.
struct CurveSkeleton
{
  Points points; ///< #P x 3
  Segments segments; ///< #S x 2: ids of two points; each pair occurs at most once
  /// #P: distance of each point from the closed surface; about half of the shape's thickness there.
  Eigen::VectorXd radii;
  /// #P: component of each point, as an index into centroids. If a component has one point, its
  /// part of the shape is a ball or almost a ball.
  std::vector<Index> part_of_point;
  std::vector<Vec3> centroids; ///< for each component, the center of mass of its part of the shape
};

/// Compute the curve skeleton of the volume that a surface encloses, by mean curvature flow
/// (Tagliasacchi, Alhashim, Olson, Zhang, Mean Curvature Skeletons, 2012). The helper executable
/// bindpose-mesher runs the flow in a separate process.
///
/// A clean surface (closed, manifold, without crossings) with at most 10 times `triangles`
/// triangles is used as it is. Any other surface (open, crossing, doubled, partly inside out, flat)
/// is replaced by a closed surface of the enclosed volume and of a layer around thin parts
/// (thick_solid.h). If the surface has defects, its parts that touch or almost touch are joined.
/// Then the helper fills hollows, remeshes the surface to about `triangles` triangles of uniform
/// size and contracts it. Components with less than a 1000th of the largest component's volume are
/// omitted, with a warning.
///
/// @param solid  set to the closed surface before remeshing
///
/// Report: surface ("clean" or "lattice"), counts.parts, counts.contracted_triangles,
/// counts.iterations, counts.left_out_parts (omitted components); if surface is "lattice", also the
/// counts of prepare_surface and the report of thick_solid.
/// Return one of these errors:
/// - invalid_input: coordinates not finite, ids out of range, no triangle with an area, or an
///   option out of range;
/// - unavailable: the helper executable is missing;
/// - internal_error: the helper failed or exceeded the time limit;
/// - canceled: the flow ends within 20 ms after a cancel request.
/// Cost: some seconds for 10,000 contracted triangles, almost independent of the number of
/// triangles of the surface.
Status curve_skeleton(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const CurveSkeletonOptions& options, CurveSkeleton& skeleton, TriangleMesh& solid);

} // namespace bindpose

#endif
