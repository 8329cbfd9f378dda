// Splits vertices along sharp edges. The corners of the triangles are listed by vertex, and every
// vertex is processed on its own. If an edge at the vertex belongs to exactly two triangles and is
// not sharp, the corners of both triangles join one group.
#include "shapes/sharp_edges.h"

#include "base/constants.h"
#include "base/disjoint_sets.h"
#include "base/execution.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
using Id = std::int32_t;

/// Unit normals, #F x 3; zero for triangles without area.
Points unit_normals(ExecutionContext& context, PointsView points, const Triangles& triangles)
{
  Points normals(triangles.rows(), 3);
  parallel_for(context, triangles.rows(), 4096,
    [&](Index begin, Index end)
    {
      for (Index t = begin; t < end; ++t)
      {
        const Vec3 a = points.row(triangles(t, 0));
        const Vec3 b = points.row(triangles(t, 1));
        const Vec3 c = points.row(triangles(t, 2));
        const Vec3 normal = (b - a).cross(c - a);
        const double length = normal.norm();
        normals.row(t) = length > 0.0 ? Vec3(normal / length) : Vec3::Zero();
      }
    });
  return normals;
}

/// Groups the corners of one vertex.
class CornerGroups
{
public:
  CornerGroups(const Triangles& triangles, const Points& normals, double cosine)
    : triangles_(triangles), normals_(normals), cosine_(cosine)
  {
  }

  /// Write the index of each corner's group. Groups are numbered from 0, in the order of their
  /// first corners.
  /// @param corners  3 * triangle + position in the triangle, ascending
  /// @return the number of groups
  Id group_corners(const Id* corners, Id count, Id* groups)
  {
    this->edges_.clear();
    this->corner_sets_.reset(static_cast<std::size_t>(count));
    for (Id k = 0; k < count; ++k)
    {
      if (k > 0 && corners[k] / 3 == corners[k - 1] / 3)
      {
        this->corner_sets_.unite(k - 1, k); // a degenerate triangle that has the vertex twice
      }
      const Id t = corners[k] / 3, position = corners[k] % 3;
      this->edges_.push_back({ this->triangles_(t, (position + 1) % 3), k });
      this->edges_.push_back({ this->triangles_(t, (position + 2) % 3), k });
    }
    std::sort(this->edges_.begin(), this->edges_.end());
    for (std::size_t begin = 0, end = 0; begin < this->edges_.size(); begin = end)
    {
      while (end < this->edges_.size() && this->edges_[end].first == this->edges_[begin].first)
      {
        ++end;
      }
      if (end - begin == 2)
      {
        const Id a = this->edges_[begin].second, b = this->edges_[begin + 1].second;
        if (this->normals_.row(corners[a] / 3).dot(this->normals_.row(corners[b] / 3)) >
          this->cosine_)
        {
          this->corner_sets_.unite(a, b);
        }
      }
    }
    Id group_count = 0;
    for (Id k = 0; k < count; ++k)
    {
      const Id root = this->corner_sets_.find(k); // the first corner of the group
      groups[k] = root == k ? group_count++ : groups[root];
    }
    return group_count;
  }

private:
  const Triangles& triangles_;
  const Points& normals_;
  double cosine_;
  /// For each edge at the vertex: the vertex at its other end, and a corner that touches the edge.
  std::vector<std::pair<Index, Id>> edges_;
  DisjointSets<Id> corner_sets_; ///< groups of corners
};
} // namespace

std::vector<Index> split_sharp_edges(PointsView points, double feature_angle, Triangles& triangles)
{
  ExecutionContext context;
  const Points normals = unit_normals(context, points, triangles);
  const auto vertices = static_cast<std::size_t>(points.rows());
  std::vector<Id> first(vertices + 1, 0);
  for (Index k = 0; k < triangles.size(); ++k)
  {
    ++first[triangles.data()[k] + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v)
  {
    first[v + 1] += first[v];
  }
  std::vector<Id> next(first.begin(), first.end() - 1);
  std::vector<Id> corners(static_cast<std::size_t>(triangles.size()));
  for (Index k = 0; k < triangles.size(); ++k)
  {
    corners[next[triangles.data()[k]]++] = static_cast<Id>(k);
  }
  std::vector<Id> groups(corners.size());
  std::vector<Id>& group_counts = next; // reuses the memory of `next`, which is no longer needed
  const double cosine = std::cos(feature_angle * pi / 180.0);
  parallel_for(context, static_cast<Index>(vertices), 2048,
    [&](Index begin, Index end)
    {
      CornerGroups corner_groups(triangles, normals, cosine);
      for (Index v = begin; v < end; ++v)
      {
        group_counts[v] = corner_groups.group_corners(
          corners.data() + first[v], first[v + 1] - first[v], groups.data() + first[v]);
      }
    });
  std::vector<Index> originals;
  originals.reserve(vertices);
  for (std::size_t v = 0; v < vertices; ++v)
  {
    const auto base = static_cast<Index>(originals.size());
    originals.insert(
      originals.end(), static_cast<std::size_t>(group_counts[v]), static_cast<Index>(v));
    for (Id k = first[v]; k < first[v + 1]; ++k)
    {
      triangles.data()[corners[k]] = base + groups[k];
    }
  }
  return originals;
}

} // namespace bindpose
