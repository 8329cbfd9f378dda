// Local extrema and their persistence. They are compared with known values on a path, and with
// brute force on a grid.
#include "weights/extrema.h"

#include "weights_shapes.h"

#include <gtest/gtest.h>

#include <queue>

using namespace bindpose;

namespace
{
VertexGraph path(Index count)
{
  VertexGraph graph;
  graph.begin.push_back(0);
  for (Index v = 0; v < count; ++v)
  {
    if (v > 0)
    {
      graph.neighbors.push_back(v - 1);
    }
    if (v + 1 < count)
    {
      graph.neighbors.push_back(v + 1);
    }
    graph.begin.push_back(static_cast<Index>(graph.neighbors.size()));
  }
  return graph;
}

/// Return the persistence of a minimum at vertex `from`, where f is the height. A path from this
/// vertex to a lower vertex or to a handle (`is_exempt`) climbs to its highest vertex. The
/// persistence is the smallest possible climb. The search uses a queue ordered by height.
double climb(const VertexGraph& graph, const Eigen::VectorXd& f, const std::vector<char>& is_exempt,
  Index from)
{
  std::vector<char> visited(static_cast<std::size_t>(f.size()), 0);
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  open.emplace(f[from], from);
  double height = f[from];
  while (!open.empty())
  {
    const auto [value, v] = open.top();
    open.pop();
    if (visited[v])
    {
      continue;
    }
    visited[v] = 1;
    height = std::max(height, value);
    if (v != from && (is_exempt[v] || f[v] < f[from]))
    {
      return height - f[from];
    }
    for (Index k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
    {
      open.emplace(f[graph.neighbors[k]], graph.neighbors[k]);
    }
  }
  return f.maxCoeff() - f.minCoeff();
}
} // namespace

TEST(Extrema, PersistenceOnAPathCanBeReadOff)
{
  Eigen::VectorXd f(9);
  // Vertices 0 and 5 are handles.
  f << 0.0, 0.5, 0.3, 0.9, 0.85, 1.0, 0.2, 0.4, 0.4;
  std::vector<char> is_exempt{ 1, 0, 0, 0, 0, 1, 0, 0, 0 };
  const auto found = interior_extrema(path(9), f, is_exempt);
  // A path from a minimum to a lower vertex or to a handle first climbs. The smallest possible
  // climb is the persistence of the minimum:
  // - vertex 6: from 0.2 to 1
  // - vertex 2: from 0.3 to 0.5
  // - vertex 4: from 0.85 to 0.9
  // Likewise, the persistence of a maximum is the smallest possible descent:
  // - vertices 7 and 8: from 0.4 to 0.2
  // - vertex 3: from 0.9 to 0.85
  // - vertex 1: from 0.5 to 0.3
  ASSERT_EQ(found.size(), 6u);
  EXPECT_EQ(found[0].vertex, 6);
  EXPECT_FALSE(found[0].maximum);
  EXPECT_DOUBLE_EQ(found[0].persistence, 0.8);
  double sum = 0.0;
  for (const Extremum& e : found)
  {
    sum += e.persistence;
    EXPECT_DOUBLE_EQ(e.value, f[e.vertex]);
  }
  EXPECT_NEAR(sum, 0.8 + 0.2 + 0.05 + 0.2 + 0.05 + 0.2, 1e-12);
  EXPECT_EQ(interior_extrema(path(9), f, is_exempt, 0.1).size(), 4u);
}

TEST(Extrema, HandlesWinTiesAndPlateausAreOne)
{
  Eigen::VectorXd f(7);
  f << 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0;
  EXPECT_TRUE(interior_extrema(path(7), f, { 0, 1, 0, 0, 0, 0, 1 }).empty());
  // Vertex 0 is now the global minimum, but lower than the handle next to it only by round-off.
  // Such a minimum is not reported.
  f[0] = -1e-10;
  EXPECT_TRUE(interior_extrema(path(7), f, { 0, 1, 0, 0, 0, 0, 1 }).empty());
  EXPECT_EQ(interior_extrema(path(7), f, { 0, 1, 0, 0, 0, 0, 1 }, 0.0).size(), 1u);
  // Without handles, each end of the path is an extremum. Its persistence is 1, the whole range of
  // the values.
  const auto all = interior_extrema(path(7), f, std::vector<char>(7, 0));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].persistence, 1.0);
  EXPECT_TRUE(interior_extrema(path(7), Eigen::VectorXd::Ones(7), std::vector<char>(7, 0)).empty());
}

TEST(Extrema, AgreeWithTheLowestPass)
{
  const Domain domain = test::to_domain(test::grid(14, 11));
  const VertexGraph graph = vertex_graph(domain);
  test::Random random(2);
  for (int round = 0; round < 5; ++round)
  {
    const Eigen::VectorXd f =
      Eigen::VectorXd::NullaryExpr(domain.points.rows(), [&] { return random.uniform(); });
    std::vector<char> is_exempt(static_cast<std::size_t>(f.size()), 0);
    for (int i = 0; i < 4; ++i)
    {
      is_exempt[random.below(f.size())] = 1;
    }
    const double range = f.maxCoeff() - f.minCoeff();
    Index expected = 0;
    for (const double sign : { 1.0, -1.0 })
    {
      for (Index v = 0; v < f.size(); ++v)
      {
        expected += !is_exempt[v] && climb(graph, sign * f, is_exempt, v) > 0.2 * range;
      }
    }
    const auto found = interior_extrema(graph, f, is_exempt, 0.2);
    EXPECT_EQ(static_cast<Index>(found.size()), expected);
    for (const Extremum& e : found)
    {
      const double twin = climb(graph, e.maximum ? Eigen::VectorXd(-f) : f, is_exempt, e.vertex);
      EXPECT_NEAR(e.persistence, twin / range, 1e-12);
    }
  }
}
