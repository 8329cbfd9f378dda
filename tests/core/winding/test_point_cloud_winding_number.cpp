// Winding numbers of oriented points (point clouds with normals and areas): the formula, known
// solid angles, and comparisons with the plain sum.
#include "winding/point_cloud_winding_number.h"

#include "base/constants.h"

#include "support/clouds.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace bindpose;
using test::Cloud;

namespace
{
const Eigen::VectorXd empty_areas(0);

/// Return points on the unit sphere, evenly spaced on a spiral or at random. Each point has an
/// equal fraction of the area.
Cloud sphere_cloud(Index count, bool even = true, std::uint64_t seed = 5)
{
  test::Random random(seed);
  Cloud cloud{ Points(count, 3), Points(count, 3),
    Eigen::VectorXd::Constant(count, 4.0 * pi / static_cast<double>(count)) };
  for (Index i = 0; i < count; ++i)
  {
    const double fraction = (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double z = even ? 1.0 - fraction : random.uniform(-1.0, 1.0);
    const double angle =
      even ? static_cast<double>(i) * pi * (3.0 - std::sqrt(5.0)) : random.uniform(0.0, 2.0 * pi);
    const double r = std::sqrt(1.0 - z * z);
    cloud.points.row(i) << r * std::cos(angle), r * std::sin(angle), z;
  }
  cloud.normals = cloud.points;
  return cloud;
}

/// Return scattered points with random normals and areas. The contributions of the points have
/// random signs, so they do not cancel systematically.
Cloud scattered_cloud(Index count, std::uint64_t seed)
{
  test::Random random(seed);
  Cloud cloud{ Points(count, 3), Points(count, 3), Eigen::VectorXd(count) };
  for (Index i = 0; i < count; ++i)
  {
    const Vec3 at = random.in_box(Vec3::Constant(-1.0), Vec3::Constant(1.0));
    cloud.points.row(i) = (i % 3 == 0 ? Vec3(0.1 * at + Vec3(0.5, 0.2, 0.0)) : at).transpose();
    cloud.normals.row(i) =
      random.in_box(Vec3::Constant(-1.0), Vec3::Constant(1.0)).normalized().transpose();
    cloud.areas[i] = random.uniform(0.0, 20.0 / static_cast<double>(count));
  }
  return cloud;
}

double dipole(const Vec3& p, const Vec3& n, double area, const Vec3& q)
{
  const Vec3 d = p - q;
  return area * n.dot(d) / (4.0 * pi * d.squaredNorm() * d.norm());
}

/// Evaluate the definition as a plain sum over the samples.
double plain_sum(const Cloud& cloud, const Vec3& q)
{
  double sum = 0.0;
  for (Index i = 0; i < cloud.points.rows(); ++i)
  {
    const Vec3 p = cloud.points.row(i);
    if (p != q)
    {
      sum += dipole(p, cloud.normals.row(i), cloud.areas[i], q);
    }
  }
  return sum;
}

PointCloudWindingNumber build_winding(const Cloud& cloud,
  WindingMethod method = WindingMethod::fast, double tolerance = 1e-3,
  const Eigen::VectorXd* areas = nullptr)
{
  PointCloudWindingNumber::Options options;
  options.method = method;
  options.tolerance = tolerance;
  ExecutionContext context;
  PointCloudWindingNumber winding;
  const Status status =
    winding.build(context, cloud.points, cloud.normals, areas ? *areas : cloud.areas, options);
  EXPECT_TRUE(status.ok()) << status.message;
  return winding;
}

/// Return random query points. A third of them are in the box [-1.5, 1.5]^3. Of the others, a few
/// are at samples, and the rest differ from a sample by up to 16 sample spacings along each axis.
Points queries_around(const Cloud& cloud, Index count, std::uint64_t seed)
{
  test::Random random(seed);
  Points queries(count, 3);
  const double spacing = std::sqrt(cloud.areas.mean());
  for (Index i = 0; i < count; ++i)
  {
    const Vec3 point = cloud.points.row(random.below(cloud.points.rows()));
    const Vec3 offset = random.in_box(Vec3::Constant(-1.0), Vec3::Constant(1.0));
    const double far = std::exp2(random.uniform(-3.0, 4.0)) * spacing;
    queries.row(i) = (i % 3 == 0 ? Vec3(1.5 * offset)
        : i % 50 == 1            ? point
                                 : Vec3(point + far * offset))
                       .transpose();
  }
  return queries;
}
} // namespace

TEST(PointCloudWindingNumber, OneDipoleIsItsFormula)
{
  Cloud cloud{ Points(1, 3), Points(1, 3), Eigen::VectorXd::Constant(1, 2.5) };
  cloud.points << 0.3, -0.2, 0.9;
  cloud.normals << 0.6, 0.0, 0.8;
  for (const WindingMethod method :
    { WindingMethod::automatic, WindingMethod::direct, WindingMethod::exact, WindingMethod::fast })
  {
    const PointCloudWindingNumber winding = build_winding(cloud, method);
    for (const Vec3& q : { Vec3(0, 0, 0), Vec3(1, 2, 3), Vec3(0.3, -0.2, 0.8), Vec3(-5, 9, 2) })
    {
      const double expected = dipole(cloud.points.row(0), cloud.normals.row(0), cloud.areas[0], q);
      EXPECT_NEAR(winding.evaluate_at(q), expected, 1e-3 + 1e-14 * std::abs(expected));
      EXPECT_NEAR(winding.evaluate_exactly_at(q), expected, 1e-14 * std::abs(expected));
    }
  }
  // The query point is on the axis of a single sample, at the distance d. The value is area / (4 pi
  // d^2). Normals may have any length.
  cloud.points << 0, 0, 1;
  cloud.normals << 0, 0, 1e-200;
  EXPECT_NEAR(build_winding(cloud).evaluate_exactly_at(Vec3(0, 0, -1)), 2.5 / (16.0 * pi), 1e-16);
  EXPECT_NEAR(build_winding(cloud).evaluate_exactly_at(Vec3(0, 0, 3)), -2.5 / (16.0 * pi), 1e-16);
}

TEST(PointCloudWindingNumber, SpheresWindOnceInsideAndTheErrorShrinks)
{
  double last = 1.0;
  for (const Index count : { 300, 3000, 30000 })
  {
    const Cloud cloud = sphere_cloud(count);
    const double spacing = std::sqrt(4.0 * pi / static_cast<double>(count));
    const PointCloudWindingNumber winding = build_winding(cloud, WindingMethod::fast, 1e-7);
    test::Random random(1);
    double largest = 0.0, two_away = 0.0;
    for (int i = 0; i < 2000; ++i)
    {
      const Vec3 u = random.in_box(Vec3::Constant(-1.0), Vec3::Constant(1.0)).normalized();
      largest = std::max({ largest, std::abs(winding.evaluate_at(0.5 * u) - 1.0),
        std::abs(winding.evaluate_at(1.5 * u)) });
      two_away =
        std::max({ two_away, std::abs(winding.evaluate_at((1.0 - 2.0 * spacing) * u) - 1.0),
          std::abs(winding.evaluate_at((1.0 + 2.0 * spacing) * u)) });
    }
    // For evenly spaced samples the error is smaller than the area of one sample.
    EXPECT_LT(largest, 0.5 / static_cast<double>(count));
    EXPECT_LT(two_away, 0.02);
    EXPECT_LT(largest, 0.5 * last);
    last = largest;
    EXPECT_NEAR(winding.status().report.number("volume", 0), 4.0 * pi / 3.0, 1e-3);
    EXPECT_NEAR(winding.status().report.number("area", 0), 4.0 * pi, 1e-9);
    EXPECT_NEAR(winding.status().report.number("spacing", 0), spacing, 1e-12);
  }
}

TEST(PointCloudWindingNumber, HalfASphereIsItsSolidAngle)
{
  Cloud cloud = sphere_cloud(40000);
  const Index half = 20000; // the first half of the points is above z = 0
  cloud = { cloud.points.topRows(half), cloud.normals.topRows(half), cloud.areas.head(half) };
  const PointCloudWindingNumber winding = build_winding(cloud, WindingMethod::fast, 1e-6);
  // On the axis below the rim, the half sphere has the same winding number as the disc that the rim
  // bounds. This number is (1 - c) / 2, where c is the cosine of the angle between the axis and a
  // line from the point to the rim.
  for (const double z : { 0.0, -0.3, -1.0, -4.0 })
  {
    const double expected = 0.5 * (1.0 + z / std::sqrt(1.0 + z * z));
    EXPECT_NEAR(winding.evaluate_at(Vec3(0, 0, z)), expected, 5e-5) << z;
  }
  // Inside of the sphere and above the plane of the rim, the value is that of the whole sphere
  // minus that of the disc.
  EXPECT_NEAR(winding.evaluate_at(Vec3(0, 0, 0.5)), 0.5 * (1.0 + 0.5 / std::sqrt(1.25)), 5e-5);
  // This point is in the plane of the rim.
  EXPECT_NEAR(winding.evaluate_at(Vec3(0.6, 0, 0)), 0.5, 5e-4);
}

TEST(PointCloudWindingNumber, FastKeepsItsTolerance)
{
  std::vector<Cloud> clouds{ sphere_cloud(20000), sphere_cloud(6000, false),
    scattered_cloud(8000, 3) };
  // One cloud is a flat square, so its bounding boxes have no thickness. Another cloud is a line.
  Cloud flat = scattered_cloud(5000, 4);
  flat.points.col(2).setZero();
  clouds.push_back(flat);
  flat.points.col(1).setZero();
  clouds.push_back(flat);
  // Many samples are at a few positions.
  Cloud stacked = scattered_cloud(4000, 5);
  stacked.points = (2.0 * stacked.points.array()).round() * 0.5;
  clouds.push_back(stacked);
  for (const Cloud& cloud : clouds)
  {
    const Points queries = queries_around(cloud, 2500, 7);
    for (const double tolerance : { 1e-1, 1e-2, 1e-3, 1e-5, 1e-8 })
    {
      const PointCloudWindingNumber winding = build_winding(cloud, WindingMethod::fast, tolerance);
      EXPECT_EQ(winding.method(), WindingMethod::fast);
      const Report& report = winding.status().report;
      EXPECT_EQ(report.number("error_bound", -1), tolerance);
      EXPECT_GE(report.number("measured_error", -1), 0.0);
      EXPECT_LE(report.number("measured_error", -1), tolerance);
      for (Index i = 0; i < queries.rows(); ++i)
      {
        const Vec3 q = queries.row(i);
        bool touches = false, touches_exactly = false;
        const double exact = winding.evaluate_exactly_at(q, &touches_exactly);
        ASSERT_NEAR(winding.evaluate_at(q, &touches), exact, tolerance + 1e-12 * std::abs(exact))
          << q.transpose();
        ASSERT_EQ(touches, touches_exactly) << q.transpose();
      }
    }
  }
}

TEST(PointCloudWindingNumber, FastKeepsItsToleranceWhereErrorsAddUp)
{
  // At the center of a sphere all boxes of the tree have the same distance, so their errors have
  // the same sign and add up.
  const Cloud cloud = sphere_cloud(100000);
  const PointCloudWindingNumber winding = build_winding(cloud, WindingMethod::fast, 1e-4);
  test::Random random(3);
  for (int i = 0; i < 300; ++i)
  {
    const Vec3 q = random.in_box(Vec3::Constant(-0.05), Vec3::Constant(0.05));
    ASSERT_NEAR(winding.evaluate_at(q), winding.evaluate_exactly_at(q), 1e-4);
  }
}

TEST(PointCloudWindingNumber, PlainSumIsTheDefinition)
{
  const Cloud cloud = scattered_cloud(3001, 9); // 3001 is not a multiple of eight
  const PointCloudWindingNumber winding = build_winding(cloud, WindingMethod::direct);
  EXPECT_EQ(winding.method(), WindingMethod::direct);
  const Points queries = queries_around(cloud, 500, 11);
  for (Index i = 0; i < queries.rows(); ++i)
  {
    const double expected = plain_sum(cloud, queries.row(i));
    ASSERT_NEAR(winding.evaluate_at(queries.row(i)), expected, 1e-12 * (1.0 + std::abs(expected)));
  }
}

TEST(PointCloudWindingNumber, PointsOnSamplesCountTheOthers)
{
  const Cloud cloud = sphere_cloud(5000);
  for (const WindingMethod method : { WindingMethod::direct, WindingMethod::fast })
  {
    const PointCloudWindingNumber winding = build_winding(cloud, method);
    std::vector<double> values(5000);
    std::vector<unsigned char> flags(5000, 7);
    ExecutionContext context;
    const Status status = winding.evaluate(context, cloud.points, values.data(), flags.data());
    EXPECT_EQ(status.report.number("counts.on_surface", -1), 5000);
    for (Index i = 0; i < 5000; i += 7)
    {
      EXPECT_EQ(flags[i], 1);
      ASSERT_NEAR(values[i], plain_sum(cloud, cloud.points.row(i)), 1e-3);
    }
    // At a sample on a sphere, the other samples give the principal value, which is about 1/2.
    EXPECT_NEAR(values[2500], 0.5, 0.05);
    bool on_surface = true;
    winding.evaluate_at(Vec3(cloud.points.row(3)) * (1.0 + 1e-9), &on_surface);
    EXPECT_FALSE(on_surface);
  }
}

TEST(PointCloudWindingNumber, ShiftsAndScalesDoNotMatter)
{
  const auto snap = [](double x) { return std::round(x * 0x1p20) * 0x1p-20; };
  Cloud cloud = scattered_cloud(3000, 13);
  cloud.points = Points(cloud.points.unaryExpr(snap));
  const Points queries = queries_around(cloud, 400, 15).unaryExpr(snap);
  const auto values = [](const Cloud& c, const Points& at, WindingMethod method)
  {
    ExecutionContext context;
    Eigen::VectorXd w;
    EXPECT_TRUE(build_winding(c, method, 1e-6).evaluate(context, at, w).ok());
    return w;
  };
  for (const WindingMethod method : { WindingMethod::direct, WindingMethod::fast })
  {
    const Eigen::VectorXd expected = values(cloud, queries, method);
    for (const double scale : { 0x1p-30, 0x1p17, 0x1p100 })
    {
      Cloud scaled = cloud;
      scaled.points *= scale;
      scaled.areas *= scale * scale;
      EXPECT_EQ(values(scaled, scale * queries, method), expected) << scale;
    }
    for (const double shift : { 0x1p10, -0x1p20 })
    {
      Cloud moved = cloud;
      moved.points.array() += shift;
      // Far from the origin, the tolerance for touching a sample is larger. The values must be the
      // same, except at samples.
      const Eigen::VectorXd there = values(moved, queries.array() + shift, method);
      const double tolerance = method == WindingMethod::fast ? 2e-6 : 1e-11;
      for (Index i = 0; i < queries.rows(); ++i)
      {
        ASSERT_NEAR(there[i], expected[i], tolerance * (1.0 + std::abs(expected[i])));
      }
    }
  }
}

TEST(PointCloudWindingNumber, EstimatedAreasDoForEvenSamples)
{
  const Cloud cloud = sphere_cloud(10000);
  const PointCloudWindingNumber winding =
    build_winding(cloud, WindingMethod::automatic, 1e-4, &empty_areas);
  ASSERT_EQ(winding.areas().size(), 10000);
  EXPECT_NEAR(winding.areas().sum(), 4.0 * pi, 1e-3 * 4.0 * pi);
  EXPECT_EQ(winding.status().report.number("counts.zero_areas", -1), 0);
  test::Random random(1);
  for (int i = 0; i < 1000; ++i)
  {
    const Vec3 u = random.in_box(Vec3::Constant(-1.0), Vec3::Constant(1.0)).normalized();
    ASSERT_NEAR(winding.evaluate_at(0.9 * u), 1.0, 5e-3);
    ASSERT_NEAR(winding.evaluate_at(1.1 * u), 0.0, 5e-3);
  }
  // Areas are estimated from the samples. They scale with the square of the unit of length and do
  // not depend on the position.
  Cloud moved = cloud;
  moved.points = Points((0x1p10 * cloud.points).array() + 0x1p12);
  const PointCloudWindingNumber large =
    build_winding(moved, WindingMethod::automatic, 1e-4, &empty_areas);
  EXPECT_LE((large.areas() * 0x1p-20 - winding.areas()).lpNorm<Eigen::Infinity>(), 1e-9);
}

TEST(PointCloudWindingNumber, MethodsAndReport)
{
  const Cloud few = sphere_cloud(100);
  const PointCloudWindingNumber small = build_winding(few, WindingMethod::automatic);
  EXPECT_EQ(small.method(), WindingMethod::direct);
  EXPECT_EQ(small.status().report.find("error_bound"), nullptr);
  const Cloud many = sphere_cloud(20000);
  const PointCloudWindingNumber large = build_winding(many, WindingMethod::automatic);
  EXPECT_EQ(large.method(), WindingMethod::fast);
  EXPECT_EQ(large.status().report.text("method"), "fast");
  EXPECT_FALSE(large.status().report.text("method_reason").empty());
  EXPECT_EQ(large.status().report.number("counts.points", -1), 20000);
  EXPECT_GT(large.memory(), 20000 * 48);
}

TEST(PointCloudWindingNumber, NormalsAndAreasOfZeroCountNothing)
{
  Cloud cloud = sphere_cloud(3000);
  cloud.normals.row(7).setZero();
  cloud.normals.row(9).setZero();
  cloud.areas[11] = 0.0;
  const PointCloudWindingNumber winding = build_winding(cloud);
  EXPECT_EQ(winding.status().report.number("counts.zero_normals", -1), 2);
  EXPECT_EQ(winding.status().report.number("counts.zero_areas", -1), 1);
  ASSERT_EQ(winding.status().warnings.size(), 1u);
  EXPECT_NE(winding.status().warnings[0].find("2 of 3000"), std::string::npos);
  EXPECT_NEAR(winding.evaluate_at(Vec3(0.2, 0.1, 0)), plain_sum(cloud, Vec3(0.2, 0.1, 0)), 1e-3);
  // A query point at a sample without a normal is still reported as on the surface.
  bool on_surface = false;
  winding.evaluate_at(cloud.points.row(7), &on_surface);
  EXPECT_TRUE(on_surface);
  cloud.areas.setZero();
  EXPECT_EQ(build_winding(cloud).evaluate_at(Vec3(0.2, 0.1, 0)), 0.0);
}

TEST(PointCloudWindingNumber, NothingWindsAroundNothing)
{
  const Cloud nothing{ Points(0, 3), Points(0, 3), empty_areas };
  const PointCloudWindingNumber winding = build_winding(nothing);
  EXPECT_EQ(winding.status().warnings.size(), 1u);
  EXPECT_EQ(winding.evaluate_at(Vec3(1, 2, 3)), 0.0);
  // Before a build, the winding number is 0 everywhere.
  EXPECT_EQ(PointCloudWindingNumber().evaluate_at(Vec3(1, 2, 3)), 0.0);
}

TEST(PointCloudWindingNumber, BadInputIsNamed)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  ExecutionContext context;
  PointCloudWindingNumber winding;
  PointCloudWindingNumber::Options options;
  const auto expect_refused = [&](const Cloud& cloud, const std::string& word)
  {
    const Status status = winding.build(context, cloud.points, cloud.normals, cloud.areas, options);
    EXPECT_EQ(status.code, StatusCode::invalid_input) << word;
    EXPECT_NE(status.message.find(word), std::string::npos) << status.message;
    Eigen::VectorXd w;
    EXPECT_EQ(winding.evaluate(context, cloud.points, w).code, StatusCode::invalid_input);
  };
  const Cloud good = sphere_cloud(50);
  Cloud cloud = good;
  cloud.points(4, 1) = nan;
  expect_refused(cloud, "point 4 has a coordinate");
  cloud = good;
  cloud.normals(5, 0) = std::numeric_limits<double>::infinity();
  expect_refused(cloud, "point 5 has a normal");
  for (const double bad : { -1.0, nan, std::numeric_limits<double>::infinity() })
  {
    cloud = good;
    cloud.areas[6] = bad;
    expect_refused(cloud, "point 6 has the area");
  }
  cloud = good;
  cloud.normals.conservativeResize(49, 3);
  expect_refused(cloud, "49 normals");
  cloud = good;
  cloud.areas.conservativeResize(3);
  expect_refused(cloud, "3 areas");
  cloud = good;
  cloud.areas *= 1e200;
  expect_refused(cloud, "too large relative to the distances");
  expect_refused({ good.points.topRows(1), good.normals.topRows(1), empty_areas }, "single point");
  options.tolerance = 0.0;
  expect_refused(good, "tolerance");
  options = {};
  options.area_neighbors = 2;
  expect_refused(good, "area_neighbors");
  for (const WindingMethod method : { WindingMethod::hierarchical, WindingMethod::crossings })
  {
    options = {};
    options.method = method;
    expect_refused(good, to_string(method));
  }
}

