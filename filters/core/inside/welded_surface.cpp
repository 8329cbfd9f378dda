// Vertices are sorted by their coordinates and triangles by their corners, so that equal ones stand
// side by side; the same is done with the edges.
#include "inside/welded_surface.h"

#include "base/parallel_sort.h"

#include <algorithm>
#include <array>

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
  {
    const ProgressRange range(context, 0.0, 0.6);
    if (!parallel_sort(context, vertices,
          [](const Vertex& x, const Vertex& y)
          {
            return std::lexicographical_compare(
              x.at.data(), x.at.data() + 3, y.at.data(), y.at.data() + 3);
          }))
    {
      return false;
    }
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
  std::vector<std::array<Index, 3>> corners;
  corners.reserve(static_cast<std::size_t>(triangles.rows()));
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    std::array<Index, 3> ids{ id_of[triangles(t, 0)], id_of[triangles(t, 1)],
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
    std::sort(ids.begin(), ids.end());
    corners.push_back(ids);
  }
  welded.triangles.conservativeResize(kept, 3);
  {
    const ProgressRange range(context, 0.6, 1.0);
    if (!parallel_sort(context, corners, std::less<>()))
    {
      return false;
    }
  }
  for (std::size_t i = 1; i < corners.size(); ++i)
  {
    welded.duplicate_triangles += corners[i] == corners[i - 1];
  }
  return true;
}

/// mesh_edges(), but on all threads and cancellable.
bool find_edges(const Triangles& triangles, ExecutionContext& context, std::vector<Edge>& edges)
{
  edges.clear();
  edges.reserve(static_cast<std::size_t>(triangles.rows()) * 3);
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index from = triangles(t, k);
      const Index to = triangles(t, (k + 1) % 3);
      edges.push_back({ std::min(from, to), std::max(from, to), 1, from < to ? 1 : -1 });
    }
  }
  if (!parallel_sort(context, edges,
        [](const Edge& x, const Edge& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; }))
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
  const ProgressRange range(context, 0.5, 1.0);
  return find_edges(welded.triangles, context, welded.edges);
}

} // namespace bindpose
