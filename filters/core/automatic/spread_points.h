#ifndef bindpose_automatic_spread_points_h
#define bindpose_automatic_spread_points_h

#include "base/execution.h"
#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// What "far" means. The order is the one vtkAutomaticHandles exposes.
enum class PointDistance
{
  along_edges, ///< of the surface: near limbs are far from each other
  straight ///< through space
};

/// "along-edges", "straight".
const char* to_string(PointDistance distance);

struct SpreadPointsOptions
{
  Index count = 8; ///< >= 1
  PointDistance distance = PointDistance::along_edges;
  /// Moves each point from its vertex into the middle of the shape, where it has an inside there.
  bool inside = true;
  double winding_threshold = 0.5; ///< inside is where the winding number is at least this, > 0
};

struct SpreadPoints
{
  Points places; ///< #count x 3, in the order of choice
  std::vector<Index> vertices; ///< #count: the vertex that each was chosen at
  Index inside = 0; ///< that were moved into the shape
  Index components = 0; ///< of the surface, equal vertices welded
  Index served = 0; ///< components with a point
};

/// Spreads points over a surface's vertices, each as far as can be from all before it in its
/// component: the first at the vertex farthest (straight) from the centroid of the component's
/// vertices. After T. Gonzalez, "Clustering to minimize the maximum intercluster distance", 1985:
/// on the surface no vertex is farther from the points than these are from each other, which is at
/// most twice the best.
///
/// - **Components**, connected by welded vertices, get shares by their area (the next point goes to
///   where area / (points + 1) is largest), but each with at least a 100th of the largest one's
///   gets one before any gets two. No distance is taken between components.
/// - **Inside**: from the vertex against its normal, on whichever side the inside is, for as long
///   as depth (the distance to the surface) grows by at least 3/10 of the way, at most half way
///   through. So a point at a limb's tip stays in the tip, a corner's goes to where the faces'
///   middles meet. What was chosen then counts as near to all vertices within twice its depth, so
///   that both sides of a plate are not served twice.
/// - **Fewer are the first of more.** Ties go to the lower vertex id; vertices that are equal are
///   one, with the lowest id.
///
/// invalid_input: not finite, ids out of range, count < 1, fewer different vertices than count.
/// Cost: count shortest-path passes of at most O(#V log #V), fewer with each; inside 64 distances a
/// point.
Status spread_points(PointsView points, TrianglesView triangles, const SpreadPointsOptions& options,
  SpreadPoints& result, ExecutionContext& context);

} // namespace bindpose

#endif
