// Bounding boxes, validity checks, volumes, edges and connected components of triangle and tet
// meshes.
#include "geometry/mesh.h"

#include "base/disjoint_sets.h"
#include "base/number_text.h"
#include "geometry/tet_facets.h"
#include "geometry/triangle_sides.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace bindpose
{

namespace
{
template <typename Elements>
Status check_elements(PointsView points, const Elements& elements, const char* element_name)
{
  for (Index e = 0; e < elements.rows(); ++e)
  {
    for (Index k = 0; k < elements.cols(); ++k)
    {
      const Index v = elements(e, k);
      if (v < 0 || v >= points.rows())
      {
        return Status::invalid_input(std::string(element_name) + " " + std::to_string(e) +
          " references vertex " + std::to_string(v) + ", but there are " +
          std::to_string(points.rows()) + " vertices");
      }
      if (!points.row(v).allFinite())
      {
        return Status::invalid_input("vertex " + std::to_string(v) +
          " has a coordinate that is not a finite number (used by " + element_name + " " +
          std::to_string(e) + ")");
      }
    }
  }
  return {};
}

template <typename Elements>
Components components_of(Index vertex_count, const Elements& elements)
{
  DisjointSets<Index> sets(static_cast<std::size_t>(vertex_count));
  std::vector<char> used(static_cast<std::size_t>(vertex_count), 0);
  for (Index e = 0; e < elements.rows(); ++e)
  {
    for (Index k = 0; k < elements.cols(); ++k)
    {
      used[elements(e, k)] = 1;
      sets.unite(elements(e, 0), elements(e, k));
    }
  }
  Components result;
  result.component_of_vertex.assign(static_cast<std::size_t>(vertex_count), -1);
  for (Index v = 0; v < vertex_count; ++v)
  {
    if (used[v])
    {
      const Index root = sets.find(v);
      result.component_of_vertex[v] = root == v ? result.count++ : result.component_of_vertex[root];
    }
  }
  return result;
}
} // namespace

void Box::add(const Vec3& p)
{
  this->lower = this->lower.cwiseMin(p);
  this->upper = this->upper.cwiseMax(p);
}

Box bounding_box(PointsView points)
{
  Box box;
  for (Index v = 0; v < points.rows(); ++v)
  {
    box.add(points.row(v));
  }
  return box;
}

Box bounding_box(PointsView points, TrianglesView triangles)
{
  Box box;
  for (Index k = 0; k < triangles.size(); ++k)
  {
    box.add(points.row(triangles.data()[k]));
  }
  return box;
}

Status check_mesh(PointsView points, TrianglesView triangles)
{
  return check_elements(points, triangles, "triangle");
}

Status check_mesh(PointsView points, TetsView tets)
{
  return check_elements(points, tets, "tet");
}

Status check_float_range(PointsView points)
{
  constexpr double largest_float = std::numeric_limits<float>::max();
  for (Index v = 0; v < points.rows(); ++v)
  {
    for (int k = 0; k < 3; ++k)
    {
      if (!(std::abs(points(v, k)) <= largest_float))
      {
        return Status::invalid_input(std::string("coordinate ") + "xyz"[k] + " of point " +
          std::to_string(v) + " is " + short_number(points(v, k)) +
          "; single precision allows at most 3.4e38");
      }
    }
  }
  const Box box = bounding_box(points);
  const double diagonal = box.size().stableNorm();
  const double distance =
    box.empty() ? 0.0 : box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).maxCoeff();
  const auto rounded = static_cast<float>(distance);
  const double spacing = std::nextafter(rounded, std::numeric_limits<float>::max()) - rounded;
  constexpr double coarsest = 0.01; // in diagonals
  return diagonal == 0.0 || spacing <= coarsest * diagonal
    ? Status()
    : Status::invalid_input("single precision resolves only " + short_number(spacing) +
        " near coordinate " + short_number(distance) + "; expected at most 0.01 of the diagonal " +
        short_number(diagonal));
}

