// Winding numbers of plane curves. They are compared with known integers, angles and symmetries,
// and with the plain sum of angles.
#include "winding/curve_winding_number.h"

#include "base/constants.h"

#include "support/curves.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace bindpose;
using test::Curve;

namespace
{
Curve make_curve(const std::vector<Vec2>& vertices, bool closed = true)
{
  Curve curve;
  curve.add(vertices, closed);
  return curve;
}

/// Return [lower, upper]^2, counter-clockwise from the lower left corner.
std::vector<Vec2> square_corners(double lower = -1.0, double upper = 1.0)
{
  return { { lower, lower }, { upper, lower }, { upper, upper }, { lower, upper } };
}

std::vector<Vec2> reversed(std::vector<Vec2> vertices)
{
  std::reverse(vertices.begin(), vertices.end());
  return vertices;
}

void expect_curve_winding(
  const Curve& curve, const Vec2& p, double expected, double tolerance = 1e-15)
{
  EXPECT_NEAR(curve_winding_number_direct(curve.points, curve.segments, p), expected,
    std::max(tolerance, 1e-14))
    << "sum at " << p.transpose();
  const CurveWindingNumber winding(curve.points, curve.segments);
  EXPECT_TRUE(winding.status().ok()) << winding.status().message;
  EXPECT_NEAR(winding.evaluate_at(p), expected, tolerance) << "at " << p.transpose();
}

/// Return a closed curve without crossings: r = 1 + amplitude cos(waves angle).
std::vector<Vec2> flower(Index count, double amplitude, int waves)
{
  std::vector<Vec2> vertices;
  for (Index i = 0; i < count; ++i)
  {
    const double angle = 2.0 * pi * static_cast<double>(i) / static_cast<double>(count);
    const double r = 1.0 + amplitude * std::cos(waves * angle);
    vertices.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return vertices;
}

PlanePoints random_plane_points(Index count, double reach, std::uint64_t seed)
{
  test::Random random(seed);
  PlanePoints points(count, 2);
  for (Index i = 0; i < count; ++i)
  {
    points.row(i) << random.uniform(-reach, reach), random.uniform(-reach, reach);
  }
  return points;
}
} // namespace

TEST(CurveWindingNumber, ClosedCurvesGiveWholeNumbersExactly)
{
  const Curve curve = make_curve(square_corners());
  const CurveWindingNumber winding(curve.points, curve.segments);
  const Curve clockwise = make_curve(reversed(square_corners()));
  const CurveWindingNumber minus(clockwise.points, clockwise.segments);
  test::Random random(7);
  for (int i = 0; i < 2000; ++i)
  {
    const Vec2 p(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0));
    const double expected = p.cwiseAbs().maxCoeff() < 1.0 ? 1.0 : 0.0;
    ASSERT_EQ(winding.evaluate_at(p), expected) << p.transpose();
    ASSERT_EQ(minus.evaluate_at(p), -expected) << p.transpose();
  }
}

TEST(CurveWindingNumber, ThreeSidesOfASquareAreThreeQuarters)
{
  expect_curve_winding(make_curve(square_corners(), false), Vec2::Zero(), 0.75);
}

TEST(CurveWindingNumber, SegmentSeenUnderARightAngleIsAQuarter)
{
  const Curve segment = make_curve({ { 1, -1 }, { 1, 1 } }, false);
  expect_curve_winding(segment, Vec2::Zero(), 0.25);
  expect_curve_winding(segment, Vec2(2, 0), -0.25);
  // This segment crosses the negative x axis, where polar angles jump from pi to -pi. The winding
  // number must still be 1/4.
  expect_curve_winding(make_curve({ { -1, 1 }, { -1, -1 } }, false), Vec2::Zero(), 0.25);
  // At the third corner of an equilateral triangle, the opposite side subtends an angle of 60
  // degrees.
  expect_curve_winding(
    make_curve({ { 0, 0 }, { 1, 0 } }, false), Vec2(0.5, 0.5 * std::sqrt(3.0)), 1.0 / 6.0);
}

