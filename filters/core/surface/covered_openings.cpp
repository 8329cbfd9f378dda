// Search for openings whose boundary lies on other parts of the surface (see covered_openings.h).
// The nearest triangle of another part is found in a tree of boxes.
#include "surface/covered_openings.h"

#include "base/constants.h"
#include "base/disjoint_sets.h"
#include "base/gather.h"
#include "base/parallel_sort.h"
#include "surface/triangle_predicates.h"
#include "surface/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace bindpose
{

namespace
{
struct BoundaryEdge
{
  Index a, b; ///< vertices, a < b
  Index triangle;
};

/// Maximum distance of an opening from the parts that cover it, as a fraction of the diagonal of
/// the opening's bounding box.
constexpr double maximum_gap = 1.0 / 50.0;

/// A connecting line from a sample of a boundary edge to the nearest point on another part.
struct SampleLink
{
  Index edge; ///< index of the boundary edge
  double distance; ///< length of the line; infinite: no other part is near, and `link` is unset
  PartLink link;
};

/// Find the edges with one triangle.
/// @return false if canceled.
bool find_boundary(
  ExecutionContext& context, TrianglesView triangles, std::vector<BoundaryEdge>& boundary)
{
  std::vector<BoundaryEdge> edges;
  edges.reserve(static_cast<std::size_t>(triangles.size()));
  for (Index f = 0; f < triangles.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index a = triangles(f, k), b = triangles(f, (k + 1) % 3);
      if (a != b)
      {
        edges.push_back({ std::min(a, b), std::max(a, b), f });
      }
    }
  }
  if (!parallel_sort(context, edges,
        [](const BoundaryEdge& e, const BoundaryEdge& f)
        { return std::tie(e.a, e.b) < std::tie(f.a, f.b); }))
  {
    return false;
  }
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end)
  {
    while (end < edges.size() && edges[end].a == edges[begin].a && edges[end].b == edges[begin].b)
    {
      ++end;
    }
    if (end == begin + 1)
    {
      boundary.push_back(edges[begin]);
    }
  }
  return true;
}

/// Return the distance of a point from a box, 0 in the box.
double distance(const Box& box, const Vec3& p)
{
  return (box.lower - p).cwiseMax(p - box.upper).cwiseMax(0.0).norm();
}

class OpeningFinder
{
public:
  OpeningFinder(PointsView points, TrianglesView triangles, const std::vector<Index>& parts,
    const PartLinkOptions& options)
    : points_(points), triangles_(triangles), parts_(parts), options_(options),
      tree_(points, triangles)
  {
  }

  bool run(ExecutionContext& context, CoveredOpenings& result)
  {
    std::vector<BoundaryEdge> boundary;
    if (!find_boundary(context, this->triangles_, boundary))
    {
      return false;
    }
    std::vector<SampleLink> samples;
    if (!gather(
          context, static_cast<Index>(boundary.size()), samples,
          [&](Index i, std::vector<SampleLink>& list) { this->link_edge(i, boundary[i], list); },
          16))
    {
      return false;
    }
    DisjointSets<Index> openings(static_cast<std::size_t>(this->points_.rows()));
    for (const BoundaryEdge& edge : boundary)
    {
      openings.unite(edge.a, edge.b);
    }
    // Compute the bounding box of each opening, and the largest distance of the opening's samples
    // from the other parts. An opening is identified by one of its vertices, which is the index of
    // the opening in `boxes` and `distances`. The entries of all other vertices in `distances` are
    // negative.
    std::vector<Box> boxes(static_cast<std::size_t>(this->points_.rows()));
    std::vector<double> distances(boxes.size(), -1.0);
    for (const BoundaryEdge& edge : boundary)
    {
      Box& box = boxes[openings.find(edge.a)];
      box.add(this->points_.row(edge.a));
      box.add(this->points_.row(edge.b));
    }
    for (const SampleLink& sample : samples)
    {
      double& largest = distances[openings.find(boundary[sample.edge].a)];
      largest = std::max(largest, sample.distance);
    }
    const auto is_covered = [&](Index opening)
    { return distances[opening] <= maximum_gap * boxes[opening].diagonal(); };
    for (Index v = 0; v < this->points_.rows(); ++v)
    {
      result.count += distances[v] >= 0.0 && is_covered(v) ? 1 : 0;
    }
    for (const SampleLink& sample : samples)
    {
      if (is_covered(openings.find(boundary[sample.edge].a)))
      {
        result.links.push_back(sample.link);
      }
    }
    return true;
  }

private:
  /// Compute the links at the samples of a boundary edge. End at the first sample that has no other
  /// part within `touch_distance`.
  void link_edge(Index index, const BoundaryEdge& edge, std::vector<SampleLink>& list) const
  {
    const Vec3 a = this->points_.row(edge.a), b = this->points_.row(edge.b);
    const auto steps = std::max(Index(1),
      static_cast<Index>(
        std::min(maximum_steps, std::ceil((b - a).norm() / this->options_.spacing))));
    for (Index k = 0; k <= steps; ++k)
    {
      const Vec3 position = a + static_cast<double>(k) / static_cast<double>(steps) * (b - a);
      SampleLink sample{ index, infinite, {} };
      sample.distance = this->link_point(edge.triangle, position, sample.link);
      list.push_back(sample);
      if (sample.distance == infinite)
      {
        return;
      }
    }
  }

  /// Connect a point of a triangle to the nearest point on another part. Return the distance of the
  /// two points, or infinity if all other parts are farther away than `touch_distance`.
  double link_point(Index triangle, const Vec3& position, PartLink& link) const
  {
    double limit = this->options_.touch_distance;
    const auto& nodes = this->tree_.nodes();
    std::vector<Index> stack{ 0 };
    while (!stack.empty())
    {
      const Index at = stack.back();
      stack.pop_back();
      const TriangleTree::Node& node = nodes[at];
      if (distance(node.box, position) > limit)
      {
        continue;
      }
      if (node.right >= 0)
      {
        stack.push_back(node.right);
        stack.push_back(at + 1);
        continue;
      }
      for (Index i = node.begin; i < node.end; ++i)
      {
        const Index g = this->tree_.order()[i];
        if (this->parts_[g] == this->parts_[triangle])
        {
          continue;
        }
        const Vec3 nearest = closest_point(position, this->points_.row(this->triangles_(g, 0)),
          this->points_.row(this->triangles_(g, 1)), this->points_.row(this->triangles_(g, 2)));
        const double d = (nearest - position).norm();
        if (d < limit || (d == limit && link.triangles[1] < 0))
        {
          limit = d;
          link.triangles = { triangle, g };
          link.positions = { position, nearest };
        }
      }
    }
    return link.triangles[1] >= 0 ? limit : infinite;
  }

  static constexpr double maximum_steps = 1000.0; ///< maximum number of sample intervals per edge

  PointsView points_;
  TrianglesView triangles_;
  const std::vector<Index>& parts_;
  const PartLinkOptions& options_;
  TriangleTree tree_;
};
} // namespace

Status find_covered_openings(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const std::vector<Index>& parts, const PartLinkOptions& options, CoveredOpenings& result)
{
  result = {};
  const Status valid = check_options(options);
  if (!valid.ok() || triangles.rows() == 0)
  {
    return valid;
  }
  return OpeningFinder(points, triangles, parts, options).run(context, result) ? Status()
                                                                               : Status::canceled();
}

} // namespace bindpose
