// Finds silhouette edges. Triangles are adjacent if they share an edge, which is identified by the
// positions of its ends. If more than two triangles share an edge, each of them is adjacent only to
// the previous and the next one in the order of triangle ids.
#include "shapes/silhouette.h"

#include "base/parallel.h"
#include "geometry/triangle_sides.h"
#include "surface/vertex_order.h"

#include <algorithm>

namespace bindpose
{

Silhouette::Silhouette(PointsView points, TrianglesView triangles) : triangles_(triangles)
{
  const std::vector<char> all(static_cast<std::size_t>(points.rows()), 1);
  const std::vector<Index> representative = find_representatives(points, all);
  const Triangles joined =
    triangles.unaryExpr([&](Index v) { return representative[static_cast<std::size_t>(v)]; });
  const std::vector<TriangleSide> sides = sides_by_edge(joined);
  this->sides_.reserve(sides.size() / 2 + 1);
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end)
  {
    end = end_of_edge(sides, begin);
    if (sides[begin].a == sides[begin].b)
    {
      continue;
    }
    for (std::size_t k = begin; k + 1 < end || k == begin; ++k)
    {
      const TriangleSide& side = sides[k];
      const std::array<int, 2> ends{ static_cast<int>(triangles(side.triangle, side.corner)),
        static_cast<int>(triangles(side.triangle, (side.corner + 1) % 3)) };
      const bool is_boundary = k + 1 == end;
      this->sides_.push_back({ ends, static_cast<int>(side.triangle),
        is_boundary ? -1 : static_cast<int>(sides[k + 1].triangle),
        !is_boundary && side.forward == sides[k + 1].forward });
    }
  }
  this->facing_.resize(static_cast<std::size_t>(triangles.rows()));
}

void Silhouette::find(PointsView points, const Eye& eye, std::vector<Edge>& edges)
{
  const double* position = points.data();
  const auto point = [position](Index v) { return Eigen::Map<const Vec3>(position + 3 * v); };
  ExecutionContext context;
  parallel_for(context, this->triangles_.rows(), 8192,
    [&](Index begin, Index end)
    {
      for (Index t = begin; t < end; ++t)
      {
        const auto a = point(this->triangles_(t, 0));
        const Vec3 normal =
          (point(this->triangles_(t, 1)) - a).cross(point(this->triangles_(t, 2)) - a);
        const double toward =
          eye.parallel ? -normal.dot(eye.direction) : normal.dot(eye.position - a);
        this->facing_[static_cast<std::size_t>(t)] = toward >= 0.0 ? 1 : -1;
      }
    });
  constexpr Index block = 8192;
  const auto count = static_cast<Index>(this->sides_.size());
  std::vector<std::vector<Edge>> found(static_cast<std::size_t>((count + block - 1) / block));
  parallel_for(context, count, block,
    [&](Index begin, Index end)
    {
      std::vector<Edge>& block_edges = found[static_cast<std::size_t>(begin / block)];
      for (Index k = begin; k < end; ++k)
      {
        const Side& side = this->sides_[static_cast<std::size_t>(k)];
        const int one = this->facing_[static_cast<std::size_t>(side.triangle)];
        const int other = side.other < 0 ? -one
          : side.same_direction          ? -this->facing_[static_cast<std::size_t>(side.other)]
                                         : this->facing_[static_cast<std::size_t>(side.other)];
        if (one != other)
        {
          block_edges.push_back({ side.points[0], side.points[1] });
        }
      }
    });
  edges.clear();
  for (const std::vector<Edge>& block_edges : found)
  {
    edges.insert(edges.end(), block_edges.begin(), block_edges.end());
  }
}

} // namespace bindpose