TEST(CurveWindingNumber, PentagramWindsTwiceInItsCenterAndOnceInItsArms)
{
  std::vector<Vec2> vertices;
  for (int i = 0; i < 5; ++i)
  {
    const double angle = 0.5 * pi + 4.0 * pi * i / 5.0;
    vertices.emplace_back(std::cos(angle), std::sin(angle));
  }
  const Curve star = make_curve(vertices);
  expect_curve_winding(star, Vec2(0, 0), 2.0, 0.0);
  expect_curve_winding(star, Vec2(0, 0.8), 1.0, 0.0);
  expect_curve_winding(star, Vec2(0, -0.8), 0.0, 0.0);
  const Report report = CurveWindingNumber(star.points, star.segments).status().report;
  EXPECT_EQ(report.number("counts.open_ends", -1), 0);
}

TEST(CurveWindingNumber, PartsAddUp)
{
  Curve nested = make_curve(square_corners());
  nested.add(square_corners(-0.5, 0.5), true);
  expect_curve_winding(nested, Vec2::Zero(), 2.0, 0.0);
  Curve ring = make_curve(square_corners());
  ring.add(reversed(square_corners(-0.5, 0.5)), true);
  expect_curve_winding(ring, Vec2::Zero(), 0.0, 0.0);
  expect_curve_winding(ring, Vec2(0.75, 0), 1.0, 0.0);
  Curve overlapping = make_curve(square_corners());
  overlapping.add(square_corners(0.0, 2.0), true);
  expect_curve_winding(overlapping, Vec2(0.5, 0.5), 2.0, 0.0);
  // In `doubled`, the top side of the square occurs twice. In `flipped`, the top side is reversed.
  Curve doubled = make_curve(square_corners());
  doubled.add_segment(2, 3);
  expect_curve_winding(doubled, Vec2::Zero(), 1.25);
  Curve flipped = make_curve(square_corners(), false);
  flipped.segments.row(2) << 3, 2;
  flipped.add_segment(3, 0);
  expect_curve_winding(flipped, Vec2::Zero(), 0.5);
}

TEST(CurveWindingNumber, PrincipalValueOnTheCurve)
{
  const Curve curve = make_curve(square_corners());
  const CurveWindingNumber winding(curve.points, curve.segments);
  for (const auto& [p, expected] : std::vector<std::pair<Vec2, double>>{ { { 1, 0.3 }, 0.5 },
         { { -0.2, -1 }, 0.5 }, { { -1, 0 }, 0.5 }, { { 1, 1 }, 0.25 }, { { -1, -1 }, 0.25 } })
  {
    expect_curve_winding(curve, p, expected);
    bool on_curve = false;
    winding.evaluate_at(p, &on_curve);
    EXPECT_TRUE(on_curve) << p.transpose();
    winding.evaluate_at(p + Vec2(1e-6, 2e-6), &on_curve);
    EXPECT_FALSE(on_curve) << p.transpose();
  }
  // At a corner of a regular polygon with n corners, the winding number is (n - 2) / (2 n). This is
  // also true far from the origin.
  std::vector<Vec2> vertices;
  for (int i = 0; i < 7; ++i)
  {
    vertices.emplace_back(1e4 + std::cos(2.0 * pi * i / 7.0), std::sin(2.0 * pi * i / 7.0) - 3e4);
  }
  const Curve heptagon = make_curve(vertices);
  // The tolerance allows for rounded coordinates.
  expect_curve_winding(heptagon, vertices[3], 5.0 / 14.0, 1e-10);
  expect_curve_winding(heptagon, 0.5 * (vertices[1] + vertices[2]), 0.5, 1e-10);
  expect_curve_winding(heptagon, 0.3 * vertices[6] + 0.7 * vertices[0], 0.5, 1e-10);
  // The first point is at an open end. The second point is on a segment that is repeated in the
  // opposite direction.
  expect_curve_winding(make_curve({ { 0, 0 }, { 1, 0 }, { 1, 1 } }, false), Vec2(0, 0), 0.125);
  expect_curve_winding(make_curve({ { 0, 0 }, { 1, 0 }, { 0, 0 } }, false), Vec2(0.5, 0), 0.0);
}

