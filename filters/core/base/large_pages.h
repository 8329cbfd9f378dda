#ifndef bindpose_base_large_pages_h
#define bindpose_base_large_pages_h

#include <cstddef>
#include <cstdint>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace bindpose
{

/// Request pages of 2 MiB for memory that has not been touched yet. If the system provides such
/// pages, the first write to a gigabyte takes 1/4 of the time, and freeing the gigabyte takes 1/30
/// of the time (measured). Random access has fewer misses in the TLB (address translation cache).
/// The request is only a hint: contents, addresses and results never depend on it.
inline void request_large_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t page = 1 << 21;
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (address + page - 1) / page * page;
  const std::uintptr_t last = (address + bytes) / page * page;
  if (first < last)
  {
    madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
  }
#endif
}

/// Reserve memory in large pages for a total of `count` items. Existing items are copied to the new
/// memory. Appending items then needs no further allocation. Random access to some megabytes then
/// has few misses in the TLB (address translation cache), so look-ups are 1.3 to 2 times as fast
/// (measured).
template <typename Item>
void reserve_in_large_pages(std::vector<Item>& items, std::size_t count)
{
  std::vector<Item> enlarged;
  enlarged.reserve(count);
  request_large_pages(enlarged.data(), count * sizeof(Item));
  enlarged.assign(items.begin(), items.end());
  items.swap(enlarged);
}

} // namespace bindpose

#endif
