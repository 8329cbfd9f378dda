// Construction of the cells of DipoleField (a fast multipole method; citations in dipole_field.h).
//
// Sources: the triangles are sorted into a binary tree. Its leaves are blocks of up to eight
// triangles. For the multipoles of a block, the normal derivatives of the regular harmonics are
// integrated over the triangles of the block. The integrands are polynomials, and the quadrature is
// exact for them. The multipoles of a node are the sums of the shifted multipoles of its children.
//
// Cells: an octree over a cube around the triangles and the query region. From the top down, a cell
// tests the nodes that are not yet part of its parent's expansion. A node that is far enough away
// is added to the local expansion of the cell, which consists of harmonic polynomials. Any other
// node that is large is replaced by its two children. The remaining nodes are passed to the
// children of the cell. A cell is not split further if few blocks remain or if the cell is small
// compared with them. The remaining blocks are its near list. Only leaves are stored.
//
// "Far enough" means: the sum of the omitted terms is estimated from the powers of the node's
// multipoles (Dehnen 2014, equation 15), and the estimate is below a threshold. The finished field
// is compared with the plain sum on sample points; up to half of them are located where the
// estimated errors are largest. If an error exceeds half the tolerance, the cells are built again
// with a lower threshold.
#include "winding/dipole_field.h"

#include "base/constants.h"
#include "base/parallel.h"
#include "solid_angle/local_polynomial.h"
#include "solid_angle/solid_harmonics.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

namespace bindpose
{

namespace
{
/// A cell whose near list has at most this many blocks is not split.
constexpr Index maximum_leaf_blocks = 2;
struct Tuning
{
  double tolerance;
  int order;
  double finest_cell;
};
/// Order and cell size for each tolerance, from measurements. All polynomials up to order 7 have
/// the same cost.
constexpr Tuning tunings[] = { { 1e-2, 4, 0.8 }, { 2e-3, 6, 0.8 }, { 1e-3, 7, 0.8 },
  { 1e-4, 7, 0.8 }, { 1e-5, 9, 0.8 }, { 1e-6, 11, 0.8 }, { 0.0, 13, 1.0 } };
/// A field with at most `small_field_blocks` blocks gets smaller cells: their size is multiplied by
/// `small_field_factor`. The evaluation is then 1.2 times as fast, but the field takes twice the
/// memory.
constexpr Index small_field_blocks = 2048;
constexpr double small_field_factor = 0.75;
/// First threshold for the error estimate of an interaction between a node and a cell, in units of
/// the tolerance. It may exceed 1, because the estimates are upper bounds and the errors of many
/// interactions rarely add up. If the errors do add up, the comparison on the sample points detects
/// this case, and the threshold is lowered.
constexpr double first_threshold = 1.2;
/// Threshold for points outside the cells, as a fraction of the threshold in the cells. The
/// fraction is below 1 for two reasons. First, each point has few interactions. Second, an estimate
/// for a single point is closer to the error than an estimate for a whole cell.
constexpr double outer_threshold_factor = 0.2;
/// Largest accepted error on the sample points, in units of the tolerance. The rest of the
/// tolerance is a margin for all other points.
constexpr double target_error = 0.5;
/// Measured nanoseconds to sum a block, to make a cell, and to test one node that a cell inherits
/// from its parent. The last two costs apply to order 7 and grow with the cube of (order + 1). The
/// cost model assumes that splitting a cell halves the near list.
constexpr double block_cost = 10.0;
constexpr double cell_cost = 2000.0;
constexpr double node_cost = 150.0;
/// Up to this many expected points, every value is the sum over all triangles, because building the
/// multipoles alone would cost about as much.
constexpr Index maximum_direct_points = 3000;
/// Number of expected points per sample point, and minimum number of sample points. At the sample
/// points, the finished field is compared with the plain sum.
constexpr Index points_per_sample = 512;
constexpr Index minimum_samples = 48;
/// At or above this tolerance single precision is accurate enough, unless the errors of float sums
/// exceed `largest_float_error` times the tolerance. A thousand triangles at one position cause
/// such errors.
constexpr double float_tolerance = 9e-5;
constexpr double largest_float_error = 0.1;

/// Compute the Gauss-Legendre nodes and weights on [0, 1].
void gauss_legendre(int count, std::vector<double>& nodes, std::vector<double>& weights)
{
  nodes.resize(static_cast<std::size_t>(count));
  weights.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
  {
    double x = std::cos(0.25 * four_pi * (i + 0.75) / (count + 0.5));
    double slope = 1.0;
    for (int round = 0; round < 50; ++round)
    {
      double p0 = 1.0, p1 = x;
      for (int n = 2; n <= count; ++n)
      {
        const double p2 = ((2.0 * n - 1.0) * x * p1 - (n - 1.0) * p0) / n;
        p0 = p1;
        p1 = p2;
      }
      slope = count * (x * p1 - p0) / (x * x - 1.0);
      const double step = p1 / slope;
      x -= step;
      if (std::abs(step) < 1e-15)
      {
        break;
      }
    }
    nodes[i] = 0.5 * (1.0 + x);
    weights[i] = 1.0 / ((1.0 - x * x) * slope * slope);
  }
}

/// Return (n - m)! (n + m)!, the weight of the squared coefficient (n, m) in the power of degree n
/// of a multipole (Dehnen 2014). For m > 0 the weight is doubled to include the coefficient
/// (n, -m).
double power_weight(int n, int m)
{
  return (m ? 2.0 : 1.0) * std::tgamma(n - m + 1.0) * std::tgamma(n + m + 1.0);
}
} // namespace

struct DipoleField::Builder
{
  struct Node
  {
    Vec3 center = Vec3::Zero();
    double radius = 0.0;
    /// Range of the node's triangles in `order`. After the blocks are built: range of the node's
    /// blocks.
    Id first = 0, count = 0;
    Id left = -1, right = -1;
    double block_radius = 0.0; ///< mean radius of the blocks
    double error_fraction = 1.0; ///< fraction of the allowed error that the node may cause
    int height = 0;
  };
  /// Error estimate of a cell's expansion. `size` is the sum of the error estimates of all nodes in
  /// the expansion. `direction_sum` is the sum of the unit vectors from the cell to these nodes,
  /// weighted by the error estimates.
  struct ErrorEstimate
  {
    double size = 0.0;
    Vec3 direction_sum = Vec3::Zero();
  };
  struct LeafError
  {
    ErrorEstimate error_estimate;
    Vec3 center;
    double half; ///< half the size of the leaf
  };
  /// The cells and leaves below one top cell of the octree.
  struct Subtree
  {
    std::vector<Id> cells{ 0 };
    std::vector<double> locals;
    std::vector<Id> run_count; ///< number of block runs (BlockRun) of each leaf
    std::vector<BlockRun> runs;
    std::vector<LeafError> leaves;
  };
  /// Coordinates of a cell among the cells of its level.
  struct CellIndex
  {
    int level;
    Id at[3];
  };
  /// Working memory of one thread.
  struct Scratch
  {
    Harmonics at, in, out, children;
    std::array<Id, harmonic_lanes> batch{};
    int batched = 0;
    ErrorEstimate error_estimate;
    std::vector<Id> stack;
    std::vector<std::vector<Id>> lists; ///< nodes not yet part of an expansion, per level
    std::vector<std::vector<double>> locals; ///< expansions of the eight children, per level
  };

