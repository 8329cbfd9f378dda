// Reduced as-rigid-as-possible deformation: constraints, extra weights, difficult weights, and
// independence of position, scale and threads.
#include "arap/full_arap.h"
#include "arap/reduced_arap.h"

#include "core/arap/arap_cases.h"
#include "support/handles.h"

#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using namespace bindpose::test;
using testing::HasSubstr;

// Constrained positions are satisfied after every iteration.
TEST(ReducedArapRobustness, PositionsAreMetAfterEveryIteration)
{
  const test::Rig rig = test::box();
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  Pose pose = posed(rig.handles, HandleMode::position);
  test::Random random(9);
  for (HandlePose& handle : pose)
  {
    handle.transform.col(3) = random.in_box(-Vec3::Ones(), Vec3::Ones());
  }
  pose[4].mode = HandleMode::free;
  for (Index count = 0; count < 20; ++count)
  {
    const Status status = arap.solve(context, pose, iterations(count));
    ASSERT_TRUE(status.ok() && status.warnings.empty());
    ASSERT_LT(status.report.number("constraint_residual", 1.0), 1e-12);
    Points result;
    ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
    for (std::size_t h = 0; h < 4; ++h)
    {
      const Vec3 target = rig.handles[h].head + pose[h].transform.col(3);
      ASSERT_LT((result.rowwise() - target.transpose()).rowwise().norm().minCoeff(), 1e-12);
    }
  }
}

TEST(ReducedArapRobustness, APivotInsideATetIsThatPointOfTheMesh)
{
  test::Rig rig = test::bar();
  const Vec3 inside(1.13, 0.31, 0.77);
  rig.handles[1].head = rig.handles[1].tail = inside;
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  ASSERT_TRUE(arap.solve(context, bend(HandleMode::position)).usable());
  Points result;
  ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
  // Interpolate the posed position of the point in the tet that contains it.
  for (Index e = 0; e < rig.mesh.tets.rows(); ++e)
  {
    Eigen::Matrix4d corners;
    Eigen::Matrix<double, 3, 4> to;
    for (int k = 0; k < 4; ++k)
    {
      corners.col(k) = rig.mesh.points.row(rig.mesh.tets(e, k)).transpose().homogeneous();
      to.col(k) = result.row(rig.mesh.tets(e, k));
    }
    const Eigen::Vector4d lambda = corners.fullPivLu().solve(inside.homogeneous());
    if (lambda.minCoeff() > 0.0)
    {
      EXPECT_LT((to * lambda - (inside + Vec3(0, 0.3, 0))).norm(), 1e-12);
    }
  }
}

// Redundant constraints are reported. Contradictory constraints are reported and solved by least
// squares.
TEST(ReducedArapRobustness, RedundantAndContradictingPositionsAreNamed)
{
  test::Rig rig = test::bar();
  // This bone begins at the position of the point handle "right".
  rig.handles.push_back(test::bone_handle("tail bone", rig.handles[2].head, Vec3(5, 0.5, 0.5)));
  Weights weights(rig.weights.rows(), 4);
  weights << rig.weights, 0.5 * rig.weights.col(2);
  weights.col(2) *= 0.5;
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, weights, rig.handles).ok());
  Pose pose = posed(rig.handles, HandleMode::position);
  pose[0].mode = HandleMode::full;
  pose[2].transform.col(3) << 0, 1, 0;
  pose[3].transform.col(3) << 0, 1, 0;
  Status status = arap.solve(context, pose);
  ASSERT_TRUE(status.usable());
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("redundant"));
  EXPECT_LT(status.report.number("constraint_residual", 1.0), 1e-10);

  pose[3].transform.col(3) << 0, 2, 0;
  status = arap.solve(context, pose);
  ASSERT_TRUE(status.usable());
  ASSERT_EQ(status.warnings.size(), 2u);
  EXPECT_THAT(status.warnings[1], HasSubstr("contradict"));
  EXPECT_THAT(status.warnings[1], HasSubstr("'right', 'tail bone'"));
  Points result;
  ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
  // Least squares places the vertex at the mean of the two targets.
  EXPECT_LT((result.rowwise() - Eigen::RowVector3d(4, 2.0, 0.5)).rowwise().norm().minCoeff(), 1e-9);
}

