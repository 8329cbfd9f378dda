// Areas of oriented point samples, computed from local Voronoi cells. The tests use samples whose
// cells are known.
#include "winding/point_areas.h"

#include "base/constants.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

namespace
{
Eigen::VectorXd areas_of(const Points& points, const Points& normals, Index neighbors = 12)
{
  ExecutionContext context;
  PointTree tree;
  EXPECT_TRUE(tree.build(context, points, 32));
  Eigen::VectorXd areas;
  EXPECT_TRUE(estimate_point_areas(context, points, normals, tree, neighbors, 0x1p-49, areas));
  return areas;
}

/// Return n * n points at distances of `step` in the plane z = 0, with upward normals.
void square_lattice(Index n, double step, Points& points, Points& normals)
{
  points.resize(n * n, 3);
  normals.resize(n * n, 3);
  for (Index i = 0; i < n * n; ++i)
  {
    points.row(i) << step * static_cast<double>(i % n), step * static_cast<double>(i / n), 0.0;
    normals.row(i) << 0, 0, 1;
  }
}
} // namespace

TEST(PointAreas, LatticesHaveTheirCells)
{
  Points points, normals;
  square_lattice(12, 0.5, points, normals);
  const Eigen::VectorXd areas = areas_of(points, normals);
  for (Index y = 2; y < 10; ++y)
  {
    for (Index x = 2; x < 10; ++x)
    {
      EXPECT_NEAR(areas[12 * y + x], 0.25, 1e-14);
    }
  }
  // The samples are a rotated lattice of rhombi. The cells of the inner samples are hexagons of
  // area sqrt(3) / 2.
  square_lattice(12, 1.0, points, normals);
  for (Index i = 0; i < points.rows(); ++i)
  {
    points(i, 0) += 0.5 * points(i, 1);
    points(i, 1) *= 0.5 * std::sqrt(3.0);
  }
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  points = Points(points * turn.transpose());
  normals = Points(normals * turn.transpose());
  EXPECT_NEAR(areas_of(points, normals)[12 * 6 + 6], 0.5 * std::sqrt(3.0), 1e-13);
}

TEST(PointAreas, CellsAreClippedToTheDiscOfHalfTheFarthestNeighbor)
{
  // The samples are on one line. Each cell is a strip, clipped by a disc around the sample.
  Points points(3, 3), normals(3, 3);
  points << -1, 0, 0, 0, 0, 0, 1, 0, 0;
  normals << 0, 0, 1, 0, 0, 1, 0, 0, 1;
  const Eigen::VectorXd areas = areas_of(points, normals);
  EXPECT_NEAR(areas[1], 0.25 * pi, 1e-14); // the bisectors touch the disc of radius 1/2
  // The disc has the radius 1. A line at the distance 1/2 from its center cuts off a circular
  // segment of 120 degrees.
  EXPECT_NEAR(areas[0], pi - (pi / 3.0 - std::sqrt(3.0) / 4.0), 1e-14);
  // For two samples, the cells are discs whose radius is half of the distance between the samples.
  EXPECT_NEAR(areas_of(points.topRows(2), normals.topRows(2))[0], 0.25 * pi, 1e-14);
}

TEST(PointAreas, SharedPlacesAndSidesOfASheet)
{
  Points points, normals;
  square_lattice(9, 1.0, points, normals);
  const Index n = points.rows();
  // If each sample occurs twice with the same normal, each copy has half of the area. A copy with
  // the opposite normal does not reduce the area of its sample, at the same position or 0.01 below.
  Points twice(2 * n, 3), same(2 * n, 3), other(2 * n, 3), below(2 * n, 3);
  twice << points, points;
  same << normals, normals;
  below << points, Points(points.rowwise() - 0.01 * Vec3::UnitZ().transpose());
  other << normals, Points(-normals);
  EXPECT_NEAR(areas_of(twice, same, 24)[40], 0.5, 1e-13);
  EXPECT_NEAR(areas_of(twice, other, 24)[40], 1.0, 1e-13);
  EXPECT_NEAR(areas_of(below, other, 24)[40], 1.0, 1e-13);
  EXPECT_NEAR(areas_of(below, other, 24)[40 + n], 1.0, 1e-13);
  // The areas are zero if all samples coincide, or if they have no normals.
  EXPECT_EQ(areas_of(Points::Zero(5, 3), normals.topRows(5)).sum(), 0.0);
  EXPECT_EQ(areas_of(points, Points::Zero(n, 3)).sum(), 0.0);
  EXPECT_EQ(areas_of(points.topRows(1), normals.topRows(1)).sum(), 0.0);
}

TEST(PointAreas, SpheresHaveTheirArea)
{
  constexpr Index count = 20000;
  test::Random random(5);
  for (const bool even : { true, false })
  {
    Points points(count, 3);
    for (Index i = 0; i < count; ++i)
    {
      const double z =
        even ? 1.0 - (2.0 * static_cast<double>(i) + 1.0) / count : random.uniform(-1.0, 1.0);
      const double angle =
        even ? static_cast<double>(i) * pi * (3.0 - std::sqrt(5.0)) : random.uniform(0.0, 2.0 * pi);
      const double r = std::sqrt(1.0 - z * z);
      points.row(i) << r * std::cos(angle), r * std::sin(angle), z;
    }
    // The cell of a random sample may be bounded by samples that are not among the 12 nearest
    // neighbors.
    const auto error = [&](Index neighbors)
    { return std::abs(areas_of(points, points, neighbors).sum() / (4.0 * pi) - 1.0); };
    EXPECT_LT(error(12), even ? 1e-3 : 0.05);
    EXPECT_LT(error(20), even ? 1e-3 : 0.01);
    EXPECT_LT(error(32), 1e-3);
  }
}
