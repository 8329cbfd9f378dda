// Baseline weights (simple methods for comparisons). They are compared with closed forms. Pairs of
// methods are compared in cases in which they must agree or must differ.
#include "weights/baseline_weights.h"
#include "weights/weight_methods.h"

#include "weights_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;
using test::problem_of;
using ::testing::HasSubstr;

namespace
{
/// Compute weights by the method with the name `word` (see WeightMethod).
WeightsResult solve_by_word(const WeightsProblem& problem, const char* word,
  const WeightsOptions& options = {}, Status* status = nullptr)
{
  ExecutionContext context;
  WeightsResult result;
  const WeightMethod* method = find_weight_method(word);
  if (!method)
  {
    ADD_FAILURE() << word;
    return result;
  }
  const Status done = method->kernel(context, problem, options, result);
  EXPECT_TRUE(done.ok()) << done.message;
  EXPECT_EQ(done.report.text("method"), word);
  if (status)
  {
    *status = done;
  }
  return result;
}

WeightsResult baseline(
  const WeightsProblem& problem, const char* word, const WeightsOptions& options = {})
{
  WeightsResult result = solve_by_word(problem, word, options);
  EXPECT_LE((result.weights.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-12);
  return result;
}

/// Return the largest coordinate of |sum over j of w_j p_j - p| over all vertices p. Here w_j is
/// the weight of point handle j at p, and p_j is the position of this handle's vertex.
double affine_error(const WeightsProblem& problem, const WeightsResult& result)
{
  Points handles(problem.handle_count(), 3);
  for (std::size_t i = 0; i < problem.constraints.vertices.size(); ++i)
  {
    Index j;
    problem.constraints.values.row(static_cast<Index>(i)).maxCoeff(&j);
    handles.row(j) = problem.mesh.domain.points.row(problem.constraints.vertices[i]);
  }
  return (result.raw * handles - problem.mesh.domain.points).cwiseAbs().maxCoeff();
}

double difference_of_weights(const WeightsResult& a, const WeightsResult& b)
{
  return (a.weights - b.weights).cwiseAbs().maxCoeff();
}

/// Return the domain without vertices that no element uses.
Domain without_unused_vertices(const Domain& domain)
{
  std::vector<Index> id(static_cast<std::size_t>(domain.points.rows()), -1);
  Domain result = domain;
  Index count = 0;
  const auto renumber = [&](auto& elements)
  {
    for (Index k = 0; k < elements.size(); ++k)
    {
      Index& v = elements.data()[k];
      if (id[v] < 0)
      {
        id[v] = count;
        result.points.row(count++) = domain.points.row(v);
      }
      v = id[v];
    }
  };
  renumber(result.tets);
  renumber(result.triangles);
  result.points.conservativeResize(count, 3);
  return result;
}

/// Return the unit square without the slot (.4, .6) x (.3, 1].
Domain slotted_square(int n)
{
  const TriangleMesh square = test::grid(n, n);
  Domain domain;
  domain.points = square.points;
  domain.triangles.resize(square.triangles.rows(), 3);
  Index count = 0;
  for (Index t = 0; t < square.triangles.rows(); ++t)
  {
    Vec3 center = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      center += square.points.row(square.triangles(t, k)).transpose() / 3.0;
    }
    if (!(center.x() > 0.4 && center.x() < 0.6 && center.y() > 0.3))
    {
      domain.triangles.row(count++) = square.triangles.row(t);
    }
  }
  domain.triangles.conservativeResize(count, 3);
  return without_unused_vertices(domain);
}
} // namespace

