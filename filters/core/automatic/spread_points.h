#ifndef bindpose_automatic_spread_points_h
#define bindpose_automatic_spread_points_h

#include "base/execution.h"
#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// The distance that is used to spread points. The integers are those of vtkAutomaticHandles.
enum class PointDistance
{
  along_edges, ///< distance along edges of the surface: neighboring limbs are far from each other
  straight ///< straight-line distance in space
};

/// Return "along-edges" or "straight".
const char* to_string(PointDistance distance);

/// Options of spread_points().
struct SpreadPointsOptions
{
  Index count = 8; ///< number of points, >= 1
  PointDistance distance = PointDistance::along_edges;
  /// Move each point from its vertex into the middle of the shape. A point remains at its vertex
  /// if, next to the vertex, both sides of the surface are outside the shape.
  bool inside = true;
  /// Threshold, > 0: a point is inside if its winding number is at least this.
  double winding_threshold = 0.5;
};

/// The result of spread_points().
struct SpreadPoints
{
  Points positions; ///< #count x 3: positions of the points, in the order of choice
  std::vector<Index> vertices; ///< #count: the vertex at which each point was chosen
  Index inside = 0; ///< number of points that were moved inside
  Index components = 0; ///< number of components, after welding vertices with equal positions
  Index covered_components = 0; ///< number of components that got at least one point
};

/// Spread points over a surface's vertices (farthest-point sampling). Each point is as far as
/// possible from all earlier points of its component. The first point is the vertex with the
/// largest straight-line distance from the centroid of the component's vertices. The method is from
/// T. Gonzalez, "Clustering to minimize the maximum intercluster distance", 1985.
///
/// If SpreadPointsOptions::inside is false, the following holds for each component. Let d be the
/// largest distance from a vertex to the nearest point. Then the distance between any two points is
/// at least d, and d is at most twice the smallest value that the same number of points can reach.
///
/// - **Components** are found after vertices with equal positions are welded. First, each component
///   with at least a 100th of the largest component's area gets one point. Each further point is
///   placed in the component whose area divided by (its number of points + 1) is largest, so that
///   numbers of points are in proportion to areas. Distances are only measured within a component.
/// - **Inside**: a point moves from its vertex against the direction of the normal, or along the
///   normal if the inside is on that side. Its depth is its distance to the surface. The point
///   moves as long as the depth grows by at least 3/10 of the distance that the point moves. It
///   moves at most half of the way to the opposite side of the shape. A point at the tip of a limb
///   therefore remains in the tip, and a point at a corner moves to where the middle surfaces of
///   the faces intersect. The vertices within twice the depth of a chosen point are treated as near
///   this point, even on the opposite side. Therefore a plate does not get two points, one from
///   each side.
/// - **The first n points do not depend on `count`.** If several vertices have the same distance,
///   the vertex with the lowest id is chosen. Vertices with equal positions count as one vertex,
///   with the lowest id.
///
/// Return invalid_input if coordinates are not finite, ids are out of range, count < 1, or there
/// are fewer different vertices than count.
/// Cost: `count` shortest-path searches of at most O(#V log #V); later searches visit fewer
/// vertices. If `inside` is true, also at most 64 distances to the surface per point.
Status spread_points(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const SpreadPointsOptions& options, SpreadPoints& result);

} // namespace bindpose

#endif
