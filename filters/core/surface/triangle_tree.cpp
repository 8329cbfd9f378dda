// Construction and traversal of the tree (see triangle_tree.h). The tree is built from the root.
// Each node is split at the median along the longest side of the bounding box of its triangles'
// centers. Equal centers are ordered by triangle id, so that the tree and all results are the same
// on every machine.
#include "surface/triangle_tree.h"

#include "base/parallel.h"
#include "geometry/median_split.h"
#include "surface/triangle_predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace bindpose
{

namespace
{
constexpr Index leaf_size = 4;
constexpr Index maximum_crossings = 1000;

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
  const auto count = static_cast<std::size_t>(triangles.rows());
  std::vector<Item> items(count);
  this->boxes_.resize(count);
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->boxes_[t].add(points.row(triangles(t, k)));
    }
    items[t] = { this->boxes_[t].center(), t };
  }
  this->nodes_.reserve(count);
  if (triangles.rows() > 0)
  {
    this->build(items, 0, triangles.rows());
  }
  std::vector<Box> boxes(count);
  this->order_.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    this->order_[i] = items[i].triangle;
    boxes[i] = this->boxes_[items[i].triangle];
  }
  this->boxes_ = std::move(boxes);
}

Box TriangleTree::build(std::vector<Item>& items, Index begin, Index end)
{
  const std::size_t node_id = this->nodes_.size();
  this->nodes_.push_back({ Box(), begin, end, -1 });
  Box box;
  if (end - begin <= leaf_size)
  {
    for (Index i = begin; i < end; ++i)
    {
      const Box& triangle_box = this->boxes_[items[i].triangle];
      box.add(triangle_box.lower);
      box.add(triangle_box.upper);
    }
    this->leaves_.push_back(static_cast<Index>(node_id));
  }
  else
  {
    Box centers;
    for (Index i = begin; i < end; ++i)
    {
      centers.add(items[i].center);
    }
    Index axis = 0;
    centers.size().maxCoeff(&axis);
    const Index middle = begin + (end - begin) / 2;
    split_at(items.begin() + begin, items.begin() + middle, items.begin() + end,
      [axis](const Item& item) { return std::pair(item.center[axis], item.triangle); });
    box = this->build(items, begin, middle);
    this->nodes_[node_id].right = static_cast<Index>(this->nodes_.size());
    const Box right = this->build(items, middle, end);
    box.add(right.lower);
    box.add(right.upper);
  }
  this->nodes_[node_id].box = box;
  return box;
}

/// Call at_triangle(closest point, squared distance) for the triangles of all leaves whose boxes
/// are within squared_limit, nearer boxes first. squared_limit is a reference, because
/// at_triangle() may lower the variable. The search ends when at_triangle() returns false.
template <typename AtTriangle>
void TriangleTree::search(
  const Vec3& p, const double& squared_limit, const AtTriangle& at_triangle) const
{
  // Each child contains half of the triangles of its parent, so the depth of the tree is below 128.
  std::array<std::pair<Index, double>, 128> stack; // nodes and their squared distances
  std::size_t top = 0;
  if (!this->nodes_.empty())
  {
    stack[top++] = { 0, squared_distance(this->nodes_[0].box, p) };
  }
  while (top > 0)
  {
    const auto [at, squared] = stack[--top];
    if (squared > squared_limit)
    {
      continue;
    }
    const Node& node = this->nodes_[at];
    if (node.right < 0)
    {
      for (Index i = node.begin; i < node.end; ++i)
      {
        const auto t = this->triangles_.row(this->order_[i]);
        const Vec3 closest = closest_point(
          p, this->points_.row(t[0]), this->points_.row(t[1]), this->points_.row(t[2]));
        if (!at_triangle(closest, (closest - p).squaredNorm()))
        {
          return;
        }
      }
      continue;
    }
    // Push the nearer child last, so that it is visited first.
    std::pair<Index, double> nearer{ at + 1, squared_distance(this->nodes_[at + 1].box, p) };
    std::pair<Index, double> farther{ node.right,
      squared_distance(this->nodes_[node.right].box, p) };
    if (farther.second < nearer.second)
    {
      std::swap(nearer, farther);
    }
    stack[top++] = farther;
    stack[top++] = nearer;
  }
}

double TriangleTree::distance(const Vec3& p, double limit, Vec3* nearest) const
{
  double best = limit * limit;
  bool found = false;
  this->search(p, best,
    [&](const Vec3& closest, double squared)
    {
      if (squared <= best)
      {
        best = squared;
        found = true;
        if (nearest)
        {
          *nearest = closest;
        }
      }
      return true;
    });
  return found ? std::sqrt(best) : std::numeric_limits<double>::infinity();
}

