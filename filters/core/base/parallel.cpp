// Parallel loops with TBB whose results do not depend on the number of threads.
//
// There is one TBB task per block. TBB chooses the thread that runs a block. The blocks, and the
// order in which partial sums are added, are fixed.
#include "base/parallel.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <numeric>

namespace bindpose
{

int thread_count(int requested)
{
  // TBB would print a warning if more threads than cores were requested.
  const int cores = tbb::info::default_concurrency();
  return requested > 0 ? std::min(requested, cores) : cores;
}

bool parallel_for(ExecutionContext& context, Index count, Index block_size,
  const std::function<void(Index, Index)>& body)
{
  if (count <= 0)
  {
    return !context.canceled();
  }
  const Index block = std::max<Index>(1, block_size);
  const Index blocks = (count + block - 1) / block;
  std::atomic<Index> done{ 0 };
  std::atomic<bool> stopped{ false };
  const auto run = [&](Index b)
  {
    if (stopped.load(std::memory_order_relaxed) || context.canceled())
    {
      stopped.store(true, std::memory_order_relaxed);
      return;
    }
    body(b * block, std::min(count, (b + 1) * block));
    const Index n = done.fetch_add(1, std::memory_order_relaxed) + 1;
    context.progress(static_cast<double>(n) / static_cast<double>(blocks));
  };
  if (context.threads() == 1 || blocks == 1)
  {
    for (Index b = 0; b < blocks && !stopped; ++b)
    {
      run(b);
    }
  }
  else
  {
    // The loop is isolated, so that a thread that waits for the last block does not start other
    // tasks.
    const auto run_blocks = [&]
    {
      tbb::this_task_arena::isolate(
        [&] { tbb::parallel_for(Index(0), blocks, Index(1), run, tbb::simple_partitioner()); });
    };
    const int threads = thread_count(context.threads());
    if (threads == thread_count(0))
    {
      // Use the existing arena. A new arena per call would exist until its worker threads have left
      // the arena. Such arenas would accumulate on a busy machine.
      run_blocks();
    }
    else
    {
      // The arenas are kept between calls, because new arenas per call would accumulate.
      thread_local std::map<int, tbb::task_arena> arenas;
      arenas.try_emplace(threads, threads).first->second.execute(run_blocks);
    }
  }
  return !stopped;
}

double parallel_sum(ExecutionContext& context, Index count, Index block_size,
  const std::function<double(Index, Index)>& body)
{
  const Index block = std::max<Index>(1, block_size);
  std::vector<double> partial(
    static_cast<std::size_t>((std::max<Index>(count, 0) + block - 1) / block), 0.0);
  parallel_for(context, count, block,
    [&](Index begin, Index end)
    { partial[static_cast<std::size_t>(begin / block)] = body(begin, end); });
  return std::accumulate(partial.begin(), partial.end(), 0.0);
}

} // namespace bindpose