TEST(PointCloudWindingNumber, OddCloudsAreFiniteEverywhere)
{
  Cloud one_place = scattered_cloud(2000, 3);
  one_place.points.setConstant(0.25);
  Cloud huge = sphere_cloud(2000);
  huge.points *= 1e150;
  huge.areas *= 1e300;
  Cloud tiny = sphere_cloud(2000);
  tiny.points *= 1e-150;
  tiny.areas *= 1e-300;
  Cloud clusters = scattered_cloud(2000, 4);
  clusters.points *= 1e-12;
  clusters.points.topRows(1000).array() += 1.0;
  Cloud heavy = sphere_cloud(2000);
  heavy.areas *= 1e30;
  for (const Cloud& cloud : { one_place, huge, tiny, clusters, heavy })
  {
    const PointCloudWindingNumber winding = build_winding(cloud);
    const double size = cloud.points.cwiseAbs().maxCoeff();
    test::Random random(2);
    for (int i = 0; i < 300; ++i)
    {
      const double distance = std::exp2(random.uniform(-60.0, 60.0)) * size;
      const Vec3 q = Vec3(cloud.points.row(i)) +
        distance * random.in_box(Vec3::Constant(-1.0), Vec3::Constant(1.0));
      const double exact = winding.evaluate_exactly_at(q);
      ASSERT_TRUE(std::isfinite(exact));
      ASSERT_NEAR(winding.evaluate_at(q), exact,
        1e-3 + 1e-12 * std::max(std::abs(exact), cloud.areas.sum() / size / size));
    }
  }
}

