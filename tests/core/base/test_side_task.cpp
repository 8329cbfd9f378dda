// SideTask: work in the background. The work starts after a delay or in finish(), whichever is
// first. Work that is dropped before its start never runs.
#include "base/side_task.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <thread>

using namespace bindpose;

namespace
{
void sleep_for(double seconds)
{
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}
constexpr double unlimited_delay = 1e6; // delay in seconds
} // namespace

TEST(SideTask, BeginsByItselfAfterItsDelay)
{
  ExecutionContext context;
  context.set_threads(2);
  std::atomic<bool> begun{ false };
  SideTask task(context, 0.01, [&](ExecutionContext&) { begun = true; });
  for (int i = 0; i < 1000 && !begun; ++i)
  {
    sleep_for(0.01);
  }
  EXPECT_TRUE(begun || std::thread::hardware_concurrency() == 1);
}

TEST(SideTask, FinishBeginsItAtOnceAndWaitsForItsEnd)
{
  for (const int threads : { 1, 2 })
  {
    ExecutionContext context;
    context.set_threads(threads);
    int runs = 0;
    SideTask task(context, unlimited_delay,
      [&](ExecutionContext&)
      {
        sleep_for(0.05);
        ++runs;
      });
    task.finish();
    EXPECT_EQ(runs, 1);
    task.finish();
    EXPECT_EQ(runs, 1);
  }
}

TEST(SideTask, IsDroppedOnlyBeforeItStarts)
{
  ExecutionContext context;
  context.set_threads(2);
  std::atomic<bool> begun{ false };
  SideTask late(context, 0.05, [&](ExecutionContext&) { begun = true; });
  EXPECT_TRUE(late.drop_unless_started());
  sleep_for(0.2);
  EXPECT_FALSE(begun); // dropped work does not start, even after the delay

  std::atomic<bool> finished{ false };
  SideTask early(context, 0.0,
    [&](ExecutionContext&)
    {
      begun = true;
      sleep_for(0.1);
      finished = true;
    });
  for (int i = 0; i < 1000 && !begun; ++i)
  {
    sleep_for(0.01);
  }
  EXPECT_TRUE(!early.drop_unless_started() || std::thread::hardware_concurrency() == 1);
  early.finish();
  EXPECT_TRUE(finished || std::thread::hardware_concurrency() == 1);
}

TEST(SideTask, WithOneThreadItWaitsForFinish)
{
  ExecutionContext context;
  context.set_threads(1);
  const std::thread::id here = std::this_thread::get_id();
  std::thread::id there;
  SideTask task(context, 0.0, [&](ExecutionContext&) { there = std::this_thread::get_id(); });
  sleep_for(0.05);
  EXPECT_EQ(there, std::thread::id());
  task.finish();
  EXPECT_EQ(there, here);
}

TEST(SideTask, IsCanceledWithItsMakerAndWhenItIsDropped)
{
  for (const bool drop : { false, true })
  {
    ExecutionContext context;
    context.set_threads(2);
    std::atomic<bool> begun{ false };
    std::atomic<bool> canceled{ false };
    {
      SideTask task(context, 0.0,
        [&](ExecutionContext& side)
        {
          begun = true;
          while (!side.canceled())
          {
            sleep_for(0.001);
          }
          canceled = true;
        });
      while (!begun && std::thread::hardware_concurrency() > 1)
      {
        sleep_for(0.001);
      }
      if (!drop)
      {
        context.request_cancel();
        task.finish();
        EXPECT_TRUE(canceled);
      }
    }
    EXPECT_TRUE(canceled || std::thread::hardware_concurrency() == 1);
  }
}

TEST(SideTask, DroppedBeforeItBeginsItNeverRuns)
{
  ExecutionContext context;
  context.set_threads(2);
  bool ran = false;
  {
    SideTask task(context, unlimited_delay, [&](ExecutionContext&) { ran = true; });
  }
  EXPECT_FALSE(ran);
}

TEST(SideTask, FinishThrowsWhatTheWorkThrew)
{
  for (const int threads : { 1, 2 })
  {
    ExecutionContext context;
    context.set_threads(threads);
    SideTask task(context, 0.0, [](ExecutionContext&) { throw std::bad_alloc(); });
    EXPECT_THROW(task.finish(), std::bad_alloc);
  }
}

TEST(SideTask, DroppedNothingIsThrown)
{
  ExecutionContext context;
  context.set_threads(2);
  std::atomic<bool> begun{ false };
  {
    SideTask task(context, 0.0,
      [&](ExecutionContext&)
      {
        begun = true;
        throw std::bad_alloc();
      });
    while (!begun && std::thread::hardware_concurrency() > 1)
    {
      sleep_for(0.001);
    }
  }
  EXPECT_TRUE(begun || std::thread::hardware_concurrency() == 1);
}
