// Reduced dynamics (time steps of implicit Euler in the reduced space) obeys the laws of mechanics.
#include "arap/reduced_dynamics.h"

#include "core/arap/arap_cases.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using namespace bindpose::test;
using testing::HasSubstr;

namespace
{
/// A body made of the tets of the bar, with the masses that lumped_mass computes.
class Body
{
public:
  explicit Body(const test::Rig& rig, Index extra = 0, int threads = 1) : rig_(rig)
  {
    this->context.set_threads(threads);
    ReducedArapOptions options;
    options.extra_weights = extra;
    EXPECT_TRUE(
      this->dynamics
        .bind(this->context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles, options)
        .ok());
    this->mass = lumped_mass(rig.mesh.points, rig.mesh.tets);
  }

  Points points()
  {
    Points result;
    EXPECT_TRUE(this->dynamics.deform(this->context, this->rig_.mesh.points, result).ok());
    return result;
  }
  Vec3 middle() { return this->points().transpose() * this->mass / this->mass.sum(); }
  void step(const Pose& pose, const ReducedDynamicsOptions& options)
  {
    const Status status = this->dynamics.step(this->context, pose, options);
    ASSERT_TRUE(status.usable()) << status.message;
  }
  double mechanical_energy(const ReducedDynamicsOptions& options) const
  {
    return options.stiffness * this->dynamics.elastic_energy() +
      options.density * this->dynamics.kinetic_energy();
  }

  ExecutionContext context;
  ReducedDynamics dynamics;
  Eigen::VectorXd mass;

private:
  const test::Rig& rig_;
};

/// Return the pose before the release: the left end is fixed and the right end is displaced.
Pose dragged_pose()
{
  return bend(HandleMode::free);
}

Pose released_pose()
{
  Pose pose(3);
  pose[1].mode = pose[2].mode = HandleMode::free;
  return pose;
}
} // namespace

// With implicit Euler, gravity g and the time step h, a body falls by g h^2 n (n + 1) / 2 in n
// steps, without deformation.
TEST(ReducedDynamics, FallsFreely)
{
  const test::Rig rig = test::bar();
  Body body(rig);
  const Pose pose = posed(rig.handles, HandleMode::free);
  ReducedDynamicsOptions options;
  options.time_step = 0.01;
  options.gravity = Vec3(0.3, -9.81, 0.2);
  options.density = 2.0;
  options.stiffness = 100.0;
  const Vec3 start = body.middle();
  for (int n = 1; n <= 100; ++n)
  {
    body.step(pose, options);
    const Vec3 fall = options.gravity * (1e-4 * n * (n + 1) / 2);
    EXPECT_LT((body.middle() - start - fall).norm(), 1e-10) << n;
    EXPECT_LT(arap_energy(rig.mesh.points, rig.mesh.tets, body.dynamics.groups(), body.points(),
                body.dynamics.rotations()),
      1e-20);
  }
  EXPECT_NEAR(body.dynamics.state().time, 1.0, 1e-12);
}

TEST(ReducedDynamics, DragSlowsTheFallByItsFormula)
{
  const test::Rig rig = test::bar();
  Body body(rig);
  const Pose pose = posed(rig.handles, HandleMode::free);
  ReducedDynamicsOptions options;
  options.time_step = 0.02;
  options.gravity = Vec3(0, -10, 0);
  options.damping = 1.5;
  double velocity = 0.0, height = body.middle().y();
  for (int n = 1; n <= 50; ++n)
  {
    body.step(pose, options);
    velocity = (velocity - 0.02 * 10.0) / (1.0 + 0.02 * 1.5);
    height += 0.02 * velocity;
    EXPECT_NEAR(body.middle().y(), height, 1e-10);
  }
}

