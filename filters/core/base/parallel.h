#ifndef bindpose_base_parallel_h
#define bindpose_base_parallel_h

#include "base/execution.h"
#include "base/mesh.h"

#include <functional>

namespace bindpose
{

/// How many threads run at once where that many are asked for (0: all cores): more threads than
/// cores gain nothing.
int thread_count(int asked);

/// Calls body(begin, end) for consecutive blocks of at most block_size items that cover [0, count),
/// on the context's threads. The blocks are the same for any number of threads, so a body that
/// writes only its own items gives the same bits on 1 or N threads. Reports progress as the share
/// of blocks done and looks at cancel before each block.
/// @return false when cancelled before all blocks ran.
bool parallel_for(ExecutionContext& context, Index count, Index block_size,
  const std::function<void(Index begin, Index end)>& body);

/// Sum of body(begin, end) over the same blocks, added in the order of the blocks: the same bits
/// for any number of threads.
double parallel_sum(ExecutionContext& context, Index count, Index block_size,
  const std::function<double(Index begin, Index end)>& body);

} // namespace bindpose

#endif