double signed_volume(PointsView points, TrianglesView triangles)
{
  // Coordinates are relative to the center of the box. Far from the origin, the determinants would
  // lose digits by cancellation.
  const Vec3 c = triangles.rows() ? bounding_box(points, triangles).center() : Vec3::Zero();
  double volume_times_six = 0.0;
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    const Vec3 p0 = points.row(triangles(t, 0)).transpose() - c;
    const Vec3 p1 = points.row(triangles(t, 1)).transpose() - c;
    const Vec3 p2 = points.row(triangles(t, 2)).transpose() - c;
    volume_times_six += p0.dot(p1.cross(p2));
  }
  return volume_times_six / 6.0;
}

double surface_area(PointsView points, TrianglesView triangles)
{
  double area_times_two = 0.0;
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    const Vec3 p0 = points.row(triangles(t, 0));
    const Vec3 p1 = points.row(triangles(t, 1));
    const Vec3 p2 = points.row(triangles(t, 2));
    area_times_two += (p1 - p0).cross(p2 - p0).norm();
  }
  return 0.5 * area_times_two;
}

double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  return (b - a).cross(c - a).dot(d - a) / 6.0;
}

Eigen::VectorXd tet_volumes(PointsView points, TetsView tets)
{
  Eigen::VectorXd volumes(tets.rows());
  for (Index t = 0; t < tets.rows(); ++t)
  {
    volumes[t] = tet_volume(points.row(tets(t, 0)), points.row(tets(t, 1)), points.row(tets(t, 2)),
      points.row(tets(t, 3)));
  }
  return volumes;
}

Triangles boundary_triangles(TetsView tets)
{
  const std::vector<TetFacet> facets = tet_facets(tets);
  std::vector<TetFacet> single;
  for (std::size_t i = 0, j = 0; i < facets.size(); i = j)
  {
    while (j < facets.size() && facets[j].vertices == facets[i].vertices)
    {
      ++j;
    }
    if (j == i + 1)
    {
      single.push_back(facets[i]);
    }
  }
  std::sort(single.begin(), single.end(),
    [](const TetFacet& x, const TetFacet& y)
    { return x.tet != y.tet ? x.tet < y.tet : x.side < y.side; });
  Triangles result(static_cast<Index>(single.size()), 3);
  for (Index i = 0; i < result.rows(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      result(i, k) = tets(single[i].tet, facet_corners[single[i].side][k]);
    }
  }
  return result;
}

std::vector<Edge> mesh_edges(TrianglesView triangles)
{
  const std::vector<TriangleSide> sides = sides_by_edge(triangles);
  std::vector<Edge> edges;
  edges.reserve(sides.size() / 2 + 1); // a closed surface has no more edges than this
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end)
  {
    end = end_of_edge(sides, begin);
    Edge edge{ sides[begin].a, sides[begin].b, 0, 0 };
    for (std::size_t k = begin; k < end; ++k)
    {
      edge.triangle_count += 1;
      edge.net_direction += sides[k].forward ? 1 : -1;
    }
    if (edge.a != edge.b)
    {
      edges.push_back(edge);
    }
  }
  return edges;
}

EdgeCounts count_edges(TrianglesView triangles)
{
  EdgeCounts counts;
  for (const Edge& edge : mesh_edges(triangles))
  {
    counts.edges += 1;
    counts.boundary += edge.triangle_count == 1;
    counts.nonmanifold += edge.triangle_count >= 3;
    counts.misoriented += edge.triangle_count == 2 && edge.net_direction != 0;
    counts.closed = counts.closed && edge.net_direction == 0;
  }
  return counts;
}

Components connected_components(Index vertex_count, TrianglesView triangles)
{
  return components_of(vertex_count, triangles);
}

Components connected_components(Index vertex_count, TetsView tets)
{
  return components_of(vertex_count, tets);
}

} // namespace bindpose
