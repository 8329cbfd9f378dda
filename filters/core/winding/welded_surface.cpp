// Merging of equal points, and counts of edges and duplicate triangles.
//
// Vertices are sorted by coordinates: a radix sort by the leading bits of x, then a comparison sort
// of the few vertices that share these bits. Edges and triangles are packed into 64-bit integers,
// grouped by their smallest vertex id, and sorted within these small groups.
#include "winding/welded_surface.h"

#include "base/large_pages.h"
#include "base/parallel_sort.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>

namespace bindpose
{

namespace
{
/// Report whether the corners are collinear to double precision.
bool is_flat(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  return u.cross(v).norm() <= 1e-15 * u.norm() * v.norm();
}

struct Vertex
{
  std::uint32_t key; ///< leading bits of x, which ascend with x
  std::int32_t id;
};

/// Return the leading 32 bits of a finite number, mapped so that they ascend with the number.
std::uint32_t leading_bits(double x)
{
  const double positive_zero = x + 0.0;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &positive_zero, sizeof(bits));
  const auto leading = static_cast<std::uint32_t>(bits >> 32);
  return leading & 0x80000000U ? ~leading : leading | 0x80000000U;
}

/// Sort vertices by x, y, z and id. `positions` contains the point of each vertex id. Return false
/// if canceled.
bool sort_vertices(
  ExecutionContext& context, const std::vector<Vec3>& positions, std::vector<Vertex>& vertices)
{
  constexpr int bits = 11;
  constexpr std::uint32_t digits = 1U << bits;
  std::vector<Vertex> other(vertices.size());
  for (int shift = 0; shift < 32; shift += bits)
  {
    std::array<std::size_t, digits> next{};
    const auto digit = [&](const Vertex& v) { return v.key >> shift & (digits - 1); };
    for (const Vertex& v : vertices)
    {
      next[digit(v)] += 1;
    }
    std::size_t sum = 0;
    for (std::size_t& n : next)
    {
      sum += std::exchange(n, sum);
    }
    for (const Vertex& v : vertices)
    {
      other[next[digit(v)]++] = v;
    }
    vertices.swap(other);
    if (context.canceled())
    {
      return false;
    }
  }
  const auto less = [&](const Vertex& s, const Vertex& t)
  {
    const Vec3& a = positions[s.id];
    const Vec3& b = positions[t.id];
    for (int k = 0; k < 3; ++k)
    {
      if (a[k] != b[k])
      {
        return a[k] < b[k];
      }
    }
    return s.id < t.id;
  };
  constexpr std::size_t parallel_group_size = 1 << 14;
  for (std::size_t first = 0, last = 0; first < vertices.size(); first = last)
  {
    while (last < vertices.size() && vertices[last].key == vertices[first].key)
    {
      ++last;
    }
    const auto begin = vertices.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = vertices.begin() + static_cast<std::ptrdiff_t>(last);
    if (last - first < parallel_group_size)
    {
      std::sort(begin, end, less);
      continue;
    }
    std::vector<Vertex> group(begin, end);
    if (!parallel_sort(context, group, less))
    {
      return false;
    }
    std::copy(group.begin(), group.end(), begin);
  }
  return true;
}

/// Pack two vertex ids into one integer, so that the integers are sorted by the first id, then by
/// the second.
std::uint64_t packed(Index first, Index second)
{
  return static_cast<std::uint64_t>(first) << 32 | static_cast<std::uint64_t>(second);
}

/// Group items by vertex: the items of vertex v become items[begin[v] … begin[v + 1]), sorted in
/// ascending order. `visit(emit)` must call emit(vertex, item) for all items, in any order.
/// group_by_vertex() calls `visit` twice. Return false if canceled.
template <typename Visit>
bool group_by_vertex(ExecutionContext& context, Index vertices, const Visit& visit,
  std::vector<Index>& begin, std::vector<std::uint64_t>& items)
{
  begin.assign(static_cast<std::size_t>(vertices) + 1, 0);
  visit([&](Index vertex, std::uint64_t) { begin[vertex + 1] += 1; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  if (context.canceled())
  {
    return false;
  }
  reserve_in_large_pages(items, static_cast<std::size_t>(begin.back()));
  items.resize(static_cast<std::size_t>(begin.back()));
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  visit([&](Index vertex, std::uint64_t item) { items[next[vertex]++] = item; });
  return parallel_for(context, vertices, 16384,
    [&](Index first, Index last)
    {
      for (Index v = first; v < last; ++v)
      {
        std::sort(items.begin() + begin[v], items.begin() + begin[v + 1]);
      }
    });
}

bool weld(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const ExactFrame& frame, WeldedSurface& welded)
{
  std::vector<char> used(static_cast<std::size_t>(points.rows()), 0);
  for (Index k = 0; k < triangles.size(); ++k)
  {
    used[triangles.data()[k]] = 1;
  }
  std::vector<Vertex> vertices;
  std::vector<Vec3> positions(static_cast<std::size_t>(points.rows()));
  for (Index v = 0; v < points.rows(); ++v)
  {
    if (used[v])
    {
      positions[v] = frame(points.row(v));
      vertices.push_back({ leading_bits(positions[v].x()), static_cast<std::int32_t>(v) });
    }
  }
  if (!sort_vertices(context, positions, vertices))
  {
    return false;
  }
  std::vector<Index> id_of(static_cast<std::size_t>(points.rows()), -1);
  Index count = 0;
  welded.points.resize(static_cast<Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    const Vec3& position = positions[vertices[i].id];
    if (i == 0 || position != positions[vertices[i - 1].id])
    {
      welded.points.row(count++) = position.transpose();
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
    // A flat triangle has no solid angle. It is kept because its edges cancel those of its
    // neighbors.
    welded.degenerate_triangles +=
      is_flat(welded.points.row(ids[0]), welded.points.row(ids[1]), welded.points.row(ids[2]));
    welded.triangles.row(kept++) << ids[0], ids[1], ids[2];
  }
  welded.triangles.conservativeResize(kept, 3);
  return true;
}

/// Count the triangles with the same corners as an earlier triangle. Return false if canceled.
bool count_duplicates(
  ExecutionContext& context, const Triangles& triangles, Index vertices, Index& duplicates)
{
  std::vector<Index> begin;
  // The two larger corner ids of each triangle, packed in ascending order.
  std::vector<std::uint64_t> other_corners;
  const auto visit = [&](const auto& emit)
  {
    for (Index t = 0; t < triangles.rows(); ++t)
    {
      const Index a = triangles(t, 0), b = triangles(t, 1), c = triangles(t, 2);
      const Index least = std::min({ a, b, c }), most = std::max({ a, b, c });
      emit(least, packed(a + b + c - least - most, most));
    }
  };
  if (!group_by_vertex(context, vertices, visit, begin, other_corners))
  {
    return false;
  }
  for (Index v = 0; v < vertices; ++v)
  {
    for (Index i = begin[v] + 1; i < begin[v + 1]; ++i)
    {
      duplicates += other_corners[i] == other_corners[i - 1];
    }
  }
  return true;
}

/// Count the edges. Find the open edges, which the triangles do not use equally often in both
/// directions. Return false if canceled.
bool find_edges(
  ExecutionContext& context, const Triangles& triangles, Index vertices, WeldedSurface& welded)
{
  std::vector<Index> begin;
  // One entry per triangle side, grouped by the smaller vertex id of the side. An entry packs the
  // larger vertex id and a flag, which is 1 if the side points to the larger id.
  std::vector<std::uint64_t> sides;
  const auto visit = [&](const auto& emit)
  {
    for (Index t = 0; t < triangles.rows(); ++t)
    {
      for (int k = 0; k < 3; ++k)
      {
        const Index from = triangles(t, k);
        const Index to = triangles(t, (k + 1) % 3);
        emit(std::min(from, to), packed(std::max(from, to), from < to ? 1 : 0));
      }
    }
  };
  if (!group_by_vertex(context, vertices, visit, begin, sides))
  {
    return false;
  }
  for (Index v = 0; v < vertices; ++v)
  {
    for (Index i = begin[v]; i < begin[v + 1];)
    {
      Edge edge;
      edge.a = v;
      edge.b = static_cast<Index>(sides[i] >> 32);
      for (; i < begin[v + 1] && static_cast<Index>(sides[i] >> 32) == edge.b; ++i)
      {
        edge.triangle_count += 1;
        edge.net_direction += sides[i] & 1 ? 1 : -1;
      }
      welded.boundary_edges += edge.triangle_count == 1;
      welded.nonmanifold_edges += edge.triangle_count > 2;
      if (edge.net_direction != 0)
      {
        welded.open_edges.push_back(edge);
      }
    }
  }
  return true;
}
} // namespace

bool weld_surface(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const ExactFrame& frame, WeldedSurface& welded)
{
  {
    const ProgressRange range(context, 0.0, 0.5);
    if (!weld(context, points, triangles, frame, welded))
    {
      return false;
    }
  }
  const Index vertices = welded.points.rows();
  {
    const ProgressRange range(context, 0.5, 0.65);
    if (!count_duplicates(context, welded.triangles, vertices, welded.duplicate_triangles))
    {
      return false;
    }
  }
  const ProgressRange range(context, 0.65, 1.0);
  return find_edges(context, welded.triangles, vertices, welded);
}

} // namespace bindpose
