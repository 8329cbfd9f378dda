// AtomicFile writes a file completely or not at all.
#include "io/atomic_file.h"
#include "io/text_scanner.h"

#include "support/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using testing::HasSubstr;

TEST(AtomicFile, AppearsOnCommit)
{
  const test::Folder folder;
  {
    AtomicFile file;
    ASSERT_TRUE(file.open(folder / "out", false).ok());
    ASSERT_TRUE(write_file(file.temporary(), "new").ok());
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    ASSERT_TRUE(file.commit().ok());
  }
  EXPECT_EQ(folder.read("out"), "new");
  EXPECT_EQ(folder.number_of_files(), 1u);
}

TEST(AtomicFile, IsTheSameWhenItWaitsForTheDisk)
{
  const test::Folder folder;
  AtomicFile file;
  ASSERT_TRUE(file.open(folder / "out", false).ok());
  ASSERT_TRUE(write_file(file.temporary(), "new").ok());
  ASSERT_TRUE(file.commit_synced().ok());
  EXPECT_EQ(folder.read("out"), "new");
  EXPECT_EQ(folder.number_of_files(), 1u);
  EXPECT_FALSE(file.commit_synced().ok()); // fails, because no file is open
  ASSERT_TRUE(file.open(folder / "unnamed", false).ok());
  ASSERT_TRUE(write_file(file.temporary(), "named").ok());
  ASSERT_TRUE(file.commit_synced_as(folder / "named").ok());
  EXPECT_EQ(folder.read("named"), "named");
  EXPECT_EQ(folder.number_of_files(), 2u);
  // The temporary file disappears, as if another process had removed it.
  ASSERT_TRUE(file.open(folder / "out", true).ok());
  std::filesystem::remove(file.temporary());
  EXPECT_THAT(file.commit_synced().message, HasSubstr("cannot write"));
  EXPECT_EQ(folder.read("out"), "new");
}

TEST(AtomicFile, LeavesNothingWithoutCommit)
{
  const test::Folder folder;
  {
    AtomicFile file;
    ASSERT_TRUE(file.open(folder / "out", false).ok());
    EXPECT_EQ(folder.number_of_files(), 1u);
  }
  EXPECT_EQ(folder.number_of_files(), 0u);
  AtomicFile first;
  AtomicFile second;
  ASSERT_TRUE(first.open(folder / "a", false).ok());
  ASSERT_TRUE(second.open(folder / "b", false).ok());
  AtomicFile::discard_all();
  EXPECT_EQ(folder.number_of_files(), 0u);
}

TEST(AtomicFile, KeepsTheOldFileUntilTheNewOneIsWhole)
{
  const test::Folder folder;
  folder.write("out", "old");
  AtomicFile file;
  EXPECT_THAT(file.open(folder / "out", false).message, HasSubstr("the file exists"));
  EXPECT_EQ(folder.number_of_files(), 1u);
  ASSERT_TRUE(file.open(folder / "out", true).ok());
  ASSERT_TRUE(write_file(file.temporary(), "new").ok());
  EXPECT_EQ(folder.read("out"), "old");
  ASSERT_TRUE(file.commit().ok());
  EXPECT_EQ(folder.read("out"), "new");
}

TEST(AtomicFile, UnwritablePlacesAreOneSentence)
{
  const test::Folder folder;
  folder.write("file", "");
  EXPECT_THAT(AtomicFile::check("", false).message, HasSubstr("name of the output file is empty"));
  EXPECT_THAT(AtomicFile::check(folder.path(), true).message, HasSubstr("directory"));
  EXPECT_THAT(AtomicFile::check(folder / "no/out", true).message, HasSubstr("No such file"));
  EXPECT_THAT(AtomicFile::check(folder / "file/out", true).message, HasSubstr("Not a directory"));
  EXPECT_THAT(AtomicFile::check("/dev/null", true).message, HasSubstr("not a regular file"));
  EXPECT_TRUE(AtomicFile::check(folder / "fresh", false).ok());
  EXPECT_EQ(folder.number_of_files(), 1u);
}

TEST(AtomicFile, AFileMadeMeanwhileIsKept)
{
  const test::Folder folder;
  AtomicFile file;
  ASSERT_TRUE(file.open(folder / "out", false).ok());
  folder.write("out", "of another");
  EXPECT_THAT(file.commit().message, HasSubstr("the file exists"));
  EXPECT_EQ(folder.read("out"), "of another");
  EXPECT_EQ(folder.number_of_files(), 1u);
}
