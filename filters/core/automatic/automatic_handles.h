#ifndef bindpose_automatic_automatic_handles_h
#define bindpose_automatic_automatic_handles_h

#include "automatic/curve_skeleton.h"
#include "automatic/skeleton_bones.h"
#include "automatic/spread_points.h"

namespace bindpose
{

/// The method that creates the handles. The integers are those of vtkAutomaticHandles.
enum class AutomaticMethod
{
  skeleton, ///< bones along the curve skeleton of the shape
  points ///< points spread over the shape
};

/// Return "skeleton" or "points".
const char* to_string(AutomaticMethod method);

/// Options of automatic_handles().
struct AutomaticHandlesOptions
{
  AutomaticMethod method = AutomaticMethod::skeleton;
  CurveSkeletonOptions skeleton; ///< options of method skeleton
  SkeletonBonesOptions bones; ///< options of method skeleton; the member `inside` is overwritten
  SpreadPointsOptions points; ///< options of method points
};

/// Create handles of a shape automatically: bones along its curve skeleton (curve_skeleton.h,
/// skeleton_bones.h), or points spread over it (spread_points.h). The surface may have any defects.
///
/// The same shape gives the same handles for any order of its vertices and triangles, because
/// vertices and triangles are first sorted by coordinates.
///
/// Report:
/// - method, counts.handles, handles[].name, handles[].kind
/// - for method skeleton: the report of curve_skeleton, counts.skeleton_points, counts.joints,
///   counts.junctions, counts.cut_cycles, counts.pruned_branches, counts.merged_branches
/// - for method skeleton, counts.joints_outside: number of joints at which the winding number of
///   the closed surface is below 0.5, with a warning if it is not 0
/// - for method skeleton, counts.bones_outside: number of bones that leave the closed surface; a
///   bone is counted if at least one of 15 test points between its ends is outside
/// - for method points: counts.components, counts.served_components (components with at least one
///   point), counts.points_inside, distance, and handles[].vertex, the input vertex from which each
///   point was made
/// For errors and cost, see curve_skeleton(), skeleton_bones() and spread_points().
Status automatic_handles(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const AutomaticHandlesOptions& options, Handles& handles);

} // namespace bindpose

#endif
