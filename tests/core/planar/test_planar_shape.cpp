// Triangulations of the region that planar curves enclose: exact areas, angles, edges, handles, and
// bad input.
#include "planar/planar_shape.h"

#include "support/environment.h"
#include "support/needs_mesher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <set>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
struct Curves
{
  PlanePoints points = PlanePoints(0, 2);
  Segments segments = Segments(0, 2);

  /// Append a polyline, closed or open.
  Curves& add(const std::vector<Vec2>& corners, bool closed = true)
  {
    const Index first = this->points.rows();
    const auto count = static_cast<Index>(corners.size());
    this->points.conservativeResize(first + count, 2);
    for (Index k = 0; k < count; ++k)
    {
      this->points.row(first + k) = corners[k].transpose();
      if (k + 1 < count || closed)
      {
        this->segments.conservativeResize(this->segments.rows() + 1, 2);
        this->segments.bottomRows<1>() << first + k, first + (k + 1) % count;
      }
    }
    return *this;
  }
};

std::vector<Vec2> polygon_on_circle(
  int count, double radius, double turns = 1.0, const Vec2& center = { 0, 0 })
{
  std::vector<Vec2> corners;
  for (int k = 0; k < count; ++k)
  {
    const double angle = turns * 2.0 * M_PI * k / count + 0.1;
    corners.push_back(center + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

const std::vector<Vec2> unit_square{ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };

/// Return the sum of the triangles' areas. Expect that each area is positive.
double shape_area(const PlanarShape& shape)
{
  double area = 0.0;
  for (Index t = 0; t < shape.triangles.rows(); ++t)
  {
    const Vec2 a = shape.points.row(shape.triangles(t, 0));
    const Vec2 b = shape.points.row(shape.triangles(t, 1));
    const Vec2 c = shape.points.row(shape.triangles(t, 2));
    const double twice = cross(b - a, c - a);
    EXPECT_GT(twice, 0.0) << "triangle " << t;
    area += 0.5 * twice;
  }
  return area;
}

/// Return the smallest angle in degrees of the triangles. Triangles with a corner at one of the
/// points `except` are ignored.
double smallest_angle(const PlanarShape& shape, const std::vector<Vec2>& except = {})
{
  double smallest = 180.0;
  for (Index t = 0; t < shape.triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vec2 a = shape.points.row(shape.triangles(t, k));
      const Vec2 b = shape.points.row(shape.triangles(t, (k + 1) % 3)).transpose() - a;
      const Vec2 c = shape.points.row(shape.triangles(t, (k + 2) % 3)).transpose() - a;
      const bool skip = std::any_of(
        except.begin(), except.end(), [&](const Vec2& p) { return (p - a).norm() < 1e-12; });
      if (!skip)
      {
        smallest = std::min(smallest, std::atan2(cross(b, c), b.dot(c)) * 180.0 / M_PI);
      }
    }
  }
  return smallest;
}

/// Return the total length of the mesh edges that are on the segment from a to b.
double covered_length(const PlanarShape& shape, const Vec2& a, const Vec2& b)
{
  const double length = (b - a).norm();
  const Vec2 along = (b - a) / length;
  std::set<std::pair<Index, Index>> edges;
  for (Index t = 0; t < shape.triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      edges.insert(
        std::minmax(Index(shape.triangles(t, k)), Index(shape.triangles(t, (k + 1) % 3))));
    }
  }
  double sum = 0.0;
  for (const auto& [v, w] : edges)
  {
    double at[2];
    bool on = true;
    for (int k = 0; k < 2; ++k)
    {
      const Vec2 p = shape.points.row(k == 0 ? v : w).transpose() - a;
      at[k] = p.dot(along);
      on = on && std::abs(cross(along, p)) < 1e-12 * length && at[k] > -1e-12 * length &&
        at[k] < length * (1.0 + 1e-12);
    }
    sum += on ? std::abs(at[1] - at[0]) : 0.0;
  }
  return sum;
}

/// Expect that all vertices are used and that each edge has at most one triangle on each side.
void expect_mesh(const PlanarShape& shape)
{
  std::set<std::pair<Index, Index>> sides;
  std::set<Index> used;
  for (Index t = 0; t < shape.triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      used.insert(shape.triangles(t, k));
      EXPECT_TRUE(sides.insert({ shape.triangles(t, k), shape.triangles(t, (k + 1) % 3) }).second);
    }
  }
  EXPECT_EQ(static_cast<Index>(used.size()), shape.points.rows());
  EXPECT_EQ(shape.winding_numbers.size(), shape.triangles.rows());
  EXPECT_EQ(static_cast<Index>(shape.original_vertices.size()), shape.points.rows());
  std::set<std::pair<double, double>> places;
  for (Index v = 0; v < shape.points.rows(); ++v)
  {
    EXPECT_TRUE(places.insert({ shape.points(v, 0), shape.points(v, 1) }).second);
  }
}

