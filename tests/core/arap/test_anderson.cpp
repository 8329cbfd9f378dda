// Anderson acceleration of a linear fixed-point iteration with a known solution.
#include "arap/anderson.h"

#include "support/meshes.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

using namespace bindpose;

namespace
{
/// The map x <- A x + b, where A has the spectral radius 0.98. An iterate also contains the two
/// dependent values C x.
struct Problem
{
  Eigen::Matrix4d a = Eigen::Vector4d(0.98, 0.9, -0.5, 0.3).asDiagonal();
  Eigen::Vector4d b{ 1, -2, 3, 0.5 };
  Eigen::Matrix<double, 2, 4> c;

  Problem()
  {
    test::Random random(4);
    Eigen::Matrix4d turn;
    for (double& entry : turn.reshaped())
    {
      entry = random.uniform(-1, 1);
    }
    this->a = turn * this->a * turn.inverse();
    this->c = turn.topRows<2>();
  }
  Eigen::Vector4d fixed_point() const
  {
    return (Eigen::Matrix4d::Identity() - this->a).inverse() * this->b;
  }
  using Iterate = Eigen::Matrix<double, 6, 1>;
  Iterate map(const Iterate& x) const
  {
    Iterate g;
    g.head<4>() = this->a * x.head<4>() + this->b;
    g.tail<2>() = this->c * g.head<4>();
    return g;
  }
};

double dot4(const double* a, const double* b)
{
  return packed_dot(4, a, b);
}
} // namespace

TEST(Anderson, FindsALinearFixedPointInAboutAsManyStepsAsItHasUnknowns)
{
  const Problem problem;
  Anderson<double> anderson(4, 4, 2, dot4);
  Problem::Iterate x = Problem::Iterate::Zero(), g;
  for (int step = 0; step < 8; ++step)
  {
    g = problem.map(x);
    if (!anderson.next(g.data(), x.data()))
    {
      x = g;
    }
    // The dependent values must still equal C x.
    EXPECT_LT((x.tail<2>() - problem.c * x.head<4>()).norm(), 1e-9 * (1.0 + x.norm()));
  }
  const Eigen::Vector4d goal = problem.fixed_point();
  EXPECT_LT((x.head<4>() - goal).norm(), 1e-6 * goal.norm());
  Problem::Iterate plain = Problem::Iterate::Zero();
  for (int step = 0; step < 8; ++step)
  {
    plain = problem.map(plain);
  }
  EXPECT_GT((plain.head<4>() - goal).norm(), 0.1 * goal.norm());
}

TEST(Anderson, WithoutAPastOrAWindowItLeavesTheIterateAlone)
{
  const Problem problem;
  const Problem::Iterate start = Problem::Iterate::Constant(3.0);
  for (const Index window : { 0, 3 })
  {
    Anderson<double> anderson(window, 4, 2, dot4);
    Problem::Iterate x = start;
    const Problem::Iterate g = problem.map(x);
    EXPECT_FALSE(anderson.next(g.data(), x.data()));
    EXPECT_EQ(x, start);
    x = g;
    const Problem::Iterate next = problem.map(x);
    EXPECT_EQ(anderson.next(next.data(), x.data()), window > 0);
    anderson.clear_history();
    x = start;
    EXPECT_FALSE(anderson.next(g.data(), x.data()));
    EXPECT_EQ(x, start);
  }
}

TEST(Anderson, AnIterateThatStandsStillStaysFinite)
{
  Anderson<double> anderson(5, 4, 2, dot4);
  Problem::Iterate x = Problem::Iterate::Constant(1.0);
  for (int step = 0; step < 20; ++step)
  {
    const Problem::Iterate g = x; // x is already the fixed point
    anderson.next(g.data(), x.data());
    ASSERT_EQ(x, g);
  }
}

TEST(Anderson, PackedDotIsTheSumOfProducts)
{
  std::vector<double> a, b;
  std::vector<float> single_a, single_b;
  double sum = 0.0;
  for (Index i = 0; i < 61; ++i)
  {
    EXPECT_EQ(packed_dot(i, a.data(), b.data()), sum) << i;
    EXPECT_EQ(packed_dot(i, single_a.data(), single_b.data()), sum) << i;
    a.push_back(static_cast<double>(i % 7) - 3.0);
    b.push_back(static_cast<double>(i % 5) + 0.5);
    single_a.push_back(static_cast<float>(a.back()));
    single_b.push_back(static_cast<float>(b.back()));
    sum += a.back() * b.back(); // exact, because the products are small multiples of 1/2
  }
}
