// Dihedral angles, validity checks and cleanup of tet meshes. Small angles that the boundary
// triangles force are counted separately.
#include "tets/tet_quality.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/sort_unique.h"
#include "geometry/triangle_sides.h"
#include "surface/triangle_predicates.h"
#include "surface/triangle_shape.h"
#include "surface/triangle_tree.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

double min_dihedral_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  // A dihedral angle is 180 degrees minus the angle between the outward normals of its two facets.
  const std::array<Vec3, 4> normals{ (c - b).cross(d - b), (d - a).cross(c - a),
    (b - a).cross(d - a), (c - a).cross(b - a) };
  const std::array<Vec3, 4> corners{ a, b, c, d };
  const double volume = std::abs((b - a).cross(c - a).dot(d - a)); // six times the volume
  constexpr double nearly_one = 0.9999;
  double largest_cosine = -1.0;
  // Smallest sine of the dihedral angles whose cosine is above `nearly_one`. The cosine of such a
  // small angle is too close to 1 to determine the angle accurately.
  double smallest_sine = 1.0;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < i; ++j)
    {
      const double lengths = normals[i].norm() * normals[j].norm();
      if (!(lengths > 0.0))
      {
        return 0.0;
      }
      const double cosine = -normals[i].dot(normals[j]) / lengths;
      largest_cosine = std::max(largest_cosine, cosine);
      if (cosine > nearly_one)
      {
        const int k = i != 0 && j != 0 ? 0 : (i != 1 && j != 1 ? 1 : 2);
        const int l = 6 - i - j - k; // the edge k-l is between facets i and j
        smallest_sine =
          std::min(smallest_sine, volume * (corners[l] - corners[k]).norm() / lengths);
      }
    }
  }
  constexpr double degrees = 57.295779513082320877;
  return degrees *
    (largest_cosine > nearly_one ? std::asin(smallest_sine) : std::acos(largest_cosine));
}

double longest_edge(const Points& points, const Tets& tets, Index t)
{
  double longest = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < i; ++j)
    {
      longest = std::max(longest, (points.row(tets(t, i)) - points.row(tets(t, j))).squaredNorm());
    }
  }
  return std::sqrt(longest);
}

TetQuality measure_tets(PointsView points, TetsView tets)
{
  TetQuality quality;
  quality.min_dihedral_angle = tets.rows() ? 180.0 : 0.0;
  const Eigen::VectorXd volumes = tet_volumes(points, tets);
  quality.volume = volumes.sum();
  quality.min_volume = tets.rows() ? volumes.minCoeff() : 0.0;
  for (Index t = 0; t < tets.rows(); ++t)
  {
    const double angle = min_dihedral_angle(points.row(tets(t, 0)), points.row(tets(t, 1)),
      points.row(tets(t, 2)), points.row(tets(t, 3)));
    quality.min_dihedral_angle = std::min(quality.min_dihedral_angle, angle);
    quality.below_5_degrees += angle < sliver_angle;
    const auto bin = static_cast<std::size_t>(angle / DihedralHistogram::bin_width);
    ++quality.histogram.tets[std::min(bin, quality.histogram.tets.size() - 1)];
  }
  return quality;
}

namespace
{
using EdgeKey = std::array<Index, 2>;

/// Report whether two boundary triangles form an angle of less than `angle` degrees, measured
/// inside the tets: the normals are nearly opposite, and the second triangle is behind the plane of
/// the first.
bool is_wedge(PointsView points, const Triangles& boundary, const TriangleSide& one,
  const TriangleSide& other, double angle)
{
  constexpr double degrees = 57.295779513082320877;
  const auto corner = [&](const TriangleSide& side, int k) -> Vec3
  { return points.row(boundary(side.triangle, (side.corner + k) % 3)); };
  const auto normal = [&](const TriangleSide& side) -> Vec3
  {
    const Vec3 a = corner(side, 0);
    return (corner(side, 1) - a).cross(corner(side, 2) - a).normalized();
  };
  const Vec3 n = normal(one), m = normal(other);
  return degrees * std::atan2(n.cross(m).norm(), -n.dot(m)) < angle &&
    n.dot(corner(other, 2) - corner(one, 0)) < 0.0;
}

/// Report whether another boundary triangle is so near to the inner side of triangle t that every
/// tet at t has a dihedral angle of at most `angle` degrees. A tet with larger angles would contain
/// the roof over the triangle: the pyramid whose three faces have the slope `angle`. The test
/// checks whether another triangle intersects a ridge of the roof, or the segment from the center
/// of the inscribed circle to the top of the roof.
bool is_blocked(
  PointsView points, const Triangles& boundary, const TriangleTree& tree, Index t, double angle)
{
  constexpr double degrees = 57.295779513082320877;
  const auto triangle = boundary.row(t);
  const std::array<Vec3, 3> corners{ points.row(triangle[0]), points.row(triangle[1]),
    points.row(triangle[2]) };
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  Vec3 center = Vec3::Zero();
  double perimeter = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const double opposite = (corners[(k + 2) % 3] - corners[(k + 1) % 3]).norm();
    center += opposite * corners[k];
    perimeter += opposite;
  }
  center /= perimeter;
  const double radius = normal.norm() / perimeter;
  // Height of `top` as a fraction of the pyramid's height. The value is less than 1, so that `top`
  // is inside the pyramid in spite of rounding errors.
  constexpr double top_height_fraction = 0.999;
  const Vec3 top =
    center - top_height_fraction * std::tan(angle / degrees) * radius * normal.normalized();
  const auto shares_no_corner = [&](Index other)
  {
    return std::none_of(triangle.begin(), triangle.end(),
      [&](Index v) { return (boundary.row(other).array() == v).any(); });
  };
  return tree.segment_meets(center, top, shares_no_corner) ||
    std::any_of(corners.begin(), corners.end(),
      [&](const Vec3& corner) { return tree.segment_meets(corner, top, shares_no_corner); });
}