class PlanarShapeTest : public test::MesherTest
{
protected:
  Status run(const Curves& curves)
  {
    ExecutionContext context;
    return planar_shape(context, curves.points, curves.segments, handles, options, shape);
  }
  double area(const Curves& curves)
  {
    status = this->run(curves);
    EXPECT_TRUE(status.ok()) << status.message;
    expect_mesh(shape);
    const double sum = shape_area(shape);
    // The area in the report was computed before the positions of new points were rounded.
    const double rounding = 0x1p-50 * curves.points.cwiseAbs().maxCoeff();
    EXPECT_NEAR(status.report.number("area", -1), sum, 1e-12 * sum + 100.0 * rounding);
    return sum;
  }
  void expect_rejected(const Curves& curves, const std::string& words)
  {
    status = this->run(curves);
    EXPECT_EQ(status.code, StatusCode::invalid_input) << status.message;
    EXPECT_THAT(status.message, HasSubstr(words));
    EXPECT_EQ(shape.triangles.rows(), 0);
  }

  PlanarHandles handles{ PlanePoints(0, 2), Segments(0, 2) };
  PlanarShapeOptions options;
  PlanarShape shape;
  Status status;
};

/// Return the five tips of a pentagram (the star polygon {5/2}), in the order of its closed line.
std::vector<Vec2> pentagram()
{
  return polygon_on_circle(5, 1.0, 2.0);
}

/// Return the area of the whole star if `all` is true, otherwise the area of its inner pentagon.
double pentagram_area(bool all)
{
  const double inner_radius = std::cos(2.0 * M_PI / 5.0) / std::cos(M_PI / 5.0);
  const double pentagon = 2.5 * inner_radius * inner_radius * std::sin(2.0 * M_PI / 5.0);
  const double star = 5.0 * inner_radius * std::sin(M_PI / 5.0);
  return all ? star : pentagon;
}
} // namespace

TEST_F(PlanarShapeTest, Square)
{
  EXPECT_NEAR(area(Curves().add(unit_square)), 1.0, 1e-14);
  EXPECT_GE(smallest_angle(shape), 30.0 - 1e-9);
  EXPECT_TRUE((shape.winding_numbers.array() == 1.0).all());
  EXPECT_TRUE(status.warnings.empty());
  // The vertices of the input come first and are unchanged.
  for (Index v = 0; v < shape.points.rows(); ++v)
  {
    ASSERT_EQ(shape.original_vertices[v], v < 4 ? v : -1);
  }
  for (int k = 0; k < 4; ++k)
  {
    EXPECT_EQ(Vec2(shape.points.row(k)), unit_square[k]);
    EXPECT_NEAR(covered_length(shape, unit_square[k], unit_square[(k + 1) % 4]), 1.0, 1e-12);
  }
  const double longest = options.edge * std::sqrt(2.0);
  EXPECT_LE(status.report.number("longest_edge", 1.0), longest * (1.0 + 1e-12));
  EXPECT_GT(shape.triangles.rows(), 1.0 / (longest * longest));
}

TEST_F(PlanarShapeTest, WithoutRefinement)
{
  options.edge = 0.0;
  options.min_angle = 0.0;
  EXPECT_NEAR(area(Curves().add(unit_square)), 1.0, 1e-14);
  EXPECT_EQ(shape.triangles.rows(), 2);
  EXPECT_EQ(shape.points.rows(), 4);
}

TEST_F(PlanarShapeTest, HolesRunTheOtherWay)
{
  std::vector<Vec2> hole = polygon_on_circle(48, 0.5);
  const double outer = 24.0 * std::sin(2.0 * M_PI / 48.0);
  EXPECT_NEAR(area(Curves().add(polygon_on_circle(48, 1.0)).add(hole)), outer, 1e-12);
  std::reverse(hole.begin(), hole.end());
  const Curves annulus = Curves().add(polygon_on_circle(48, 1.0)).add(hole);
  EXPECT_NEAR(area(annulus), 0.75 * outer, 1e-12);
  EXPECT_GE(smallest_angle(shape), 30.0 - 1e-9);
  for (Index e = 0; e < annulus.segments.rows(); ++e)
  {
    const Vec2 a = annulus.points.row(annulus.segments(e, 0));
    const Vec2 b = annulus.points.row(annulus.segments(e, 1));
    ASSERT_NEAR(covered_length(shape, a, b), (b - a).norm(), 1e-12);
  }
}

