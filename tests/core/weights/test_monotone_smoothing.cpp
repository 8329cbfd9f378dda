// Smoothing of functions with given extrema, compared with isotonic regression, a dense quadratic
// program and monotone weights. The result has exactly the listed extrema, and it does not depend
// on units.
#include "weights/monotone_smoothing.h"

#include "domain/scaled_mesh.h"
#include "geometry/laplacian.h"
#include "weights/monotone_weights.h"

#include "support/cancel_later.h"
#include "weights_shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <cmath>

using namespace bindpose;
using Eigen::VectorXd;

namespace
{
struct Smoothed : MonotoneSmoothingResult
{
  Status status;
};

Smoothed smooth(const Domain& domain, const VectorXd& data,
  const MonotoneSmoothingOptions& options = {}, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  Smoothed result;
  result.status = monotone_smoothing(context, domain, data, options, result);
  return result;
}

/// Return a function with two hills, two hollows and noise.
VectorXd noisy_hills(const Domain& domain, double noise)
{
  test::Random random(3);
  const double z = domain.is_volume() ? 0.5 : 0.0;
  return VectorXd::NullaryExpr(domain.points.rows(),
    [&](Index v)
    {
      const Vec3 p = domain.points.row(v);
      const auto bump = [&](double x, double y)
      { return std::exp(-30.0 * (p - Vec3(x, y, z)).squaredNorm()); };
      return bump(0.25, 0.3) + 0.8 * bump(0.7, 0.65) - 0.7 * bump(0.75, 0.2) -
        0.5 * bump(0.25, 0.75) + noise * (random.uniform() - 0.5);
    });
}

/// Return the list of two maxima and two minima at the vertices nearest to the hills and hollows.
ExtremaList hills_list(const Domain& domain)
{
  ExtremaList list(static_cast<std::size_t>(domain.points.rows()), 0);
  const double z = domain.is_volume() ? 0.5 : 0.0;
  const auto put = [&](double x, double y, signed char kind)
  {
    Index at = 0;
    (domain.points.rowwise() - Eigen::RowVector3d(x, y, z)).rowwise().squaredNorm().minCoeff(&at);
    list[at] = kind;
  };
  put(0.25, 0.3, 1);
  put(0.7, 0.65, 1);
  put(0.75, 0.2, -1);
  put(0.25, 0.75, -1);
  return list;
}

/// Expect a certified result that has exactly the listed extrema.
void expect_only_listed(const Domain& domain, const Smoothed& result, double tolerance = 1e-6)
{
  ASSERT_TRUE(result.status.ok()) << result.status.message;
  EXPECT_LE(result.certificate.relative_gap, tolerance);
  EXPECT_LE(result.certificate.kkt_residual, tolerance);
  EXPECT_LE(result.certificate.order_violation, 1e-15);
  EXPECT_TRUE(result.spurious.empty());
  const VertexGraph graph = vertex_graph(domain);
  const VectorXd& w = result.values;
  const double round_off = 1e-15 * w.cwiseAbs().maxCoeff();
  for (Index v = 0; v < w.size(); ++v)
  {
    bool above = false;
    bool below = false;
    for (Index k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
    {
      const double u = w[graph.neighbors[k]];
      above = above || u >= w[v];
      below = below || u <= w[v];
      if (result.list[v] != 0)
      {
        EXPECT_GE(result.list[v] * (w[v] - u), -round_off) << "vertex " << v;
      }
    }
    EXPECT_TRUE(result.list[v] != 0 || (above && below)) << "vertex " << v;
  }
}

/// Compute isotonic regression with the pool-adjacent-violators algorithm.
std::vector<double> isotonic(const std::vector<double>& f, const std::vector<double>& mass)
{
  struct Block
  {
    double value, mass;
    std::size_t count;
  };
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < f.size(); ++i)
  {
    blocks.push_back({ f[i], mass[i], 1 });
    while (blocks.size() > 1 && blocks[blocks.size() - 2].value >= blocks.back().value)
    {
      const Block last = blocks.back();
      blocks.pop_back();
      Block& b = blocks.back();
      b.value = (b.value * b.mass + last.value * last.mass) / (b.mass + last.mass);
      b.mass += last.mass;
      b.count += last.count;
    }
  }
  std::vector<double> result;
  for (const Block& b : blocks)
  {
    result.insert(result.end(), b.count, b.value);
  }
  return result;
}
} // namespace

