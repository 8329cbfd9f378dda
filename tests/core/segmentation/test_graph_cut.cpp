// Binary labelings of minimum energy by graph cuts, compared with brute force.
#include "segmentation/graph_cut.h"

#include "support/cancel_later.h"
#include "support/meshes.h"
#include "support/sanitized.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

using namespace bindpose;
using namespace bindpose::test;
using testing::HasSubstr;

namespace
{
CutEnergy random_energy(Index nodes, Index edges, Random& random)
{
  CutEnergy energy;
  for (Index i = 0; i < nodes; ++i)
  {
    // Some nodes have equal costs inside and outside. Others have a much lower cost on one side.
    const Index kind = random.below(5);
    energy.inside_costs.push_back(kind == 0 ? 0.0 : kind == 1 ? 100.0 : random.uniform());
    energy.outside_costs.push_back(kind == 0 ? 0.0 : random.uniform());
  }
  for (Index e = 0; e < edges; ++e)
  {
    const Index a = random.below(nodes);
    // Node b is any node except a. Pairs of nodes may repeat.
    const Index b = (a + 1 + random.below(nodes - 1)) % nodes;
    energy.edges.push_back({ a, b, random.below(4) == 0 ? 0.0 : random.uniform() });
  }
  return energy;
}

/// Return the smallest energy of all labelings.
double brute_force(const CutEnergy& energy)
{
  const std::size_t nodes = energy.inside_costs.size();
  double least = std::numeric_limits<double>::infinity();
  std::vector<char> inside(nodes);
  for (std::size_t labels = 0; labels < (std::size_t(1) << nodes); ++labels)
  {
    for (std::size_t i = 0; i < nodes; ++i)
    {
      inside[i] = (labels >> i) & 1;
    }
    least = std::min(least, energy.evaluate(inside));
  }
  return least;
}

Status minimized(const CutEnergy& energy, std::vector<char>& inside)
{
  ExecutionContext context;
  return minimize(context, energy, inside);
}

/// Return a grid of n^3 nodes with random costs. The minimization of this energy is slow.
CutEnergy noise_energy(Index n)
{
  Random random(7);
  CutEnergy energy;
  for (Index i = 0; i < n * n * n; ++i)
  {
    energy.inside_costs.push_back(random.uniform());
    energy.outside_costs.push_back(random.uniform());
    const Index step[3] = { 1, n, n * n };
    for (int k = 0; k < 3; ++k)
    {
      if ((i / step[k]) % n + 1 < n)
      {
        energy.edges.push_back({ i, i + step[k], 0.3 });
      }
    }
  }
  return energy;
}
} // namespace

TEST(GraphCut, EqualsBruteForce)
{
  Random random(1);
  for (int instance = 0; instance < 400; ++instance)
  {
    const Index nodes = 2 + random.below(11);
    const CutEnergy energy = random_energy(nodes, random.below(4 * nodes), random);
    std::vector<char> inside;
    ASSERT_TRUE(minimized(energy, inside).ok());
    ASSERT_NEAR(energy.evaluate(inside), brute_force(energy), 1e-9) << "instance " << instance;
  }
}

TEST(GraphCut, WithoutEdgesEveryNodeTakesItsCheaperSide)
{
  CutEnergy energy;
  energy.inside_costs = { 0.0, 1.0, 0.5, 0.5 };
  energy.outside_costs = { 1.0, 0.0, 0.5, 0.6 };
  std::vector<char> inside;
  ASSERT_TRUE(minimized(energy, inside).ok());
  EXPECT_EQ(inside, (std::vector<char>{ 1, 0, 0, 1 })); // equal costs: node 2 is outside
}

TEST(GraphCut, ScaleDoesNotMatter)
{
  Random random(2);
  CutEnergy energy = random_energy(200, 800, random);
  std::vector<char> inside, scaled;
  ASSERT_TRUE(minimized(energy, inside).ok());
  for (const double factor : { 0x1p-200, 0x1p200 })
  {
    CutEnergy other = energy;
    for (Index i = 0; i < 200; ++i)
    {
      other.inside_costs[i] *= factor;
      other.outside_costs[i] *= factor;
    }
    for (CutEnergy::Edge& edge : other.edges)
    {
      edge.cost *= factor;
    }
    ASSERT_TRUE(minimized(other, scaled).ok());
    EXPECT_EQ(scaled, inside);
  }
}

TEST(GraphCut, NothingAndOneNode)
{
  std::vector<char> inside{ 1, 1 };
  ASSERT_TRUE(minimized(CutEnergy(), inside).ok());
  EXPECT_TRUE(inside.empty());
  CutEnergy one;
  one.inside_costs = { 0.0 };
  one.outside_costs = { 0.25 };
  ASSERT_TRUE(minimized(one, inside).ok());
  EXPECT_EQ(inside, std::vector<char>{ 1 });
}

TEST(GraphCut, BadCostsAndNodesAreNamed)
{
  CutEnergy energy;
  energy.inside_costs = { 0.0, 1.0 };
  energy.outside_costs = { 0.0, std::numeric_limits<double>::quiet_NaN() };
  std::vector<char> inside;
  EXPECT_THAT(minimized(energy, inside).message, HasSubstr("node 1"));
  energy.outside_costs = { 0.0, -1.0 };
  EXPECT_EQ(minimized(energy, inside).code, StatusCode::invalid_input);
  energy.outside_costs = { 0.0 };
  EXPECT_EQ(minimized(energy, inside).code, StatusCode::invalid_input);
  energy.outside_costs = { 0.0, 1.0 };
  for (const CutEnergy::Edge& edge :
    { CutEnergy::Edge{ 0, 2, 1.0 }, { -1, 0, 1.0 }, { 1, 1, 1.0 }, { 0, 1, -1.0 } })
  {
    energy.edges = { { 0, 1, 1.0 }, edge };
    EXPECT_THAT(minimized(energy, inside).message, HasSubstr("edge 1"));
  }
}

TEST(GraphCut, CancelStopsIt)
{
  const CutEnergy energy = noise_energy(70); // minimizing this energy takes seconds
  ExecutionContext context;
  test::DelayedCancel canceler(context, 500);
  std::vector<char> inside;
  const Status status = minimize(context, energy, inside);
  const double seconds_since_cancel = canceler.seconds_since_cancel();
  if (status.code == StatusCode::canceled)
  {
    // The cancel takes about 200 ms on an idle machine.
    EXPECT_LT(seconds_since_cancel, test::sanitized ? 10.0 : 1.0);
  }
  else
  {
    // A fast machine may finish before the cancel request.
    EXPECT_TRUE(status.ok()) << status.message;
    EXPECT_LT(seconds_since_cancel, 0.0);
  }
}