TEST_F(PlanarShapeTest, PentagramByThreshold)
{
  const Curves star = Curves().add(pentagram());
  EXPECT_NEAR(area(star), pentagram_area(true), 1e-12);
  EXPECT_EQ(status.report.number("counts.crossings", -1), 5);
  EXPECT_EQ(shape.winding_numbers.maxCoeff(), 2.0);
  EXPECT_EQ(shape.winding_numbers.minCoeff(), 1.0);
  EXPECT_GE(smallest_angle(shape), 30.0 - 1e-9); // the star's tips have 36 degrees
  for (int k = 0; k < 5; ++k) // edges of the mesh cover each line of the star completely
  {
    const Vec2 a = star.points.row(k);
    const Vec2 b = star.points.row((k + 1) % 5);
    EXPECT_NEAR(covered_length(shape, a, b), (b - a).norm(), 1e-10);
  }
  options.winding_threshold = 1.5;
  EXPECT_NEAR(area(star), pentagram_area(false), 1e-12);
  EXPECT_TRUE((shape.winding_numbers.array() == 2.0).all());
  EXPECT_EQ(status.report.number("counts.kept_points", -1), 0);
}

TEST_F(PlanarShapeTest, OpenSquareGetsItsFourthSide)
{
  EXPECT_NEAR(area(Curves().add(unit_square, false)), 1.0, 1e-14);
  EXPECT_EQ(status.report.number("counts.open_ends", -1), 2);
  EXPECT_LT(shape.winding_numbers.maxCoeff(), 1.0);
  EXPECT_GT(shape.winding_numbers.minCoeff(), 0.5);
}

TEST_F(PlanarShapeTest, FigureEight)
{
  // The curve has the shape of an eight. One loop is counter-clockwise and the other one clockwise,
  // so their winding numbers are 1 and -1.
  const Curves eight = Curves().add({ { 0, 0 }, { 3, 3 }, { 3, 0 }, { 0, 3 } });
  const Curves larger = Curves().add({ { 0, 0 }, { 4, 4 }, { 4, 0 }, { 0, 2 } });
  // The lines y = x and y = 2 - x / 2 intersect at x = 4/3.
  const double right = 0.5 * 4.0 * (4.0 - 4.0 / 3.0);
  const double left = 0.5 * 2.0 * 4.0 / 3.0;
  EXPECT_NEAR(area(eight), 2.25, 1e-12);
  EXPECT_NEAR(area(larger), std::max(left, right), 1e-12);
  EXPECT_EQ(status.report.number("turned", -1), 1); // the larger loop of the input is clockwise
}

TEST_F(PlanarShapeTest, ClockwiseIsTurned)
{
  std::vector<Vec2> clockwise(unit_square.rbegin(), unit_square.rend());
  EXPECT_NEAR(area(Curves().add(clockwise)), 1.0, 1e-14);
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("clockwise"));
}

TEST_F(PlanarShapeTest, OverlapsAndDoubledCurves)
{
  std::vector<Vec2> moved;
  for (const Vec2& p : unit_square)
  {
    // Two sides of this square overlap parts of two sides of the unit square.
    moved.emplace_back(p + Vec2(0.5, 0.0));
  }
  const Curves two = Curves().add(unit_square).add(moved);
  EXPECT_NEAR(area(two), 1.5, 1e-14);
  options.winding_threshold = 1.5;
  EXPECT_NEAR(area(two), 0.5, 1e-14);
  const Curves doubled = Curves().add(unit_square).add(unit_square);
  EXPECT_NEAR(area(doubled), 1.0, 1e-14);
  EXPECT_TRUE((shape.winding_numbers.array() == 2.0).all());
  EXPECT_EQ(shape.original_vertices[3], 3); // of two equal vertices, only the first is used
  EXPECT_EQ(shape.original_vertices[4], -1);
}

TEST_F(PlanarShapeTest, LooseSegmentsAreACurve)
{
  Curves soup;
  for (int k = 0; k < 4; ++k)
  {
    soup.add({ unit_square[k], unit_square[(k + 1) % 4] }, false);
  }
  EXPECT_NEAR(area(soup), 1.0, 1e-14);
}