// The strip has the triangles (i, i + 1, i + 2). If the order follows the strip, the value of
// vertex i must be between those of vertices i - 2 and i + 2. If the energy contains only the fit
// to the data, the problem is isotonic regression, separately for the even and for the odd
// vertices.
TEST(MonotoneSmoothing, IsIsotonicRegressionAlongAStrip)
{
  constexpr Index n = 41;
  Domain domain;
  domain.points.resize(n, 3);
  domain.triangles.resize(n - 2, 3);
  test::Random random(5);
  VectorXd f(n);
  for (Index i = 0; i < n; ++i)
  {
    domain.points.row(i) << 0.5 * double(i), i % 2 ? std::sqrt(0.75) : 0.0, 0.0;
    f[i] = double(i) + 12.0 * random.uniform();
  }
  f[0] = -20.0;
  f[n - 1] = 70.0;
  for (Index i = 0; i + 2 < n; ++i)
  {
    domain.triangles.row(i) << i, i + 1 + i % 2, i + 2 - i % 2;
  }
  MonotoneSmoothingOptions options;
  options.extrema.assign(n, 0);
  options.extrema.front() = -1;
  options.extrema.back() = 1;
  options.data_weight = 1e14;
  options.guide = SmoothingGuide::harmonic;
  options.rebuilds = 0;
  const Smoothed result = smooth(domain, f, options);
  expect_only_listed(domain, result);
  const VectorXd mass = lumped_mass(domain.points, domain.triangles);
  for (const Index first : { Index(0), Index(1) })
  {
    std::vector<double> values, masses;
    for (Index i = first; i < n; i += 2)
    {
      values.push_back(f[i]);
      masses.push_back(mass[i]);
    }
    const std::vector<double> expected = isotonic(values, masses);
    EXPECT_NE(values, expected);
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      EXPECT_NEAR(result.values[first + 2 * static_cast<Index>(i)], expected[i], 1e-6 * 90.0);
    }
  }
}

TEST(MonotoneSmoothing, AgreesWithADenseTwin)
{
  const Domain domain = test::to_domain(test::grid(6, 4, 1.0, 0.7));
  const VertexGraph graph = vertex_graph(domain);
  const Index n = domain.points.rows();
  test::Random random(8);
  for (const int order : { 2, 3 })
  {
    for (const double epsilon : { 0.0, 0.01 })
    {
      const VectorXd f = VectorXd::NullaryExpr(n, [&] { return random.uniform(); });
      MonotoneSmoothingOptions options;
      options.order = order;
      options.data_weight = 1e4;
      options.epsilon = epsilon;
      options.rebuilds = 0;
      options.tolerance = 1e-9;
      options.extrema.assign(static_cast<std::size_t>(n), 0);
      options.extrema[3] = options.extrema[20] = -1;
      options.extrema[10] = options.extrema[31] = 1;
      const Smoothed result = smooth(domain, f, options);
      expect_only_listed(domain, result, 1e-9);

      // Compute the reference: the same quadratic program in dense form, solved by Hildreth's
      // method (coordinate ascent in the multipliers).
      const ScaledMesh scaled = scale_mesh(domain, std::vector<char>(std::size_t(n), 1));
      const double unit = scaled.mass_unit;
      const Eigen::RowVector3d centroid =
        scaled.mass.transpose() * scaled.points / scaled.mass.sum();
      const double size = std::sqrt(12.0 *
        scaled.mass.dot((scaled.points.rowwise() - centroid).rowwise().squaredNorm()) /
        scaled.mass.sum());
      const VectorXd data_diagonal =
        options.data_weight * std::pow(unit, order) * scaled.mass / std::pow(size, 2 * order);
      Eigen::MatrixXd form = harmonic_energy(scaled.stiffness, scaled.mass, order);
      form.diagonal() += data_diagonal;
      const Eigen::MatrixXd inverse = form.llt().solve(Eigen::MatrixXd::Identity(n, n));
      VectorXd w = inverse * data_diagonal.cwiseProduct(f);
      ExecutionContext context;
      std::vector<Index> rank;
      ASSERT_GT(order_with_extrema(
                  context, graph, std::vector<char>(std::size_t(n), 1), options.extrema, w, rank),
        0);
      const double least = epsilon * (f.maxCoeff() - f.minCoeff());
      const auto pairs = pairs_from_order(graph, options.extrema, rank, least);
      VectorXd multipliers = VectorXd::Zero(static_cast<Index>(pairs.size()));
      for (int sweep = 0; sweep < 20000; ++sweep)
      {
        for (std::size_t k = 0; k < pairs.size(); ++k)
        {
          const OrderedPair& p = pairs[k];
          const VectorXd direction = inverse.col(p.high) - inverse.col(p.low);
          double& z = multipliers[static_cast<Index>(k)];
          const double missing_difference = p.minimum_difference - (w[p.high] - w[p.low]);
          const double step =
            std::max(missing_difference / (direction[p.high] - direction[p.low]), -z);
          z += step;
          w += step * direction;
        }
      }
      EXPECT_GT(multipliers.maxCoeff(), 0.0);
      EXPECT_LE((result.values - w).cwiseAbs().maxCoeff(), 1e-6);
      const double energy = (w.dot(form * w) - 2.0 * w.dot(data_diagonal.cwiseProduct(f)) +
                              f.dot(data_diagonal.cwiseProduct(f))) /
        std::pow(unit, order - 1) / std::pow(f.maxCoeff() - f.minCoeff(), 2) *
        std::pow(size, 2 * order - 2);
      EXPECT_NEAR(result.energies.back(), energy, 1e-6 * energy);
    }
  }
}

