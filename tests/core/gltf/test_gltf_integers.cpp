// Offsets, lengths and counts in the JSON text of glTF files.
#include "gltf/gltf_integers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;

TEST(GltfIntegers, InRangeAreAccepted)
{
  for (const char* text :
    { R"({"accessors": [{"count": 4294967295, "byteOffset": 0, "sparse": {"count": 3.0}}]})",
      R"({"extras": {"count": -5, "a": [{"byteOffset": 1e99}]}, "bufferViews": []})",
      R"({"nodes": [{"extensions": {"OTHER": {"b": [], "count": 0.5}}}], "other": -1})",
      R"({"count": "many", "byteLength": null, "byteStride": {"min": -1}})",
      R"({"accessors": [{"count": 1)", // cut: other functions report it
      "no JSON text" })
  {
    const Status status = check_gltf_integers(text);
    EXPECT_TRUE(status.ok()) << text << ": " << status.message;
  }
}

TEST(GltfIntegers, OutOfRangeAreNamed)
{
  const auto error = [](const std::string& text)
  {
    const Status status = check_gltf_integers(text);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    return status.message;
  };
  EXPECT_EQ(error(R"({"accessors": [{"byteOffset": -4}]})"),
    "the property byteOffset is -4; expected an integer from 0 to 4294967295");
  EXPECT_THAT(error(R"({"buffers": [{"byteLength": 4294967296}]})"),
    testing::HasSubstr("byteLength is 4294967296"));
  EXPECT_THAT(
    error(R"({"bufferViews": [{"byteStride": 0.5}]})"), testing::HasSubstr("byteStride is 0.5"));
  EXPECT_THAT(
    error(R"({"accessors": [{"count": 99999999999999999999}]})"), testing::HasSubstr("count is"));
  // Values after extras are checked again.
  EXPECT_THAT(error(R"({"extras": {"a": [{}, {"count": -1}]}, "accessors": [{"count": -2}]})"),
    testing::HasSubstr("count is -2"));
}
