// Optimal rotations for covariance matrices: comparisons with Eigen's SVD, and cases with several
// optima.
#include "pose/rotation_fit.h"

#include "support/meshes.h"

#include <Eigen/SVD>
#include <gtest/gtest.h>

using namespace bindpose;

namespace
{
Eigen::Matrix3d random_square_matrix(test::Random& random)
{
  Eigen::Matrix3d s;
  for (int i = 0; i < 9; ++i)
  {
    s(i / 3, i % 3) = random.uniform(-1.0, 1.0);
  }
  return s;
}

Eigen::Matrix3d random_rotation(test::Random& random)
{
  const Vec3 axis = random.in_box(-Vec3::Ones(), Vec3::Ones()).normalized();
  return Eigen::AngleAxisd(random.uniform(-3.0, 3.0), axis).toRotationMatrix();
}

/// Return the largest value of tr(R S) over all rotations R.
double best_trace(const Eigen::Matrix3d& s)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(s, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.singularValues()[0] + svd.singularValues()[1] + sign * svd.singularValues()[2];
}

/// Expect that r is orthogonal with determinant +1, and that tr(R S) is as large as for the SVD.
void expect_best(const Eigen::Matrix3d& s, const Eigen::Matrix3d& r)
{
  ASSERT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-13);
  ASSERT_GT(r.determinant(), 0.999999);
  ASSERT_LE(best_trace(s) - (r * s).trace(), 1e-13 * s.norm()) << s;
}
} // namespace

// The fitted rotations of 100,000 random matrices are as good as those of an SVD.
TEST(RotationFit, HundredThousandRandomMatricesAreAsGoodAsTheirSvd)
{
  constexpr Index count = 100000;
  test::Random random(3);
  std::vector<double> s(9 * count), r(9 * count, 0.0);
  for (Index k = 0; k < count; ++k)
  {
    Eigen::Matrix3d matrix = random_square_matrix(random);
    if (k % 4 == 1) // the matrix is close to a reflection
    {
      matrix = random_rotation(random) * Vec3(1.0, 0.9, -0.5).asDiagonal() * matrix;
    }
    if (k % 4 == 2) // the magnitudes are from 1e-20 to 1e20
    {
      matrix *= std::pow(10.0, random.uniform(-20.0, 20.0));
    }
    if (k % 4 == 3) // the singular values differ by factors of up to 1e12
    {
      matrix = random_rotation(random) *
        Vec3(1.0, std::pow(10.0, random.uniform(-6.0, 0.0)),
          std::pow(10.0, random.uniform(-12.0, 0.0)))
          .asDiagonal() *
        random_rotation(random);
    }
    for (int e = 0; e < 9; ++e)
    {
      s[e * count + k] = matrix(e / 3, e % 3);
      r[e * count + k] = e % 4 == 0 ? 1.0 : 0.0;
    }
  }
  fit_rotations(count, count, s.data(), r.data());
  for (Index k = 0; k < count; ++k)
  {
    Eigen::Matrix3d matrix, rotation;
    for (int e = 0; e < 9; ++e)
    {
      matrix(e / 3, e % 3) = s[e * count + k];
      rotation(e / 3, e % 3) = r[e * count + k];
    }
    expect_best(matrix, rotation);
  }
}

