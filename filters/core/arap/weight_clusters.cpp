// Clusters of vertices with similar weights, by k-means. Distances are computed as |x|^2 - 2 x.c +
// |c|^2, with one matrix product per block of rows. All steps whose result could depend on the
// order of threads (means, ties, empty clusters) are processed in row order.
#include "arap/weight_clusters.h"

#include "base/parallel.h"
#include "linear/dense_product.h"

#include <cmath>
#include <limits>

namespace bindpose
{

namespace
{
constexpr Index rows_per_task = 512;
constexpr Index lloyd_rounds = 100;
/// Number of sampled rows per cluster from which the means are computed. At the end all rows are
/// assigned to the means.
constexpr Index rows_per_cluster = 25;
/// Rows are equal if their distance is at most this.
constexpr double same_row_tolerance = 1e-12;

/// Return a pseudo-random number that is the same on every machine (splitmix64).
std::uint64_t splitmix64(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Label each row by its nearest mean (the lowest label if several means are equally near). Return
/// false if canceled.
bool assign_rows(
  ExecutionContext& context, WeightsView rows, const Weights& means, std::vector<Index>& labels)
{
  const Eigen::RowVectorXd mean_norms = means.rowwise().squaredNorm().transpose();
  const Weights transposed = -2.0 * means.transpose();
  return parallel_for(context, rows.rows(), rows_per_task,
    [&](Index begin, Index end)
    {
      const Index width = rows.cols();
      Weights distances = mean_norms.replicate(end - begin, 1);
      add_product({ rows.data() + begin * width, end - begin, width, width, 1 },
        { transposed.data(), width, transposed.cols(), transposed.cols(), 1 }, distances.data(),
        distances.cols());
      for (Index i = begin; i < end; ++i)
      {
        Index nearest = 0;
        distances.row(i - begin).minCoeff(&nearest);
        labels[static_cast<std::size_t>(i)] = nearest;
      }
    });
}
} // namespace

void farthest_rows(
  ExecutionContext& context, WeightsView rows, Index count, std::vector<Index>& seeds)
{
  if (rows.rows() == 0 || count <= 0)
  {
    return;
  }
  const Index blocks = (rows.rows() + rows_per_task - 1) / rows_per_task;
  std::vector<double> distance(
    static_cast<std::size_t>(rows.rows()), std::numeric_limits<double>::infinity());
  std::vector<Index> farthest_in_block(static_cast<std::size_t>(blocks), 0);
  const auto pick = [&]
  {
    Index best = farthest_in_block[0];
    for (const Index row : farthest_in_block)
    {
      best = distance[static_cast<std::size_t>(row)] > distance[static_cast<std::size_t>(best)]
        ? row
        : best;
    }
    return best;
  };
  const auto shrink = [&](Index seed)
  {
    return parallel_for(context, rows.rows(), rows_per_task,
      [&](Index begin, Index end)
      {
        Index best = begin;
        for (Index i = begin; i < end; ++i)
        {
          double& d = distance[static_cast<std::size_t>(i)];
          d = std::min(d, (rows.row(i) - rows.row(seed)).squaredNorm());
          best = d > distance[static_cast<std::size_t>(best)] ? i : best;
        }
        farthest_in_block[static_cast<std::size_t>(begin / rows_per_task)] = best;
      });
  };
  Index added = 0;
  if (seeds.empty())
  {
    Index first = 0;
    rows.rowwise().squaredNorm().maxCoeff(&first);
    seeds.push_back(first);
    ++added;
  }
  for (const Index seed : std::vector<Index>(seeds))
  {
    if (!shrink(seed))
    {
      return;
    }
  }
  for (; added < count; ++added)
  {
    const Index next = pick();
    if (distance[static_cast<std::size_t>(next)] <= same_row_tolerance * same_row_tolerance)
    {
      return;
    }
    seeds.push_back(next);
    if (!shrink(next))
    {
      return;
    }
  }
}

std::vector<Index> largest_weight_rows(WeightsView weights)
{
  std::vector<Index> result(static_cast<std::size_t>(weights.cols()), 0);
  for (Index j = 0; j < weights.cols() && weights.rows() > 0; ++j)
  {
    weights.col(j).maxCoeff(&result[static_cast<std::size_t>(j)]);
  }
  return result;
}

bool cluster_rows(ExecutionContext& context, WeightsView rows, Index count, Clusters& clusters)
{
  clusters = Clusters();
  clusters.cluster_of_row.assign(static_cast<std::size_t>(rows.rows()), 0);
  if (rows.rows() == 0)
  {
    return !context.canceled();
  }
  count = std::max<Index>(1, std::min(count, rows.rows()));
  const Index sample_size = std::max<Index>(5000, rows_per_cluster * count);
  const Index step = (rows.rows() + sample_size - 1) / sample_size;
  Weights sample((rows.rows() + step - 1) / step, rows.cols());
  for (Index i = 0; i < sample.rows(); ++i)
  {
    // Sample one random row from each `step` consecutive rows. Sampling at a constant stride is
    // avoided, because the vertex order of meshes is often periodic.
    const auto offset = static_cast<Index>(splitmix64(static_cast<std::uint64_t>(i)) %
      static_cast<std::uint64_t>(std::min(step, rows.rows() - i * step)));
    sample.row(i) = rows.row(i * step + offset);
  }
  std::vector<Index> seeds;
  farthest_rows(context, sample, count, seeds);
  Weights means(static_cast<Index>(seeds.size()), rows.cols());
  for (Index c = 0; c < means.rows(); ++c)
  {
    means.row(c) = sample.row(seeds[static_cast<std::size_t>(c)]);
  }
  std::vector<Index> labels(static_cast<std::size_t>(sample.rows()), -1);
  std::vector<Index> before;
  for (Index round = 0; round < lloyd_rounds; ++round)
  {
    before = labels;
    if (!assign_rows(context, sample, means, labels))
    {
      return false;
    }
    Index moved = 0;
    Weights sums = Weights::Zero(means.rows(), means.cols());
    std::vector<Index> sizes(static_cast<std::size_t>(means.rows()), 0);
    for (Index i = 0; i < sample.rows(); ++i)
    {
      const Index c = labels[static_cast<std::size_t>(i)];
      moved += c != before[static_cast<std::size_t>(i)] ? 1 : 0;
      sums.row(c) += sample.row(i);
      ++sizes[static_cast<std::size_t>(c)];
    }
    for (Index c = 0; c < means.rows(); ++c)
    {
      if (sizes[static_cast<std::size_t>(c)] > 0) // an empty cluster keeps its mean
      {
        means.row(c) = sums.row(c) / static_cast<double>(sizes[static_cast<std::size_t>(c)]);
      }
    }
    if (1000 * moved < sample.rows())
    {
      break;
    }
  }
  if (!assign_rows(context, rows, means, clusters.cluster_of_row))
  {
    return false;
  }
  std::vector<Index> name(static_cast<std::size_t>(means.rows()), -1);
  for (Index& label : clusters.cluster_of_row)
  {
    Index& new_label = name[static_cast<std::size_t>(label)];
    if (new_label < 0)
    {
      new_label = clusters.count++;
    }
    label = new_label;
  }
  return true;
}

Weights spline_bumps(ExecutionContext& context, WeightsView weights, Index count)
{
  std::vector<Index> seeds = largest_weight_rows(weights);
  const std::size_t handles = seeds.size();
  farthest_rows(context, weights, count, seeds);
  const auto extras = static_cast<Index>(seeds.size() - handles);
  Weights bumps(weights.rows(), extras);
  for (Index e = 0; e < extras; ++e)
  {
    const Index seed = seeds[handles + static_cast<std::size_t>(e)];
    double to_seed = std::numeric_limits<double>::infinity();
    double to_handle = std::numeric_limits<double>::infinity();
    for (std::size_t other = 0; other < seeds.size(); ++other)
    {
      if (seeds[other] == seed)
      {
        continue;
      }
      const double d = (weights.row(seeds[other]) - weights.row(seed)).norm();
      to_seed = std::min(to_seed, d);
      to_handle = other < handles ? std::min(to_handle, d) : to_handle;
    }
    const double radius = std::min(2.0 * to_seed, to_handle);
    for (Index v = 0; v < weights.rows(); ++v)
    {
      const double t = 2.0 * (weights.row(v) - weights.row(seed)).norm() / radius;
      bumps(v, e) = t < 1.0 ? 1.5 * (2.0 / 3.0 - t * t + 0.5 * t * t * t)
        : t < 2.0           ? 0.25 * (2.0 - t) * (2.0 - t) * (2.0 - t)
                            : 0.0;
    }
  }
  return bumps;
}

} // namespace bindpose
