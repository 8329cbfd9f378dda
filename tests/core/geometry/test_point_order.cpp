// Spatial sort of points: the order contains every point once, and consecutive points are close.
#include "geometry/point_order.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace bindpose;

namespace
{
double path_length(const std::vector<Vec3>& points, const std::vector<std::int32_t>& order)
{
  double sum = 0.0;
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    sum += (points[order[i]] - points[order[i - 1]]).norm();
  }
  return sum;
}
} // namespace

TEST(PointOrder, EveryPointOnceAndTheWayIsShort)
{
  test::Random random(7);
  for (const std::size_t count : { 0, 1, 5, 3000, 40000 })
  {
    SCOPED_TRACE(count);
    std::vector<Vec3> points(count);
    std::vector<std::int32_t> as_they_come(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      points[i] = random.in_box(Vec3(-1, 5, 1e3), Vec3(1, 6, 1e3 + 4));
      as_they_come[i] = static_cast<std::int32_t>(i);
    }
    std::vector<std::int32_t> order = spatial_sort(points);
    ASSERT_EQ(order.size(), count);
    if (count >= 3000)
    {
      EXPECT_LT(path_length(points, order), 0.2 * path_length(points, as_they_come));
    }
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, as_they_come);
  }
}

TEST(PointOrder, PlacesThatAreNone)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<Vec3> points;
  for (const double x : { nan, infinity, -infinity, 1e308, -1e308, 0.0 })
  {
    points.insert(points.end(), 20, Vec3(x, 1.0, -x));
  }
  std::vector<std::int32_t> order = spatial_sort(points);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_EQ(order[i], static_cast<std::int32_t>(i));
  }
}
