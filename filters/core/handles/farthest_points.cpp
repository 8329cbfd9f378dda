// Farthest-point sampling (see farthest_points.h). The squared distance to the nearest chosen point
// is stored for each vertex. Each new point is the vertex with the largest distance.
#include "handles/farthest_points.h"

#include <limits>

namespace bindpose
{

namespace
{
std::vector<Index> used_vertices(Index vertex_count, TrianglesView triangles)
{
  std::vector<char> used(static_cast<std::size_t>(vertex_count), 0);
  for (Index k = 0; k < triangles.size(); ++k)
  {
    used[triangles.data()[k]] = 1;
  }
  std::vector<Index> ids;
  for (Index v = 0; v < vertex_count; ++v)
  {
    if (used[v])
    {
      ids.push_back(v);
    }
  }
  return ids;
}
} // namespace

Status farthest_points(ExecutionContext& context, PointsView points, TrianglesView triangles,
  Index count, std::vector<Index>& chosen)
{
  chosen.clear();
  if (count < 1)
  {
    return Status::invalid_input(
      "the number of handles must be at least 1, not " + std::to_string(count));
  }
  Status status = check_mesh(points, triangles);
  if (!status.ok())
  {
    return status;
  }
  const std::vector<Index> vertices = used_vertices(points.rows(), triangles);
  Vec3 centroid = Vec3::Zero();
  for (const Index v : vertices)
  {
    centroid += points.row(v).transpose() / static_cast<double>(vertices.size());
  }
  std::vector<double> distance(vertices.size(), std::numeric_limits<double>::infinity());
  Vec3 from = centroid;
  for (Index n = 0; n < count; ++n)
  {
    if (context.canceled())
    {
      return Status::canceled();
    }
    context.progress(static_cast<double>(n) / static_cast<double>(count));
    std::size_t best = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i)
    {
      const double squared = (points.row(vertices[i]).transpose() - from).squaredNorm();
      // The first pass measures distances to the centroid. The centroid is not a chosen point, so
      // the second pass overwrites these distances.
      distance[i] = n <= 1 ? squared : std::min(distance[i], squared);
      best = distance[i] > distance[best] ? i : best;
    }
    if (vertices.empty() || (n > 0 && !(distance[best] > 0.0)))
    {
      chosen.clear();
      return Status::invalid_input("the surface has only " + std::to_string(n) +
        " distinct vertices, fewer than the " + std::to_string(count) + " requested handles");
    }
    chosen.push_back(vertices[best]);
    from = points.row(vertices[best]).transpose();
  }
  return {};
}

} // namespace bindpose
