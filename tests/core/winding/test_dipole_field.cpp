// Dipole fields approximate the winding number of many small triangles. The error must be below the
// tolerance for all triangles and points. The bits must not depend on how the field is evaluated.
#include "winding/dipole_field.h"

#include "winding/winding_number.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>

using namespace bindpose;

namespace
{
constexpr double touch_tolerance = 0x1.0p-49;

struct FieldCase
{
  std::string name;
  TriangleMesh mesh;
  std::vector<int> multiplicities;
};

FieldCase unit_case(std::string name, TriangleMesh mesh)
{
  std::vector<int> ones(static_cast<std::size_t>(mesh.triangles.rows()), 1);
  return { std::move(name), std::move(mesh), std::move(ones) };
}

TriangleMesh bumpy(int levels)
{
  TriangleMesh mesh = test::sphere(levels);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    const Vec3 p = mesh.points.row(v);
    mesh.points.row(v) *= 0.9 + 0.15 * std::sin(7.0 * p.x()) * std::cos(5.0 * p.y() + p.z());
  }
  return mesh;
}

/// Return disks on a sphere: many small ones at random positions and a large one. Each disk is a
/// fan of triangles.
TriangleMesh caps(int loops)
{
  test::Random random(17);
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;
  for (int l = 0; l <= loops; ++l)
  {
    const Vec3 axis = random.in_box(Vec3::Constant(-1), Vec3::Constant(1)).normalized();
    const Vec3 u = axis.unitOrthogonal();
    const Vec3 v = axis.cross(u);
    const int edges = l == loops ? 200 : 5 + static_cast<int>(random.below(20));
    const double radius = l == loops ? 0.6 : random.uniform(0.01, 0.05);
    const Index first = static_cast<Index>(points.size());
    for (int e = 0; e < edges; ++e)
    {
      const double angle = 6.283185307179586 * e / edges;
      points.push_back(0.8 * axis + radius * (std::cos(angle) * u + std::sin(angle) * v) +
        0.2 * radius * std::cos(3.0 * angle) * axis);
      if (e >= 2)
      {
        triangles.push_back({ first, first + e - 1, first + e });
      }
    }
  }
  TriangleMesh mesh{ Points(static_cast<Index>(points.size()), 3),
    Triangles(static_cast<Index>(triangles.size()), 3) };
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    mesh.points.row(static_cast<Index>(i)) = points[i].transpose();
  }
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    mesh.triangles.row(static_cast<Index>(i)) << triangles[i][0], triangles[i][1], triangles[i][2];
  }
  return mesh;
}

/// Return triangles of all sizes at random positions, some of them degenerate.
TriangleMesh random_soup(Index count)
{
  test::Random random(23);
  TriangleMesh mesh{ Points(3 * count, 3), Triangles(count, 3) };
  for (Index t = 0; t < count; ++t)
  {
    const Vec3 center = random.in_box(Vec3::Constant(-1), Vec3::Constant(1));
    const double size = std::pow(10.0, random.uniform(-3.0, -0.5));
    for (int k = 0; k < 3; ++k)
    {
      mesh.points.row(3 * t + k) =
        (center + size * random.in_box(Vec3::Constant(-1), Vec3::Constant(1))).transpose();
      mesh.triangles(t, k) = 3 * t + k;
    }
    if (t % 10 == 0)
    {
      mesh.points.row(3 * t + 2) = 0.5 * (mesh.points.row(3 * t) + mesh.points.row(3 * t + 1));
    }
    if (t % 25 == 0)
    {
      mesh.points.row(3 * t + 1) = mesh.points.row(3 * t);
    }
  }
  return mesh;
}

std::vector<FieldCase> all_cases()
{
  std::vector<FieldCase> cases;
  cases.push_back(unit_case("closed", bumpy(3)));
  TriangleMesh open = bumpy(4);
  open.triangles.conservativeResize(3 * open.triangles.rows() / 4, 3);
  cases.push_back(unit_case("open", open));
  cases.push_back(unit_case("caps", caps(60)));
  cases.push_back(unit_case("soup", random_soup(500)));
  cases.push_back(unit_case("one triangle", random_soup(1)));
  cases.back().mesh.points << 0.1, 0.2, 0.3, 0.9, 0.1, -0.2, -0.3, 0.8, 0.4;
  cases.push_back(unit_case("slivers", test::grid(1, 300)));
  FieldCase counted = unit_case("multiplicities", random_soup(400));
  for (std::size_t t = 0; t < counted.multiplicities.size(); ++t)
  {
    constexpr int some[] = { 1, -1, 2, -2, 0, 5 };
    counted.multiplicities[t] = some[t % 6];
  }
  cases.push_back(counted);
  return cases;
}