TEST(MonotoneSmoothing, LeavesTheListedExtremaAndNoOther)
{
  const Domain domains[] = { test::to_domain(test::grid(40, 40)),
    test::to_domain(test::tet_box(9, 9, 9)) };
  for (const Domain& domain : domains)
  {
    const VectorXd f = noisy_hills(domain, 0.3);
    const std::vector<char> none(static_cast<std::size_t>(f.size()), 0);
    EXPECT_GE(interior_extrema(vertex_graph(domain), f, none).size(), 100u);
    for (const int order : { 2, 3 })
    {
      for (const bool keep : { false, true })
      {
        MonotoneSmoothingOptions options;
        options.order = order;
        options.data_weight = order == 2 ? 1e6 : 1e8;
        options.extrema = hills_list(domain);
        options.keep_values = keep;
        const Smoothed result = smooth(domain, f, options);
        expect_only_listed(domain, result);
        // All four listed extrema occur, and no others.
        EXPECT_EQ(interior_extrema(vertex_graph(domain), result.values, none).size(), 4u);
        ASSERT_EQ(result.extrema.size(), 4u);
        for (const Extremum& e : result.extrema)
        {
          EXPECT_EQ(e.maximum, options.extrema[e.vertex] > 0);
          EXPECT_GT(e.persistence, notable_persistence);
          EXPECT_EQ(e.value, result.values[e.vertex]);
          EXPECT_TRUE(!keep || e.value == f[e.vertex]);
        }
      }
    }
  }
}

TEST(MonotoneSmoothing, ChoosesThePersistentExtremaOfTheData)
{
  const Domain domain = test::to_domain(test::sphere(4));
  const VertexGraph graph = vertex_graph(domain);
  test::Random random(6);
  const VectorXd f = VectorXd::NullaryExpr(domain.points.rows(),
    [&](Index v) { return domain.points(v, 2) * domain.points(v, 0) + 0.1 * random.uniform(); });
  const std::vector<char> none(static_cast<std::size_t>(f.size()), 0);
  MonotoneSmoothingOptions options;
  options.persistence = 0.25;
  const Smoothed result = smooth(domain, f, options);
  expect_only_listed(domain, result);
  const auto expected = interior_extrema(graph, f, none, options.persistence);
  EXPECT_EQ(expected.size(), 4u);
  EXPECT_EQ(result.extrema.size(), expected.size());
  for (const Extremum& e : expected)
  {
    EXPECT_EQ(result.list[e.vertex], e.maximum ? 1 : -1);
  }
  for (const Index count : { 1, 2, 3, 7 })
  {
    options.extrema_count = count;
    const Smoothed some = smooth(domain, f, options);
    expect_only_listed(domain, some);
    EXPECT_EQ(static_cast<Index>(some.extrema.size()), std::max<Index>(2, count));
  }
}

