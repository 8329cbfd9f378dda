// Poses from libigl's matrices. The results are compared with the formulas of libigl for transforms
// and for forward kinematics.
#include "pose/pose_matrix.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
/// Return one point, and three bones in a chain.
Handles chain()
{
  Handles handles(4);
  handles[0].name = "p1";
  handles[0].head = handles[0].tail = Vec3(0, 2, 0);
  for (int b = 1; b < 4; ++b)
  {
    handles[b].name = "b" + std::to_string(b);
    handles[b].kind = HandleKind::bone;
    handles[b].head = Vec3(b - 1, 0, 0);
    handles[b].tail = Vec3(b, 0, 0);
    handles[b].parent = b > 1 ? b - 1 : -1;
  }
  return handles;
}
} // namespace

TEST(PoseMatrix, TransformsAreTransposedOneBelowTheOther)
{
  const Handles handles = chain();
  std::srand(3);
  for (const Index d : { 2, 3 })
  {
    const Weights matrix = Weights::Random(4 * (d + 1), d);
    Pose pose;
    ASSERT_TRUE(pose_of_matrix(matrix, handles, pose).ok());
    const Vec3 p(0.3, -0.8, 0.5);
    for (Index h = 0; h < 4; ++h)
    {
      EXPECT_EQ(pose[h].mode, HandleMode::automatic);
      Eigen::RowVectorXd row(d + 1);
      row << p.head(d).transpose(), 1.0;
      const Eigen::RowVectorXd expected = row * matrix.middleRows(h * (d + 1), d + 1);
      const Eigen::RowVectorXd moved = (pose[h].transform * p.homogeneous()).transpose();
      EXPECT_LT((moved.head(d) - expected).norm(), 1e-15);
      if (d == 2)
      {
        EXPECT_EQ(moved[2], p.z());
      }
    }
  }
}

TEST(PoseMatrix, RotationsAddUpAlongAChain)
{
  for (const bool known : { true, false })
  {
    Handles handles = chain();
    for (Handle& handle : handles)
    {
      // Without given parents, the parent of a bone is the bone that ends where this bone begins.
      handle.parent = known ? handle.parent : -1;
    }
    // Each bone rotates by 90 degrees about z, so the chain becomes three sides of a square.
    // Quaternions may have any length.
    Weights matrix(12, 1);
    for (int b = 0; b < 3; ++b)
    {
      matrix.middleRows(4 * b, 4) << 0, 0, (b + 1) * std::sqrt(0.5), (b + 1) * std::sqrt(0.5);
    }
    Pose pose;
    ASSERT_TRUE(pose_of_matrix(matrix, handles, pose).ok());
    EXPECT_EQ(pose[0].transform, identity_affine());
    const Vec3 tails[3] = { Vec3(0, 1, 0), Vec3(-1, 1, 0), Vec3(-1, 0, 0) };
    for (int b = 1; b < 4; ++b)
    {
      EXPECT_LT((pose[b].transform * handles[b].tail.homogeneous() - tails[b - 1]).norm(), 1e-15);
      const Vec3 head = b == 1 ? Vec3(0, 0, 0) : tails[b - 2];
      EXPECT_LT((pose[b].transform * handles[b].head.homogeneous() - head).norm(), 1e-15);
    }
  }
}

TEST(PoseMatrix, BonesInARingEnd)
{
  Handles handles = chain();
  for (Handle& handle : handles)
  {
    handle.parent = -1;
  }
  handles[3].tail = handles[1].head;
  Pose pose;
  ASSERT_TRUE(pose_of_matrix(Weights(Weights::Ones(12, 1)), handles, pose).ok());
  for (const HandlePose& handle : pose)
  {
    EXPECT_TRUE(handle.transform.allFinite());
  }
}

TEST(PoseMatrix, SizesAndNumbersThatCannotBeAreNamed)
{
  const Handles handles = chain();
  Pose pose;
  const auto message = [&](const Weights& matrix)
  {
    const Status status = pose_of_matrix(matrix, handles, pose);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    return status.message;
  };
  EXPECT_EQ(message(Weights::Zero(12, 3)),
    "the pose is a matrix of size 12 x 3; for 4 handles it must be 16 x 3, or in the plane 12 x 2 "
    "(transposed "
    "transforms), or 12 x 1 (rotations of the bones)");
  EXPECT_THAT(message(Weights::Zero(0, 0)), HasSubstr("a matrix of size 0 x 0"));
  EXPECT_THAT(message(Weights::Zero(16, 4)), HasSubstr("a matrix of size 16 x 4"));
  EXPECT_THAT(message(Weights::Zero(12, 1)), HasSubstr("bone 'b1' has length zero"));
  Weights matrix = Weights::Zero(16, 3);
  matrix(3, 1) = std::nan("");
  EXPECT_THAT(message(matrix), HasSubstr("not finite"));
  const Handles points(2, Handle());
  EXPECT_EQ(
    pose_of_matrix(Weights(Weights::Zero(0, 1)), points, pose).code, StatusCode::invalid_input);
}
