// Optimized centers of rotation (Le and Hodgins 2016), accelerated by grouping elements.
//
// The similarity of weights is a sum over pairs of handles. The term of a pair is a smooth function
// of only two weights. Therefore, for each pair, elements that have nearly the same two weights are
// grouped, whatever their other weights are. Each group contributes one term. A pair of weights is
// a point in a plane. A set of elements is split in two along the weight with the larger range,
// until the ranges of both weights are at most the group size. With twenty handles of global
// influence, almost no two elements have similar rows of weights, but hundreds of elements have
// similar pairs of weights.
//
// The groups of each pair are contiguous. The groups of a pair are computed from all elements in
// which both handles have a weight. For a vertex at which both handles have a weight, the sum runs
// over these groups, eight per step.
#include "skinning/rotation_centers.h"

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
// Number of vertices per block; small, so that a cancel request is noticed quickly.
constexpr Index vertices_per_block = 16;
constexpr Index element_block = 4096;
constexpr Index lanes = 8;

/// An element in which both handles of a pair have a weight.
struct PairElement
{
  double weights[2]; ///< weights of the two handles, averaged over the element's corners
  double amount; ///< size of the element (volume or area) * weights[0] * weights[1]
  Index element;
};

/// The groups of elements in which both handles of a pair have a weight. The arrays are padded to
/// whole lanes with groups of amount zero.
struct PairGroups
{
  /// Mean weights of the pair's first and second handle over the elements of each group, divided by
  /// the width of the similarity function.
  std::vector<double> first, second;
  std::vector<double> amount; ///< sum of PairElement::amount over the elements
  std::vector<double> x, y, z; ///< sum of amount * centroid over the elements
  Index count = 0;

  void add(double a, double b, double total_amount, const Vec3& moment)
  {
    this->first.push_back(a);
    this->second.push_back(b);
    this->amount.push_back(total_amount);
    this->x.push_back(moment[0]);
    this->y.push_back(moment[1]);
    this->z.push_back(moment[2]);
  }
  void pad()
  {
    this->count = static_cast<Index>(this->first.size());
    while (static_cast<Index>(this->first.size()) % lanes != 0)
    {
      this->add(0.0, 0.0, 0.0, Vec3::Zero());
    }
  }
};

/// Sums of the groups' amounts and moments, weighted by similarity.
struct Sums
{
  double amount = 0.0;
  Vec3 moment = Vec3::Zero();
};

/// Return exp(-u) for u >= 0 with a relative error of about 1e-13; 0 if u >= 690 (about 1e-300).
BINDPOSE_ALWAYS_INLINE double decay(double u)
{
  constexpr double log2_e = 1.4426950408889634, ln2_high = 6.93145751953125e-1,
                   ln2_low = 1.42860682030941723212e-6;
  // Adding this constant rounds to the nearest integer, which is then in the low bits.
  constexpr double rounding_constant = 0x1.8p52;
  const double x = u < 690.0 ? -u : -690.0;
  const double shifted = x * log2_e + rounding_constant;
  const double rounded = shifted - rounding_constant;
  const double r = (x - rounded * ln2_high) - rounded * ln2_low;
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
  std::uint64_t bits; // unsigned, so that a left shift that drops bits is defined
  std::memcpy(&bits, &shifted, sizeof(bits));
  bits = (bits + 1023) << 52; // 2^rounded
  double scale;
  std::memcpy(&scale, &bits, sizeof(scale));
  return u < 690.0 ? p * scale : 0.0;
}