/// Return the plain sum over the triangles. If any multiplicity is not 1, the triangles are
/// evaluated one by one.
double expected_at(const FieldCase& c, const Vec3& p)
{
  if (std::all_of(c.multiplicities.begin(), c.multiplicities.end(), [](int m) { return m == 1; }))
  {
    return winding_number_direct(c.mesh.points, c.mesh.triangles, p);
  }
  double sum = 0.0;
  for (Index t = 0; t < c.mesh.triangles.rows(); ++t)
  {
    const Triangles one = c.mesh.triangles.row(t);
    sum += c.multiplicities[t] * winding_number_direct(c.mesh.points, one, p);
  }
  return sum;
}

DipoleField build_field(const FieldCase& c, double tolerance, int threads = 1)
{
  ExecutionContext context;
  context.set_threads(threads);
  DipoleField::Options options;
  options.tolerance = tolerance;
  DipoleField field;
  EXPECT_TRUE(field.build(
    context, c.mesh.points, c.mesh.triangles, c.multiplicities, touch_tolerance, options));
  return field;
}

/// Return points in and around the box, far away, and near triangles, but not on triangles.
std::vector<Vec3> points_for(const TriangleMesh& mesh, int count, test::Random& random)
{
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i)
  {
    const Index t = random.below(mesh.triangles.rows());
    const Vec3 a = mesh.points.row(mesh.triangles(t, 0));
    const Vec3 b = mesh.points.row(mesh.triangles(t, 1));
    const Vec3 c = mesh.points.row(mesh.triangles(t, 2));
    const double size = std::max((b - a).norm(), 1e-3);
    const Vec3 anywhere = random.in_box(Vec3::Constant(-1), Vec3::Constant(1));
    const double u = random.uniform(), v = random.uniform() * (1.0 - u);
    const Vec3 inside = a + u * (b - a) + v * (c - a);
    points.push_back(1.2 * anywhere);
    points.push_back(inside + size * anywhere);
    points.push_back(inside + 0.1 * size * anywhere);
    points.push_back(inside + 1e-3 * size * anywhere);
    if (i % 4 == 0)
    {
      points.push_back(std::pow(10.0, random.uniform(0.0, 6.0)) * anywhere);
    }
  }
  return points;
}
} // namespace

TEST(DipoleField, IsTheWindingNumberWithinTheTolerance)
{
  for (const FieldCase& c : all_cases())
  {
    for (const double tolerance : { 1e-2, 1e-3, 1e-4, 1e-5, 1e-6 })
    {
      const DipoleField field = build_field(c, tolerance);
      EXPECT_LE(field.measured_error(), 0.5 * tolerance) << c.name << ", " << tolerance;
      test::Random random(31);
      double worst = 0.0;
      for (const Vec3& p : points_for(c.mesh, 80, random))
      {
        worst = std::max(worst, std::abs(field.evaluate(p) - expected_at(c, p)));
      }
      EXPECT_LE(worst, tolerance) << c.name << ", " << tolerance;
    }
  }
}

