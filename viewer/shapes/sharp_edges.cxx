// Splits vertices along sharp edges. The corners of the triangles are listed by vertex, and every
// vertex is processed on its own. If an edge at the vertex belongs to exactly two triangles and is
// not sharp, the corners of both triangles join one group. The vertices at one position of a seam
// are processed again, together.
#include "shapes/sharp_edges.h"

#include "base/constants.h"
#include "base/disjoint_sets.h"
#include "base/execution.h"
#include "base/parallel.h"
#include "surface/vertex_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

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

/// Groups the corners of one vertex, or of all vertices at one position.
class CornerGroups
{
public:
  CornerGroups(const Triangles& triangles, const Points& normals, double cosine)
    : triangles_(triangles), normals_(normals), cosine_(cosine)
  {
  }

  /// Write the index of each corner's group. Groups are numbered from 0, in the order of their
  /// first corners.
  /// @param corners  3 * triangle + position in the triangle; ascending for each vertex
  /// @param representatives  #V, lowest vertex at the same position; null: ignore seams
  /// @return the number of groups
  Id group_corners(
    const Id* corners, Id count, const std::vector<Index>* representatives, Id* groups)
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
      const Index vertex = this->triangles_(t, position);
      this->edges_.push_back({ vertex, this->triangles_(t, (position + 1) % 3), k });
      this->edges_.push_back({ vertex, this->triangles_(t, (position + 2) % 3), k });
    }
    this->unite_at_edges(corners);
    this->has_boundary_ = !this->single_edges_.empty();
    if (representatives)
    {
      this->edges_.swap(this->single_edges_);
      for (Edge& edge : this->edges_)
      {
        edge.vertex = 0; // all vertices are at the same position
        edge.other = (*representatives)[static_cast<std::size_t>(edge.other)];
      }
      this->unite_at_edges(corners);
    }
    Id group_count = 0;
    for (Id k = 0; k < count; ++k)
    {
      const Id root = this->corner_sets_.find(k); // the first corner of the group
      groups[k] = root == k ? group_count++ : groups[root];
    }
    return group_count;
  }

  /// Report whether an edge at the last vertex has only one triangle.
  bool has_boundary() const { return this->has_boundary_; }

private:
  /// An edge at the vertex.
  struct Edge
  {
    Index vertex;
    Index other; ///< vertex at the other end
    Id corner; ///< index of a corner that touches the edge

    bool operator<(const Edge& edge) const
    {
      return std::tie(this->vertex, this->other, this->corner) <
        std::tie(edge.vertex, edge.other, edge.corner);
    }
    bool is_same(const Edge& edge) const
    {
      return this->vertex == edge.vertex && this->other == edge.other;
    }
  };

  /// Unite the corners at edges of exactly two triangles that are not sharp. Edges with one
  /// triangle become single_edges_.
  void unite_at_edges(const Id* corners)
  {
    std::sort(this->edges_.begin(), this->edges_.end());
    this->single_edges_.clear();
    for (std::size_t begin = 0, end = 0; begin < this->edges_.size(); begin = end)
    {
      while (end < this->edges_.size() && this->edges_[end].is_same(this->edges_[begin]))
      {
        ++end;
      }
      if (end - begin == 1)
      {
        this->single_edges_.push_back(this->edges_[begin]);
      }
      if (end - begin == 2)
      {
        const Id a = this->edges_[begin].corner, b = this->edges_[begin + 1].corner;
        if (this->normals_.row(corners[a] / 3).dot(this->normals_.row(corners[b] / 3)) >
          this->cosine_)
        {
          this->corner_sets_.unite(a, b);
        }
      }
    }
  }

  const Triangles& triangles_;
  const Points& normals_;
  double cosine_;
  std::vector<Edge> edges_;
  std::vector<Edge> single_edges_;
  bool has_boundary_ = false;
  DisjointSets<Id> corner_sets_; ///< groups of corners
};

/// The corners of the triangles, sorted by vertex, and their groups.
struct CornerLists
{
  std::vector<Id> first; ///< #V + 1, index of each vertex's first corner
  std::vector<Id> corners; ///< 3 * triangle + position in the triangle
  std::vector<Id> groups; ///< group of each corner, numbered from 0 at each vertex
  std::vector<Id> group_counts; ///< #V; 0 for vertices that share the groups of another one
  std::vector<char> is_boundary; ///< #V
};

