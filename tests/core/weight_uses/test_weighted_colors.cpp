// Colors blended by weights, in linear light or in encoded values. Bounded weights keep colors
// within the range of the handles' colors, and points outside of the gamut are counted.
#include "weight_uses/weighted_colors.h"
#include "weights/bounded_biharmonic_weights.h"
#include "weights/monotone_weights.h"
#include "weights/unconstrained_weights.h"

#include "weights_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

using namespace bindpose;

namespace
{
WeightedColors blend(const Weights& weights, const Colors& colors, bool linear_light, bool clamp,
  Report* report = nullptr)
{
  ExecutionContext context;
  WeightedColors result;
  const Status status = weighted_colors(context, weights, colors, { linear_light, clamp }, result);
  EXPECT_TRUE(status.ok()) << status.message;
  if (report)
  {
    *report = status.report;
  }
  return result;
}

/// A bar with handles at 0, 1/2 and 1. The first handle is white, the other two are black.
struct BlackAndWhiteBar
{
  static constexpr int n = 96;
  test::Bar bar = test::bar(n, { 0.0, 0.5, 1.0 });
  WeightsProblem problem;
  Colors colors = Colors::Zero(3, 3);

  BlackAndWhiteBar()
  {
    ExecutionContext context;
    EXPECT_TRUE(make_weights_problem(
      context, this->bar.domain, this->bar.region_ids, this->bar.handles, {}, this->problem)
                  .ok());
    this->colors.row(0).setOnes();
  }
};
} // namespace

TEST(WeightedColors, UnconstrainedWeightsLeaveTheGamutByANinth)
{
  BlackAndWhiteBar test;
  ExecutionContext context;
  WeightsResult solved;
  ASSERT_TRUE(biharmonic_weights(context, test.problem, {}, solved).ok());
  for (const bool linear_light : { false, true })
  {
    Report report;
    const WeightedColors result = blend(solved.weights, test.colors, linear_light, false, &report);
    const Index at = test.bar.vertex(2.0 / 3.0, test.n);
    const double expected = linear_light ? from_linear_light(-1.0 / 9.0) : -1.0 / 9.0;
    EXPECT_NEAR(result.colors(at, 1), expected, 2e-4);
    EXPECT_NEAR(report.number("largest_gamut_violation", -1), 1.0 / 9.0, 1e-4);
    EXPECT_NEAR(report.number("largest_overshoot", -1), 1.0 / 9.0, 1e-4);
    // Compute from the weights which points are out of gamut. These must be exactly the points in
    // the second half of the bar.
    Index outside = 0;
    for (Index v = 0; v < solved.weights.rows(); ++v)
    {
      const double gray = solved.weights(v, 0);
      const bool is_out = gray < -1e-6 || gray > 1.0 + 1e-6;
      EXPECT_EQ(result.out_of_gamut[static_cast<std::size_t>(v)], is_out);
      outside += is_out;
      const double x = test.bar.domain.points(v, 0);
      EXPECT_EQ(is_out, x > 0.5 + 1e-9 && x < 1.0 - 1e-9) << x;
    }
    EXPECT_EQ(report.number("counts.out_of_gamut", -1), outside);
    const WeightedColors clamped = blend(solved.weights, test.colors, linear_light, true);
    EXPECT_EQ(clamped.colors.minCoeff(), 0.0);
    EXPECT_EQ(clamped.out_of_gamut, result.out_of_gamut);
  }
}

TEST(WeightedColors, BoundedAndMonotoneWeightsStayWithinTheHandlesColors)
{
  BlackAndWhiteBar test;
  test.colors << 0.9, 0.3, 0.1, 0.2, 0.4, 0.1, 0.5, 0.7, 0.1;
  ExecutionContext context;
  WeightsResult results[2];
  ASSERT_TRUE(bounded_biharmonic_weights(context, test.problem, {}, results[0]).ok());
  ASSERT_TRUE(monotone_weights(context, test.problem, {}, results[1]).ok());
  for (const WeightsResult& solved : results)
  {
    Report report;
    const WeightedColors result = blend(solved.weights, test.colors, false, false, &report);
    EXPECT_EQ(report.number("counts.out_of_gamut", -1), 0);
    EXPECT_EQ(report.number("counts.beyond_handles", -1), 0);
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_GE(result.colors.col(k).minCoeff(), test.colors.col(k).minCoeff() - 1e-12);
      EXPECT_LE(result.colors.col(k).maxCoeff(), test.colors.col(k).maxCoeff() + 1e-12);
    }
  }
}

