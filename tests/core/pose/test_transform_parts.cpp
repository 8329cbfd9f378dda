// Transforms are decomposed into rotation, scale and translation, and composed from these parts.
// The parts are compared with known rotations and scales. Other tests check the smallest rotation
// from one direction to another.
#include "pose/transform_parts.h"

#include "support/affines.h"
#include "support/meshes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace bindpose;

namespace
{
Vec3 random_vector(test::Random& random)
{
  return random.in_box(-Vec3::Ones(), Vec3::Ones());
}

Affine random_affine(test::Random& random)
{
  Affine transform;
  for (int column = 0; column < 4; ++column)
  {
    transform.col(column) = random_vector(random);
  }
  return transform;
}
} // namespace

TEST(TransformParts, ARotationVectorIsTheAxisTimesTheAngle)
{
  test::Random random(3);
  for (const double degrees : { 0.0, 1e-6, 30.0, 90.0, 179.0, 180.0 })
  {
    const Vec3 axis = random_vector(random).normalized();
    const Vec3 vector =
      rotation_vector(Eigen::AngleAxisd(degrees * EIGEN_PI / 180.0, axis).toRotationMatrix());
    EXPECT_NEAR(vector.norm(), degrees, 1e-6);
    // The axis of a rotation by 180 degrees may have either direction.
    EXPECT_LT(std::min((vector - degrees * axis).norm(),
                degrees < 180.0 ? 1e9 : (vector + degrees * axis).norm()),
      1e-6);
  }
}

TEST(TransformParts, AreComposedToTheTransform)
{
  test::Random random(5);
  for (int k = 0; k < 200; ++k)
  {
    const Affine transform = random_affine(random); // half of these transforms include a reflection
    const Vec3 pivot = random_vector(random);
    const TransformParts parts = parts_of(transform, pivot);
    EXPECT_LT((affine_of(parts, pivot) - transform).norm(), 1e-12);
    EXPECT_LT(
      (parts.rotation * parts.rotation.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(parts.rotation.determinant(), 1.0, 1e-12);
    EXPECT_LT((parts.scale - parts.scale.transpose()).norm(), 1e-12);
    EXPECT_LT((pivot + parts.translation - transform * pivot.homogeneous()).norm(), 1e-12);
  }
}

TEST(TransformParts, AreTheRotationAndScaleThatMadeThem)
{
  test::Random random(6);
  for (int k = 0; k < 100; ++k)
  {
    const Vec3 axis = random_vector(random).normalized();
    const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(random.uniform(-3.0, 3.0), axis).toRotationMatrix();
    const Eigen::Matrix3d half =
      Eigen::Matrix3d::NullaryExpr([&] { return random.uniform(-1, 1); });
    const Eigen::Matrix3d scale = half * half.transpose() + 0.1 * Eigen::Matrix3d::Identity();
    const Vec3 pivot = random_vector(random);
    const TransformParts parts =
      parts_of(affine_about(pivot, rotation * scale, Vec3(1, 2, 3)), pivot);
    EXPECT_LT((parts.rotation - rotation).norm(), 1e-10);
    EXPECT_LT((parts.scale - scale).norm(), 1e-10);
    EXPECT_LT((parts.translation - Vec3(1, 2, 3)).norm(), 1e-12);
  }
}

TEST(TransformParts, OfRestAndOfAMoveAreWithoutRoundOff)
{
  const Vec3 pivot(0.1, 0.7, -0.3);
  const TransformParts parts = parts_of(identity_affine(), pivot);
  EXPECT_EQ(parts.translation, Vec3::Zero());
  EXPECT_EQ(parts.rotation, Eigen::Matrix3d::Identity());
  EXPECT_EQ(parts.scale, Eigen::Matrix3d::Identity());
  EXPECT_EQ(affine_of(parts, pivot), identity_affine());
}

TEST(TransformParts, OfAMirrorHaveItInTheScale)
{
  const Eigen::Matrix3d mirror = Vec3(1, 1, -1).asDiagonal();
  const TransformParts parts =
    parts_of(affine_about(Vec3::Zero(), mirror, Vec3::Zero()), Vec3::Zero());
  EXPECT_NEAR(parts.rotation.determinant(), 1.0, 1e-12);
  EXPECT_NEAR(parts.scale.determinant(), -1.0, 1e-12);
  EXPECT_LT((parts.rotation * parts.scale - mirror).norm(), 1e-12);
}

TEST(MinimalRotation, TurnsAnyDirectionToAnyOtherBySmallestAngle)
{
  test::Random random(9);
  for (int k = 0; k < 1000; ++k)
  {
    const Vec3 from = random_vector(random);
    const Vec3 to = k % 2 ? Vec3(-2.0 * from) : random_vector(random);
    const Eigen::Quaterniond rotation = minimal_rotation(from, to);
    EXPECT_NEAR(rotation.norm(), 1.0, 1e-15);
    EXPECT_LT((rotation * from.normalized() - to.normalized()).norm(), 1e-14);
    EXPECT_NEAR(rotation.angularDistance(Eigen::Quaterniond::Identity()),
      std::acos(std::clamp(from.normalized().dot(to.normalized()), -1.0, 1.0)), 1e-7);
  }
  for (const double tiny : { 1e-5, 1e-9, 1e-13 })
  {
    const Vec3 almost_opposite(-1, tiny, 0);
    const Eigen::Quaterniond rotation = minimal_rotation(Vec3(1, 0, 0), almost_opposite);
    EXPECT_LT((rotation * Vec3(1, 0, 0) - almost_opposite.normalized()).norm(), 1e-14) << tiny;
  }
}

TEST(MinimalRotation, IsExactForEqualDirectionsAndZeroVectors)
{
  const Vec3 vector(0.3, -0.1, 2);
  for (const Vec3& to : { vector, Vec3(4.0 * vector), Vec3(0, 0, 0) })
  {
    EXPECT_EQ(minimal_rotation(vector, to).coeffs(), Eigen::Quaterniond::Identity().coeffs());
    EXPECT_EQ(minimal_rotation(to, vector).coeffs(), Eigen::Quaterniond::Identity().coeffs());
  }
}

TEST(MinimalRotation, OppositeDirectionsInAFlatShapeTurnWithinItsPlane)
{
  const Eigen::Matrix3d half_turn = test::rotation(180, Vec3(0, 0, 1));
  for (const Vec3& from : { Vec3(1, 0, 0), Vec3(0, -2, 0), Vec3(3, -4, 0) })
  {
    EXPECT_LT((minimal_rotation(from, -from).toRotationMatrix() - half_turn).norm(), 1e-15);
  }
}
