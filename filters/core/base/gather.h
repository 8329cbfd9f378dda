#ifndef bindpose_base_gather_h
#define bindpose_base_gather_h

#include "base/parallel.h"

#include <vector>

namespace bindpose
{

/// Call body(i, list) for all i in [0, count) on the context's threads. Concatenate the items that
/// the bodies append to their lists, in the order of i, so that the result is the same for any
/// number of threads. A cancel request is checked every 16 items.
/// @return false if canceled; `all` is then incomplete.
template <typename Item, typename Body>
bool gather(ExecutionContext& context, Index count, std::vector<Item>& all, const Body& body,
  Index block = 512)
{
  std::vector<std::vector<Item>> block_items(static_cast<std::size_t>((count + block - 1) / block));
  const bool completed = parallel_for(context, count, block,
    [&](Index begin, Index end)
    {
      auto& list = block_items[static_cast<std::size_t>(begin / block)];
      for (Index i = begin; i < end; ++i)
      {
        if (i % 16 == 0 && context.canceled())
        {
          return;
        }
        body(i, list);
      }
    });
  all.clear();
  for (auto& list : block_items)
  {
    all.insert(all.end(), list.begin(), list.end());
    std::vector<Item>().swap(list);
  }
  return completed && !context.canceled();
}

} // namespace bindpose

#endif