// Extra weights keep the rest shape and lower the energy.
TEST(ReducedArapRobustness, ExtraWeightsRestAtZeroAndLowerTheEnergy)
{
  const Status bound = expect_that_extra_weights_help(ExtraWeights::bumps);
  EXPECT_TRUE(bound.warnings.empty());
  EXPECT_GT(bound.report.number("counts.extra_weights", 0), 3);
}

TEST(ReducedArapRobustness, RestStaysAtRestWhateverTheWeights)
{
  const test::Rig rig = test::box(3);
  const Index n = rig.mesh.points.rows();
  test::Random random(21);
  std::vector<Weights> cases;
  Weights dense(n, 5);
  for (Index v = 0; v < n; ++v)
  {
    for (Index j = 0; j < 5; ++j)
    {
      dense(v, j) = random.uniform(-1, 1);
    }
  }
  cases.push_back(dense);
  Weights ill = rig.weights; // two columns of the weights differ by 1e-12
  ill.col(0) = 0.5 * (rig.weights.col(0) + rig.weights.col(1));
  ill.col(1) = ill.col(0) + 1e-12 * dense.col(0);
  cases.push_back(ill);
  Weights doubled = rig.weights;
  doubled.col(1) = doubled.col(0);
  cases.push_back(doubled);
  Weights empty = rig.weights;
  empty.col(3).setZero();
  cases.push_back(empty);
  cases.push_back(Weights::Zero(n, 5));
  for (const Weights& weights : cases)
  {
    ExecutionContext context;
    ReducedArap arap;
    ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, weights, rig.handles).ok());
    for (const HandleMode mode : { HandleMode::full, HandleMode::position, HandleMode::free })
    {
      ASSERT_TRUE(arap.solve(context, posed(rig.handles, mode)).ok());
      Points result;
      ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
      EXPECT_LT((result - rig.mesh.points).cwiseAbs().maxCoeff(), 1e-9);
    }
    // The mesh must not move much farther than the dragged handle.
    Pose pose = posed(rig.handles, HandleMode::position);
    pose[1].transform.col(3) << 0.3, 0.2, 0.1;
    pose[2].mode = HandleMode::free;
    ASSERT_TRUE(arap.solve(context, pose).usable());
    Points result;
    ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
    EXPECT_LT((result - rig.mesh.points).cwiseAbs().maxCoeff(), 3.0);
  }
}

// The modes and transforms are random, including reflections and collapses.
TEST(ReducedArapRobustness, RandomDragsStayFiniteAndNearTheirHandles)
{
  const test::Rig rig = test::box(3);
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(
    arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles, { {}, 0, 3 })
      .ok());
  test::Random random(77);
  Pose pose(5);
  Points result;
  for (int drag = 0; drag < 3000; ++drag)
  {
    HandlePose& handle = pose[static_cast<std::size_t>(random.below(5))];
    handle.mode = static_cast<HandleMode>(random.below(3));
    handle.transform = rigid(random.uniform(-180, 180), random.in_box(-Vec3::Ones(), Vec3::Ones()),
      random.in_box(-Vec3::Ones(), Vec3::Ones()));
    handle.transform.col(drag % 3) *= drag % 7 == 0 ? 0.0 : random.uniform(-1.5, 1.5);
    const bool mixed = drag % 2 == 0;
    const Status status =
      arap.solve(context, pose, { 1e-6, 20, ReducedArap::Start::last, 5, 0.0, mixed });
    ASSERT_TRUE(status.usable());
    for (std::size_t i = 1; i < arap.energies().size(); ++i)
    {
      ASSERT_LE(
        arap.energies()[i], arap.energies()[i - 1] + (mixed ? 1e-6 : 1e-12) * arap.rest_energy());
    }
    ASSERT_LT(status.report.number("constraint_residual", 0.0), 1e-9);
    ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
    ASSERT_LT(result.cwiseAbs().maxCoeff(), 20.0);
  }
}

TEST(ReducedArapRobustness, EmptyHandlesAreNamed)
{
  test::Rig rig = test::box(2);
  rig.weights.col(3).setZero();
  ExecutionContext context;
  ReducedArap arap;
  const Status status =
    arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles);
  ASSERT_TRUE(status.ok());
  ASSERT_EQ(status.warnings.size(), 2u);
  EXPECT_THAT(status.warnings[0], HasSubstr("do not sum to one"));
  EXPECT_THAT(status.warnings[1], HasSubstr("'z'"));
}

