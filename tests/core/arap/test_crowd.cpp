// A crowd poses many instances of one shape. Each instance must have the same result as
// ReducedArap.
#include "arap/crowd.h"

#include "core/arap/arap_cases.h"

#include <gmock/gmock.h>

using namespace bindpose;
using namespace bindpose::test;
using testing::HasSubstr;

namespace
{
/// Return the poses of the instances at the given time. All poses are different.
std::vector<Pose> poses_at(const Handles& handles, int time)
{
  std::vector<Pose> poses;
  for (int i = 0; i < 5; ++i)
  {
    Pose pose(handles.size());
    pose[1].mode = i % 2 == 0 ? HandleMode::free : HandleMode::position;
    pose[1].transform.col(3) << 0.0, 0.1 * i, 0.0;
    pose[2].transform = affine_about(handles[2].head,
      rigid(20.0 * i + 10.0 * time, Vec3(0, 0, 1), Vec3::Zero()).leftCols<3>(),
      Vec3(-0.1 * i, 0.2 * i, 0));
    poses.push_back(pose);
  }
  return poses;
}
} // namespace

TEST(Crowd, InstancesAreWhatReducedArapMakesOfTheirPoses)
{
  const Rig rig = bar();
  ExecutionContext context, parallel_context;
  context.set_threads(1);
  parallel_context.set_threads(4);
  Crowd crowd;
  ASSERT_TRUE(
    crowd.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).usable());
  std::vector<ReducedArap> alone(5);
  for (ReducedArap& arap : alone)
  {
    ASSERT_TRUE(
      arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).usable());
  }
  const double diagonal = bounding_box(rig.mesh.points).diagonal();
  for (int time = 0; time < 3; ++time)
  {
    const std::vector<Pose> poses = poses_at(rig.handles, time);
    const Status status = crowd.solve(context, poses);
    ASSERT_TRUE(status.usable()) << status.message;
    EXPECT_EQ(status.report.number("counts.instances", 0), 5);
    std::vector<FloatPoints> posed, again;
    ASSERT_TRUE(crowd.deform(context, rig.mesh.points, posed).ok());
    ASSERT_TRUE(crowd.deform(parallel_context, rig.mesh.points, again).ok());
    EXPECT_EQ(posed, again);
    double iterations = 0.0;
    for (std::size_t i = 0; i < 5; ++i)
    {
      const Status single = alone[i].solve(context, poses[i]);
      ASSERT_TRUE(single.usable());
      iterations += single.report.number("iterations", 0);
      EXPECT_EQ(crowd.transforms()[i], alone[i].transforms()) << time << " " << i;
      Points expected;
      ASSERT_TRUE(alone[i].deform(context, rig.mesh.points, expected).ok());
      EXPECT_LT((posed[i].cast<double>() - expected).cwiseAbs().maxCoeff(), 1e-6 * diagonal);
    }
    EXPECT_EQ(status.report.number("iterations", 0), iterations);
  }
}

TEST(Crowd, ComesAndGoesAndSaysWhichPoseIsBad)
{
  const Rig rig = bar();
  ExecutionContext context;
  Crowd crowd;
  ASSERT_TRUE(
    crowd.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).usable());
  std::vector<Pose> poses = poses_at(rig.handles, 0);
  ASSERT_TRUE(crowd.solve(context, poses).usable());
  const std::vector<std::vector<Affine>> first = crowd.transforms();
  poses[3][2].transform(1, 1) = std::nan("");
  Status status = crowd.solve(context, poses);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_THAT(status.message, HasSubstr("instance 3: "));
  // Solve the first poses again after the failed call.
  poses = poses_at(rig.handles, 0);
  poses.resize(2);
  ASSERT_TRUE(crowd.solve(context, poses).usable());
  std::vector<FloatPoints> posed;
  ASSERT_TRUE(crowd.deform(context, rig.mesh.points, posed).ok());
  EXPECT_EQ(posed.size(), 2u);
  poses = poses_at(rig.handles, 0);
  ASSERT_TRUE(crowd.solve(context, poses).usable());
  EXPECT_EQ(crowd.transforms()[4], first[4]);
  // The report counts the instances that did not converge.
  ReducedSolveOptions few;
  few.tolerance = 1e-15;
  few.max_iterations = 1;
  poses = poses_at(rig.handles, 7);
  status = crowd.solve(context, poses, few);
  EXPECT_EQ(status.code, StatusCode::not_converged);
  EXPECT_GT(status.report.number("counts.not_converged", 0), 0);
  EXPECT_THAT(status.message, HasSubstr("of 5 instances did not converge"));

  context.request_cancel();
  EXPECT_EQ(crowd.solve(context, poses).code, StatusCode::canceled);
}

