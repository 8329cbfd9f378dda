// Rotations at point handles from their dragged positions (Jacobson et al. 2011, Bounded Biharmonic
// Weights, section 5). The user moves points. Virtual edges between the points do not deform the
// shape; they only determine the rotations of their ends.
#include "pose/pseudo_edges.h"

#include "pose/transform_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>

namespace bindpose
{

namespace
{
/// Adjacency lists of the vertices: the neighbors of v are to[k] for start[v] <= k < start[v + 1].
struct Neighbors
{
  std::vector<Index> start, to;
};

/// List each edge once per element that uses it. Duplicates do not affect shortest paths.
template <typename Elements>
Neighbors neighbors_of(Index vertices, const Elements& elements)
{
  Neighbors list;
  const Index other_corner_count = elements.cols() - 1;
  list.start.assign(static_cast<std::size_t>(vertices) + 1, 0);
  for (Index k = 0; k < elements.size(); ++k)
  {
    list.start[static_cast<std::size_t>(elements.data()[k]) + 1] += other_corner_count;
  }
  std::partial_sum(list.start.begin(), list.start.end(), list.start.begin());
  list.to.resize(static_cast<std::size_t>(list.start.back()));
  std::vector<Index> next(list.start.begin(), list.start.end() - 1);
  for (Index e = 0; e < elements.rows(); ++e)
  {
    for (Index a = 0; a < elements.cols(); ++a)
    {
      for (Index b = 0; b < elements.cols(); ++b)
      {
        if (a != b)
        {
          Index& index = next[static_cast<std::size_t>(elements(e, a))];
          list.to[static_cast<std::size_t>(index++)] = elements(e, b);
        }
      }
    }
  }
  return list;
}

/// Return the vertex nearest to `to`, or -1. Vertices that no element uses are ignored.
Index nearest_vertex(PointsView points, const Neighbors& neighbors, const Vec3& to)
{
  Index nearest = -1;
  double smallest_distance = std::numeric_limits<double>::infinity();
  for (Index v = 0; v < points.rows(); ++v)
  {
    const double distance = (points.row(v).transpose() - to).squaredNorm();
    const auto index = static_cast<std::size_t>(v);
    if (neighbors.start[index] < neighbors.start[index + 1] && distance < smallest_distance)
    {
      smallest_distance = distance;
      nearest = v;
    }
  }
  return nearest;
}

/// A path between two handles: its length, then the indices of the handles. Paths are sorted by
/// length.
using HandlePath = std::tuple<double, Index, Index>;

HandlePath make_path(double length, Index a, Index b)
{
  return { length, std::min(a, b), std::max(a, b) };
}

/// Return the pseudo-edges of the minimum spanning forest, by Kruskal's algorithm.
PseudoEdges spanning_tree(std::vector<HandlePath> paths, std::size_t handles)
{
  std::sort(paths.begin(), paths.end());
  std::vector<Index> part(handles);
  std::iota(part.begin(), part.end(), Index(0));
  PseudoEdges edges;
  for (const auto& [length, a, b] : paths)
  {
    const Index from = part[static_cast<std::size_t>(a)], to = part[static_cast<std::size_t>(b)];
    if (from != to)
    {
      edges.push_back({ a, b });
      std::replace(part.begin(), part.end(), to, from);
    }
  }
  return edges;
}

template <typename Elements>
Status find_edges(ExecutionContext& context, PointsView points, const Elements& elements,
  const Handles& handles, PseudoEdges& edges)
{
  edges.clear();
  Status valid = check_mesh(points, elements);
  if (!valid.ok())
  {
    return valid;
  }
  const Neighbors neighbors = neighbors_of(points.rows(), elements);
  const auto size = static_cast<std::size_t>(points.rows());
  std::vector<double> distance(size, std::numeric_limits<double>::infinity());
  std::vector<Index> owner(size, -1);
  std::vector<HandlePath> paths;
  // Distance between a handle and a vertex, then the indices of the handle and of the vertex.
  using Reached = std::tuple<double, Index, Index>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<Reached>> front;
  Index count = 0;
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    if (handles[h].kind != HandleKind::point)
    {
      continue;
    }
    const Index vertex = nearest_vertex(points, neighbors, handles[h].head);
    if (vertex >= 0)
    {
      count += 1;
      front.emplace(
        (points.row(vertex).transpose() - handles[h].head).norm(), static_cast<Index>(h), vertex);
    }
  }
  Index steps = 0;
  while (!front.empty())
  {
    const auto [length, handle, v] = front.top();
    front.pop();
    const auto index = static_cast<std::size_t>(v);
    if (owner[index] >= 0)
    {
      if (owner[index] != handle) // a path between two different handles
      {
        paths.push_back(make_path(distance[index] + length, owner[index], handle));
      }
      continue;
    }
    owner[index] = handle;
    distance[index] = length;
    for (Index k = neighbors.start[index]; k < neighbors.start[index + 1]; ++k)
    {
      const Index u = neighbors.to[static_cast<std::size_t>(k)];
      const auto next = static_cast<std::size_t>(u);
      const double new_distance = length + (points.row(u) - points.row(v)).norm();
      if (owner[next] < 0)
      {
        if (new_distance < distance[next])
        {
          distance[next] = new_distance;
          front.emplace(new_distance, handle, u);
        }
      }
      else if (owner[next] != handle)
      {
        paths.push_back(make_path(new_distance + distance[next], owner[next], handle));
      }
    }
    if (++steps % 1024 == 0)
    {
      context.progress(static_cast<double>(steps) / static_cast<double>(points.rows()));
      if (context.canceled())
      {
        return Status::canceled();
      }
    }
  }
  edges = spanning_tree(std::move(paths), handles.size());
  Status status;
  if (edges.empty())
  {
    status.warnings.push_back(count < 2
        ? "automatic pseudo-edges need at least 2 point handles on the mesh, but the number of "
          "such handles is " +
          std::to_string(count)
        : "no automatic pseudo-edges were created because no two point handles are on the same "
          "connected part of the mesh");
  }
  return status;
}

/// Sums over the pseudo-edges at a handle.
struct EdgeRotation
{
  Eigen::Vector4d quaternion = Eigen::Vector4d::Zero(); // sum of the edges' rotations
  double ratio = 0.0; // sum of the edges' length ratios
  Index edges = 0;

