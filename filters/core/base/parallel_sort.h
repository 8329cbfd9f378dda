#ifndef bindpose_base_parallel_sort_h
#define bindpose_base_parallel_sort_h

#include "base/parallel.h"

#include <algorithm>

namespace bindpose
{

/// Sort on the context's threads: sort blocks, then merge pairs of blocks until one block is left.
/// The sort is stable, so the result is the same for any number of threads. A cancel request is
/// checked before each block and each merge; therefore kernels with many items call this function
/// instead of std::sort.
/// @return false if canceled; the items are then complete, in unspecified order.
template <typename Items, typename Less>
bool parallel_sort(ExecutionContext& context, Items& items, const Less& less)
{
  const Index count = static_cast<Index>(items.size());
  constexpr Index block = Index(1) << 15;
  const auto at = [&](Index i) { return items.begin() + std::min(i, count); };
  {
    const ProgressRange range(context, 0.0, 0.5);
    if (!parallel_for(context, count, block,
          [&](Index begin, Index end) { std::stable_sort(at(begin), at(end), less); }))
    {
      return false;
    }
  }
  double done = 0.5;
  for (Index width = block; width < count; width *= 2)
  {
    const ProgressRange range(context, done, done + 0.5 * (1.0 - done));
    done += 0.5 * (1.0 - done);
    const Index pairs = (count + 2 * width - 1) / (2 * width);
    if (!parallel_for(context, pairs, 1,
          [&](Index pair, Index)
          {
            const Index begin = 2 * pair * width;
            std::inplace_merge(at(begin), at(begin + width), at(begin + 2 * width), less);
          }))
    {
      return false;
    }
  }
  return true;
}

} // namespace bindpose

#endif
