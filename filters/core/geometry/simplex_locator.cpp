// Nearest element by a binary tree of axis-aligned boxes. Nodes are split at the median of the
// elements' centers along the longest side. The search visits the nearest box first.
#include "geometry/simplex_locator.h"

#include "geometry/median_split.h"

#include <algorithm>
#include <numeric>

namespace bindpose
{

namespace
{
constexpr Index leaf_size = 8;

SimplexLocation nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const Vec3 ab = b - a;
  const double length = ab.squaredNorm();
  const double t = length > 0.0 ? std::clamp((p - a).dot(ab) / length, 0.0, 1.0) : 0.0;
  SimplexLocation result;
  result.element = 0;
  result.barycentric = { 1.0 - t, t, 0.0, 0.0 };
  result.distance = (p - (a + t * ab)).norm();
  return result;
}

double box_distance(const Vec3& p, const Vec3& lower, const Vec3& upper)
{
  return (lower - p).cwiseMax(p - upper).cwiseMax(0.0).norm();
}
} // namespace

SimplexLocation nearest_in_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 normal = ab.cross(ac);
  const double area = normal.squaredNorm();
  if (area > 0.0)
  {
    const Vec3 ap = p - a;
    const double v = ap.cross(ac).dot(normal) / area;
    const double w = ab.cross(ap).dot(normal) / area;
    if (v >= 0.0 && w >= 0.0 && v + w <= 1.0)
    {
      SimplexLocation inside;
      inside.element = 0;
      inside.barycentric = { std::max(0.0, 1.0 - v - w), v, w, 0.0 };
      inside.distance = (ap - v * ab - w * ac).norm();
      return inside;
    }
  }
  const Vec3 corner[3] = { a, b, c };
  SimplexLocation best;
  best.distance = 1e300;
  for (int k = 0; k < 3; ++k)
  {
    const SimplexLocation edge = nearest_on_segment(p, corner[k], corner[(k + 1) % 3]);
    if (edge.distance < best.distance)
    {
      best.element = 0;
      best.distance = edge.distance;
      best.barycentric = { 0.0, 0.0, 0.0, 0.0 };
      best.barycentric[k] = edge.barycentric[0];
      best.barycentric[(k + 1) % 3] = edge.barycentric[1];
    }
  }
  return best;
}

SimplexLocation nearest_in_tet(
  const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Vec3 corner[4] = { a, b, c, d };
  const double volume_times_six = (b - a).cross(c - a).dot(d - a);
  if (volume_times_six != 0.0)
  {
    const double u = (p - a).cross(c - a).dot(d - a) / volume_times_six;
    const double v = (b - a).cross(p - a).dot(d - a) / volume_times_six;
    const double w = (b - a).cross(c - a).dot(p - a) / volume_times_six;
    if (u >= 0.0 && v >= 0.0 && w >= 0.0 && u + v + w <= 1.0)
    {
      SimplexLocation inside;
      inside.element = 0;
      inside.barycentric = { std::max(0.0, 1.0 - u - v - w), u, v, w };
      return inside;
    }
  }
  constexpr int facets[4][3] = { { 1, 2, 3 }, { 0, 2, 3 }, { 0, 1, 3 }, { 0, 1, 2 } };
  SimplexLocation best;
  best.distance = 1e300;
  for (const auto& facet : facets)
  {
    const SimplexLocation on =
      nearest_in_triangle(p, corner[facet[0]], corner[facet[1]], corner[facet[2]]);
    if (on.distance < best.distance)
    {
      best.element = 0;
      best.distance = on.distance;
      best.barycentric = { 0.0, 0.0, 0.0, 0.0 };
      for (int k = 0; k < 3; ++k)
      {
        best.barycentric[facet[k]] = on.barycentric[k];
      }
    }
  }
  return best;
}

SimplexLocator::SimplexLocator(PointsView points, TetsView tets)
  : points_(points), elements_(tets.data()), count_(tets.rows()), corners_per_element_(4)
{
  this->build();
}