TEST(DipoleField, TouchingTrianglesCountNothing)
{
  for (const double tolerance : { 1e-3, 1e-6 })
  {
    const FieldCase cube = unit_case("cube", test::cube());
    const DipoleField field = build_field(cube, tolerance);
    bool on_surface = false;
    EXPECT_NEAR(field.evaluate(Vec3(1, 0, 0), &on_surface), 0.5, tolerance);
    EXPECT_TRUE(on_surface);
    EXPECT_NEAR(field.evaluate(Vec3(1, 0.25, 0.5), &on_surface), 0.5, tolerance);
    EXPECT_TRUE(on_surface);
    EXPECT_NEAR(field.evaluate(Vec3(1, 1, 0), &on_surface), 0.25, tolerance);
    EXPECT_TRUE(on_surface);
    EXPECT_NEAR(field.evaluate(Vec3(-1, 1, 1), &on_surface), 0.125, tolerance);
    EXPECT_TRUE(on_surface);
    EXPECT_NEAR(field.evaluate(Vec3(0.9999, 0, 0), &on_surface), 1.0, tolerance);
    EXPECT_FALSE(on_surface);
    EXPECT_NEAR(field.evaluate(Vec3(1.0001, 0, 0), &on_surface), 0.0, tolerance);
    EXPECT_FALSE(on_surface);

    // The query points are vertices, at which several triangles meet. Some of the triangles were
    // subdivided.
    for (const FieldCase& c :
      { unit_case("bumpy", bumpy(3)), unit_case("slivers", test::grid(1, 300)) })
    {
      const DipoleField other = build_field(c, tolerance);
      for (Index v = 0; v < c.mesh.points.rows(); v += 7)
      {
        const Vec3 p = c.mesh.points.row(v);
        EXPECT_NEAR(other.evaluate(p, &on_surface), expected_at(c, p), tolerance);
        EXPECT_TRUE(on_surface);
      }
    }
  }
}

TEST(DipoleField, RowsGiveTheBitsOfTheirPoints)
{
  for (const FieldCase& c : all_cases())
  {
    for (const double tolerance : { 1e-3, 1e-6 })
    {
      const DipoleField field = build_field(c, tolerance);
      const Index count = 300;
      std::vector<double> values(static_cast<std::size_t>(count));
      std::vector<unsigned char> touched(static_cast<std::size_t>(count));
      for (const Vec3& step : { Vec3(0.013, 0, 0), Vec3(-0.02, 0, 0), Vec3(0.01, -0.004, 0.002) })
      {
        const Vec3 first = Vec3(0.3, 0.1, -0.2) - 150.0 * step;
        field.evaluate_row(first, step, count, values.data(), touched.data());
        for (Index i = 0; i < count; ++i)
        {
          bool on_surface = false;
          const Vec3 p = first + static_cast<double>(i) * step;
          ASSERT_EQ(values[i], field.evaluate(p, &on_surface)) << c.name << " at " << p.transpose();
          ASSERT_EQ(touched[i] != 0, on_surface);
        }
      }
    }
  }
}

TEST(DipoleField, ManyPointsAtOnceGiveTheBitsOfEach)
{
  for (const FieldCase& c : all_cases())
  {
    for (const double tolerance : { 1e-3, 1e-6 })
    {
      const DipoleField field = build_field(c, tolerance);
      test::Random random(6);
      const std::vector<Vec3> points = points_for(c.mesh, 25, random);
      const auto count = static_cast<Index>(points.size());
      std::vector<double> values(points.size());
      const auto touched = std::make_unique<bool[]>(points.size());
      field.evaluate(points.data(), count, values.data(), touched.get());
      for (Index i = 0; i < count; ++i)
      {
        bool on_surface = false;
        ASSERT_EQ(values[i], field.evaluate(points[i], &on_surface)) << c.name;
        ASSERT_EQ(touched[i], on_surface);
      }
    }
  }
}

TEST(DipoleField, SameBitsForAnyNumberOfThreads)
{
  for (const FieldCase& c : all_cases())
  {
    const DipoleField one = build_field(c, 1e-4, 1);
    for (const int threads : { 0, 2 })
    {
      const DipoleField many = build_field(c, 1e-4, threads);
      EXPECT_EQ(one.measured_error(), many.measured_error());
      EXPECT_EQ(one.memory(), many.memory());
      test::Random random(3);
      for (const Vec3& p : points_for(c.mesh, 100, random))
      {
        ASSERT_EQ(one.evaluate(p), many.evaluate(p));
      }
    }
  }
}

