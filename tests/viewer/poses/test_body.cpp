// A moving body (recorded dynamics): a replay gives the same bits, a released body keeps its
// velocity, and the motion ends at rest.
#include "poser/body.h"
#include "rigs.h"

#include <gtest/gtest.h>

using namespace bindpose;
using test::beam;
using test::Rig;

namespace
{
class MovingBeam : public testing::Test
{
protected:
  MovingBeam() : body(this->rig.source())
  {
    this->start = Pose(4);
    this->start[1].mode = this->start[2].mode = this->start[3].mode = HandleMode::free;
    this->start[0].mode = HandleMode::full;
    EXPECT_TRUE(this->body.bind(this->context, this->reduced).usable());
    EXPECT_TRUE(this->body.restart(this->context, this->start, this->posed).usable());
  }

  void step(const Pose& pose)
  {
    const Status status = this->body.step(this->context, pose, this->options, this->posed);
    ASSERT_TRUE(status.usable()) << status.message;
  }

  Rig rig = beam();
  ExecutionContext context;
  PoseOptions reduced;
  BodyOptions options;
  Body body;
  Pose start;
  Points posed;
};
} // namespace

TEST_F(MovingBeam, SagsUnderGravityAndReplaysBitByBit)
{
  const double end = this->posed.col(1).minCoeff();
  std::vector<Points> frames{ this->posed };
  Pose pose = this->start;
  for (int k = 0; k < 40; ++k)
  {
    if (k == 20)
    {
      pose[0].transform(0, 3) = 0.3;
      this->options.damping = 3.0;
    }
    this->step(pose);
    frames.push_back(this->posed);
  }
  EXPECT_LT(this->posed.col(1).minCoeff(), end - 0.01);
  ASSERT_EQ(this->body.run().steps.size(), 40U);
  // Consecutive recorded steps with equal poses share one pose object.
  EXPECT_EQ(this->body.run().steps[0].pose, this->body.run().steps[19].pose);
  EXPECT_NE(this->body.run().steps[19].pose, this->body.run().steps[20].pose);

  Body other(this->rig.source());
  ASSERT_TRUE(other.bind(this->context, this->reduced).usable());
  for (Body* replayed : { &other, &this->body })
  {
    std::size_t steps = 0;
    const BodyRun run = this->body.run();
    const Status status = replayed->play(this->context, run,
      [&](std::size_t step, const Points& points)
      {
        EXPECT_EQ(points, frames[step]) << step;
        ++steps;
        return true;
      });
    EXPECT_TRUE(status.usable()) << status.message;
    EXPECT_EQ(steps, 41U);
  }
  EXPECT_EQ(this->body.binds(), 1);
}

TEST_F(MovingBeam, KeepsItsVelocityWhenItIsLetGo)
{
  this->options.gravity = 0.0;
  this->options.damping = 0.0;
  Pose pose = this->start;
  pose[3].mode = HandleMode::position; // constrain the handle, which then moves along y
  for (int k = 1; k <= 6; ++k)
  {
    pose[3].transform(1, 3) = 0.05 * k;
    this->step(pose);
  }
  const Vec3 before = this->body.transforms()[3].col(3);
  const Points points_at_release = this->posed;
  pose[3].mode = HandleMode::free;
  for (int k = 0; k < 3; ++k)
  {
    this->step(pose);
  }
  // After the handle is released, the body continues to move.
  EXPECT_GT((this->posed - points_at_release).col(1).maxCoeff(), 0.02);
  EXPECT_NE(Vec3(this->body.transforms()[3].col(3)), before);
}

TEST_F(MovingBeam, ComesToRestWithDamping)
{
  this->options.damping = 20.0;
  for (int k = 0; k < 400; ++k)
  {
    this->step(this->start);
  }
  const Points before = this->posed;
  this->step(this->start);
  EXPECT_LT((this->posed - before).cwiseAbs().maxCoeff(), 1e-5);
}

TEST_F(MovingBeam, MovesInTetsToo)
{
  this->reduced.use_tet_energy = true;
  this->reduced.extra_weights = 3;
  ASSERT_TRUE(this->body.bind(this->context, this->reduced).usable());
  EXPECT_FALSE(this->body.has_started());
  ASSERT_TRUE(this->body.restart(this->context, this->start, this->posed).usable());
  EXPECT_LT((this->posed - this->rig.source()->points).cwiseAbs().maxCoeff(), 1e-9);
  for (int k = 0; k < 10; ++k)
  {
    this->step(this->start);
  }
  EXPECT_TRUE(this->posed.allFinite());
}

TEST(Body, WhatCannotMoveIsSaid)
{
  Rig rig = beam();
  rig.surface->GetPointData()->RemoveArray("Weights");
  Body body(rig.source());
  ExecutionContext context;
  Points posed;
  EXPECT_NE(body.bind(context, {}).message, "");
  EXPECT_NE(body.restart(context, Pose(4), posed).message, "");
  EXPECT_NE(body.step(context, Pose(4), {}, posed).message, "");
  EXPECT_NE(body.play(context, {}, [](std::size_t, const Points&) { return true; }).message, "");
}
