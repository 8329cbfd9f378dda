// Area of the Voronoi cell of each sample, clipped to a disc. A cell starts as the square around
// the disc and is cut by the bisector of each neighbor. Then the area of the intersection of the
// polygon and the disc is computed as a sum over the edges of the polygon. The part of an edge
// inside the disc contributes the triangle that it forms with the center of the disc. A part
// outside the disc contributes a circular sector.
#include "winding/point_areas.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
/// Keep the part of a convex polygon whose points p satisfy p . `direction` <= `limit`. `buffer` is
/// working memory.
void cut(std::vector<Vec2>& polygon, const Vec2& direction, double limit, std::vector<Vec2>& buffer)
{
  buffer.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[(i + 1) % polygon.size()];
    const double distance_a = a.dot(direction) - limit;
    const double distance_b = b.dot(direction) - limit;
    if (distance_a <= 0.0)
    {
      buffer.push_back(a);
    }
    if ((distance_a < 0.0 && distance_b > 0.0) || (distance_a > 0.0 && distance_b < 0.0))
    {
      buffer.push_back(a + (distance_a / (distance_a - distance_b)) * (b - a));
    }
  }
  polygon.swap(buffer);
}

/// Return the signed area of the intersection of the triangle 0, a, b with the disc around 0.
double triangle_in_disc(const Vec2& a, const Vec2& b, double radius)
{
  const auto sector = [radius](const Vec2& from, const Vec2& to)
  { return 0.5 * radius * radius * std::atan2(cross(from, to), from.dot(to)); };
  const Vec2 segment_vector = b - a;
  const double length = segment_vector.squaredNorm();
  const double half = -a.dot(segment_vector);
  const double root = half * half - length * (a.squaredNorm() - radius * radius);
  if (!(root > 0.0) || length == 0.0)
  {
    return sector(a, b);
  }
  const double enters = std::max(0.0, (half - std::sqrt(root)) / length);
  const double leaves = std::min(1.0, (half + std::sqrt(root)) / length);
  if (enters >= leaves)
  {
    return sector(a, b);
  }
  const Vec2 in = a + enters * segment_vector;
  const Vec2 out = a + leaves * segment_vector;
  return (enters > 0.0 ? sector(a, in) : 0.0) + 0.5 * cross(in, out) +
    (leaves < 1.0 ? sector(out, b) : 0.0);
}

/// Working memory of one thread.
struct Scratch
{
  std::vector<PointTree::Neighbor> neighbors;
  std::vector<Vec2> polygon, buffer;
};

double voronoi_area(const Points& points, const Points& normals, PointTree::Id point,
  double tolerance, Scratch& scratch)
{
  const Vec3 normal = normals.row(point);
  if (scratch.neighbors.empty() || normal.isZero(0.0))
  {
    return 0.0;
  }
  const double radius = 0.5 * std::sqrt(scratch.neighbors.back().squared_distance);
  if (2.0 * radius <= tolerance)
  {
    return 0.0;
  }
  const Vec3 right = normal.unitOrthogonal();
  const Vec3 up = normal.cross(right);
  scratch.polygon = { { -radius, -radius }, { radius, -radius }, { radius, radius },
    { -radius, radius } };
  int coincident_count = 1;
  for (const PointTree::Neighbor& neighbor : scratch.neighbors)
  {
    if (normal.dot(normals.row(neighbor.point)) < 0.0)
    {
      continue;
    }
    const double distance = std::sqrt(neighbor.squared_distance);
    if (distance <= tolerance)
    {
      ++coincident_count;
      continue;
    }
    const Vec3 offset = (points.row(neighbor.point) - points.row(point)).transpose();
    const Vec2 projected(offset.dot(right), offset.dot(up));
    const double length = projected.norm();
    constexpr double minimum_projection = 1e-9;
    if (length > minimum_projection * distance)
    {
      cut(scratch.polygon, projected / length, 0.5 * distance, scratch.buffer);
    }
  }
  double area = 0.0;
  for (std::size_t i = 0; i < scratch.polygon.size(); ++i)
  {
    area += triangle_in_disc(
      scratch.polygon[i], scratch.polygon[(i + 1) % scratch.polygon.size()], radius);
  }
  return area / coincident_count;
}
} // namespace

bool estimate_point_areas(ExecutionContext& context, const Points& points, const Points& normals,
  const PointTree& tree, Index neighbors, double tolerance, Eigen::VectorXd& areas)
{
  areas.setZero(points.rows());
  constexpr Index block = 512;
  return parallel_for(context, points.rows(), block,
    [&](Index begin, Index end)
    {
      Scratch scratch;
      for (Index i = begin; i < end; ++i)
      {
        // Points are processed in tree order, so that consecutive searches visit the same boxes.
        const PointTree::Id point = tree.order()[i];
        tree.nearest(points, point, neighbors, scratch.neighbors);
        areas[point] = voronoi_area(points, normals, point, tolerance, scratch);
      }
    });
}

} // namespace bindpose
