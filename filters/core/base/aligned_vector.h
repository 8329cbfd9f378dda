#ifndef bindpose_base_aligned_vector_h
#define bindpose_base_aligned_vector_h

#include <cstddef>
#include <new>
#include <vector>

namespace bindpose
{

/// Allocates memory that begins at a cache line, so that a load of the widest registers never
/// crosses a cache line.
template <typename T>
struct CacheLineAllocator
{
  using value_type = T;
  static constexpr std::align_val_t line{ 64 };

  CacheLineAllocator() = default;
  template <typename U>
  CacheLineAllocator(const CacheLineAllocator<U>&)
  {
  }
  T* allocate(std::size_t count)
  {
    return static_cast<T*>(::operator new(count * sizeof(T), line));
  }
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, line); }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
  friend bool operator!=(const CacheLineAllocator&, const CacheLineAllocator&) { return false; }
};

template <typename T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

} // namespace bindpose

#endif
