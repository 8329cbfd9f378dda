// Smallest angles of triangles, and counts of needles and caps.
#include "surface/triangle_shape.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

TEST(TriangleShape, SmallestCornerIsTheAnalyticAngle)
{
  EXPECT_NEAR(
    smallest_triangle_angle(Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1, std::sqrt(3.0), 0)), 60.0, 1e-12);
  const Vec3 shift(5, -7, 3);
  for (const double height : { 1.0, 0.1, 1e-6 })
  {
    SCOPED_TRACE(height);
    const double degrees = std::atan(height) * 180.0 / M_PI;
    const Vec3 a = shift, b = shift + Vec3(1, 0, 0), c = shift + Vec3(1, 0, height);
    EXPECT_NEAR(smallest_triangle_angle(a, b, c) / degrees, 1.0, 1e-8);
    EXPECT_NEAR(smallest_triangle_angle(c, a, b) / degrees, 1.0, 1e-8);
    EXPECT_NEAR(smallest_triangle_angle(c, b, a) / degrees, 1.0, 1e-8);
  }
}

TEST(TriangleShape, NeedlesAndCapsAreCounted)
{
  Points points(6, 3);
  points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 20, 0, 0.5, 0.01, 0, 3, 0, 0;
  Triangles triangles(4, 3);
  triangles << 0, 1, 2, // smallest angle 45 degrees
    0, 1, 3, // a needle: 2.9 degrees
    0, 1, 4, // a cap: 1.1 degrees
    0, 1, 5; // on one line: 0 degrees
  EXPECT_EQ(count_needles(points, triangles, 5.0), 3);
  EXPECT_EQ(count_needles(points, triangles, 2.0), 2);
  EXPECT_EQ(count_needles(points, triangles, 0.0), 0);
  EXPECT_EQ(count_needles(points, triangles, 46.0), 4);
}
