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
struct LineAllocator
{
  using value_type = T;
  static constexpr std::align_val_t line{ 64 };

  LineAllocator() = default;
  template <typename U>
  LineAllocator(const LineAllocator<U>&)
  {
  }
  T* allocate(std::size_t count)
  {
    return static_cast<T*>(::operator new(count * sizeof(T), line));
  }
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, line); }
  friend bool operator==(const LineAllocator&, const LineAllocator&) { return true; }
  friend bool operator!=(const LineAllocator&, const LineAllocator&) { return false; }
};

template <typename T>
using AlignedVector = std::vector<T, LineAllocator<T>>;

} // namespace bindpose

#endif
