// Outlines around the shape in an image. The outlines are closed, do not cross each other, and are
// at most one pixel away from the shape.
#include "planar/image_outline.h"

#include "support/sanitized.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <random>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
using Picture = std::vector<std::vector<float>>; // pixel values row by row, from y = 0

Status outline_of(const Picture& picture, ImageOutline& outline, double simplify = 0.5)
{
  ExecutionContext context;
  ImageOutlineOptions options;
  options.simplify = simplify;
  const auto rows = static_cast<Index>(picture.size());
  const Index columns = rows == 0 ? 0 : static_cast<Index>(picture[0].size());
  return image_outline(
    context, columns, rows,
    [&](Index row, float* values) { std::copy(picture[row].begin(), picture[row].end(), values); },
    options, outline);
}

template <typename Function>
Picture paint(Index columns, Index rows, const Function& alpha)
{
  Picture picture(rows, std::vector<float>(columns));
  for (Index y = 0; y < rows; ++y)
  {
    for (Index x = 0; x < columns; ++x)
    {
      picture[y][x] = static_cast<float>(alpha(static_cast<double>(x), static_cast<double>(y)));
    }
  }
  return picture;
}

Picture noise_picture(Index columns, Index rows, unsigned seed, bool binary)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  return paint(
    columns, rows, [&](double, double) { return binary ? std::round(any(random)) : any(random); });
}

/// Return the signed area of an outline. Expect that each vertex is the end of exactly one segment
/// and the start of exactly one.
double outline_area(const ImageOutline& outline)
{
  std::vector<int> balance(outline.points.rows(), 0);
  double twice = 0.0;
  for (Index e = 0; e < outline.segments.rows(); ++e)
  {
    const Vec2 a = outline.points.row(outline.segments(e, 0));
    const Vec2 b = outline.points.row(outline.segments(e, 1));
    twice += cross(a, b);
    balance[outline.segments(e, 0)] += 1;
    balance[outline.segments(e, 1)] += 10;
  }
  EXPECT_TRUE(std::all_of(balance.begin(), balance.end(), [](int b) { return b == 11; }));
  return 0.5 * twice;
}

/// Return twice the signed area of a triangle.
double turn(const Vec2& a, const Vec2& b, const Vec2& c)
{
  return cross(b - a, c - a);
}

/// Count the pairs of segments that cross, or that touch although they share no vertex, by brute
/// force.
int crossings(const ImageOutline& outline)
{
  int count = 0;
  for (Index e = 0; e < outline.segments.rows(); ++e)
  {
    const Vec2 a = outline.points.row(outline.segments(e, 0));
    const Vec2 b = outline.points.row(outline.segments(e, 1));
    for (Index f = 0; f < e; ++f)
    {
      if (outline.segments(e, 0) == outline.segments(f, 1) ||
        outline.segments(e, 1) == outline.segments(f, 0))
      {
        continue;
      }
      const Vec2 c = outline.points.row(outline.segments(f, 0));
      const Vec2 d = outline.points.row(outline.segments(f, 1));
      const bool boxes = (a.cwiseMin(b).array() <= c.cwiseMax(d).array()).all() &&
        (c.cwiseMin(d).array() <= a.cwiseMax(b).array()).all();
      count +=
        boxes && turn(a, b, c) * turn(a, b, d) <= 0.0 && turn(c, d, a) * turn(c, d, b) <= 0.0;
    }
  }
  return count;
}

double distance(const Vec2& p, const Vec2& a, const Vec2& b)
{
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

/// Return the largest distance from points on one outline to the other outline.
double one_sided_distance(const ImageOutline& from, const ImageOutline& to)
{
  double largest = 0.0;
  for (Index e = 0; e < from.segments.rows(); ++e)
  {
    for (int k = 0; k < 8; ++k)
    {
      const Vec2 p = (from.points.row(from.segments(e, 0)) * (1.0 - k / 8.0) +
        from.points.row(from.segments(e, 1)) * (k / 8.0))
                       .transpose();
      double nearest = 1e300;
      for (Index f = 0; f < to.segments.rows(); ++f)
      {
        nearest = std::min(
          nearest, distance(p, to.points.row(to.segments(f, 0)), to.points.row(to.segments(f, 1))));
      }
      largest = std::max(largest, nearest);
    }
  }
  return largest;
}

double inside_fraction(double x, double y, const Vec2& center, double radius)
{
  int inside = 0;
  for (int i = 0; i < 64; ++i)
  {
    const Vec2 p(x - 0.5 + (i % 8 + 0.5) / 8.0, y - 0.5 + (i / 8 + 0.5) / 8.0);
    inside += (p - center).norm() <= radius;
  }
  return inside / 64.0;
}
} // namespace