TEST(DipoleField, GradientIsTheSlope)
{
  for (const FieldCase& c : all_cases())
  {
    const DipoleField field = build_field(c, 1e-6);
    test::Random random(8);
    for (int i = 0; i < 200; ++i)
    {
      const Vec3 p = (i % 4 ? 1.0 : 6.0) * random.in_box(Vec3::Constant(-1), Vec3::Constant(1));
      // Compute finite differences of the exact sum, which uses no cells. Points at which the sum
      // changes too fast for finite differences are skipped.
      const double step = 1e-5;
      Vec3 slope, second;
      for (int k = 0; k < 3; ++k)
      {
        Vec3 q = p;
        q[k] = p[k] + step;
        const double above = expected_at(c, q);
        q[k] = p[k] - step;
        const double below = expected_at(c, q);
        slope[k] = (above - below) / (2.0 * step);
      }
      if (slope.norm() < 10.0)
      {
        EXPECT_LE((field.gradient(p) - slope).norm(), 1e-4 * (1.0 + slope.norm()))
          << c.name << " at " << p.transpose();
      }
    }
  }
}

TEST(DipoleField, NothingGivesNothing)
{
  FieldCase empty;
  EXPECT_EQ(build_field(empty, 1e-3).evaluate(Vec3(0.1, 0.2, 0.3)), 0.0);
  EXPECT_EQ(build_field(empty, 1e-3).gradient(Vec3(0.1, 0.2, 0.3)), Vec3::Zero());
  FieldCase uncounted = unit_case("uncounted", test::cube());
  std::fill(uncounted.multiplicities.begin(), uncounted.multiplicities.end(), 0);
  EXPECT_EQ(build_field(uncounted, 1e-3).evaluate(Vec3(0.1, 0.2, 0.3)), 0.0);
  // All corners of all triangles are at one position, so the triangles have no area.
  FieldCase flat = unit_case("flat", random_soup(50));
  flat.mesh.points.setConstant(0.25);
  const DipoleField field = build_field(flat, 1e-3);
  EXPECT_EQ(field.evaluate(Vec3(0.1, 0.2, 0.3)), 0.0);
  EXPECT_EQ(field.evaluate(Vec3::Constant(0.25)), 0.0);
}

// The round-off of coincident triangles and of sums in single precision accumulates. The total
// error must not exceed the tolerance.
TEST(DipoleField, ManyTrianglesAtOnePlace)
{
  for (const Index count : { 200, 1000 })
  {
    for (const double apart : { 0.0, 1e-3 })
    {
      FieldCase pile = unit_case("pile", random_soup(1));
      pile.mesh.points << 0.1, 0.2, 0.3, 0.9, 0.1, -0.2, -0.3, 0.8, 0.4;
      const Points one = pile.mesh.points;
      pile.mesh.points = one.replicate(count, 1);
      pile.mesh.triangles.resize(count, 3);
      test::Random random(4);
      for (Index v = 0; v < pile.mesh.points.rows(); ++v)
      {
        pile.mesh.points.row(v) +=
          apart * random.in_box(Vec3::Constant(-1), Vec3::Constant(1)).transpose();
        pile.mesh.triangles(v / 3, v % 3) = v;
      }
      pile.multiplicities.assign(static_cast<std::size_t>(count), 1);
      for (const double tolerance : { 1e-2, 1e-3, 1e-4 })
      {
        const DipoleField field = build_field(pile, tolerance);
        for (int i = 0; i < 300; ++i)
        {
          const Vec3 p = (i % 2 ? 1.0 : 2.0) * random.in_box(Vec3::Constant(-1), Vec3::Constant(1));
          EXPECT_NEAR(field.evaluate(p), expected_at(pile, p), tolerance);
        }
      }
    }
  }
}

TEST(DipoleField, CanBeCanceledAnywhere)
{
  const FieldCase c = unit_case("bumpy", bumpy(4));
  DipoleField::Options options;
  int total_checks = 0;
  {
    ExecutionContext context(nullptr, [&] { return ++total_checks < 0; });
    context.set_threads(1);
    DipoleField field;
    ASSERT_TRUE(field.build(
      context, c.mesh.points, c.mesh.triangles, c.multiplicities, touch_tolerance, options));
  }
  ASSERT_GT(total_checks, 10);
  for (int stop = 1; stop <= total_checks; stop += 1 + total_checks / 20)
  {
    int cancel_checks = 0;
    ExecutionContext context(nullptr, [&] { return ++cancel_checks >= stop; });
    context.set_threads(1);
    DipoleField field;
    EXPECT_FALSE(field.build(
      context, c.mesh.points, c.mesh.triangles, c.multiplicities, touch_tolerance, options));
    EXPECT_EQ(field.evaluate(Vec3::Zero()), 0.0);
  }
}