TEST(ReducedArapRobustness, FlatSurfacesBendOutOfTheirPlane)
{
  const TriangleMesh plane = test::grid(10, 4, 2.5, 1.0);
  Handles handles(2);
  handles[0].name = "left";
  handles[1].name = "right";
  handles[0].head = handles[0].tail = Vec3(0, 0.5, 0);
  handles[1].head = handles[1].tail = Vec3(2.5, 0.5, 0);
  Weights weights(plane.points.rows(), 2);
  for (Index v = 0; v < plane.points.rows(); ++v)
  {
    const double t = plane.points(v, 0) / 2.5;
    weights.row(v) << 1.0 - t * t * (3.0 - 2.0 * t), t * t * (3.0 - 2.0 * t);
  }
  ExecutionContext context;
  for (const ArapEnergy energy : { ArapEnergy::spokes_and_rims, ArapEnergy::elements })
  {
    ReducedArap arap;
    const Status bound =
      arap.bind(context, plane.points, plane.triangles, weights, handles, { energy, 0, 0 });
    ASSERT_TRUE(bound.ok());
    EXPECT_EQ(bound.report.text("method"),
      energy == ArapEnergy::elements ? "triangles" : "spokes_and_rims");
    Pose pose(2);
    pose[1].mode = HandleMode::position;
    pose[1].transform.col(3) << -0.3, 0, 0.8;
    ASSERT_TRUE(arap.solve(context, pose, iterations(200)).ok());
    Points result;
    ASSERT_TRUE(arap.deform(context, plane.points, result).ok());
    EXPECT_TRUE(result.allFinite());
    EXPECT_LT(
      (result.rowwise() - Eigen::RowVector3d(2.2, 0.5, 0.8)).rowwise().norm().minCoeff(), 1e-12);
    for (std::size_t i = 1; i < arap.energies().size(); ++i)
    {
      ASSERT_LE(arap.energies()[i], arap.energies()[i - 1] + 1e-12 * arap.rest_energy());
    }
  }
}

TEST(ReducedArapRobustness, MovesWithTheWorldAndScalesWithIt)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  const Pose pose = bend(HandleMode::position);
  ASSERT_TRUE(arap.solve(context, pose, iterations(40)).ok());
  Points result;
  ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());

  Affine world = rigid(33, Vec3(1, -1, 2), Vec3(100, 20, -30));
  world.leftCols<3>() *= 50.0;
  Affine back;
  back.leftCols<3>() = world.leftCols<3>().inverse();
  back.col(3) = -back.leftCols<3>() * world.col(3);
  const auto compose = [](const Affine& a, const Affine& b)
  {
    Affine c;
    c.leftCols<3>() = a.leftCols<3>() * b.leftCols<3>();
    c.col(3) = a.leftCols<3>() * b.col(3) + a.col(3);
    return c;
  };
  test::Rig other = rig;
  other.mesh.points = moved(rig.mesh.points, world);
  Pose moved_pose = pose;
  for (std::size_t h = 0; h < 3; ++h)
  {
    other.handles[h].head = other.handles[h].tail = world * rig.handles[h].head.homogeneous();
    moved_pose[h].transform = compose(world, compose(pose[h].transform, back));
  }
  ReducedArap same;
  ASSERT_TRUE(
    same.bind(context, other.mesh.points, other.mesh.tets, other.weights, other.handles).ok());
  ASSERT_TRUE(same.solve(context, moved_pose, iterations(40)).ok());
  Points moved_result;
  ASSERT_TRUE(same.deform(context, other.mesh.points, moved_result).ok());
  EXPECT_LT((moved_result - moved(result, world)).cwiseAbs().maxCoeff(), 1e-9 * 200);
  EXPECT_NEAR(same.energies().back(), 125000.0 * arap.energies().back(), 1e-6);
}