TEST(PointCloudWindingNumber, PointsThatAreNoneGiveNaN)
{
  const PointCloudWindingNumber winding = build_winding(sphere_cloud(2000));
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Points queries(4, 3);
  queries << 0, 0, 0, nan, 0, 0, 0, std::numeric_limits<double>::infinity(), 0, 1e300, 0, 0;
  ExecutionContext context;
  Eigen::VectorXd w;
  const Status status = winding.evaluate(context, queries, w);
  EXPECT_TRUE(status.ok());
  EXPECT_EQ(status.report.number("counts.queries", -1), 4);
  EXPECT_EQ(status.report.number("counts.not_finite", -1), 2);
  EXPECT_EQ(status.warnings.size(), 1u);
  EXPECT_NEAR(w[0], 1.0, 2e-3);
  EXPECT_TRUE(std::isnan(w[1]));
  EXPECT_TRUE(std::isnan(w[2]));
  EXPECT_EQ(w[3], 0.0);
}

TEST(PointCloudWindingNumber, GridsAndPointsAgreeOnAnyNumberOfThreads)
{
  const Cloud cloud = sphere_cloud(30000, false);
  SampleGrid grid;
  grid.origin = Vec3(-1.2, -1.1, -1.3);
  grid.spacing = Vec3(0.1, 0.11, 0.13);
  grid.extent = { 0, 23, 1, 20, -1, 18 };
  Points queries(grid.count(), 3);
  Index row = 0;
  for (Index k = -1; k <= 18; ++k)
  {
    for (Index j = 1; j <= 20; ++j)
    {
      for (Index i = 0; i <= 23; ++i)
      {
        queries.row(row++) = grid.point(i, j, k).transpose();
      }
    }
  }
  std::vector<Eigen::VectorXd> values;
  std::vector<Eigen::VectorXd> areas;
  for (const int threads : { 1, 2, 3 })
  {
    ExecutionContext context;
    context.set_threads(threads);
    PointCloudWindingNumber winding;
    ASSERT_TRUE(winding.build(context, cloud.points, cloud.normals, empty_areas).ok());
    areas.push_back(winding.areas());
    Eigen::VectorXd on_grid(grid.count()), at_points;
    ASSERT_TRUE(winding.evaluate(context, grid, on_grid.data()).ok());
    ASSERT_TRUE(winding.evaluate(context, queries, at_points).ok());
    EXPECT_EQ(on_grid, at_points);
    values.push_back(on_grid);
  }
  EXPECT_EQ(values[0], values[1]);
  EXPECT_EQ(values[0], values[2]);
  EXPECT_EQ(areas[0], areas[1]);
  EXPECT_EQ(areas[0], areas[2]);
}