TEST(Crowd, StandsWhereItIsPlaced)
{
  // A placement transforms the posed points. This must also be true if the rows of the weights do
  // not sum to 1.
  for (const double row_sum : { 1.0, 0.7 })
  {
    Rig rig = bar();
    rig.weights *= row_sum;
    ExecutionContext context;
    Crowd crowd;
    ASSERT_TRUE(
      crowd.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).usable());
    const std::vector<Pose> poses = poses_at(rig.handles, 1);
    ASSERT_TRUE(crowd.solve(context, poses).usable());
    std::vector<Affine> placements;
    for (int i = 0; i < 5; ++i)
    {
      Affine place = rigid(70.0 * i, Vec3(1, 2, 0.5).normalized(), Vec3(i, -2.0 * i, 0.5));
      place.leftCols<3>() *= 1.0 + 0.5 * i;
      placements.push_back(place);
    }
    std::vector<FloatPoints> plain, placed;
    ASSERT_TRUE(crowd.deform(context, rig.mesh.points, plain).ok());
    ASSERT_TRUE(crowd.deform(context, rig.mesh.points, placed, placements).ok());
    for (std::size_t i = 0; i < 5; ++i)
    {
      const Points expected =
        (plain[i].cast<double>() * placements[i].leftCols<3>().transpose()).rowwise() +
        placements[i].col(3).transpose();
      EXPECT_LT((placed[i].cast<double>() - expected).cwiseAbs().maxCoeff(), 1e-5) << i;
    }
    placements.pop_back();
    EXPECT_EQ(
      crowd.deform(context, rig.mesh.points, placed, placements).code, StatusCode::invalid_input);
  }
}

TEST(Crowd, NormalsFollow)
{
  const Rig rig = bar();
  ExecutionContext context;
  Crowd crowd;
  ASSERT_TRUE(
    crowd.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).usable());
  // All handles have the same map. The normals are transformed by the inverse transpose of the map,
  // then by the inverse transpose of the placement.
  Eigen::Matrix3d map, place;
  map << 1.2, 0.3, 0, 0, 0.9, -0.2, 0.1, 0, 1.1;
  place << 0, -2, 0, 1, 0, 0.4, 0, 0, 1.5;
  std::vector<Pose> poses(1, Pose(rig.handles.size()));
  for (HandlePose& handle : poses[0])
  {
    handle.transform.leftCols<3>() = map;
  }
  ASSERT_TRUE(crowd.solve(context, poses).usable());
  Affine placement = identity_affine();
  placement.leftCols<3>() = place;
  Points rest(rig.mesh.points.rows(), 3);
  for (Index v = 0; v < rest.rows(); ++v)
  {
    rest.row(v) = Vec3(std::cos(v), std::sin(v), 0.3).normalized().transpose();
  }
  std::vector<FloatPoints> normals;
  ASSERT_TRUE(crowd.deform_normals(context, rest, normals, { placement }).ok());
  ASSERT_EQ(normals.size(), 1u);
  const Eigen::Matrix3d turn = (place * map).inverse().transpose();
  for (Index v = 0; v < rest.rows(); ++v)
  {
    const Vec3 expected = (turn * rest.row(v).transpose()).normalized();
    EXPECT_LT((normals[0].row(v).cast<double>().transpose() - expected).norm(), 1e-5);
  }
}