EdgeKey edge_key(Index a, Index b)
{
  return { std::min(a, b), std::max(a, b) };
}

/// Return the sorted edges of all tets whose smallest dihedral angle is below `angle`. `angles`
/// contains the smallest dihedral angle of each tet.
std::vector<EdgeKey> edges_of_flat(TetsView tets, const Eigen::VectorXd& angles, double angle)
{
  std::vector<EdgeKey> edges;
  for (Index t = 0; t < tets.rows(); ++t)
  {
    for (int k = 0; k < 16 && angles[t] < angle; ++k)
    {
      if (k / 4 < k % 4)
      {
        edges.push_back(edge_key(tets(t, k / 4), tets(t, k % 4)));
      }
    }
  }
  sort_unique(edges);
  return edges;
}

/// Evaluate is_blocked() for the boundary triangles that have an edge in `edges`.
std::vector<char> blocked_triangles(ExecutionContext& context, PointsView points,
  const Triangles& boundary, const std::vector<EdgeKey>& edges, double angle)
{
  std::vector<char> blocked(static_cast<std::size_t>(boundary.rows()), 0);
  const TriangleTree tree(points, boundary);
  constexpr Index block = 256;
  parallel_for(context, boundary.rows(), block,
    [&](Index begin, Index end)
    {
      for (Index t = begin; t < end; ++t)
      {
        for (int k = 0; k < 3; ++k)
        {
          const EdgeKey edge = edge_key(boundary(t, k), boundary(t, (k + 1) % 3));
          if (std::binary_search(edges.begin(), edges.end(), edge))
          {
            blocked[t] = is_blocked(points, boundary, tree, t, angle);
            break;
          }
        }
      }
    });
  return blocked;
}

/// Return the edges at which the boundary forces small angles, sorted: see count_forced_tets().
std::vector<EdgeKey> forced_edges(
  PointsView points, const Triangles& boundary, const std::vector<char>& blocked, double angle)
{
  std::vector<EdgeKey> forced;
  const std::vector<TriangleSide> sides = sides_by_edge(boundary);
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end)
  {
    end = end_of_edge(sides, begin);
    bool is_forced = false;
    for (std::size_t i = begin; i < end && !is_forced; ++i)
    {
      const Index t = sides[i].triangle;
      is_forced = blocked[t] ||
        smallest_triangle_angle(points.row(boundary(t, 0)), points.row(boundary(t, 1)),
          points.row(boundary(t, 2))) < angle;
      for (std::size_t j = begin; j < i && !is_forced; ++j)
      {
        is_forced = is_wedge(points, boundary, sides[j], sides[i], angle);
      }
    }
    if (is_forced)
    {
      forced.push_back({ sides[begin].a, sides[begin].b });
    }
  }
  return forced;
}
} // namespace

Index count_forced_tets(ExecutionContext& context, PointsView points, TetsView tets,
  const Eigen::VectorXd& angles, double angle)
{
  const Triangles boundary = boundary_triangles(tets);
  const std::vector<char> blocked =
    blocked_triangles(context, points, boundary, edges_of_flat(tets, angles, angle), angle);
  const std::vector<EdgeKey> forced = forced_edges(points, boundary, blocked, angle);
  Index count = 0;
  for (Index t = 0; t < tets.rows(); ++t)
  {
    bool touches = false;
    for (int i = 0; i < 4 && angles[t] < angle; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        touches = touches ||
          std::binary_search(forced.begin(), forced.end(), edge_key(tets(t, i), tets(t, j)));
      }
    }
    count += touches;
  }
  return count;
}

Status check_tets(PointsView points, TetsView tets, bool may_branch)
{
  return check_tets(points, tets, tet_facets(tets), may_branch);
}

