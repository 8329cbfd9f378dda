// Error-free sums and products, double-double arithmetic, exact 2D orientation, and parallel sort.
#include "base/parallel_sort.h"
#include "geometry/exact.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

using namespace bindpose;

TEST(Exact, SumsAndProductsLoseNothing)
{
  double high, low;
  two_sum(1.0, 0x1p-80, high, low);
  EXPECT_EQ(high, 1.0);
  EXPECT_EQ(low, 0x1p-80);
  two_product(1.0 + 0x1p-52, 1.0 - 0x1p-52, high, low); // the exact product is 1 - 2^-104
  EXPECT_EQ(high, 1.0);
  EXPECT_EQ(low, -0x1p-104);
}

TEST(Exact, DoubleDoubleHasTwiceTheDigits)
{
  const DoubleDouble two(2.0);
  const DoubleDouble root = sqrt(two);
  EXPECT_LT(std::abs((root * root - two).value()), 1e-31);
  const DoubleDouble x = DoubleDouble(1.0) + DoubleDouble(1e-25);
  EXPECT_NEAR((x - DoubleDouble(1.0)).value(), 1e-25, 1e-40);
  EXPECT_EQ(sqrt(DoubleDouble(0.0)).value(), 0.0);
}

TEST(Exact, OrientationSeesTheLastBit)
{
  EXPECT_EQ(orientation_2d(0, 0, 1, 0, 0, 1), 1);
  EXPECT_EQ(orientation_2d(0, 0, 0, 1, 1, 0), -1);
  // The coordinates x and y are equal or differ by at most 31 units in the last place. For such
  // points, the determinant in floating point often has the wrong sign (a textbook example). The
  // exact sign is the sign of y - x.
  for (int i = 0; i < 32; ++i)
  {
    for (int j = 0; j < 32; ++j)
    {
      const double x = 0.5 + i * 0x1p-53;
      const double y = 0.5 + j * 0x1p-53;
      EXPECT_EQ(orientation_2d(12, 12, 24, 24, x, y), (y > x) - (y < x)) << i << " " << j;
      EXPECT_EQ(orientation_2d(x, y, 12, 12, 24, 24), (y > x) - (y < x));
      EXPECT_EQ(orientation_2d(24, 24, 12, 12, x, y), (y < x) - (y > x));
    }
  }
}

TEST(ParallelSort, SameAsStableSortForAnyThreads)
{
  test::Random random(11);
  std::vector<std::pair<Index, Index>> items;
  for (Index i = 0; i < 150000; ++i)
  {
    items.emplace_back(random.below(1000), i);
  }
  const auto less = [](const auto& a, const auto& b) { return a.first < b.first; };
  auto expected = items;
  std::stable_sort(expected.begin(), expected.end(), less);
  for (const int threads : { 1, 2, 0 })
  {
    auto sorted = items;
    double last = 0.0;
    ExecutionContext context(
      [&](double fraction, const std::string&)
      {
        EXPECT_GE(fraction, last);
        last = fraction;
      },
      nullptr);
    context.set_threads(threads);
    EXPECT_TRUE(parallel_sort(context, sorted, less));
    EXPECT_EQ(sorted, expected);
  }
  std::vector<std::pair<Index, Index>> nothing;
  ExecutionContext canceled;
  EXPECT_TRUE(parallel_sort(canceled, nothing, less));
  canceled.request_cancel();
  EXPECT_FALSE(parallel_sort(canceled, items, less));
}
