// The VDB writer compiled without OpenVDB reports that it is not available.
#include "io/vdb.h"

#include "support/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using testing::HasSubstr;

TEST(VdbAbsent, NamesThePackage)
{
  const test::Folder folder;
  SampleGrid grid;
  grid.extent = { 0, 1, 0, 1, 0, 1 };
  const std::vector<double> values(8, 1.0);
  ExecutionContext context;
  const Status status = write_vdb(context, folder / "field.vdb", grid, values.data(), VdbOptions());
  EXPECT_EQ(status.code, StatusCode::unavailable);
  EXPECT_THAT(status.message, HasSubstr("libopenvdb-dev"));
  EXPECT_EQ(check_vdb_available().message, status.message);
  EXPECT_EQ(folder.number_of_files(), 0u);
}
