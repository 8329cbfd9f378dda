// Total orders of the vertices of a mesh, computed from arbitrary values. The local extrema of an
// order are exactly the vertices of a given list.
#include "weights/extrema_order.h"

#include "weights_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;
using Eigen::VectorXd;

namespace
{
/// Expect that the order has the listed extrema:
/// - A vertex that is not listed has a neighbor before it and a neighbor after it.
/// - All neighbors of a listed minimum are after the minimum, except other listed minima.
/// - All neighbors of a listed maximum are before the maximum, except other listed maxima.
void expect_order(const VertexGraph& graph, const ExtremaList& list, const std::vector<Index>& rank)
{
  for (std::size_t v = 0; v < list.size(); ++v)
  {
    bool above = false;
    bool below = false;
    for (Index k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
    {
      const Index u = graph.neighbors[k];
      above = above || rank[u] > rank[v];
      below = below || rank[u] < rank[v];
      EXPECT_FALSE(list[v] > 0 && list[u] <= 0 && rank[u] > rank[v]);
      EXPECT_FALSE(list[v] < 0 && list[u] >= 0 && rank[u] < rank[v]);
    }
    EXPECT_TRUE(list[v] != 0 || (above && below));
  }
}
} // namespace

TEST(ExtremaOrder, HasTheListedExtremaWhateverTheValues)
{
  test::Random random(11);
  const Domain domains[] = { test::to_domain(test::grid(23, 17)), test::to_domain(test::sphere(3)),
    test::to_domain(test::tet_box(7, 6, 8)) };
  for (const Domain& domain : domains)
  {
    const VertexGraph graph = vertex_graph(domain);
    const Index n = domain.points.rows();
    const std::vector<char> all(static_cast<std::size_t>(n), 1);
    for (int round = 0; round < 20; ++round)
    {
      const VectorXd values = VectorXd::NullaryExpr(n,
        [&](Index v)
        { return round % 2 ? random.uniform() : std::floor(4.0 * domain.points(v, round % 3)); });
      ExtremaList list(static_cast<std::size_t>(n), 0);
      for (int i = 0; i < 2 + round; ++i)
      {
        list[random.below(n)] = i % 2 ? 1 : -1;
      }
      if (!parts_without_extremum(graph, all, list, 1).empty() ||
        !parts_without_extremum(graph, all, list, -1).empty())
      {
        continue;
      }
      ExecutionContext context;
      std::vector<Index> rank;
      const int floods = order_with_extrema(context, graph, all, list, values, rank);
      EXPECT_GT(floods, 0);
      EXPECT_LE(floods, 50);
      expect_order(graph, list, rank);
    }
  }
}

TEST(ExtremaOrder, KeepsValuesThatNeedNoChange)
{
  const Domain domain = test::to_domain(test::grid(12, 12));
  const VertexGraph graph = vertex_graph(domain);
  const VectorXd values = domain.points.col(0) + 0.3 * domain.points.col(1);
  ExtremaList list(169, 0);
  list[0] = -1;
  list[168] = 1;
  ExecutionContext context;
  std::vector<Index> rank;
  EXPECT_EQ(order_with_extrema(context, graph, std::vector<char>(169, 1), list, values, rank), 1);
  for (Index a = 0; a < 169; ++a)
  {
    for (Index k = graph.begin[a]; k < graph.begin[a + 1]; ++k)
    {
      const Index b = graph.neighbors[k];
      EXPECT_TRUE(values[a] >= values[b] || rank[a] < rank[b]);
    }
  }
}
