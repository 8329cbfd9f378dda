// Measurements of used and available memory, and error messages about memory limits.
#include "base/memory.h"

#include "support/sanitized.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <vector>

#ifdef __linux__
#include <sys/resource.h>
#include <sys/sysinfo.h>
#include <unistd.h>
#endif

using namespace bindpose;

#ifdef __linux__
TEST(Memory, LiesWithinTheMachines)
{
  struct sysinfo machine = {};
  ASSERT_EQ(::sysinfo(&machine), 0);
  const double all = static_cast<double>(machine.totalram) * machine.mem_unit;
  EXPECT_GT(resident_memory(), mebibyte);
  EXPECT_LT(resident_memory(), all);
  EXPECT_GT(available_memory(), 0.0);
  EXPECT_LT(available_memory(), all);
}

TEST(Memory, WhatIsTakenIsHeld)
{
  const double before = resident_memory();
  {
    const std::vector<char> taken(64 << 20, 1);
    EXPECT_NEAR(resident_memory() - before, 64 * mebibyte, 8 * mebibyte);
    EXPECT_EQ(taken.back(), 1);
  }
  if (!test::sanitized) // sanitizers delay the release of freed memory
  {
    EXPECT_NEAR(resident_memory() - before, 0.0, 8 * mebibyte);
  }
  EXPECT_GE(peak_memory() - before, 56 * mebibyte);
}

TEST(Memory, TheLimitOnAddressSpaceCounts)
{
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  double pages = 0.0;
  std::ifstream("/proc/self/statm") >> pages;
  rlimit limit = before;
  limit.rlim_cur = static_cast<rlim_t>(pages) * ::sysconf(_SC_PAGESIZE) + (64 << 20);
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &limit), 0);
  const double left = available_memory();
  ::setrlimit(RLIMIT_AS, &before);
  EXPECT_NEAR(left, 64 * mebibyte, mebibyte);
}
#endif

TEST(Memory, RefusesWithBothNumbers)
{
  EXPECT_TRUE(check_memory("a little", 1024.0, 0).ok());
  const Status far = check_memory("all of it", 1e18, 0);
  EXPECT_EQ(far.code, StatusCode::internal_error);
  EXPECT_THAT(far.message,
    testing::StartsWith("all of it would increase the memory of this process to about 95"));
  EXPECT_THAT(far.message, testing::HasSubstr(" are available: use a coarser mesh"));

  const auto resident_mebibytes = static_cast<Index>(resident_memory() / mebibyte);
  EXPECT_TRUE(check_memory("a little", 16 * mebibyte, resident_mebibytes + 128).ok());
  const Status over = check_memory("too much", 256 * mebibyte, resident_mebibytes + 128);
  EXPECT_EQ(over.code, StatusCode::internal_error);
  EXPECT_THAT(over.message,
    testing::HasSubstr(
      "the limit is " + std::to_string(resident_mebibytes + 128) + " MiB: use a coarser mesh or "));
  EXPECT_LE(remaining_memory(resident_mebibytes + 128), 129 * mebibyte);
  EXPECT_EQ(remaining_memory(1), 0.0);
}
