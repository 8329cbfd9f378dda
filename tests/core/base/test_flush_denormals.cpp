#include "base/flush_denormals.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <limits>

using namespace bindpose;

namespace
{
/// Return the product of two normal numbers, which is denormal in exact arithmetic.
float denormal_product()
{
  volatile float smallest = std::numeric_limits<float>::min();
  volatile float half = 0.5F;
  return smallest * half;
}

/// Return a large multiple of a denormal number, which is a normal number in exact arithmetic.
float multiple_of_a_denormal()
{
  volatile float denormal = std::numeric_limits<float>::denorm_min();
  volatile float large = 1e10F;
  return denormal * large;
}
} // namespace

TEST(FlushDenormals, DenormalsAreZeroWithinTheScopeOnly)
{
#if !defined(__x86_64__) && !defined(__aarch64__)
  GTEST_SKIP() << "denormal numbers are not flushed on this processor";
#endif
  EXPECT_GT(denormal_product(), 0.0F);
  EXPECT_GT(multiple_of_a_denormal(), 0.0F);
  {
    const FlushDenormals outer;
    EXPECT_EQ(denormal_product(), 0.0F);
    EXPECT_EQ(multiple_of_a_denormal(), 0.0F);
    {
      const FlushDenormals inner;
      EXPECT_EQ(denormal_product(), 0.0F);
    }
    EXPECT_EQ(denormal_product(), 0.0F);
    volatile float one = 1.0F;
    EXPECT_EQ(one * std::numeric_limits<float>::min(), std::numeric_limits<float>::min());
  }
  EXPECT_GT(denormal_product(), 0.0F);
  EXPECT_GT(multiple_of_a_denormal(), 0.0F);
}

TEST(FlushDenormals, ExceptionFlagsOfTheScopeRemain)
{
  std::feclearexcept(FE_ALL_EXCEPT);
  {
    const FlushDenormals flush;
    volatile float zero = 0.0F;
    volatile float infinite = 1.0F / zero;
    EXPECT_GT(infinite, 0.0F);
  }
  EXPECT_NE(std::fetestexcept(FE_DIVBYZERO), 0);
}
