// Construction and evaluation of WindingTree (Jacobson et al. 2013).
//
// Nodes are split at the median of the triangles' centers along the longest axis. Boundaries are
// computed from the leaves upwards: edges that the two children use in opposite directions cancel.
// The cap of a boundary is the fan from one of its vertices to all its edges. Equal numbers of
// boundary edges enter and leave each vertex, so the node's triangles and the reversed fan together
// form a closed surface. Outside the node's box, the winding number of this closed surface is zero.
#include "winding/winding_tree.h"

#include "geometry/median_split.h"

#include <algorithm>
#include <numeric>

namespace bindpose
{

namespace
{
/// Merge the entries of the same edge and remove entries whose `net` is 0. The entries must be
/// sorted by (a, b).
template <typename NetEdges>
void merge_edges(NetEdges& edges)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < edges.size();)
  {
    auto edge = edges[i++];
    while (i < edges.size() && edges[i].a == edge.a && edges[i].b == edge.b)
    {
      edge.net += edges[i++].net;
    }
    if (edge.net != 0)
    {
      edges[kept++] = edge;
    }
  }
  edges.resize(kept);
}

constexpr auto compare_edges = [](const auto& x, const auto& y)
{ return x.a != y.a ? x.a < y.a : x.b < y.b; };
} // namespace

bool WindingTree::build(ExecutionContext& context, const Points& points, const Triangles& triangles,
  double tolerance, Index max_leaf_size)
{
  this->points_ = &points;
  this->triangles_ = &triangles;
  this->margin_ = 4.0 * tolerance;
  this->max_leaf_size_ = static_cast<Id>(std::max<Index>(1, max_leaf_size));
  this->nodes_.clear();
  this->caps_.clear();
  const Index count = triangles.rows();
  this->order_.resize(static_cast<std::size_t>(count));
  std::iota(this->order_.begin(), this->order_.end(), 0);
  this->centers_.resize(static_cast<std::size_t>(count));
  for (Index t = 0; t < count; ++t)
  {
    this->centers_[t] =
      (points.row(triangles(t, 0)) + points.row(triangles(t, 1)) + points.row(triangles(t, 2)));
  }
  bool done = !context.canceled();
  if (count > 0 && done)
  {
    this->nodes_.emplace_back();
    this->nodes_.back().count = static_cast<Id>(count);
    std::vector<NetEdge> boundary;
    done = this->build_node(context, 0, boundary);
  }
  this->centers_ = {};
  this->nodes_.shrink_to_fit();
  this->caps_.shrink_to_fit();
  return done;
}

bool WindingTree::build_node(ExecutionContext& context, Id id, std::vector<NetEdge>& boundary)
{
  const Id first = this->nodes_[id].first;
  const Id count = this->nodes_[id].count;
  if (count > 1024)
  {
    if (context.canceled())
    {
      return false;
    }
    context.progress(static_cast<double>(first) / static_cast<double>(this->order_.size()));
  }
  Box box;
  Box center_box;
  for (Id i = first; i < first + count; ++i)
  {
    const Index t = this->order_[i];
    for (int k = 0; k < 3; ++k)
    {
      box.add(this->points_->row((*this->triangles_)(t, k)));
    }
    center_box.add(this->centers_[t]);
  }
  std::copy_n(box.lower.data(), 3, this->nodes_[id].lower);
  std::copy_n(box.upper.data(), 3, this->nodes_[id].upper);

  int axis = 0;
  const double longest = center_box.size().maxCoeff(&axis);
  if (count <= this->max_leaf_size_ || longest <= 0.0)
  {
    boundary = this->boundary_of_triangles(first, count);
  }
  else
  {
    const auto begin = this->order_.begin() + first;
    split_at(begin, begin + count / 2, begin + count,
      [&](Id t) { return std::pair(this->centers_[t][axis], t); });
    const Id left = static_cast<Id>(this->nodes_.size());
    this->nodes_.resize(this->nodes_.size() + 2);
    this->nodes_[id].left = left;
    this->nodes_[id].right = left + 1;
    this->nodes_[left].first = first;
    this->nodes_[left].count = count / 2;
    this->nodes_[left + 1].first = first + count / 2;
    this->nodes_[left + 1].count = count - count / 2;
    std::vector<NetEdge> right_boundary;
    if (!this->build_node(context, left, boundary) ||
      !this->build_node(context, left + 1, right_boundary))
    {
      return false;
    }
    const auto middle = static_cast<std::ptrdiff_t>(boundary.size());
    boundary.insert(boundary.end(), right_boundary.begin(), right_boundary.end());
    std::inplace_merge(boundary.begin(), boundary.begin() + middle, boundary.end(), compare_edges);
    merge_edges(boundary);
  }

  // Boundary edges at the apex of the fan need no triangle. Therefore the apex is a vertex with
  // many boundary edges: the one that is the end `a` of the largest number of edges.
  Id apex = -1;
  std::size_t most = 0;
  for (std::size_t i = 0; i < boundary.size();)
  {
    std::size_t end = i;
    while (end < boundary.size() && boundary[end].a == boundary[i].a)
    {
      ++end;
    }
    if (end - i > most)
    {
      most = end - i;
      apex = boundary[i].a;
    }
    i = end;
  }
  const auto spanned = [&](const NetEdge& edge) { return edge.a != apex && edge.b != apex; };
  const auto size = std::count_if(boundary.begin(), boundary.end(), spanned);
  if (size < count)
  {
    this->nodes_[id].cap_first = static_cast<Id>(this->caps_.size());
    this->nodes_[id].cap_count = static_cast<Id>(size);
    for (const NetEdge& edge : boundary)
    {
      if (spanned(edge))
      {
        this->caps_.push_back({ apex, edge.a, edge.b, edge.net });
      }
    }
  }
  return true;
}

