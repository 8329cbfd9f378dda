// Vertices are sorted by their coordinates, so that equal ones stand side by side. Edges and
// triangles are laid out by their smallest vertex, and sorted where they share it: few do.
#include "winding/welded_surface.h"

#include "base/large_pages.h"
#include "base/parallel_sort.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

namespace bindpose
{

namespace
{
/// True when the corners lie on one line, as exactly as doubles hold it.
bool is_flat(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  return u.cross(v).norm() <= 1e-15 * u.norm() * v.norm();
}

/// Lays out items by a vertex of each: those of v are items[begin[v] … begin[v + 1]), sorted.
/// `visit(see)` calls see(vertex, item) for all items, twice. false when cancelled.
template <typename Item, typename Visit, typename Less>
bool lay_out(ExecutionContext& context, Index vertices, const Visit& visit, const Less& less,
  std::vector<Index>& begin, std::vector<Item>& items)
{
  begin.assign(static_cast<std::size_t>(vertices) + 1, 0);
  visit([&](Index vertex, const Item&) { begin[vertex + 1] += 1; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  if (context.cancelled())
  {
    return false;
  }
  reserve_in_large_pages(items, static_cast<std::size_t>(begin.back()));
  items.resize(static_cast<std::size_t>(begin.back()));
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  visit([&](Index vertex, const Item& item) { items[next[vertex]++] = item; });
  return parallel_for(context, vertices, 16384,
    [&](Index first, Index last)
    {
      for (Index v = first; v < last; ++v)
      {
        std::sort(items.begin() + begin[v], items.begin() + begin[v + 1], less);
      }
    });
}

bool weld(PointsView points, TrianglesView triangles, const ExactFrame& frame,
  ExecutionContext& context, WeldedSurface& welded)
{
  std::vector<char> used(static_cast<std::size_t>(points.rows()), 0);
  for (Index k = 0; k < triangles.size(); ++k)
  {
    used[triangles.data()[k]] = 1;
  }
  struct Vertex
  {
    Vec3 at;
    Index id;
  };
  std::vector<Vertex> vertices;
  for (Index v = 0; v < points.rows(); ++v)
  {
    if (used[v])
    {
      vertices.push_back({ frame(points.row(v)), v });
    }
  }
  if (!parallel_sort(context, vertices,
        [](const Vertex& x, const Vertex& y)
        {
          return std::lexicographical_compare(
            x.at.data(), x.at.data() + 3, y.at.data(), y.at.data() + 3);
        }))
  {
    return false;
  }
  std::vector<Index> id_of(static_cast<std::size_t>(points.rows()), -1);
  Index count = 0;
  welded.points.resize(static_cast<Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    if (i == 0 || vertices[i].at != vertices[i - 1].at)
    {
      welded.points.row(count++) = vertices[i].at.transpose();
      welded.original_vertices.push_back(vertices[i].id);
    }
    id_of[vertices[i].id] = count - 1;
  }
  welded.points.conservativeResize(count, 3);
  welded.merged_vertices = static_cast<Index>(vertices.size()) - count;

  Index kept = 0;
  welded.triangles.resize(triangles.rows(), 3);
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    const std::array<Index, 3> ids{ id_of[triangles(t, 0)], id_of[triangles(t, 1)],
      id_of[triangles(t, 2)] };
    if (ids[0] == ids[1] || ids[1] == ids[2] || ids[2] == ids[0])
    {
      welded.degenerate_triangles += 1;
      continue;
    }
    // A flat one has no angle, but its edges hold those of its neighbours together.
    welded.degenerate_triangles +=
      is_flat(welded.points.row(ids[0]), welded.points.row(ids[1]), welded.points.row(ids[2]));
    welded.triangles.row(kept++) << ids[0], ids[1], ids[2];
  }
  welded.triangles.conservativeResize(kept, 3);
  return true;
}

/// Triangles of the same corners as one before them; false when cancelled.
bool count_duplicates(
  const Triangles& triangles, Index vertices, ExecutionContext& context, Index& duplicates)
{
  using Others = std::array<Index, 2>; // corners, ascending
  std::vector<Index> begin;
  std::vector<Others> others;
  const auto visit = [&](const auto& see)
  {
    for (Index t = 0; t < triangles.rows(); ++t)
    {
      std::array<Index, 3> ids{ triangles(t, 0), triangles(t, 1), triangles(t, 2) };
      std::sort(ids.begin(), ids.end());
      see(ids[0], Others{ ids[1], ids[2] });
    }
  };
  if (!lay_out(context, vertices, visit, std::less<>(), begin, others))
  {
    return false;
  }
  for (Index v = 0; v < vertices; ++v)
  {
    for (Index i = begin[v] + 1; i < begin[v + 1]; ++i)
    {
      duplicates += others[i] == others[i - 1];
    }
  }
  return true;
}

/// mesh_edges(), but on all threads and cancellable.
bool find_edges(
  const Triangles& triangles, Index vertices, ExecutionContext& context, std::vector<Edge>& edges)
{
  std::vector<Index> begin;
  const auto visit = [&](const auto& see)
  {
    for (Index t = 0; t < triangles.rows(); ++t)
    {
      for (int k = 0; k < 3; ++k)
      {
        const Index from = triangles(t, k);
        const Index to = triangles(t, (k + 1) % 3);
        see(std::min(from, to),
          Edge{ std::min(from, to), std::max(from, to), 1, from < to ? 1 : -1 });
      }
    }
  };
  edges.clear();
  if (!lay_out(
        context, vertices, visit, [](const Edge& x, const Edge& y) { return x.b < y.b; }, begin,
        edges))
  {
    return false;
  }
  std::size_t kept = 0;
  for (std::size_t i = 1; i < edges.size(); ++i)
  {
    if (edges[i].a == edges[kept].a && edges[i].b == edges[kept].b)
    {
      edges[kept].uses += 1;
      edges[kept].net_direction += edges[i].net_direction;
    }
    else
    {
      edges[++kept] = edges[i];
    }
  }
  edges.resize(edges.empty() ? 0 : kept + 1);
  return true;
}
} // namespace

bool weld_surface(PointsView points, TrianglesView triangles, const ExactFrame& frame,
  ExecutionContext& context, WeldedSurface& welded)
{
  {
    const ProgressRange range(context, 0.0, 0.5);
    if (!weld(points, triangles, frame, context, welded))
    {
      return false;
    }
  }
  const Index vertices = welded.points.rows();
  {
    const ProgressRange range(context, 0.5, 0.65);
    if (!count_duplicates(welded.triangles, vertices, context, welded.duplicate_triangles))
    {
      return false;
    }
  }
  const ProgressRange range(context, 0.65, 1.0);
  return find_edges(welded.triangles, vertices, context, welded.edges);
}

} // namespace bindpose
