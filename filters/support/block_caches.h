#ifndef block_caches_h
#define block_caches_h

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace bindpose
{

/// The block of a composite input on which a filter works. An input that is not a composite counts
/// as a single block.
struct BlockNumber
{
  std::size_t index = 0;
  std::size_t count = 1;
  bool composite = false; ///< whether the input consists of blocks
};

/// One cache per block of a composite input. The bind of a block therefore stays valid while the
/// filter works on the other blocks. The caches of blocks that no longer exist are deleted.
template <typename Cache>
class BlockCaches
{
public:
  /// @param block  the number of the current block, which selects the cache. The BlockNumber must
  /// outlive this object.
  explicit BlockCaches(const BlockNumber& block) : block_(&block) {}

  /// Return the cache of the current block; it is empty at first.
  Cache& operator*() const
  {
    std::unique_ptr<Cache>& cache = this->current();
    if (!cache)
    {
      cache = std::make_unique<Cache>();
    }
    return *cache;
  }
  Cache* operator->() const { return &**this; }

  ///@{
  /// Replace the cache of the current block by `cache`, or by an empty cache.
  void reset() { this->current() = std::make_unique<Cache>(); }
  void reset(std::unique_ptr<Cache> cache) { this->current() = std::move(cache); }
  ///@}

private:
  std::unique_ptr<Cache>& current() const
  {
    this->caches_.resize(this->block_->count);
    return this->caches_[this->block_->index];
  }

  const BlockNumber* block_;
  mutable std::vector<std::unique_ptr<Cache>> caches_;
};

} // namespace bindpose

#endif
