// Transfer by matching and inpainting. Matched rows are those of the source, inpainted rows satisfy
// the optimality conditions of the bounded biharmonic problem, parts that are near each other but
// not connected exchange no weights, and seams and units have no effect.
#include "transfer/inpaint.h"
#include "transfer/transfer.h"

#include "domain/scaled_mesh.h"
#include "weights_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
/// Return an open tube along z, from z = 0 to `length`, with outward normals.
TriangleMesh tube(double x, double radius, double length, int sides = 24, int rings = 20)
{
  TriangleMesh mesh;
  mesh.points.resize((rings + 1) * sides, 3);
  mesh.triangles.resize(2 * rings * sides, 3);
  for (int r = 0; r <= rings; ++r)
  {
    for (int s = 0; s < sides; ++s)
    {
      const double angle = 2.0 * EIGEN_PI * s / sides;
      mesh.points.row(r * sides + s) << x + radius * std::cos(angle), radius * std::sin(angle),
        length * r / rings;
    }
  }
  Index f = 0;
  for (int r = 0; r < rings; ++r)
  {
    for (int s = 0; s < sides; ++s)
    {
      const Index a = r * sides + s, b = r * sides + (s + 1) % sides;
      mesh.triangles.row(f++) << a, b, b + sides;
      mesh.triangles.row(f++) << a, b + sides, a + sides;
    }
  }
  return mesh;
}

/// Two legs beside each other with four handles: the upper and the lower half of each leg. The
/// weights change with height.
struct Legs
{
  Domain domain;
  Weights values;
  static constexpr double distance = 1.1; ///< between the axes; the radius is 0.5

  Legs()
  {
    const TriangleMesh left = tube(0.0, 0.5, 4.0);
    this->domain = test::to_domain(test::join(left, tube(distance, 0.5, 4.0)));
    this->values = Weights::Zero(this->domain.points.rows(), 4);
    for (Index v = 0; v < this->values.rows(); ++v)
    {
      const double t = std::clamp((this->domain.points(v, 2) - 1.0) / 2.0, 0.0, 1.0);
      const Index leg = v < left.points.rows() ? 0 : 2;
      this->values(v, leg) = t;
      this->values(v, leg + 1) = 1.0 - t;
    }
  }
};

/// Inpaint and expect success.
InpaintedWeights inpaint(const Domain& source, const Weights& values, const Domain& target,
  const InpaintOptions& options = {}, Report* report = nullptr, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  InpaintedWeights result;
  const Status status = inpaint_weights(context, source, values, target, options, result);
  EXPECT_TRUE(status.ok()) << status.message;
  if (report)
  {
    *report = status.report;
  }
  return result;
}

std::string error_of(const Domain& source, const Weights& values, const Domain& target,
  const InpaintOptions& options = {})
{
  ExecutionContext context;
  InpaintedWeights result;
  const Status status = inpaint_weights(context, source, values, target, options, result);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_EQ(result.weights.size(), 0);
  return status.message;
}

/// A trouser leg that is wider than the left leg, so that it passes near the right leg.
Domain trouser_leg()
{
  return test::to_domain(tube(0.0, 0.57, 4.0, 30, 25));
}
} // namespace

TEST(VertexNormals, OfASphereAreItsRadii)
{
  const TriangleMesh sphere = test::sphere(3);
  const Points normals = vertex_normals(sphere.points, sphere.triangles);
  EXPECT_LT((normals - sphere.points).cwiseAbs().maxCoeff(), 0.02);
  EXPECT_LT((normals.rowwise().norm().array() - 1.0).abs().maxCoeff(), 1e-14);
  // A triangle and its opposite cancel each other; an unused vertex has no normal.
  TriangleMesh both;
  both.points = Points::Random(4, 3);
  both.triangles.resize(2, 3);
  both.triangles << 0, 1, 2, 0, 2, 1;
  EXPECT_TRUE(vertex_normals(both.points, both.triangles).isZero(0.0));
}