TEST(PointCloudWindingNumber, GradientIsTheDefinitions)
{
  for (const Cloud& cloud : { sphere_cloud(4000, false), scattered_cloud(5000, 8) })
  {
    const PointCloudWindingNumber winding = build_winding(cloud, WindingMethod::direct);
    const Points queries = queries_around(cloud, 200, 12);
    Points gradients(queries.rows(), 3);
    ExecutionContext context;
    ASSERT_TRUE(winding.evaluate_gradient(context, queries, gradients.data()).ok());
    for (Index i = 0; i < queries.rows(); ++i)
    {
      Vec3 sum = Vec3::Zero();
      double unsigned_sum = 0.0;
      const Vec3 q = queries.row(i);
      for (Index k = 0; k < cloud.points.rows(); ++k)
      {
        const Vec3 p = cloud.points.row(k);
        if (p != q)
        {
          const Vec3 n = cloud.normals.row(k);
          const Vec3 d = p - q;
          const double r2 = d.squaredNorm();
          const double scale = cloud.areas[k] / (4.0 * pi * r2 * std::sqrt(r2));
          sum += scale * (3.0 * n.dot(d) / r2 * d - n);
          unsigned_sum += 4.0 * scale;
        }
      }
      EXPECT_LE((Vec3(gradients.row(i)) - sum).norm(), 1e-12 * unsigned_sum) << q.transpose();
    }
  }
}

