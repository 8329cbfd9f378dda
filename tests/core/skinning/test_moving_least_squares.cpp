// Deformation by moving least squares (Schaefer, McPhail, Warren 2006). Rigid poses are exact,
// handles are interpolated, and results are invariant under similarities. Results are compared with
// a direct evaluation of the paper's formulas, and with known integrals.
#include "skinning/moving_least_squares.h"

#include "support/affines.h"
#include "support/differences.h"
#include "support/handles.h"
#include "support/meshes.h"

#include <Eigen/SVD>

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;
using test::affine;
using test::largest_distance;
using test::moved;
using test::rotation;

namespace
{
Handle numbered_point(const Vec3& at, Index number)
{
  return test::point_handle("p" + std::to_string(number), at);
}

Handle numbered_bone(const Vec3& head, const Vec3& tail, Index number)
{
  return test::bone_handle("b" + std::to_string(number), head, tail);
}

Pose pose_of(const std::vector<Affine>& transforms)
{
  Pose pose(transforms.size());
  for (std::size_t j = 0; j < pose.size(); ++j)
  {
    pose[j].transform = transforms[j];
  }
  return pose;
}

/// Return random points in space or in the plane z = 0.
Points random_rest(Index count, bool flat, std::uint64_t seed = 5)
{
  Points points = test::random_points(count, 1.0, seed);
  points.col(2) *= flat ? 0.0 : 1.0;
  return points;
}

/// Return two point handles and two bones.
Handles mixed_handles(bool flat)
{
  const double z = flat ? 0.0 : 1.0;
  return { numbered_point(Vec3(-0.8, 0.1, 0.3 * z), 0), numbered_point(Vec3(0.2, 0.7, -0.4 * z), 1),
    numbered_bone(Vec3(-0.3, -0.6, 0.1 * z), Vec3(0.4, -0.5, 0.6 * z), 2),
    numbered_bone(Vec3(0.5, 0.1, -0.2 * z), Vec3(0.9, 0.8, 0.1 * z), 3) };
}

/// Return a pose with a different motion of each handle.
Pose mixed_pose(bool flat)
{
  const Vec3 axis = flat ? Vec3(0, 0, 1) : Vec3(1, 2, 3);
  const double z = flat ? 0.0 : 1.0;
  return pose_of({ affine(rotation(20, axis), Vec3(0.1, 0.2, -0.3 * z)),
    affine(rotation(-50, axis), Vec3(0, -0.4, 0.2 * z)),
    affine(rotation(75, axis), Vec3(0.3, 0.1, 0.1 * z)),
    affine(rotation(10, axis), Vec3(-0.2, 0.3, 0.4 * z)) });
}

Points warped(const Points& rest, const Handles& handles, const Pose& pose, double exponent = 1.0,
  int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  MovingLeastSquares warp;
  Status status = warp.bind(context, { exponent }, rest, handles);
  EXPECT_TRUE(status.ok()) << status.message;
  Points posed;
  status = warp.warp(context, handles, pose, posed);
  EXPECT_TRUE(status.ok()) << status.message;
  return posed;
}

/// Evaluate the paper's formulas for one point. Each bone is replaced by very many points. The
/// weight of such a point is the length of its part of the bone, divided by the extent of all
/// handles.
Vec3 reference_warp(
  const Vec3& v, const Handles& handles, const Pose& pose, double exponent, bool flat)
{
  double extent = 0.0;
  for (const Handle& one : handles)
  {
    for (const Handle& other : handles)
    {
      for (const Vec3& end : { other.head, other.tail })
      {
        extent = std::max({ extent, (one.head - end).norm(), (one.tail - end).norm() });
      }
    }
  }
  std::vector<Vec3> p;
  std::vector<Vec3> q;
  std::vector<double> w;
  for (std::size_t j = 0; j < handles.size(); ++j)
  {
    const Handle& handle = handles[j];
    const bool is_bone = handle.kind == HandleKind::bone;
    const int samples = is_bone ? 4000 : 1;
    for (int s = 0; s < samples; ++s)
    {
      const double t = is_bone ? (s + 0.5) / samples : 0.0;
      p.push_back(handle.head + t * (handle.tail - handle.head));
      q.emplace_back(pose[j].transform.leftCols<3>() * p.back() + pose[j].transform.col(3));
      const double part = is_bone ? (handle.tail - handle.head).norm() / extent / samples : 1.0;
      w.push_back(part / std::pow((p.back() - v).squaredNorm(), exponent));
    }
  }
  double sum = 0.0;
  Vec3 p_mean = Vec3::Zero();
  Vec3 q_mean = Vec3::Zero();
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    sum += w[i];
    p_mean += w[i] * p[i];
    q_mean += w[i] * q[i];
  }
  p_mean /= sum;
  q_mean /= sum;
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    moment += w[i] / sum * (q[i] - q_mean) * (p[i] - p_mean).transpose();
  }
  if (flat)
  {
    moment(2, 2) = 1e3; // this large entry makes the z axis the axis of rotation
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() > 0 ? 1 : -1);
  const Eigen::Matrix3d turn = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  return turn * (v - p_mean) + q_mean;
}
} // namespace