TEST(CurveWindingNumber, JumpsByOneAcrossTheCurveAndNotAcrossChords)
{
  const Curve curve = make_curve(square_corners(), false); // the side x = -1 is open
  const CurveWindingNumber winding(curve.points, curve.segments);
  for (const double e : { 1e-3, 1e-6, 1e-9, 1e-14 })
  {
    const double inside = winding.evaluate_at(Vec2(0.25, -1.0 + e));
    const double outside = winding.evaluate_at(Vec2(0.25, -1.0 - e));
    EXPECT_NEAR(inside - outside, 1.0, e);
    const double before = winding.evaluate_at(Vec2(-1.0 + e, 0.25));
    const double behind = winding.evaluate_at(Vec2(-1.0 - e, 0.25));
    EXPECT_NEAR(before - behind, 0.0, e);
  }
  // The points are on the missing side x = -1 or on the extension of this side. There is no segment
  // at these points, so no contact is reported.
  for (const double y : { 0.25, 0.0, 5.0, -5.0 })
  {
    bool on_curve = true;
    EXPECT_NEAR(winding.evaluate_at(Vec2(-1, y), &on_curve),
      curve_winding_number_direct(curve.points, curve.segments, Vec2(-1, y)), 1e-15);
    EXPECT_FALSE(on_curve) << y;
  }
  EXPECT_NEAR(winding.evaluate_at(Vec2(-1, 0)), 0.5, 1e-15);
  EXPECT_NEAR(winding.evaluate_at(Vec2(-1, 5)) + winding.evaluate_at(Vec2(-1, -5)), 0.0, 1e-15);
}

TEST(CurveWindingNumber, SameAsTheSumOfAnglesOnHeapsOnALattice)
{
  // Vertices and query points are on a small lattice. The points are on segments, at vertices,
  // collinear with segments, or at the height of vertices. Many segments are repeated, opposite,
  // branching or collinear.
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
  {
    test::Random random(seed);
    const Index lattice = 2 + random.below(9);
    const Index vertices = 3 + random.below(40);
    const Index segments = 1 + random.below(120);
    Curve curve;
    curve.points.resize(vertices, 2);
    for (Index v = 0; v < vertices; ++v)
    {
      curve.points.row(v) << static_cast<double>(random.below(lattice)),
        static_cast<double>(random.below(lattice));
    }
    curve.segments.resize(segments, 2);
    const bool polyline = seed % 3 == 0;
    for (Index e = 0; e < segments; ++e)
    {
      curve.segments.row(e) << (polyline ? e % vertices : random.below(vertices)),
        (polyline ? (e + 1) % vertices : random.below(vertices));
    }
    const CurveWindingNumber winding(curve.points, curve.segments);
    ASSERT_TRUE(winding.status().ok());
    const bool closed = winding.status().report.number("counts.open_ends", -1) == 0;
    for (Index i = -1; i <= 2 * lattice; ++i)
    {
      for (Index j = -1; j <= 2 * lattice; ++j)
      {
        const Vec2 p(0.5 * static_cast<double>(i), 0.5 * static_cast<double>(j));
        bool touches = false, touches_direct = false;
        const double value = winding.evaluate_at(p, &touches);
        const double direct =
          curve_winding_number_direct(curve.points, curve.segments, p, &touches_direct);
        ASSERT_NEAR(value, direct, 1e-13) << "seed " << seed << " at " << p.transpose();
        ASSERT_EQ(touches, touches_direct) << "seed " << seed << " at " << p.transpose();
        if (closed && !touches)
        {
          ASSERT_EQ(value, std::round(value)) << "seed " << seed << " at " << p.transpose();
        }
      }
    }
  }
}