TEST(ReducedArapRobustness, TheOrderOfHandlesDoesNotMatter)
{
  const test::Rig rig = test::bar();
  const std::vector<std::size_t> order{ 2, 0, 1 };
  test::Rig other = rig;
  const Pose pose = bend(HandleMode::position);
  Pose permuted(3);
  for (std::size_t h = 0; h < 3; ++h)
  {
    other.handles[h] = rig.handles[order[h]];
    other.weights.col(static_cast<Index>(h)) = rig.weights.col(static_cast<Index>(order[h]));
    permuted[h] = pose[order[h]];
  }
  ExecutionContext context;
  ReducedArap a, b;
  const ReducedArapOptions options{ ArapEnergy::elements, rig.mesh.tets.rows(), 0 };
  ASSERT_TRUE(
    a.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles, options).ok());
  ASSERT_TRUE(
    b.bind(context, rig.mesh.points, rig.mesh.tets, other.weights, other.handles, options).ok());
  // Before convergence, the extrapolation of Anderson acceleration amplifies round-off. These
  // iterations are therefore not accelerated.
  ASSERT_TRUE(a.solve(context, pose, iterations_from_rest(30)).ok());
  ASSERT_TRUE(b.solve(context, permuted, iterations_from_rest(30)).ok());
  Points first, second;
  ASSERT_TRUE(a.deform(context, rig.mesh.points, first).ok());
  ASSERT_TRUE(b.deform(context, rig.mesh.points, second).ok());
  EXPECT_LT((first - second).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(ReducedArapRobustness, AnyNumberOfThreadsGivesTheSameBits)
{
  const test::Rig rig = test::bar(40);
  Points results[2];
  double energies[2];
  for (int i = 0; i < 2; ++i)
  {
    ExecutionContext context;
    context.set_threads(i == 0 ? 1 : 4);
    ReducedArap arap;
    ASSERT_TRUE(arap
                  .bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles,
                    { ArapEnergy::automatic, 9, 6 })
                  .ok());
    ASSERT_TRUE(arap.solve(context, bend(HandleMode::position)).usable());
    ASSERT_TRUE(arap.deform(context, rig.mesh.points, results[i]).ok());
    energies[i] = arap.energies().back();
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(energies[0], energies[1]);
}

TEST(ReducedArapRobustness, AWarmStartNeedsFewerIterations)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  Pose pose = bend(HandleMode::position);
  ReducedArap::SolveOptions options;
  options.max_iterations = 1000;
  const Status cold = arap.solve(context, pose, options);
  ASSERT_TRUE(cold.ok()) << cold.message;
  pose[1].transform(0, 3) += 0.01;
  const Status warm = arap.solve(context, pose, options);
  ASSERT_TRUE(warm.ok());
  EXPECT_LT(warm.report.number("iterations", 1e9), cold.report.number("iterations", 0));
  // After discard_rotations() the result equals that of a new object.
  arap.discard_rotations();
  ASSERT_TRUE(arap.solve(context, pose, options).ok());
  ReducedArap fresh;
  ASSERT_TRUE(fresh.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  ASSERT_TRUE(fresh.solve(context, pose, options).ok());
  EXPECT_EQ(fresh.energies(), arap.energies());
}

TEST(ReducedArapRobustness, TooFewIterationsSaySo)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  const Status status =
    arap.solve(context, bend(HandleMode::position), { 1e-9, 2, ReducedArap::Start::last });
  EXPECT_EQ(status.code, StatusCode::not_converged);
  EXPECT_THAT(status.message, HasSubstr("last of 2 iterations"));
}

TEST(ReducedArapRobustness, ATimeBudgetIsReplayedByItsIterations)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  ReducedArap timed, counted;
  for (ReducedArap* arap : { &timed, &counted })
  {
    ASSERT_TRUE(arap->bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  }
  const Pose pose = bend(HandleMode::position);
  ReducedArap::SolveOptions options;
  options.tolerance = 1e-15;
  options.max_iterations = 10000000;
  options.budget_microseconds = 5.0;
  const Status status = timed.solve(context, pose, options);
  EXPECT_EQ(status.code, StatusCode::not_converged);
  EXPECT_THAT(status.message, HasSubstr("time budget"));
  const auto allowed = static_cast<Index>(status.report.number("iterations", 0.0));
  EXPECT_GE(allowed, 1);
  EXPECT_GE(status.report.number("residual", -1.0), 0.0);
  options.max_iterations = allowed;
  options.budget_microseconds = 0.0;
  const Status again = counted.solve(context, pose, options);
  EXPECT_EQ(again.report.number("iterations", 0.0), static_cast<double>(allowed));
  EXPECT_EQ(timed.energies(), counted.energies());
  Points first, second;
  ASSERT_TRUE(timed.deform(context, rig.mesh.points, first).ok());
  ASSERT_TRUE(counted.deform(context, rig.mesh.points, second).ok());
  EXPECT_EQ(first, second);
  // Even the smallest time budget permits one iteration in each precision.
  options.max_iterations = 100;
  options.budget_microseconds = 1e-9;
  EXPECT_EQ(timed.solve(context, pose, options).report.number("iterations", 0.0), 2.0);
  options.mixed_precision = false;
  EXPECT_EQ(timed.solve(context, pose, options).report.number("iterations", 0.0), 1.0);
}