TEST_F(PlanarShapeTest, RandomTangleAgreesWithSampledArea)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  std::vector<Vec2> corners;
  for (int k = 0; k < 60; ++k)
  {
    corners.emplace_back(any(random), any(random));
  }
  const Curves tangle = Curves().add(corners);
  options.min_angle = 20.0;
  options.edge = 0.0;
  const double sum = area(tangle);
  const double sign = status.report.number("turned", 0) > 0 ? -1.0 : 1.0;
  constexpr int samples = 600;
  Index inside = 0;
  const CurveWindingNumber winding(tangle.points, tangle.segments);
  for (int i = 0; i < samples; ++i)
  {
    for (int j = 0; j < samples; ++j)
    {
      inside += sign * winding.evaluate_at({ (i + 0.5) / samples, (j + 0.5) / samples }) >= 0.5;
    }
  }
  EXPECT_NEAR(sum, static_cast<double>(inside) / (samples * samples), 3e-3);
}

TEST_F(PlanarShapeTest, SharpTipsStayAndTheRestIsGood)
{
  const std::vector<Vec2> needle{ { 0, 0 }, { 1, 0 }, { 1, 0.05 } }; // the angle is 2.9 degrees
  EXPECT_NEAR(area(Curves().add(needle)), 0.025, 1e-14);
  EXPECT_NEAR(smallest_angle(shape), std::atan(0.05) * 180.0 / M_PI, 1e-9);
  EXPECT_GE(smallest_angle(shape, { needle[0] }), 20.0);
}

TEST_F(PlanarShapeTest, HandlesAreVerticesAndBonesEdges)
{
  handles.points.resize(5, 2);
  handles.points << 0.3, 0.4, /* a bone across a side */ 0.5, 0.5, 1.5, 0.7, /* on a side */ 0.25,
    0.0,
    /* outside */ 3.0, 3.0;
  handles.bones.resize(1, 2);
  handles.bones << 1, 2;
  EXPECT_NEAR(area(Curves().add(unit_square)), 1.0, 1e-14);
  ASSERT_EQ(shape.handle_vertices.size(), 5u);
  for (const int h : { 0, 1, 3 })
  {
    ASSERT_GE(shape.handle_vertices[h], 0);
    EXPECT_EQ(shape.points.row(shape.handle_vertices[h]), handles.points.row(h));
  }
  EXPECT_EQ(shape.handle_vertices[2], -1);
  EXPECT_EQ(shape.handle_vertices[4], -1);
  EXPECT_EQ(status.report.number("counts.outside_handles", -1), 2);
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("2 of 5"));
  const Vec2 out(1.0, 0.6); // the bone leaves the square here
  EXPECT_NEAR(covered_length(shape, { 0.5, 0.5 }, out), (out - Vec2(0.5, 0.5)).norm(), 1e-12);
  EXPECT_GE(smallest_angle(shape), 25.0);
}

TEST_F(PlanarShapeTest, HandleAtAVertexOfTheCurve)
{
  handles.points.resize(1, 2);
  handles.points << 1.0, 1.0;
  EXPECT_NEAR(area(Curves().add(unit_square)), 1.0, 1e-14);
  EXPECT_EQ(shape.handle_vertices[0], 2);
  EXPECT_EQ(shape.original_vertices[2], 2);
}

TEST_F(PlanarShapeTest, ScaleAndPlaceDoNotMatter)
{
  const Curves star = Curves().add(pentagram());
  const double expected = area(star);
  const Index triangles = shape.triangles.rows();
  for (const double scale : { 0x1p-30, 0x1p30, 0x1p-900, 0x1p500 })
  {
    Curves scaled = star;
    scaled.points *= scale;
    status = run(scaled);
    ASSERT_TRUE(status.ok()) << scale << ": " << status.message;
    EXPECT_EQ(shape.triangles.rows(), triangles) << scale;
    PlanarShape back = shape;
    back.points /= scale;
    EXPECT_NEAR(shape_area(back), expected, 1e-12);
  }
  for (const double far : { 1e3, 1e9 })
  {
    Curves moved = star;
    moved.points.array() += far;
    EXPECT_NEAR(area(moved), expected, 2e-15 * far + 1e-12 + 1e-7 * (far > 1e6));
    EXPECT_GE(smallest_angle(shape), 29.9);
  }
}

TEST_F(PlanarShapeTest, CurvesThatAlmostTouch)
{
  // The corners are points of a coarse lattice plus errors of up to 1e-14. Some segments are
  // therefore too close to each other for refinement, so the points are rounded to a grid.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  std::vector<Vec2> corners;
  std::vector<Vec2> rounded;
  for (int k = 0; k < 60; ++k)
  {
    const Vec2 p(std::round(10.0 * any(random)) / 10.0, std::round(10.0 * any(random)) / 10.0);
    rounded.push_back(p);
    corners.push_back(p + 1e-14 * Vec2(any(random), any(random)));
  }
  options.edge = 0.0;
  options.min_angle = 20.0;
  const double expected = area(Curves().add(rounded));
  EXPECT_NEAR(area(Curves().add(corners)), expected, 1e-9);
  EXPECT_GT(status.report.number("grid", -1), 0.0);
  EXPECT_LT(status.report.number("grid", -1), 1e-11);
}

