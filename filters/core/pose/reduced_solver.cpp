// Pose time of reduced as-rigid-as-possible.
//
// With displacements D from rest (V' = V + M D) and Q = R - I for the rotations, what is minimised
// is
//     E(D, Q) = 1/2 <D, H D> - <P, D> - <Q, S0 + K D>,   H, K, S0 projected at bind time,
// because rest with R = I is a minimum of the energy: all its constant and linear terms cancel. The
// unknowns are split into given ones (blocks of full handles) and open ones D = D* + B Y, where D*
// is the best that meets the positions with Q = 0, and the columns of B keep them met and are
// orthonormal in H (B^T H B = I; B spans what the positions leave open). With C = K B one iteration
// is
//     S = S* + C Y                   covariances
//     Q = best rotations of S - I    the local step
//     Y = C^T Q                      the global step
// a product each with one dense matrix, and the energies after both half-steps are
//     after a local step   E = E* + 1/2 |Y|^2 - <Q, S>,
//     after a global step  E = E* - 1/2 |Y|^2 - <Q, S*>,   E* = 1/2 <D*, H D*> - <P, D*>.
//
// Anderson acceleration works on Y, whose length is the energy's own; C Y is carried along, so that
// an extrapolated Y costs no product. It is taken if its energy, with the rotations that fit it, is
// no higher than that of the plain Y. The last iterate is a plain one.
//
// Ranks are decided where the matrices are small: positions by a pivoted QR, the rest by a
// Cholesky factor that gives way to an eigenvalue decomposition when it finds itself
// ill-conditioned. What neither energy nor constraints see stays at rest.
#include "pose/reduced_solver.h"

#include "base/simd.h"
#include "pose/anderson.h"
#include "pose/pivot_rotation.h"
#include "pose/rotation_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <chrono>
#include <cmath>

