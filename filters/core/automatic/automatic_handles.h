#ifndef bindpose_automatic_automatic_handles_h
#define bindpose_automatic_automatic_handles_h

#include "automatic/curve_skeleton.h"
#include "automatic/skeleton_bones.h"
#include "automatic/spread_points.h"

namespace bindpose
{

/// The order is the one vtkAutomaticHandles exposes.
enum class AutomaticMethod
{
  skeleton, ///< bones along the shape's curve skeleton
  points ///< points spread over the shape
};

/// "skeleton", "points".
const char* to_string(AutomaticMethod method);

struct AutomaticHandlesOptions
{
  AutomaticMethod method = AutomaticMethod::skeleton;
  CurveSkeletonOptions skeleton; ///< of method skeleton
  SkeletonBonesOptions bones; ///< of method skeleton; its `inside` is set
  SpreadPointsOptions points; ///< of method points
};

/// Handles of a shape without a hand: bones along its curve skeleton (curve_skeleton.h,
/// skeleton_bones.h), or points spread over it (spread_points.h), for surfaces as unclean as they
/// come.
///
/// The same shape gives the same handles, whatever the order of its vertices and triangles: they
/// are sorted by their coordinates first.
///
/// Report: method, counts.handles, handles[].name, handles[].kind. Of skeleton what curve_skeleton
/// reports, counts.skeleton_points, counts.joints, counts.junctions, counts.joints_outside (whose
/// winding number by the closed surface is below 0.5; a warning says so),
/// counts.bones_outside (that leave it on their way, at one of 15 places between their ends),
/// counts.cut_cycles, counts.pruned_branches, counts.merged_branches. Of points counts.components,
/// counts.served_components, counts.points_inside, distance, and handles[].vertex, the vertex of
/// the input that each was chosen at.
/// Errors and cost: theirs.
Status automatic_handles(PointsView points, TrianglesView triangles,
  const AutomaticHandlesOptions& options, Handles& handles, ExecutionContext& context);

} // namespace bindpose

#endif
