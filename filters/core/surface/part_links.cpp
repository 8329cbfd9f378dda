// Links between nearest parts (see part_links.h), by searches in a tree of boxes. A group is a set
// of linked parts. Boxes that contain triangles of only one group are labeled with that group. A
// search for the nearest triangle outside a group skips the group's own boxes. The smallest
// distance found so far bounds the search for the next triangle of the group.
#include "surface/part_links.h"

#include "base/constants.h"
#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "surface/triangle_predicates.h"
#include "surface/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

namespace bindpose
{

namespace
{
constexpr Index mixed_label = -1; ///< label of a box with triangles of more than one group

using Corners = std::array<Vec3, 3>;

/// Two triangles of different groups and their distance.
struct Pair
{
  double distance = infinite;
  PartLink link;
};

/// Return the parameters of the nearest points of the segments p0 p1 and q0 q1.
std::array<double, 2> nearest_on_segments(
  const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1)
{
  const Vec3 u = p1 - p0, v = q1 - q0, w = p0 - q0;
  const double a = u.squaredNorm(), b = u.dot(v), c = v.squaredNorm();
  const double d = u.dot(w), e = v.dot(w);
  const double determinant = a * c - b * b;
  double s = determinant > 0.0 ? std::clamp((b * e - c * d) / determinant, 0.0, 1.0) : 0.0;
  const double t = c > 0.0 ? std::clamp((b * s + e) / c, 0.0, 1.0) : 0.0;
  s = a > 0.0 ? std::clamp((b * t - d) / a, 0.0, 1.0) : 0.0;
  return { s, t };
}

/// Find the first point where an edge of triangle a intersects triangle b. Return false if there is
/// none.
bool edge_meets(const Corners& a, const Corners& b, Vec3& position)
{
  for (int k = 0; k < 3; ++k)
  {
    const Vec3& p = a[k];
    const Vec3& q = a[(k + 1) % 3];
    if (segment_meets_triangle(p, q, b[0], b[1], b[2]))
    {
      const Vec3 normal = (b[1] - b[0]).cross(b[2] - b[0]);
      const double from = normal.dot(p - b[0]), to = normal.dot(q - b[0]);
      const double t = from != to ? std::clamp(from / (from - to), 0.0, 1.0) : 0.5;
      position = closest_point(p + t * (q - p), b[0], b[1], b[2]);
      return true;
    }
  }
  return false;
}

Box box_of(const Corners& corners)
{
  Box box;
  for (const Vec3& corner : corners)
  {
    box.add(corner);
  }
  return box;
}

double distance(const Box& a, const Box& b)
{
  return (a.lower - b.upper).cwiseMax(b.lower - a.upper).cwiseMax(0.0).norm();
}

class Linker
{
public:
  Linker(ExecutionContext& context, PointsView points, TrianglesView triangles,
    const std::vector<Index>& parts, const std::vector<char>& constrained,
    const PartLinkOptions& options)
    : points_(points), triangles_(triangles), parts_(parts), constrained_(constrained),
      options_(options), context_(context), tree_(points, triangles), groups_(constrained.size())
  {
  }

  bool run(std::vector<PartLink>& links)
  {
    return this->link_nearest(links) && this->link_touching(links);
  }

private:
  Corners corners(Index f) const
  {
    return { this->points_.row(this->triangles_(f, 0)), this->points_.row(this->triangles_(f, 1)),
      this->points_.row(this->triangles_(f, 2)) };
  }
  /// Label every box of the tree: with the common label of its triangles, with `mixed_label` if
  /// their labels differ, or with `no_part_label` if none of its triangles belongs to a part.
  void label_boxes(const std::vector<Index>& label_of_part)
  {
    const auto& nodes = this->tree_.nodes();
    this->labels_.assign(nodes.size(), no_part_label);
    for (std::size_t at = nodes.size(); at-- > 0;)
    {
      const auto& node = nodes[at];
      Index& label = this->labels_[at];
      if (node.right >= 0)
      {
        label = this->joined(this->labels_[at + 1], this->labels_[node.right]);
        continue;
      }
      for (Index i = node.begin; i < node.end; ++i)
      {
        const Index part = this->parts_[this->tree_.order()[i]];
        label = this->joined(label, part < 0 ? no_part_label : label_of_part[part]);
      }
    }
  }
  static Index joined(Index a, Index b)
  {
    return a == no_part_label || a == b ? b : b == no_part_label ? a : mixed_label;
  }