TEST(MovingLeastSquares, RestStaysAndRigidPosesAreExact)
{
  for (const bool flat : { false, true })
  {
    const Points rest = random_rest(400, flat);
    const Handles handles = mixed_handles(flat);
    EXPECT_LT(largest_distance(warped(rest, handles, Pose(4)), rest), 1e-13);
    for (const double degrees : { 0.0, 33.0, 120.0, 180.0, -90.0 })
    {
      const Vec3 axis = flat ? Vec3(0, 0, 1) : Vec3(0.3, -1, 0.5);
      const Affine motion = affine(rotation(degrees, axis), Vec3(3, -2, flat ? 0 : 1));
      for (const double exponent : { 1.0, 1.5, 3.0 })
      {
        const Points posed = warped(rest, handles, pose_of({ 4, motion }), exponent);
        EXPECT_LT(largest_distance(posed, moved(rest, motion)), 1e-12)
          << degrees << " " << exponent;
      }
    }
  }
}

TEST(MovingLeastSquares, HandlesAreInterpolated)
{
  for (const bool flat : { false, true })
  {
    const Handles handles = mixed_handles(flat);
    const Pose pose = mixed_pose(flat);
    Points rest(2 + 2 * 11, 3);
    Points expected(rest.rows(), 3);
    Index row = 0;
    for (std::size_t j = 0; j < handles.size(); ++j)
    {
      const Handle& handle = handles[j];
      const int steps = handle.kind == HandleKind::bone ? 10 : 0;
      for (int s = 0; s <= steps; ++s, ++row)
      {
        const Vec3 p =
          handle.head + (steps ? double(s) / steps : 0.0) * (handle.tail - handle.head);
        rest.row(row) = p.transpose();
        expected.row(row) =
          (pose[j].transform.leftCols<3>() * p + pose[j].transform.col(3)).transpose();
      }
    }
    for (const double exponent : { 1.0, 2.0, 8.0 })
    {
      EXPECT_LT(largest_distance(warped(rest, handles, pose, exponent), expected), 1e-10)
        << exponent;
    }
  }
}

TEST(MovingLeastSquares, IsThePapersFormula)
{
  for (const bool flat : { false, true })
  {
    const Points rest = random_rest(60, flat, 8);
    const Handles handles = mixed_handles(flat);
    const Pose pose = mixed_pose(flat);
    for (const double exponent : { 1.0, 1.7, 2.0 })
    {
      const Points posed = warped(rest, handles, pose, exponent);
      for (Index v = 0; v < rest.rows(); ++v)
      {
        const Vec3 plain = reference_warp(rest.row(v).transpose(), handles, pose, exponent, flat);
        EXPECT_LT((posed.row(v).transpose() - plain).norm(), 2e-5) << v;
      }
    }
  }
}

TEST(MovingLeastSquares, PointsAloneAreThePapersFormulaToRounding)
{
  const Handles handles{ numbered_point(Vec3(-0.8, 0.1, 0.2), 0),
    numbered_point(Vec3(0.2, 0.7, -0.5), 1), numbered_point(Vec3(0.6, -0.4, 0.1), 2),
    numbered_point(Vec3(-0.1, -0.2, 0.9), 3) };
  const Points rest = random_rest(200, false, 2);
  const Points posed = warped(rest, handles, mixed_pose(false));
  for (Index v = 0; v < rest.rows(); ++v)
  {
    const Vec3 plain =
      reference_warp(rest.row(v).transpose(), handles, mixed_pose(false), 1.0, false);
    EXPECT_LT((posed.row(v).transpose() - plain).norm(), 1e-12) << v;
  }
}

