// Fast multipole evaluation of the winding number of a point cloud (after Barill et al. 2018), with
// an error bound for every value.
//
// Each point p is a dipole. Its contribution at q is the derivative of the potential of a charge,
// -m . grad (1 / |p - q|), with m = area n / (4 pi). Points are sorted into a tree. Each box of the
// tree has multipoles about its center: sums of the derivatives of the regular solid harmonics
// along m. A query point descends the tree. Boxes that are far enough away contribute their
// multipoles; the points of near leaves are summed one by one.
//
// "Far enough" is defined as follows. Consider the harmonics of degree n of a dipole m at the
// offset y from the center of the box. At distance r their sum is at most n |m| |y|^(n-1) /
// r^(n+1), because the slope of a zonal harmonic |y|^n P_n is at most n |y|^(n-1) (inequality of
// Bernstein and Szego). Let A = sum |m| |y|^order, let R be the largest |y|, and let u = R / r < 1.
// Then the terms omitted after degree `order` are at most
//
//   A / r^(order+2) (order + 1 + u / (1 - u)) / (1 - u)
//
// A box is far enough if this bound is below a threshold, which is the same for all boxes. Each
// query also sums the bounds of the boxes that contribute multipoles. If the sum of the bounds
// exceeds the tolerance, the point is evaluated again, with the required distances multiplied by a
// power of (sum / tolerance). Therefore the error is within the tolerance at every point. The build
// chooses the threshold so that almost no points are evaluated again.
//
// Eight boxes or points are processed in parallel, in lanes that are independent until the final
// sums, so that all machines compute the same bits.
#include "winding/point_cloud_winding_number.h"

