#include "io/expression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace bindpose::test
{

namespace
{
double value_of(const std::string& text, double t = 0.25)
{
  ExpressionParser parser;
  double value = -1e9;
  const Status status = parser.evaluate(text, t, value);
  EXPECT_TRUE(status.ok()) << text << ": " << status.message;
  return value;
}

std::string error_of(const std::string& text)
{
  ExpressionParser parser;
  double value = 7.0;
  const Status status = parser.evaluate(text, 0.25, value);
  EXPECT_EQ(status.code, StatusCode::invalid_input) << text;
  EXPECT_EQ(value, 7.0) << text;
  return status.message;
}
} // namespace

TEST(Expression, HasTheOperatorsOfArithmetic)
{
  EXPECT_EQ(value_of("1 + 2 * 3 - 8 / 4"), 5.0);
  EXPECT_EQ(value_of("-2 ^ 2 + 7 % 4"), -1.0);
  EXPECT_EQ(value_of("2 ^ 3 ^ 2"), 512.0);
  EXPECT_EQ(value_of("1e-3 + .5"), 0.501);
  EXPECT_EQ(value_of("(t < 1 && !(t >= 0.5)) || t == 3"), 1.0);
  EXPECT_EQ(value_of("\t1\n+ 2\r\n"), 3.0);
  EXPECT_EQ(value_of("t > 0.2 ? t != 0.25 ? 1 : 2 : 3"), 2.0);
}

TEST(Expression, HasTheFunctionsOfMath)
{
  EXPECT_DOUBLE_EQ(
    value_of("sin(t) + cos(t) * tan(t)"), std::sin(0.25) + std::cos(0.25) * std::tan(0.25));
  EXPECT_DOUBLE_EQ(
    value_of("asin(t) + acos(t) + atan(t)"), std::asin(0.25) + std::acos(0.25) + std::atan(0.25));
  EXPECT_DOUBLE_EQ(
    value_of("sinh(t) + cosh(t) + tanh(t)"), std::sinh(0.25) + std::cosh(0.25) + std::tanh(0.25));
  EXPECT_DOUBLE_EQ(value_of("asinh(t) + acosh(1 + t) + atanh(t)"),
    std::asinh(0.25) + std::acosh(1.25) + std::atanh(0.25));
  EXPECT_DOUBLE_EQ(value_of("exp(log(3)) + log10(1000)"), std::exp(std::log(3.0)) + 3.0);
  EXPECT_DOUBLE_EQ(value_of("sqrt(16) + abs(-2) + pow(2, 5) + hypot(3, 4)"), 43.0);
  EXPECT_DOUBLE_EQ(value_of("floor(2.5) + ceil(2.5) + round(2.5) + trunc(-2.5)"), 6.0);
  EXPECT_DOUBLE_EQ(value_of("sign(-3) + sign(0) + 2 * sign(t)"), 1.0);
  EXPECT_DOUBLE_EQ(value_of("mod(7, 4) + min(3, 1, 2) + max(3, 1, 2)"), 7.0);
  EXPECT_DOUBLE_EQ(value_of("clamp(0, 5, 1) + clamp(0, -5, 1) + clamp(0, t, 1)"), 1.25);
  EXPECT_DOUBLE_EQ(value_of("if(t > 1, 10, 20) + atan2(0, -1) - pi"), 20.0);
}

TEST(Expression, UsesTheTimeOfEachCall)
{
  ExpressionParser parser;
  double value = 0.0;
  for (const double t : { 0.0, 0.5, -3.0 })
  {
    ASSERT_TRUE(parser.evaluate("2 * t", t, value).ok());
    EXPECT_EQ(value, 2.0 * t);
  }
}

TEST(Expression, NonFiniteResultsAreNaN)
{
  for (const char* text : { "1 / 0", "log(-1)", "sqrt(-1)", "exp(1000)", "0 / 0" })
  {
    EXPECT_TRUE(std::isnan(value_of(text))) << text;
  }
}

TEST(Expression, NamesWhatItCannotEvaluate)
{
  EXPECT_EQ(error_of(" \t"), "the expression is empty");
  EXPECT_THAT(error_of("sin(u)"), ::testing::HasSubstr("\"u\""));
  EXPECT_THAT(error_of("1 +"), ::testing::HasSubstr("scalar expression in t"));
  EXPECT_THAT(error_of("1, 2"), ::testing::HasSubstr("2 values"));
  EXPECT_THAT(error_of("sin(1, 2)"), ::testing::HasSubstr("sin"));
  error_of("t = 3");
  error_of("(((1)");
  error_of("while (true) {}");
  error_of("var x[100000000] := {}; x[0]");
  error_of("'abc' + \"d\"");
  EXPECT_THAT(error_of("1 + \xff"), ::testing::HasSubstr("not UTF-8 (0xff at position 4)"));
  EXPECT_THAT(error_of(std::string("1\0+ 1", 5)), ::testing::HasSubstr("control character"));
  EXPECT_THAT(error_of(std::string(4097, '1')), ::testing::HasSubstr("4097 characters"));
}

/// A recursive parser would exhaust the stack.
TEST(Expression, MayBeNestedDeeply)
{
  const std::size_t depth = 2000;
  EXPECT_EQ(value_of(std::string(depth, '(') + "t" + std::string(depth, ')')), 0.25);
  std::string signs;
  for (std::size_t i = 0; i < depth / 2; ++i)
  {
    signs += "-(";
  }
  EXPECT_EQ(value_of(signs + "t" + std::string(depth / 2, ')')), 0.25);
}

} // namespace bindpose::test