TEST(ImageOutline, DiscWithinAPixel)
{
  const Vec2 center(63.3, 60.8);
  const double radius = 50.4;
  for (const bool smooth : { true, false })
  {
    const Picture picture = paint(128, 120,
      [&](double x, double y)
      {
        return smooth ? inside_fraction(x, y, center, radius)
                      : ((Vec2(x, y) - center).norm() <= radius ? 1.0 : 0.0);
      });
    for (const double simplify : { 0.0, 0.25, 0.5, 1.0 })
    {
      ImageOutline outline;
      const Status status = outline_of(picture, outline, simplify);
      ASSERT_TRUE(status.ok()) << status.message;
      EXPECT_EQ(status.report.number("counts.loops", -1), 1);
      double largest = 0.0;
      for (Index e = 0; e < outline.segments.rows(); ++e)
      {
        for (int k = 0; k < 16; ++k)
        {
          const Vec2 p = (outline.points.row(outline.segments(e, 0)) * (1.0 - k / 16.0) +
            outline.points.row(outline.segments(e, 1)) * (k / 16.0))
                           .transpose();
          largest = std::max(largest, std::abs((p - center).norm() - radius));
        }
      }
      // If pixels have only the values 0 and 1, the position of the boundary is known only to half
      // the diagonal of a pixel.
      const double of_contour = smooth ? 0.15 : 0.71;
      EXPECT_LE(largest, of_contour + simplify);
      if (simplify <= 0.5)
      {
        EXPECT_LE(largest, 1.0) << simplify << smooth;
      }
      if (simplify == 0.0)
      {
        EXPECT_NEAR(outline_area(outline), M_PI * radius * radius, smooth ? 10.0 : 40.0);
      }
      EXPECT_GE(outline.points.rows(), simplify == 0.0 ? 300 : 12);
      EXPECT_LE(outline.points.rows(), simplify < 0.5 ? 500 : 100);
    }
  }
}

TEST(ImageOutline, StaysWithinTheToleranceAndNeverCrosses)
{
  for (const unsigned seed : { 1u, 2u, 3u })
  {
    for (const bool binary : { true, false })
    {
      const Picture picture = noise_picture(24, 20, seed, binary);
      ImageOutline contour, outline;
      ASSERT_TRUE(outline_of(picture, contour, 0.0).ok());
      EXPECT_EQ(crossings(contour), 0);
      for (const double simplify : { 0.3, 1.0 })
      {
        const Status status = outline_of(picture, outline, simplify);
        ASSERT_TRUE(status.ok()) << status.message;
        outline_area(outline);
        EXPECT_EQ(crossings(outline), 0);
        EXPECT_LT(outline.points.rows(), contour.points.rows());
        EXPECT_LE(one_sided_distance(contour, outline), simplify + 1e-9);
        EXPECT_LE(one_sided_distance(outline, contour), simplify + 1e-9);
      }
    }
  }
}

TEST(ImageOutline, OneComponentALoop)
{
  // At a pixel's center, the winding number of the contour is 1 for pixels inside and 0 for pixels
  // outside.
  const Picture picture = noise_picture(40, 33, 5, false);
  ImageOutline outline;
  ASSERT_TRUE(outline_of(picture, outline, 0.0).ok());
  const CurveWindingNumber winding(outline.points, outline.segments);
  for (int y = 0; y < 33; ++y)
  {
    for (int x = 0; x < 40; ++x)
    {
      ASSERT_EQ(winding.evaluate_at({ x, y }), picture[y][x] >= 0.5f ? 1.0 : 0.0);
    }
  }
}

TEST(ImageOutline, ContourIsWhereAlphaPasses)
{
  // The values are a ramp along x. The outline is where the ramp has the value 1/2.
  const Picture picture = paint(11, 5, [](double x, double) { return 1.0 - x / 10.0; });
  ImageOutline outline;
  ASSERT_TRUE(outline_of(picture, outline, 0.0).ok());
  int on_line = 0;
  for (Index v = 0; v < outline.points.rows(); ++v)
  {
    const double y = outline.points(v, 1);
    on_line += std::abs(outline.points(v, 0) - 5.0) < 2e-3 && y >= 0.0 && y <= 4.0;
  }
  EXPECT_EQ(on_line, 5);
}