TEST(ReducedDynamics, WithoutGravityMomentumStays)
{
  const test::Rig rig = test::bar();
  Body body(rig, 6);
  ReducedDynamicsOptions options;
  options.time_step = 0.01;
  options.stiffness = 50.0;
  // The bar swings with one end fixed. Then this end is released, and the bar moves away while it
  // rotates and vibrates.
  ASSERT_TRUE(body.dynamics.start(body.context, dragged_pose()).usable());
  for (int n = 0; n < 20; ++n)
  {
    body.step(released_pose(), options);
  }
  const Vec3 momentum = body.dynamics.momentum();
  EXPECT_GT(momentum.norm(), 1e-2);
  const Pose nothing = posed(rig.handles, HandleMode::free);
  for (int n = 0; n < 200; ++n)
  {
    body.step(nothing, options);
    ASSERT_LT((body.dynamics.momentum() - momentum).norm(), 1e-10 * momentum.norm()) << n;
  }
  // The reported momentum equals the total mass times the velocity of the center of mass.
  const Vec3 before = body.middle();
  body.step(nothing, options);
  const Vec3 velocity = (body.middle() - before) / options.time_step;
  EXPECT_LT((velocity * body.mass.sum() - momentum).norm(), 1e-9);
}

TEST(ReducedDynamics, SwingsAreWavesThatLoseEnergy)
{
  const test::Rig rig = test::bar();
  Body body(rig);
  ReducedDynamicsOptions options;
  options.time_step = 0.01;
  options.stiffness = 50.0;
  options.solve.tolerance = 1e-12;
  options.solve.max_iterations = 2000;
  ASSERT_TRUE(body.dynamics.start(body.context, dragged_pose(), options.solve).usable());
  double energy = body.mechanical_energy(options);
  EXPECT_GT(energy, 1e-2);
  double largest_kinetic = 0.0;
  const double start = energy;
  for (int n = 0; n < 300; ++n)
  {
    body.step(released_pose(), options);
    const double now = body.mechanical_energy(options);
    ASSERT_LE(now, energy + 1e-9 * start) << n;
    energy = now;
    largest_kinetic = std::max(largest_kinetic, body.dynamics.kinetic_energy());
  }
  EXPECT_GT(largest_kinetic, 0.1 * start); // the bar did vibrate
  EXPECT_LT(energy, 0.9 * start);
  // A body at rest stays at rest and does not drift.
  ASSERT_TRUE(body.dynamics.start(body.context, posed(rig.handles, HandleMode::free)).usable());
  for (int n = 0; n < 100; ++n)
  {
    body.step(posed(rig.handles, HandleMode::free), options);
  }
  EXPECT_LT((body.points() - rig.mesh.points).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(ReducedDynamics, ComesToRestWhereTheForcesBalance)
{
  const test::Rig rig = test::bar();
  Body body(rig, 4);
  ReducedDynamicsOptions options;
  options.time_step = 0.1;
  options.stiffness = 200.0;
  options.gravity = Vec3(0, -1, 0);
  options.damping = 2.0;
  options.solve.tolerance = 1e-14;
  options.solve.max_iterations = 500;
  for (int n = 0; n < 600; ++n)
  {
    body.step(released_pose(), options);
  }
  EXPECT_LT(body.dynamics.kinetic_energy(), 1e-12);
  const Points hanging = body.points();
  EXPECT_LT(hanging.col(1).minCoeff(), rig.mesh.points.col(1).minCoeff() - 0.01);
  // The equilibrium does not depend on the time step.
  options.time_step = 0.25;
  for (int n = 0; n < 300; ++n)
  {
    body.step(released_pose(), options);
  }
  EXPECT_LT((body.points() - hanging).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ReducedDynamics, AReleasedDragKeepsItsVelocity)
{
  const test::Rig rig = test::bar();
  Body body(rig);
  ReducedDynamicsOptions options;
  options.time_step = 0.02;
  options.stiffness = 100.0;
  Pose pose = posed(rig.handles, HandleMode::full);
  for (int n = 1; n <= 20; ++n)
  {
    for (HandlePose& handle : pose)
    {
      // Each handle moves by 0.05 per time step of 0.02, which is a speed of 2.5.
      handle.transform.col(3) = Vec3(0.0, 0.05 * n, 0.0);
    }
    body.step(pose, options);
  }
  const double height = body.middle().y();
  for (int n = 1; n <= 20; ++n)
  {
    body.step(posed(rig.handles, HandleMode::free), options);
    EXPECT_NEAR(body.middle().y(), height + 0.05 * n, 1e-9);
  }
}

// Simulate one hour at 24 frames per second, with random drags and releases under gravity and large
// time steps.
TEST(ReducedDynamics, AnHourOfFramesStaysFinite)
{
  const test::Rig rig = test::bar(6);
  Body body(rig, 3);
  ReducedDynamicsOptions options;
  options.stiffness = 300.0;
  options.gravity = Vec3(0, -9.81, 0);
  options.damping = 0.2;
  options.solve.max_iterations = 5;
  test::Random random(5);
  Pose pose = released_pose();
  for (int n = 0; n < 3600 * 24; ++n)
  {
    if (n % 100 == 0)
    {
      pose[0].transform.col(3) = random.in_box(Vec3::Constant(-0.5), Vec3::Constant(0.5));
      pose[2].mode = static_cast<HandleMode>(random.below(3));
      pose[2].transform.col(3) = random.in_box(Vec3::Constant(-1), Vec3::Constant(1));
    }
    const Status status = body.dynamics.step(body.context, pose, options);
    ASSERT_TRUE(status.usable());
    ASSERT_LT(body.dynamics.state().displacement.cwiseAbs().maxCoeff(), 100.0) << n;
  }
  EXPECT_NEAR(body.dynamics.state().time, 3600.0, 1e-6);
}

TEST(ReducedDynamics, ReplaysAreTheSameBitsOnAnyNumberOfThreads)
{
  const test::Rig rig = test::bar();
  ReducedDynamicsOptions options;
  options.stiffness = 100.0;
  options.gravity = Vec3(0, -1, 0);
  Body first(rig, 5), second(rig, 5, 4);
  ReducedDynamics::State half;
  for (Body* body : { &first, &second })
  {
    ASSERT_TRUE(body->dynamics.start(body->context, dragged_pose()).usable());
    for (int n = 0; n < 60; ++n)
    {
      body->step(n < 10 ? dragged_pose() : released_pose(), options);
      if (n == 29)
      {
        half = body->dynamics.state();
      }
    }
  }
  const Points at_end = first.points();
  EXPECT_EQ(at_end, second.points());
  // Restore the state that was saved after the first half of the simulation, and repeat the second
  // half.
  first.dynamics.set_state(half);
  EXPECT_NE(first.points(), at_end);
  for (int n = 30; n < 60; ++n)
  {
    first.step(released_pose(), options);
  }
  EXPECT_EQ(first.points(), at_end);
}

TEST(ReducedDynamics, BadNumbersAreNamed)
{
  const test::Rig rig = test::bar();
  Body body(rig);
  const Pose pose = released_pose();
  const auto message = [&](auto change)
  {
    ReducedDynamicsOptions options;
    change(options);
    const Status status = body.dynamics.step(body.context, pose, options);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    return status.message;
  };
  using Options = ReducedDynamicsOptions;
  EXPECT_THAT(message([](Options& o) { o.time_step = 0.0; }), HasSubstr("time step"));
  EXPECT_THAT(message([](Options& o) { o.density = -1.0; }), HasSubstr("density"));
  EXPECT_THAT(message([](Options& o) { o.stiffness = std::nan(""); }), HasSubstr("stiffness"));
  EXPECT_THAT(message([](Options& o) { o.damping = -0.1; }), HasSubstr("damping"));
  EXPECT_THAT(message([](Options& o) { o.gravity[1] = INFINITY; }), HasSubstr("gravity"));
  EXPECT_EQ(body.dynamics.step(body.context, Pose(1), {}).code, StatusCode::invalid_input);
}