bool TriangleTree::is_within(const Vec3& p, double limit) const
{
  const double squared_limit = limit * limit;
  bool found = false;
  this->search(p, squared_limit,
    [&](const Vec3&, double squared)
    {
      found = squared <= squared_limit;
      return !found;
    });
  return found;
}

/// Visit the tree from the root. Subtrees for which `enter` returns false are skipped. The visit
/// ends when `at_leaf` returns false.
template <typename Enter, typename AtLeaf>
void TriangleTree::visit(const Enter& enter, const AtLeaf& at_leaf) const
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
    if (!enter(node))
    {
      continue;
    }
    if (node.right >= 0)
    {
      stack.push_back(node.right);
      stack.push_back(at + 1);
    }
    else if (!at_leaf(node))
    {
      return;
    }
  }
}

bool TriangleTree::segment_meets(
  const Vec3& a, const Vec3& b, const std::function<bool(Index)>& accept) const
{
  Box box;
  box.add(a);
  box.add(b);
  const Vec3 segment_vector = b - a;
  // Slab test: for each axis, find the interval of the segment between the two planes of a box.
  const auto passes = [&](const Box& node)
  {
    if (!boxes_meet(node, box))
    {
      return false;
    }
    double first = 0.0;
    double last = 1.0;
    for (int k = 0; k < 3; ++k)
    {
      if (segment_vector[k] != 0.0)
      {
        const double t = (node.lower[k] - a[k]) / segment_vector[k];
        const double u = (node.upper[k] - a[k]) / segment_vector[k];
        constexpr double rounding = 1e-12;
        first = std::max(first, std::min(t, u) - rounding);
        last = std::min(last, std::max(t, u) + rounding);
      }
    }
    return first <= last;
  };
  bool is_crossed = false;
  this->visit([&](const Node& node) { return passes(node.box); },
    [&](const Node& node)
    {
      for (Index i = node.begin; i < node.end && !is_crossed; ++i)
      {
        const auto t = this->triangles_.row(this->order_[i]);
        is_crossed = passes(this->boxes_[i]) && accept(this->order_[i]) &&
          segment_meets_triangle(
            a, b, this->points_.row(t[0]), this->points_.row(t[1]), this->points_.row(t[2]));
      }
      return !is_crossed;
    });
  return is_crossed;
}

void TriangleTree::pairs_of_leaf(Index leaf, const std::function<bool(Index, Index)>& found) const
{
  const Node& query_node = this->nodes_[this->leaves_[leaf]];
  std::array<bool, leaf_size> finished{};
  // Number of triangles in the leaf that are not finished. A triangle is finished if found() has
  // returned false for one of its pairs.
  Index left = query_node.end - query_node.begin;
  this->visit([&](const Node& node)
    { return node.end > query_node.begin && boxes_meet(node.box, query_node.box); },
    [&](const Node& node)
    {
      for (Index i = query_node.begin; i < query_node.end; ++i)
      {
        bool& done = finished[i - query_node.begin];
        for (Index j = std::max(i + 1, node.begin); j < node.end && !done; ++j)
        {
          if (boxes_meet(this->boxes_[i], this->boxes_[j]) &&
            !found(this->order_[i], this->order_[j]))
          {
            done = true;
            --left;
          }
        }
      }
      return left > 0;
    });
}

bool crossing_pairs(ExecutionContext& context, PointsView points, TrianglesView triangles,
  std::vector<std::pair<Index, Index>>& pairs)
{
  const TriangleTree tree(points, triangles);
  const Index block = 64;
  const Index blocks = (tree.leaf_count() + block - 1) / block;
  std::vector<std::vector<std::pair<Index, Index>>> pairs_of_block(
    static_cast<std::size_t>(blocks));
  const bool completed = parallel_for(context, tree.leaf_count(), block,
    [&](Index begin, Index end)
    {
      auto& block_pairs = pairs_of_block[static_cast<std::size_t>(begin / block)];
      for (Index leaf = begin; leaf < end; ++leaf)
      {
        std::map<Index, Index> crossed; // number of listed pairs per triangle
        Index tested_pairs = 0;
        tree.pairs_of_leaf(leaf,
          [&](Index f, Index g)
          {
            constexpr Index check_interval = 1024;
            const bool should_continue =
              ++tested_pairs % check_interval != 0 || !context.canceled();
            if (!triangles_cross(points, triangles, f, g))
            {
              return should_continue;
            }
            block_pairs.push_back(std::minmax(f, g));
            return should_continue && ++crossed[f] < maximum_crossings;
          });
      }
    });
  pairs.clear();
  for (const auto& list : pairs_of_block)
  {
    pairs.insert(pairs.end(), list.begin(), list.end());
  }
  std::sort(pairs.begin(), pairs.end());
  return completed && !context.canceled();
}

} // namespace bindpose