TEST(SurfaceMatch, NeedsDistanceAndNormal)
{
  const Domain source = test::to_domain(test::grid(10, 10)); // in z = 0, with normals along +z
  const auto matched_at = [&](double z, bool flip, double angle)
  {
    TriangleMesh copy = test::translated(test::grid(10, 10), Vec3(0, 0, z));
    copy = flip ? test::flipped(copy) : copy;
    SurfaceMatchOptions options;
    options.maximum_angle = angle;
    ExecutionContext context;
    SurfaceMatch match;
    EXPECT_TRUE(match_surface(context, source, test::to_domain(copy), options, match).ok());
    return std::count(match.matched.begin(), match.matched.end(), 1);
  };
  const double limit = 0.05 * std::sqrt(2.0);
  EXPECT_EQ(matched_at(0.99 * limit, false, 30.0), 121);
  EXPECT_EQ(matched_at(1.01 * limit, false, 30.0), 0);
  EXPECT_EQ(matched_at(0.5 * limit, true, 30.0), 0) << "opposite normals";
  EXPECT_EQ(matched_at(0.5 * limit, true, 180.0), 121) << "normals are ignored";
}

TEST(Inpaint, TheSourceItselfKeepsItsRows)
{
  const Legs legs;
  Report report;
  const InpaintedWeights result = inpaint(legs.domain, legs.values, legs.domain, {}, &report);
  EXPECT_LT((result.weights - legs.values).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(report.number("matched_fraction", 0), 1.0);
  EXPECT_EQ(report.number("counts.inpainted", -1), 0);
}

TEST(Inpaint, NearPartsDoNotShareWeights)
{
  const Legs legs;
  const Domain target = trouser_leg();
  // The nearest transfer takes weights from the other leg, because the trouser leg is wider than
  // half of the gap.
  ExecutionContext context;
  Weights nearest;
  TransferCounts counts;
  ASSERT_TRUE(transfer(context, legs.domain, legs.values, target.points, {}, nearest, counts).ok());
  EXPECT_GT(nearest.rightCols(2).maxCoeff(), 0.9);

  Report report;
  const InpaintedWeights result = inpaint(legs.domain, legs.values, target, {}, &report);
  EXPECT_EQ(result.weights.rightCols(2).maxCoeff(), 0.0);
  EXPECT_GT(report.number("counts.inpainted", 0), 0);
  EXPECT_GT(report.number("matched_fraction", 0), 0.5);
  EXPECT_LT((result.weights.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-12);
  // The weights of the legs depend on the height only. This is also true for the trouser leg, up to
  // the error of the inpainting.
  for (Index v = 0; v < target.points.rows(); ++v)
  {
    const double t = std::clamp((target.points(v, 2) - 1.0) / 2.0, 0.0, 1.0);
    EXPECT_NEAR(result.weights(v, 0), t, 0.03) << v;
  }
}

TEST(Inpaint, SolvedRowsAreOptimal)
{
  // The upper half of a sphere matches; the weights of the lower half are solved for.
  const TriangleMesh sphere = test::sphere(4);
  Domain source = test::to_domain(sphere);
  std::vector<Index> upper;
  for (Index f = 0; f < sphere.triangles.rows(); ++f)
  {
    bool above = true;
    for (int k = 0; k < 3; ++k)
    {
      above = above && sphere.points(sphere.triangles(f, k), 2) > 0.3;
    }
    if (above)
    {
      upper.push_back(f);
    }
  }
  source.triangles.resize(static_cast<Index>(upper.size()), 3);
  for (std::size_t i = 0; i < upper.size(); ++i)
  {
    source.triangles.row(static_cast<Index>(i)) = sphere.triangles.row(upper[i]);
  }
  const Domain target = test::to_domain(sphere);
  Weights values(sphere.points.rows(), 2);
  for (Index v = 0; v < values.rows(); ++v)
  {
    // The values rise towards the edge of the matched part, so that the bounds become active.
    values(v, 0) = std::clamp((1.0 - sphere.points(v, 2)) / 0.7, 0.0, 1.0);
    values(v, 1) = 1.0 - values(v, 0);
  }
  Report report;
  const InpaintedWeights result = inpaint(source, values, target, {}, &report);
  EXPECT_LE(report.number("relative_gap", 1), 1e-6);
  EXPECT_LE(report.number("kkt_residual", 1), 1e-6);
  EXPECT_LT(report.number("row_sum_error", 1), 1e-6);
  const std::vector<char> used(static_cast<std::size_t>(target.points.rows()), 1);
  const ScaledMesh scaled = scale_mesh(target, used);
  const SparseMatrix q = harmonic_energy(scaled.stiffness, scaled.mass, 2);
  const Eigen::VectorXd w = result.weights.col(0);
  const Eigen::VectorXd gradient = q * w;
  double lowest = 1.0, highest = 0.0; // of the matched weights: the bounds of the others
  for (Index v = 0; v < w.size(); ++v)
  {
    lowest = result.matched[v] ? std::min(lowest, w[v]) : lowest;
    highest = result.matched[v] ? std::max(highest, w[v]) : highest;
  }
  EXPECT_EQ(lowest, 0.0);
  EXPECT_LT(highest, 1.0);
  Index at_bounds = 0;
  for (Index v = 0; v < w.size(); ++v)
  {
    if (result.matched[v])
    {
      continue;
    }
    EXPECT_GE(w[v], lowest) << v;
    EXPECT_LE(w[v], highest) << v;
    const double slope = gradient[v] / q.coeff(v, v);
    at_bounds += w[v] == lowest || w[v] == highest;
    EXPECT_NEAR(w[v], std::clamp(w[v] - slope, lowest, highest), 2e-6) << v;
  }
  EXPECT_GT(at_bounds, 0);
}

TEST(Inpaint, SeamsAndThreadsHaveNoEffect)
{
  const Legs legs;
  const TriangleMesh cloth = tube(0.0, 0.57, 4.0, 30, 25);
  const TriangleMesh pieces = test::unwelded(cloth);
  // Normals of single triangles differ from those of vertices, so they are ignored here.
  InpaintOptions options;
  options.match.maximum_angle = 180.0;
  options.match.maximum_distance = 0.01;
  const InpaintedWeights one =
    inpaint(legs.domain, legs.values, test::to_domain(cloth), options, nullptr, 1);
  const InpaintedWeights two =
    inpaint(legs.domain, legs.values, test::to_domain(cloth), options, nullptr, 2);
  EXPECT_EQ(one.weights, two.weights);
  const InpaintedWeights cut = inpaint(legs.domain, legs.values, test::to_domain(pieces), options);
  for (Index f = 0; f < cloth.triangles.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_LT((cut.weights.row(pieces.triangles(f, k)) - one.weights.row(cloth.triangles(f, k)))
                  .cwiseAbs()
                  .maxCoeff(),
        1e-5);
    }
  }
}

TEST(Inpaint, UnitsAndPositionHaveNoEffect)
{
  const Legs legs;
  const Domain target = trouser_leg();
  const InpaintedWeights expected = inpaint(legs.domain, legs.values, target);
  for (const double scale : { 0x1p-200, 0x1p+200 })
  {
    Domain source = legs.domain, scaled = target;
    source.points *= scale;
    scaled.points *= scale;
    const InpaintedWeights result = inpaint(source, legs.values, scaled);
    EXPECT_LT((result.weights - expected.weights).cwiseAbs().maxCoeff(), 1e-5) << scale;
  }
  Domain source = legs.domain, moved = target;
  source.points.rowwise() += Eigen::RowVector3d(1e6, -1e6, 1e6);
  moved.points.rowwise() += Eigen::RowVector3d(1e6, -1e6, 1e6);
  EXPECT_LT(
    (inpaint(source, legs.values, moved).weights - expected.weights).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(Inpaint, TheNumberOfInfluencesIsKept)
{
  // Five columns; each source row has at most two weights above 0.
  const Domain source = test::to_domain(test::grid(20, 4, 5.0, 1.0));
  Weights values = Weights::Zero(source.points.rows(), 5);
  for (Index v = 0; v < values.rows(); ++v)
  {
    const double x = std::clamp(source.points(v, 0) - 0.5, 0.0, 3.999);
    const auto j = static_cast<Index>(x);
    values(v, j) = 1.0 - (x - static_cast<double>(j));
    values(v, j + 1) += x - static_cast<double>(j);
  }
  // A strip whose middle rises far above the source.
  TriangleMesh strip = test::grid(33, 3, 5.0, 1.0);
  for (Index v = 0; v < strip.points.rows(); ++v)
  {
    const double x = strip.points(v, 0);
    strip.points(v, 2) = x > 1.0 && x < 4.0 ? 2.0 : 0.0;
  }
  const auto most = [](const Weights& rows)
  { return (rows.array() > 0.0).cast<int>().rowwise().sum().maxCoeff(); };
  for (const Index limit : { 0, 1, 3 })
  {
    InpaintOptions options;
    options.maximum_influences = limit;
    Report report;
    const InpaintedWeights result =
      inpaint(source, values, test::to_domain(strip), options, &report);
    EXPECT_LE(most(result.weights), limit > 0 ? limit : 2);
    EXPECT_EQ(report.number("maximum_influences", 0), limit > 0 ? limit : 2);
    EXPECT_LT((result.weights.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-12);
    EXPECT_GE(result.weights.minCoeff(), 0.0);
    EXPECT_LE(report.number("relative_gap", 1), 1e-6);
  }
}

TEST(Inpaint, TheInnerSideOfAShellFollowsItsOuterSide)
{
  // A cuff with an inner and an outer side around the middle of a limb, where weights change with
  // height. The inner side has opposite normals, so it does not match.
  const TriangleMesh limb = tube(0.0, 0.5, 4.0, 24, 40);
  Weights values(limb.points.rows(), 2);
  values.col(0) = (limb.points.col(2).array() / 4.0).matrix();
  values.col(1) = (1.0 - values.col(0).array()).matrix();
  constexpr int sides = 24, rings = 8;
  constexpr Index side = (rings + 1) * sides; // points of one side
  const TriangleMesh inner = test::flipped(tube(0.0, 0.55, 1.0, sides, rings));
  TriangleMesh cuff = test::join(tube(0.0, 0.6, 1.0, sides, rings), inner);
  const Index f = cuff.triangles.rows();
  cuff.triangles.conservativeResize(f + 4 * sides, Eigen::NoChange);
  for (Index s = 0; s < sides; ++s)
  {
    const Index next = (s + 1) % sides, top = rings * sides;
    cuff.triangles.row(f + 4 * s) << next, s, s + side;
    cuff.triangles.row(f + 4 * s + 1) << next, s + side, next + side;
    cuff.triangles.row(f + 4 * s + 2) << top + s, top + next, top + side + s;
    cuff.triangles.row(f + 4 * s + 3) << top + next, top + side + next, top + side + s;
  }
  cuff.points.col(2).array() += 1.5;
  const InpaintedWeights result = inpaint(test::to_domain(limb), values, test::to_domain(cuff));
  EXPECT_EQ(std::count(result.matched.begin() + side, result.matched.end(), 1), 0);
  double lowest = 1.0, highest = 0.0; // of the matched weights
  for (Index v = 0; v < side; ++v)
  {
    const double w = result.weights(v, 0);
    lowest = result.matched[v] ? std::min(lowest, w) : lowest;
    highest = result.matched[v] ? std::max(highest, w) : highest;
  }
  EXPECT_GE(lowest, 1.5 / 4.0);
  EXPECT_LE(highest, 2.5 / 4.0);
  EXPECT_GE(result.weights.col(0).minCoeff(), lowest - 1e-6);
  EXPECT_LE(result.weights.col(0).maxCoeff(), highest + 1e-6);
}

TEST(Inpaint, SmallGroupsDoNotMatch)
{
  // A square of 10 x 10 follows handle 0. An island of 2 x 2 in its middle follows handle 1. In a
  // ring around the island, the normals are flipped, so nothing matches there.
  TriangleMesh source = test::unwelded(test::grid(20, 20, 10.0, 10.0));
  Weights values = Weights::Zero(source.points.rows(), 2);
  for (Index f = 0; f < source.triangles.rows(); ++f)
  {
    Vec3 center = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      center += source.points.row(source.triangles(f, k)).transpose() / 3.0;
    }
    const double distance = std::max(std::abs(center.x() - 5.0), std::abs(center.y() - 5.0));
    for (int k = 0; k < 3; ++k)
    {
      values(source.triangles(f, k), distance < 1.0 ? 1 : 0) = 1.0;
    }
    if (distance > 1.0 && distance < 2.0)
    {
      std::swap(source.triangles(f, 1), source.triangles(f, 2));
    }
  }
  // The group above the island has about 4 / 84 = 0.05 of the area of the other group. If the
  // target is finer near the island, it has more vertices, but its area is the same.
  for (const bool finer : { false, true })
  {
    TriangleMesh target = test::translated(test::grid(50, 50, 10.0, 10.0), Vec3(0, 0, 0.1));
    if (finer)
    {
      target.points.leftCols(2) =
        (0.04 * (target.points.leftCols(2).array() - 5.0).cube() + 5.0).matrix();
    }
    for (const double smallest : { 0.02, 0.1 })
    {
      InpaintOptions options;
      options.smallest_group = smallest;
      Report report;
      const InpaintedWeights result =
        inpaint(test::to_domain(source), values, test::to_domain(target), options, &report);
      const bool kept = smallest == 0.02;
      EXPECT_EQ(result.weights.col(1).maxCoeff(), kept ? 1.0 : 0.0) << finer;
      EXPECT_EQ(report.number("counts.small_groups", -1), kept ? 0 : 1) << finer;
      EXPECT_EQ(result.weights.col(0).maxCoeff(), 1.0);
    }
  }
}

TEST(Inpaint, APartWithoutAMatchGetsTheNearestRows)
{
  const Legs legs;
  const TriangleMesh cloth = tube(0.0, 0.57, 4.0);
  const TriangleMesh buckle =
    test::box(Vec3(-0.1, -1.2, 3.5), Vec3(0.1, -1.0, 3.7)); // too far for a match
  ExecutionContext context;
  InpaintedWeights result;
  const Status status = inpaint_weights(
    context, legs.domain, legs.values, test::to_domain(test::join(cloth, buckle)), {}, result);
  ASSERT_TRUE(status.ok());
  EXPECT_EQ(status.report.number("counts.unmatched_parts", 0), 1);
  EXPECT_EQ(status.report.number("counts.nearest", 0), buckle.points.rows());
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("1 of 2 connected parts"));
  for (Index v = cloth.points.rows(); v < result.weights.rows(); ++v)
  {
    EXPECT_NEAR(result.weights(v, 0), 1.0, 1e-14);
    EXPECT_EQ(result.matched[v], 0);
  }
}

TEST(Inpaint, ARigidPieceKeepsItsOneHandle)
{
  // All rows of the source are (1, 0), but interpolated values differ from 1 by round-off.
  const Domain source = test::to_domain(test::sphere(3));
  Weights values = Weights::Zero(source.points.rows(), 2);
  values.col(0).setOnes();
  TriangleMesh helmet = test::sphere(4, 1.02);
  for (Index v = 0; v < helmet.points.rows(); ++v)
  {
    helmet.points(v, 2) *= helmet.points(v, 2) > 0.0 ? 2.0 : 1.0; // the upper half does not match
  }
  Report report;
  const InpaintedWeights result = inpaint(source, values, test::to_domain(helmet), {}, &report);
  EXPECT_GT(report.number("counts.inpainted", 0), 100);
  EXPECT_EQ(report.number("iterations", -1), 0);
  EXPECT_LT((result.weights.col(0).array() - 1.0).abs().maxCoeff(), 1e-12);
  EXPECT_EQ(result.weights.col(1).cwiseAbs().maxCoeff(), 0.0);
}

TEST(Inpaint, ValuesBeyondOneAreKept)
{
  const Legs legs;
  Weights values = legs.values;
  values.col(0) = 3.0 * values.col(0) - Eigen::VectorXd::Constant(values.rows(), 1.0);
  values.col(2).setZero();
  const InpaintedWeights result = inpaint(legs.domain, values, trouser_leg());
  EXPECT_LE(result.weights.col(0).maxCoeff(), 2.0 + 1e-12);
  EXPECT_GE(result.weights.col(0).minCoeff(), -1.0 - 1e-12);
  EXPECT_GT(result.weights.col(0).maxCoeff(), 1.9);
}

TEST(Inpaint, VerticesWithoutWeightsAreIgnored)
{
  // A third leg of the source has no weights; a second trouser leg matches it.
  Legs legs;
  const TriangleMesh third = tube(9.0, 0.5, 4.0);
  legs.domain = test::to_domain(test::join({ legs.domain.points, legs.domain.triangles }, third));
  legs.values.conservativeResize(legs.domain.points.rows(), Eigen::NoChange);
  legs.values.bottomRows(third.points.rows()).setZero();
  const TriangleMesh trousers = test::join(tube(0.0, 0.57, 4.0), tube(9.0, 0.52, 4.0));
  ExecutionContext context;
  InpaintedWeights result;
  const Status status =
    inpaint_weights(context, legs.domain, legs.values, test::to_domain(trousers), {}, result);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(status.report.number("counts.unmatched_parts", 0), 1);
  const Index first = tube(0.0, 0.57, 4.0).points.rows();
  EXPECT_LT((result.weights.topRows(first).rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-12);
  EXPECT_TRUE(result.weights.bottomRows(result.weights.rows() - first).isZero(0.0));
}

TEST(Inpaint, CanBeCanceled)
{
  const Legs legs;
  ExecutionContext context;
  context.request_cancel();
  InpaintedWeights result;
  EXPECT_EQ(inpaint_weights(context, legs.domain, legs.values, trouser_leg(), {}, result).code,
    StatusCode::canceled);
  EXPECT_EQ(result.weights.size(), 0);
}

TEST(Inpaint, SmoothingKeepsSumsAndFarRows)
{
  const Legs legs;
  const Domain target = test::to_domain(test::join(tube(0.0, 0.57, 4.0), tube(9.0, 0.5, 4.0)));
  Legs far = legs;
  // A third leg, far away, that matches everywhere.
  far.domain =
    test::to_domain(test::join({ legs.domain.points, legs.domain.triangles }, tube(9.0, 0.5, 4.0)));
  far.values.conservativeResize(far.domain.points.rows(), Eigen::NoChange);
  for (Index v = legs.values.rows(); v < far.values.rows(); ++v)
  {
    far.values.row(v) << 0.25, 0.75, 0.0, 0.0;
  }
  InpaintOptions options;
  options.match.maximum_distance = 0.01; // of a diagonal of about 10
  const InpaintedWeights before = inpaint(far.domain, far.values, target, options);
  options.smoothing_steps = 10;
  const InpaintedWeights after = inpaint(far.domain, far.values, target, options);
  const Index near = tube(0.0, 0.57, 4.0).points.rows();
  EXPECT_GT((after.weights - before.weights).topRows(near).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_EQ(after.weights.bottomRows(near), before.weights.bottomRows(near));
  EXPECT_LT((after.weights.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-12);
  EXPECT_GE(after.weights.minCoeff(), 0.0);
}

TEST(Inpaint, TetsAreInpaintedInTheirInside)
{
  const TetMesh box = test::tet_box(6, 6, 6);
  const Domain target = test::to_domain(box);
  Domain source;
  source.points = box.points;
  source.triangles = boundary_triangles(box.tets);
  Weights values(box.points.rows(), 2);
  values.col(0) = box.points.col(0);
  values.col(1) = Eigen::VectorXd::Ones(values.rows()) - values.col(0);
  InpaintOptions options;
  options.match.maximum_distance = 1e-6;
  Report report;
  const InpaintedWeights result = inpaint(source, values, target, options, &report);
  EXPECT_EQ(report.number("counts.inpainted", 0), 125);
  EXPECT_LT((result.weights.col(0) - box.points.col(0)).cwiseAbs().maxCoeff(), 0.1);
}

TEST(Inpaint, ThinTrianglesUseUniformWeights)
{
  const Legs legs;
  TriangleMesh cloth = tube(0.0, 0.57, 4.0);
  // Move every second ring almost onto the previous one.
  for (Index v = 0; v < cloth.points.rows(); ++v)
  {
    const Index ring = v / 24;
    cloth.points(v, 2) = ring % 2 == 1 ? cloth.points(v, 2) - 0.2 + 1e-13 : cloth.points(v, 2);
  }
  ExecutionContext context;
  InpaintedWeights result;
  const Status status =
    inpaint_weights(context, legs.domain, legs.values, test::to_domain(cloth), {}, result);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_THAT(status.warnings, testing::ElementsAre(HasSubstr("too thin")));
  EXPECT_GE(result.weights.minCoeff(), 0.0);
  EXPECT_LT((result.weights.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-12);
  EXPECT_EQ(result.weights.rightCols(2).maxCoeff(), 0.0);
}

TEST(Inpaint, ErrorsAreOneSentence)
{
  const Legs legs;
  const Domain target = trouser_leg();
  Domain points = target;
  points.triangles.resize(0, 3);
  EXPECT_THAT(error_of(legs.domain, legs.values, points), HasSubstr("the target mesh has neither"));
  EXPECT_THAT(error_of(points, legs.values, target), HasSubstr("the source mesh has neither"));
  EXPECT_THAT(error_of(legs.domain, legs.values.topRows(5), target), HasSubstr("not 5 x 4"));
  Weights wrong = legs.values;
  wrong(7, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_of(legs.domain, wrong, target), HasSubstr("source vertex 7 are not finite"));
  Domain broken = target;
  broken.points(3, 0) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(error_of(legs.domain, legs.values, broken), HasSubstr("vertex 3"));
  InpaintOptions options;
  options.match.maximum_angle = 181.0;
  EXPECT_THAT(error_of(legs.domain, legs.values, target, options), HasSubstr("0 to 180 degrees"));
  options = {};
  options.match.maximum_distance = -1.0;
  EXPECT_THAT(error_of(legs.domain, legs.values, target, options), HasSubstr("at least 0"));
  options = {};
  options.maximum_influences = -1;
  EXPECT_THAT(error_of(legs.domain, legs.values, target, options), HasSubstr("0 or more"));
  options = {};
  options.smallest_group = 1.5;
  EXPECT_THAT(error_of(legs.domain, legs.values, target, options), HasSubstr("from 0 to 1"));
}
