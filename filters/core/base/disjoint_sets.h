#ifndef bindpose_base_disjoint_sets_h
#define bindpose_base_disjoint_sets_h

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace bindpose
{

/// Union-find with path halving over 0 … count - 1. The root of a set is its smallest member.
/// Therefore the result does not depend on the order of unions.
template <typename Id>
class DisjointSets
{
public:
  DisjointSets() = default;
  explicit DisjointSets(std::size_t count) { this->reset(count); }

  /// Put each id into a separate set.
  void reset(std::size_t count)
  {
    this->parent_.resize(count);
    std::iota(this->parent_.begin(), this->parent_.end(), Id(0));
  }
  Id find(Id i)
  {
    while (this->parent_[i] != i)
    {
      this->parent_[i] = this->parent_[this->parent_[i]];
      i = this->parent_[i];
    }
    return i;
  }
  void unite(Id i, Id j)
  {
    i = this->find(i);
    j = this->find(j);
    (i < j ? this->parent_[j] : this->parent_[i]) = std::min(i, j);
  }

private:
  std::vector<Id> parent_;
};

} // namespace bindpose

#endif