  /// Visit the leaf boxes whose label differs from `label` and whose distance from `box` is at most
  /// `limit`. Call at_triangle(g) for each triangle g in these boxes; at_triangle() may lower
  /// `limit`. The nearer one of two sibling boxes is visited first.
  template <typename AtTriangle>
  void visit_others(const Box& box, Index label, const double& limit, const AtTriangle& at_triangle)
  {
    auto& stack = this->stack_;
    stack.clear();
    const auto& nodes = this->tree_.nodes();
    const auto push = [&](Index at)
    {
      if (this->labels_[at] != label && this->labels_[at] != no_part_label)
      {
        const double d = distance(nodes[at].box, box);
        if (d <= limit)
        {
          stack.emplace_back(d, at);
        }
      }
    };
    push(0);
    while (!stack.empty())
    {
      const auto [d, at] = stack.back();
      stack.pop_back();
      if (d > limit)
      {
        continue;
      }
      const auto& node = nodes[at];
      if (node.right < 0)
      {
        for (Index i = node.begin; i < node.end; ++i)
        {
          at_triangle(this->tree_.order()[i]);
        }
        continue;
      }
      const std::size_t first = stack.size();
      push(at + 1);
      push(node.right);
      if (stack.size() == first + 2 && stack[first].first < stack[first + 1].first)
      {
        std::swap(stack[first], stack[first + 1]);
      }
    }
  }

  /// Return the nearest pair of a triangle of the group and a triangle of another group.
  Pair nearest_to(const std::vector<Index>& members, Index group)
  {
    Pair best;
    for (const Index f : members)
    {
      if (best.distance == 0.0)
      {
        break;
      }
      const Corners own_corners = this->corners(f);
      const Box box = box_of(own_corners);
      this->visit_others(box, group, best.distance,
        [&](Index g)
        {
          const Index part = this->parts_[g];
          if (part < 0 || this->group_of_part_[part] == group ||
            distance(box_of(this->corners(g)), box) >= best.distance)
          {
            return;
          }
          PartLink link;
          link.triangles = { f, g };
          const double d = nearest_points(own_corners, this->corners(g), link.positions);
          if (d < best.distance)
          {
            best = { d, link };
          }
        });
    }
    return best;
  }

  bool link_nearest(std::vector<PartLink>& links)
  {
    const auto parts = static_cast<Index>(this->constrained_.size());
    // For each group, 1 if it contains a held (constrained) part. The index of a group is the
    // smallest id of its parts.
    std::vector<char> constrained = this->constrained_;
    for (bool changed = true; changed;)
    {
      changed = false;
      this->group_of_part_.resize(this->constrained_.size());
      for (Index p = 0; p < parts; ++p)
      {
        this->group_of_part_[p] = this->groups_.find(p);
      }
      std::vector<std::vector<Index>> members(this->constrained_.size());
      for (Index i = 0; i < this->triangles_.rows(); ++i)
      {
        // Use the order of the tree, so that consecutive triangles are near each other.
        const Index f = this->tree_.order()[i];
        const Index group = this->parts_[f] < 0 ? -1 : this->group_of_part_[this->parts_[f]];
        if (group >= 0 && !constrained[group])
        {
          members[group].push_back(f);
        }
      }
      this->label_boxes(this->group_of_part_);
      for (Index group = 0; group < parts; ++group)
      {
        if (members[group].empty())
        {
          continue;
        }
        if (this->context_.canceled())
        {
          return false;
        }
        const Pair best = this->nearest_to(members[group], group);
        if (best.distance == infinite)
        {
          continue;
        }
        const Index a = this->groups_.find(group);
        const Index b = this->groups_.find(this->parts_[best.link.triangles[1]]);
        if (a != b)
        {
          links.push_back(best.link);
          this->groups_.unite(a, b);
          constrained[std::min(a, b)] = constrained[a] || constrained[b] ? 1 : 0;
          changed = true;
        }
      }
    }
    return true;
  }