// Single precision only makes the solve faster. The result has the accuracy of double precision.
TEST(ReducedArapRobustness, MixedPrecisionComesToTheSameShape)
{
  // The last two sizes exceed the range of float.
  for (const double size : { 1.0, 1e-15, 1e15, 1e-60, 1e60 })
  {
    test::Rig rig = test::bar();
    rig.mesh.points *= size;
    for (Handle& handle : rig.handles)
    {
      handle.head *= size;
      handle.tail *= size;
    }
    ExecutionContext context;
    ReducedArap arap;
    ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
    Pose pose = bend(HandleMode::position);
    for (HandlePose& handle : pose)
    {
      handle.transform.col(3) *= size;
    }
    Points shapes[2];
    double energies[2];
    for (const bool mixed : { false, true })
    {
      const Status status =
        arap.solve(context, pose, { 1e-12, 1000, ReducedArap::Start::rest, 5, 0.0, mixed });
      ASSERT_TRUE(status.ok()) << status.message;
      EXPECT_EQ(status.report.number("single_precision_iterations", -1.0) > 0.0, mixed);
      ASSERT_TRUE(arap.deform(context, rig.mesh.points, shapes[mixed]).ok());
      energies[mixed] = arap.energies().back();
      for (const Eigen::Matrix3d& r : arap.rotations())
      {
        EXPECT_LT((r.transpose() * r - Eigen::Matrix3d::Identity()).norm(), 1e-14);
      }
    }
    EXPECT_NEAR(energies[1], energies[0], 1e-11 * energies[0]);
    EXPECT_LT((shapes[1] - shapes[0]).cwiseAbs().maxCoeff(), 1e-5 * size);
  }
}

TEST(ReducedArapRobustness, BadInputIsNamed)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  ReducedArap arap;
  const Weights short_rows = rig.weights.topRows(5);
  EXPECT_THAT(arap.bind(context, rig.mesh.points, rig.mesh.tets, short_rows, rig.handles).message,
    HasSubstr("5 rows"));
  const Weights two = rig.weights.leftCols(2);
  EXPECT_THAT(arap.bind(context, rig.mesh.points, rig.mesh.tets, two, rig.handles).message,
    HasSubstr("2 columns"));
  Weights broken = rig.weights;
  broken(7, 1) = std::nan("");
  EXPECT_THAT(arap.bind(context, rig.mesh.points, rig.mesh.tets, broken, rig.handles).message,
    HasSubstr("vertex 7"));
  EXPECT_THAT(arap.bind(context, rig.mesh.points, Tets(0, 4), rig.weights, rig.handles).message,
    HasSubstr("no elements"));
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  EXPECT_EQ(arap.solve(context, Pose(2)).code, StatusCode::invalid_input);
  Pose pose(3);
  pose[1].transform(2, 2) = std::nan("");
  EXPECT_THAT(arap.solve(context, pose).message, HasSubstr("'middle'"));
}

