// Construction of the tree and search for nearest neighbors.
//
// The points of a group are divided into two halves three times, each time along the longest axis
// of their box. Therefore each group has eight children of about the same size. The first half has
// a multiple of eight points, so that all leaves except the last one are whole blocks.
//
// The search for neighbors descends from the root. It visits the nearest box first and skips boxes
// that cannot contain a nearer point.
#include "winding/point_tree.h"

#include "geometry/median_split.h"

#include <algorithm>

namespace bindpose
{

namespace
{
constexpr PointTree::Id large = 1 << 15; // dividing this many points takes milliseconds

bool is_nearer(const PointTree::Neighbor& x, const PointTree::Neighbor& y)
{
  return x.squared_distance != y.squared_distance ? x.squared_distance < y.squared_distance
                                                  : x.point < y.point;
}
} // namespace

bool PointTree::build(ExecutionContext& context, const Points& points, Id leaf_size)
{
  this->order_.clear();
  this->groups_.clear();
  this->leaf_size_ = leaf_size;
  this->stopped_ = false;
  const auto count = static_cast<Id>(points.rows());
  if (count == 0)
  {
    return !context.canceled();
  }
  std::vector<Item> items;
  items.reserve(static_cast<std::size_t>(count));
  for (Id i = 0; i < count; ++i)
  {
    items.push_back({ points.row(i), i });
  }
  this->groups_.emplace_back();
  this->divide(context, items, 0, 0, count);
  for (const Item& item : items)
  {
    this->order_.push_back(item.id);
  }
  return !this->stopped_;
}

void PointTree::divide(
  ExecutionContext& context, std::vector<Item>& items, Id group, Id first, Id count)
{
  this->stopped_ = this->stopped_ || (count >= large && context.canceled());
  if (this->stopped_)
  {
    return;
  }
  Group divided;
  this->add_children(items, divided, first, count, 3);
  for (int c = 0; c < divided.size; ++c)
  {
    Child& child = divided.children[c];
    if (child.count > this->leaf_size_)
    {
      child.group = static_cast<Id>(this->groups_.size());
      this->groups_.emplace_back();
      this->divide(context, items, child.group, child.first, child.count);
    }
    if (child.count >= large)
    {
      context.progress(
        static_cast<double>(child.first + child.count) / static_cast<double>(items.size()));
    }
  }
  this->groups_[group] = divided;
}

void PointTree::add_children(
  std::vector<Item>& items, Group& group, Id first, Id count, int halvings)
{
  const auto begin = items.begin() + first;
  Vec3 lower = begin->position;
  Vec3 upper = lower;
  for (auto item = begin; item != begin + count; ++item)
  {
    lower = lower.cwiseMin(item->position);
    upper = upper.cwiseMax(item->position);
  }
  if (halvings == 0 || count <= this->leaf_size_)
  {
    group.children[group.size++] = { lower, upper, first, count, -1 };
    return;
  }
  int axis = 0;
  (upper - lower).maxCoeff(&axis);
  const Id half = (count / 2 + width - 1) / width * width;
  split_at(begin, begin + half, begin + count,
    [axis](const Item& item) { return std::pair(item.position[axis], item.id); });
  this->add_children(items, group, first, half, halvings - 1);
  this->add_children(items, group, first + half, count - half, halvings - 1);
}

void PointTree::nearest(
  const Points& points, Id point, Index count, std::vector<Neighbor>& neighbors) const
{
  neighbors.clear();
  const auto neighbor_count =
    static_cast<std::size_t>(std::min<Index>(count, static_cast<Index>(this->order_.size()) - 1));
  if (neighbor_count == 0)
  {
    return;
  }
  const Vec3 position = points.row(point);
  const auto visit_group = [&](const auto& visit_child, Id number) -> void
  {
    const Group& group = this->groups_[number];
    std::array<Neighbor, width> nearest_children{}; // children, sorted by distance
    for (int c = 0; c < group.size; ++c)
    {
      const Child& child = group.children[c];
      const Vec3 box_offset =
        (child.lower - position).cwiseMax(position - child.upper).cwiseMax(Vec3::Zero());
      const Neighbor box{ box_offset.squaredNorm(), c };
      int slot = c;
      for (; slot > 0 && is_nearer(box, nearest_children[slot - 1]); --slot)
      {
        nearest_children[slot] = nearest_children[slot - 1];
      }
      nearest_children[slot] = box;
    }
    for (int k = 0; k < group.size; ++k)
    {
      if (neighbors.size() == neighbor_count &&
        nearest_children[k].squared_distance > neighbors.back().squared_distance)
      {
        return;
      }
      const Child& child = group.children[nearest_children[k].point];
      if (child.group >= 0)
      {
        visit_child(visit_child, child.group);
        continue;
      }
      for (Id i = child.first; i < child.first + child.count; ++i)
      {
        const Id other = this->order_[i];
        const Neighbor neighbor{ (points.row(other).transpose() - position).squaredNorm(), other };
        if (other == point ||
          (neighbors.size() == neighbor_count && !is_nearer(neighbor, neighbors.back())))
        {
          continue;
        }
        if (neighbors.size() == neighbor_count)
        {
          neighbors.pop_back();
        }
        neighbors.insert(
          std::upper_bound(neighbors.begin(), neighbors.end(), neighbor, is_nearer), neighbor);
      }
    }
  };
  visit_group(visit_group, 0);
}

} // namespace bindpose
