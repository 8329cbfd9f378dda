#ifndef bindpose_geometry_median_split_h
#define bindpose_geometry_median_split_h

#include <algorithm>
#include <iterator>
#include <utility>

namespace bindpose
{

/// Reorder the elements from `begin` to `end` so that no element before `middle` has a larger key
/// than an element at or after `middle`. Used to build trees that divide their elements at the
/// median. Cost: linear on average.
/// @param key  returns for an element a pair: its coordinate along the axis of the division and its
/// id. Elements with equal coordinates are ordered by id, so that the two sets of elements do not
/// depend on the initial order.
template <typename Iterator, typename Key>
void split_at(Iterator begin, Iterator middle, Iterator end, const Key& key)
{
  using Element = typename std::iterator_traits<Iterator>::value_type;
  std::nth_element(begin, middle, end,
    [&key](const Element& a, const Element& b)
    {
      const auto [x, first_id] = key(a);
      const auto [y, second_id] = key(b);
      return x != y ? x < y : first_id < second_id;
    });
}

} // namespace bindpose

#endif
