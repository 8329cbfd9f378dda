#ifndef bindpose_base_most_frequent_h
#define bindpose_base_most_frequent_h

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace bindpose
{

/// Return the most frequent value. If several values are equally frequent, return the lowest one.
/// The range is sorted and must not be empty.
template <typename Iterator>
typename std::iterator_traits<Iterator>::value_type most_frequent(Iterator begin, Iterator end)
{
  std::sort(begin, end);
  auto best = *begin;
  std::ptrdiff_t longest_run = 0;
  for (Iterator run = begin; run != end;)
  {
    const Iterator next = std::upper_bound(run, end, *run);
    if (next - run > longest_run)
    {
      longest_run = next - run;
      best = *run;
    }
    run = next;
  }
  return best;
}

} // namespace bindpose

#endif
