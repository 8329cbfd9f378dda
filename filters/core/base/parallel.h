#ifndef bindpose_base_parallel_h
#define bindpose_base_parallel_h

#include "base/execution.h"
#include "base/mesh.h"

#include <functional>

namespace bindpose
{

/// Return the number of threads that run concurrently if `asked` threads are requested (0: all
/// cores). It is at most the number of cores, because more threads gain nothing.
int thread_count(int asked);

/// Call body(begin, end) for consecutive blocks of at most block_size items that cover [0, count),
/// on the context's threads. The blocks are the same for any number of threads, so a body that
/// writes only its own items gives the same bits on 1 or N threads. The fraction of finished blocks
/// is reported as progress, and cancel is checked before each block.
/// @return false if canceled before all blocks ran.
bool parallel_for(ExecutionContext& context, Index count, Index block_size,
  const std::function<void(Index begin, Index end)>& body);

/// Return the sum of body(begin, end) over the same blocks. The results are added in the order of
/// the blocks, so that the bits are the same for any number of threads.
double parallel_sum(ExecutionContext& context, Index count, Index block_size,
  const std::function<double(Index begin, Index end)>& body);

} // namespace bindpose

#endif