  Builder(ExecutionContext& run, DipoleField& owner, const Options& requested)
    : field(owner), context(run), options(requested)
  {
  }

  bool run(const Triangles& triangles, const std::vector<int>& multiplicities);
  void add_triangles(const Triangles& triangles, const std::vector<int>& multiplicities);
  void cut_long_triangles();
  bool sort_triangles();
  Id split(Id first, Id count);
  template <typename Real>
  void fill_blocks(std::vector<TriangleBlock<Real>>& blocks);
  bool find_multipoles();
  void block_multipole(const Node& node, Scratch& scratch, double* moments) const;
  void find_bounds();
  double error(Id node, double distance, double radius) const;
  void place_cells();
  void find_outer();
  void add_outer(Id node);
  void set_up_direct_sum();
  bool is_split_worthwhile(
    const Vec3& center, double size, double blocks, std::size_t near_count) const;
  bool fill_cells();
  void fill(Subtree& tree, const CellIndex& cell, std::size_t entry, const double* local,
    const ErrorEstimate& inherited_error, const std::vector<Id>& inherited, Scratch& scratch,
    std::size_t depth);
  bool add_if_far(Id node, const Vec3& center, double radius, Scratch& scratch) const;
  void flush(const Vec3& center, Scratch& scratch) const;
  void emit_leaf(Subtree& tree, std::size_t entry, double half, const std::vector<double>& local,
    const std::vector<Id>& near_nodes) const;
  double measure();

  Vec3 point(Id id) const
  {
    const Id original_count = static_cast<Id>(this->field.points_->rows());
    return id < original_count ? Vec3(this->field.points_->row(id))
                               : this->field.extra_points_[id - original_count];
  }
  Corners corners(Id t) const
  {
    return { this->point(this->ids[t][0]), this->point(this->ids[t][1]),
      this->point(this->ids[t][2]) };
  }
  int moment_count() const { return 2 * harmonic_count(this->field.order_ + 1); }

  DipoleField& field;
  ExecutionContext& context;
  const Options& options;
  double finest_cell = 1.0;
  double threshold = 0.0; // largest allowed error estimate of an interaction
  Box region; // region that contains most of the expected points
  // Expected number of query points per unit of volume in `region`. 0: unknown or unlimited; every
  // split of a cell is then worthwhile.
  double density = 0.0;
  std::vector<std::array<Id, 3>> ids;
  std::vector<int> triangle_multiplicities;
  std::vector<int> weights; // multiplicity of each lane of each block
  std::vector<Vec3> centers; // centroids of the triangles
  std::vector<Id> order;
  std::vector<Node> nodes;
  // Multipoles of the nodes, one node after the other: the real and the imaginary part of each
  // coefficient (n, m).
  std::vector<double> moments;
  std::vector<double> bounds; // error bounds of the nodes, (order + 2) numbers per node
  std::vector<double> nodes_of_quadrature, weights_of_quadrature;
  std::vector<LeafError> leaf_errors; // leaves with their error estimates
  double float_error = 0.0; // largest error of single-precision sums
};

void DipoleField::Builder::add_triangles(
  const Triangles& triangles, const std::vector<int>& multiplicities)
{
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    if (multiplicities[t] != 0)
    {
      this->ids.push_back({ static_cast<Id>(triangles(t, 0)), static_cast<Id>(triangles(t, 1)),
        static_cast<Id>(triangles(t, 2)) });
      this->triangle_multiplicities.push_back(multiplicities[t]);
    }
  }
}

// Cut long slivers among short triangles. A sliver is near all cells along its length. Each half of
// the sliver is near fewer cells, and the solid angles of both halves sum to that of the sliver.
// All triangles with an edge longer than `limit` are cut. `limit` is chosen so that the cuts add
// few triangles.
void DipoleField::Builder::cut_long_triangles()
{
  const std::size_t count = this->ids.size();
  if (count <= 64)
  {
    return;
  }
  double area = 0.0;
  std::vector<double> longest(count);
  for (std::size_t t = 0; t < count; ++t)
  {
    const Corners c = this->corners(static_cast<Id>(t));
    area += 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).norm();
    longest[t] = std::sqrt(std::max(
      { (c[1] - c[0]).squaredNorm(), (c[2] - c[1]).squaredNorm(), (c[0] - c[2]).squaredNorm() }));
  }
  const double shortest_cut = 2.5 * std::sqrt(2.0 * area / static_cast<double>(count));
  // Allow fewer pieces of cut triangles if fewer points are expected.
  const std::size_t factor = this->options.expected_points == 0 ? 8
    : this->options.expected_points < 500000                    ? 2
                                                                : 4;
  const std::size_t maximum_triangles =
    std::max(2 * count, std::min<std::size_t>(factor * count, 8192));
  // A triangle whose longest edge has length x is cut into about 1.5 x / limit pieces.
  double limit = *std::max_element(longest.begin(), longest.end());
  const auto pieces = [&](double length)
  {
    double sum = 0.0;
    for (const double x : longest)
    {
      sum += x > length ? std::ceil(1.5 * x / length) : 1.0;
    }
    return sum;
  };
  while (
    limit * 0.75 > shortest_cut && pieces(limit * 0.75) <= static_cast<double>(maximum_triangles))
  {
    limit *= 0.75;
  }
  const auto original_count = static_cast<Id>(this->field.points_->rows());
  for (std::size_t t = 0; t < this->ids.size() && this->ids.size() < maximum_triangles; ++t)
  {
    for (bool is_split = true; is_split;)
    {
      const Corners c = this->corners(static_cast<Id>(t));
      int edge = 0;
      double length = 0.0;
      for (int k = 0; k < 3; ++k)
      {
        const double x = (c[(k + 1) % 3] - c[k]).norm();
        if (x > length)
        {
          length = x;
          edge = k;
        }
      }
      is_split = length > limit && this->ids.size() < maximum_triangles;
      if (is_split)
      {
        const Id middle = original_count + static_cast<Id>(this->field.extra_points_.size());
        this->field.extra_points_.push_back(0.5 * (c[edge] + c[(edge + 1) % 3]));
        std::array<Id, 3> other = this->ids[t];
        this->ids[t][(edge + 1) % 3] = middle;
        other[edge] = middle;
        this->ids.push_back(other);
        this->triangle_multiplicities.push_back(this->triangle_multiplicities[t]);
      }
    }
  }
}

