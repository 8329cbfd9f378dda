// The edge length that is requested at a point: it grows with the distance from given sites.
#include "inside/sizing_field.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace bindpose;

TEST(SizingField, IsTheLeastOverAllSites)
{
  test::Random random(8);
  constexpr Index count = 500;
  Points sites(count, 3);
  Eigen::VectorXd lengths(count);
  for (Index i = 0; i < count; ++i)
  {
    sites.row(i) = random.in_box(Vec3::Zero(), Vec3::Ones());
    lengths[i] = random.uniform(0.001, 0.3);
  }
  constexpr double growth = 0.3;
  constexpr double largest = 0.2;
  const SizingField field(sites, lengths, growth, largest);
  for (int k = 0; k < 1000; ++k)
  {
    const Vec3 p = random.in_box(Vec3::Constant(-1.0), Vec3::Constant(2.0));
    double least = largest;
    for (Index i = 0; i < count; ++i)
    {
      least = std::min(least, lengths[i] + growth * (sites.row(i).transpose() - p).norm());
    }
    EXPECT_DOUBLE_EQ(field.at(p), least);
  }
}

TEST(SizingField, WithoutSitesIsTheLargest)
{
  EXPECT_EQ(SizingField(Points(0, 3), Eigen::VectorXd(0), 0.3, 0.7).at(Vec3::Ones()), 0.7);
}