TEST(CurveWindingNumber, SameAsTheSumOfAnglesOnLongCurves)
{
  Curve curve = make_curve(flower(3000, 0.3, 9));
  curve.add(flower(500, 0.1, 40), false);
  for (Index i = 0; i < 200; ++i) // add short scattered curves
  {
    test::Random random(static_cast<std::uint64_t>(i) + 99);
    const Vec2 at(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5));
    curve.add({ at, at + Vec2(0.01, 0.02), at + Vec2(-0.02, 0.05) }, i % 2 == 0);
  }
  const CurveWindingNumber winding(curve.points, curve.segments);
  EXPECT_EQ(winding.status().report.number("counts.open_ends", -1), 202);
  EXPECT_EQ(winding.status().report.number("counts.components", -1), 202);
  PlanePoints queries = random_plane_points(2000, 1.6, 5);
  for (Index i = 0; i < 600; ++i) // points at vertices, at midpoints of segments, and next to them
  {
    const Index e = (37 * i) % curve.segments.rows();
    const Vec2 a = curve.points.row(curve.segments(e, 0));
    const Vec2 b = curve.points.row(curve.segments(e, 1));
    queries.row(i) = (i % 3 == 0 ? a : Vec2(0.5 * (a + b))).transpose();
    queries(i, 0) += i % 3 == 1 ? 1e-13 : 0.0;
  }
  ExecutionContext context;
  Eigen::VectorXd values;
  const Status status = winding.evaluate(context, queries, values);
  ASSERT_TRUE(status.ok());
  EXPECT_GE(status.report.number("counts.on_surface", -1), 200);
  for (Index i = 0; i < queries.rows(); ++i)
  {
    ASSERT_NEAR(
      values[i], curve_winding_number_direct(curve.points, curve.segments, queries.row(i)), 1e-12)
      << queries.row(i);
  }
}

TEST(CurveWindingNumber, FlowerIsInsideWhereItsRadiusSays)
{
  // The distance of the polygon from its curve is below 1e-5.
  const Curve curve = make_curve(flower(20000, 0.3, 9));
  const CurveWindingNumber winding(curve.points, curve.segments);
  const PlanePoints queries = random_plane_points(5000, 1.5, 11);
  for (Index i = 0; i < queries.rows(); ++i)
  {
    const double r = queries.row(i).norm();
    const double edge = 1.0 + 0.3 * std::cos(9.0 * std::atan2(queries(i, 1), queries(i, 0)));
    if (std::abs(r - edge) > 1e-4)
    {
      ASSERT_EQ(winding.evaluate_at(queries.row(i)), r < edge ? 1.0 : 0.0) << queries.row(i);
    }
  }
}

TEST(CurveWindingNumber, GradientIsThatOfTheField)
{
  // The point is in front of a segment from (1, -1) to (1, 1). On the x axis the angle is 2 atan(1
  // / (1 - x)), and its derivative is 2 / ((1 - x)^2 + 1). At x = 0 this gives the gradient 1 / (2
  // pi).
  const Curve segment = make_curve({ { 1, -1 }, { 1, 1 } }, false);
  ExecutionContext context;
  PlanePoints query(1, 2);
  query << 0, 0;
  Vec2 gradient;
  ASSERT_TRUE(CurveWindingNumber(segment.points, segment.segments)
                .evaluate_gradient(context, query, gradient.data())
                .ok());
  EXPECT_NEAR(gradient.x(), 0.5 / pi, 1e-15);
  EXPECT_NEAR(gradient.y(), 0.0, 1e-15);

  Curve curve = make_curve(flower(200, 0.3, 5), false);
  curve.add({ { -1, 0.3 }, { 0.4, 0.5 }, { 0.1, -0.8 } }, false);
  curve.add(square_corners(-0.1, 0.2), true);
  for (const double unit : { 1.0, 1000.0 })
  {
    const CurveWindingNumber winding(PlanePoints(unit * curve.points), curve.segments);
    PlanePoints queries = unit * random_plane_points(200, 1.4, 3);
    Eigen::VectorXd gradients(2 * queries.rows());
    ASSERT_TRUE(winding.evaluate_gradient(context, queries, gradients.data()).ok());
    for (Index i = 0; i < queries.rows(); ++i)
    {
      const Vec2 p = queries.row(i);
      const double h = 1e-5 * unit;
      for (int k = 0; k < 2; ++k)
      {
        const double difference =
          winding.evaluate_at(p + h * Vec2::Unit(k)) - winding.evaluate_at(p - h * Vec2::Unit(k));
        // The gradient excludes integer jumps across the curve.
        const double smooth = (difference - std::round(difference)) / (2.0 * h);
        ASSERT_NEAR(unit * gradients[2 * i + k], unit * smooth, 1e-4) << p.transpose();
      }
    }
  }
  // The gradient must be zero inside of a closed curve, finite at an open end, and zero far away
  // from the curve.
  const Curve closed = make_curve(square_corners());
  ASSERT_TRUE(CurveWindingNumber(closed.points, closed.segments)
                .evaluate_gradient(context, query, gradient.data())
                .ok());
  EXPECT_EQ(gradient, Vec2(0, 0));
  PlanePoints special(3, 2);
  special << 1, 1, 1e200, 0, std::numeric_limits<double>::quiet_NaN(), 0;
  Eigen::VectorXd at(6);
  ASSERT_TRUE(CurveWindingNumber(segment.points, segment.segments)
                .evaluate_gradient(context, special, at.data())
                .ok());
  // The point (1, 1) is one end of the curve. Only the other end contributes, which is at a
  // distance of 2 below the point.
  EXPECT_NEAR(at[0], 0.25 / pi, 1e-15);
  EXPECT_NEAR(at[1], 0.0, 1e-15);
  EXPECT_EQ(at[2], 0.0);
  EXPECT_TRUE(std::isnan(at[4]));
}

