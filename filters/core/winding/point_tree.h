#ifndef bindpose_winding_point_tree_h
#define bindpose_winding_point_tree_h

#include "base/execution.h"
#include "geometry/mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace bindpose
{

/// Points sorted into a tree of boxes. Each group has up to eight children, stored contiguously so
/// that all eight can be tested in parallel. The tree is the same for any number of threads.
class PointTree
{
public:
  using Id = std::int32_t;
  static constexpr Id width = 8;

  struct Child
  {
    Vec3 lower, upper; ///< box around the points of the child
    Id first = 0,
       /// Points of the child: order()[first … first + count); `first` is divisible by 8.
      count = 0;
    Id group = -1; ///< group that contains the children of this child; -1: a leaf
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

  /// Build the tree from #P x 3 finite points, fewer than 2^31. `leaf_size` is the largest number
  /// of points in a leaf and must be divisible by 8. Cost: O(#P log #P), about 0.2 us per point.
  /// @return false if canceled.
  bool build(ExecutionContext& context, const Points& points, Id leaf_size);

  /// Return the ids of the points in the order of the leaves.
  const std::vector<Id>& order() const { return this->order_; }
  /// Return the groups. The first group is the root; the list is empty if there are no points. A
  /// group is stored after its parent.
  const std::vector<Group>& groups() const { return this->groups_; }

  /// Find the `count` nearest neighbors of a point of the tree, or all other points if there are
  /// fewer. The point itself is excluded. The result is sorted by distance, then by id.
  /// Thread-safe.
  void nearest(const Points& points, Id point, Index count, std::vector<Neighbor>& neighbors) const;

private:
  struct Item
  {
    Vec3 position;
    Id id;
  };
  void divide(ExecutionContext& context, std::vector<Item>& items, Id group, Id first, Id count);
  void add_children(std::vector<Item>& items, Group& group, Id first, Id count, int halvings);

  Id leaf_size_ = 16;
  bool stopped_ = false;
  std::vector<Id> order_;
  std::vector<Group> groups_;
};

} // namespace bindpose

#endif