#include "base/constants.h"
#include "base/parallel.h"
#include "base/simd.h"
#include "solid_angle/solid_harmonics.h"
#include "winding/exact_frame.h"
#include "winding/point_areas.h"
#include "winding/point_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace bindpose
{

namespace
{
using Id = PointTree::Id;
/// Up to this many points the plain sum takes no more time than the tree.
constexpr Index direct_sum_points = 3000;
constexpr Id leaf_size = 32;
/// Beyond this distance from the origin, in units of the cloud's size, the winding number is 0 in
/// double precision.
constexpr double farthest = 1e100;
/// Limit for the moments, so that no sum overflows.
constexpr double largest_moment = 1e100;
/// Minimum distance at which multipoles are evaluated. At smaller distances r the powers of 1 / r
/// would overflow.
constexpr double nearest_multipole = 1e-12;

struct CloudTuning
{
  double tolerance;
  int order;
};
/// Order of the multipoles for each tolerance, measured on 100k points.
constexpr CloudTuning cloud_tunings[] = { { 1e-2, 6 }, { 1e-3, 8 }, { 1e-5, 10 }, { 0.0, 12 } };

/// Eight points with m = area n / (4 pi). An unused lane contains a copy of another point, with m
/// set to 0.
struct Dipoles
{
  HarmonicLanes at[3];
  HarmonicLanes moment[3];
};

/// Eight boxes of the tree.
struct Boxes
{
  HarmonicLanes center[3];
  /// Multipoles are used beyond this squared distance; infinite in an unused lane.
  HarmonicLanes squared_reach;
  HarmonicLanes bound; ///< bound of the omitted terms at distance r, times r^(order+2)
  Id first_block[harmonic_lanes]; ///< first block of the dipoles in the box
  Id block_count[harmonic_lanes];
  Id group[harmonic_lanes]; ///< group that contains the children of the box; -1: a leaf
};

/// The size of a box and of its moments. They determine the distance beyond which the box's
/// multipoles are used (see far_distance()).
struct Extent
{
  double radius = 0.0; ///< distance of the farthest point from the center
  double power = 0.0; ///< the number A of the error bound in the comment at the top of the file
};

/// Return the number of moments per box. A moment is the real or imaginary part of a coefficient;
/// the imaginary parts for m = 0 are omitted.
constexpr Index moment_count(int order)
{
  return (order + 1) * (order + 1) - 1;
}

using Mask __attribute__((vector_size(64))) = std::int64_t;

double sum_lanes(const HarmonicLanes& lanes)
{
  const double(&l)[harmonic_lanes] = lanes.lane;
  return ((l[0] + l[1]) + (l[2] + l[3])) + ((l[4] + l[5]) + (l[6] + l[7]));
}

/// Add the contributions of the dipoles to `sums`. Dipoles that coincide with q add nothing and set
/// `touching`.
BINDPOSE_SIMD_CLONES void add_dipoles(const Dipoles* dipoles, Index count, const double (&q)[3],
  double squared_tolerance, HarmonicLanes& sums, bool& touching)
{
  HarmonicPack sum = pack(sums);
  Mask touched{};
  for (const Dipoles* d = dipoles; d != dipoles + count; ++d)
  {
    const HarmonicPack x = pack(d->at[0]) - q[0];
    const HarmonicPack y = pack(d->at[1]) - q[1];
    const HarmonicPack z = pack(d->at[2]) - q[2];
    const HarmonicPack squared = x * x + y * y + z * z;
    HarmonicLanes root;
    for (int i = 0; i < harmonic_lanes; ++i)
    {
      root.lane[i] = __builtin_sqrt(squared[i]);
    }
    const HarmonicPack contribution =
      (x * pack(d->moment[0]) + y * pack(d->moment[1]) + z * pack(d->moment[2])) /
      (squared * pack(root));
    const Mask touches = squared <= squared_tolerance;
    sum += touches ? HarmonicPack{} : contribution;
    touched |= touches;
  }
  reinterpret_cast<HarmonicPack&>(sums) = sum;
  for (int i = 0; i < harmonic_lanes; ++i)
  {
    touching = touching || touched[i] != 0;
  }
}

/// Add the contributions of the dipoles to the gradient `sums`. Dipoles that coincide with q add
/// nothing.
BINDPOSE_SIMD_CLONES void add_dipole_gradients(const Dipoles* dipoles, Index count,
  const double (&q)[3], double squared_tolerance, HarmonicLanes (&sums)[3])
{
  for (const Dipoles* d = dipoles; d != dipoles + count; ++d)
  {
    HarmonicPack at[3];
    HarmonicPack squared{}, along{};
    for (int k = 0; k < 3; ++k)
    {
      at[k] = pack(d->at[k]) - q[k];
      squared += at[k] * at[k];
      along += at[k] * pack(d->moment[k]);
    }
    HarmonicLanes root;
    for (int i = 0; i < harmonic_lanes; ++i)
    {
      root.lane[i] = __builtin_sqrt(squared[i]);
    }
    const HarmonicPack inverse = 1.0 / (squared * pack(root));
    const HarmonicPack steep = 3.0 * along / squared;
    const Mask touches = squared <= squared_tolerance;
    for (int k = 0; k < 3; ++k)
    {
      const HarmonicPack contribution = (steep * at[k] - pack(d->moment[k])) * inverse;
      reinterpret_cast<HarmonicPack&>(sums[k]) += touches ? HarmonicPack{} : contribution;
    }
  }
}

/// Return a bit mask of the boxes that are far enough away. `from` is set to the positions of q
/// relative to the centers of the boxes. The bounds of the omitted terms are added to `bounds`.
BINDPOSE_SIMD_CLONES unsigned far_boxes(const Boxes& boxes, const double (&q)[3], int order,
  double squared_stretch, HarmonicLanes (&from)[3], HarmonicLanes& bounds)
{
  HarmonicPack squared{};
  for (int k = 0; k < 3; ++k)
  {
    const HarmonicPack x = q[k] - pack(boxes.center[k]);
    reinterpret_cast<HarmonicPack&>(from[k]) = x;
    squared += x * x;
  }
  const Mask is_far = squared > pack(boxes.squared_reach) * squared_stretch;
  const HarmonicPack inverse = 1.0 / squared;
  HarmonicPack bound = pack(boxes.bound);
  for (int k = 0; k < order + 2; k += 2)
  {
    bound *= inverse;
  }
  reinterpret_cast<HarmonicPack&>(bounds) += is_far ? bound : HarmonicPack{};
  unsigned bits = 0;
  for (int i = 0; i < harmonic_lanes; ++i)
  {
    bits |= is_far[i] != 0 ? 1u << i : 0u;
  }
  return bits;
}

/// Evaluate the multipoles of the boxes whose bit is set in `bits`, and add the values to `sums`.
BINDPOSE_SIMD_CLONES void add_multipoles(int order, const HarmonicLanes* moments,
  const Harmonics& harmonics, unsigned bits, HarmonicLanes& sums)
{
  HarmonicPack sum{};
  for (int n = 1; n <= order; ++n)
  {
    const int row = harmonic_index(n, 0);
    sum += pack(*moments++) * pack(harmonics.real[row]);
    for (int m = 1; m <= n; ++m)
    {
      sum += pack(*moments++) * pack(harmonics.real[row + m]);
      sum += pack(*moments++) * pack(harmonics.imaginary[row + m]);
    }
  }
  for (int i = 0; i < harmonic_lanes; ++i)
  {
    // The sum of a near box may be infinite, and 0 times infinity is NaN. Therefore near boxes are
    // excluded by a condition, not by a factor 0.
    sums.lane[i] += bits >> i & 1u ? sum[i] : 0.0;
  }
}

/// Evaluate the gradients of the multipoles of the boxes whose bit is set in `bits`, and add the
/// gradients to `sums`. `harmonics` must contain the irregular harmonics T up to degree order + 1,
/// because the derivatives of T(n, m) are d/dz T(n, m) = -T(n+1, m) and
/// (d/dx + i d/dy) T(n, m) = -T(n+1, m+1).
BINDPOSE_SIMD_CLONES void add_multipole_gradients(int order, const HarmonicLanes* moments,
  const Harmonics& harmonics, unsigned bits, HarmonicLanes (&sums)[3])
{
  HarmonicPack sum[3] = {};
  for (int n = 1; n <= order; ++n)
  {
    const HarmonicLanes* const real = harmonics.real + harmonic_index(n + 1, 0);
    const HarmonicLanes* const imaginary = harmonics.imaginary + harmonic_index(n + 1, 0);
    const HarmonicPack zonal = pack(*moments++);
    sum[0] -= zonal * pack(real[1]);
    sum[1] -= zonal * pack(imaginary[1]);
    sum[2] -= zonal * pack(real[0]);
    for (int m = 1; m <= n; ++m)
    {
      const HarmonicPack re = pack(*moments++);
      const HarmonicPack im = pack(*moments++);
      sum[0] += 0.5 *
        (re * (pack(real[m - 1]) - pack(real[m + 1])) +
          im * (pack(imaginary[m - 1]) - pack(imaginary[m + 1])));
      sum[1] += 0.5 *
        (im * (pack(real[m - 1]) + pack(real[m + 1])) -
          re * (pack(imaginary[m - 1]) + pack(imaginary[m + 1])));
      sum[2] -= re * pack(real[m]) + im * pack(imaginary[m]);
    }
  }
  for (int k = 0; k < 3; ++k)
  {
    for (int i = 0; i < harmonic_lanes; ++i)
    {
      sums[k].lane[i] += bits >> i & 1u ? sum[k][i] : 0.0;
    }
  }
}

/// Return the error bound at distance r (see the comment at the top of the file), times
/// r^(order+2).
double omitted_bound(const Extent& extent, int order, double r)
{
  const double u = extent.radius / r;
  return extent.power * (order + 1 + u / (1.0 - u)) / (1.0 - u);
}

/// Return the smallest distance at which the error bound of a box is below the threshold.
double far_distance(const Extent& extent, int order, double threshold)
{
  if (extent.power == 0.0)
  {
    return extent.radius;
  }
  const auto exceeds_threshold = [&](double r)
  { return omitted_bound(extent, order, r) / std::pow(r, order + 2) > threshold; };
  double upper = 2.0 * extent.radius;
  while (exceeds_threshold(upper))
  {
    upper *= 2.0;
  }
  double lower = extent.radius;
  constexpr double precise_enough = 1e-3;
  while (upper - lower > precise_enough * upper)
  {
    const double middle = 0.5 * (lower + upper);
    (exceeds_threshold(middle) ? lower : upper) = middle;
  }
  return upper;
}

Status check_input(PointsView points, PointsView normals, NumbersView areas,
  const PointCloudWindingNumber::Options& options)
{
  const Index count = points.rows();
  if (normals.rows() != count || (areas.size() != 0 && areas.size() != count))
  {
    return Status::invalid_input("a cloud of " + std::to_string(count) +
      " points must have one normal per point (and one area per point if areas are given), not " +
      std::to_string(normals.rows()) + " normals and " + std::to_string(areas.size()) + " areas");
  }
  if (count > std::numeric_limits<Id>::max() / 4)
  {
    return Status::invalid_input(
      "the cloud has " + std::to_string(count) + " points: expected fewer than 2^29");
  }
  for (Index i = 0; i < count; ++i)
  {
    const auto invalid_point = [i](const std::string& problem)
    { return Status::invalid_input("point " + std::to_string(i) + " has " + problem); };
    if (!points.row(i).allFinite())
    {
      return invalid_point("a coordinate that is not a finite number");
    }
    if (!normals.row(i).allFinite())
    {
      return invalid_point("a normal that is not a finite number");
    }
    if (areas.size() != 0 && !(areas[i] >= 0.0 && std::isfinite(areas[i])))
    {
      std::ostringstream text;
      text << "the area " << areas[i] << "; areas must be finite and at least 0";
      return invalid_point(text.str());
    }
  }
  if (count == 1 && areas.size() == 0)
  {
    return Status::invalid_input("the area of a single point cannot be estimated because it has no "
                                 "neighbors; provide the area");
  }
  if (options.method == WindingMethod::hierarchical || options.method == WindingMethod::crossings)
  {
    return Status::invalid_input(std::string("the method ") + to_string(options.method) +
      " can only be used for triangles; use fast or direct for points");
  }
  if (!(options.tolerance >= 1e-8 && options.tolerance <= 0.1))
  {
    std::ostringstream text;
    text << "the tolerance must be from 1e-8 to 0.1, not " << options.tolerance;
    return Status::invalid_input(text.str());
  }
  if (options.area_neighbors < 3 || options.area_neighbors > 64)
  {
    return Status::invalid_input(
      "area_neighbors must be from 3 to 64, not " + std::to_string(options.area_neighbors));
  }
  return {};
}

/// Return the normals scaled to length 1. Normals of length 0 stay 0; their number is written to
/// `zero_normals`.
Points directions(PointsView normals, Index& zero_normals)
{
  Points unit(normals.rows(), 3);
  for (Index i = 0; i < normals.rows(); ++i)
  {
    const double length = normals.row(i).stableNorm();
    zero_normals += length == 0.0;
    if (length > 0.0)
    {
      unit.row(i) = normals.row(i).stableNormalized();
    }
    else
    {
      unit.row(i).setZero();
    }
  }
  return unit;
}
} // namespace

struct PointCloudWindingNumber::Impl
{
  Status status;
  WindingMethod method = WindingMethod::direct;
  ExactFrame frame;
  Eigen::VectorXd areas;
  std::vector<Dipoles> dipoles; ///< the points in the order of the tree, eight per entry
  int order = 0; ///< degree of the multipoles, even
  double tolerance = 0.0;
  std::vector<Boxes> boxes; ///< one entry per group of the tree
  std::vector<HarmonicLanes> moments; ///< multipole moments of each group
  std::vector<Extent> extents; ///< eight extents per group; used by the build only

  void store_dipoles(const Points& points, const Points& point_moments, const PointTree& tree);
  bool find_multipoles(ExecutionContext& context, const PointTree& tree);
  void find_multipole(const PointTree::Group& group, Index number, Harmonics (&workspace)[2]);
  bool find_far_distances(ExecutionContext& context, double threshold);
  bool find_threshold(ExecutionContext& context, const Points& sample_points);
  double measured_error(ExecutionContext& context, const Points& sample_points) const;
  Points sample(const PointTree& tree) const;

  bool can_be_nonzero(const Vec3& framed) const;
  template <typename Far, typename Near>
  double visit(const Vec3& framed, double squared_stretch, const Far& far, const Near& near) const;
  template <typename Try>
  void repeat_until_tolerance(const Try& attempt) const;
  double plain_sum(const Vec3& framed, bool& touches) const;
  double tree_sum(const Vec3& framed, bool& touches) const;
  double at(const Vec3& query, bool exactly, bool& touches) const;
  Vec3 plain_gradient(const Vec3& framed) const;
  Vec3 tree_gradient(const Vec3& framed) const;
  Vec3 gradient_at(const Vec3& query) const;
};

PointCloudWindingNumber::PointCloudWindingNumber() : impl_(new Impl) {}
PointCloudWindingNumber::~PointCloudWindingNumber() = default;
PointCloudWindingNumber::PointCloudWindingNumber(PointCloudWindingNumber&&) noexcept = default;
PointCloudWindingNumber& PointCloudWindingNumber::operator=(
  PointCloudWindingNumber&&) noexcept = default;

// ---- Building ----------------------------------------------------------------------------------

/// Call far(group, from, bits) for each group that has far boxes. `bits` is the bit mask of these
/// boxes, and `from` contains the positions of p relative to the centers of the group's eight
/// boxes. Call near(first block, block count) for each near leaf. Return the sum of the error
/// bounds of the multipoles.
template <typename Far, typename Near>
double PointCloudWindingNumber::Impl::visit(
  const Vec3& p, double squared_stretch, const Far& far, const Near& near) const
{
  HarmonicLanes bounds{};
  const double q[3] = { p[0], p[1], p[2] };
  // Each level leaves at most seven groups on the stack; a tree of 2^29 points has ten levels.
  Id stack[128];
  int stack_size = 0;
  stack[stack_size++] = 0;
  while (stack_size > 0)
  {
    const Id number = stack[--stack_size];
    const Boxes& box = this->boxes[number];
    HarmonicLanes from[3];
    const unsigned far_mask = far_boxes(box, q, this->order, squared_stretch, from, bounds);
    if (far_mask != 0)
    {
      far(number, from, far_mask);
    }
    for (int c = 0; c < harmonic_lanes; ++c)
    {
      if (far_mask >> c & 1u)
      {
        continue;
      }
      if (box.group[c] >= 0)
      {
        stack[stack_size++] = box.group[c];
      }
      else if (box.block_count[c] > 0)
      {
        near(box.first_block[c], box.block_count[c]);
      }
    }
  }
  return sum_lanes(bounds);
}

/// Call `attempt` until the error bound that it returns is within the tolerance. The required
/// distance of far boxes is increased before each further call.
template <typename Try>
void PointCloudWindingNumber::Impl::repeat_until_tolerance(const Try& attempt) const
{
  double squared_stretch = 1.0;
  for (;;)
  {
    const double error_bound = attempt(squared_stretch);
    if (error_bound <= this->tolerance)
    {
      return;
    }
    // The error bound of a box decreases with the distance d at least as fast as 1 / d^(order + 2).
    // The error bounds of the children of the box are smaller. Therefore the required distances are
    // multiplied by (error_bound / tolerance)^(1 / (order + 2)), apart from the margin.
    constexpr double margin = 1.05;
    squared_stretch *= margin * std::pow(error_bound / this->tolerance, 2.0 / (this->order + 2));
  }
}

void PointCloudWindingNumber::Impl::store_dipoles(
  const Points& points, const Points& point_moments, const PointTree& tree)
{
  const std::vector<Id>& ids = tree.order();
  this->dipoles.resize((ids.size() + harmonic_lanes - 1) / harmonic_lanes);
  for (std::size_t i = 0; i < this->dipoles.size() * harmonic_lanes; ++i)
  {
    const Id id = ids[std::min(i, ids.size() - 1)];
    Dipoles& block = this->dipoles[i / harmonic_lanes];
    for (int k = 0; k < 3; ++k)
    {
      block.at[k].lane[i % harmonic_lanes] = points(id, k);
      block.moment[k].lane[i % harmonic_lanes] = i < ids.size() ? point_moments(id, k) : 0.0;
    }
  }
}

bool PointCloudWindingNumber::Impl::find_multipoles(
  ExecutionContext& context, const PointTree& tree)
{
  const std::size_t groups = tree.groups().size();
  this->boxes.resize(groups);
  this->moments.resize(groups * static_cast<std::size_t>(moment_count(this->order)));
  this->extents.resize(groups * harmonic_lanes);
  constexpr Index block = 16;
  return parallel_for(context, static_cast<Index>(groups), block,
    [&](Index begin, Index end)
    {
      const auto workspace = std::make_unique<Harmonics[][2]>(1);
      for (Index g = begin; g < end; ++g)
      {
        this->find_multipole(tree.groups()[g], g, workspace[0]);
      }
    });
}

void PointCloudWindingNumber::Impl::find_multipole(
  const PointTree::Group& group, Index number, Harmonics (&workspace)[2])
{
  Boxes& box = this->boxes[number];
  HarmonicLanes* out = &this->moments[number * moment_count(this->order)];
  for (int c = 0; c < harmonic_lanes; ++c)
  {
    if (c >= group.size)
    {
      box.squared_reach.lane[c] = std::numeric_limits<double>::infinity();
      box.first_block[c] = box.block_count[c] = 0;
      box.group[c] = -1;
      continue;
    }
    const PointTree::Child& child = group.children[c];
    box.first_block[c] = child.first / harmonic_lanes;
    box.block_count[c] = (child.count + harmonic_lanes - 1) / harmonic_lanes;
    box.group[c] = child.group;
    const Dipoles* begin = &this->dipoles[box.first_block[c]];
    const Dipoles* end = begin + box.block_count[c];

    // The center is the mean of the points, weighted by the size of their moments. This makes the
    // omitted terms small.
    const auto for_each_dipole = [&](const auto& body)
    {
      for (const Dipoles* d = begin; d != end; ++d)
      {
        for (int i = 0; i < harmonic_lanes; ++i)
        {
          body(Vec3(d->at[0].lane[i], d->at[1].lane[i], d->at[2].lane[i]),
            Vec3(d->moment[0].lane[i], d->moment[1].lane[i], d->moment[2].lane[i]).norm());
        }
      }
    };
    Vec3 center = Vec3::Zero();
    double weights = 0.0;
    for_each_dipole(
      [&](const Vec3& at, double weight)
      {
        center += weight * at;
        weights += weight;
      });
    center = weights > 0.0 ? Vec3(center / weights) : child.lower;
    center = center.cwiseMax(child.lower).cwiseMin(child.upper);
    Extent& extent = this->extents[number * harmonic_lanes + c];
    for_each_dipole(
      [&](const Vec3& at, double weight)
      {
        // The radius includes points without a moment, because a query point may touch such a
        // point. The descent must then reach the leaf that contains the touched point.
        const double distance = (at - center).norm();
        extent.radius = std::max(extent.radius, distance);
        extent.power += weight * std::pow(distance, this->order);
      });

    Harmonics& harmonics = workspace[0];
    Harmonics& sum = workspace[1];
    sum.clear(this->order);
    for (const Dipoles* d = begin; d != end; ++d)
    {
      HarmonicLanes at[3], normal[3];
      for (int k = 0; k < 3; ++k)
      {
        for (int i = 0; i < harmonic_lanes; ++i)
        {
          at[k].lane[i] = d->at[k].lane[i] - center[k];
          normal[k].lane[i] = -d->moment[k].lane[i];
        }
      }
      regular_harmonics(this->order - 1, at, harmonics);
      regular_derivative(this->order, harmonics, normal, sum);
    }
    for (int k = 0; k < 3; ++k)
    {
      box.center[k].lane[c] = center[k];
    }
    HarmonicLanes* to = out;
    for (int n = 1; n <= this->order; ++n)
    {
      (to++)->lane[c] = sum_lanes(sum.real[harmonic_index(n, 0)]);
      for (int m = 1; m <= n; ++m)
      {
        // The coefficients for m and -m have the same contribution, so only one of them is stored,
        // doubled.
        (to++)->lane[c] = 2.0 * sum_lanes(sum.real[harmonic_index(n, m)]);
        (to++)->lane[c] = 2.0 * sum_lanes(sum.imaginary[harmonic_index(n, m)]);
      }
    }
  }
}

bool PointCloudWindingNumber::Impl::find_far_distances(ExecutionContext& context, double threshold)
{
  constexpr Index block = 64;
  return parallel_for(context, static_cast<Index>(this->boxes.size()), block,
    [&](Index begin, Index end)
    {
      for (Index g = begin; g < end; ++g)
      {
        for (int c = 0; c < harmonic_lanes; ++c)
        {
          this->boxes[g].bound.lane[c] = 0.0;
          double& squared = this->boxes[g].squared_reach.lane[c];
          if (this->boxes[g].block_count[c] > 0)
          {
            const Extent& extent = this->extents[g * harmonic_lanes + c];
            const double reach = std::max({ far_distance(extent, this->order, threshold),
              extent.radius + 2.0 * this->frame.tolerance, nearest_multipole });
            squared = reach * reach;
            this->boxes[g].bound.lane[c] = omitted_bound(extent, this->order, reach);
          }
        }
      }
    });
}

/// Return sample points for measuring the error. Half of them are near points of the cloud, at
/// distances comparable with the point spacing. The other half are in and around the bounding box.
Points PointCloudWindingNumber::Impl::sample(const PointTree& tree) const
{
  constexpr Index count = 384;
  Points result(count, 3);
  std::uint64_t state = 1;
  const auto uniform = [&state]
  {
    // SplitMix64 generator.
    std::uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  };
  const auto random_in_cube = [&]
  {
    const double x = uniform(), y = uniform(), z = uniform();
    return Vec3(2.0 * x - 1.0, 2.0 * y - 1.0, 2.0 * z - 1.0);
  };
  Box box;
  for (const PointTree::Child& child : tree.groups()[0].children)
  {
    if (child.count > 0)
    {
      box.add(child.lower);
      box.add(child.upper);
    }
  }
  const auto points = static_cast<double>(tree.order().size());
  for (Index i = 0; i < count; ++i)
  {
    if (i % 2 == 0)
    {
      const auto dipole_index = static_cast<Index>(uniform() * points);
      const Dipoles& block = this->dipoles[dipole_index / harmonic_lanes];
      Vec3 lower = Vec3::Constant(farthest), upper = -lower, at;
      for (int k = 0; k < 3; ++k)
      {
        at[k] = block.at[k].lane[dipole_index % harmonic_lanes];
        for (int l = 0; l < harmonic_lanes; ++l)
        {
          lower[k] = std::min(lower[k], block.at[k].lane[l]);
          upper[k] = std::max(upper[k], block.at[k].lane[l]);
        }
      }
      const double distance = (upper - lower).norm() * std::exp2(4.0 * uniform() - 2.0);
      result.row(i) = (at + distance * random_in_cube()).transpose();
    }
    else
    {
      const double width = i % 4 == 1 ? 1.1 : 2.0;
      result.row(i) =
        (box.center() + 0.5 * width * random_in_cube().cwiseProduct(box.size())).transpose();
    }
  }
  return result;
}

/// Find a threshold such that the largest sum of the error bounds at `sample_points` is about 90 %
/// of the tolerance. Return false if canceled.
bool PointCloudWindingNumber::Impl::find_threshold(
  ExecutionContext& context, const Points& sample_points)
{
  // The error bound of each box is proportional to the threshold, and the number of boxes decreases
  // only slightly if the threshold increases. Therefore each round multiplies the threshold by the
  // intended sum of the error bounds divided by the largest sum.
  double threshold = this->tolerance / 32.0;
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round)
  {
    const ProgressRange range(context, round / (rounds + 1.0), (round + 1) / (rounds + 1.0));
    if (!this->find_far_distances(context, threshold))
    {
      return false;
    }
    std::vector<double> bounds(static_cast<std::size_t>(sample_points.rows()));
    constexpr Index block = 16;
    if (!parallel_for(context, sample_points.rows(), block,
          [&](Index begin, Index end)
          {
            for (Index i = begin; i < end; ++i)
            {
              bounds[i] = this->visit(
                sample_points.row(i), 1.0, [](Id, const auto&, unsigned) {}, [](Id, Id) {});
            }
          }))
    {
      return false;
    }
    const double largest = *std::max_element(bounds.begin(), bounds.end());
    constexpr double maximum_factor = 32.0;
    threshold *= std::clamp(
      0.9 * this->tolerance / std::max(largest, 1e-300), 1.0 / maximum_factor, maximum_factor);
  }
  const ProgressRange range(context, rounds / (rounds + 1.0), 1.0);
  return this->find_far_distances(context, threshold);
}

