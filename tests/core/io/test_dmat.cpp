// The matrix format DMAT of libigl: column-major values, as text and as raw doubles.
#include "io/dmat.h"

#include "support/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using testing::HasSubstr;

TEST(Dmat, ColumnsComeFirst)
{
  const test::Folder folder;
  const Weights expected = (Weights(2, 3) << 1, 3, 5, 2, 4, 0.1).finished();
  Weights matrix;
  ASSERT_TRUE(read_dmat(folder.write("m.dmat", "3 2\n1\n2\n3\n4\n5\n0.1\n"), matrix).ok());
  EXPECT_EQ(matrix, expected);
  for (const auto encoding : { DmatEncoding::ascii, DmatEncoding::binary })
  {
    ASSERT_TRUE(write_dmat(folder / "out.dmat", expected, encoding).ok());
    ASSERT_TRUE(read_dmat(folder / "out.dmat", matrix).ok());
    EXPECT_EQ(matrix, expected);
  }
  EXPECT_EQ(folder.read("out.dmat").size(), std::string("0 0\n3 2\n").size() + 6 * sizeof(double));
  ASSERT_TRUE(read_dmat(folder.write("none.dmat", "0 0\n"), matrix).ok());
  EXPECT_EQ(matrix.size(), 0);
}

TEST(Dmat, ErrorsAreNamed)
{
  const test::Folder folder;
  Weights matrix;
  const auto error = [&](const std::string& text)
  { return read_dmat(folder.write("m.dmat", text), matrix).message; };
  EXPECT_THAT(error("hello"), HasSubstr("line 1"));
  EXPECT_THAT(error("2 2\n1\n2\n3\n"), HasSubstr("column 1 has only 1"));
  EXPECT_THAT(error("2 2\n1\n2\nx\n4\n"), HasSubstr("line 4"));
  EXPECT_THAT(error("1000000 1000000\n1\n"), HasSubstr("truncated"));
  EXPECT_THAT(error("0 0\n2 2\n12345678"), HasSubstr("truncated"));
  EXPECT_THAT(error("1099511627775 1099511627775\n1"), HasSubstr("truncated"));
  // These matrices are empty, but a loop over their columns or rows would take hours.
  EXPECT_THAT(error("1099511627775 0\n"), HasSubstr("values is not valid"));
  EXPECT_THAT(error("0 1099511627775\n"), HasSubstr("values is not valid"));
  EXPECT_EQ(matrix.size(), 0);
}
