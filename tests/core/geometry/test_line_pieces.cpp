// Subdivision of a line into segments whose lengths follow a given function.
#include "geometry/line_pieces.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

namespace
{
int nearest(double lengths)
{
  return static_cast<int>(std::lround(lengths));
}
} // namespace

TEST(LinePieces, AreEqualWhereTheLengthIs)
{
  const std::vector<double> cuts = line_cuts(
    0.2, 0.8, [](double) { return 0.11; }, nearest); // 0.6 / 0.11 = 5.45 segments, rounded to 5
  ASSERT_EQ(cuts.size(), 4u);
  for (std::size_t i = 0; i < cuts.size(); ++i)
  {
    EXPECT_NEAR(cuts[i], 0.2 + 0.12 * static_cast<double>(i + 1), 1e-12);
  }
}

TEST(LinePieces, AreTwiceAsLongWhereTheLengthIs)
{
  // Expect eight segments of length 1/16, then four of length 1/8.
  const std::vector<double> cuts = line_cuts(
    0.0, 1.0, [](double t) { return t < 0.5 ? 0.0625 : 0.125; }, nearest);
  ASSERT_EQ(cuts.size(), 11u);
  for (std::size_t i = 0; i < cuts.size(); ++i)
  {
    const auto n = static_cast<double>(i + 1);
    EXPECT_NEAR(cuts[i], n <= 8.0 ? n / 16.0 : 0.5 + (n - 8.0) / 8.0, 1e-12);
  }
}

TEST(LinePieces, AreAsManyAsIsWanted)
{
  const auto far = [](double) { return 10.0; };
  EXPECT_TRUE(line_cuts(0.0, 1.0, far, [](double) { return 1; }).empty());
  const std::vector<double> halves = line_cuts(0.0, 1.0, far, [](double) { return 2; });
  ASSERT_EQ(halves.size(), 1u);
  EXPECT_NEAR(halves[0], 0.5, 1e-12);
}