bool DipoleField::Builder::sort_triangles()
{
  const auto count = static_cast<Id>(this->ids.size());
  this->centers.resize(this->ids.size());
  for (Id t = 0; t < count; ++t)
  {
    const Corners c = this->corners(t);
    this->centers[t] = (c[0] + c[1] + c[2]) / 3.0;
  }
  this->order.resize(this->ids.size());
  std::iota(this->order.begin(), this->order.end(), 0);
  this->split(0, count);
  if (this->context.canceled())
  {
    return false;
  }
  // Leaves become blocks, from left to right.
  Id blocks = 0;
  for (std::size_t n = 0; n < this->nodes.size(); ++n)
  {
    Node& node = this->nodes[n];
    if (node.left < 0)
    {
      for (int i = 0; i < triangle_lanes; ++i)
      {
        // Fill empty lanes with copies of the last triangle; the weight of a copy is 0.
        const Id t = this->order[node.first + std::min<Id>(i, node.count - 1)];
        this->field.ids_.push_back(this->ids[t]);
        this->weights.push_back(i < node.count ? this->triangle_multiplicities[t] : 0);
      }
      node.first = blocks++;
      node.count = 1;
      node.block_radius = node.radius;
    }
  }
  for (std::size_t n = this->nodes.size(); n-- > 0;)
  {
    Node& node = this->nodes[n];
    if (node.left >= 0)
    {
      const Node& a = this->nodes[node.left];
      const Node& b = this->nodes[node.right];
      node.first = a.first;
      node.count = a.count + b.count;
      node.height = 1 + std::max(a.height, b.height);
      node.block_radius =
        (a.block_radius * a.count + b.block_radius * b.count) / static_cast<double>(node.count);
      node.radius = std::min(node.radius,
        std::max(
          (a.center - node.center).norm() + a.radius, (b.center - node.center).norm() + b.radius));
    }
  }
  // The multipoles of a child that is almost as large as its parent cause almost the same error as
  // the multipoles of the parent. The errors of two such children add up, so the parent's allowed
  // error is divided between the two children.
  for (const Node& node : this->nodes)
  {
    for (const Id id : { node.left, node.right })
    {
      if (id >= 0)
      {
        Node& child = this->nodes[id];
        const bool as_large = child.radius > 0.9 * node.radius;
        child.error_fraction =
          as_large ? node.error_fraction * child.count / node.count : node.error_fraction;
      }
    }
  }
  return true;
}

// Make a node of the triangles order[first … first + count), split it recursively and return its
// id. A part of a split costs its number of blocks times its squared size. Each split is chosen so
// that the sum of the costs of both parts is small.
std::int32_t DipoleField::Builder::split(Id first, Id count)
{
  Box box, center_box;
  const auto add_triangle = [&](Box& to, Id t)
  {
    for (const Vec3& corner : this->corners(t))
    {
      to.add(corner);
    }
  };
  for (Id i = first; i < first + count; ++i)
  {
    add_triangle(box, this->order[i]);
    center_box.add(this->centers[this->order[i]]);
  }
  const auto id = static_cast<Id>(this->nodes.size());
  Node node;
  node.first = first;
  node.count = count;
  node.center = box.center();
  double radius2 = 0.0;
  for (Id i = first; i < first + count; ++i)
  {
    for (const Vec3& corner : this->corners(this->order[i]))
    {
      radius2 = std::max(radius2, (corner - node.center).squaredNorm());
    }
  }
  // The radius includes the touch tolerance. Therefore the node is never far from a point that
  // touches one of its triangles.
  node.radius = std::sqrt(radius2) + 2.0 * this->field.touch_tolerance_;
  this->nodes.push_back(node);
  int axis = 0;
  const double longest = center_box.size().maxCoeff(&axis);
  if (count == 1 || !(longest > 0.0) || (count > 4096 && this->context.canceled()))
  {
    if (count <= triangle_lanes || this->context.canceled())
    {
      return id;
    }
  }
  const auto blocks = [](Id triangles)
  { return static_cast<double>((triangles + triangle_lanes - 1) / triangle_lanes); };
  const auto begin = this->order.begin() + first;
  const auto before = [&](Id s, Id t)
  {
    const double x = this->centers[s][axis];
    const double y = this->centers[t][axis];
    return x != y ? x < y : s < t;
  };
  double best = 1e300;
  Id cut = 0;
  if (count <= 64)
  {
    std::sort(begin, begin + count, before);
    double prefix_extents[64];
    Box side;
    for (Id i = 0; i + 1 < count; ++i)
    {
      add_triangle(side, begin[i]);
      prefix_extents[i + 1] = side.size().squaredNorm();
    }
    side = Box();
    for (Id i = count - 1; i > 0; --i)
    {
      add_triangle(side, begin[i]);
      const double cost =
        prefix_extents[i] * blocks(i) + side.size().squaredNorm() * blocks(count - i);
      if (cost < best)
      {
        best = cost;
        cut = i;
      }
    }
    if (count <= triangle_lanes && !(best < 0.2 * box.size().squaredNorm()))
    {
      return id;
    }
  }
  else
  {
    constexpr int bins = 32;
    std::array<Box, bins> boxes;
    std::array<Id, bins> counts{};
    const auto bin_of = [&](Id t)
    {
      const double x = (this->centers[t][axis] - center_box.lower[axis]) / longest;
      return longest > 0.0 ? std::clamp(static_cast<int>(x * bins), 0, bins - 1) : 0;
    };
    for (Id i = 0; i < count; ++i)
    {
      const int bin = bin_of(begin[i]);
      add_triangle(boxes[bin], begin[i]);
      counts[bin] += 1;
    }
    const auto join = [](Box& to, const Box& other)
    {
      if (!other.empty())
      {
        to.add(other.lower);
        to.add(other.upper);
      }
    };
    std::array<double, bins> above{};
    Box side;
    for (int b = bins - 1; b > 0; --b)
    {
      join(side, boxes[b]);
      above[b] = side.size().squaredNorm();
    }
    side = Box();
    Id left_count = 0;
    for (int b = 1; b < bins; ++b)
    {
      join(side, boxes[b - 1]);
      left_count += counts[b - 1];
      const double cost =
        side.size().squaredNorm() * blocks(left_count) + above[b] * blocks(count - left_count);
      if (left_count > 0 && left_count < count && cost < best)
      {
        best = cost;
        cut = left_count;
      }
    }
    cut = cut ? cut : count / 2;
    // In a node of more than 512 triangles, round the number of triangles in the left group down to
    // whole blocks. This moves few triangles to the right group.
    const Id rounded_cut = cut / triangle_lanes * triangle_lanes;
    cut = rounded_cut > 0 && count > 512 ? rounded_cut : cut;
    std::nth_element(begin, begin + cut, begin + count, before);
  }
  const Id left = this->split(first, cut);
  const Id right = this->split(first + cut, count - cut);
  this->nodes[id].left = left;
  this->nodes[id].right = right;
  return id;
}

