// Vertices within a geodesic distance of a point on a surface, on shapes with known distances.
#include "support/meshes.h"
#include "surface/surface_disc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace bindpose;

TEST(SurfaceDisc, OnAFlatGridDistancesAreThoseOfThePlane)
{
  const TriangleMesh flat = test::grid(40, 40);
  const SurfaceDisc disc(flat.points, flat.triangles);
  const Vec3 place(0.513, 0.507, 0.0);
  Index triangle = 0; // the triangle that contains `place`
  for (Index f = 0; f < flat.triangles.rows(); ++f)
  {
    Eigen::Matrix3d m;
    for (int k = 0; k < 3; ++k)
    {
      m.col(k) =
        Vec3(flat.points(flat.triangles(f, k), 0), flat.points(flat.triangles(f, k), 1), 1);
    }
    const Vec3 b = m.inverse() * Vec3(place[0], place[1], 1.0);
    triangle = b.minCoeff() >= 0.0 ? f : triangle;
  }
  const double radius = 0.3;
  std::map<Index, double> found;
  double last = 0.0;
  for (const auto& [vertex, distance] : disc.within(place, triangle, radius))
  {
    EXPECT_GE(distance, last) << "sorted";
    last = distance;
    found[vertex] = distance;
  }
  for (Index v = 0; v < flat.points.rows(); ++v)
  {
    const double true_distance = (Vec3(flat.points.row(v)) - place).norm();
    if (found.count(v))
    {
      EXPECT_NEAR(found[v], true_distance, 0.004) << "no less, and a little more at most";
      EXPECT_GE(found[v], true_distance - 1e-12);
    }
    else
    {
      EXPECT_GT(true_distance, radius - 0.004);
    }
  }
  EXPECT_GT(found.size(), 400u);
  // The result of a call must not depend on previous calls.
  EXPECT_EQ(disc.within(place, triangle, radius).size(), found.size());
}

TEST(SurfaceDisc, OnASphereDistancesAreArcs)
{
  const TriangleMesh ball = test::sphere(5);
  const SurfaceDisc disc(ball.points, ball.triangles);
  const Index start = ball.triangles(77, 0);
  const Vec3 pole = ball.points.row(start);
  int count = 0;
  for (const auto& [vertex, distance] : disc.within(pole, 77, 2.0))
  {
    const double arc = std::acos(std::min(1.0, pole.dot(Vec3(ball.points.row(vertex)))));
    EXPECT_NEAR(distance, arc, 0.02 * arc + 0.01);
    ++count;
  }
  // The points are evenly distributed. The fraction of the points that are found therefore equals
  // the area of the spherical cap divided by the area of the sphere.
  EXPECT_NEAR(static_cast<double>(count) / static_cast<double>(ball.points.rows()),
    0.5 * (1.0 - std::cos(2.0)), 0.02);
}

TEST(SurfaceDisc, TheOtherSideOfAThinPlateIsFarAway)
{
  // The two grids are close to each other but not connected.
  const TriangleMesh flat = test::grid(20, 20);
  const TriangleMesh two = test::join(flat, test::translated(flat, Vec3(0, 0, 1e-3)));
  const SurfaceDisc disc(two.points, two.triangles);
  for (const auto& [vertex, distance] : disc.within(two.points.row(200), 380, 0.5))
  {
    EXPECT_LT(vertex, flat.points.rows());
  }
  EXPECT_TRUE(disc.within(Vec3::Zero(), -1, 1.0).empty());
  EXPECT_TRUE(disc.within(Vec3::Zero(), two.triangles.rows(), 1.0).empty());
  EXPECT_TRUE(disc.within(two.points.row(200), 380, -1.0).empty());
}