TEST(CurveWindingNumber, ShiftsScalesAndOrderDoNotMatter)
{
  Curve curve = make_curve(flower(400, 0.3, 7));
  curve.add(flower(90, 0.2, 3), false);
  curve.add(square_corners(-0.2, 0.3), false);
  const auto snap = [](double x) { return std::round(x * 0x1p20) * 0x1p-20; };
  curve.points = PlanePoints(curve.points.unaryExpr(snap));
  const PlanePoints queries = random_plane_points(300, 1.5, 17).unaryExpr(snap);
  const auto values = [](const PlanePoints& points, const Segments& segments, const PlanePoints& at)
  {
    Eigen::VectorXd w;
    ExecutionContext context;
    EXPECT_TRUE(CurveWindingNumber(points, segments).evaluate(context, at, w).ok());
    return w;
  };
  const Eigen::VectorXd expected = values(curve.points, curve.segments, queries);
  for (const double shift : { 0x1p10, -0x1p26 })
  {
    const PlanePoints moved = curve.points.array() + shift;
    const PlanePoints at = queries.array() + shift;
    EXPECT_LE((values(moved, curve.segments, at) - expected).lpNorm<Eigen::Infinity>(), 1e-13);
  }
  for (const double scale : { 0x1p-30, 0x1p17, 0x1p100, 0x1p-1000, 0x1p990 })
  {
    EXPECT_EQ(values(scale * curve.points, curve.segments, scale * queries), expected) << scale;
  }
  PlanePoints shuffled = curve.points;
  Segments renamed = curve.segments;
  const Index n = shuffled.rows(); // 494 is not divisible by 101, so the permutation below is valid
  for (Index v = 0; v < n; ++v)
  {
    shuffled.row((v * 101) % n) = curve.points.row(v);
  }
  for (Index e = 0; e < renamed.rows(); ++e)
  {
    const Index from = renamed.rows() - 1 - e;
    renamed.row(e) << (curve.segments(from, 0) * 101) % n, (curve.segments(from, 1) * 101) % n;
  }
  EXPECT_LE((values(shuffled, renamed, queries) - expected).lpNorm<Eigen::Infinity>(), 1e-13);
}

TEST(CurveWindingNumber, HugeAndTinyCurvesAreNoExceptions)
{
  for (const double size : { 1e-320, 1e-300, 1.0, 1e150, 1e307, 1.7e308 })
  {
    const Curve curve = make_curve(square_corners(-size, size));
    EXPECT_EQ(CurveWindingNumber(curve.points, curve.segments).evaluate_at(Vec2::Zero()), 1.0)
      << size;
    expect_curve_winding(make_curve(square_corners(-size, size), false), Vec2::Zero(), 0.75);
  }
}