/// Return the largest difference from the plain sum at `sample_points`, or a negative number if
/// canceled.
double PointCloudWindingNumber::Impl::measured_error(
  ExecutionContext& context, const Points& sample_points) const
{
  std::vector<double> errors(static_cast<std::size_t>(sample_points.rows()));
  const bool done = parallel_for(context, sample_points.rows(), 1,
    [&](Index i, Index)
    {
      bool touches = false;
      const Vec3 sample_point = sample_points.row(i);
      errors[i] =
        std::abs(this->tree_sum(sample_point, touches) - this->plain_sum(sample_point, touches));
    });
  return done ? *std::max_element(errors.begin(), errors.end()) : -1.0;
}

Status PointCloudWindingNumber::build(ExecutionContext& context, PointsView points,
  PointsView normals, NumbersView areas, const Options& options)
{
  this->impl_.reset(new Impl);
  Impl& impl = *this->impl_;
  Status& status = impl.status;
  status = check_input(points, normals, areas, options);
  if (!status.ok())
  {
    return status;
  }
  const Index count = points.rows();
  Report& report = status.report;
  if (count == 0)
  {
    report.set("method", to_string(impl.method));
    report.set("counts.points", 0);
    status.warnings.emplace_back("the cloud has no points, so its winding number is 0 everywhere");
    return status;
  }
  impl.frame = ExactFrame(bounding_box(points));
  const double scale = impl.frame.scale;
  Points framed(count, 3);
  for (Index i = 0; i < count; ++i)
  {
    framed.row(i) = impl.frame(points.row(i)).transpose();
  }
  Index zero_normals = 0;
  Points moments = directions(normals, zero_normals);

  PointTree tree;
  bool done = true;
  {
    const ProgressRange range(context, 0.0, 0.2);
    done = tree.build(context, framed, leaf_size);
  }
  Eigen::VectorXd framed_areas;
  if (done && areas.size() == 0)
  {
    const ProgressRange range(context, 0.2, 0.6);
    done = estimate_point_areas(
      context, framed, moments, tree, options.area_neighbors, impl.frame.tolerance, framed_areas);
    impl.areas = framed_areas / scale / scale;
  }
  else if (done)
  {
    impl.areas = areas;
    framed_areas = impl.areas * scale * scale;
  }
  if (!done)
  {
    this->impl_.reset(new Impl);
    this->impl_->status = Status::canceled();
    return this->impl_->status;
  }

  double area = 0.0, volume = 0.0;
  Index zero_areas = 0;
  const Vec3 center = 0.5 * framed.colwise().minCoeff() + 0.5 * framed.colwise().maxCoeff();
  for (Index i = 0; i < count; ++i)
  {
    area += framed_areas[i];
    volume += framed_areas[i] * moments.row(i).dot(framed.row(i) - center.transpose()) / 3.0;
    zero_areas += framed_areas[i] == 0.0;
    moments.row(i) *= framed_areas[i] / four_pi;
  }
  if (!(area <= largest_moment))
  {
    this->impl_.reset(new Impl);
    this->impl_->status =
      Status::invalid_input("the areas are too large relative to the distances between the points");
    return this->impl_->status;
  }
  report.set("counts.points", count);
  report.set("counts.zero_normals", zero_normals);
  report.set("counts.zero_areas", zero_areas);
  report.set("area", area / scale / scale);
  report.set("spacing", std::sqrt(area / static_cast<double>(count)) / scale);
  report.set("volume", volume / scale / scale / scale);
  if (zero_normals > 0)
  {
    status.warnings.push_back(std::to_string(zero_normals) + " of " + std::to_string(count) +
      " points have a normal of length 0 and are ignored");
  }
  if (zero_areas > zero_normals && areas.size() == 0)
  {
    status.warnings.push_back(std::to_string(zero_areas) + " of " + std::to_string(count) +
      " points are ignored: their area is 0 because many points have the same position");
  }

  impl.store_dipoles(framed, moments, tree);
  impl.method = options.method == WindingMethod::fast ||
      (options.method == WindingMethod::automatic && count > direct_sum_points)
    ? WindingMethod::fast
    : WindingMethod::direct;
  std::string reason = "requested";
  if (options.method == WindingMethod::automatic)
  {
    reason = std::to_string(count) +
      (count > direct_sum_points ? " points: a direct sum would take longer"
                                 : " points: a direct sum is fastest for so few");
  }
  if (impl.method == WindingMethod::fast)
  {
    impl.tolerance = options.tolerance;
    for (const CloudTuning& tuning : cloud_tunings)
    {
      impl.order = tuning.order;
      if (options.tolerance >= tuning.tolerance)
      {
        break;
      }
    }
    {
      const ProgressRange range(context, 0.6, 0.8);
      done = impl.find_multipoles(context, tree);
    }
    const Points sample_points = done ? impl.sample(tree) : Points(0, 3);
    if (done)
    {
      const ProgressRange range(context, 0.8, 0.9);
      done = impl.find_threshold(context, sample_points);
    }
    if (done)
    {
      const ProgressRange range(context, 0.9, 1.0);
      const double error = impl.measured_error(context, sample_points);
      done = error >= 0.0;
      report.set("error_bound", options.tolerance);
      report.set("measured_error", error);
    }
    impl.extents = {};
  }
  report.set("method", to_string(impl.method));
  report.set("method_reason", reason);
  if (!done)
  {
    this->impl_.reset(new Impl);
    this->impl_->status = Status::canceled();
  }
  return this->impl_->status;
}

