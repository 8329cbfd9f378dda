// Orders of vertices with prescribed extrema, by flooding (see extrema_order.h). Upward flooding
// begins with the listed minima and then repeatedly takes the lowest vertex that is a neighbor of a
// vertex already taken. So each vertex except the listed minima comes after one of its neighbors.
// If the values have a minimum that is not listed, the vertices around this minimum are taken when
// the flood reaches the lowest pass to it. In the same way, downward flooding from the listed
// maxima removes unlisted maxima, but it may create new minima near the removed maxima. Therefore
// upward and downward floods alternate until the order has exactly the listed extrema. Each flood
// only moves vertices within the plateaus that the previous flood created, and these plateaus
// become smaller.
#include "weights/extrema_order.h"

#include "qp/ordered_pairs.h"

#include <algorithm>
#include <queue>

namespace bindpose
{

namespace
{
/// Report whether every vertex that is not a listed extremum has a higher neighbor (if `above` is
/// true) or a lower neighbor (if `above` is false).
bool has_neighbors(const VertexGraph& graph, const ExtremaList& list,
  const std::vector<Index>& rank, const std::vector<Index>& order, bool above)
{
  return std::all_of(order.begin(), order.end(),
    [&](Index v)
    {
      const auto begin = graph.neighbors.begin() + graph.begin[v];
      const auto end = graph.neighbors.begin() + graph.begin[v + 1];
      return list[v] != 0 ||
        std::any_of(
          begin, end, [&](Index u) { return above ? rank[u] > rank[v] : rank[u] < rank[v]; });
    });
}

/// Replace the order by the order in which a flood from the minima (from = -1) or maxima (from = 1)
/// takes the vertices. The flood takes extrema of the opposite kind last. The result is ascending
/// in both cases: the order of a flood from the maxima is reversed.
void flood(const VertexGraph& graph, const ExtremaList& list, int from, std::vector<Index>& rank,
  std::vector<Index>& order)
{
  const auto count = static_cast<Index>(order.size());
  if (from > 0)
  {
    std::reverse(order.begin(), order.end());
  }
  // The queue contains positions in `order`; the smallest position is taken first.
  std::vector<Index> queue_index(rank.size(), -1);
  std::priority_queue<Index, std::vector<Index>, std::greater<>> open;
  std::vector<Index> last;
  for (Index i = 0; i < count; ++i)
  {
    const Index v = order[i];
    if (list[v] * from > 0)
    {
      open.push(i);
    }
    else if (list[v] != 0)
    {
      last.push_back(v);
    }
    else
    {
      queue_index[v] = i;
    }
  }
  std::vector<Index> new_order;
  new_order.reserve(order.size());
  // The flood starts at the listed extrema of one kind. These extrema come first in the new order,
  // because each of them must come before its unlisted neighbors.
  for (std::size_t listed = open.size(); listed > 0; --listed)
  {
    new_order.push_back(order[open.top()]);
    open.pop();
  }
  const auto push_neighbors = [&](Index v)
  {
    for (Index k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
    {
      const Index u = graph.neighbors[k];
      if (queue_index[u] >= 0)
      {
        open.push(queue_index[u]);
        queue_index[u] = -1;
      }
    }
  };
  const std::size_t seeds = new_order.size();
  for (std::size_t i = 0; i < seeds; ++i)
  {
    push_neighbors(new_order[i]);
  }
  while (!open.empty())
  {
    new_order.push_back(order[open.top()]);
    open.pop();
    push_neighbors(new_order.back());
  }
  new_order.insert(new_order.end(), last.begin(), last.end());
  order = std::move(new_order);
  if (from > 0)
  {
    std::reverse(order.begin(), order.end());
  }
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    rank[order[i]] = static_cast<Index>(i);
  }
}
} // namespace

std::vector<std::vector<Index>> parts_without_extremum(
  const VertexGraph& graph, const std::vector<char>& is_included, const ExtremaList& list, int kind)
{
  std::vector<std::vector<Index>> parts;
  std::vector<char> visited(is_included.size(), 0);
  for (std::size_t first = 0; first < visited.size(); ++first)
  {
    if (visited[first] || !is_included[first] || list[first] * kind < 0)
    {
      continue;
    }
    std::vector<Index> part{ static_cast<Index>(first) };
    visited[first] = 1;
    bool found = false;
    for (std::size_t i = 0; i < part.size(); ++i)
    {
      const Index v = part[i];
      found = found || list[v] * kind > 0;
      for (Index k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
      {
        const Index u = graph.neighbors[k];
        if (!visited[u] && is_included[u] && list[u] * kind >= 0)
        {
          visited[u] = 1;
          part.push_back(u);
        }
      }
    }
    if (!found)
    {
      parts.push_back(std::move(part));
    }
  }
  return parts;
}

int order_with_extrema(const ExecutionContext& context, const VertexGraph& graph,
  const std::vector<char>& is_included, const ExtremaList& list, const Eigen::VectorXd& values,
  std::vector<Index>& rank)
{
  constexpr int maximum_floods = 1000;
  const Index n = values.size();
  rank.assign(static_cast<std::size_t>(n), -1);
  std::vector<Index> order;
  for (Index v = 0; v < n; ++v)
  {
    if (is_included[v])
    {
      order.push_back(v);
    }
  }
  std::sort(order.begin(), order.end(),
    [&](Index a, Index b) { return values[a] != values[b] ? values[a] < values[b] : a < b; });
  for (int floods = 1; floods <= maximum_floods && !context.canceled(); ++floods)
  {
    const bool upwards = floods % 2 == 1;
    flood(graph, list, upwards ? -1 : 1, rank, order);
    if (has_neighbors(graph, list, rank, order, upwards))
    {
      return floods;
    }
  }
  return 0;
}

void update_order(const Eigen::VectorXd& values, std::vector<Index>& rank)
{
  std::vector<Index> order;
  for (std::size_t v = 0; v < rank.size(); ++v)
  {
    if (rank[v] >= 0)
    {
      order.push_back(static_cast<Index>(v));
    }
  }
  std::sort(order.begin(), order.end(),
    [&](Index a, Index b)
    { return values[a] != values[b] ? values[a] < values[b] : rank[a] < rank[b]; });
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    rank[order[i]] = static_cast<Index>(i);
  }
}

std::vector<OrderedPair> pairs_from_order(const VertexGraph& graph, const ExtremaList& list,
  const std::vector<Index>& rank, double minimum_difference)
{
  std::vector<OrderedPair> pairs;
  for (std::size_t i = 0; i < rank.size(); ++i)
  {
    const auto v = static_cast<Index>(i);
    if (rank[v] < 0)
    {
      continue;
    }
    Index lowest = v;
    Index highest = v;
    for (Index k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
    {
      const Index u = graph.neighbors[k];
      lowest = rank[u] < rank[lowest] ? u : lowest;
      highest = rank[u] > rank[highest] ? u : highest;
      if (list[v] != 0 && list[u] * list[v] <= 0)
      {
        pairs.push_back(list[v] > 0 ? OrderedPair{ u, v, minimum_difference }
                                    : OrderedPair{ v, u, minimum_difference });
      }
    }
    if (list[v] == 0)
    {
      pairs.push_back({ lowest, v, minimum_difference });
      pairs.push_back({ v, highest, minimum_difference });
    }
  }
  sort_pairs(pairs);
  return pairs;
}

} // namespace bindpose