namespace bindpose
{

namespace
{
using Rows = ReducedSpace::Rows;

/// Directions below this share of the largest eigenvalue count as seen by no energy.
constexpr double energy_rank = 1e-12;
/// Positions below this share of the largest pivot count as redundant.
constexpr double position_rank = 1e-9;
/// A position missed by more than this share of the diagonal contradicts others.
constexpr double contradiction = 1e-9;
/// Below this share of the rest energy an energy counts as zero for the tolerance.
constexpr double nothing_bends = 1e-6;

/// Energies this share of the rest energy apart are equal but for round-off.
constexpr double same_energy = 1e-15;

constexpr Index tile = 8;
typedef double Pack __attribute__((vector_size(tile * sizeof(double)), aligned(8), may_alias));

/// y_j = A x_j for j = 0, 1, 2; A has whole tiles of rows, columns follow each other, and so do the
/// x_j and the y_j.
BINDPOSE_SIMD_CLONES void multiply(Index rows, Index cols, const double* __restrict a,
  const double* x, Index x_stride, double* __restrict y)
{
  const double *x0 = x, *x1 = x + x_stride, *x2 = x + 2 * x_stride;
  Index r = 0;
  for (; r + 2 * tile <= rows; r += 2 * tile)
  {
    Pack s0 = {}, s1 = {}, s2 = {}, t0 = {}, t1 = {}, t2 = {};
    for (Index c = 0; c < cols; ++c)
    {
      const Pack u = *reinterpret_cast<const Pack*>(a + c * rows + r);
      const Pack v = *reinterpret_cast<const Pack*>(a + c * rows + r + tile);
      s0 += u * x0[c];
      t0 += v * x0[c];
      s1 += u * x1[c];
      t1 += v * x1[c];
      s2 += u * x2[c];
      t2 += v * x2[c];
    }
    *reinterpret_cast<Pack*>(y + r) = s0;
    *reinterpret_cast<Pack*>(y + r + tile) = t0;
    *reinterpret_cast<Pack*>(y + rows + r) = s1;
    *reinterpret_cast<Pack*>(y + rows + r + tile) = t1;
    *reinterpret_cast<Pack*>(y + 2 * rows + r) = s2;
    *reinterpret_cast<Pack*>(y + 2 * rows + r + tile) = t2;
  }
  for (; r < rows; r += tile)
  {
    Pack s0 = {}, s1 = {}, s2 = {};
    for (Index c = 0; c < cols; ++c)
    {
      const Pack u = *reinterpret_cast<const Pack*>(a + c * rows + r);
      s0 += u * x0[c];
      s1 += u * x1[c];
      s2 += u * x2[c];
    }
    *reinterpret_cast<Pack*>(y + r) = s0;
    *reinterpret_cast<Pack*>(y + rows + r) = s1;
    *reinterpret_cast<Pack*>(y + 2 * rows + r) = s2;
  }
}

BINDPOSE_ALWAYS_INLINE double sum_of(const Pack& p)
{
  return ((p[0] + p[4]) + (p[2] + p[6])) + ((p[1] + p[5]) + (p[3] + p[7]));
}

/// y_j = A^T x_j for j = 0, 1, 2, likewise.
BINDPOSE_SIMD_CLONES void multiply_transposed(Index rows, Index cols, const double* __restrict a,
  const double* __restrict x, double* __restrict y, Index y_stride)
{
  const double *x0 = x, *x1 = x + rows, *x2 = x + 2 * rows;
  Index c = 0;
  for (; c + 2 <= cols; c += 2)
  {
    const double *a0 = a + c * rows, *a1 = a0 + rows;
    Pack s0 = {}, s1 = {}, s2 = {}, t0 = {}, t1 = {}, t2 = {};
    for (Index r = 0; r < rows; r += tile)
    {
      const Pack u = *reinterpret_cast<const Pack*>(a0 + r);
      const Pack v = *reinterpret_cast<const Pack*>(a1 + r);
      const Pack p0 = *reinterpret_cast<const Pack*>(x0 + r);
      const Pack p1 = *reinterpret_cast<const Pack*>(x1 + r);
      const Pack p2 = *reinterpret_cast<const Pack*>(x2 + r);
      s0 += u * p0;
      t0 += v * p0;
      s1 += u * p1;
      t1 += v * p1;
      s2 += u * p2;
      t2 += v * p2;
    }
    y[c] = sum_of(s0);
    y[c + 1] = sum_of(t0);
    y[y_stride + c] = sum_of(s1);
    y[y_stride + c + 1] = sum_of(t1);
    y[2 * y_stride + c] = sum_of(s2);
    y[2 * y_stride + c + 1] = sum_of(t2);
  }
  for (; c < cols; ++c)
  {
    for (Index j = 0; j < 3; ++j)
    {
      Pack s = {};
      for (Index r = 0; r < rows; r += tile)
      {
        s += *reinterpret_cast<const Pack*>(a + c * rows + r) *
          *reinterpret_cast<const Pack*>(x + j * rows + r);
      }
      y[j * y_stride + c] = sum_of(s);
    }
  }
}

Index padded(Index count)
{
  return (count + tile - 1) / tile * tile;
}
} // namespace

void ReducedSolver::reset()
{
  *this = ReducedSolver();
}

void ReducedSolver::set_rotations(std::vector<double> rotations)
{
  this->rotations_ = std::move(rotations);
  this->warm_ = true;
}

void ReducedSolver::factor(
  const ReducedSpace& space, const Eigen::MatrixXd& stiffness, const Pose& pose)
{
  this->modes_ = modes_of(pose);
  this->open_.clear();
  this->positions_.clear();
  this->redundant_.clear();
  for (Index h = 0; h < static_cast<Index>(pose.size()); ++h)
  {
    if (holds_pivot(pose[static_cast<std::size_t>(h)].mode))
    {
      this->positions_.push_back(h);
    }
    if (holds_tail(pose[static_cast<std::size_t>(h)].mode))
    {
      this->positions_.push_back(h + static_cast<Index>(pose.size()));
    }
  }
  for (Index j = 0; j < space.columns; ++j)
  {
    if (j >= static_cast<Index>(pose.size()) ||
      this->modes_[static_cast<std::size_t>(j)] != HandleMode::full)
    {
      for (Index a = 0; a < 4; ++a)
      {
        this->open_.push_back(4 * j + a);
      }
    }
  }
  const auto size = static_cast<Index>(this->open_.size());
  const auto asked = static_cast<Index>(this->positions_.size());
  Eigen::MatrixXd open_stiffness(size, size), rows(asked, size);
  for (Index c = 0; c < size; ++c)
  {
    // Unknowns in units in which a column of M has size one; an empty column drops out.
    const Index from = this->open_[static_cast<std::size_t>(c)];
    const double scale = space.basis_scale[from];
    for (Index r = 0; r < size; ++r)
    {
      const Index row = this->open_[static_cast<std::size_t>(r)];
      open_stiffness(r, c) = scale * space.basis_scale[row] * stiffness(row, from);
    }
    for (Index r = 0; r < asked; ++r)
    {
      rows(r, c) = scale * space.pivot_rows(this->positions_[static_cast<std::size_t>(r)], from);
    }
  }

  // Positions: D = particular b + Z z with rows Z = 0; Z is the tail of the orthogonal factor.
  Eigen::MatrixXd free_space = Eigen::MatrixXd::Identity(size, size);
  this->particular_ = Eigen::MatrixXd::Zero(size, asked);
  if (asked > 0 && size > 0)
  {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows.transpose());
    qr.setThreshold(position_rank);
    const Index rank = qr.rank();
    const Eigen::MatrixXd orthogonal = qr.householderQ();
    free_space = orthogonal.rightCols(size - rank);
    for (Index r = rank; r < asked; ++r)
    {
      this->redundant_.push_back(
        this->positions_[static_cast<std::size_t>(qr.colsPermutation().indices()[r])] %
        static_cast<Index>(pose.size()));
    }
    if (rank > 0)
    {
      const Eigen::MatrixXd reduced = rows * orthogonal.leftCols(rank); // full column rank
      this->particular_ = orthogonal.leftCols(rank) *
        reduced.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(asked, asked));
    }
  }
  const Eigen::MatrixXd reduced = free_space.transpose() * open_stiffness * free_space;
  this->basis_.resize(size, 0);
  if (reduced.rows() > 0)
  {
    const Eigen::LLT<Eigen::MatrixXd> llt(reduced);
    if (llt.info() == Eigen::Success && llt.rcond() > 1e3 * energy_rank)
    {
      this->basis_ = llt.matrixL().solve(free_space.transpose()).transpose();
    }
    else
    {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(reduced);
      const double largest = std::max(eigen.eigenvalues().maxCoeff(), 0.0);
      const Index seen = (eigen.eigenvalues().array() > energy_rank * largest).count(); // the last
      this->basis_ = free_space * eigen.eigenvectors().rightCols(seen) *
        eigen.eigenvalues().tail(seen).cwiseSqrt().cwiseInverse().asDiagonal();
    }
  }
  for (Index r = 0; r < size; ++r)
  {
    const double scale = space.basis_scale[this->open_[static_cast<std::size_t>(r)]];
    this->particular_.row(r) *= scale;
    this->basis_.row(r) *= scale;
  }
  const Index clusters = space.groups.count, stride = space.stride;
  Eigen::MatrixXd open_covariance(space.covariance.rows(), size);
  for (Index c = 0; c < size; ++c)
  {
    open_covariance.col(c) = space.covariance.col(this->open_[static_cast<std::size_t>(c)]);
  }
  const Eigen::MatrixXd covariance = open_covariance * this->basis_;
  this->covariance_.assign(static_cast<std::size_t>(3 * stride * covariance.cols()), 0.0);
  for (Index c = 0; c < covariance.cols(); ++c)
  {
    for (Index i = 0; i < 3; ++i)
    {
      std::copy_n(covariance.data() + c * covariance.rows() + i * clusters, clusters,
        this->covariance_.data() + (3 * c + i) * stride);
    }
  }
}

