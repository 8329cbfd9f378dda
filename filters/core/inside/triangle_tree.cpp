// Top-down tree, split at the median of the longest side; ties by triangle id, so that the tree and
// everything that comes from it are the same on every machine.
#include "inside/triangle_tree.h"

#include "base/parallel.h"
#include "inside/triangle_predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace bindpose
{

namespace
{
constexpr Index leaf_size = 4;
constexpr Index most_crossings = 1000;

bool boxes_meet(const Box& a, const Box& b)
{
  return (a.lower.array() <= b.upper.array()).all() && (b.lower.array() <= a.upper.array()).all();
}

double squared_distance(const Box& box, const Vec3& p)
{
  return (box.lower - p).cwiseMax(p - box.upper).cwiseMax(0.0).squaredNorm();
}
} // namespace

TriangleTree::TriangleTree(PointsView points, TrianglesView triangles)
  : points_(points), triangles_(triangles)
{
  this->order_.resize(static_cast<std::size_t>(triangles.rows()));
  std::iota(this->order_.begin(), this->order_.end(), Index(0));
  this->centers_.resize(this->order_.size());
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    this->centers_[t] = this->box_of(t).center();
  }
  this->nodes_.reserve(this->order_.size());
  if (triangles.rows() > 0)
  {
    this->build(0, triangles.rows());
  }
  std::vector<Vec3>().swap(this->centers_);
}

Box TriangleTree::box_of(Index triangle) const
{
  Box box;
  for (int k = 0; k < 3; ++k)
  {
    box.add(this->points_.row(this->triangles_(triangle, k)));
  }
  return box;
}

void TriangleTree::build(Index begin, Index end)
{
  const std::size_t self = this->nodes_.size();
  this->nodes_.emplace_back();
  Box box, centers;
  for (Index i = begin; i < end; ++i)
  {
    const Box one = this->box_of(this->order_[i]);
    box.add(one.lower);
    box.add(one.upper);
    centers.add(this->centers_[this->order_[i]]);
  }
  this->nodes_[self].box = box;
  this->nodes_[self].begin = begin;
  this->nodes_[self].end = end;
  if (end - begin <= leaf_size)
  {
    return;
  }
  Index axis = 0;
  centers.size().maxCoeff(&axis);
  const Index middle = begin + (end - begin) / 2;
  std::nth_element(this->order_.begin() + begin, this->order_.begin() + middle,
    this->order_.begin() + end,
    [&](Index a, Index b)
    {
      const double x = this->centers_[a][axis];
      const double y = this->centers_[b][axis];
      return x != y ? x < y : a < b;
    });
  this->build(begin, middle);
  this->nodes_[self].right = static_cast<Index>(this->nodes_.size());
  this->build(middle, end);
}

double TriangleTree::distance(const Vec3& p, double limit) const
{
  double best = limit * limit;
  bool found = false;
  std::vector<Index> stack;
  if (!this->nodes_.empty())
  {
    stack.push_back(0);
  }
  while (!stack.empty())
  {
    const Index at = stack.back();
    stack.pop_back();
    const Node& node = this->nodes_[at];
    if (squared_distance(node.box, p) > best)
    {
      continue;
    }
    if (node.right < 0)
    {
      for (Index i = node.begin; i < node.end; ++i)
      {
        const auto t = this->triangles_.row(this->order_[i]);
        const double d = (closest_point(p, this->points_.row(t[0]), this->points_.row(t[1]),
                            this->points_.row(t[2])) -
          p)
                           .squaredNorm();
        if (d <= best)
        {
          best = d;
          found = true;
        }
      }
      continue;
    }
    // The nearer child last: it is looked at first.
    const Index left = at + 1;
    const bool left_nearer = squared_distance(this->nodes_[left].box, p) <=
      squared_distance(this->nodes_[node.right].box, p);
    stack.push_back(left_nearer ? node.right : left);
    stack.push_back(left_nearer ? left : node.right);
  }
  return found ? std::sqrt(best) : std::numeric_limits<double>::infinity();
}

void TriangleTree::boxes_meeting(const Box& box, const std::function<bool(Index)>& found) const
{
  std::vector<Index> stack;
  if (!this->nodes_.empty())
  {
    stack.push_back(0);
  }
  while (!stack.empty())
  {
    const Index at = stack.back();
    stack.pop_back();
    const Node& node = this->nodes_[at];
    if (!boxes_meet(node.box, box))
    {
      continue;
    }
    if (node.right >= 0)
    {
      stack.push_back(at + 1);
      stack.push_back(node.right);
      continue;
    }
    for (Index i = node.begin; i < node.end; ++i)
    {
      const Index t = this->order_[i];
      if (boxes_meet(this->box_of(t), box) && !found(t))
      {
        return;
      }
    }
  }
}

bool crossing_pairs(PointsView points, TrianglesView triangles,
  std::vector<std::pair<Index, Index>>& pairs, ExecutionContext& context)
{
  const TriangleTree tree(points, triangles);
  const Index block = 256;
  const Index blocks = (triangles.rows() + block - 1) / block;
  std::vector<std::vector<std::pair<Index, Index>>> of_block(static_cast<std::size_t>(blocks));
  const bool whole = parallel_for(context, triangles.rows(), block,
    [&](Index begin, Index end)
    {
      auto& mine = of_block[static_cast<std::size_t>(begin / block)];
      for (Index f = begin; f < end; ++f)
      {
        Box box;
        for (int k = 0; k < 3; ++k)
        {
          box.add(points.row(triangles(f, k)));
        }
        Index looked = 0;
        Index crossed = 0;
        tree.boxes_meeting(box,
          [&](Index g)
          {
            if (g > f && triangles_cross(points, triangles, f, g))
            {
              mine.emplace_back(f, g);
              ++crossed;
            }
            constexpr Index often = 1024;
            return crossed < most_crossings && (++looked % often != 0 || !context.cancelled());
          });
      }
    });
  pairs.clear();
  for (const auto& list : of_block)
  {
    pairs.insert(pairs.end(), list.begin(), list.end());
  }
  std::sort(pairs.begin(), pairs.end());
  return whole && !context.cancelled();
}

} // namespace bindpose