TEST(PointCloudWindingNumber, GradientIsTheSlope)
{
  const Cloud cloud = scattered_cloud(5000, 9);
  const PointCloudWindingNumber winding = build_winding(cloud, WindingMethod::fast, 1e-6);
  const Points queries = queries_around(cloud, 300, 13);
  Points gradients(queries.rows(), 3);
  ExecutionContext context;
  ASSERT_TRUE(winding.evaluate_gradient(context, queries, gradients.data()).ok());
  int compared = 0;
  for (Index i = 0; i < queries.rows(); ++i)
  {
    const Vec3 q = queries.row(i);
    const double nearest =
      std::sqrt((cloud.points.rowwise() - q.transpose()).rowwise().squaredNorm().minCoeff());
    if (nearest < 1e-3)
    {
      continue;
    }
    const double step = 1e-4 * nearest;
    Vec3 slope;
    for (int k = 0; k < 3; ++k)
    {
      Vec3 above = q, below = q;
      above[k] += step;
      below[k] -= step;
      slope[k] =
        (winding.evaluate_exactly_at(above) - winding.evaluate_exactly_at(below)) / (2.0 * step);
    }
    EXPECT_LE((Vec3(gradients.row(i)) - slope).norm(), 1e-6 * slope.norm() + 1e-5 / nearest);
    ++compared;
  }
  EXPECT_GT(compared, 250);
}