/// A first guess without history: each cluster turns as the full handles near it do; what is near
/// other handles takes the rotation that fits all pivots, and the full handles' frames, best.
void ReducedSolver::start_rotations(const ReducedSpace& space, const Pose& pose)
{
  const double reach = 0.3 * space.radius; // the size of a full handle's frame
  const Eigen::Matrix3d common = pivot_rotation(space.handles, pose, reach);
  for (Index k = 0; k < space.groups.count; ++k)
  {
    Eigen::Matrix3d blend = 1e-9 * common;
    for (std::size_t h = 0; h < pose.size(); ++h)
    {
      const double w = space.cluster_weights(k, static_cast<Index>(h));
      blend += w *
        (pose[h].mode == HandleMode::full ? Eigen::Matrix3d(pose[h].transform.leftCols<3>())
                                          : common);
    }
    Eigen::Matrix3d rotation = common;
    fit_rotation(blend.transpose(), rotation);
    for (Index e = 0; e < 9; ++e)
    {
      this->rotations_[static_cast<std::size_t>(e * space.stride + k)] = rotation(e / 3, e % 3);
    }
  }
}

Status ReducedSolver::solve(ExecutionContext& context, const ReducedSpace& space,
  const Quadratic& quadratic, const Pose& pose, const ReducedSolveOptions& options, Rows& d)
{
  Status status = check_pose(space.handles, pose);
  if (!status.ok())
  {
    return status;
  }
  if (!same_modes(this->modes_, pose))
  {
    this->factor(space, quadratic.stiffness, pose);
  }
  if (!this->redundant_.empty())
  {
    status.warnings.push_back(
      "these positions are redundant (others determine them, or no weight is there): " +
      quoted_names(space.handles, this->redundant_));
  }

  // What this pose gives: blocks of full handles, targets of positions.
  const auto size = static_cast<Index>(this->open_.size());
  const Index clusters = space.groups.count, stride = space.stride;
  d = Rows::Zero(4 * space.columns, 3);
  for (std::size_t h = 0; h < pose.size(); ++h)
  {
    if (pose[h].mode == HandleMode::full)
    {
      const auto j = static_cast<Index>(h);
      d.middleRows<4>(4 * j) = space.block_of(pose[h].transform, j);
    }
  }
  const auto asked = static_cast<Index>(this->positions_.size());
  Rows wanted(asked, 3), target(asked, 3);
  for (Index r = 0; r < asked; ++r)
  {
    const Index h = this->positions_[static_cast<std::size_t>(r)];
    const auto handle = static_cast<std::size_t>(h) % pose.size();
    const Handle& rest = space.handles[handle];
    const Vec3 move = static_cast<std::size_t>(h) < pose.size()
      ? posed_pivot(rest, pose[handle]) - rest.head
      : posed_tail(rest, pose[handle]) - rest.tail;
    wanted.row(r) = move.transpose();
    target.row(r) = wanted.row(r) - space.pivot_rows.row(h) * d;
  }
  // D*: the positions met, then the given blocks, that and the load answered with Q = 0.
  Rows star = d;
  const Rows met = this->particular_ * target;
  for (Index r = 0; r < size; ++r)
  {
    star.row(this->open_[static_cast<std::size_t>(r)]) = met.row(r);
  }
  const Rows force = quadratic.stiffness * star - quadratic.load;
  Rows open_force(size, 3);
  for (Index r = 0; r < size; ++r)
  {
    open_force.row(r) = force.row(this->open_[static_cast<std::size_t>(r)]);
  }
  const Rows answer = this->basis_ * (this->basis_.transpose() * open_force);
  for (Index r = 0; r < size; ++r)
  {
    star.row(this->open_[static_cast<std::size_t>(r)]) -= answer.row(r);
  }
  const double star_energy = quadratic.constant +
    0.5 * (star.array() * (quadratic.stiffness * star).array()).sum() -
    (star.array() * quadratic.load.array()).sum();
  // Covariances in planes. In those of C Y the roles of row and column are exchanged: what one
  // column of Y makes lies together.
  const Index length = padded(this->basis_.cols()), planes = 9 * stride;
  std::vector<double> star_covariance = space.rest_covariance;
  {
    const Rows given = space.covariance * star;
    for (Index e = 0; e < 9; ++e)
    {
      for (Index k = 0; k < clusters; ++k)
      {
        star_covariance[static_cast<std::size_t>(e * stride + k)] +=
          given(e / 3 * clusters + k, e % 3);
      }
    }
  }

  this->rotations_.resize(static_cast<std::size_t>(planes), 0.0);
  if (options.start == ReducedStart::rest)
  {
    for (Index e = 0; e < 9; ++e)
    {
      std::fill_n(this->rotations_.begin() + static_cast<std::ptrdiff_t>(e * stride), clusters,
        e % 4 == 0 ? 1.0 : 0.0);
    }
  }
  else if (options.start == ReducedStart::guess || !this->warm_)
  {
    this->start_rotations(space, pose);
  }
  // Q and S row by column, Q in the padding zero; an iterate is the three columns of Y, then C Y.
  std::vector<double> q(static_cast<std::size_t>(planes), 0.0), s(q);
  std::vector<double> plain(static_cast<std::size_t>(3 * length + planes), 0.0), tried(plain);
  const auto take_rotations = [&]
  {
    for (Index e = 0; e < 9; ++e)
    {
      const double rest = e % 4 == 0 ? 1.0 : 0.0;
      const double* from = this->rotations_.data() + e * stride;
      double* to = q.data() + e * stride;
      for (Index k = 0; k < clusters; ++k)
      {
        to[k] = from[k] - rest;
      }
    }
  };
  // Row i of S goes with column i of the rotations.
  const auto paired = [&](const std::vector<double>& covariance)
  {
    double sum = 0.0;
    for (Index e = 0; e < 9; ++e)
    {
      sum += packed_dot(
        stride, q.data() + e * stride, covariance.data() + (3 * (e % 3) + e / 3) * stride);
    }
    return sum;
  };
  const auto half_square = [length](const std::vector<double>& iterate)
  { return 0.5 * packed_dot(3 * length, iterate.data(), iterate.data()); };
  const auto local_step = [&](const std::vector<double>& iterate)
  {
    for (Index e = 0; e < 9; ++e)
    {
      const double* moved = iterate.data() + 3 * length + (3 * (e % 3) + e / 3) * stride;
      const double* given = star_covariance.data() + e * stride;
      double* to = s.data() + e * stride;
      for (Index k = 0; k < stride; ++k)
      {
        to[k] = given[k] + moved[k];
      }
    }
    fit_rotations(clusters, stride, s.data(), this->rotations_.data());
    take_rotations();
    return star_energy + half_square(iterate) - paired(s);
  };
  const auto global_step = [&](std::vector<double>& iterate)
  {
    const Index columns = this->basis_.cols();
    multiply_transposed(
      3 * stride, columns, this->covariance_.data(), q.data(), iterate.data(), length);
    multiply(3 * stride, columns, this->covariance_.data(), iterate.data(), length,
      iterate.data() + 3 * length);
    return star_energy - half_square(iterate) - paired(star_covariance);
  };
  take_rotations();
  this->energies_.assign(1, global_step(plain));
  tried = plain;
  Anderson anderson(options.anderson_window, 3 * length, planes,
    [length](const double* a, const double* b) { return packed_dot(3 * length, a, b); });
  const double floor = nothing_bends * space.rest_energy;
  Index iterations = 0;
  bool converged = false, accelerated = false, in_time = true;
  double change = 0.0, microseconds = 0.0;
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [start]
  {
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start)
      .count();
  };
  while (iterations < options.max_iterations && !converged && in_time)
  {
    if (iterations % 64 == 63 && context.cancelled())
    {
      return Status::cancelled();
    }
    const double energy_before = this->energies_.back();
    double energy = local_step(accelerated ? tried : plain);
    if (accelerated && !(energy <= energy_before + same_energy * space.rest_energy))
    {
      anderson.forget();
      energy = local_step(plain);
      accelerated = false;
    }
    this->energies_.push_back(energy);
    if (!accelerated && options.anderson_window > 0)
    {
      tried = plain;
    }
    this->energies_.push_back(global_step(plain));
    ++iterations;
    energy = this->energies_.back();
    change = energy_before - energy;
    converged = options.tolerance > 0.0 && change <= options.tolerance * std::max(energy, floor);
    in_time = options.budget_microseconds <= 0.0 || elapsed() < options.budget_microseconds;
    accelerated = anderson.next(plain.data(), tried.data());
  }
  microseconds = elapsed();
  this->warm_ = true;

  const Rows best = this->basis_ *
    Eigen::Map<const Rows, 0, Eigen::OuterStride<>>(
      plain.data(), this->basis_.cols(), 3, Eigen::OuterStride<>(length));
  for (Index r = 0; r < size; ++r)
  {
    const Index row = this->open_[static_cast<std::size_t>(r)];
    d.row(row) = star.row(row) + best.row(r);
  }
  double residual = 0.0;
  std::vector<Index> contradicting;
  for (Index r = 0; r < asked; ++r)
  {
    const Index h = this->positions_[static_cast<std::size_t>(r)];
    const double miss =
      (space.pivot_rows.row(h) * d - wanted.row(r)).norm() / std::max(space.diagonal, 1e-300);
    residual = std::max(residual, miss);
    if (miss > contradiction)
    {
      contradicting.push_back(h % static_cast<Index>(pose.size()));
    }
  }
  if (!contradicting.empty())
  {
    status.warnings.push_back("these positions contradict each other or cannot be reached, the "
                              "worst is missed by " +
      std::to_string(residual * space.diagonal) + ": " +
      quoted_names(space.handles, contradicting));
  }
  status.report.set("energy", Report::Value(std::max(this->energies_.back(), 0.0)));
  status.report.set("iterations", Report::Value(std::int64_t(iterations)));
  if (iterations > 0)
  {
    status.report.set(
      "residual", Report::Value(std::max(change, 0.0) / std::max(this->energies_.back(), floor)));
  }
  status.report.set("microseconds_per_iteration",
    Report::Value(iterations > 0 ? microseconds / static_cast<double>(iterations) : 0.0));
  if (asked > 0)
  {
    status.report.set("constraint_residual", Report::Value(residual));
  }
  if (options.tolerance > 0.0 && !converged && options.max_iterations > 0)
  {
    status.code = StatusCode::not_converged;
    status.message = "the energy still fell by " + std::to_string(change) + " of " +
      std::to_string(this->energies_.back()) + " in the last of " + std::to_string(iterations) +
      " iterations" + (in_time ? "" : ", when the time budget was spent");
  }
  return status;
}

} // namespace bindpose