SimplexLocator::SimplexLocator(PointsView points, TrianglesView triangles)
  : points_(points), elements_(triangles.data()), count_(triangles.rows()), corners_per_element_(3)
{
  this->build();
}

void SimplexLocator::build()
{
  this->lower_.resize(static_cast<std::size_t>(this->count_));
  this->upper_.resize(static_cast<std::size_t>(this->count_));
  this->order_.resize(static_cast<std::size_t>(this->count_));
  std::iota(this->order_.begin(), this->order_.end(), Index(0));
  for (Index e = 0; e < this->count_; ++e)
  {
    Box box;
    for (int k = 0; k < this->corners_per_element_; ++k)
    {
      box.add(this->points_.row(this->elements_[e * this->corners_per_element_ + k]));
    }
    this->lower_[e] = box.lower;
    this->upper_[e] = box.upper;
  }
  if (this->count_ > 0)
  {
    this->build(0, this->count_);
  }
}

Index SimplexLocator::build(Index begin, Index end)
{
  const auto node_id = static_cast<Index>(this->nodes_.size());
  this->nodes_.emplace_back();
  Box box;
  Box centers;
  for (Index i = begin; i < end; ++i)
  {
    const Index e = this->order_[i];
    box.add(this->lower_[e]);
    box.add(this->upper_[e]);
    centers.add(this->lower_[e] + this->upper_[e]);
  }
  this->nodes_[node_id].lower = box.lower;
  this->nodes_[node_id].upper = box.upper;
  this->nodes_[node_id].begin = begin;
  this->nodes_[node_id].end = end;
  if (end - begin > leaf_size)
  {
    int axis;
    centers.size().maxCoeff(&axis);
    const Index middle = (begin + end) / 2;
    const auto first = this->order_.begin();
    split_at(first + begin, first + middle, first + end,
      [&](Index e) { return std::pair(this->lower_[e][axis] + this->upper_[e][axis], e); });
    this->build(begin, middle);
    const Index right = this->build(middle, end);
    this->nodes_[node_id].right = right;
  }
  return node_id;
}

SimplexLocation SimplexLocator::nearest_in_element(Index element, const Vec3& p) const
{
  const Index* ids = this->elements_ + element * this->corners_per_element_;
  const auto at = [&](int k) { return Vec3(this->points_.row(ids[k])); };
  SimplexLocation result = this->corners_per_element_ == 4
    ? nearest_in_tet(p, at(0), at(1), at(2), at(3))
    : nearest_in_triangle(p, at(0), at(1), at(2));
  result.element = element;
  return result;
}

SimplexLocation SimplexLocator::locate(const Vec3& p) const
{
  SimplexLocation best;
  best.distance = 1e300;
  if (this->nodes_.empty() || !p.allFinite())
  {
    best.distance = 0.0;
    return best;
  }
  std::vector<std::pair<double, Index>> stack{ { 0.0, 0 } };
  while (!stack.empty())
  {
    const auto [distance, at] = stack.back();
    stack.pop_back();
    if (distance > best.distance)
    {
      continue;
    }
    const Node& node = this->nodes_[at];
    if (node.right < 0)
    {
      for (Index i = node.begin; i < node.end; ++i)
      {
        const Index e = this->order_[i];
        if (box_distance(p, this->lower_[e], this->upper_[e]) > best.distance)
        {
          continue;
        }
        const SimplexLocation found = this->nearest_in_element(e, p);
        if (found.distance < best.distance || (found.distance == best.distance && e < best.element))
        {
          best = found;
        }
      }
      continue;
    }
    std::pair<double, Index> nearest_entry{
      box_distance(p, this->nodes_[at + 1].lower, this->nodes_[at + 1].upper), at + 1
    };
    std::pair<double, Index> far{
      box_distance(p, this->nodes_[node.right].lower, this->nodes_[node.right].upper), node.right
    };
    if (far.first < nearest_entry.first)
    {
      std::swap(nearest_entry, far);
    }
    stack.push_back(far);
    stack.push_back(nearest_entry);
  }
  return best;
}

} // namespace bindpose
