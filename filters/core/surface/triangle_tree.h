#ifndef bindpose_surface_triangle_tree_h
#define bindpose_surface_triangle_tree_h

#include "base/execution.h"
#include "geometry/mesh.h"

#include <functional>
#include <utility>
#include <vector>

namespace bindpose
{

/// A binary tree of boxes over triangles, for distances and intersections. It stores only boxes:
/// points and triangles must outlive it. Memory: about 120 bytes per triangle. Cost: O(n log n) to
/// build.
class TriangleTree
{
public:
  TriangleTree(PointsView points, TrianglesView triangles);

  /// Return the distance from p to the surface if it is at most `limit`, else infinity.
  /// Thread-safe.
  /// @param nearest  if not null, set to the nearest point on the surface; unchanged if the
  /// distance is above `limit`
  double distance(const Vec3& p, double limit, Vec3* nearest = nullptr) const;
  /// Report whether the distance from p to the surface is at most `limit`. This is faster than
  /// distance(), because the search ends at the first triangle within the limit. Thread-safe.
  bool is_within(const Vec3& p, double limit) const;

  /// Report whether the segment from a to b intersects a triangle for which accept() returns true.
  /// Thread-safe.
  bool segment_meets(const Vec3& a, const Vec3& b, const std::function<bool(Index)>& accept) const;

  /// Return the number of leaves. Each leaf contains a few triangles.
  Index leaf_count() const { return static_cast<Index>(this->leaves_.size()); }
  /// Call found(f, g) for pairs of triangles whose boxes overlap. Triangle f is in this leaf; g
  /// comes after f in this leaf or is in a later leaf. If this function is called once for each
  /// leaf, every pair of the tree is visited once. If found() returns false, the remaining pairs of
  /// f are skipped. Thread-safe.
  void pairs_of_leaf(Index leaf, const std::function<bool(Index, Index)>& found) const;

  /// A node, for searches by the caller. The root is the first node, and children follow their
  /// parents.
  struct Node
  {
    Box box;
    Index begin = 0, end = 0; ///< range of triangles in order()
    Index right = -1; ///< index of the second child (the first child is the next node); -1: a leaf
  };
  const std::vector<Node>& nodes() const { return this->nodes_; }
  /// Return the triangle ids, sorted by leaf.
  const std::vector<Index>& order() const { return this->order_; }

private:
  template <typename AtTriangle>
  void search(const Vec3& p, const double& squared_limit, const AtTriangle& at_triangle) const;

  struct Item
  {
    Vec3 center;
    Index triangle;
  };
  /// Build the nodes for a range of items.
  /// @return the box of these items.
  Box build(std::vector<Item>& items, Index begin, Index end);
  template <typename Enter, typename AtLeaf>
  void visit(const Enter& enter, const AtLeaf& at_leaf) const;

  PointsView points_;
  TrianglesView triangles_;
  std::vector<Index> order_;
  std::vector<Box> boxes_; ///< one box per triangle, in the order of the ids in order_
  std::vector<Node> nodes_;
  std::vector<Index> leaves_; ///< indices of the leaf nodes
};

/// Find the pairs (f, g), f < g, of triangles for which triangles_cross() is true, and sort the
/// pairs. At most 1000 pairs are listed per triangle, so that the list remains short enough if the
/// surface contains a thousand copies of one solid.
/// @return false if canceled.
bool crossing_pairs(ExecutionContext& context, PointsView points, TrianglesView triangles,
  std::vector<std::pair<Index, Index>>& pairs);

} // namespace bindpose

#endif
