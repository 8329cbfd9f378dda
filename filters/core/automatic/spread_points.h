#ifndef bindpose_automatic_spread_points_h
#define bindpose_automatic_spread_points_h

#include "base/execution.h"
#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// Measure of distance. vtkAutomaticHandles exposes the same order.
enum class PointDistance
{
  along_edges, ///< along edges of the surface: neighboring limbs are far from each other
  straight ///< through space
};

/// Return "along-edges" or "straight".
const char* to_string(PointDistance distance);

struct SpreadPointsOptions
{
  Index count = 8; ///< >= 1
  PointDistance distance = PointDistance::along_edges;
  /// Move each point from its vertex to the middle of the shape, if there is an inside at the
  /// vertex.
  bool inside = true;
  double winding_threshold = 0.5; ///< a point is inside if its winding number is at least this, > 0
};

struct SpreadPoints
{
  Points places; ///< #count x 3, in the order of choice
  std::vector<Index> vertices; ///< #count: the vertex at which each point was chosen
  Index inside = 0; ///< number of points that were moved inside
  Index components = 0; ///< number of components of the surface with equal vertices welded
  Index served = 0; ///< number of components with a point
};

/// Spread points over a surface's vertices. Each point is as far as possible from all earlier
/// points of its component. The first one is the vertex farthest (straight) from the centroid of
/// the component's vertices. The method is that of T. Gonzalez, "Clustering to minimize the maximum
/// intercluster distance", 1985: on the surface, no vertex is farther from its nearest point than
/// the points are from each other, and this distance is at most twice the optimum.
///
/// - **Components** are connected by welded vertices and get points in proportion to their area:
///   the next point goes to the component with the largest area / (points + 1). Before that, each
///   component with at least a 100th of the largest component's area gets one point. Distances are
///   only measured within a component.
/// - **Inside**: a point moves from the vertex against its normal, or along the normal if the
///   inside is there. It moves while its depth (the distance to the surface) grows by at least 3/10
///   of the path, and at most half way through. A point at a limb's tip therefore remains in the
///   tip, and a point at a corner moves to where the middles of the faces meet. All vertices within
///   twice the depth of a chosen point count as near it, so that the two sides of a plate do not
///   both get points.
/// - **The first n points do not depend on count.** Of equally distant vertices the one with the
///   lowest id is chosen. Equal vertices are one vertex, with the lowest id.
///
/// invalid_input: coordinates not finite, ids out of range, count < 1, fewer different vertices
/// than count.
/// Cost: count shortest-path searches of at most O(#V log #V), each one smaller than the previous;
/// inside: 64 distances per point.
Status spread_points(PointsView points, TrianglesView triangles, const SpreadPointsOptions& options,
  SpreadPoints& result, ExecutionContext& context);

} // namespace bindpose

#endif
