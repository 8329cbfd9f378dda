#include "surface/vertex_order.h"

#include <algorithm>

namespace bindpose
{

namespace
{
/// Below, at or above 0: a comes before b, is in the same place, comes after.
int compare(const PointsView& points, Index a, Index b)
{
  for (int k = 0; k < 3; ++k)
  {
    if (points(a, k) != points(b, k))
    {
      return points(a, k) < points(b, k) ? -1 : 1;
    }
  }
  return 0;
}
} // namespace

bool same_place(const PointsView& points, Index a, Index b)
{
  return compare(points, a, b) == 0;
}

std::vector<Index> order_by_place(const PointsView& points, const std::vector<char>& used)
{
  std::vector<Index> order;
  for (Index v = 0; v < points.rows(); ++v)
  {
    if (used[static_cast<std::size_t>(v)])
    {
      order.push_back(v);
    }
  }
  std::sort(order.begin(), order.end(),
    [&points](Index a, Index b)
    {
      const int by_place = compare(points, a, b);
      return by_place != 0 ? by_place < 0 : a < b;
    });
  return order;
}

} // namespace bindpose
