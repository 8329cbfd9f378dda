// Similarity depends on weights only and is smooth in them, so elements of nearly the same weights
// are one term of the sum: weight space is halved, along the weight that differs most, until no
// box is larger than the group size. A group keeps its size (area or volume), centroid and mean
// weights, so that what is linear in the weights within it is exact.
//
// A pair of handles sees only groups that have both. Each pair has these side by side, and a vertex
// that has the pair runs over them, eight at once.
#include "pose/rotation_centres.h"

#include "base/parallel.h"
#include "base/simd.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace bindpose
{

namespace
{
constexpr Index block_size = 16; // vertices: a cancel is seen soon
constexpr Index element_block = 4096;
constexpr Index lanes = 8;

/// Elements of nearly the same weights.
struct Group
{
  double size = 0.0;
  Vec3 moment = Vec3::Zero(); ///< size times centroid
};

/// The groups that have both handles of a pair; the arrays are padded to whole lanes by groups of
/// size zero.
struct PairGroups
{
  std::vector<double> first, second; ///< mean weights
  std::vector<double> amount; ///< size * first * second
  std::vector<double> x, y, z; ///< amount * centroid

  void add(double a, double b, double size, const Vec3& centroid)
  {
    this->first.push_back(a);
    this->second.push_back(b);
    this->amount.push_back(size * a * b);
    this->x.push_back(size * a * b * centroid[0]);
    this->y.push_back(size * a * b * centroid[1]);
    this->z.push_back(size * a * b * centroid[2]);
  }
  void pad()
  {
    while (static_cast<Index>(this->first.size()) % lanes != 0)
    {
      this->add(0.0, 0.0, 0.0, Vec3::Zero());
    }
  }
};

/// amount and moment of what is similar.
struct Sums
{
  double amount = 0.0;
  Vec3 moment = Vec3::Zero();
};

/// exp(-u) for u >= 0, to about 1e-13 of itself; 0 where it is less than 1e-300.
BINDPOSE_ALWAYS_INLINE double decay(double u)
{
  constexpr double log2_e = 1.4426950408889634, ln2_high = 6.93145751953125e-1,
                   ln2_low = 1.42860682030941723212e-6;
  constexpr double rounder = 0x1.8p52; // its sum's low bits are the nearest whole number
  const double x = u < 690.0 ? -u : -690.0;
  const double shifted = x * log2_e + rounder;
  const double whole = shifted - rounder;
  const double r = (x - whole * ln2_high) - whole * ln2_low;
  double p = 1.0 / 479001600.0;
  p = p * r + 1.0 / 39916800.0;
  p = p * r + 1.0 / 3628800.0;
  p = p * r + 1.0 / 362880.0;
  p = p * r + 1.0 / 40320.0;
  p = p * r + 1.0 / 5040.0;
  p = p * r + 1.0 / 720.0;
  p = p * r + 1.0 / 120.0;
  p = p * r + 1.0 / 24.0;
  p = p * r + 1.0 / 6.0;
  p = p * r + 0.5;
  p = p * r + 1.0;
  p = p * r + 1.0;
  std::int64_t bits;
  std::memcpy(&bits, &shifted, sizeof(bits));
  bits = (bits + 1023) << 52; // 2^whole
  double scale;
  std::memcpy(&scale, &bits, sizeof(scale));
  return u < 690.0 ? p * scale : 0.0;
}

/// Adds the groups of a pair of handles to what is similar to weights a and b, over the width, of
/// these.
BINDPOSE_SIMD_CLONES void add_similar(
  const PairGroups& groups, double a, double b, double factor, Sums& sums)
{
  alignas(64) double amount[lanes] = {}, x[lanes] = {}, y[lanes] = {}, z[lanes] = {};
  const auto count = static_cast<Index>(groups.first.size());
  const double *first = groups.first.data(), *second = groups.second.data();
  const double *of_amount = groups.amount.data(), *of_x = groups.x.data(), *of_y = groups.y.data(),
               *of_z = groups.z.data();
  for (Index g = 0; g < count; g += lanes)
  {
    for (Index i = 0; i < lanes; ++i)
    {
      const double d = a * second[g + i] - b * first[g + i];
      const double s = decay(d * d);
      amount[i] += s * of_amount[g + i];
      x[i] += s * of_x[g + i];
      y[i] += s * of_y[g + i];
      z[i] += s * of_z[g + i];
    }
  }
  for (Index i = 0; i < lanes; ++i)
  {
    sums.amount += factor * amount[i];
    sums.moment += factor * Vec3(x[i], y[i], z[i]);
  }
}

double size_of(PointsView points, const Index* v, int corners)
{
  const Vec3 a = points.row(v[0]), b = points.row(v[1]), c = points.row(v[2]);
  return corners == 3 ? 0.5 * (b - a).cross(c - a).norm()
                      : std::abs(tet_volume(a, b, c, Vec3(points.row(v[3]))));
}

/// Puts elements of nearly the same weights together.
class Grouping
{
public:
  Grouping(Weights weights, const RotationCentresOptions& options)
    : weights_(std::move(weights)), limit_(options.group_size)
  {
  }

  /// Ranges of `order` that are groups.
  bool run(ExecutionContext& context, std::vector<Index>& order, std::vector<Index>& ends)
  {
    std::vector<std::pair<Index, Index>> open;
    if (!order.empty())
    {
      open.emplace_back(0, static_cast<Index>(order.size()));
    }
    Index done = 0;
    while (!open.empty())
    {
      const auto [begin, end] = open.back();
      open.pop_back();
      const Index middle = this->split(order, begin, end);
      if (middle > begin)
      {
        open.emplace_back(middle, end);
        open.emplace_back(begin, middle);
        continue;
      }
      ends.push_back(end);
      done += end - begin;
      context.progress(static_cast<double>(done) / static_cast<double>(order.size()));
      if (context.cancelled())
      {
        return false;
      }
    }
    return true;
  }

  const Weights& weights() const { return this->weights_; }

private:
  /// Where the second half begins; begin: there is none.
  Index split(std::vector<Index>& order, Index begin, Index end) const
  {
    Eigen::RowVectorXd lower = this->weights_.row(order[static_cast<std::size_t>(begin)]);
    Eigen::RowVectorXd upper = lower;
    for (Index k = begin + 1; k < end; ++k)
    {
      const auto row = this->weights_.row(order[static_cast<std::size_t>(k)]);
      lower = lower.cwiseMin(row);
      upper = upper.cwiseMax(row);
    }
    Index widest = 0;
    if (!((upper - lower).maxCoeff(&widest) > this->limit_))
    {
      return begin;
    }
    // Below the upper end even where both are neighbours, so that each half has an element.
    const double half = 0.5 * (lower[widest] + upper[widest]);
    const double cut = half < upper[widest] ? half : lower[widest];
    const auto middle = std::stable_partition(order.begin() + begin, order.begin() + end,
      [&](Index e) { return this->weights_(e, widest) <= cut; });
    return middle - order.begin();
  }

  Weights weights_;
  double limit_;
};

Status check(const RotationCentresOptions& options, PointsView points, WeightsView weights)
{
  if (!(options.width > 0.0) ||
    !(options.smallest_weight >= 0.0 && options.smallest_weight < 1.0) ||
    !(options.smallest_pair >= 0.0 && options.smallest_pair < 1.0) || !(options.group_size >= 0.0))
  {
    return Status::invalid_input(
      "the width must be above 0, the smallest weight and pair at least 0 and less "
      "than 1, and the group size at least 0");
  }
  if (weights.rows() != points.rows())
  {
    return Status::invalid_input("there are weights of " + std::to_string(weights.rows()) +
      " vertices for " + std::to_string(points.rows()));
  }
  return weights.allFinite() ? Status() : Status::invalid_input("a weight is not a finite number");
}

/// Pairs of handles j < k in a row.
Index pair_of(Index j, Index k, Index handles)
{
  return j * handles - j * (j + 1) / 2 + k - j - 1;
}

template <typename Elements>
Status find_centres(ExecutionContext& context, const RotationCentresOptions& options,
  PointsView points, const Elements& elements, WeightsView weights, Points& centres)
{
  const Status valid = check(options, points, weights);
  if (!valid.ok())
  {
    return valid;
  }
  constexpr int corners = Elements::ColsAtCompileTime;
  const Index handles = weights.cols(), count = elements.rows();
  const double smallest = std::max(options.smallest_weight, 1e-300);
  centres = points;

  Weights means(count, handles);
  std::vector<double> sizes(static_cast<std::size_t>(count));
  const auto gather = [&](Index begin, Index end)
  {
    for (Index e = begin; e < end; ++e)
    {
      means.row(e).setZero();
      for (int k = 0; k < corners; ++k)
      {
        means.row(e) += weights.row(elements(e, k)) / corners;
      }
      sizes[static_cast<std::size_t>(e)] = size_of(points, elements.data() + corners * e, corners);
    }
  };
  std::vector<Index> order, ends;
  {
    const ProgressRange range(context, 0.0, 0.02);
    if (!parallel_for(context, count, element_block, gather))
    {
      return Status::cancelled();
    }
  }
  for (Index e = 0; e < count; ++e)
  {
    // What has one handle only is similar to nothing.
    if (sizes[static_cast<std::size_t>(e)] > 0.0 && (means.row(e).array() > smallest).count() > 1)
    {
      order.push_back(e);
    }
  }
  Grouping grouping(std::move(means), options);
  {
    const ProgressRange range(context, 0.02, 0.1);
    if (!grouping.run(context, order, ends))
    {
      return Status::cancelled();
    }
  }

  std::vector<PairGroups> pairs(static_cast<std::size_t>(handles * (handles - 1) / 2));
  Index begin = 0;
  for (const Index end : ends)
  {
    Group group;
    Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(handles);
    for (Index k = begin; k < end; ++k)
    {
      const Index e = order[static_cast<std::size_t>(k)];
      const double size = sizes[static_cast<std::size_t>(e)];
      Vec3 centroid = Vec3::Zero();
      for (int c = 0; c < corners; ++c)
      {
        centroid += points.row(elements(e, c)).transpose() / corners;
      }
      group.size += size;
      group.moment += size * centroid;
      mean += size * grouping.weights().row(e);
    }
    begin = end;
    mean /= group.size;
    for (Index j = 0; j < handles; ++j)
    {
      for (Index k = j + 1; mean[j] > smallest && k < handles; ++k)
      {
        if (mean[k] > smallest)
        {
          pairs[static_cast<std::size_t>(pair_of(j, k, handles))].add(mean[j] / options.width,
            mean[k] / options.width, group.size, group.moment / group.size);
        }
      }
    }
  }
  for (PairGroups& pair : pairs)
  {
    pair.pad();
  }

  std::vector<char> found(static_cast<std::size_t>(points.rows()), 0);
  const ProgressRange range(context, 0.1, 1.0);
  const bool done = parallel_for(context, points.rows(), block_size,
    [&](Index from, Index to)
    {
      std::vector<Index> own;
      for (Index v = from; v < to; ++v)
      {
        own.clear();
        for (Index j = 0; j < handles; ++j)
        {
          if (weights(v, j) > smallest)
          {
            own.push_back(j);
          }
        }
        // The largest product is that of the two largest weights.
        double most = 0.0, second_most = 0.0;
        for (const Index j : own)
        {
          second_most = std::max(second_most, std::min(most, weights(v, j)));
          most = std::max(most, weights(v, j));
        }
        const double least = options.smallest_pair * most * second_most;
        Sums sums;
        for (std::size_t a = 0; a < own.size(); ++a)
        {
          for (std::size_t b = a + 1; b < own.size(); ++b)
          {
            const double first = weights(v, own[a]), second = weights(v, own[b]);
            if (first * second >= least)
            {
              add_similar(pairs[static_cast<std::size_t>(pair_of(own[a], own[b], handles))], first,
                second, first * second, sums);
            }
          }
        }
        if (sums.amount > 1e-300)
        {
          centres.row(v) = (sums.moment / sums.amount).transpose();
          found[static_cast<std::size_t>(v)] = 1;
        }
      }
    });
  if (!done)
  {
    return Status::cancelled();
  }
  Status status;
  status.report.set("counts.groups", static_cast<Index>(ends.size()));
  status.report.set(
    "counts.centers", static_cast<Index>(std::count(found.begin(), found.end(), char(1))));
  return status;
}
} // namespace

Status rotation_centres(ExecutionContext& context, const RotationCentresOptions& options,
  PointsView points, TetsView tets, WeightsView weights, Points& centres)
{
  return find_centres(context, options, points, tets, weights, centres);
}

Status rotation_centres(ExecutionContext& context, const RotationCentresOptions& options,
  PointsView points, TrianglesView triangles, WeightsView weights, Points& centres)
{
  return find_centres(context, options, points, triangles, weights, centres);
}

} // namespace bindpose