TEST(PointCloudWindingNumber, FastGradientsAreWithinTheirTolerance)
{
  for (const Cloud& cloud :
    { sphere_cloud(20000), sphere_cloud(20000, false), scattered_cloud(20000, 10) })
  {
    const PointCloudWindingNumber plain = build_winding(cloud, WindingMethod::direct);
    Points queries = queries_around(cloud, 300, 14);
    Points expected(queries.rows(), 3), gradients(queries.rows(), 3);
    ExecutionContext context;
    ASSERT_TRUE(plain.evaluate_gradient(context, queries, expected.data()).ok());
    for (const double tolerance : { 1e-2, 1e-3, 1e-5 })
    {
      const PointCloudWindingNumber winding = build_winding(cloud, WindingMethod::fast, tolerance);
      ASSERT_TRUE(winding.evaluate_gradient(context, queries, gradients.data()).ok());
      for (Index i = 0; i < queries.rows(); ++i)
      {
        const Vec3 q = queries.row(i);
        const double nearest =
          std::sqrt((cloud.points.rowwise() - q.transpose()).rowwise().squaredNorm().minCoeff());
        if (nearest > 0.0)
        {
          EXPECT_LE((gradients.row(i) - expected.row(i)).norm(), 10.0 * tolerance / nearest);
        }
      }
    }
  }
}

