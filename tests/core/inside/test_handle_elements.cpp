// Sampling of handles: samples of bones and cage triangles become vertices of the tets.
#include "inside/handle_elements.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
HandleElements three_handle_points()
{
  HandleElements handle_elements;
  handle_elements.points.resize(3, 3);
  handle_elements.points << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  return handle_elements;
}
} // namespace

TEST(HandleElements, ALineIsCutIntoPiecesOfTheLocalLength)
{
  HandleElements handle_elements = three_handle_points();
  handle_elements.segments.resize(1, 2);
  handle_elements.segments << 0, 1;
  const HandleSamples even =
    sample_handle_elements(handle_elements, [](const Vec3&) { return 0.1; });
  EXPECT_EQ(even.handle_point_count, 3);
  ASSERT_EQ(even.points.rows(), 3 + 9);
  for (Index i = 0; i < 9; ++i)
  {
    EXPECT_NEAR(even.points(3 + i, 0), 0.1 * static_cast<double>(i + 1), 1e-9);
  }
  // The requested length grows along the bone, so the segments must become longer. No segment may
  // be longer than the length requested at its end.
  const auto growing = [](const Vec3& p) { return 0.05 + 0.3 * p.x(); };
  const HandleSamples graded = sample_handle_elements(handle_elements, growing);
  double last = 0.0;
  double last_piece = 0.0;
  for (Index i = 3; i < graded.points.rows(); ++i)
  {
    const double piece = graded.points(i, 0) - last;
    EXPECT_GT(piece, last_piece);
    EXPECT_LT(piece, growing(graded.points.row(i)) * 1.01);
    last = graded.points(i, 0);
    last_piece = piece;
  }
}

TEST(HandleElements, ABoneHasAPointBetweenItsEndsAndNeverTooMany)
{
  HandleElements handle_elements = three_handle_points();
  handle_elements.segments.resize(1, 2);
  handle_elements.segments << 0, 1;
  EXPECT_EQ(
    sample_handle_elements(handle_elements, [](const Vec3&) { return 10.0; }).points.rows(), 4);
  EXPECT_LE(
    sample_handle_elements(handle_elements, [](const Vec3&) { return 1e-12; }).points.rows(),
    3 + 1001);
}

TEST(HandleElements, ATriangleIsCoveredAndEveryPlaceIsThereOnce)
{
  HandleElements handle_elements = three_handle_points();
  handle_elements.segments.resize(3, 2);
  handle_elements.segments << 0, 1, 1, 2, 2, 0;
  handle_elements.triangles.resize(1, 3);
  handle_elements.triangles << 0, 1, 2;
  const HandleSamples samples =
    sample_handle_elements(handle_elements, [](const Vec3&) { return 0.1; });
  for (Index i = 0; i < samples.points.rows(); ++i)
  {
    const Vec3 p = samples.points.row(i);
    EXPECT_EQ(p.z(), 0.0);
    EXPECT_GE(p.head<2>().minCoeff(), -1e-12);
    EXPECT_LE(p.head<2>().sum(), 1.0 + 1e-12);
    for (Index j = 0; j < i; ++j)
    {
      ASSERT_NE(samples.points.row(i), samples.points.row(j));
    }
  }
  for (int i = 0; i <= 20; ++i)
  {
    for (int j = 0; i + j <= 20; ++j)
    {
      const Vec3 p(0.05 * i, 0.05 * j, 0.0);
      EXPECT_LT((samples.points.rowwise() - p.transpose()).rowwise().norm().minCoeff(), 0.1);
    }
  }
}

TEST(HandleElements, EndsAtOnePlace)
{
  HandleElements handle_elements = three_handle_points();
  handle_elements.points.row(1) = handle_elements.points.row(0);
  handle_elements.segments.resize(1, 2);
  handle_elements.segments << 0, 1;
  handle_elements.triangles.resize(1, 3);
  handle_elements.triangles << 0, 0, 1;
  const HandleSamples samples =
    sample_handle_elements(handle_elements, [](const Vec3&) { return 0.1; });
  EXPECT_EQ(samples.points.rows(), 2);
  EXPECT_EQ(samples.handle_point_count, 2);
}

TEST(HandleElements, BadOnesAreRefused)
{
  HandleElements handle_elements = three_handle_points();
  EXPECT_TRUE(check_handle_elements(handle_elements).ok());
  handle_elements.triangles.resize(1, 3);
  handle_elements.triangles << 0, 1, 3;
  EXPECT_THAT(check_handle_elements(handle_elements).message,
    HasSubstr("handle triangle 0 references point 3"));
  handle_elements.triangles << 0, 1, -1;
  EXPECT_EQ(check_handle_elements(handle_elements).code, StatusCode::invalid_input);
  handle_elements.triangles.resize(0, 3);
  handle_elements.points(1, 1) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(check_handle_elements(handle_elements).message, HasSubstr("not finite"));
}
