#include "base/range_check.h"

#include <gtest/gtest.h>

#include <limits>

using namespace bindpose;

TEST(RangeCheck, NamesTheOptionAndTheValue)
{
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(check_positive("a", 1e-300).ok());
  EXPECT_EQ(check_positive("a", 0.0).message, "a must be positive, not 0");
  EXPECT_EQ(check_positive("a", -0.5).message, "a must be positive, not -0.5");
  EXPECT_EQ(check_positive("a", inf).message, "a must be positive, not inf");
  EXPECT_EQ(check_positive("a", nan).message, "a must be positive, not nan");
  EXPECT_TRUE(check_not_negative("b", 0.0).ok());
  EXPECT_EQ(check_not_negative("b", -2.0).message, "b must be 0 or more, not -2");
  EXPECT_EQ(check_not_negative("b", inf).message, "b must be 0 or more, not inf");
}