TEST(WeightedColors, AGrayBlendIsTheSumAndAVertexOnAHandleHasItsColor)
{
  test::Random random(3);
  Weights weights(500, 4);
  Colors colors(4, 3);
  for (Index i = 0; i < weights.size(); ++i)
  {
    weights.data()[i] = random.uniform();
  }
  for (Index i = 0; i < colors.size(); ++i)
  {
    colors.data()[i] = random.uniform();
  }
  for (Index v = 0; v < weights.rows(); ++v)
  {
    weights.row(v) /= weights.row(v).sum();
  }
  weights.topRows(4).setIdentity();
  for (const bool linear_light : { false, true })
  {
    const WeightedColors result = blend(weights, colors, linear_light, true);
    EXPECT_LT((result.colors.topRows(4) - colors).cwiseAbs().maxCoeff(), 1e-14);
    for (Index v = 0; v < weights.rows(); ++v)
    {
      for (int k = 0; k < 3; ++k)
      {
        double sum = 0.0;
        for (Index j = 0; j < 4; ++j)
        {
          sum += weights(v, j) * (linear_light ? to_linear_light(colors(j, k)) : colors(j, k));
        }
        EXPECT_NEAR(result.colors(v, k), linear_light ? from_linear_light(sum) : sum, 1e-14);
      }
    }
  }
}

TEST(WeightedColors, HalfBlackHalfWhiteIsHalfTheLight)
{
  const Weights half = Weights::Constant(1, 2, 0.5);
  Colors colors = Colors::Zero(2, 3);
  colors.row(1).setOnes();
  // Half of the light of white is encoded as 188 of 255 (IEC 61966-2-1).
  EXPECT_EQ(std::lround(255.0 * blend(half, colors, true, true).colors(0, 0)), 188);
  EXPECT_EQ(blend(half, colors, false, true).colors(0, 0), 0.5);
}

TEST(WeightedColors, LightAndNumbersAreInverseAndOdd)
{
  for (double x = -1.5; x <= 1.5; x += 0.001)
  {
    // The two branches of the standard's formula have a small jump between them.
    EXPECT_NEAR(from_linear_light(to_linear_light(x)), x, 1e-7);
    EXPECT_EQ(to_linear_light(-x), -to_linear_light(x));
  }
  EXPECT_EQ(to_linear_light(0.0), 0.0);
  EXPECT_EQ(to_linear_light(1.0), 1.0);
  EXPECT_EQ(from_linear_light(1.0), 1.0);
}

TEST(WeightedColors, EqualColorsAreThatColorEverywhere)
{
  BlackAndWhiteBar test;
  ExecutionContext context;
  WeightsResult solved;
  ASSERT_TRUE(biharmonic_weights(context, test.problem, {}, solved).ok());
  test.colors.rowwise() = Eigen::RowVector3d(0.25, 0.5, 0.75);
  Report report;
  const WeightedColors result = blend(solved.weights, test.colors, true, false, &report);
  EXPECT_LT((result.colors.rowwise() - test.colors.row(0)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(report.number("counts.beyond_handles", -1), 0);
}

TEST(WeightedColors, CategoricalColorsDiffer)
{
  const Colors colors = categorical_colors(24);
  std::set<std::array<double, 3>> seen;
  for (Index j = 0; j < colors.rows(); ++j)
  {
    seen.insert({ colors(j, 0), colors(j, 1), colors(j, 2) });
  }
  EXPECT_EQ(seen.size(), 24u);
  EXPECT_GE(colors.minCoeff(), 0.0);
  EXPECT_LE(colors.maxCoeff(), 1.0);
}

TEST(WeightedColors, WhatCannotBeUsedIsOneSentence)
{
  ExecutionContext context;
  WeightedColors result;
  const auto message = [&](const Weights& weights, const Colors& colors)
  {
    const Status status = weighted_colors(context, weights, colors, {}, result);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    return status.message;
  };
  const Weights weights = Weights::Constant(3, 2, 0.5);
  EXPECT_NE(message(weights, Colors::Zero(3, 3)).find("2 columns, but there are 3 colors"),
    std::string::npos);
  Colors colors = Colors::Zero(2, 3);
  colors(1, 2) = 1.5;
  EXPECT_NE(message(weights, colors).find("handle 1"), std::string::npos);
  colors(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message(weights, colors).find("handle 1"), std::string::npos);
  Weights bad = weights;
  bad(2, 0) = std::numeric_limits<double>::infinity();
  EXPECT_NE(message(bad, Colors::Zero(2, 3)).find("vertex 2"), std::string::npos);
  context.request_cancel();
  const Colors black = Colors::Zero(2, 3);
  EXPECT_EQ(weighted_colors(context, weights, black, {}, result).code, StatusCode::canceled);
}
