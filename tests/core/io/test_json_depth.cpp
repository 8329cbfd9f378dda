// The limit on the nesting depth of JSON texts.
#include "io/json_depth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
std::string nested(int depth)
{
  return std::string(depth, '[') + std::string(depth, ']');
}
} // namespace

TEST(JsonDepth, CountsListsAndObjects)
{
  EXPECT_TRUE(check_json_depth("").ok());
  EXPECT_TRUE(check_json_depth(nested(maximum_json_depth)).ok());
  EXPECT_FALSE(check_json_depth(nested(maximum_json_depth + 1)).ok());
  EXPECT_FALSE(check_json_depth(std::string(100000, '{')).ok());
  std::string flat;
  for (int k = 0; k < 1000; ++k)
  {
    flat += nested(2) + ",";
  }
  EXPECT_TRUE(check_json_depth(flat).ok());
}

TEST(JsonDepth, IgnoresBracketsInStrings)
{
  EXPECT_TRUE(check_json_depth("\"" + std::string(1000, '[') + "\"").ok());
  EXPECT_TRUE(check_json_depth("\"\\\"" + std::string(1000, '[') + "\"").ok());
  EXPECT_FALSE(check_json_depth("\"\\\\\"" + std::string(1000, '[')).ok());
}

TEST(JsonDepth, NamesTheLine)
{
  const Status status = check_json_depth("{\n\n\"a\": " + nested(1000) + "}");
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_THAT(status.message, HasSubstr("line 3"));
}