const Status& PointCloudWindingNumber::status() const
{
  return this->impl_->status;
}

WindingMethod PointCloudWindingNumber::method() const
{
  return this->impl_->method;
}

const Eigen::VectorXd& PointCloudWindingNumber::areas() const
{
  return this->impl_->areas;
}

Index PointCloudWindingNumber::memory() const
{
  const Impl& impl = *this->impl_;
  return static_cast<Index>(sizeof(double) * static_cast<std::size_t>(impl.areas.size()) +
    sizeof(Dipoles) * impl.dipoles.size() + sizeof(Boxes) * impl.boxes.size() +
    sizeof(HarmonicLanes) * impl.moments.size());
}

// ---- Evaluating --------------------------------------------------------------------------------

double PointCloudWindingNumber::Impl::plain_sum(const Vec3& p, bool& touches) const
{
  HarmonicLanes sums{};
  const double q[3] = { p[0], p[1], p[2] };
  add_dipoles(this->dipoles.data(), static_cast<Index>(this->dipoles.size()), q,
    this->frame.tolerance * this->frame.tolerance, sums, touches);
  return sum_lanes(sums);
}

double PointCloudWindingNumber::Impl::tree_sum(const Vec3& p, bool& touches) const
{
  const double q[3] = { p[0], p[1], p[2] };
  const double squared_tolerance = this->frame.tolerance * this->frame.tolerance;
  Harmonics harmonics;
  HarmonicLanes sums;
  this->repeat_until_tolerance(
    [&](double squared_stretch)
    {
      sums = {};
      return this->visit(
        p, squared_stretch,
        [&](Id number, const HarmonicLanes(&from)[3], unsigned bits)
        {
          irregular_harmonics(this->order, from, harmonics);
          add_multipoles(
            this->order, &this->moments[number * moment_count(this->order)], harmonics, bits, sums);
        },
        [&](Id first, Id count)
        { add_dipoles(&this->dipoles[first], count, q, squared_tolerance, sums, touches); });
    });
  return sum_lanes(sums);
}

