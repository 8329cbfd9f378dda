// Approximate geodesic distances around a point (see surface_disc.h). Vertices are processed in the
// order of Dijkstra's algorithm. The distance of a vertex c is the minimum of two values: along an
// edge, and through a triangle a b c whose vertices a and b have distances. For the second value,
// the source is mapped to the triangle's plane, on the side of ab that does not contain c. The
// mapped source is an intersection of two circles: their centers are a and b, and their radii are
// the distances of a and b. If the straight line from the mapped source to c crosses ab, the length
// of the line is the distance through the triangle. (M. Novotni and R. Klein, "Computing geodesic
// distances on triangular meshes", 2002.)
#include "surface/surface_disc.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

namespace bindpose
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
} // namespace

SurfaceDisc::SurfaceDisc(PointsView points, TrianglesView triangles)
  : points_(points), triangles_(triangles)
{
  const auto count = static_cast<std::size_t>(points.rows());
  this->first_.assign(count + 1, 0);
  for (Index f = 0; f < triangles.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      ++this->first_[static_cast<std::size_t>(triangles(f, k)) + 1];
    }
  }
  for (std::size_t v = 0; v < count; ++v)
  {
    this->first_[v + 1] += this->first_[v];
  }
  this->vertex_triangles_.resize(static_cast<std::size_t>(3 * triangles.rows()));
  std::vector<Index> next(this->first_.begin(), this->first_.end() - 1);
  for (Index f = 0; f < triangles.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->vertex_triangles_[static_cast<std::size_t>(
        next[static_cast<std::size_t>(triangles(f, k))]++)] = f;
    }
  }
  this->distance_.assign(count, infinity);
  this->done_.assign(count, 0);
}

double SurfaceDisc::propagated_distance(Index a, Index b, Index c) const
{
  const Vec3 pa = this->points_.row(a);
  const Vec3 pb = this->points_.row(b);
  const Vec3 pc = this->points_.row(c);
  const double da = this->distance_[static_cast<std::size_t>(a)];
  const double db = this->distance_[static_cast<std::size_t>(b)];
  const double along_edge = std::min(da + (pc - pa).norm(), db + (pc - pb).norm());
  const double length = (pb - pa).norm();
  if (!(length > 0.0) || !std::isfinite(da + db))
  {
    return along_edge;
  }
  // Coordinates in the triangle's plane: a is the origin and b is (length, 0). c is above the line
  // ab, and the source is below the line.
  const Vec3 u = (pb - pa) / length;
  const double cx = u.dot(pc - pa);
  const double cy = (pc - pa - cx * u).norm();
  const double sx = (da * da - db * db + length * length) / (2.0 * length);
  const double sy2 = da * da - sx * sx;
  if (sy2 < 0.0 || cy == 0.0)
  {
    // The circles do not intersect (because of rounding or a path around a corner), or c is on the
    // line ab. Only the distance along an edge can then be used.
    return along_edge;
  }
  const double sy = std::sqrt(sy2);
  const double crossing = sx + (cx - sx) * sy / (sy + cy);
  if (crossing < 0.0 || crossing > length)
  {
    return along_edge;
  }
  return std::min(along_edge, std::hypot(cx - sx, cy + sy));
}

std::vector<SurfaceDisc::VertexDistance> SurfaceDisc::within(
  const Vec3& point, Index triangle, double radius) const
{
  std::vector<VertexDistance> found;
  if (triangle < 0 || triangle >= this->triangles_.rows() || !point.allFinite())
  {
    return found;
  }
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<Index> visited_vertices;
  const auto relax_distance = [&](Index vertex, double distance)
  {
    double& current = this->distance_[static_cast<std::size_t>(vertex)];
    if (distance <= radius && distance < current && !this->done_[static_cast<std::size_t>(vertex)])
    {
      if (current == infinity)
      {
        visited_vertices.push_back(vertex);
      }
      current = distance;
      queue.emplace(distance, vertex);
    }
  };
  for (int k = 0; k < 3; ++k)
  {
    const Index vertex = this->triangles_(triangle, k);
    relax_distance(vertex, (Vec3(this->points_.row(vertex)) - point).norm());
  }
  while (!queue.empty())
  {
    const auto [distance, vertex] = queue.top();
    queue.pop();
    const auto v = static_cast<std::size_t>(vertex);
    if (this->done_[v] || distance > this->distance_[v])
    {
      continue;
    }
    this->done_[v] = 1;
    found.emplace_back(vertex, distance);
    for (Index i = this->first_[v]; i < this->first_[v + 1]; ++i)
    {
      const auto t = this->triangles_.row(this->vertex_triangles_[static_cast<std::size_t>(i)]);
      for (int k = 0; k < 3; ++k)
      {
        const Index other = t[k];
        const Index third = t[0] + t[1] + t[2] - vertex - other;
        if (other != vertex && third != vertex && third != other)
        {
          relax_distance(other, this->propagated_distance(vertex, third, other));
        }
      }
    }
  }
  // Sort the vertices by distance. The order in which they were found can differ slightly, because
  // a path through an obtuse triangle can be shorter than a path that was found earlier.
  std::sort(found.begin(), found.end(),
    [](const VertexDistance& a, const VertexDistance& b)
    { return a.second != b.second ? a.second < b.second : a.first < b.first; });
  for (const Index vertex : visited_vertices)
  {
    this->distance_[static_cast<std::size_t>(vertex)] = infinity;
    this->done_[static_cast<std::size_t>(vertex)] = 0;
  }
  return found;
}

} // namespace bindpose
