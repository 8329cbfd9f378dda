// Farthest-point sampling of a surface (see spread_points.h). For each vertex, the distance to the
// nearest chosen point of its component is stored. The next point is the vertex with the largest
// distance. With distances along edges, a new point only changes the distances of vertices that are
// nearer to this point than to all other points. Therefore Dijkstra's algorithm starts at the new
// point and does not continue from vertices whose distance it cannot reduce.
#include "automatic/spread_points.h"

#include "base/constants.h"
#include "base/range_check.h"
#include "surface/surface_probe.h"
#include "surface/vertex_order.h"
#include "winding/winding_number.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace bindpose
{

const char* to_string(PointDistance distance)
{
  return distance == PointDistance::straight ? "straight" : "along-edges";
}

namespace
{
struct Component
{
  std::vector<Index> vertices;
  double area = 0.0;
  Index points = 0;
  bool is_exhausted = false; ///< whether every vertex of the component is chosen
};

class PointSpreader
{
public:
  PointSpreader(ExecutionContext& context, PointsView points, TrianglesView triangles,
    const SpreadPointsOptions& options)
    : points_(points), triangles_(triangles), options_(options), context_(context)
  {
  }

  Status build()
  {
    this->find_components();
    this->distance_.assign(static_cast<std::size_t>(this->points_.rows()), infinite);
    if (this->options_.distance == PointDistance::along_edges)
    {
      this->find_neighbors();
    }
    if (!this->options_.inside)
    {
      return {};
    }
    this->find_normals();
    this->diagonal_ = bounding_box(this->points_, this->triangles_).diagonal();
    return this->winding_.build(this->context_, this->points_, this->triangles_);
  }

  Status choose_points(SpreadPoints& result)
  {
    result.components = static_cast<Index>(this->components_.size());
    const SurfaceProbe probe(this->points_, this->triangles_);
    std::vector<Vec3> positions;
    for (Index n = 0; n < this->options_.count; ++n)
    {
      this->context_.progress(static_cast<double>(n) / static_cast<double>(this->options_.count));
      Index vertex = -1;
      Component* component = nullptr;
      while (vertex < 0)
      {
        component = this->next_component();
        if (!component)
        {
          return Status::invalid_input("the surface has only " + std::to_string(n) +
            " distinct vertices, fewer than the " + std::to_string(this->options_.count) +
            " requested points");
        }
        vertex = this->farthest(*component);
        component->is_exhausted = vertex < 0;
      }
      ++component->points;
      result.covered_components += component->points == 1 ? 1 : 0;
      Vec3 position = this->points_.row(vertex);
      std::vector<std::pair<double, Index>> near_vertices{ { 0.0, vertex } };
      double depth = 0.0;
      if (this->options_.inside && this->move_inside(probe, vertex, positions, position, depth))
      {
        ++result.inside;
        this->add_vertices_near(*component, position, 2.0 * depth, near_vertices);
      }
      if (!this->update(*component, position, std::move(near_vertices)))
      {
        return Status::canceled();
      }
      positions.push_back(position);
      result.vertices.push_back(vertex);
    }
    result.positions.resize(static_cast<Index>(positions.size()), 3);
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      result.positions.row(static_cast<Index>(i)) = positions[i].transpose();
    }
    return {};
  }

private:
  void find_components()
  {
    // Weld vertices with equal, finite coordinates, including vertices that no triangle uses.
    std::vector<char> finite(static_cast<std::size_t>(this->points_.rows()));
    for (Index v = 0; v < this->points_.rows(); ++v)
    {
      finite[static_cast<std::size_t>(v)] = this->points_.row(v).allFinite();
    }
    const std::vector<Index> welded_ids = find_representatives(this->points_, finite);
    this->welded_ = this->triangles_;
    for (Index k = 0; k < this->welded_.size(); ++k)
    {
      this->welded_.data()[k] = welded_ids[this->welded_.data()[k]];
    }
    const Components parts =
      connected_components(this->points_.rows(), TrianglesView(this->welded_));
    this->components_.resize(static_cast<std::size_t>(parts.count));
    for (Index v = 0; v < this->points_.rows(); ++v)
    {
      if (parts.component_of_vertex[v] >= 0)
      {
        this->components_[parts.component_of_vertex[v]].vertices.push_back(v);
      }
    }
    for (Index f = 0; f < this->welded_.rows(); ++f)
    {
      const Vec3 a = this->points_.row(this->welded_(f, 0));
      const Vec3 b = this->points_.row(this->welded_(f, 1));
      const Vec3 c = this->points_.row(this->welded_(f, 2));
      this->components_[parts.component_of_vertex[this->welded_(f, 0)]].area +=
        0.5 * (b - a).cross(c - a).norm();
    }
    for (const Component& component : this->components_)
    {
      this->largest_area_ = std::max(this->largest_area_, component.area);
    }
  }

  void find_neighbors()
  {
    this->neighbors_.resize(static_cast<std::size_t>(this->points_.rows()));
    for (const Edge& edge : mesh_edges(this->welded_))
    {
      this->neighbors_[edge.a].push_back(edge.b);
      this->neighbors_[edge.b].push_back(edge.a);
    }
  }

  void find_normals()
  {
    this->normals_ = Points::Zero(this->points_.rows(), 3);
    for (Index f = 0; f < this->welded_.rows(); ++f)
    {
      const Vec3 a = this->points_.row(this->welded_(f, 0));
      const Vec3 b = this->points_.row(this->welded_(f, 1));
      const Vec3 c = this->points_.row(this->welded_(f, 2));
      const Vec3 normal = (b - a).cross(c - a);
      for (int k = 0; k < 3; ++k)
      {
        this->normals_.row(this->welded_(f, k)) += normal.transpose();
      }
    }
  }

  /// Return the component that gets the next point. First, each component that is not tiny gets one
  /// point. Then points are assigned by area. Return null if every vertex of every component is
  /// chosen.
  Component* next_component()
  {
    constexpr double minimum_area_fraction = 0.01;
    Component* best = nullptr;
    double maximum = -1.0;
    bool best_has_no_points = false;
    for (Component& component : this->components_)
    {
      if (component.is_exhausted)
      {
        continue;
      }
      const bool first =
        component.points == 0 && component.area >= minimum_area_fraction * this->largest_area_;
      const double area_per_point = component.area / static_cast<double>(component.points + 1);
      if ((first && !best_has_no_points) ||
        (first == best_has_no_points && area_per_point > maximum))
      {
        best = &component;
        maximum = area_per_point;
        best_has_no_points = first;
      }
    }
    return best;
  }

  /// Return the vertex of a component that is farthest from the component's points. If there are no
  /// points yet, return the vertex farthest from the centroid. Return -1 if all vertices are
  /// chosen.
  Index farthest(const Component& component) const
  {
    Vec3 centroid = Vec3::Zero();
    const bool first = component.points == 0;
    for (const Index v : component.vertices)
    {
      if (first)
      {
        centroid +=
          this->points_.row(v).transpose() / static_cast<double>(component.vertices.size());
      }
    }
    Index best = -1;
    double maximum = first ? -1.0 : 0.0;
    for (const Index v : component.vertices)
    {
      const double distance =
        first ? (this->points_.row(v).transpose() - centroid).norm() : this->distance_[v];
      if (distance > maximum)
      {
        maximum = distance;
        best = v;
      }
    }
    return best;
  }

  bool is_inside(const Vec3& p) const
  {
    return this->winding_.evaluate_at(p) >= this->options_.winding_threshold;
  }

  /// Move a point from its vertex into the middle of the shape, unless another point is already at
  /// the new position. Return whether the point was moved.
  /// @param depth set to the distance of the moved point from the surface.
  bool move_inside(const SurfaceProbe& probe, Index vertex, const std::vector<Vec3>& earlier_points,
    Vec3& position, double& depth) const
  {
    // The inside is tested at two points, one on each side of the surface, at this distance from
    // the vertex (in bounding-box diagonals).
    constexpr double test_distance = 1e-5;
    const Vec3 from = position;
    Vec3 direction = -this->normals_.row(vertex).transpose();
    if (!(direction.norm() > 0.0))
    {
      return false;
    }
    direction.normalize();
    const double step = test_distance * this->diagonal_;
    if (!this->is_inside(from + step * direction))
    {
      direction = -direction; // the surface is inside out at this vertex
      if (!this->is_inside(from + step * direction))
      {
        return false;
      }
    }
    // Find the distance at which the ray leaves the shape.
    const Vec3 origin = from + step * direction;
    double end = this->diagonal_;
    double last = 0.0;
    for (const SurfaceProbe::Hit& hit : probe.hits(origin, direction))
    {
      if (!this->is_inside(origin + 0.5 * (last + hit.distance) * direction))
      {
        break;
      }
      last = end = hit.distance;
    }
    const auto depth_at = [&](double t)
    {
      const Vec3 p = origin + t * direction;
      Vec3 nearest = p;
      probe.nearest(p, nearest);
      return (p - nearest).norm();
    };
    constexpr int steps = 64;
    constexpr double least_gain = 0.3;
    const double h = 0.5 * end / steps;
    double best = h;
    depth = depth_at(h);
    for (int i = 2; i <= steps; ++i)
    {
      const double next_depth = depth_at(i * h);
      if (next_depth - depth < least_gain * h)
      {
        break;
      }
      best = i * h;
      depth = next_depth;
    }
    const Vec3 inner = origin + best * direction;
    constexpr double duplicate_distance = 1e-6;
    const bool free = std::none_of(earlier_points.begin(), earlier_points.end(),
      [&](const Vec3& other)
      { return (other - inner).norm() <= duplicate_distance * this->diagonal_; });
    if (!free || !this->is_inside(inner))
    {
      return false;
    }
    position = inner;
    return true;
  }

  void add_vertices_near(const Component& component, const Vec3& position, double reach,
    std::vector<std::pair<double, Index>>& near_vertices) const
  {
    for (const Index v : component.vertices)
    {
      const double distance = (this->points_.row(v).transpose() - position).norm();
      if (distance <= reach)
      {
        near_vertices.emplace_back(distance, v);
      }
    }
  }

  /// Update the distances of the component's vertices for a new point.
  /// @return false if canceled.
  bool update(const Component& component, const Vec3& position,
    std::vector<std::pair<double, Index>> near_vertices)
  {
    if (this->options_.distance == PointDistance::straight)
    {
      for (const Index v : component.vertices)
      {
        this->distance_[v] =
          std::min(this->distance_[v], (this->points_.row(v).transpose() - position).norm());
      }
      this->distance_[near_vertices.front().second] = 0.0;
      return !this->context_.canceled();
    }
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto relax = [&](double distance, Index v)
    {
      if (distance < this->distance_[v])
      {
        this->distance_[v] = distance;
        open.emplace(distance, v);
      }
    };
    for (const auto& [distance, v] : near_vertices)
    {
      relax(distance, v);
    }
    constexpr Index report_interval = 4096;
    for (Index count = 1; !open.empty(); ++count)
    {
      if (count % report_interval == 0 && this->context_.canceled())
      {
        return false;
      }
      const auto [distance, v] = open.top();
      open.pop();
      if (distance > this->distance_[v])
      {
        continue;
      }
      for (const Index w : this->neighbors_[v])
      {
        relax(distance + (this->points_.row(v) - this->points_.row(w)).norm(), w);
      }
    }
    return !this->context_.canceled();
  }

  PointsView points_;
  TrianglesView triangles_;
  const SpreadPointsOptions& options_;
  ExecutionContext& context_;
  Triangles welded_;
  std::vector<Component> components_;
  double largest_area_ = 0.0;
  double diagonal_ = 0.0;
  std::vector<std::vector<Index>> neighbors_;
  Points normals_;
  std::vector<double> distance_;
  WindingNumber winding_;
};
} // namespace

Status spread_points(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const SpreadPointsOptions& options, SpreadPoints& result)
{
  result = SpreadPoints();
  if (options.count < 1)
  {
    return Status::invalid_input(
      "the number of points must be at least 1, not " + std::to_string(options.count));
  }
  Status status = check_positive("winding_threshold", options.winding_threshold);
  if (status.ok())
  {
    status = check_mesh(points, triangles);
  }
  if (!status.ok())
  {
    return status;
  }
  PointSpreader spreader(context, points, triangles, options);
  {
    const Phase phase(context, "build", 0.0, 0.3);
    status = spreader.build();
  }
  if (!status.ok())
  {
    return status;
  }
  const Phase phase(context, "choose", 0.3, 1.0);
  status = spreader.choose_points(result);
  if (!status.ok())
  {
    result = SpreadPoints();
  }
  return status;
}

} // namespace bindpose