std::vector<WindingTree::NetEdge> WindingTree::boundary_of_triangles(Id first, Id count) const
{
  std::vector<NetEdge> edges;
  edges.reserve(3 * static_cast<std::size_t>(count));
  for (Id i = first; i < first + count; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Id from = static_cast<Id>((*this->triangles_)(this->order_[i], k));
      const Id to = static_cast<Id>((*this->triangles_)(this->order_[i], (k + 1) % 3));
      edges.push_back({ std::min(from, to), std::max(from, to), from < to ? 1 : -1 });
    }
  }
  std::sort(edges.begin(), edges.end(), compare_edges);
  merge_edges(edges);
  return edges;
}

void WindingTree::add_triangles(SolidAngleSum& sum, const Node& node) const
{
  for (Id i = node.first; i < node.first + node.count; ++i)
  {
    const Index t = this->order_[i];
    sum.add(this->points_->row((*this->triangles_)(t, 0)),
      this->points_->row((*this->triangles_)(t, 1)), this->points_->row((*this->triangles_)(t, 2)));
  }
}

void WindingTree::add_to(SolidAngleSum& sum, const Vec3& point) const
{
  if (this->nodes_.empty())
  {
    return;
  }
  // Halving 2^31 triangles takes 31 levels, and each level leaves one node on the stack.
  Id stack[64] = { 0 };
  int height = 1;
  while (height > 0)
  {
    const Node& node = this->nodes_[stack[--height]];
    const bool outside = point.x() < node.lower[0] - this->margin_ ||
      point.x() > node.upper[0] + this->margin_ || point.y() < node.lower[1] - this->margin_ ||
      point.y() > node.upper[1] + this->margin_ || point.z() < node.lower[2] - this->margin_ ||
      point.z() > node.upper[2] + this->margin_;
    if (outside && node.cap_count >= 0)
    {
      for (Id i = node.cap_first; i < node.cap_first + node.cap_count; ++i)
      {
        const CapTriangle& cap = this->caps_[i];
        sum.add(this->points_->row(cap.a), this->points_->row(cap.b), this->points_->row(cap.c),
          cap.multiplicity);
      }
    }
    else if (node.left < 0)
    {
      this->add_triangles(sum, node);
    }
    else
    {
      stack[height++] = node.right;
      stack[height++] = node.left;
    }
  }
}

Index WindingTree::memory() const
{
  return static_cast<Index>(this->order_.capacity() * sizeof(Id) +
    this->nodes_.capacity() * sizeof(Node) + this->caps_.capacity() * sizeof(CapTriangle));
}

} // namespace bindpose
