// Points in weight space (rows of the weight matrix): clusters, farthest-row sampling, and splines
// around rows.
#include "arap/weight_clusters.h"

#include "support/bars.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <set>

using namespace bindpose;

namespace
{
/// Return rows in tight groups around the given centers.
Weights blobs(const Weights& centers, Index each, double spread)
{
  test::Random random(3);
  Weights rows(centers.rows() * each, centers.cols());
  for (Index i = 0; i < rows.rows(); ++i)
  {
    for (Index j = 0; j < rows.cols(); ++j)
    {
      rows(i, j) = centers(i % centers.rows(), j) + random.uniform(-spread, spread);
    }
  }
  return rows;
}
} // namespace

TEST(WeightClusters, GroupsAreFound)
{
  Weights centers(4, 2);
  centers << 0, 0, 1, 0, 0, 1, 1, 1;
  // With 5000 rows per group, the clusters are computed from a sample.
  for (const Index each : { 50, 5000 })
  {
    ExecutionContext context;
    Clusters clusters;
    ASSERT_TRUE(cluster_rows(context, blobs(centers, each, 0.1), 4, clusters));
    ASSERT_EQ(clusters.count, 4);
    for (std::size_t i = 4; i < clusters.cluster_of_row.size(); ++i)
    {
      ASSERT_EQ(clusters.cluster_of_row[i], clusters.cluster_of_row[i % 4]);
    }
    EXPECT_EQ(
      std::set<Index>(clusters.cluster_of_row.begin(), clusters.cluster_of_row.begin() + 4).size(),
      4u);
  }
}

TEST(WeightClusters, NoRowHasANearerMean)
{
  const test::Rig rig = test::box(6);
  ExecutionContext context;
  Clusters clusters;
  ASSERT_TRUE(cluster_rows(context, rig.weights, 12, clusters));
  Weights means = Weights::Zero(clusters.count, rig.weights.cols());
  std::vector<double> sizes(static_cast<std::size_t>(clusters.count), 0.0);
  for (Index v = 0; v < rig.weights.rows(); ++v)
  {
    const Index c = clusters.cluster_of_row[static_cast<std::size_t>(v)];
    means.row(c) += rig.weights.row(v);
    sizes[static_cast<std::size_t>(c)] += 1.0;
  }
  Index wrong = 0;
  for (Index c = 0; c < clusters.count; ++c)
  {
    ASSERT_GT(sizes[static_cast<std::size_t>(c)], 0.0);
    means.row(c) /= sizes[static_cast<std::size_t>(c)];
  }
  for (Index v = 0; v < rig.weights.rows(); ++v)
  {
    Index nearest = 0;
    (means.rowwise() - rig.weights.row(v)).rowwise().squaredNorm().minCoeff(&nearest);
    wrong += nearest != clusters.cluster_of_row[static_cast<std::size_t>(v)] ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0); // each row is in the nearest cluster: Lloyd's iteration has converged
}

TEST(WeightClusters, EqualRowsAreOneCluster)
{
  ExecutionContext context;
  Clusters clusters;
  ASSERT_TRUE(cluster_rows(context, Weights(Weights::Ones(100, 1)), 7, clusters));
  EXPECT_EQ(clusters.count, 1);
  ASSERT_TRUE(cluster_rows(context, Weights(0, 3), 7, clusters));
  EXPECT_EQ(clusters.count, 0);
  context.request_cancel();
  EXPECT_FALSE(cluster_rows(context, Weights(Weights::Ones(100, 1)), 7, clusters));
}

TEST(WeightClusters, FarthestPointsSpread)
{
  Weights line(11, 1);
  for (Index i = 0; i < 11; ++i)
  {
    line(i, 0) = static_cast<double>(i);
  }
  ExecutionContext context;
  std::vector<Index> seeds;
  farthest_rows(context, line, 3, seeds);
  EXPECT_EQ(seeds, (std::vector<Index>{ 10, 0, 5 }));
  farthest_rows(context, line, 100, seeds); // requests 100 rows, but there are only 11
  EXPECT_EQ(seeds.size(), 11u);
  EXPECT_EQ(std::set<Index>(seeds.begin(), seeds.end()).size(), 11u);
}

// Bumps are splines in weight space that are zero at the handles.
TEST(WeightClusters, BumpsAreSplinesThatVanishAtTheHandles)
{
  const test::Rig rig = test::box(6);
  ExecutionContext context;
  const Weights bumps = spline_bumps(context, rig.weights, 15);
  ASSERT_EQ(bumps.cols(), 15);
  EXPECT_GE(bumps.minCoeff(), 0.0);
  for (Index e = 0; e < bumps.cols(); ++e)
  {
    // The spline's maximum 2/3 at the seed is scaled by 1.5.
    EXPECT_NEAR(bumps.col(e).maxCoeff(), 1.0, 1e-14);
  }
  for (const Index v : largest_weight_rows(rig.weights))
  {
    EXPECT_LT(bumps.row(v).maxCoeff(), 1e-12);
  }
  // Splines around neighboring seeds overlap, except where a close handle limits the radius of a
  // spline.
  Index overlaps = 0;
  for (Index e = 0; e < bumps.cols(); ++e)
  {
    Index seed = 0;
    bumps.col(e).maxCoeff(&seed);
    overlaps += (bumps.row(seed).array() > 1e-3).count() > 1 ? 1 : 0;
  }
  EXPECT_GT(overlaps, 5);
}
