// Evaluation of the sizing field by a tree of boxes over the sites. Each box stores the smallest
// length of its sites. A box is skipped if this length plus growth * (distance to the box) is at
// least the best value so far.
#include "inside/sizing_field.h"

#include "geometry/median_split.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace bindpose
{

namespace
{
constexpr Index leaf_size = 8;
}

SizingField::SizingField(
  const Points& sites, const Eigen::VectorXd& lengths, double growth, double largest)
  : growth_(growth), largest_(largest)
{
  this->order_.resize(static_cast<std::size_t>(sites.rows()));
  std::iota(this->order_.begin(), this->order_.end(), Index(0));
  this->sites_ = sites;
  this->lengths_ = lengths;
  if (sites.rows() > 0)
  {
    this->build(0, sites.rows());
  }
  // Store the sites in the order of the tree, so that neighbors are adjacent in memory.
  for (Index i = 0; i < sites.rows(); ++i)
  {
    this->sites_.row(i) = sites.row(this->order_[i]);
    this->lengths_[i] = lengths[this->order_[i]];
  }
}

void SizingField::build(Index begin, Index end)
{
  const std::size_t node_id = this->nodes_.size();
  this->nodes_.emplace_back();
  Node node;
  node.begin = begin;
  node.end = end;
  node.smallest = this->largest_;
  for (Index i = begin; i < end; ++i)
  {
    node.box.add(this->sites_.row(this->order_[i]));
    node.smallest = std::min(node.smallest, this->lengths_[this->order_[i]]);
  }
  this->nodes_[node_id] = node;
  if (end - begin <= leaf_size)
  {
    return;
  }
  Index axis = 0;
  node.box.size().maxCoeff(&axis);
  const Index middle = begin + (end - begin) / 2;
  const auto first = this->order_.begin();
  split_at(first + begin, first + middle, first + end,
    [&](Index site) { return std::pair(this->sites_(site, axis), site); });
  this->build(begin, middle);
  this->nodes_[node_id].right = static_cast<Index>(this->nodes_.size());
  this->build(middle, end);
}

double SizingField::bound(const Node& node, const Vec3& p) const
{
  const Vec3 box_offset = (node.box.lower - p).cwiseMax(p - node.box.upper).cwiseMax(0.0);
  return this->scale_ * node.smallest + this->growth_ * box_offset.norm();
}

double SizingField::at(const Vec3& p) const
{
  double best = this->largest_;
  // Nodes are split at the median, so the depth of the tree is logarithmic in the number of sites.
  // Therefore 128 entries are always sufficient.
  std::array<std::pair<Index, double>, 128> stack;
  std::size_t top = 0;
  if (!this->nodes_.empty())
  {
    stack[top++] = { 0, this->bound(this->nodes_[0], p) };
  }
  while (top > 0)
  {
    const auto [at, least] = stack[--top];
    if (least >= best)
    {
      continue;
    }
    const Node& node = this->nodes_[at];
    if (node.right < 0)
    {
      for (Index i = node.begin; i < node.end; ++i)
      {
        best = std::min(best,
          this->scale_ * this->lengths_[i] +
            this->growth_ * (this->sites_.row(i).transpose() - p).norm());
      }
      continue;
    }
    const double left = this->bound(this->nodes_[at + 1], p);
    const double right = this->bound(this->nodes_[node.right], p);
    // Push the child with the smaller value last, so that it is visited first.
    stack[top++] = left <= right ? std::make_pair(node.right, right) : std::make_pair(at + 1, left);
    stack[top++] = left <= right ? std::make_pair(at + 1, left) : std::make_pair(node.right, right);
  }
  return best;
}

} // namespace bindpose