template <typename Real>
void DipoleField::Builder::fill_blocks(std::vector<TriangleBlock<Real>>& blocks)
{
  blocks.resize(this->field.ids_.size() / triangle_lanes);
  for (const Node& node : this->nodes)
  {
    if (node.left >= 0)
    {
      continue;
    }
    TriangleBlock<Real>& block = blocks[node.first];
    // The lower limit of the radius keeps the third powers of scaled lengths within the range of
    // floats.
    block.inverse_size = 1.0 / std::max(node.radius, 1e-6);
    for (int k = 0; k < 3; ++k)
    {
      block.center[k] = node.center[k];
    }
    for (int i = 0; i < triangle_lanes; ++i)
    {
      const Index slot = static_cast<Index>(node.first) * triangle_lanes + i;
      const Corners c = this->field.corners(slot);
      for (int k = 0; k < 9; ++k)
      {
        block.corner[k][i] =
          static_cast<Real>((c[k / 3][k % 3] - node.center[k % 3]) * block.inverse_size);
      }
      block.weight[i] = static_cast<Real>(this->weights[slot]);
      block.unit_weights = (i == 0 || block.unit_weights) && std::abs(this->weights[slot]) <= 1;
    }
  }
}

void DipoleField::Builder::block_multipole(const Node& node, Scratch& scratch, double* out) const
{
  const int degree = this->field.order_; // degree of the integrands
  HarmonicLanes corner[3][3], normal[3], at[3];
  for (int i = 0; i < harmonic_lanes; ++i)
  {
    const Index slot = static_cast<Index>(node.first) * triangle_lanes + i;
    const Corners c = this->field.corners(slot);
    const Vec3 area = (c[1] - c[0]).cross(c[2] - c[0]) * (-this->weights[slot] / four_pi);
    for (int k = 0; k < 3; ++k)
    {
      for (int v = 0; v < 3; ++v)
      {
        corner[v][k].lane[i] = c[v][harmonic_axes[k]] - node.center[harmonic_axes[k]];
      }
      normal[k].lane[i] = area[harmonic_axes[k]];
    }
  }
  Harmonics& sum = scratch.in;
  sum.clear(degree);
  const std::size_t points = this->nodes_of_quadrature.size();
  for (std::size_t a = 0; a < points; ++a)
  {
    for (std::size_t b = 0; b < points; ++b)
    {
      const double u = this->nodes_of_quadrature[a];
      const double v = this->nodes_of_quadrature[b] * (1.0 - u);
      const double w = this->weights_of_quadrature[a] * this->weights_of_quadrature[b] * (1.0 - u);
      for (int k = 0; k < 3; ++k)
      {
        for (int i = 0; i < harmonic_lanes; ++i)
        {
          at[k].lane[i] = corner[0][k].lane[i] * (1.0 - u - v) + corner[1][k].lane[i] * u +
            corner[2][k].lane[i] * v;
        }
      }
      regular_harmonics(degree, at, scratch.at);
      for (int c = 0; c < harmonic_count(degree); ++c)
      {
        for (int i = 0; i < harmonic_lanes; ++i)
        {
          sum.real[c].lane[i] += w * scratch.at.real[c].lane[i];
          sum.imaginary[c].lane[i] += w * scratch.at.imaginary[c].lane[i];
        }
      }
    }
  }
  scratch.out.clear(degree + 1);
  regular_derivative(degree + 1, sum, normal, scratch.out);
  for (int c = 0; c < harmonic_count(degree + 1); ++c)
  {
    double re = 0.0, im = 0.0;
    for (int i = 0; i < harmonic_lanes; ++i)
    {
      re += scratch.out.real[c].lane[i];
      im += scratch.out.imaginary[c].lane[i];
    }
    out[2 * c] = re;
    out[2 * c + 1] = im;
  }
}

bool DipoleField::Builder::find_multipoles()
{
  const int stride = this->moment_count();
  const int degree = this->field.order_ + 1;
  this->moments.assign(this->nodes.size() * static_cast<std::size_t>(stride), 0.0);
  gauss_legendre(
    (this->field.order_ + 3) / 2, this->nodes_of_quadrature, this->weights_of_quadrature);
  // Sort nodes by height, so that children are processed before their parents.
  int height = 0;
  for (const Node& node : this->nodes)
  {
    height = std::max(height, node.height);
  }
  std::vector<std::vector<Id>> levels(static_cast<std::size_t>(height) + 1);
  for (std::size_t n = 0; n < this->nodes.size(); ++n)
  {
    levels[this->nodes[n].height].push_back(static_cast<Id>(n));
  }
  if (!parallel_for(this->context, static_cast<Index>(levels[0].size()), 256,
        [&](Index begin, Index end)
        {
          const auto scratch = std::make_unique<Scratch>();
          for (Index i = begin; i < end; ++i)
          {
            const Id n = levels[0][i];
            this->block_multipole(
              this->nodes[n], *scratch, &this->moments[std::size_t(n) * stride]);
          }
        }))
  {
    return false;
  }
  for (int h = 1; h <= height; ++h)
  {
    // Process four parents at a time. The eight lanes contain their children, two per parent.
    const std::vector<Id>& level = levels[h];
    if (!parallel_for(this->context, static_cast<Index>(level.size()), 128,
          [&](Index begin, Index end)
          {
            const auto scratch = std::make_unique<Scratch>();
            for (Index i = begin; i < end; i += harmonic_lanes / 2)
            {
              HarmonicLanes shift[3];
              for (int lane = 0; lane < harmonic_lanes; ++lane)
              {
                const Node& parent = this->nodes[level[std::min(end - 1, i + lane / 2)]];
                const Id child = lane % 2 ? parent.right : parent.left;
                const Vec3 by = this->nodes[child].center - parent.center;
                for (int k = 0; k < 3; ++k)
                {
                  shift[k].lane[lane] = by[harmonic_axes[k]];
                }
                const double* from = &this->moments[std::size_t(child) * stride];
                for (int c = 0; 2 * c < stride; ++c)
                {
                  scratch->in.real[c].lane[lane] = from[2 * c];
                  scratch->in.imaginary[c].lane[lane] = from[2 * c + 1];
                }
              }
              regular_harmonics(degree, shift, scratch->at);
              scratch->out.clear(degree);
              multipole_to_multipole(degree, scratch->at, scratch->in, scratch->out);
              for (int p = 0; p < harmonic_lanes / 2 && i + p < end; ++p)
              {
                double* to = &this->moments[std::size_t(level[i + p]) * stride];
                for (int c = 0; 2 * c < stride; ++c)
                {
                  to[2 * c] =
                    scratch->out.real[c].lane[2 * p] + scratch->out.real[c].lane[2 * p + 1];
                  to[2 * c + 1] = scratch->out.imaginary[c].lane[2 * p] +
                    scratch->out.imaginary[c].lane[2 * p + 1];
                }
              }
            }
          }))
    {
      return false;
    }
  }
  this->find_bounds();
  return true;
}