TEST(MonotoneSmoothing, KeepsDataThatNeedNoChange)
{
  const Domain domain = test::to_domain(test::grid(24, 20));
  VectorXd f(domain.points.rows());
  for (Index v = 0; v < f.size(); ++v)
  {
    f[v] = std::sin(7.0 * domain.points(v, 0) + 0.3) * std::cos(5.0 * domain.points(v, 1) + 0.1) +
      0.2 * domain.points(v, 0);
  }
  MonotoneSmoothingOptions options;
  options.persistence = 0.0;
  options.data_weight = 1e13;
  const Smoothed result = smooth(domain, f, options);
  expect_only_listed(domain, result);
  EXPECT_GT(result.extrema.size(), 4u);
  EXPECT_LE((result.values - f).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(result.iterations, 0);
}

// If there are no data, and the listed extrema are one maximum with the value 1 and minima with the
// value 0, the result equals a column of monotone weights.
TEST(MonotoneSmoothing, WithoutDataItIsMonotoneWeights)
{
  const Domain domain = test::to_domain(test::grid(40, 40));
  for (const int order : { 2, 3 })
  {
    const WeightsProblem problem = test::problem_of(domain, test::five_points());
    WeightsOptions weights_options;
    weights_options.order = order;
    ExecutionContext context;
    WeightsResult weights;
    ASSERT_TRUE(monotone_weights(context, problem, weights_options, weights).ok());
    ASSERT_EQ(problem.vertex_count(), domain.points.rows());
    const HandleConstraints& constraints = problem.constraints;
    for (const Index handle : { 0, 2 })
    {
      MonotoneSmoothingOptions options;
      options.order = order;
      options.data_weight = 0.0;
      options.guide = SmoothingGuide::harmonic;
      options.rebuilds = 0;
      options.extrema.assign(static_cast<std::size_t>(domain.points.rows()), 0);
      VectorXd f = VectorXd::Zero(domain.points.rows());
      for (std::size_t i = 0; i < constraints.vertices.size(); ++i)
      {
        const double value = constraints.values(static_cast<Index>(i), handle);
        f[constraints.vertices[i]] = value;
        options.extrema[constraints.vertices[i]] = value > 0.5 ? 1 : -1;
      }
      const Smoothed result = smooth(domain, f, options);
      expect_only_listed(domain, result);
      EXPECT_NEAR(result.certificate.energy, weights.columns[handle].certificate.energy,
        3e-6 * result.certificate.energy);
      EXPECT_LE((result.values - weights.raw.col(handle)).cwiseAbs().maxCoeff(), 1e-4);
    }
  }
}

TEST(MonotoneSmoothing, UnitsDoNotMatter)
{
  const Domain domain = test::to_domain(test::grid(20, 20));
  const VectorXd f = noisy_hills(domain, 0.3);
  MonotoneSmoothingOptions options;
  options.extrema = hills_list(domain);
  const VectorXd plain = smooth(domain, f, options).values;
  const double range = f.maxCoeff() - f.minCoeff();
  // Scaling by a power of two does not round.
  for (const double scale : { 1048576.0, 1.0 / 1048576.0 })
  {
    const VectorXd scaled = scale * f;
    EXPECT_EQ(smooth(domain, scaled, options).values, scale * plain);
  }
  for (const double scale : { 1e6, 1e-6 })
  {
    const VectorXd scaled = (scale * f).array() + 3.0 * scale;
    const VectorXd w = smooth(domain, scaled, options).values;
    EXPECT_LE((w.array() / scale - 3.0 - plain.array()).abs().maxCoeff(), 1e-6 * range);
  }
  const VectorXd upside_down = -f;
  MonotoneSmoothingOptions turned = options;
  for (signed char& kind : turned.extrema)
  {
    kind = static_cast<signed char>(-kind);
  }
  EXPECT_LE((smooth(domain, upside_down, turned).values + plain).cwiseAbs().maxCoeff(),
    2e-2 * range); // the results differ: f and -f both order equal values by vertex id
  Domain moved = domain;
  const Eigen::Matrix3d rotation =
    Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  moved.points =
    (1000.0 * domain.points * rotation.transpose()).rowwise() + Eigen::RowVector3d(5e3, -2e3, 1e3);
  EXPECT_LE((smooth(moved, f, options).values - plain).cwiseAbs().maxCoeff(), 1e-6 * range);
}

TEST(MonotoneSmoothing, TheEnergyNeverRises)
{
  const Domain domain = test::to_domain(test::grid(30, 30));
  const VectorXd f = noisy_hills(domain, 0.3);
  for (const int order : { 2, 3 })
  {
    MonotoneSmoothingOptions options;
    options.order = order;
    options.data_weight = 1e7;
    options.extrema = hills_list(domain);
    options.guide = SmoothingGuide::harmonic;
    options.rebuilds = 6;
    const Smoothed result = smooth(domain, f, options);
    expect_only_listed(domain, result);
    ASSERT_GE(result.energies.size(), 3u);
    for (std::size_t i = 1; i < result.energies.size(); ++i)
    {
      EXPECT_LE(result.energies[i], result.energies[i - 1]);
    }
    EXPECT_LT(result.energies.back(), 0.999 * result.energies.front());
    options.rebuilds = 0;
    EXPECT_EQ(smooth(domain, f, options).energies.size(), 1u);
    EXPECT_EQ(result.analyses, 1);
  }
}

TEST(MonotoneSmoothing, EpsilonMakesTheOrderStrict)
{
  const Domain domain = test::to_domain(test::grid(16, 16));
  const VertexGraph graph = vertex_graph(domain);
  const VectorXd f = noisy_hills(domain, 0.3);
  MonotoneSmoothingOptions options;
  options.extrema = hills_list(domain);
  options.epsilon = 1e-3;
  const Smoothed result = smooth(domain, f, options);
  expect_only_listed(domain, result);
  const double least = options.epsilon * (f.maxCoeff() - f.minCoeff()) * (1.0 - 1e-9);
  for (Index v = 0; v < f.size(); ++v)
  {
    double lowest = result.values[v];
    double highest = lowest;
    for (Index k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
    {
      lowest = std::min(lowest, result.values[graph.neighbors[k]]);
      highest = std::max(highest, result.values[graph.neighbors[k]]);
    }
    EXPECT_TRUE(result.list[v] < 0 || lowest <= result.values[v] - least);
    EXPECT_TRUE(result.list[v] > 0 || highest >= result.values[v] + least);
  }
}

TEST(MonotoneSmoothing, ThreadsDoNotChangeABit)
{
  const Domain domain = test::to_domain(test::tet_box(8, 8, 8));
  const VectorXd f = noisy_hills(domain, 0.3);
  MonotoneSmoothingOptions options;
  options.extrema = hills_list(domain);
  const VectorXd serial = smooth(domain, f, options, 1).values;
  for (const int threads : { 2, 5 })
  {
    EXPECT_EQ(smooth(domain, f, options, threads).values, serial);
  }
}

TEST(MonotoneSmoothing, PartsAreSmoothedEachForItself)
{
  const TriangleMesh square = test::grid(12, 12);
  const Domain alone = test::to_domain(square);
  Domain both = test::to_domain(test::join(square, test::translated(square, Vec3(2.0, 0.0, 0.0))));
  const Index n = alone.points.rows();
  // Two unused vertices are added.
  both.points.conservativeResize(2 * n + 2, 3);
  both.points.bottomRows(2) << 9.0, 9.0, 9.0, 0.0, 0.0, 0.0;
  const VectorXd f = noisy_hills(alone, 0.3);
  VectorXd twice(2 * n + 2);
  twice << f, f, std::nan(""), 7.0;
  MonotoneSmoothingOptions options;
  options.extrema = hills_list(alone);
  options.extrema.resize(static_cast<std::size_t>(2 * n + 2), 0);
  // The second part of the mesh has no listed extremum. Its result is therefore constant and equals
  // the mean of the data.
  const Smoothed half = smooth(both, twice, options);
  ASSERT_TRUE(half.status.ok()) << half.status.message;
  EXPECT_EQ(half.status.warnings.size(), 2u);
  const VectorXd mass = lumped_mass(alone.points, alone.triangles);
  const double mean = mass.dot(f) / mass.sum();
  EXPECT_NEAR(half.values.segment(n, n).maxCoeff(), mean, 1e-12);
  EXPECT_NEAR(half.values.segment(n, n).minCoeff(), mean, 1e-12);
  EXPECT_TRUE(std::isnan(half.values[2 * n]));
  EXPECT_EQ(half.values[2 * n + 1], 7.0);
  // If a maximum is listed in the second part, a minimum must be listed there too.
  options.extrema[static_cast<std::size_t>(n) + 40] = 1;
  EXPECT_EQ(smooth(both, twice, options).status.code, StatusCode::invalid_input);
  // Automatic extrema are chosen separately in each part.
  options.extrema.clear();
  options.persistence = 0.3;
  const Smoothed chosen = smooth(both, twice, options);
  ASSERT_TRUE(chosen.status.ok()) << chosen.status.message;
  for (Index v = 0; v < n; ++v)
  {
    EXPECT_EQ(chosen.list[v], chosen.list[n + v]);
    EXPECT_NEAR(chosen.values[v], chosen.values[n + v], 1e-6);
  }
  // If the data of the second part are constant, no extrema are chosen there.
  twice.segment(n, n).setConstant(0.125);
  const Smoothed flat = smooth(both, twice, options);
  ASSERT_TRUE(flat.status.ok()) << flat.status.message;
  EXPECT_NEAR(flat.values[n + 5], 0.125, 1e-12);
}

// Two squares share one corner. If this corner is an extremum, it separates the squares.
TEST(MonotoneSmoothing, WhatAnExtremumClosesOffNeedsOneOfTheOtherKind)
{
  TriangleMesh mesh = test::grid(6, 6);
  const TriangleMesh second = test::translated(mesh, Vec3(1.0, 1.0, 0.0));
  mesh = test::join(mesh, second);
  for (Index& v : mesh.triangles.reshaped())
  {
    // The first corner of the second square is the last corner of the first one.
    v = v == 49 ? 48 : v;
  }
  Domain domain = test::to_domain(mesh);
  VectorXd f = domain.points.col(0) + domain.points.col(1);
  f = (f.array() - 2.0).abs().matrix(); // this function has a minimum at the shared corner
  f[97] += 0.5;
  MonotoneSmoothingOptions options;
  options.extrema_count = 2;
  const Smoothed chosen = smooth(domain, f, options);
  ASSERT_TRUE(chosen.status.ok()) << chosen.status.message;
  EXPECT_EQ(chosen.extrema.size(), 3u);
  EXPECT_EQ(chosen.list[48], -1);
  EXPECT_EQ(chosen.list[0], 1);
  EXPECT_EQ(chosen.list[97], 1);
  options.extrema.assign(98, 0);
  options.extrema[48] = -1;
  options.extrema[97] = 1;
  const Smoothed listed = smooth(domain, f, options);
  EXPECT_EQ(listed.status.code, StatusCode::invalid_input);
  EXPECT_NE(listed.status.message.find("separate from the rest"), std::string::npos)
    << listed.status.message;
}

TEST(MonotoneSmoothing, ConstantDataStay)
{
  const Domain domain = test::to_domain(test::grid(5, 5));
  const Smoothed result = smooth(domain, VectorXd::Constant(36, 4.25));
  EXPECT_TRUE(result.status.ok());
  EXPECT_EQ(result.status.warnings.size(), 1u);
  EXPECT_EQ(result.values, VectorXd::Constant(36, 4.25));
  EXPECT_TRUE(result.extrema.empty());
}

TEST(MonotoneSmoothing, BadInputIsSaid)
{
  const Domain domain = test::to_domain(test::grid(5, 5));
  const VectorXd f = noisy_hills(domain, 0.3);
  const auto message = [&](const VectorXd& data, const MonotoneSmoothingOptions& options)
  {
    const Smoothed result = smooth(domain, data, options);
    EXPECT_EQ(result.status.code, StatusCode::invalid_input);
    return result.status.message;
  };
  MonotoneSmoothingOptions options;
  EXPECT_EQ(smooth(Domain(), VectorXd(), options).status.code, StatusCode::invalid_input);
  VectorXd bad = f;
  bad[7] = std::nan("");
  EXPECT_NE(message(bad, options).find("vertex 7"), std::string::npos);
  bad[7] = HUGE_VAL;
  EXPECT_NE(message(bad, options).find("vertex 7"), std::string::npos);
  bad = f;
  bad[0] = 1.7e308;
  bad[1] = -1.7e308;
  EXPECT_NE(message(bad, options).find("range"), std::string::npos);
  EXPECT_NE(message(f.head(30), options).find("30 data values"), std::string::npos);
  options.extrema.assign(35, 0);
  EXPECT_NE(message(f, options).find("35 entries"), std::string::npos);
  options.extrema.assign(36, 0);
  EXPECT_NE(message(f, options).find("is empty"), std::string::npos);
  options.extrema[3] = 1;
  EXPECT_NE(message(f, options).find("no minimum"), std::string::npos);
  options.extrema[3] = -1;
  EXPECT_NE(message(f, options).find("no maximum"), std::string::npos);
  // The listed minimum has a larger value than the listed maximum next to it.
  options.extrema[3] = 1;
  options.extrema[4] = -1;
  options.keep_values = true;
  bad = f;
  bad[3] = 0.0;
  bad[4] = 1.0;
  EXPECT_NE(message(bad, options).find("cannot be kept"), std::string::npos);
  const auto refuses = [&](auto change)
  {
    MonotoneSmoothingOptions wrong;
    change(wrong);
    EXPECT_FALSE(message(f, wrong).empty());
  };
  refuses([](auto& o) { o.order = 1; });
  refuses([](auto& o) { o.order = 4; });
  refuses([](auto& o) { o.data_weight = -1.0; });
  refuses([](auto& o) { o.data_weight = std::nan(""); });
  refuses([](auto& o) { o.persistence = 1.0; });
  refuses([](auto& o) { o.extrema_count = -1; });
  refuses([](auto& o) { o.epsilon = -0.1; });
  refuses([](auto& o) { o.rebuilds = -1; });
  refuses([](auto& o) { o.tolerance = 0.0; });
  refuses([](auto& o) { o.maximum_iterations = 0; });
}

TEST(MonotoneSmoothing, TooFewIterationsAreSaidAndCancelEndsIt)
{
  const Domain domain = test::to_domain(test::grid(60, 60));
  const VectorXd f = noisy_hills(domain, 0.3);
  MonotoneSmoothingOptions options;
  options.extrema = hills_list(domain);
  options.maximum_iterations = 3;
  const Smoothed result = smooth(domain, f, options);
  EXPECT_EQ(result.status.code, StatusCode::not_converged);
  EXPECT_NE(result.status.message.find("not certified"), std::string::npos);
  EXPECT_EQ(result.values.size(), f.size());
  EXPECT_GT(std::max(result.certificate.relative_gap, result.certificate.kkt_residual), 1e-6);
  EXPECT_LE(result.certificate.order_violation, 0.0); // the order constraints are still satisfied

  ExecutionContext before;
  before.request_cancel();
  MonotoneSmoothingResult nothing;
  EXPECT_EQ(monotone_smoothing(before, domain, f, MonotoneSmoothingOptions(), nothing).code,
    StatusCode::canceled);
  ExecutionContext context;
  options.maximum_iterations = 100;
  options.order = 3;
  const Domain fine = test::to_domain(test::grid(120, 120));
  options.extrema = hills_list(fine);
  test::DelayedCancel later(context, 300);
  EXPECT_EQ(monotone_smoothing(context, fine, noisy_hills(fine, 0.3), options, nothing).code,
    StatusCode::canceled);
  EXPECT_LT(later.seconds_since_cancel(), 1.0);
}