Status check_tets(
  PointsView points, TetsView tets, const std::vector<TetFacet>& facets, bool may_branch)
{
  const auto failure = [](const std::string& problem)
  { return Status::failure(StatusCode::internal_error, problem); };
  for (Index t = 0; t < tets.rows(); ++t)
  {
    const Vec3 a = points.row(tets(t, 0)), b = points.row(tets(t, 1));
    const Vec3 c = points.row(tets(t, 2)), d = points.row(tets(t, 3));
    // The volume must be positive both exactly and in double precision, which later integrals use.
    if (orientation_3d(a, b, c, d) <= 0 || !(tet_volume(a, b, c, d) > 0.0))
    {
      return failure("tet " + std::to_string(t) + " must have a positive volume");
    }
  }
  // Report whether the vertex ids of the facet, in outward orientation, are a cyclic permutation of
  // the ids in ascending order.
  const auto forward = [&](const TetFacet& facet)
  {
    const auto& corners = facet_corners[facet.side];
    const Index a = tets(facet.tet, corners[0]), b = tets(facet.tet, corners[1]);
    const Index c = tets(facet.tet, corners[2]);
    return (a < b) + (b < c) + (c < a) == 2;
  };
  for (std::size_t i = 0, j = 0; i < facets.size(); i = j)
  {
    while (j < facets.size() && facets[j].vertices == facets[i].vertices)
    {
      ++j;
    }
    for (std::size_t k = i + 1; k < j; ++k)
    {
      for (std::size_t l = i; l < k; ++l)
      {
        if (tets(facets[k].tet, facets[k].side) == tets(facets[l].tet, facets[l].side))
        {
          return failure("tet " + std::to_string(facets[k].tet) + " is a duplicate");
        }
      }
    }
    if (!may_branch && (j - i > 2 || (j - i == 2 && forward(facets[i]) == forward(facets[i + 1]))))
    {
      return failure("tets overlap at a facet of tet " + std::to_string(facets[i].tet) +
        ", so the boundary is not closed");
    }
  }
  return {};
}

Index remove_small_components(
  const Points& points, Tets& tets, std::vector<TetFacet>& facets, double isolated_fraction)
{
  DisjointSets<Index> groups(static_cast<std::size_t>(tets.rows()));
  for (std::size_t i = 1; i < facets.size(); ++i)
  {
    if (facets[i].vertices == facets[i - 1].vertices)
    {
      groups.unite(facets[i - 1].tet, facets[i].tet);
    }
  }
  const Eigen::VectorXd volumes = tet_volumes(points, tets);
  Eigen::VectorXd group_volume = Eigen::VectorXd::Zero(tets.rows());
  std::vector<Index> size(static_cast<std::size_t>(tets.rows()), 0);
  for (Index t = 0; t < tets.rows(); ++t)
  {
    group_volume[groups.find(t)] += volumes[t];
    ++size[groups.find(t)];
  }
  constexpr double minimum_fraction = 1e-8;
  const double all = volumes.sum();
  Index kept = 0;
  for (Index t = 0; t < tets.rows(); ++t)
  {
    if (group_volume[groups.find(t)] >=
      (size[groups.find(t)] > 1 ? minimum_fraction : isolated_fraction) * all)
    {
      tets.row(kept++) = tets.row(t).eval();
    }
  }
  const Index dropped = tets.rows() - kept;
  if (dropped > 0)
  {
    tets.conservativeResize(kept, 4);
    facets = tet_facets(tets);
  }
  return dropped;
}

Index peel_slivers(const Points& points, Tets& tets, std::vector<TetFacet>& facets, double height)
{
  const auto is_flat = [&](Index t)
  {
    const Vec3 a = points.row(tets(t, 0)), b = points.row(tets(t, 1));
    const Vec3 c = points.row(tets(t, 2)), d = points.row(tets(t, 3));
    const double largest_area = 0.5 *
      std::max({ (c - b).cross(d - b).norm(), (d - a).cross(c - a).norm(),
        (b - a).cross(d - a).norm(), (c - a).cross(b - a).norm() });
    return 3.0 * std::abs(tet_volume(a, b, c, d)) < height * largest_area;
  };
  Index removed = 0;
  for (;;)
  {
    std::vector<char> slivers(static_cast<std::size_t>(tets.rows()), 0);
    bool any = false;
    for (Index t = 0; t < tets.rows(); ++t)
    {
      slivers[t] = is_flat(t);
      any = any || slivers[t];
    }
    if (!any)
    {
      return removed;
    }
    std::vector<char> at_boundary(slivers.size(), 0);
    for (std::size_t i = 0; i < facets.size();)
    {
      const bool shared = i + 1 < facets.size() && facets[i + 1].vertices == facets[i].vertices;
      at_boundary[facets[i].tet] |= !shared;
      i += shared ? 2 : 1;
    }
    Index kept = 0;
    for (Index t = 0; t < tets.rows(); ++t)
    {
      if (!slivers[t] || !at_boundary[t])
      {
        tets.row(kept++) = tets.row(t).eval();
      }
    }
    if (kept == tets.rows())
    {
      return removed;
    }
    removed += tets.rows() - kept;
    tets.conservativeResize(kept, 4);
    facets = tet_facets(tets);
  }
}

Points tet_centers(const Points& points, const Tets& tets)
{
  Points centers(tets.rows(), 3);
  for (Index t = 0; t < tets.rows(); ++t)
  {
    centers.row(t) = 0.25 *
      (points.row(tets(t, 0)) + points.row(tets(t, 1)) + points.row(tets(t, 2)) +
        points.row(tets(t, 3)));
  }
  return centers;
}

} // namespace bindpose