TEST(LinearSubspace, PointsCarryAffineMaps)
{
  const WeightsProblem box = problem_of(test::to_domain(test::tet_box(5, 4, 6)),
    test::point_handles({ Vec3(0.1, 0.2, 0.1), Vec3(0.9, 0.1, 0.3), Vec3(0.2, 0.9, 0.4),
      Vec3(0.5, 0.5, 0.95), Vec3(0.8, 0.7, 0.6) }));
  EXPECT_LT(affine_error(box, solve_by_word(box, "linear-subspace")), 1e-9);
  EXPECT_GT(affine_error(box, solve_by_word(box, "biharmonic")), 1e-2);
  const WeightsProblem square =
    problem_of(test::to_domain(test::grid(20, 20)), test::five_points());
  EXPECT_LT(affine_error(square, solve_by_word(square, "linear-subspace")), 1e-9);
  EXPECT_GT(affine_error(square, solve_by_word(square, "biharmonic")), 1e-2);
}

TEST(LinearSubspace, HandlesThatDoNotSpanAreAWarning)
{
  Status status;
  const WeightsProblem two = problem_of(test::to_domain(test::grid(12, 12)),
    test::point_handles({ Vec3(0.2, 0.5, 0.0), Vec3(0.8, 0.5, 0.0) }));
  const WeightsResult weights = solve_by_word(two, "linear-subspace", {}, &status);
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("do not determine its weights"));
  // The weights are almost linear along x, the direction of the line through the two handles.
  for (Index v = 0; v < two.vertex_count(); ++v)
  {
    EXPECT_NEAR(weights.raw(v, 1), (two.mesh.domain.points(v, 0) - 0.2) / 0.6, 1e-2);
  }
}

TEST(LinearSubspace, OnClosedSurfacesItIsBiharmonic)
{
  const WeightsProblem sphere = problem_of(test::to_domain(test::sphere(2)),
    test::point_handles({ Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1) }));
  EXPECT_LT(difference_of_weights(
              solve_by_word(sphere, "linear-subspace"), solve_by_word(sphere, "biharmonic")),
    1e-8);
}

TEST(GraphBiharmonic, DependsOnTheMesh)
{
  // Half of the strip has a four times finer mesh. The integral of (w'')^2 does not depend on the
  // mesh, but a plain sum of squares does.
  test::Bar strip = test::bar(40, { 0.0, 1.0 });
  const auto uneven = [](double x) { return x < 0.8 ? 0.5 * x / 0.8 : 0.5 + 2.5 * (x - 0.8); };
  test::Bar warped = strip;
  for (Index v = 0; v < warped.domain.points.rows(); ++v)
  {
    warped.domain.points(v, 0) = uneven(warped.domain.points(v, 0));
  }
  const WeightsProblem problem = problem_of(warped.domain, warped.handles, warped.region_ids);
  const auto error = [&](const char* method)
  {
    const WeightsResult result = solve_by_word(problem, method);
    double largest = 0.0;
    for (Index v = 0; v < problem.vertex_count(); ++v)
    {
      const double x = problem.mesh.domain.points(v, 0);
      largest = std::max(largest, std::abs(result.weights(v, 1) - x * x * (3.0 - 2.0 * x)));
    }
    return largest;
  };
  EXPECT_LT(error("biharmonic"), 0.01);
  EXPECT_GT(error("graph-biharmonic"), 0.05);
}