TEST(MovingLeastSquares, MotionsAndScalesGoThrough)
{
  for (const bool flat : { false, true })
  {
    const Points rest = random_rest(200, flat);
    const Handles handles = mixed_handles(flat);
    const Pose pose = mixed_pose(flat);
    const Points posed = warped(rest, handles, pose);
    // If the same similarity is applied to the rest shape and to the pose, it is also applied to
    // the result.
    const Affine change = affine(
      1000.0 * rotation(40, flat ? Vec3(0, 0, 1) : Vec3(1, 0, 1)), Vec3(70, -20, flat ? 0 : 9));
    Handles changed = handles;
    Pose conjugate = pose;
    const Eigen::Matrix3d back = change.leftCols<3>().inverse();
    for (std::size_t j = 0; j < handles.size(); ++j)
    {
      changed[j].head = change.leftCols<3>() * handles[j].head + change.col(3);
      changed[j].tail = change.leftCols<3>() * handles[j].tail + change.col(3);
      const Eigen::Matrix3d linear = change.leftCols<3>() * pose[j].transform.leftCols<3>() * back;
      conjugate[j].transform.leftCols<3>() = linear;
      conjugate[j].transform.col(3) =
        change.leftCols<3>() * pose[j].transform.col(3) + change.col(3) - linear * change.col(3);
    }
    const Points after = warped(moved(rest, change), changed, conjugate);
    EXPECT_LT(largest_distance(after, moved(posed, change)), 1e-8);
    // If the same translation is applied to all handles of the pose, but not to the rest shape, it
    // is also applied to the result. This is true for large translations, too.
    const Affine shift = affine(Eigen::Matrix3d::Identity(), Vec3(1e3, 2e3, flat ? 0 : -5e2));
    Pose shifted = pose;
    for (HandlePose& one : shifted)
    {
      one.transform.col(3) += shift.col(3);
    }
    EXPECT_LT(largest_distance(warped(rest, handles, shifted), moved(posed, shift)), 1e-9);
  }
}

TEST(MovingLeastSquares, OneHandleTellsOnlyWhatItCan)
{
  const Points rest = random_rest(50, false);
  const Affine motion = affine(rotation(60, Vec3(0, 0, 1)), Vec3(1, 2, 3));
  // If the only handle is a point handle, its translation translates all points.
  const Handles one{ numbered_point(Vec3(0.3, 0.2, 0.1), 0) };
  const Vec3 step = motion.leftCols<3>() * one[0].head + motion.col(3) - one[0].head;
  EXPECT_LT(largest_distance(warped(rest, one, pose_of({ motion })),
              moved(rest, affine(Eigen::Matrix3d::Identity(), step))),
    1e-14);
  // In the plane, one bone determines the whole motion.
  const Points flat = random_rest(50, true);
  const Handles stick{ numbered_bone(Vec3(0, 0, 0), Vec3(1, 0, 0), 0) };
  const Affine in_plane = affine(rotation(60, Vec3(0, 0, 1)), Vec3(1, 2, 0));
  EXPECT_LT(
    largest_distance(warped(flat, stick, pose_of({ in_plane })), moved(flat, in_plane)), 1e-12);
  // In space, one bone determines the smallest rotation of its direction. A rotation around the
  // bone has no effect.
  EXPECT_LT(
    largest_distance(warped(rest, stick, pose_of({ in_plane })), moved(rest, in_plane)), 1e-12);
  const Affine roll = affine(rotation(70, Vec3(1, 0, 0)), Vec3::Zero());
  EXPECT_LT(largest_distance(warped(rest, stick, pose_of({ roll })), rest), 1e-12);
}

TEST(MovingLeastSquares, AMirroredPoseInThePlaneDoesNotLeaveIt)
{
  const Points rest = random_rest(100, true);
  const Handles handles{ numbered_point(Vec3(-0.5, 0, 0), 0), numbered_point(Vec3(0.5, 0, 0), 1),
    numbered_point(Vec3(0, 0.6, 0), 2) };
  // In space, a rotation by 180 degrees would fit better, but points in a plane must stay in the
  // plane.
  const Pose mirror = pose_of({ affine(Eigen::Matrix3d::Identity(), Vec3::Zero()),
    affine(Eigen::Matrix3d::Identity(), Vec3::Zero()),
    affine(Eigen::Matrix3d::Identity(), Vec3(0, -1.2, 0)) });
  EXPECT_EQ(warped(rest, handles, mirror).col(2).cwiseAbs().maxCoeff(), 0.0);
}

TEST(MovingLeastSquares, ModesPositionAndFree)
{
  const Points rest = random_rest(100, false);
  const Handles handles = mixed_handles(false);
  Pose pose = mixed_pose(false);
  // A handle of mode free has no effect, even on a point at its position. The additional handle is
  // between the others, so it does not change the extent of the handles. This extent is the unit of
  // length for bones.
  Handles more = handles;
  more.push_back(numbered_point(Vec3(0.1, 0, 0), 4));
  Pose with_free = pose;
  with_free.push_back(pose[1]);
  with_free[4].mode = HandleMode::free;
  Points on = rest;
  on.row(0) << 0.1, 0, 0;
  EXPECT_LT(largest_distance(warped(on, more, with_free), warped(on, handles, pose)), 1e-12);
  // Mode position uses only the translation of the pivot.
  Pose position = pose;
  position[2].mode = HandleMode::position;
  const Vec3 head = handles[2].head;
  const Vec3 goes = pose[2].transform.leftCols<3>() * head + pose[2].transform.col(3);
  pose[2].transform = affine(Eigen::Matrix3d::Identity(), goes - head);
  EXPECT_EQ(largest_distance(warped(rest, handles, position), warped(rest, handles, pose)), 0.0);
  // If all handles have mode free, the result is the rest shape, with a warning.
  for (HandlePose& one : pose)
  {
    one.mode = HandleMode::free;
  }
  ExecutionContext context;
  MovingLeastSquares warp;
  ASSERT_TRUE(warp.bind(context, {}, rest, handles).ok());
  Points still;
  const Status status = warp.warp(context, handles, pose, still);
  EXPECT_TRUE(status.ok());
  EXPECT_EQ(status.warnings.size(), 1u);
  EXPECT_EQ(still, rest);
}