TEST(RotationFit, StretchedRotationsGiveTheRotation)
{
  test::Random random(5);
  for (int i = 0; i < 10000; ++i)
  {
    const Eigen::Matrix3d q = random_rotation(random);
    const Eigen::Matrix3d a = random_rotation(random);
    const Eigen::Matrix3d stretch = a *
      Vec3(random.uniform(0.1, 2), random.uniform(0.1, 2), random.uniform(0.1, 2)).asDiagonal() *
      a.transpose();
    Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
    fit_rotation(stretch * q.transpose(), r);
    ASSERT_LT((r - q).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(RotationFit, HalfTurnsAreFoundFromRest)
{
  for (const Vec3& axis : { Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 2, 3) })
  {
    const Eigen::Matrix3d q = Eigen::AngleAxisd(EIGEN_PI, axis.normalized()).toRotationMatrix();
    Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
    fit_rotation(Vec3(1, 2, 3).asDiagonal() * q.transpose(), r);
    EXPECT_LT((r - q).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(RotationFit, ReflectionsGiveTheBestRotation)
{
  test::Random random(7);
  for (int i = 0; i < 1000; ++i)
  {
    Eigen::Matrix3d s = random_rotation(random) * Vec3(3, 2, -1).asDiagonal();
    Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
    fit_rotation(s, r);
    expect_best(s, r);
    // The determinant is negative. If the two smallest singular values are equal, the optimal
    // rotations form a one-parameter family. If all three are equal, they form a two-parameter
    // family.
    s = random_rotation(random) * Vec3(3, 1, -1).asDiagonal();
    fit_rotation(s, r);
    expect_best(s, r);
    fit_rotation(-random_rotation(random), r);
    ASSERT_NEAR(r.determinant(), 1.0, 1e-13);
  }
}

TEST(RotationFit, NothingToGoByKeepsThePreviousRotation)
{
  test::Random random(9);
  const Eigen::Matrix3d before = random_rotation(random);
  Eigen::Matrix3d r = before;
  fit_rotation(Eigen::Matrix3d::Zero(), r);
  EXPECT_EQ(r, before);
  Eigen::Matrix3d broken = Eigen::Matrix3d::Identity();
  broken(1, 2) = std::nan("");
  fit_rotation(broken, r);
  EXPECT_EQ(r, before);
}

TEST(RotationFit, RankOneTakesTheNearestOfTheBest)
{
  test::Random random(11);
  for (int i = 0; i < 1000; ++i)
  {
    const Eigen::Matrix3d before = random_rotation(random);
    const Vec3 rest = random.in_box(-Vec3::Ones(), Vec3::Ones());
    // The previous rotation is kept if it is optimal.
    Eigen::Matrix3d r = before;
    fit_rotation(rest * (before * rest).transpose(), r);
    ASSERT_LT((r - before).cwiseAbs().maxCoeff(), 1e-12);
    // If the previous rotation is not optimal, the result is the optimal rotation nearest to it.
    // This is the previous rotation, followed by the smallest rotation from the direction of
    // `before * rest` to that of `posed`.
    const Vec3 posed = random.in_box(-Vec3::Ones(), Vec3::Ones());
    fit_rotation(rest * posed.transpose(), r);
    expect_best(rest * posed.transpose(), r);
    const Eigen::Quaterniond arc = Eigen::Quaterniond::FromTwoVectors(before * rest, posed);
    ASSERT_LT((r - arc * before).cwiseAbs().maxCoeff(), 1e-9);
  }
}

// Some counts are multiples of the number of SIMD lanes, others are not. Every third matrix has
// rank one, so that its result depends on the previous rotation.
TEST(RotationFit, BatchesAndSinglesAgreeToTheBit)
{
  test::Random random(13);
  for (const Index count : { 2, 7, 8, 9, 29, 32, 33, 41, 70 })
  {
    const Index stride = count + 2;
    std::vector<double> s(9 * stride), r(9 * stride, 0.0), before(9 * stride);
    for (Index k = 0; k < count; ++k)
    {
      const Vec3 a = random.in_box(-Vec3::Ones(), Vec3::Ones());
      const Eigen::Matrix3d matrix =
        k % 3 == 2 ? Eigen::Matrix3d(a * a.reverse().transpose()) : random_square_matrix(random);
      const Eigen::Matrix3d previous = random_rotation(random);
      for (int e = 0; e < 9; ++e)
      {
        s[e * stride + k] = matrix(e / 3, e % 3);
        before[e * stride + k] = previous(e / 3, e % 3);
      }
    }
    r = before;
    fit_rotations(count, stride, s.data(), r.data());
    for (Index k = 0; k < count; ++k)
    {
      Eigen::Matrix3d matrix, single;
      for (int e = 0; e < 9; ++e)
      {
        matrix(e / 3, e % 3) = s[e * stride + k];
        single(e / 3, e % 3) = before[e * stride + k];
      }
      fit_rotation(matrix, single);
      for (int e = 0; e < 9; ++e)
      {
        EXPECT_EQ(single(e / 3, e % 3), r[e * stride + k]) << k << " of " << count;
      }
    }
    for (int e = 0; e < 9; ++e) // the padding after each array of matrix entries is unchanged
    {
      for (Index k = count; k < stride; ++k)
      {
        EXPECT_EQ(r[e * stride + k], 0.0);
      }
    }
  }
}

TEST(RotationFit, TurnsAreRotationsLessOneInAnyPlanes)
{
  test::Random random(17);
  constexpr Index count = 29;
  std::vector<double> s(9 * count), r(9 * count, 0.0), transposed(9 * count),
    deltas(9 * count, -1.0);
  std::vector<float> single(9 * count), single_deltas(9 * count, 0.0F);
  for (Index k = 0; k < count; ++k)
  {
    const Eigen::Matrix3d matrix = random_rotation(random) *
      Vec3(1.0, random.uniform(0.2, 1.0), random.uniform(0.1, 1.0)).asDiagonal();
    for (int e = 0; e < 9; ++e)
    {
      s[e * count + k] = matrix(e / 3, e % 3);
      transposed[(3 * (e % 3) + e / 3) * count + k] = matrix(e / 3, e % 3);
      single[e * count + k] = static_cast<float>(matrix(e / 3, e % 3));
    }
  }
  fit_rotations(count, count, s.data(), r.data());
  fit_rotation_deltas(count, MatrixPlanes<const double>{ transposed.data(), count, 3 * count },
    MatrixPlanes<double>{ deltas.data(), 3 * count, count });
  fit_rotation_deltas(count, MatrixPlanes<const float>{ single.data(), 3 * count, count },
    MatrixPlanes<float>{ single_deltas.data(), 3 * count, count });
  for (Index k = 0; k < count; ++k)
  {
    for (int e = 0; e < 9; ++e)
    {
      const double rotation = r[e * count + k] - (e % 4 == 0 ? 1.0 : 0.0);
      EXPECT_NEAR(deltas[e * count + k], rotation, 1e-15);
      EXPECT_NEAR(single_deltas[e * count + k], rotation, 2e-5);
    }
  }
}

TEST(RotationFit, SinglePrecisionLosesNextToNothing)
{
  test::Random random(19);
  constexpr Index count = 20000;
  std::vector<float> s(9 * count), deltas(9 * count, 0.0F);
  for (Index k = 0; k < count; ++k)
  {
    const Eigen::Matrix3d matrix = random_square_matrix(random).normalized();
    for (int e = 0; e < 9; ++e)
    {
      s[e * count + k] = static_cast<float>(matrix(e / 3, e % 3));
    }
  }
  fit_rotation_deltas(count, MatrixPlanes<const float>{ s.data(), 3 * count, count },
    MatrixPlanes<float>{ deltas.data(), 3 * count, count });
  for (Index k = 0; k < count; ++k)
  {
    Eigen::Matrix3d matrix, rotation, best = Eigen::Matrix3d::Identity();
    for (int e = 0; e < 9; ++e)
    {
      matrix(e / 3, e % 3) = s[e * count + k];
      rotation(e / 3, e % 3) = deltas[e * count + k] + (e % 4 == 0 ? 1.0 : 0.0);
    }
    fit_rotation(matrix, best);
    ASSERT_LT((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm(), 2e-6);
    ASSERT_NEAR((rotation * matrix).trace(), (best * matrix).trace(), 2e-6);
  }
}
