#ifndef bindpose_base_parallel_h
#define bindpose_base_parallel_h

// Parallel loops and sums whose results do not depend on the number of threads.

#include "base/execution.h"
#include "base/mesh_types.h"

#include <functional>

namespace bindpose
{

/// Return the number of threads that run concurrently if `requested` threads are requested (0: all
/// cores). It is at most the number of cores, because more threads would save no time.
int thread_count(int requested);

/// Call body(begin, end) for consecutive blocks of at most block_size items that cover [0, count),
/// on the context's threads. The blocks are the same for any number of threads. Therefore results
/// are bit-identical if body(begin, end) writes only to items begin … end - 1. The fraction of
/// finished blocks is reported as progress, and a cancel request is checked before each block.
/// @return false if canceled before all blocks ran.
bool parallel_for(ExecutionContext& context, Index count, Index block_size,
  const std::function<void(Index begin, Index end)>& body);

/// Return the sum of body(begin, end) over the blocks of parallel_for(). The results are added in
/// the order of the blocks, so that the bits are the same for any number of threads.
double parallel_sum(ExecutionContext& context, Index count, Index block_size,
  const std::function<double(Index begin, Index end)>& body);

} // namespace bindpose

#endif
