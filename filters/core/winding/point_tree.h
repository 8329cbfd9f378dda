#ifndef bindpose_winding_point_tree_h
#define bindpose_winding_point_tree_h

#include "base/execution.h"
#include "base/mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace bindpose
{

/// Points sorted into a tree of boxes: each group of it has up to eight children, beside each other
/// so that eight can be looked at at once. The same tree for any number of threads.
class PointTree
{
public:
  using Id = std::int32_t;
  static constexpr Id width = 8;

  struct Child
  {
    Vec3 lower, upper; ///< box around its points
    Id first = 0, count = 0; ///< its points: order()[first … first + count), first divisible by 8
    Id group = -1; ///< what it is divided into; -1: a leaf
  };
  struct Group
  {
    std::array<Child, width> children;
    int size = 0;
  };
  struct Neighbor
  {
    double squared_distance;
    Id point;
  };

  /// #P x 3 finite points, fewer than 2^31, and how many a leaf may have (divisible by 8).
  /// Cost: O(#P log #P), about 0.2 us a point.
  /// @return false when cancelled.
  bool build(const Points& points, Id leaf_size, ExecutionContext& context);

  /// Ids of the points from left to right.
  const std::vector<Id>& order() const { return this->order_; }
  /// The first one is the root; none without points. Groups come after the group they divide.
  const std::vector<Group>& groups() const { return this->groups_; }

  /// The `count` points nearest to a point of the tree other than itself, or all there are; nearest
  /// first, of equally near ones the smallest id. Thread-safe.
  void nearest(const Points& points, Id point, Index count, std::vector<Neighbor>& neighbors) const;

private:
  struct Item
  {
    Vec3 at;
    Id id;
  };
  void divide(std::vector<Item>& items, Id group, Id first, Id count, ExecutionContext& context);
  void add_children(std::vector<Item>& items, Group& group, Id first, Id count, int halvings);

  Id leaf_size_ = 16;
  bool stopped_ = false;
  std::vector<Id> order_;
  std::vector<Group> groups_;
};

} // namespace bindpose

#endif