TEST(MovingLeastSquares, SharesOfABoneAreTheIntegrals)
{
  // The bone is the unit interval of the x axis. The point is at (a, d, 0), and the exponent is 1.
  // Moment k is the integral of s^k / (d^2 + s^2) over s from -a to 1 - a:
  // - moment 0: m = (atan((1 - a) / d) + atan(a / d)) / d
  // - moment 1: 1/2 log((d^2 + (1 - a)^2) / (d^2 + a^2))
  // - moment 2: 1 - d^2 m
  ExecutionContext context;
  for (const double d : { 1e-9, 1e-4, 0.1, 1.0, 50.0 })
  {
    for (const double a : { 0.0, 0.3, 1.0 })
    {
      const Handles handles{ numbered_bone(Vec3(0, 0, 0), Vec3(1, 0, 0), 0) };
      Points rest(1, 3);
      rest << a, d, 0.0;
      MovingLeastSquares warp;
      ASSERT_TRUE(warp.bind(context, {}, rest, handles).ok());
      const MovingLeastSquares::HandleMoments moments = warp.moments(0, 0);
      const double zeroth = (std::atan((1 - a) / d) + std::atan(a / d)) / d;
      const double first = 0.5 * std::log((d * d + (1 - a) * (1 - a)) / (d * d + a * a));
      const double second = 1.0 - d * d * zeroth;
      EXPECT_NEAR(moments.amount / (d * d * zeroth), 1.0, 1e-9) << d << " " << a;
      EXPECT_NEAR(moments.mean, a + first / zeroth, 1e-8 * std::max(1e-3, std::abs(first / zeroth)))
        << d;
      if (d <= 1.0) // for larger distances the closed form suffers from cancellation
      {
        EXPECT_NEAR(moments.variance / (second / zeroth - std::pow(first / zeroth, 2)), 1.0, 1e-7)
          << d << " " << a;
      }
    }
  }
  // The point is on the line of the bone, beyond its end. The weight is the integral of 1 / s^2
  // from d to d + 1.
  const Handles handles{ numbered_bone(Vec3(0, 0, 0), Vec3(1, 0, 0), 0) };
  Points rest(1, 3);
  rest << 1.25, 0.0, 0.0;
  MovingLeastSquares warp;
  ASSERT_TRUE(warp.bind(context, {}, rest, handles).ok());
  EXPECT_NEAR(warp.moments(0, 0).amount, 0.25 * 0.25 * (1 / 0.25 - 1 / 1.25), 1e-10);
  EXPECT_NEAR(1.25 - warp.moments(0, 0).mean, std::log(5.0) / (1 / 0.25 - 1 / 1.25), 1e-8);
}

TEST(MovingLeastSquares, TheSameBitsForAnyNumberOfThreads)
{
  const Points rest = random_rest(5000, false);
  const Points one = warped(rest, mixed_handles(false), mixed_pose(false), 1.3, 1);
  const Points two = warped(rest, mixed_handles(false), mixed_pose(false), 1.3, 2);
  EXPECT_EQ(one, two);
}

TEST(MovingLeastSquares, WhatCannotBeUsedIsOneSentence)
{
  ExecutionContext context;
  MovingLeastSquares warp;
  const Points rest = random_rest(10, false);
  for (const double exponent : { 0.0, 0.99, 8.1, -1.0, std::nan("") })
  {
    const Status status = warp.bind(context, { exponent }, rest, mixed_handles(false));
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    EXPECT_NE(status.message.find("exponent"), std::string::npos);
  }
  EXPECT_EQ(warp.bind(context, {}, rest, {}).code, StatusCode::invalid_input);
  Points posed;
  ASSERT_TRUE(warp.bind(context, {}, rest, mixed_handles(false)).ok());
  EXPECT_EQ(
    warp.warp(context, mixed_handles(false), Pose(2), posed).code, StatusCode::invalid_input);
  context.request_cancel();
  EXPECT_EQ(warp.warp(context, mixed_handles(false), Pose(4), posed).code, StatusCode::canceled);
  EXPECT_EQ(warp.bind(context, {}, rest, mixed_handles(false)).code, StatusCode::canceled);
}
