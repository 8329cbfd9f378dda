// Sorting and welding of vertices by exact coordinates (see vertex_order.h).
#include "surface/vertex_order.h"

#include <algorithm>
#include <numeric>

namespace bindpose
{

namespace
{
/// Compare vertices by coordinates. Return a value below 0 if a is before b, 0 if they are equal,
/// and a value above 0 if a is after b.
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

bool are_coincident(const PointsView& points, Index a, Index b)
{
  return compare(points, a, b) == 0;
}

std::vector<Index> lexicographic_order(const PointsView& points, const std::vector<char>& used)
{
  struct Entry
  {
    double x; // x coordinate of the vertex, stored here because most comparisons need only x
    Index vertex;
  };
  std::vector<Entry> entries;
  for (Index v = 0; v < points.rows(); ++v)
  {
    if (used[static_cast<std::size_t>(v)])
    {
      entries.push_back({ points(v, 0), v });
    }
  }
  std::sort(entries.begin(), entries.end(),
    [&points](const Entry& a, const Entry& b)
    {
      if (a.x != b.x)
      {
        return a.x < b.x;
      }
      const int position_order = compare(points, a.vertex, b.vertex);
      return position_order != 0 ? position_order < 0 : a.vertex < b.vertex;
    });
  std::vector<Index> order;
  order.reserve(entries.size());
  for (const Entry& entry : entries)
  {
    order.push_back(entry.vertex);
  }
  return order;
}

std::vector<Index> find_representatives(const PointsView& points, const std::vector<char>& used)
{
  const std::vector<Index> order = lexicographic_order(points, used);
  std::vector<Index> lowest(static_cast<std::size_t>(points.rows()));
  std::iota(lowest.begin(), lowest.end(), Index(0));
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    if (are_coincident(points, order[i - 1], order[i]))
    {
      lowest[order[i]] = lowest[order[i - 1]];
    }
  }
  return lowest;
}

} // namespace bindpose
