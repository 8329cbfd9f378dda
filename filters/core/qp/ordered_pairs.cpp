// Ordered pairs of vertices: constraints that exclude extrema (see ordered_pairs.h).
#include "qp/ordered_pairs.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

SparseMatrix positive_stiffness(
  const SparseMatrix& stiffness, const VertexGraph& graph, const std::vector<char>& is_used)
{
  // Minimum edge weight as a fraction of the diagonal entries. It is small enough that the harmonic
  // function still follows the geometry of the mesh, and large enough to keep rounding errors of
  // the solution small.
  constexpr double least_weight = 1e-3;
  const Eigen::VectorXd diagonal = stiffness.diagonal();
  const auto n = static_cast<int>(stiffness.rows());
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(graph.neighbors.size() + static_cast<std::size_t>(n));
  for (int v = 0; v < n; ++v)
  {
    double degree = 0;
    for (Index k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
    {
      const Index other = graph.neighbors[k];
      if (is_used[v] && is_used[other])
      {
        const double minimum = least_weight * std::sqrt(diagonal[v] * diagonal[other]);
        const double w = std::max(-stiffness.coeff(v, other), minimum);
        entries.emplace_back(v, static_cast<int>(other), -w);
        degree += w;
      }
    }
    entries.emplace_back(v, v, degree);
  }
  SparseMatrix laplacian(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  return laplacian;
}

void sort_pairs(std::vector<OrderedPair>& pairs)
{
  std::sort(pairs.begin(), pairs.end(),
    [](const OrderedPair& x, const OrderedPair& y)
    { return x.low != y.low ? x.low < y.low : x.high < y.high; });
  pairs.erase(std::unique(pairs.begin(), pairs.end(),
                [](const OrderedPair& x, const OrderedPair& y)
                { return x.low == y.low && x.high == y.high; }),
    pairs.end());
}

std::vector<Index> topological_order(const std::vector<OrderedPair>& pairs, Index count)
{
  std::vector<std::vector<Index>> successors(static_cast<std::size_t>(count));
  // For each vertex, the number of pairs in which this vertex is `high` and whose `low` vertex is
  // not yet in the order.
  std::vector<Index> open_predecessors(static_cast<std::size_t>(count), 0);
  for (const OrderedPair& pair : pairs)
  {
    successors[pair.low].push_back(pair.high);
    open_predecessors[pair.high] += 1;
  }
  std::vector<Index> order;
  order.reserve(successors.size());
  for (Index v = 0; v < count; ++v)
  {
    if (open_predecessors[v] == 0)
    {
      order.push_back(v);
    }
  }
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    for (const Index v : successors[order[i]])
    {
      if (--open_predecessors[v] == 0)
      {
        order.push_back(v);
      }
    }
  }
  return order;
}

std::vector<OrderedPair> sort_pairs_by_order(
  const std::vector<OrderedPair>& pairs, const std::vector<Index>& order)
{
  std::vector<Index> rank(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    rank[order[i]] = static_cast<Index>(i);
  }
  std::vector<OrderedPair> sorted_pairs = pairs;
  std::stable_sort(sorted_pairs.begin(), sorted_pairs.end(),
    [&](const OrderedPair& a, const OrderedPair& b) { return rank[a.low] < rank[b.low]; });
  return sorted_pairs;
}

void enforce_order(const std::vector<OrderedPair>& sorted_pairs, const std::vector<char>& is_free,
  const Eigen::VectorXd& highest, Eigen::VectorXd& values)
{
  // Upper limits of the values: the limits `highest`, reduced so that the pairs can be satisfied.
  // For each pair, the limit of the low vertex is at most the limit of the high vertex minus the
  // minimum difference of the pair.
  Eigen::VectorXd highest_feasible = highest;
  for (Index v = 0; v < values.size(); ++v)
  {
    highest_feasible[v] = is_free[v] ? highest[v] : values[v];
  }
  for (auto pair = sorted_pairs.rbegin(); pair != sorted_pairs.rend(); ++pair)
  {
    highest_feasible[pair->low] = std::min(
      highest_feasible[pair->low], highest_feasible[pair->high] - pair->minimum_difference);
  }
  for (Index v = 0; v < values.size(); ++v)
  {
    values[v] = is_free[v] ? std::min(values[v], highest_feasible[v]) : values[v];
  }
  for (const OrderedPair& pair : sorted_pairs)
  {
    if (is_free[pair.high])
    {
      values[pair.high] = std::max(values[pair.high], values[pair.low] + pair.minimum_difference);
    }
  }
}

Index find_infeasible_vertex(
  const BoxQpColumn& column, const std::vector<Index>& fixed, Index count)
{
  std::vector<double> minimum(static_cast<std::size_t>(count));
  std::vector<double> maximum(static_cast<std::size_t>(count));
  for (Index u = 0; u < count; ++u)
  {
    minimum[u] = column.bounds.low(u);
    maximum[u] = column.bounds.high(u);
  }
  for (std::size_t i = 0; i < fixed.size(); ++i)
  {
    minimum[fixed[i]] = maximum[fixed[i]] = column.fixed_values[static_cast<Index>(i)];
  }
  for (std::size_t i = 0; i < column.pinned.size(); ++i)
  {
    minimum[column.pinned[i]] = maximum[column.pinned[i]] =
      column.pinned_values[static_cast<Index>(i)];
  }
  const std::vector<Index> order = topological_order(column.pairs, count);
  for (const OrderedPair& pair : sort_pairs_by_order(column.pairs, order))
  {
    minimum[pair.high] = std::max(minimum[pair.high], minimum[pair.low] + pair.minimum_difference);
  }
  constexpr double round_off = 1e-12;
  const auto infeasible = std::find_if(
    order.begin(), order.end(), [&](Index u) { return minimum[u] > maximum[u] + round_off; });
  return infeasible == order.end() ? Index(-1) : *infeasible;
}

} // namespace bindpose