// Compute the error bounds of each node for the first omitted total degree, N = order + 2. Let P(n)
// be the power of degree n of the node's multipoles (see power_weight). The bounds are
// binomial(N, n) P(n) for n = 1 … N. P(N) is unknown. It is estimated as the maximum of
// P(N - 1) radius and P(N - 2) radius^2. Both terms are needed, because every second power is 0 in
// a symmetric group of triangles.
void DipoleField::Builder::find_bounds()
{
  const int top = this->field.order_ + 2;
  const int stride = this->moment_count();
  this->bounds.resize(this->nodes.size() * static_cast<std::size_t>(top));
  std::vector<double> weight(static_cast<std::size_t>(harmonic_count(top)));
  for (int n = 1; n < top; ++n)
  {
    for (int m = 0; m <= n; ++m)
    {
      weight[harmonic_index(n, m)] = power_weight(n, m);
    }
  }
  for (std::size_t i = 0; i < this->nodes.size(); ++i)
  {
    const double* moment = &this->moments[i * stride];
    double* bound = &this->bounds[i * top];
    double binomial = 1.0, power = 0.0, before = 0.0;
    for (int n = 1; n <= top; ++n)
    {
      binomial *= static_cast<double>(top - n + 1) / n;
      if (n < top)
      {
        before = power;
        power = 0.0;
        for (int m = 0; m <= n; ++m)
        {
          const int c = harmonic_index(n, m);
          power +=
            weight[c] * (moment[2 * c] * moment[2 * c] + moment[2 * c + 1] * moment[2 * c + 1]);
        }
        power = std::sqrt(power);
      }
      else
      {
        const double radius = this->nodes[i].radius;
        power = std::max(power * radius, before * radius * radius);
      }
      bound[n - 1] = binomial * power;
    }
  }
}

/// Return the error estimate of an interaction, divided by the node's `error_fraction`. `distance`
/// is the distance between the center of the node and the center of a cell of radius `radius`.
double DipoleField::Builder::error(Id node, double distance, double radius) const
{
  const int top = this->field.order_ + 2;
  const double* bound = &this->bounds[std::size_t(node) * top];
  const double inverse = 1.0 / distance;
  // Compute the sum over n of bound(n) radius^(top - n) / distance^(top + 1).
  double sum = 0.0, power = inverse;
  for (int n = 0; n < top; ++n)
  {
    sum = sum * radius + bound[n];
    power *= inverse;
  }
  // The higher degrees are estimated by a geometric series.
  const Node& cluster = this->nodes[node];
  return sum * power / ((1.0 - (radius + cluster.radius) * inverse) * cluster.error_fraction);
}

void DipoleField::Builder::place_cells()
{
  Box box = this->options.region;
  for (const Node& node : this->nodes)
  {
    if (node.left < 0)
    {
      for (int i = 0; i < triangle_lanes; ++i)
      {
        for (const Vec3& corner :
          this->field.corners(static_cast<Index>(node.first) * triangle_lanes + i))
        {
          box.add(corner);
        }
      }
    }
  }
  const double size = box.size().maxCoeff();
  this->field.size_ = size > 0.0 ? 1.25 * size : 1.0;
  this->field.lower_ = box.center() - Vec3::Constant(0.5 * this->field.size_);
  this->field.top_level_ = this->ids.size() < 1000 ? 2 : 3;
  const auto expected = static_cast<double>(this->options.expected_points);
  if (expected > 0.0)
  {
    const int level = expected < 2e4 ? 0 : expected < 2e5 ? 1 : 2;
    this->field.top_level_ = std::min(this->field.top_level_, level);
    // Thicken a flat region, because the expected points can be anywhere in the cells that the
    // region crosses.
    this->region = this->options.region.empty() ? box : this->options.region;
    const Vec3 region_size = this->region.size();
    for (int k = 0; k < 3; ++k)
    {
      const double padding = std::max(0.0, 0.05 * size - 0.5 * region_size[k]);
      this->region.lower[k] -= padding;
      this->region.upper[k] += padding;
    }
    const double volume = this->region.size().prod();
    this->density = volume > 0.0 ? expected / volume : 0.0;
  }
}

/// Make one cell whose near list contains all triangles.
void DipoleField::Builder::set_up_direct_sum()
{
  DipoleField& f = this->field;
  f.top_level_ = 0;
  f.cells_.assign(1, ~Id(0));
  f.first_run_ = { 0, 1 };
  f.runs_.assign(1, { 0, static_cast<Id>(f.block_count()) });
  const auto numbers =
    static_cast<std::size_t>(local_coefficient_count(f.order_) + polynomial_lanes);
  f.double_precision_ ? f.double_locals_.assign(numbers, 0.0)
                      : f.float_locals_.assign(numbers, 0.0F);
  OuterNode all;
  all.blocks = f.runs_[0];
  all.radius = 1e300; // with this radius, no point is far from the node
  all.leaf = true;
  all.skip = 1;
  f.outer_.assign(1, all);
  f.outer_moments_.assign(static_cast<std::size_t>(this->moment_count()), 0.0);
}

/// Report whether splitting a cell saves more time in the evaluation than it takes in the build.
/// @param blocks number of blocks in the near nodes of the cell
/// @param near_count number of near nodes of the cell
bool DipoleField::Builder::is_split_worthwhile(
  const Vec3& center, double size, double blocks, std::size_t near_count) const
{
  if (this->density <= 0.0)
  {
    return true;
  }
  double volume = 1.0;
  for (int k = 0; k < 3; ++k)
  {
    const double lower = std::max(this->region.lower[k], center[k] - 0.5 * size);
    const double upper = std::min(this->region.upper[k], center[k] + 0.5 * size);
    volume *= std::max(0.0, upper - lower);
  }
  const double orders = (this->field.order_ + 1) / 8.0;
  const double child =
    (cell_cost + node_cost * static_cast<double>(near_count)) * orders * orders * orders;
  return 0.5 * block_cost * blocks * volume * this->density > 8.0 * child;
}