TEST(CurveWindingNumber, ReportTellsWhatTheCurveIs)
{
  // Each side of the square has its own two vertices. Later a side is repeated, and two segments of
  // length zero are added. One of them has equal vertex ids, the other one has equal positions.
  Curve curve;
  const std::vector<Vec2> corners = square_corners();
  for (int i = 0; i < 4; ++i)
  {
    curve.add({ corners[i], corners[(i + 1) % 4] }, false);
  }
  ExecutionContext context;
  CurveWindingNumber winding;
  Report report = winding.build(context, curve.points, curve.segments).report;
  EXPECT_EQ(report.number("counts.vertices", -1), 8);
  EXPECT_EQ(report.number("counts.segments", -1), 4);
  EXPECT_EQ(report.number("counts.merged_vertices", -1), 4);
  EXPECT_EQ(report.number("counts.open_ends", -1), 0);
  EXPECT_EQ(report.number("counts.components", -1), 1);
  EXPECT_EQ(report.number("area", -1), 4.0);
  EXPECT_EQ(report.text("method"), "crossings");
  EXPECT_EQ(winding.evaluate_at(Vec2(0.1, 0.2)), 1.0);
  EXPECT_GT(winding.memory(), 0);

  curve.add_segment(1, 0);
  curve.add_segment(2, 2);
  curve.add_segment(0, 7); // the vertices have different ids but equal coordinates
  curve.add({ { 5, 5 }, { 6, 5 } }, false);
  report = winding.build(context, curve.points, curve.segments).report;
  EXPECT_EQ(report.number("counts.duplicate_segments", -1), 1);
  EXPECT_EQ(report.number("counts.degenerate_segments", -1), 2);
  EXPECT_EQ(report.number("counts.boundary_vertices", -1), 2);
  EXPECT_EQ(report.number("counts.nonmanifold_vertices", -1), 2);
  EXPECT_EQ(report.number("counts.open_ends", -1), 4);
  EXPECT_EQ(report.number("counts.components", -1), 2);
  // The lower side and its repetition cancel, so the curve is open there.
  EXPECT_NEAR(winding.evaluate_at(Vec2(0, 0)),
    0.75 + (std::atan2(5.0, 6.0) - std::atan2(5.0, 5.0)) / (2.0 * pi), 1e-15);
}

TEST(CurveWindingNumber, NothingWindsAroundNothing)
{
  const CurveWindingNumber empty(PlanePoints(0, 2), Segments(0, 2));
  EXPECT_TRUE(empty.status().ok());
  EXPECT_EQ(empty.status().warnings.size(), 1u);
  EXPECT_EQ(empty.evaluate_at(Vec2(1, 2)), 0.0);
  // Before a build, the winding number is 0 everywhere.
  EXPECT_EQ(CurveWindingNumber().evaluate_at(Vec2(1, 2)), 0.0);
  const Curve dot = make_curve({ { 3, 3 }, { 3, 3 } });
  const CurveWindingNumber degenerate(dot.points, dot.segments);
  EXPECT_EQ(degenerate.status().warnings.size(), 1u);
  EXPECT_EQ(degenerate.evaluate_at(Vec2(3, 3)), 0.0);
}

TEST(CurveWindingNumber, BadInputIsNamed)
{
  ExecutionContext context;
  CurveWindingNumber winding;
  Curve curve = make_curve(square_corners());
  curve.segments(2, 1) = 4;
  Status status = winding.build(context, curve.points, curve.segments);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_NE(status.message.find("segment 2 references vertex 4"), std::string::npos);
  Eigen::VectorXd w;
  EXPECT_EQ(winding.evaluate(context, curve.points, w).code, StatusCode::invalid_input);
  curve.segments(2, 1) = -1;
  EXPECT_EQ(winding.build(context, curve.points, curve.segments).code, StatusCode::invalid_input);
  curve = make_curve(square_corners());
  for (const double bad :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    curve.points(3, 1) = bad;
    status = winding.build(context, curve.points, curve.segments);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    EXPECT_NE(status.message.find("vertex 3"), std::string::npos);
  }
  // An unused vertex may have any coordinates.
  curve.points.row(3).setZero();
  curve.points.conservativeResize(5, 2);
  curve.points.row(4).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(winding.build(context, curve.points, curve.segments).ok());
}

