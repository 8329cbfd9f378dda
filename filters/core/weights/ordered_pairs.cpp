#include "weights/ordered_pairs.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

SparseMatrix positive_stiffness(
  const SparseMatrix& stiffness, const VertexGraph& graph, const std::vector<char>& pulls)
{
  // As a share of the diagonals: small enough not to turn the guide, large enough to keep the
  // solution's rounding errors small.
  constexpr double least_weight = 1e-3;
  const Eigen::VectorXd diagonal = stiffness.diagonal();
  const auto n = static_cast<int>(stiffness.rows());
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(graph.neighbours.size() + static_cast<std::size_t>(n));
  for (int v = 0; v < n; ++v)
  {
    double degree = 0;
    for (Index k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
    {
      const Index other = graph.neighbours[k];
      if (pulls[v] && pulls[other])
      {
        const double least = least_weight * std::sqrt(diagonal[v] * diagonal[other]);
        const double w = std::max(-stiffness.coeff(v, other), least);
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

Index without_room(const BoxQpColumn& column, const std::vector<Index>& fixed, Index count)
{
  std::vector<double> least(static_cast<std::size_t>(count));
  std::vector<double> most(static_cast<std::size_t>(count));
  for (Index u = 0; u < count; ++u)
  {
    least[u] = column.bounds.low(u);
    most[u] = column.bounds.high(u);
  }
  for (std::size_t i = 0; i < fixed.size(); ++i)
  {
    least[fixed[i]] = most[fixed[i]] = column.fixed_values[static_cast<Index>(i)];
  }
  for (std::size_t i = 0; i < column.pinned.size(); ++i)
  {
    least[column.pinned[i]] = most[column.pinned[i]] = column.pinned_values[static_cast<Index>(i)];
  }
  std::vector<std::vector<const OrderedPair*>> above(static_cast<std::size_t>(count));
  std::vector<Index> open(static_cast<std::size_t>(count), 0);
  for (const OrderedPair& pair : column.pairs)
  {
    above[pair.low].push_back(&pair);
    open[pair.high] += 1;
  }
  std::vector<Index> ordered;
  for (Index u = 0; u < count; ++u)
  {
    if (open[u] == 0)
    {
      ordered.push_back(u);
    }
  }
  constexpr double round_off = 1e-12;
  for (std::size_t i = 0; i < ordered.size(); ++i)
  {
    const Index u = ordered[i];
    if (least[u] > most[u] + round_off)
    {
      return u;
    }
    for (const OrderedPair* pair : above[u])
    {
      least[pair->high] = std::max(least[pair->high], least[u] + pair->least);
      if (--open[pair->high] == 0)
      {
        ordered.push_back(pair->high);
      }
    }
  }
  return -1;
}

} // namespace bindpose
