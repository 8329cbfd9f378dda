// An edge is open if different numbers of triangles use the edge in its two directions. Equal
// numbers of open edges enter and leave each vertex, so a walk along open edges always returns to a
// visited vertex. When the walk reaches a vertex for the second time, the loop since the first
// visit is removed from the walk and capped.
//
// A loop is capped by bisection: one triangle joins the first, the middle and the last vertex of
// the loop. Then both halves of the loop are capped in the same way. Most triangles are then as
// small as the edges and close to the boundary. DipoleField and WindingCells process them faster
// than the many long triangles of a fan.
#include "winding/boundary_caps.h"

#include <algorithm>

namespace bindpose
{

namespace
{
struct DirectedEdge
{
  Index from, to;
};

/// Add the triangles that fill the region between the path first … last and its chord.
void cap_path(const std::vector<Index>& path, std::size_t first, std::size_t last,
  std::vector<std::array<Index, 3>>& caps)
{
  if (last - first < 2)
  {
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  // The corners are in reverse order, because the cap must use each edge in the direction opposite
  // to the surface.
  caps.push_back({ path[last], path[middle], path[first] });
  cap_path(path, first, middle, caps);
  cap_path(path, middle, last, caps);
}
} // namespace

Triangles boundary_caps(const std::vector<Edge>& edges)
{
  std::vector<DirectedEdge> open_edges;
  for (const Edge& edge : edges)
  {
    for (Index k = 0; k < std::abs(edge.net_direction); ++k)
    {
      open_edges.push_back(
        edge.net_direction > 0 ? DirectedEdge{ edge.a, edge.b } : DirectedEdge{ edge.b, edge.a });
    }
  }
  std::stable_sort(open_edges.begin(), open_edges.end(),
    [](const DirectedEdge& x, const DirectedEdge& y) { return x.from < y.from; });
  // Boundary vertices are referred to by their index in `vertices`, so that the arrays have the
  // size of the boundary, not of the mesh.
  std::vector<Index> vertices;
  std::vector<std::size_t> next; // index of the first unvisited edge at each vertex
  for (std::size_t i = 0; i < open_edges.size(); ++i)
  {
    if (i == 0 || open_edges[i].from != open_edges[i - 1].from)
    {
      vertices.push_back(open_edges[i].from);
      next.push_back(i);
    }
  }
  const auto index_of = [&](Index vertex)
  {
    return static_cast<std::size_t>(
      std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin());
  };
  std::vector<std::array<Index, 3>> caps;
  constexpr std::size_t not_on_path = ~std::size_t{ 0 };
  std::vector<std::size_t> path_index(
    vertices.size(), not_on_path); // index of each vertex in `path`
  std::vector<Index> path;
  for (std::size_t start = 0; start < vertices.size(); ++start)
  {
    std::size_t current = start;
    path.assign(1, vertices[start]);
    path_index[start] = 0;
    while (next[current] < open_edges.size() && open_edges[next[current]].from == vertices[current])
    {
      current = index_of(open_edges[next[current]++].to);
      path.push_back(vertices[current]);
      if (path_index[current] != not_on_path)
      {
        const std::size_t begin = path_index[current];
        // A loop of n edges has n + 1 entries; the last one repeats the first.
        cap_path(path, begin, path.size() - 2, caps);
        while (path.size() > begin + 1)
        {
          path_index[index_of(path.back())] = not_on_path;
          path.pop_back();
        }
        path_index[current] = begin;
      }
      else
      {
        path_index[current] = path.size() - 1;
      }
    }
    path_index[start] = not_on_path;
  }
  Triangles result(static_cast<Index>(caps.size()), 3);
  for (std::size_t t = 0; t < caps.size(); ++t)
  {
    result.row(static_cast<Index>(t)) << caps[t][0], caps[t][1], caps[t][2];
  }
  return result;
}

Triangles smaller_caps(const Points& points, const Triangles& triangles, const Triangles& caps)
{
  // All vertices of a cap belong to one component, because a walk along the boundary cannot leave
  // the component.
  const Components components = connected_components(points.rows(), triangles);
  const auto component_of = [&](const auto& triangle)
  { return components.component_of_vertex[triangle[0]]; };
  const auto squared_longest_edge = [&](const auto& triangle)
  {
    double longest = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      longest = std::max(
        longest, (points.row(triangle[k]) - points.row(triangle[(k + 1) % 3])).squaredNorm());
    }
    return longest;
  };
  // Per component: size of its caps minus size of its triangles. The size of a set of triangles is
  // the sum of the squared lengths of their longest edges.
  std::vector<double> excess(static_cast<std::size_t>(components.count), 0.0);
  for (Index t = 0; t < caps.rows(); ++t)
  {
    excess[component_of(caps.row(t))] += squared_longest_edge(caps.row(t));
  }
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    excess[component_of(triangles.row(t))] -= squared_longest_edge(triangles.row(t));
  }
  Triangles chosen(triangles.rows() + caps.rows(), 3);
  Index count = 0;
  for (Index t = 0; t < caps.rows(); ++t)
  {
    if (excess[component_of(caps.row(t))] <= 0.0)
    {
      chosen.row(count++) = caps.row(t);
    }
  }
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    if (excess[component_of(triangles.row(t))] > 0.0)
    {
      chosen.row(count++) << triangles(t, 2), triangles(t, 1), triangles(t, 0);
    }
  }
  chosen.conservativeResize(count, 3);
  return chosen;
}

} // namespace bindpose
