#ifndef bindpose_winding_winding_tree_h
#define bindpose_winding_winding_tree_h

#include "base/execution.h"
#include "solid_angle/solid_angle.h"

#include <cstdint>

namespace bindpose
{

/// Hierarchy of boxes over triangles for exact winding numbers (Jacobson, Kavan, Sorkine-Hornung,
/// Robust Inside-Outside Segmentation using Generalized Winding Numbers, 2013).
///
/// Seen from outside a node's box, the node's triangles have the same winding number as any other
/// surface with the same boundary in that box. Therefore the node stores a fan over its boundary
/// edges, called its cap, which replaces the triangles in the sum. The result is exact up to
/// round-off. In a triangle soup every edge is a boundary edge. Then caps save no time, and the
/// tree works like a list.
class WindingTree
{
public:
  /// Build the tree. Points must be centered and scaled, equal points must be merged to one vertex,
  /// and ids must be below 2^31. Both matrices must outlive the tree. A node of at most
  /// max_leaf_size triangles is not split.
  /// @return false if canceled.
  bool build(ExecutionContext& context, const Points& points, const Triangles& triangles,
    double tolerance, Index max_leaf_size);

  /// Add the solid angle of all triangles, as seen from `point`, to `sum`. `sum` must have been
  /// created for the same point. Thread-safe.
  void add_to(SolidAngleSum& sum, const Vec3& point) const;

  /// Return the memory in use, in bytes.
  Index memory() const;

private:
  using Id = std::int32_t;
  /// An edge with a < b. `net` is the number of uses as a -> b minus the number of uses as b -> a,
  /// and is not 0.
  struct NetEdge
  {
    Id a, b, net;
  };
  struct CapTriangle
  {
    Id a, b, c, multiplicity;
  };
  struct Node
  {
    double lower[3], upper[3];
    Id first = 0, count = 0; ///< range of the node's triangles in `order_`
    Id left = -1, right = -1; ///< children; -1: a leaf
    Id cap_first = 0;
    /// Number of triangles of the cap; -1: no cap, because the cap would have at least as many
    /// triangles as the node.
    Id cap_count = -1;
  };

  bool build_node(ExecutionContext& context, Id node, std::vector<NetEdge>& boundary);
  std::vector<NetEdge> boundary_of_triangles(Id first, Id count) const;
  void add_triangles(SolidAngleSum& sum, const Node& node) const;

  const Points* points_ = nullptr;
  const Triangles* triangles_ = nullptr;
  double margin_ = 0.0;
  Id max_leaf_size_ = 0;
  std::vector<Vec3> centers_; // sum of the three corners per triangle; used while building only
  std::vector<Id> order_;
  std::vector<Node> nodes_;
  std::vector<CapTriangle> caps_;
};

} // namespace bindpose

#endif
