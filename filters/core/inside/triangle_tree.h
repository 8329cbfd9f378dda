#ifndef bindpose_inside_triangle_tree_h
#define bindpose_inside_triangle_tree_h

#include "base/execution.h"
#include "base/mesh.h"

#include <functional>
#include <utility>
#include <vector>

namespace bindpose
{

/// A binary tree of boxes over triangles, for distances and crossings. Keeps a copy of nothing but
/// boxes: points and triangles must outlive it. About 60 bytes a triangle, O(n log n) to build.
class TriangleTree
{
public:
  TriangleTree(PointsView points, TrianglesView triangles);

  /// Distance from p to the surface when it is at most `limit`, else infinity. Thread-safe.
  double distance(const Vec3& p, double limit) const;

  /// Calls found(g) for every triangle whose box meets the box, in no particular order.
  /// Thread-safe. The call ends early when found returns false.
  void boxes_meeting(const Box& box, const std::function<bool(Index)>& found) const;

private:
  struct Node
  {
    Box box;
    Index begin = 0, end = 0; ///< triangles, in order_
    Index right = -1; ///< second child, the first is the next node; -1: a leaf
  };
  void build(Index begin, Index end);
  Box box_of(Index triangle) const;

  PointsView points_;
  TrianglesView triangles_;
  std::vector<Index> order_;
  std::vector<Vec3> centers_; // while building only
  std::vector<Node> nodes_;
};

/// Pairs (f, g), f < g, of triangles that meet in more than the vertices and edges they share
/// (triangles_cross), sorted. A triangle gives at most 1000 pairs, so that a thousand copies of one
/// solid do not make the list explode. @return false when cancelled.
bool crossing_pairs(PointsView points, TrianglesView triangles,
  std::vector<std::pair<Index, Index>>& pairs, ExecutionContext& context);

} // namespace bindpose

#endif
