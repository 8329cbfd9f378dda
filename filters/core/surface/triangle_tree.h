#ifndef bindpose_surface_triangle_tree_h
#define bindpose_surface_triangle_tree_h

#include "base/execution.h"
#include "base/mesh.h"

#include <functional>
#include <utility>
#include <vector>

namespace bindpose
{

/// A binary tree of boxes over triangles, for distances and crossings. It stores only boxes: points
/// and triangles must outlive it. About 120 bytes per triangle, O(n log n) to build.
class TriangleTree
{
public:
  TriangleTree(PointsView points, TrianglesView triangles);

  /// Return the distance from p to the surface if it is at most `limit`, else infinity.
  /// Thread-safe.
  /// @param nearest  set to the nearest point on the surface if the distance is at most `limit`
  double distance(const Vec3& p, double limit, Vec3* nearest = nullptr) const;

  /// Report whether the segment from a to b meets a triangle for which counts() returns true.
  /// Thread-safe.
  bool segment_meets(const Vec3& a, const Vec3& b, const std::function<bool(Index)>& counts) const;

  /// Return the number of leaves. Each leaf contains a few triangles.
  Index leaf_count() const { return static_cast<Index>(this->leaves_.size()); }
  /// Call found(f, g) for pairs of triangles whose boxes meet, with f in this leaf and g after f in
  /// this or a later leaf. All leaves together give every pair once. After found returns false, no
  /// more pairs of f follow. Thread-safe.
  void pairs_of_leaf(Index leaf, const std::function<bool(Index, Index)>& found) const;

  /// Node for custom searches: the root is the first node, and children follow their parents.
  struct Node
  {
    Box box;
    Index begin = 0, end = 0; ///< range of triangles in order()
    Index right = -1; ///< second child; the first child is the next node; -1: a leaf
  };
  const std::vector<Node>& nodes() const { return this->nodes_; }
  const std::vector<Index>& order() const { return this->order_; } ///< triangle ids

private:
  struct Item
  {
    Vec3 center;
    Index triangle;
  };
  /// @return the box of the built nodes.
  Box build(std::vector<Item>& items, Index begin, Index end);
  template <typename Enter, typename AtLeaf>
  void visit(const Enter& enter, const AtLeaf& at_leaf) const;

  PointsView points_;
  TrianglesView triangles_;
  std::vector<Index> order_;
  std::vector<Box> boxes_; ///< boxes of the triangles of order_
  std::vector<Node> nodes_;
  std::vector<Index> leaves_; ///< indices of the leaf nodes
};

/// Find the pairs (f, g), f < g, of triangles that meet beyond their shared vertices and edges
/// (triangles_cross), sorted. A triangle gives at most 1000 pairs. This limits the list if the
/// surface contains a thousand copies of one solid. @return false when canceled.
bool crossing_pairs(PointsView points, TrianglesView triangles,
  std::vector<std::pair<Index, Index>>& pairs, ExecutionContext& context);

} // namespace bindpose

#endif