  void add(const Vec3& rest, const Vec3& posed)
  {
    const double from = rest.stableNorm(), to = posed.stableNorm();
    if (!(from > 0.0 && to > 0.0))
    {
      return; // an edge of length zero has no direction
    }
    const Eigen::Vector4d q = minimal_rotation(rest, posed).coeffs();
    this->quaternion += this->edges > 0 && q.dot(this->first_) < 0.0 ? Eigen::Vector4d(-q) : q;
    this->first_ = this->edges > 0 ? this->first_ : q;
    this->ratio += to / from;
    this->edges += 1;
  }

private:
  Eigen::Vector4d first_ = Eigen::Vector4d::Zero();
};
} // namespace

Status check_pseudo_edges(const Handles& handles, const PseudoEdges& edges)
{
  const auto is_point = [&](Index h)
  {
    return h >= 0 && h < static_cast<Index>(handles.size()) &&
      handles[static_cast<std::size_t>(h)].kind == HandleKind::point;
  };
  for (std::size_t e = 0; e < edges.size(); ++e)
  {
    const auto [a, b] = edges[e];
    if (!is_point(a) || !is_point(b) || a == b)
    {
      return Status::invalid_input(
        "pseudo-edge " + std::to_string(e) + " must connect two different point handles");
    }
  }
  return {};
}

Status automatic_pseudo_edges(ExecutionContext& context, PointsView points, TetsView tets,
  const Handles& handles, PseudoEdges& edges)
{
  return find_edges(context, points, tets, handles, edges);
}

Status automatic_pseudo_edges(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const Handles& handles, PseudoEdges& edges)
{
  return find_edges(context, points, triangles, handles, edges);
}

void rotate_by_pseudo_edges(
  const Handles& handles, const PseudoEdges& edges, bool stretch, Pose& pose)
{
  Points posed(static_cast<Index>(handles.size()), 3);
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    const Vec3 pivot = handles[h].head;
    const Vec3 moved = pose[h].transform * pivot.homogeneous();
    posed.row(static_cast<Index>(h)) = pose[h].mode == HandleMode::free ? pivot : moved;
  }
  std::vector<EdgeRotation> edge_rotations(handles.size());
  for (const auto& [a, b] : edges)
  {
    const Vec3 rest =
      handles[static_cast<std::size_t>(b)].head - handles[static_cast<std::size_t>(a)].head;
    const Vec3 posed_edge = (posed.row(b) - posed.row(a)).transpose();
    edge_rotations[static_cast<std::size_t>(a)].add(rest, posed_edge);
    edge_rotations[static_cast<std::size_t>(b)].add(rest, posed_edge);
  }
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    const EdgeRotation& edge_rotation = edge_rotations[h];
    if (edge_rotation.edges == 0 || pose[h].mode == HandleMode::free)
    {
      continue;
    }
    // The sum is not zero, because the angle between each quaternion and the first one is at most a
    // right angle.
    const Eigen::Quaterniond q(Eigen::Vector4d(edge_rotation.quaternion.normalized()));
    Eigen::Matrix3d linear = q.toRotationMatrix();
    linear *= stretch ? edge_rotation.ratio / static_cast<double>(edge_rotation.edges) : 1.0;
    if (constrains_transform(pose[h].mode))
    {
      linear *= Eigen::Matrix3d(pose[h].transform.leftCols<3>());
    }
    pose[h].mode = HandleMode::full;
    pose[h].transform.leftCols<3>() = linear;
    pose[h].transform.col(3) =
      posed.row(static_cast<Index>(h)).transpose() - linear * handles[h].head;
  }
}

} // namespace bindpose