Vec3 PointCloudWindingNumber::Impl::tree_gradient(const Vec3& p) const
{
  const double q[3] = { p[0], p[1], p[2] };
  const double squared_tolerance = this->frame.tolerance * this->frame.tolerance;
  Harmonics harmonics;
  HarmonicLanes sums[3];
  this->repeat_until_tolerance(
    [&](double squared_stretch)
    {
      std::fill_n(sums, 3, HarmonicLanes{});
      return this->visit(
        p, squared_stretch,
        [&](Id number, const HarmonicLanes(&from)[3], unsigned bits)
        {
          irregular_harmonics(this->order + 1, from, harmonics);
          add_multipole_gradients(
            this->order, &this->moments[number * moment_count(this->order)], harmonics, bits, sums);
        },
        [&](Id first, Id count)
        { add_dipole_gradients(&this->dipoles[first], count, q, squared_tolerance, sums); });
    });
  return { sum_lanes(sums[0]), sum_lanes(sums[1]), sum_lanes(sums[2]) };
}

Vec3 PointCloudWindingNumber::Impl::plain_gradient(const Vec3& p) const
{
  const double q[3] = { p[0], p[1], p[2] };
  HarmonicLanes sums[3] = {};
  add_dipole_gradients(this->dipoles.data(), static_cast<Index>(this->dipoles.size()), q,
    this->frame.tolerance * this->frame.tolerance, sums);
  return { sum_lanes(sums[0]), sum_lanes(sums[1]), sum_lanes(sums[2]) };
}