  /// Link each loose (not constrained) part to all parts that it touches, with one link per cube of
  /// a grid.
  bool link_touching(std::vector<PartLink>& links)
  {
    std::vector<Index> label_of_part_index(this->constrained_.size());
    std::iota(label_of_part_index.begin(), label_of_part_index.end(), Index(0));
    this->label_boxes(label_of_part_index);
    using Cell = std::array<std::int64_t, 3>;
    std::set<std::tuple<Index, Index, Cell>> linked;
    const auto cell_of = [&](const Vec3& position)
    {
      Cell cell;
      for (int k = 0; k < 3; ++k)
      {
        cell[k] = std::llround(position[k] / this->options_.spacing);
      }
      return cell;
    };
    for (const PartLink& link : links)
    {
      const Index a = this->parts_[link.triangles[0]], b = this->parts_[link.triangles[1]];
      linked.insert({ std::min(a, b), std::max(a, b), cell_of(link.positions[0]) });
    }
    std::set<std::pair<Index, Cell>> visited_cells;
    for (Index i = 0; i < this->triangles_.rows(); ++i)
    {
      const Index f = this->tree_.order()[i];
      const Index part = this->parts_[f];
      if (part < 0 || this->constrained_[part])
      {
        continue;
      }
      if (i % 256 == 0 && this->context_.canceled())
      {
        return false;
      }
      this->for_each_sample(f,
        [&](const Vec3& position)
        {
          if (!visited_cells.insert({ part, cell_of(position) }).second)
          {
            return;
          }
          Box box;
          box.add(position);
          double limit = this->options_.touch_distance;
          PartLink link;
          this->visit_others(box, part, limit,
            [&](Index g)
            {
              if (this->parts_[g] < 0 || this->parts_[g] == part)
              {
                return;
              }
              const Corners other_corners = this->corners(g);
              const Vec3 nearest =
                closest_point(position, other_corners[0], other_corners[1], other_corners[2]);
              const double d = (nearest - position).norm();
              if (d < limit || (d == limit && link.triangles[1] < 0))
              {
                limit = d;
                link.triangles = { f, g };
                link.positions = { position, nearest };
              }
            });
          if (link.triangles[1] >= 0)
          {
            const Index other = this->parts_[link.triangles[1]];
            if (linked.insert({ std::min(part, other), std::max(part, other), cell_of(position) })
                  .second)
            {
              links.push_back(link);
            }
          }
        });
    }
    return true;
  }

  /// Call at_point() for a grid of points on a triangle, including its corners. Neighboring points
  /// are at most about `spacing` apart.
  template <typename AtPoint>
  void for_each_sample(Index f, const AtPoint& at_point) const
  {
    const Corners corner = this->corners(f);
    double longest = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      longest = std::max(longest, (corner[(k + 1) % 3] - corner[k]).norm());
    }
    constexpr double maximum = 100.0;
    const int steps =
      std::max(1, static_cast<int>(std::min(maximum, std::ceil(longest / this->options_.spacing))));
    for (int i = 0; i <= steps; ++i)
    {
      for (int j = 0; i + j <= steps; ++j)
      {
        const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
        at_point(corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]));
      }
    }
  }

  static constexpr Index no_part_label = -2; ///< label of a box whose triangles belong to no part

  PointsView points_;
  TrianglesView triangles_;
  const std::vector<Index>& parts_;
  const std::vector<char>& constrained_;
  const PartLinkOptions& options_;
  ExecutionContext& context_;
  TriangleTree tree_;
  DisjointSets<Index> groups_;
  std::vector<Index> group_of_part_;
  std::vector<Index> labels_; ///< label of each box of the tree
  std::vector<std::pair<double, Index>> stack_;
};
} // namespace

double nearest_points(
  const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, std::array<Vec3, 2>& positions)
{
  double best = infinite;
  const auto update_nearest = [&](const Vec3& p, const Vec3& q)
  {
    const double d = (p - q).norm();
    if (d < best)
    {
      best = d;
      positions = { p, q };
    }
  };
  Vec3 position;
  if (distance(box_of(a), box_of(b)) == 0.0 &&
    (edge_meets(a, b, position) || edge_meets(b, a, position)))
  {
    positions = { closest_point(position, a[0], a[1], a[2]),
      closest_point(position, b[0], b[1], b[2]) };
    return 0.0;
  }
  for (int k = 0; k < 3; ++k)
  {
    update_nearest(a[k], closest_point(a[k], b[0], b[1], b[2]));
    update_nearest(closest_point(b[k], a[0], a[1], a[2]), b[k]);
    for (int l = 0; l < 3; ++l)
    {
      const Vec3 &p = a[k], &q = a[(k + 1) % 3], &r = b[l], &s = b[(l + 1) % 3];
      const auto at = nearest_on_segments(p, q, r, s);
      update_nearest(p + at[0] * (q - p), r + at[1] * (s - r));
    }
  }
  return best;
}

Status check_options(const PartLinkOptions& options)
{
  return options.touch_distance >= 0.0 && options.spacing > 0.0
    ? Status()
    : Status::invalid_input(
        "the spacing of links must be greater than 0 and the touch distance at least 0");
}

Status link_parts(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const std::vector<Index>& parts, const std::vector<char>& constrained,
  const PartLinkOptions& options, std::vector<PartLink>& links)
{
  links.clear();
  if (std::none_of(
        constrained.begin(), constrained.end(), [](char is_held) { return is_held != 0; }))
  {
    return Status::invalid_input("no part of the surface is constrained by a handle");
  }
  const Status valid = check_options(options);
  if (!valid.ok())
  {
    return valid;
  }
  return Linker(context, points, triangles, parts, constrained, options).run(links)
    ? Status()
    : Status::canceled();
}

} // namespace bindpose
