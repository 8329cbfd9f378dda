// Parallel loops and sums: each item is processed once, and the results have the same bits for any
// number of threads.
#include "base/parallel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace bindpose;

TEST(Parallel, EveryItemOnceWhateverTheThreads)
{
  for (const int threads : { 0, 1, 2, 5 })
  {
    ExecutionContext context;
    context.set_threads(threads);
    std::vector<int> seen(1003, 0);
    EXPECT_TRUE(parallel_for(context, 1003, 17,
      [&](Index begin, Index end)
      {
        for (Index i = begin; i < end; ++i)
        {
          seen[i] += 1;
        }
      }));
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 1003) << threads;
  }
}

TEST(Parallel, SumsHaveTheSameBitsWhateverTheThreads)
{
  const auto partial = [](Index begin, Index end)
  {
    double sum = 0.0;
    for (Index i = begin; i < end; ++i)
    {
      sum += std::sin(static_cast<double>(i)) * 1e10 / static_cast<double>(1 + i);
    }
    return sum;
  };
  ExecutionContext one;
  one.set_threads(1);
  const double expected = parallel_sum(one, 100000, 64, partial);
  for (const int threads : { 0, 2, 7 })
  {
    ExecutionContext many;
    many.set_threads(threads);
    EXPECT_EQ(parallel_sum(many, 100000, 64, partial), expected);
  }
}

TEST(Parallel, CancelStopsBetweenBlocks)
{
  for (const int threads : { 1, 2 })
  {
    ExecutionContext context;
    context.set_threads(threads);
    std::atomic<int> blocks{ 0 };
    EXPECT_FALSE(parallel_for(context, 1000, 1,
      [&](Index, Index)
      {
        if (++blocks == 10)
        {
          context.request_cancel();
        }
      }));
    EXPECT_LT(blocks.load(), 20);
  }
}

TEST(Parallel, NothingToDoIsDone)
{
  ExecutionContext context;
  EXPECT_TRUE(parallel_for(context, 0, 8, [](Index, Index) { FAIL(); }));
  EXPECT_EQ(parallel_sum(context, 0, 8, [](Index, Index) { return 1.0; }), 0.0);
}