TEST(ImageOutline, SaddlesByBilinearInterpolation)
{
  const auto loops = [](float a, float b)
  {
    ImageOutline outline;
    const Status status = outline_of({ { a, b }, { b, a } }, outline, 0.0);
    EXPECT_TRUE(status.ok());
    return status.report.number("counts.loops", -1);
  };
  EXPECT_EQ(loops(1.0f, 0.0f), 1); // the value at the saddle is 1/2, which counts as inside
  EXPECT_EQ(loops(0.9f, 0.0f), 2);
  EXPECT_EQ(loops(0.9f, 0.2f), 1);
  EXPECT_EQ(loops(0.0f, 0.9f), 2);
}

TEST(ImageOutline, HolesAndIslands)
{
  const Picture picture = paint(60, 60,
    [](double x, double y)
    {
      const double r = std::hypot(x - 30, y - 30);
      return (r < 25 && r > 15) || r < 5 ? 1.0 : 0.0;
    });
  ImageOutline outline;
  const Status status = outline_of(picture, outline);
  ASSERT_TRUE(status.ok());
  EXPECT_EQ(status.report.number("counts.loops", -1), 3);
  EXPECT_NEAR(outline_area(outline), M_PI * (25 * 25 - 15 * 15 + 5 * 5), 60.0);
}

TEST(ImageOutline, OpaqueImageReachesHalfAPixelOutside)
{
  ImageOutline outline;
  ASSERT_TRUE(outline_of(Picture(30, std::vector<float>(40, 1.0f)), outline).ok());
  EXPECT_EQ(outline.points.col(0).minCoeff(), -0.5);
  EXPECT_EQ(outline.points.col(0).maxCoeff(), 39.5);
  EXPECT_EQ(outline.points.col(1).maxCoeff(), 29.5);
  // The tolerance is half a pixel on all sides.
  EXPECT_NEAR(outline_area(outline), 40 * 30, 4 * 0.125 + 0.5 * 140);
}

TEST(ImageOutline, OnePixel)
{
  ImageOutline outline;
  ASSERT_TRUE(outline_of({ { 1.0f } }, outline, 1.0).ok());
  EXPECT_EQ(outline.points.rows(), 4);
  EXPECT_NEAR(outline_area(outline), 0.5, 1e-12);
}

TEST(ImageOutline, Refuses)
{
  ImageOutline outline;
  ExecutionContext context;
  const AlphaRow never = [](Index, float*) { FAIL(); };
  for (const auto& [columns, rows] : { std::pair<Index, Index>(0, 5), { 5, 0 }, { -1, 2 } })
  {
    const Status status = image_outline(context, columns, rows, never, {}, outline);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    EXPECT_THAT(status.message, HasSubstr("no pixels"));
  }
  for (const double simplify : { -0.1, 1.1, double(NAN) })
  {
    EXPECT_THAT(
      outline_of({ { 1.0f } }, outline, simplify).message, HasSubstr("from 0 to 1 pixel"));
  }
  EXPECT_THAT(
    image_outline(context, 1, 1, never, { 0.0, 0.5 }, outline).message, HasSubstr("threshold"));
  Status status = outline_of({ { 0.0f, 0.4f }, { 0.1f, 0.0f } }, outline);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_THAT(status.message, HasSubstr("transparent"));
  status = outline_of({ { NAN, NAN } }, outline);
  EXPECT_THAT(status.message, HasSubstr("transparent"));
  context.request_cancel();
  EXPECT_EQ(image_outline(
              context, 1, 1, [](Index, float* value) { *value = 1.0f; }, {}, outline)
              .code,
    StatusCode::canceled);
}

TEST(ImageOutline, HugeImageInSeconds)
{
  constexpr Index size = 8192;
  ExecutionContext context;
  ImageOutline outline;
  const auto start = std::chrono::steady_clock::now();
  const Status status = image_outline(
    context, size, size,
    [](Index row, float* values)
    {
      for (Index x = 0; x < size; ++x)
      {
        const double dx = static_cast<double>(x) - 4000.0;
        const double dy = static_cast<double>(row) - 4100.0;
        values[x] = dx * dx + dy * dy < 3900.0 * 3900.0 ? 1.0f : 0.0f;
      }
    },
    {}, outline);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  ASSERT_TRUE(status.ok());
  EXPECT_NEAR(outline_area(outline) / (M_PI * 3900.0 * 3900.0), 1.0, 1e-3);
  EXPECT_LT(outline.points.rows(), 3000);
  // The measured time is 1 s on an idle machine and 21 s with sanitizers.
  EXPECT_LT(seconds.count(), test::sanitized ? 120.0 : 20.0);
}