/// Report whether the winding number can differ from 0. Far away it is 0 in double precision.
bool PointCloudWindingNumber::Impl::can_be_nonzero(const Vec3& framed) const
{
  return !this->dipoles.empty() && framed.cwiseAbs().maxCoeff() < farthest;
}

Vec3 PointCloudWindingNumber::Impl::gradient_at(const Vec3& query) const
{
  if (!query.allFinite())
  {
    return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  const Vec3 p = this->frame(query);
  if (!this->can_be_nonzero(p))
  {
    return Vec3::Zero();
  }
  return this->frame.scale *
    (this->method == WindingMethod::direct ? this->plain_gradient(p) : this->tree_gradient(p));
}

double PointCloudWindingNumber::Impl::at(const Vec3& query, bool exactly, bool& touches) const
{
  touches = false;
  if (!query.allFinite())
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const Vec3 p = this->frame(query);
  if (!this->can_be_nonzero(p))
  {
    return 0.0;
  }
  return exactly || this->method == WindingMethod::direct ? this->plain_sum(p, touches)
                                                          : this->tree_sum(p, touches);
}

double PointCloudWindingNumber::evaluate_at(const Vec3& point, bool* on_surface) const
{
  bool touches = false;
  const double winding_number = this->impl_->at(point, false, touches);
  if (on_surface)
  {
    *on_surface = touches;
  }
  return winding_number;
}

double PointCloudWindingNumber::evaluate_exactly_at(const Vec3& point, bool* on_surface) const
{
  bool touches = false;
  const double winding_number = this->impl_->at(point, true, touches);
  if (on_surface)
  {
    *on_surface = touches;
  }
  return winding_number;
}

template <typename PointAt>
Status PointCloudWindingNumber::evaluate_points(ExecutionContext& context, Index count,
  const PointAt& point_at, double* out, unsigned char* on_surface) const
{
  const Impl& impl = *this->impl_;
  if (!impl.status.ok())
  {
    return impl.status;
  }
  const double nanoseconds = impl.method == WindingMethod::fast
    ? 4000.0
    : 1.0 + 8.0 * static_cast<double>(impl.dipoles.size());
  return point_values(context, count, nanoseconds, out, on_surface,
    [&](Index begin, Index end, unsigned char* flags)
    {
      for (Index i = begin; i < end; ++i)
      {
        bool touches = false;
        out[i] = impl.at(point_at(i), false, touches);
        flags[i - begin] = touches;
      }
    });
}

Status PointCloudWindingNumber::evaluate(
  ExecutionContext& context, PointsView queries, double* out, unsigned char* on_surface) const
{
  return this->evaluate_points(
    context, queries.rows(), [queries](Index i) -> Vec3 { return queries.row(i); }, out,
    on_surface);
}

Status PointCloudWindingNumber::evaluate(
  ExecutionContext& context, PointsView queries, Eigen::VectorXd& out) const
{
  out.resize(queries.rows());
  return this->evaluate(context, queries, out.data());
}

Status PointCloudWindingNumber::evaluate(
  ExecutionContext& context, const SampleGrid& grid, double* out, unsigned char* on_surface) const
{
  return this->evaluate_points(
    context, grid.count(), [&grid](Index i) { return grid.point(i); }, out, on_surface);
}

template <typename PointAt>
Status PointCloudWindingNumber::evaluate_gradients(
  ExecutionContext& context, Index count, const PointAt& point_at, double* out) const
{
  const Impl& impl = *this->impl_;
  if (!impl.status.ok())
  {
    return impl.status;
  }
  const double nanoseconds = impl.method == WindingMethod::fast
    ? 8000.0
    : 1.0 + 16.0 * static_cast<double>(impl.dipoles.size());
  return point_gradients(context, count, nanoseconds,
    [&](Index i) { Eigen::Map<Vec3>(out + 3 * i) = impl.gradient_at(point_at(i)); });
}

Status PointCloudWindingNumber::evaluate_gradient(
  ExecutionContext& context, PointsView queries, double* out) const
{
  return this->evaluate_gradients(
    context, queries.rows(), [queries](Index i) -> Vec3 { return queries.row(i); }, out);
}

Status PointCloudWindingNumber::evaluate_gradient(
  ExecutionContext& context, const SampleGrid& grid, double* out) const
{
  return this->evaluate_gradients(
    context, grid.count(), [&grid](Index i) { return grid.point(i); }, out);
}

} // namespace bindpose