/// Add the groups of a pair of handles to `sums`. The factor of each group is the similarity
/// between its two skinning weights and the skinning weights `a` and `b` of a vertex. The weights
/// of the groups are already divided by the width of the similarity function.
BINDPOSE_SIMD_CLONES void add_similar(
  const PairGroups& groups, double a, double b, double factor, Sums& sums)
{
  alignas(64) double amount[lanes] = {}, x[lanes] = {}, y[lanes] = {}, z[lanes] = {};
  const auto count = static_cast<Index>(groups.first.size());
  const double *first = groups.first.data(), *second = groups.second.data();
  const double *group_amount = groups.amount.data(), *group_x = groups.x.data(),
               *group_y = groups.y.data(), *group_z = groups.z.data();
  for (Index g = 0; g < count; g += lanes)
  {
    for (Index i = 0; i < lanes; ++i)
    {
      const double d = a * second[g + i] - b * first[g + i];
      const double s = decay(d * d);
      amount[i] += s * group_amount[g + i];
      x[i] += s * group_x[g + i];
      y[i] += s * group_y[g + i];
      z[i] += s * group_z[g + i];
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

/// Partition elements[begin..end) at the middle of the interval of weights[0] or weights[1],
/// whichever interval is longer. Return the start of the second part. If neither interval is longer
/// than `limit`, the elements form one group: return `begin`.
std::size_t split(
  std::vector<PairElement>& elements, std::size_t begin, std::size_t end, double limit)
{
  double lower[2] = { elements[begin].weights[0], elements[begin].weights[1] };
  double upper[2] = { lower[0], lower[1] };
  for (std::size_t k = begin + 1; k < end; ++k)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      lower[axis] = std::min(lower[axis], elements[k].weights[axis]);
      upper[axis] = std::max(upper[axis], elements[k].weights[axis]);
    }
  }
  const int axis = upper[1] - lower[1] > upper[0] - lower[0] ? 1 : 0;
  if (!(upper[axis] - lower[axis] > limit))
  {
    return begin;
  }
  // If the ends of the interval are adjacent floating-point numbers, their mean may equal the upper
  // end. In this case the lower end is the cut, so that each part contains an element.
  const double half = 0.5 * (lower[axis] + upper[axis]);
  const double cut = half < upper[axis] ? half : lower[axis];
  const auto first = elements.begin();
  return static_cast<std::size_t>(
    std::stable_partition(first + static_cast<std::ptrdiff_t>(begin),
      first + static_cast<std::ptrdiff_t>(end),
      [&](const PairElement& element) { return element.weights[axis] <= cut; }) -
    first);
}

/// Group the elements of a pair of handles by their two weights, and sum each group.
PairGroups groups_of(std::vector<PairElement>& elements, const Points& centroids,
  const RotationCentersOptions& options)
{
  PairGroups groups;
  std::vector<std::pair<std::size_t, std::size_t>> pending_ranges;
  if (!elements.empty())
  {
    pending_ranges.emplace_back(0, elements.size());
  }
  while (!pending_ranges.empty())
  {
    const auto [begin, end] = pending_ranges.back();
    pending_ranges.pop_back();
    const std::size_t middle = split(elements, begin, end, options.group_size);
    if (middle > begin)
    {
      pending_ranges.emplace_back(middle, end);
      pending_ranges.emplace_back(begin, middle);
      continue;
    }
    double amount = 0.0, first = 0.0, second = 0.0;
    Vec3 moment = Vec3::Zero();
    for (std::size_t k = begin; k < end; ++k)
    {
      const PairElement& element = elements[k];
      amount += element.amount;
      first += element.amount * element.weights[0];
      second += element.amount * element.weights[1];
      moment += element.amount * centroids.row(element.element).transpose();
    }
    if (amount > 0.0)
    {
      groups.add(first / amount / options.width, second / amount / options.width, amount, moment);
    }
  }
  groups.pad();
  return groups;
}

Status check(const RotationCentersOptions& options, PointsView points, WeightsView weights)
{
  if (!(options.width > 0.0) ||
    !(options.smallest_weight >= 0.0 && options.smallest_weight < 1.0) ||
    !(options.smallest_pair >= 0.0 && options.smallest_pair < 1.0) || !(options.group_size >= 0.0))
  {
    return Status::invalid_input(
      "centers of rotation: expected a width > 0, smallest_weight and smallest_pair from 0 to less "
      "than 1, and a group size >= 0");
  }
  if (weights.rows() != points.rows())
  {
    return Status::invalid_input("the weights have " + std::to_string(weights.rows()) +
      " rows, but there are " + std::to_string(points.rows()) + " vertices");
  }
  return weights.allFinite() ? Status() : Status::invalid_input("a weight is not a finite number");
}

/// Return the index of the pair of handles j < k in an array of all pairs.
Index pair_of(Index j, Index k, Index handles)
{
  return j * handles - j * (j + 1) / 2 + k - j - 1;
}

template <typename Elements>
Status find_centers(ExecutionContext& context, const RotationCentersOptions& options,
  PointsView points, const Elements& elements, WeightsView weights, Points& centers)
{
  Status valid = check(options, points, weights);
  if (!valid.ok())
  {
    return valid;
  }
  constexpr int corners = Elements::ColsAtCompileTime;
  const Index handles = weights.cols(), count = elements.rows();
  const double smallest = std::max(options.smallest_weight, 1e-300);
  centers = points;

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
  Points centroids = Points::Zero(count, 3);
  {
    const ProgressRange range(context, 0.0, 0.02);
    if (!parallel_for(context, count, element_block, gather))
    {
      return Status::canceled();
    }
  }
  // For each handle: the elements in which it has a weight.
  std::vector<std::vector<Index>> elements_of_handle(static_cast<std::size_t>(handles));
  for (Index e = 0; e < count; ++e)
  {
    for (Index j = 0; j < handles && sizes[static_cast<std::size_t>(e)] > 0.0; ++j)
    {
      if (means(e, j) > smallest)
      {
        elements_of_handle[static_cast<std::size_t>(j)].push_back(e);
      }
    }
    for (int c = 0; c < corners; ++c)
    {
      centroids.row(e) += points.row(elements(e, c)) / corners;
    }
  }
  const Index pair_count = handles * (handles - 1) / 2;
  std::vector<PairGroups> pairs(static_cast<std::size_t>(pair_count));
  std::vector<std::pair<Index, Index>> handle_pairs;
  for (Index j = 0; j < handles; ++j)
  {
    for (Index k = j + 1; k < handles; ++k)
    {
      handle_pairs.emplace_back(j, k);
    }
  }
  {
    const ProgressRange range(context, 0.02, 0.3);
    const bool done = parallel_for(context, pair_count, 1,
      [&](Index from, Index to)
      {
        std::vector<PairElement> pair_elements;
        for (Index p = from; p < to; ++p)
        {
          const auto [j, k] = handle_pairs[static_cast<std::size_t>(p)];
          pair_elements.clear();
          for (const Index e : elements_of_handle[static_cast<std::size_t>(j)])
          {
            const double a = means(e, j), b = means(e, k);
            if (b > smallest)
            {
              pair_elements.push_back({ { a, b }, sizes[static_cast<std::size_t>(e)] * a * b, e });
            }
          }
          pairs[static_cast<std::size_t>(p)] = groups_of(pair_elements, centroids, options);
        }
      });
    if (!done)
    {
      return Status::canceled();
    }
  }
  Index groups = 0;
  for (const PairGroups& pair : pairs)
  {
    groups += pair.count;
  }

  std::vector<char> found(static_cast<std::size_t>(points.rows()), 0);
  const ProgressRange range(context, 0.3, 1.0);
  const bool done = parallel_for(context, points.rows(), vertices_per_block,
    [&](Index from, Index to)
    {
      std::vector<Index> influences;
      for (Index v = from; v < to; ++v)
      {
        influences.clear();
        for (Index j = 0; j < handles; ++j)
        {
          if (weights(v, j) > smallest)
          {
            influences.push_back(j);
          }
        }
        // The largest product is the product of the two largest weights.
        double largest = 0.0, second_largest = 0.0;
        for (const Index j : influences)
        {
          second_largest = std::max(second_largest, std::min(largest, weights(v, j)));
          largest = std::max(largest, weights(v, j));
        }
        const double threshold = options.smallest_pair * largest * second_largest;
        Sums sums;
        for (std::size_t a = 0; a < influences.size(); ++a)
        {
          for (std::size_t b = a + 1; b < influences.size(); ++b)
          {
            const double first = weights(v, influences[a]), second = weights(v, influences[b]);
            if (first * second >= threshold)
            {
              add_similar(
                pairs[static_cast<std::size_t>(pair_of(influences[a], influences[b], handles))],
                first, second, first * second, sums);
            }
          }
        }
        if (sums.amount > 1e-300)
        {
          centers.row(v) = (sums.moment / sums.amount).transpose();
          found[static_cast<std::size_t>(v)] = 1;
        }
      }
    });
  if (!done)
  {
    return Status::canceled();
  }
  Status status;
  status.report.set("counts.groups", groups);
  status.report.set(
    "counts.centers", static_cast<Index>(std::count(found.begin(), found.end(), char(1))));
  return status;
}
} // namespace

Status rotation_centers(ExecutionContext& context, const RotationCentersOptions& options,
  PointsView points, TetsView tets, WeightsView weights, Points& centers)
{
  return find_centers(context, options, points, tets, weights, centers);
}

Status rotation_centers(ExecutionContext& context, const RotationCentersOptions& options,
  PointsView points, TrianglesView triangles, WeightsView weights, Points& centers)
{
  return find_centers(context, options, points, triangles, weights, centers);
}

} // namespace bindpose