CornerLists list_corners(const Triangles& triangles, std::size_t vertices)
{
  CornerLists lists;
  lists.first.assign(vertices + 1, 0);
  for (Index k = 0; k < triangles.size(); ++k)
  {
    ++lists.first[triangles.data()[k] + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v)
  {
    lists.first[v + 1] += lists.first[v];
  }
  std::vector<Id> next(lists.first.begin(), lists.first.end() - 1);
  lists.corners.resize(static_cast<std::size_t>(triangles.size()));
  for (Index k = 0; k < triangles.size(); ++k)
  {
    lists.corners[next[triangles.data()[k]]++] = static_cast<Id>(k);
  }
  lists.groups.resize(lists.corners.size());
  lists.group_counts.swap(next);
  lists.is_boundary.assign(vertices, 0);
  return lists;
}

/// Group the corners of the vertices at one position of a seam together.
/// @param representatives  #V, lowest boundary vertex at the same position
void group_at_seams(
  const std::vector<Index>& representatives, CornerGroups& corner_groups, CornerLists& lists)
{
  std::vector<std::pair<Index, Index>> members; // representative and vertex
  for (std::size_t v = 0; v < representatives.size(); ++v)
  {
    if (lists.is_boundary[v])
    {
      members.emplace_back(representatives[v], static_cast<Index>(v));
    }
  }
  std::sort(members.begin(), members.end());
  std::vector<Id> corners, groups;
  for (std::size_t begin = 0, end = 0; begin < members.size(); begin = end)
  {
    corners.clear();
    while (end < members.size() && members[end].first == members[begin].first)
    {
      const Index v = members[end++].second;
      corners.insert(corners.end(), lists.corners.begin() + lists.first[v],
        lists.corners.begin() + lists.first[v + 1]);
    }
    if (end - begin == 1)
    {
      continue;
    }
    groups.resize(corners.size());
    const Id count = corner_groups.group_corners(
      corners.data(), static_cast<Id>(corners.size()), &representatives, groups.data());
    const Id* from = groups.data();
    for (std::size_t m = begin; m < end; ++m)
    {
      const Index v = members[m].second;
      const Id size = lists.first[v + 1] - lists.first[v];
      std::copy_n(from, size, lists.groups.begin() + lists.first[v]);
      from += size;
      lists.group_counts[v] = m == begin ? count : 0;
    }
  }
}
} // namespace

SplitVertices split_sharp_edges(PointsView points, double feature_angle, Triangles& triangles)
{
  ExecutionContext context;
  const Points normals = unit_normals(context, points, triangles);
  const auto vertices = static_cast<std::size_t>(points.rows());
  CornerLists lists = list_corners(triangles, vertices);
  const double cosine = std::cos(feature_angle * pi / 180.0);
  parallel_for(context, static_cast<Index>(vertices), 2048,
    [&](Index begin, Index end)
    {
      CornerGroups corner_groups(triangles, normals, cosine);
      for (Index v = begin; v < end; ++v)
      {
        lists.group_counts[v] = corner_groups.group_corners(lists.corners.data() + lists.first[v],
          lists.first[v + 1] - lists.first[v], nullptr, lists.groups.data() + lists.first[v]);
        lists.is_boundary[v] = corner_groups.has_boundary();
      }
    });
  std::vector<Index> representatives(vertices);
  std::iota(representatives.begin(), representatives.end(), Index(0));
  if (std::find(lists.is_boundary.begin(), lists.is_boundary.end(), 1) != lists.is_boundary.end())
  {
    representatives = find_representatives(points, lists.is_boundary);
    CornerGroups corner_groups(triangles, normals, cosine);
    group_at_seams(representatives, corner_groups, lists);
  }
  SplitVertices split;
  split.originals.reserve(vertices);
  split.normals.reserve(vertices);
  std::vector<Index> first_normal(vertices); // index of the normal of each vertex's group 0
  bool shares_normals = false;
  std::vector<Index> new_vertices; // new vertex of each group, or -1
  for (std::size_t v = 0; v < vertices; ++v)
  {
    first_normal[v] = split.normal_count;
    split.normal_count += lists.group_counts[v];
    const Index base = first_normal[static_cast<std::size_t>(representatives[v])];
    new_vertices.clear();
    for (Id k = lists.first[v]; k < lists.first[v + 1]; ++k)
    {
      const auto group = static_cast<std::size_t>(lists.groups[k]);
      new_vertices.resize(std::max(new_vertices.size(), group + 1), -1);
      if (new_vertices[group] < 0)
      {
        new_vertices[group] = static_cast<Index>(split.originals.size());
        split.originals.push_back(static_cast<Index>(v));
        split.normals.push_back(base + lists.groups[k]);
      }
      triangles.data()[lists.corners[k]] = new_vertices[group];
    }
    shares_normals = shares_normals || representatives[v] != static_cast<Index>(v);
  }
  if (!shares_normals)
  {
    split.normals.clear(); // groups and vertices have the same order
  }
  return split;
}

} // namespace bindpose