TEST_F(PlanarShapeTest, TanglesOnALatticeAndFarAway)
{
  // Many lines pass through the same points. At some corners, refinement to 30 degrees does not
  // terminate.
  options.edge = 0.05;
  for (const unsigned seed : { 3u, 4u, 39u, 47u })
  {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> lattice(0, 7);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    std::vector<Vec2> on_lattice;
    std::vector<Vec2> far;
    for (int k = 0; k < 100; ++k)
    {
      on_lattice.emplace_back(lattice(random), lattice(random));
      if (k < 25)
      {
        far.emplace_back(any(random) + 1e11, any(random) - 1e12);
      }
    }
    EXPECT_GT(area(Curves().add(on_lattice)), 0.0);
    EXPECT_TRUE(run(Curves().add(far)).ok()) << status.message;
    EXPECT_GT(shape_area(shape), 0.0);
  }
}

TEST_F(PlanarShapeTest, SameForAnyNumberOfThreads)
{
  const Curves star = Curves().add(pentagram());
  area(star);
  const PlanarShape first = shape;
  ExecutionContext one;
  one.set_threads(1);
  ASSERT_TRUE(planar_shape(one, star.points, star.segments, handles, options, shape).ok());
  EXPECT_EQ(first.points, shape.points);
  EXPECT_EQ(first.triangles, shape.triangles);
  EXPECT_EQ(first.winding_numbers, shape.winding_numbers);
}

TEST_F(PlanarShapeTest, Refuses)
{
  expect_rejected({}, "no curves");
  expect_rejected(Curves().add({ { 1, 2 }, { 1, 2 } }), "coincide");
  expect_rejected(Curves().add({ { 0, 0 }, { 1, 1 }, { 3, 3 } }), "one line");
  expect_rejected(Curves().add({ { 0, 0 }, { NAN, 1 }, { 3, 3 } }), "vertex 1");
  expect_rejected(Curves().add({ { 0, 0 }, { INFINITY, 1 }, { 3, 3 } }), "finite");
  Curves wrong = Curves().add(unit_square);
  wrong.segments(2, 1) = 4;
  expect_rejected(wrong, "segment 2 references vertex 4");
  // Between the two arms the winding number is below 1/2.
  Curves arms;
  arms.add({ { 0, 0 }, { 1, 0 } }, false).add({ { 1, 2 }, { 0, 2 } }, false);
  expect_rejected(arms, "enclose nothing");
}

TEST_F(PlanarShapeTest, RefusesOptions)
{
  const Curves curves = Curves().add(unit_square);
  const PlanarShapeOptions good;
  options.winding_threshold = 0.0;
  expect_rejected(curves, "threshold");
  options = good;
  options.winding_threshold = 1.5;
  expect_rejected(curves, "the largest winding number is 1");
  options = good;
  for (const double angle : { -1.0, 34.0, double(NAN) })
  {
    options.min_angle = angle;
    expect_rejected(curves, "angle");
  }
  options = good;
  for (const double edge : { -1.0, 1e-7, double(NAN) })
  {
    options.edge = edge;
    expect_rejected(curves, "edge");
  }
  options = good;
  options.time_limit = 0.0;
  expect_rejected(curves, "time_limit");
  options = good;
  handles.points.resize(1, 2);
  handles.points << NAN, 0.0;
  expect_rejected(curves, "handle");
}

TEST_F(PlanarShapeTest, Cancel)
{
  const Curves curves = Curves().add(unit_square);
  ExecutionContext context;
  context.request_cancel();
  EXPECT_EQ(planar_shape(context, curves.points, curves.segments, handles, options, shape).code,
    StatusCode::canceled);
  EXPECT_EQ(shape.triangles.rows(), 0);
}

TEST(PlanarShape, WithoutHelperItIsUnavailable)
{
  const test::Environment no_helper("BINDPOSE_MESHER", "/nowhere/bindpose-mesher");
  const Curves curves = Curves().add(unit_square);
  ExecutionContext context;
  PlanarShape shape;
  const Status status = planar_shape(context, curves.points, curves.segments,
    { PlanePoints(0, 2), Segments(0, 2) }, PlanarShapeOptions(), shape);
  EXPECT_EQ(status.code, StatusCode::unavailable);
  EXPECT_THAT(status.message, HasSubstr("BINDPOSE_MESHER"));
}
