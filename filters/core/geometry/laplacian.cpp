// Cotangent weights, stiffness matrices, lumped masses and polyharmonic energies of triangle and
// tet meshes.
#include "geometry/laplacian.h"

#include "geometry/side_flux.h"
#include "geometry/tet_facets.h"

#include <cmath>
#include <vector>

namespace bindpose
{

namespace
{
SparseMatrix from_entries(
  Index vertex_count, const std::vector<Eigen::Triplet<double, int>>& entries)
{
  SparseMatrix matrix(vertex_count, vertex_count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <typename Elements, typename Cotangents, std::size_t EdgeCount>
SparseMatrix assemble(Index vertex_count, const Elements& elements, const Cotangents& c,
  const int (&edges)[EdgeCount][2])
{
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(static_cast<std::size_t>(elements.rows()) * EdgeCount * 4);
  for (Index e = 0; e < elements.rows(); ++e)
  {
    for (std::size_t k = 0; k < EdgeCount; ++k)
    {
      const int i = static_cast<int>(elements(e, edges[k][0]));
      const int j = static_cast<int>(elements(e, edges[k][1]));
      const double w = c(e, static_cast<Index>(k));
      entries.emplace_back(i, j, -w);
      entries.emplace_back(j, i, -w);
      entries.emplace_back(i, i, w);
      entries.emplace_back(j, j, w);
    }
  }
  return from_entries(vertex_count, entries);
}

constexpr int triangle_edges[3][2] = { { 1, 2 }, { 2, 0 }, { 0, 1 } };
} // namespace

Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> cotangent_weights(
  PointsView points, TrianglesView triangles)
{
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> c(triangles.rows(), 3);
  c.setZero();
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    const Vec3 p[3] = { points.row(triangles(t, 0)), points.row(triangles(t, 1)),
      points.row(triangles(t, 2)) };
    const double area_times_two = (p[1] - p[0]).cross(p[2] - p[0]).norm();
    for (int k = 0; k < 3 && area_times_two > 0.0; ++k)
    {
      const Vec3 u = p[(k + 1) % 3] - p[k];
      const Vec3 v = p[(k + 2) % 3] - p[k];
      const double half_cot = 0.5 * u.dot(v) / area_times_two;
      c(t, k) = std::isfinite(half_cot) ? half_cot : 0.0;
    }
  }
  return c;
}

Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> cotangent_weights(
  PointsView points, TetsView tets)
{
  Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> c(tets.rows(), 6);
  c.setZero();
  for (Index t = 0; t < tets.rows(); ++t)
  {
    const Vec3 p[4] = { points.row(tets(t, 0)), points.row(tets(t, 1)), points.row(tets(t, 2)),
      points.row(tets(t, 3)) };
    const double volume_times_six = (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
    if (volume_times_six == 0.0)
    {
      continue;
    }
    // The gradient is grad phi_i = g_i / (6 V). g_i is the inward normal of the facet opposite to
    // corner i, with a length of twice the facet's area.
    Vec3 g[4];
    g[1] = (p[2] - p[0]).cross(p[3] - p[0]);
    g[2] = (p[3] - p[0]).cross(p[1] - p[0]);
    g[3] = (p[1] - p[0]).cross(p[2] - p[0]);
    g[0] = -(g[1] + g[2] + g[3]);
    const double scale = 1.0 / (6.0 * std::abs(volume_times_six));
    for (int k = 0; k < 6; ++k)
    {
      const double w = -scale * g[tet_edges[k][0]].dot(g[tet_edges[k][1]]);
      c(t, k) = std::isfinite(w) ? w : 0.0;
    }
  }
  return c;
}

SparseMatrix stiffness_matrix(
  PointsView points, TrianglesView triangles, const Eigen::VectorXd& fractions)
{
  auto c = cotangent_weights(points, triangles);
  if (fractions.size() > 0)
  {
    c = fractions.asDiagonal() * c;
  }
  return assemble(points.rows(), triangles, c, triangle_edges);
}

SparseMatrix stiffness_matrix(PointsView points, TetsView tets, const Eigen::VectorXd& fractions)
{
  auto c = cotangent_weights(points, tets);
  if (fractions.size() > 0)
  {
    c = fractions.asDiagonal() * c;
  }
  return assemble(points.rows(), tets, c, tet_edges);
}

SparseMatrix boundary_flux(PointsView points, TrianglesView triangles)
{
  std::vector<TriangleSide> boundary_sides;
  const std::vector<TriangleSide> sides = sides_by_edge(triangles);
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j)
  {
    j = end_of_edge(sides, i);
    if (j == i + 1)
    {
      boundary_sides.push_back(sides[i]);
    }
  }
  return side_flux(points, triangles, boundary_sides);
}

SparseMatrix boundary_flux(PointsView points, TetsView tets)
{
  std::vector<Eigen::Triplet<double, int>> entries;
  const std::vector<TetFacet> facets = tet_facets(tets);
  for (std::size_t i = 0, j = 0; i < facets.size(); i = j)
  {
    while (j < facets.size() && facets[j].vertices == facets[i].vertices)
    {
      ++j;
    }
    const Index t = facets[i].tet;
    const auto& corners = facet_corners[facets[i].side];
    const auto at = [&](int k) -> Vec3 { return points.row(tets(t, k)); };
    const double volume_times_six = (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0));
    if (j > i + 1 || !(volume_times_six > 0.0))
    {
      continue;
    }
    const auto twice_area = [&](int side) -> Vec3
    {
      const auto& c = facet_corners[side];
      return (at(c[1]) - at(c[0])).cross(at(c[2]) - at(c[0]));
    };
    const Vec3 outwards = 0.5 * twice_area(facets[i].side);
    for (int c = 0; c < 4; ++c)
    {
      // The gradient of the corner's basis function points away from the facet opposite to the
      // corner.
      const double gradient_flux = outwards.dot(-twice_area(c)) / volume_times_six / 3.0;
      for (const int end : corners)
      {
        entries.emplace_back(
          static_cast<int>(tets(t, end)), static_cast<int>(tets(t, c)), gradient_flux);
      }
    }
  }
  return from_entries(points.rows(), entries);
}

Eigen::VectorXd lumped_mass(PointsView points, TrianglesView triangles)
{
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(points.rows());
  const auto c = cotangent_weights(points, triangles);
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    const Vec3 p[3] = { points.row(triangles(t, 0)), points.row(triangles(t, 1)),
      points.row(triangles(t, 2)) };
    const double area = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
    const bool obtuse = c(t, 0) < 0.0 || c(t, 1) < 0.0 || c(t, 2) < 0.0;
    for (int k = 0; k < 3; ++k)
    {
      double corner_area;
      if (obtuse)
      {
        corner_area = c(t, k) < 0.0 ? area / 2.0 : area / 4.0;
      }
      else
      {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        corner_area =
          0.25 * (c(t, j) * (p[i] - p[k]).squaredNorm() + c(t, i) * (p[j] - p[k]).squaredNorm());
      }
      mass[triangles(t, k)] += corner_area;
    }
  }
  return mass;
}

Eigen::VectorXd lumped_mass(PointsView points, TetsView tets, const Eigen::VectorXd& fractions)
{
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(points.rows());
  Eigen::VectorXd volumes = tet_volumes(points, tets);
  if (fractions.size() > 0)
  {
    volumes.array() *= fractions.array();
  }
  for (Index t = 0; t < tets.rows(); ++t)
  {
    for (int k = 0; k < 4; ++k)
    {
      mass[tets(t, k)] += 0.25 * std::abs(volumes[t]);
    }
  }
  return mass;
}

SparseMatrix harmonic_energy(const SparseMatrix& stiffness, const Eigen::VectorXd& mass, int k)
{
  const Eigen::VectorXd inverse_mass =
    mass.unaryExpr([](double m) { return m > 0.0 ? 1.0 / m : 0.0; });
  SparseMatrix q = stiffness;
  for (int power = 1; power < k; ++power)
  {
    q = SparseMatrix(stiffness * inverse_mass.asDiagonal() * q).eval();
  }
  if (k > 2)
  {
    // The product of three matrices is symmetric only up to round-off.
    q = SparseMatrix(0.5 * (q + SparseMatrix(q.transpose())));
  }
  return q;
}

} // namespace bindpose