// Store the nodes for points outside the cells. If a node is far enough away from all points
// outside the cells, its descendants are omitted.
void DipoleField::Builder::find_outer()
{
  this->field.outer_.clear();
  this->field.outer_moments_.clear();
  this->field.outer_threshold_ = outer_threshold_factor * this->threshold;
  this->add_outer(0);
  this->field.outer_.shrink_to_fit();
  this->field.outer_moments_.shrink_to_fit();
}

void DipoleField::Builder::add_outer(Id id)
{
  const Node& node = this->nodes[id];
  const int top = this->field.order_ + 2;
  const int stride = this->moment_count();
  const auto outer_index = this->field.outer_.size();
  OuterNode outer;
  outer.center = node.center;
  outer.radius = node.radius;
  outer.bound = this->bounds[std::size_t(id) * top + top - 1] / node.error_fraction;
  outer.blocks = { node.first, node.count };
  this->field.outer_.push_back(outer);
  const double* moment = &this->moments[std::size_t(id) * stride];
  this->field.outer_moments_.insert(this->field.outer_moments_.end(), moment, moment + stride);
  // Smallest distance from the center of the node to a point outside the cells.
  const Vec3 inside = node.center - this->field.lower_;
  const double distance =
    std::min(inside.minCoeff(), this->field.size_ - inside.maxCoeff()) * (1.0 - 1e-9);
  const bool is_valid_everywhere =
    distance > 1.05 * node.radius && this->error(id, distance, 0.0) <= this->field.outer_threshold_;
  this->field.outer_[outer_index].leaf = is_valid_everywhere || node.left < 0;
  if (!this->field.outer_[outer_index].leaf)
  {
    this->add_outer(node.left);
    this->add_outer(node.right);
  }
  this->field.outer_[outer_index].skip = static_cast<Id>(this->field.outer_.size());
}

/// Add the node to the cell's expansion if it is far enough away. Return whether it was added.
bool DipoleField::Builder::add_if_far(
  Id id, const Vec3& center, double radius, Scratch& scratch) const
{
  const Node& node = this->nodes[id];
  const double distance = (center - node.center).norm();
  if (!(distance > 1.05 * (radius + node.radius)))
  {
    return false;
  }
  const double error = this->error(id, distance, radius);
  if (error <= this->threshold)
  {
    scratch.error_estimate.size += error;
    scratch.error_estimate.direction_sum += error / distance * (node.center - center);
    scratch.batch[scratch.batched++] = id;
    if (scratch.batched == harmonic_lanes)
    {
      this->flush(center, scratch);
    }
    return true;
  }
  return false;
}

void DipoleField::Builder::flush(const Vec3& center, Scratch& scratch) const
{
  if (scratch.batched == 0)
  {
    return;
  }
  const int degree = this->field.order_ + 1;
  const int stride = this->moment_count();
  HarmonicLanes from[3];
  for (int lane = 0; lane < harmonic_lanes; ++lane)
  {
    const bool used = lane < scratch.batched;
    const Id id = scratch.batch[used ? lane : 0];
    const Vec3 by = center - this->nodes[id].center;
    const double* moment = &this->moments[std::size_t(id) * stride];
    for (int k = 0; k < 3; ++k)
    {
      from[k].lane[lane] = by[harmonic_axes[k]];
    }
    for (int c = 1; 2 * c < stride; ++c)
    {
      scratch.in.real[c].lane[lane] = used ? moment[2 * c] : 0.0;
      scratch.in.imaginary[c].lane[lane] = used ? moment[2 * c + 1] : 0.0;
    }
  }
  irregular_harmonics(degree, from, scratch.at);
  multipole_to_local(degree, scratch.at, scratch.in, scratch.out);
  scratch.batched = 0;
}

void DipoleField::Builder::fill(Subtree& tree, const CellIndex& cell, std::size_t entry,
  const double* inherited_local, const ErrorEstimate& inherited_error,
  const std::vector<Id>& inherited, Scratch& scratch, std::size_t depth)
{
  const int degree = this->field.order_;
  const int count = harmonic_count(degree);
  const double size = std::ldexp(this->field.size_, -cell.level);
  const double radius = 0.8660254037844386 * size;
  const Vec3 center =
    this->field.lower_ + size * Vec3(cell.at[0] + 0.5, cell.at[1] + 0.5, cell.at[2] + 0.5);
  if (scratch.lists.size() <= depth + 1)
  {
    scratch.lists.resize(depth + 2);
    scratch.locals.resize(depth + 2);
  }
  std::vector<Id> near_nodes = std::move(scratch.lists[depth]);
  near_nodes.clear();
  scratch.out.clear(degree);
  scratch.error_estimate = inherited_error;
  std::vector<Id>& stack = scratch.stack;
  const auto collect_near = [&](Id root, double largest)
  {
    stack.assign(1, root);
    while (!stack.empty())
    {
      const Id id = stack.back();
      stack.pop_back();
      if (this->add_if_far(id, center, radius, scratch))
      {
        continue;
      }
      const Node& node = this->nodes[id];
      if (node.left >= 0 && node.radius > largest)
      {
        stack.push_back(node.right);
        stack.push_back(node.left);
      }
      else
      {
        near_nodes.push_back(id);
      }
    }
  };
  for (const Id id : inherited)
  {
    collect_near(id, 0.5 * radius);
  }
  double blocks = 0.0, sizes = 0.0;
  for (const Id id : near_nodes)
  {
    blocks += this->nodes[id].count;
    sizes += this->nodes[id].block_radius * this->nodes[id].count;
  }
  const bool leaf = blocks <= static_cast<double>(maximum_leaf_blocks) ||
    cell.level >= finest_level || radius * blocks <= this->finest_cell * sizes ||
    radius < 1e-6 * this->field.size_ ||
    !this->is_split_worthwhile(center, size, blocks, near_nodes.size());
  if (leaf)
  {
    std::vector<Id> rest;
    rest.swap(near_nodes);
    for (const Id id : rest)
    {
      collect_near(id, -1.0);
    }
  }
  this->flush(center, scratch);
  const ErrorEstimate error_estimate = scratch.error_estimate;
  std::vector<double> local(2 * static_cast<std::size_t>(count));
  for (int c = 0; c < count; ++c)
  {
    double re = 0.0, im = 0.0;
    for (int i = 0; i < harmonic_lanes; ++i)
    {
      re += scratch.out.real[c].lane[i];
      im += scratch.out.imaginary[c].lane[i];
    }
    local[2 * c] = inherited_local[2 * c] + re;
    local[2 * c + 1] = inherited_local[2 * c + 1] + im;
  }
  if (leaf)
  {
    this->emit_leaf(tree, entry, 0.5 * size, local, near_nodes);
    tree.leaves.push_back({ error_estimate, center, 0.5 * size });
  }
  else if (!this->context.canceled())
  {
    HarmonicLanes shift[3];
    for (int lane = 0; lane < harmonic_lanes; ++lane)
    {
      for (int k = 0; k < 3; ++k)
      {
        shift[k].lane[lane] = (lane >> harmonic_axes[k] & 1 ? 0.25 : -0.25) * size;
      }
    }
    for (int c = 0; c < count; ++c)
    {
      for (int lane = 0; lane < harmonic_lanes; ++lane)
      {
        scratch.in.real[c].lane[lane] = local[2 * c];
        scratch.in.imaginary[c].lane[lane] = local[2 * c + 1];
      }
    }
    regular_harmonics(degree, shift, scratch.at);
    local_to_local(degree, scratch.at, scratch.in, scratch.children);
    std::vector<double> children = std::move(scratch.locals[depth]);
    children.resize(harmonic_lanes * 2 * static_cast<std::size_t>(count));
    for (int lane = 0; lane < harmonic_lanes; ++lane)
    {
      for (int c = 0; c < count; ++c)
      {
        children[2 * (lane * count + c)] = scratch.children.real[c].lane[lane];
        children[2 * (lane * count + c) + 1] = scratch.children.imaginary[c].lane[lane];
      }
    }
    const std::size_t first = tree.cells.size();
    tree.cells[entry] = static_cast<Id>(first);
    tree.cells.resize(first + 8, 0);
    for (int child = 0; child < 8; ++child)
    {
      const CellIndex child_index{ cell.level + 1,
        { 2 * cell.at[0] + (child & 1), 2 * cell.at[1] + (child >> 1 & 1),
          2 * cell.at[2] + (child >> 2) } };
      this->fill(tree, child_index, first + child, &children[2 * child * count], error_estimate,
        near_nodes, scratch, depth + 1);
    }
    scratch.locals[depth] = std::move(children);
  }
  scratch.lists[depth] = std::move(near_nodes);
}