TEST(CurveWindingNumber, PointsThatAreNoneGiveNaN)
{
  const Curve curve = make_curve(square_corners());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  PlanePoints queries(5, 2);
  queries << 0, 0, nan, 0, 0, std::numeric_limits<double>::infinity(), 1e300, 0, 1, 1;
  ExecutionContext context;
  std::vector<double> values(5);
  std::vector<unsigned char> flags(5, 7);
  const Status status = CurveWindingNumber(curve.points, curve.segments)
                          .evaluate(context, queries, values.data(), flags.data());
  EXPECT_TRUE(status.ok());
  EXPECT_EQ(status.report.number("counts.queries", -1), 5);
  EXPECT_EQ(status.report.number("counts.not_finite", -1), 2);
  EXPECT_EQ(status.report.number("counts.on_surface", -1), 1);
  EXPECT_EQ(status.warnings.size(), 1u);
  EXPECT_EQ(values[0], 1.0);
  EXPECT_TRUE(std::isnan(values[1]));
  EXPECT_TRUE(std::isnan(values[2]));
  EXPECT_EQ(values[3], 0.0);
  EXPECT_EQ(flags, (std::vector<unsigned char>{ 0, 0, 0, 0, 1 }));
}

TEST(CurveWindingNumber, SameBitsOnAnyNumberOfThreads)
{
  Curve curve = make_curve(flower(100000, 0.3, 9));
  curve.add(flower(30000, 0.2, 4), false);
  const PlanePoints queries = random_plane_points(100000, 1.5, 23);
  std::vector<Eigen::VectorXd> values;
  for (const int threads : { 1, 2, 3 })
  {
    ExecutionContext context;
    context.set_threads(threads);
    CurveWindingNumber winding;
    ASSERT_TRUE(winding.build(context, curve.points, curve.segments).ok());
    values.emplace_back();
    ASSERT_TRUE(winding.evaluate(context, queries, values.back()).ok());
  }
  EXPECT_EQ(values[0], values[1]);
  EXPECT_EQ(values[0], values[2]);
}

TEST(CurveWindingNumber, CancelsMidwayAndRunsAgain)
{
  const Curve curve = make_curve(flower(200000, 0.3, 9));
  const PlanePoints queries = random_plane_points(300000, 1.5, 29);
  int allowed = 0;
  int cancel_checks = 0;
  ExecutionContext probe({},
    [&]
    {
      ++cancel_checks;
      return false;
    });
  probe.set_threads(1);
  CurveWindingNumber winding;
  ASSERT_TRUE(winding.build(probe, curve.points, curve.segments).ok());
  const int build_checks = cancel_checks;
  Eigen::VectorXd w;
  ASSERT_TRUE(winding.evaluate(probe, queries, w).ok());
  const int in_all = cancel_checks;
  ASSERT_GT(build_checks, 10);
  ASSERT_GT(in_all, build_checks + 5);
  for (const int quarters : { 0, 1, 2, 3 })
  {
    allowed = build_checks * quarters / 4;
    ExecutionContext context({}, [&] { return --allowed < 0; });
    context.set_threads(1);
    EXPECT_EQ(winding.build(context, curve.points, curve.segments).code, StatusCode::canceled);
    EXPECT_EQ(winding.status().code, StatusCode::canceled);
  }
  ExecutionContext quiet;
  ASSERT_TRUE(winding.build(quiet, curve.points, curve.segments).ok());
  allowed = 4;
  ExecutionContext context({}, [&] { return --allowed < 0; });
  context.set_threads(1);
  EXPECT_EQ(winding.evaluate(context, queries, w).code, StatusCode::canceled);
  Eigen::VectorXd again;
  EXPECT_TRUE(winding.evaluate(quiet, queries, again).ok());
  double largest = 0.0;
  std::vector<double> fractions;
  ExecutionContext watched(
    [&](double fraction, const std::string&) { fractions.push_back(fraction); }, {});
  EXPECT_TRUE(winding.build(watched, curve.points, curve.segments).ok());
  for (const double fraction : fractions)
  {
    EXPECT_GE(fraction, largest);
    largest = fraction;
  }
}