TEST(PointCloudWindingNumber, GradientsOfGridsAndOddPoints)
{
  const Cloud cloud = sphere_cloud(10000);
  SampleGrid grid;
  grid.origin = Vec3(-1.2, -1.1, -1.3);
  grid.spacing = Vec3(0.3, 0.31, 0.33);
  grid.extent = { 0, 7, 1, 6, -1, 6 };
  std::vector<Points> values;
  for (const int threads : { 1, 2 })
  {
    ExecutionContext context;
    context.set_threads(threads);
    const PointCloudWindingNumber winding = build_winding(cloud);
    Points gradients(grid.count(), 3);
    ASSERT_TRUE(winding.evaluate_gradient(context, grid, gradients.data()).ok());
    values.push_back(gradients);
    Points one(1, 3);
    const Points first = grid.point(0, 1, -1).transpose();
    ASSERT_TRUE(winding.evaluate_gradient(context, first, one.data()).ok());
    EXPECT_EQ(one, Points(gradients.topRows(1)));
    Points odd(3, 3);
    odd << 1e300, 0, 0, std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, 0, 0;
    Points at_odd(3, 3);
    ASSERT_TRUE(winding.evaluate_gradient(context, odd, at_odd.data()).ok());
    EXPECT_EQ(Points(at_odd.topRows(1)), Points(Points::Zero(1, 3)));
    EXPECT_TRUE(at_odd.row(1).array().isNaN().all());
    EXPECT_LE(at_odd.row(2).norm(), 1e-3); // the point is at the center of the sphere
  }
  EXPECT_EQ(values[0], values[1]);
  const PointCloudWindingNumber winding = build_winding(cloud);
  ExecutionContext canceled(nullptr, [] { return true; });
  Points gradients(grid.count(), 3);
  EXPECT_EQ(winding.evaluate_gradient(canceled, grid, gradients.data()).code, StatusCode::canceled);
  // If the cloud is eight times as large, the gradient is an eighth.
  Cloud larger = cloud;
  larger.points *= 8.0;
  larger.areas *= 64.0;
  SampleGrid larger_grid = grid;
  larger_grid.origin *= 8.0;
  larger_grid.spacing *= 8.0;
  Points of_larger(grid.count(), 3);
  ExecutionContext context;
  ASSERT_TRUE(build_winding(larger).evaluate_gradient(context, larger_grid, of_larger.data()).ok());
  EXPECT_LE((8.0 * of_larger - values[0]).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PointCloudWindingNumber, CancelsMidwayAndRunsAgain)
{
  const Cloud cloud = sphere_cloud(20000);
  PointCloudWindingNumber winding;
  int cancel_checks = 0;
  ExecutionContext probe({},
    [&]
    {
      ++cancel_checks;
      return false;
    });
  probe.set_threads(1);
  ASSERT_TRUE(winding.build(probe, cloud.points, cloud.normals, empty_areas).ok());
  const int build_checks = cancel_checks;
  ASSERT_GT(build_checks, 50);
  Eigen::VectorXd w;
  int allowed = 0;
  for (int step = 0; step < 8; ++step)
  {
    allowed = build_checks * step / 8;
    ExecutionContext context({}, [&] { return --allowed < 0; });
    context.set_threads(1);
    EXPECT_EQ(
      winding.build(context, cloud.points, cloud.normals, empty_areas).code, StatusCode::canceled);
    EXPECT_EQ(winding.evaluate(context, cloud.points, w).code, StatusCode::canceled);
  }
  std::vector<double> fractions;
  ExecutionContext watched(
    [&](double fraction, const std::string&) { fractions.push_back(fraction); }, {});
  ASSERT_TRUE(winding.build(watched, cloud.points, cloud.normals, empty_areas).ok());
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  allowed = 3;
  ExecutionContext context({}, [&] { return --allowed < 0; });
  context.set_threads(1);
  EXPECT_EQ(winding.evaluate(context, cloud.points, w).code, StatusCode::canceled);
  EXPECT_TRUE(winding.evaluate(watched, cloud.points, w).ok());
}