void DipoleField::Builder::emit_leaf(Subtree& tree, std::size_t entry, double half,
  const std::vector<double>& local, const std::vector<Id>& near_nodes) const
{
  const int degree = this->field.order_;
  tree.cells[entry] = ~static_cast<Id>(tree.run_count.size());
  for (int l = 0; l <= degree; ++l)
  {
    for (int part = 0; part < (l > 0 ? 2 : 1); ++part)
    {
      double scale = std::pow(half, l) * (l > 0 ? 2.0 : 1.0);
      for (int k = l; k <= degree; ++k)
      {
        tree.locals.push_back(scale * local[2 * harmonic_index(k, l) + part]);
        scale *= half;
      }
    }
  }
  Id runs = 0;
  for (const Id id : near_nodes)
  {
    const Node& node = this->nodes[id];
    if (runs > 0 && tree.runs.back().first + tree.runs.back().count == node.first)
    {
      tree.runs.back().count += node.count;
    }
    else
    {
      tree.runs.push_back({ node.first, node.count });
      ++runs;
    }
  }
  tree.run_count.push_back(runs);
}

bool DipoleField::Builder::fill_cells()
{
  DipoleField& f = this->field;
  const Id cells_per_axis = 1 << f.top_level_;
  const Index top_cells = static_cast<Index>(cells_per_axis) * cells_per_axis * cells_per_axis;
  std::vector<Subtree> trees(static_cast<std::size_t>(top_cells));
  const std::vector<double> zero_coefficients(
    2 * static_cast<std::size_t>(harmonic_count(f.order_)), 0.0);
  const std::vector<Id> root(1, 0);
  if (!parallel_for(this->context, top_cells, 1,
        [&](Index begin, Index end)
        {
          const auto scratch = std::make_unique<Scratch>();
          for (Index i = begin; i < end; ++i)
          {
            const auto at = static_cast<Id>(i);
            this->fill(trees[i],
              { f.top_level_,
                { at % cells_per_axis, at / cells_per_axis % cells_per_axis,
                  at / cells_per_axis / cells_per_axis } },
              0, zero_coefficients.data(), ErrorEstimate(), root, *scratch, 0);
          }
        }) ||
    this->context.canceled())
  {
    return false;
  }
  f.cells_.assign(static_cast<std::size_t>(top_cells), 0);
  f.first_run_.clear();
  f.runs_.clear();
  f.float_locals_.clear();
  f.double_locals_.clear();
  this->leaf_errors.clear();
  std::size_t cells = f.cells_.size(), leaves = 0, runs = 0;
  for (const Subtree& tree : trees)
  {
    cells += tree.cells.size() - 1;
    leaves += tree.run_count.size();
    runs += tree.runs.size();
  }
  f.cells_.reserve(cells);
  f.first_run_.reserve(leaves + 1);
  f.runs_.reserve(runs);
  const std::size_t coefficients =
    leaves * static_cast<std::size_t>(local_coefficient_count(f.order_));
  f.double_precision_ ? f.double_locals_.reserve(coefficients + polynomial_lanes)
                      : f.float_locals_.reserve(coefficients + polynomial_lanes);
  Id run = 0;
  for (Index i = 0; i < top_cells; ++i)
  {
    Subtree& tree = trees[i];
    const auto offset = static_cast<Id>(f.cells_.size()) - 1;
    const auto leaf_offset = static_cast<Id>(f.first_run_.size());
    for (Id& entry : tree.cells)
    {
      entry = entry < 0 ? ~(~entry + leaf_offset) : entry + offset;
    }
    f.cells_[i] = tree.cells[0];
    f.cells_.insert(f.cells_.end(), tree.cells.begin() + 1, tree.cells.end());
    for (const Id count : tree.run_count)
    {
      f.first_run_.push_back(run);
      run += count;
    }
    f.runs_.insert(f.runs_.end(), tree.runs.begin(), tree.runs.end());
    this->leaf_errors.insert(this->leaf_errors.end(), tree.leaves.begin(), tree.leaves.end());
    for (const double x : tree.locals)
    {
      f.double_precision_ ? f.double_locals_.push_back(x)
                          : f.float_locals_.push_back(static_cast<float>(x));
    }
    tree = Subtree();
  }
  f.first_run_.push_back(run);
  // Add padding, because contract_local() reads beyond the end of the last row.
  f.double_precision_ ? f.double_locals_.resize(coefficients + polynomial_lanes)
                      : f.float_locals_.resize(coefficients + polynomial_lanes);
  return true;
}