TEST(InverseDistance, IsShepards)
{
  Handles handles = test::point_handles({ Vec3(0.3, 0.9, 0.0), Vec3(0.8, 0.9, 0.0) });
  const WeightsProblem slot = problem_of(slotted_square(20), handles);
  const WeightsResult straight = baseline(slot, "inverse-distance");
  for (Index v = 0; v < slot.vertex_count(); ++v)
  {
    const Vec3 p = slot.mesh.domain.points.row(v);
    if (slot.constraints.roles[v] == VertexRole::solved && (p - Vec3(0.65, 0.9, 0)).norm() < 1e-9)
    {
      EXPECT_NEAR(straight.weights(v, 0), 0.1552, 5e-5) << "across the slot, known";
    }
  }
  // Compare with brute force, for a bone, a region and a point.
  const TetMesh box = test::tet_box(4, 4, 4);
  handles = { test::point_handle("p", Vec3(0.1, 0.9, 0.6)),
    test::bone_handle("b", Vec3(0.25, 0.25, 0.25), Vec3(0.75, 0.25, 0.5)),
    test::region_handle("r", 7) };
  std::vector<Index> labels(static_cast<std::size_t>(box.points.rows()), 0);
  std::vector<Vec3> region;
  for (Index v = 0; v < box.points.rows(); ++v)
  {
    if (box.points(v, 2) > 0.99 && box.points(v, 0) > 0.6)
    {
      labels[v] = 7;
      region.emplace_back(box.points.row(v));
    }
  }
  const WeightsProblem problem = problem_of(test::to_domain(box), handles, labels);
  WeightsOptions options;
  options.power = 3.0;
  const WeightsResult result = baseline(problem, "inverse-distance", options);
  for (Index v = 0; v < problem.vertex_count(); ++v)
  {
    if (problem.constraints.roles[v] != VertexRole::solved)
    {
      continue;
    }
    const Vec3 p = problem.mesh.domain.points.row(v);
    double bone = 1e9;
    for (int i = 0; i <= 100000; ++i)
    {
      bone = std::min(bone, (p - Vec3(0.25 + 0.5e-5 * i, 0.25, 0.25 + 0.25e-5 * i)).norm());
    }
    double labeled = 1e9;
    for (const Vec3& q : region)
    {
      labeled = std::min(labeled, (p - q).norm());
    }
    Vec3 expected((p - handles[0].head).norm(), bone, labeled);
    expected = expected.array().pow(-3.0);
    expected /= expected.sum();
    EXPECT_LT((result.weights.row(v).transpose() - expected).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(SmoothedHarmonic, LiesBetweenHarmonicAndBiharmonic)
{
  const WeightsProblem problem =
    problem_of(test::to_domain(test::grid(24, 24)), test::five_points());
  const WeightsResult harmonic = solve_by_word(problem, "harmonic");
  const WeightsResult biharmonic = solve_by_word(problem, "biharmonic");
  WeightsOptions options;
  options.smoothing = 0.0;
  EXPECT_LT(
    difference_of_weights(baseline(problem, "smoothed-harmonic", options), harmonic), 1e-12);
  options.smoothing = 1e3;
  EXPECT_LT(
    difference_of_weights(baseline(problem, "smoothed-harmonic", options), biharmonic), 1e-6);
  options.smoothing = 0.05;
  const WeightsResult between = baseline(problem, "smoothed-harmonic", options);
  EXPECT_GT(difference_of_weights(between, harmonic), 0.02);
  EXPECT_GT(difference_of_weights(between, biharmonic), 0.02);
}

TEST(BoneHeat, GoesFromHarmonicToNearest)
{
  const WeightsProblem problem =
    problem_of(test::to_domain(test::grid(24, 24)), test::five_points());
  WeightsOptions options;
  options.heat = 1e-12;
  EXPECT_LT(difference_of_weights(
              baseline(problem, "bone-heat", options), solve_by_word(problem, "harmonic")),
    1e-8);
  options.heat = 1e12;
  const WeightsResult nearest = baseline(problem, "bone-heat", options);
  for (Index v = 0; v < problem.vertex_count(); ++v)
  {
    const Vec3 p = problem.mesh.domain.points.row(v);
    Eigen::VectorXd d(problem.handle_count());
    for (Index j = 0; j < d.size(); ++j)
    {
      d[j] = (problem.handles[j].head - p).norm();
    }
    Index j;
    const double least = d.minCoeff(&j);
    if ((d.array() < 1.001 * least).count() == 1)
    {
      EXPECT_NEAR(nearest.weights(v, j), 1.0, 1e-6) << v;
    }
  }
}

TEST(BoneHeat, HandlesHideBehindWalls)
{
  const Handles handles = test::point_handles({ Vec3(0.3, 0.9, 0.0), Vec3(0.8, 0.1, 0.0) });
  WeightsOptions options;
  options.heat = 1e6;
  const auto at_probe = [&](const Domain& domain)
  {
    const WeightsProblem problem = problem_of(domain, handles);
    const WeightsResult result = baseline(problem, "bone-heat", options);
    Index v;
    (problem.mesh.domain.points.rowwise() - Vec3(0.65, 0.9, 0.0).transpose())
      .rowwise()
      .norm()
      .minCoeff(&v);
    return result.weights(v, 0);
  };
  EXPECT_GT(at_probe(test::to_domain(test::grid(20, 20))), 0.99) << "the nearest";
  EXPECT_LT(at_probe(slotted_square(20)), 0.01) << "the nearest is behind the slot";
  // Visibility also matters in a volume: a bone in one leg of a U is not visible from the other
  // leg.
  const TetMesh box = test::tet_box(10, 10, 2, Vec3::Zero(), Vec3(1.0, 1.0, 0.2));
  Domain u;
  u.points = box.points;
  u.tets.resize(box.tets.rows(), 4);
  Index count = 0;
  for (Index t = 0; t < box.tets.rows(); ++t)
  {
    Vec3 center = Vec3::Zero();
    for (int k = 0; k < 4; ++k)
    {
      center += 0.25 * box.points.row(box.tets(t, k)).transpose();
    }
    if (!(center.x() > 0.4 && center.x() < 0.6 && center.y() > 0.3))
    {
      u.tets.row(count++) = box.tets.row(t);
    }
  }
  u.tets.conservativeResize(count, 4);
  u = without_unused_vertices(u);
  const Handles bones = { test::bone_handle("left", Vec3(0.3, 0.9, 0.1), Vec3(0.3, 0.5, 0.1)),
    test::bone_handle("below", Vec3(0.8, 0.1, 0.1), Vec3(0.6, 0.1, 0.1)) };
  const WeightsProblem problem = problem_of(u, bones);
  const WeightsResult result = baseline(problem, "bone-heat", options);
  for (Index v = 0; v < problem.vertex_count(); ++v)
  {
    const Vec3 p = problem.mesh.domain.points.row(v);
    if (p.x() > 0.59 && p.y() > 0.75)
    {
      EXPECT_LT(result.weights(v, 0), 0.05) << p.transpose();
    }
  }
}

TEST(BaselineWeights, BadOptionsAreOneSentence)
{
  const WeightsProblem problem = problem_of(test::to_domain(test::grid(4, 4)), test::five_points());
  ExecutionContext context;
  WeightsResult result;
  for (const double bad : { 0.0, -1.0, std::nan("") })
  {
    WeightsOptions options;
    options.power = bad;
    EXPECT_EQ(
      inverse_distance_weights(context, problem, options, result).code, StatusCode::invalid_input);
    options = {};
    options.heat = bad;
    EXPECT_EQ(
      inverse_distance_weights(context, problem, options, result).code, StatusCode::invalid_input);
  }
  WeightsOptions options;
  options.smoothing = -1.0;
  EXPECT_EQ(
    inverse_distance_weights(context, problem, options, result).code, StatusCode::invalid_input);
  ExecutionContext stopped(nullptr, [] { return true; });
  for (const char* word : { "inverse-distance", "smoothed-harmonic", "bone-heat" })
  {
    EXPECT_EQ(
      find_weight_method(word)->kernel(stopped, problem, {}, result).code, StatusCode::canceled);
  }
}

TEST(WeightMethods, AreFoundByTheirWords)
{
  for (const WeightMethod& method : weight_methods())
  {
    EXPECT_EQ(find_weight_method(method.word), &method);
  }
  EXPECT_EQ(find_weight_method("best"), nullptr);
  EXPECT_THAT(weight_method_words(true), testing::StartsWith("bounded-biharmonic, monotone, "));
  EXPECT_THAT(weight_method_words(false), testing::StartsWith("harmonic, "));
}
