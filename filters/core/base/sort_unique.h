#ifndef bindpose_base_sort_unique_h
#define bindpose_base_sort_unique_h

#include <algorithm>
#include <vector>

namespace bindpose
{

/// Sort the items and remove duplicates.
template <typename Item>
void sort_unique(std::vector<Item>& items)
{
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

} // namespace bindpose

#endif