TEST(ReducedArapRobustness, CancelEndsTheBindAndTheSolve)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  context.request_cancel();
  ReducedArap arap;
  EXPECT_EQ(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).code,
    StatusCode::canceled);
  ExecutionContext fine;
  ASSERT_TRUE(arap.bind(fine, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  EXPECT_EQ(
    arap.solve(context, bend(HandleMode::free), iterations(1000)).code, StatusCode::canceled);
}

namespace
{
/// The bar of test::bar(), whose middle handle is replaced by a bone from one vertex to another
/// vertex.
struct BarWithBone
{
  test::Rig rig = test::bar();
  Index head = 0, tail = 0; ///< vertex ids

  BarWithBone()
  {
    const auto nearest = [&](const Vec3& place)
    {
      Index v = 0;
      (this->rig.mesh.points.rowwise() - place.transpose()).rowwise().norm().minCoeff(&v);
      return v;
    };
    this->head = nearest(Vec3(1.5, 0, 0));
    this->tail = nearest(Vec3(2.5, 1, 1));
    Handle& bone = this->rig.handles[1];
    bone.kind = HandleKind::bone;
    bone.head = this->rig.mesh.points.row(this->head);
    bone.tail = this->rig.mesh.points.row(this->tail);
  }
};
} // namespace

TEST(ReducedArapRobustness, EndsOfBonesAreHeldOneByOne)
{
  const BarWithBone bar;
  const test::Rig& rig = bar.rig;
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  FullArap whole;
  ASSERT_TRUE(whole.bind(context, rig.mesh.points, rig.mesh.tets, rig.handles).usable());
  Pose pose = bend(HandleMode::free);
  pose[1].transform = rigid(25, Vec3(0, 0.3, 1), Vec3(0.2, 0.4, -0.1));
  pose[1].stretch = 1.2;
  const Vec3 head = posed_pivot(rig.handles[1], pose[1]);
  const Vec3 tail = posed_tail(rig.handles[1], pose[1]);
  EXPECT_NEAR(
    (tail - head).norm(), 1.2 * (rig.handles[1].tail - rig.handles[1].head).norm(), 1e-12);
  std::vector<double> energies;
  for (const HandleMode mode :
    { HandleMode::free, HandleMode::position, HandleMode::tail, HandleMode::ends })
  {
    pose[1].mode = mode;
    const Status status = arap.solve(context, pose, iterations(500));
    ASSERT_TRUE(status.ok() && status.warnings.empty()) << to_string(mode);
    ASSERT_LT(status.report.number("constraint_residual", 0.0), 1e-12);
    energies.push_back(status.report.number("energy", -1.0));
    Points result;
    ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
    EXPECT_EQ((result.row(bar.head).transpose() - head).norm() < 1e-11, constrains_pivot(mode));
    EXPECT_EQ((result.row(bar.tail).transpose() - tail).norm() < 1e-11, constrains_tail(mode));

    const Status full = whole.solve(context, pose);
    ASSERT_TRUE(full.usable()) << full.message;
    ASSERT_LT(full.report.number("constraint_residual", 0.0), 1e-9);
    const Points& without = whole.posed();
    EXPECT_EQ((without.row(bar.head).transpose() - head).norm() < 1e-9, constrains_pivot(mode));
    EXPECT_EQ((without.row(bar.tail).transpose() - tail).norm() < 1e-9, constrains_tail(mode));
  }
  // A constraint on the head or on the tail of the bone raises the energy. Constraints on both
  // raise the energy further.
  EXPECT_LT(energies[0], energies[1]);
  EXPECT_LT(energies[0], energies[2]);
  EXPECT_LT(energies[1], energies[3]);
  EXPECT_LT(energies[2], energies[3]);
}

TEST(ReducedArapRobustness, RigidTargetsOfEndsAreReached)
{
  // Bones whose ends are both constrained determine a rigid motion, unless all ends are on one
  // line.
  BarWithBone bar;
  test::Rig& rig = bar.rig;
  rig.handles[2].kind = HandleKind::bone;
  rig.handles[2].tail = rig.mesh.points.row(0);
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  const Affine motion = rigid(110, Vec3(1, 2, 3), Vec3(5, -2, 1));
  Pose pose = posed(rig.handles, HandleMode::ends, motion);
  pose[0].mode = HandleMode::position;
  const Status status = arap.solve(context, pose, iterations(2000));
  ASSERT_TRUE(status.ok());
  Points result;
  ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
  EXPECT_LT((result - moved(rig.mesh.points, motion)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ReducedArapRobustness, ModesOfEndsAreForBones)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  for (const HandleMode mode : { HandleMode::tail, HandleMode::ends })
  {
    const Status status = arap.solve(context, bend(mode));
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    EXPECT_EQ(status.message,
      "the mode " + std::string(to_string(mode)) + " of handle '" + rig.handles[1].name +
        "' can only be used for bones");
  }
}