/// Return the largest error on the sample points, which are near triangles, in the cells, around
/// the cells, and where the estimated errors are largest. The error of a leaf's expansion is
/// largest at the corner that is nearest to the nodes of the expansion.
double DipoleField::Builder::measure()
{
  DipoleField& f = this->field;
  const Index blocks = f.block_count();
  const BlockRun all{ 0, static_cast<Id>(blocks) };
  Index samples = std::clamp<Index>(2000000 / std::max<Index>(1, blocks), 256, 4096);
  if (this->options.expected_points > 0)
  {
    samples = std::min(
      samples, std::max(minimum_samples, this->options.expected_points / points_per_sample));
  }
  const Index worst_leaf_samples =
    std::min<Index>(samples / 2, static_cast<Index>(this->leaf_errors.size()));
  std::partial_sort(this->leaf_errors.begin(), this->leaf_errors.begin() + worst_leaf_samples,
    this->leaf_errors.end(),
    [](const LeafError& s, const LeafError& t)
    {
      return s.error_estimate.size != t.error_estimate.size
        ? s.error_estimate.size > t.error_estimate.size
        : std::lexicographical_compare(
            s.center.begin(), s.center.end(), t.center.begin(), t.center.end());
    });
  std::vector<double> errors(static_cast<std::size_t>(samples));
  std::vector<double> float_errors(static_cast<std::size_t>(samples / 16 + 1), 0.0);
  parallel_for(this->context, samples, 8,
    [&](Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        // Low-discrepancy sequence: multiples of the powers of 1 / x, where x is the positive root
        // of x^4 = x + 1.
        const double n = static_cast<double>(i) + 0.5;
        Vec3 u(n * 0.8191725133961645, n * 0.6710436067037893, n * 0.5497004779019703);
        u = u.unaryExpr([](double x) { return x - std::floor(x); });
        Vec3 at;
        if (i < worst_leaf_samples)
        {
          const LeafError& leaf = this->leaf_errors[i];
          for (int k = 0; k < 3; ++k)
          {
            at[k] = leaf.center[k] +
              (leaf.error_estimate.direction_sum[k] > 0.0 ? 0.99 : -0.99) * leaf.half;
          }
        }
        else if (i % 2)
        {
          // Margin on each side, relative to the size of the cells' cube.
          const double margin = i % 4 == 1 ? 0.5 : 0.01;
          at = f.lower_ + f.size_ * ((1.0 + 2.0 * margin) * u - Vec3::Constant(margin));
        }
        else
        {
          const auto slot = std::min<Index>(blocks * triangle_lanes - 1,
            static_cast<Index>(
              n / static_cast<double>(samples) * static_cast<double>(blocks * triangle_lanes)));
          const Corners c = f.corners(slot);
          const Vec3 normal = (c[1] - c[0]).cross(c[2] - c[0]);
          const double length = normal.norm();
          at = (c[0] + c[1] + c[2]) / 3.0;
          if (length > 0.0)
          {
            const double normal_offset = (i % 4 ? 1.0 : -1.0) * std::pow(20.0, u[0] - 1.0) * 2.0;
            at += normal / length * normal_offset * std::sqrt(0.5 * length) +
              (u[1] - 0.5) * (c[1] - c[0]) + (u[2] - 0.5) * (c[2] - c[0]);
          }
        }
        bool touched = false;
        const double sum = f.near_sum(&all, 1, at, touched);
        errors[i] = std::abs(f.evaluate(at) - sum);
        if (i % 16 == 0 && !f.double_precision_)
        {
          float_errors[i / 16] = std::abs(f.exact_sum(at) - sum);
        }
      }
    });
  this->float_error = *std::max_element(float_errors.begin(), float_errors.end());
  return *std::max_element(errors.begin(), errors.end());
}

bool DipoleField::Builder::run(const Triangles& triangles, const std::vector<int>& multiplicities)
{
  DipoleField& f = this->field;
  this->add_triangles(triangles, multiplicities);
  if (this->ids.empty())
  {
    return !this->context.canceled();
  }
  const Tuning* tuning = tunings;
  while (tuning->tolerance > this->options.tolerance)
  {
    ++tuning;
  }
  f.order_ = std::clamp(
    this->options.order ? this->options.order : tuning->order, 2, largest_polynomial_order);
  this->finest_cell =
    this->options.finest_cell > 0.0 ? this->options.finest_cell : tuning->finest_cell;
  f.double_precision_ = this->options.tolerance < float_tolerance;
  const bool uses_direct_sum = DipoleField::uses_direct_sum(this->options.expected_points);
  if (!uses_direct_sum)
  {
    this->cut_long_triangles();
  }
  {
    const ProgressRange range(this->context, 0.0, 0.2);
    if (!this->sort_triangles())
    {
      return false;
    }
  }
  f.double_precision_ ? this->fill_blocks(f.double_blocks_) : this->fill_blocks(f.float_blocks_);
  if (this->options.finest_cell <= 0.0 && f.block_count() <= small_field_blocks)
  {
    this->finest_cell *= small_field_factor;
  }
  if (!uses_direct_sum)
  {
    const ProgressRange range(this->context, 0.2, 0.3);
    if (!this->find_multipoles())
    {
      return false;
    }
  }
  this->place_cells();
  this->threshold = first_threshold * this->options.tolerance;
  for (int round = 0;; ++round)
  {
    const ProgressRange range(this->context, 1.0 - 0.7 / (1 << round), 1.0 - 0.35 / (1 << round));
    if (uses_direct_sum)
    {
      this->set_up_direct_sum();
    }
    else
    {
      this->find_outer();
      if (!this->fill_cells())
      {
        return false;
      }
    }
    f.measured_error_ = this->measure();
    if (this->context.canceled())
    {
      return false;
    }
    const double requested = target_error * this->options.tolerance;
    if (this->float_error > largest_float_error * this->options.tolerance && !f.double_precision_)
    {
      f.double_precision_ = true;
      this->fill_blocks(f.double_blocks_);
      f.float_blocks_ = {};
      continue;
    }
    if (f.measured_error_ <= requested || round == 4 || uses_direct_sum)
    {

      return true;
    }
    this->threshold *= 0.8 * std::clamp(requested / f.measured_error_, 0.02, 1.0);
  }
}

bool DipoleField::uses_direct_sum(Index expected_points)
{
  return expected_points > 0 && expected_points <= maximum_direct_points;
}

bool DipoleField::build(ExecutionContext& context, const Points& points, const Triangles& triangles,
  const std::vector<int>& multiplicities, double touch_tolerance, const Options& options)
{
  *this = DipoleField();
  this->points_ = &points;
  this->touch_tolerance_ = touch_tolerance;
  Builder build(context, *this, options);
  const bool done = build.run(triangles, multiplicities);
  if (!done)
  {
    *this = DipoleField();
  }
  return done;
}

} // namespace bindpose
