#ifndef bindpose_surface_triangle_tree_h
#define bindpose_surface_triangle_tree_h

#include "base/execution.h"
#include "base/mesh.h"

#include <functional>
#include <utility>
#include <vector>

namespace bindpose
{

/// A binary tree of boxes over triangles, for distances and crossings. Keeps a copy of nothing but
/// boxes: points and triangles must outlive it. About 120 bytes a triangle, O(n log n) to build.
class TriangleTree
{
public:
  TriangleTree(PointsView points, TrianglesView triangles);

  /// Distance from p to the surface when it is at most `limit`, else infinity. Thread-safe.
  /// @param nearest  the place on the surface, when it is that near
  double distance(const Vec3& p, double limit, Vec3* nearest = nullptr) const;

  /// True when the segment from a to b meets a triangle that counts. Thread-safe.
  bool segment_meets(const Vec3& a, const Vec3& b, const std::function<bool(Index)>& counts) const;

  /// The triangles by leaf, a few in each.
  Index leaf_count() const { return static_cast<Index>(this->leaves_.size()); }
  /// Calls found(f, g) for pairs of triangles whose boxes meet, f in this leaf, g behind it in this
  /// or a later leaf: all leaves together give every pair once. No more pairs of f once found
  /// returns false. Thread-safe.
  void pairs_of_leaf(Index leaf, const std::function<bool(Index, Index)>& found) const;

  /// For searches of other kinds: the root is the first, children come after their parents.
  struct Node
  {
    Box box;
    Index begin = 0, end = 0; ///< triangles, in order()
    Index right = -1; ///< second child, the first is the next node; -1: a leaf
  };
  const std::vector<Node>& nodes() const { return this->nodes_; }
  const std::vector<Index>& order() const { return this->order_; } ///< triangle ids

private:
  struct Item
  {
    Vec3 center;
    Index triangle;
  };
  /// @return box of what it built.
  Box build(std::vector<Item>& items, Index begin, Index end);
  template <typename Enter, typename AtLeaf>
  void visit(const Enter& enter, const AtLeaf& at_leaf) const;

  PointsView points_;
  TrianglesView triangles_;
  std::vector<Index> order_;
  std::vector<Box> boxes_; ///< of order_'s triangles
  std::vector<Node> nodes_;
  std::vector<Index> leaves_; ///< nodes
};

/// Pairs (f, g), f < g, of triangles that meet in more than the vertices and edges they share
/// (triangles_cross), sorted. A triangle gives at most 1000 pairs, so that a thousand copies of one
/// solid do not make the list explode. @return false when cancelled.
bool crossing_pairs(PointsView points, TrianglesView triangles,
  std::vector<std::pair<Index, Index>>& pairs, ExecutionContext& context);

} // namespace bindpose

#endif
