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

#include "base/dense_cholesky.h"
#include "base/dense_product.h"
#include "base/number_text.h"
#include "base/thin_product.h"
#include "pose/pivot_rotation.h"
#include "pose/rotation_fit.h"

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

/// The columns that follow the first `rank` of the orthogonal factor of a QR decomposition, as
/// I - V T V^T with the reflections in V (Schreiber and Van Loan 1989).
class OrthogonalTail
{
public:
  OrthogonalTail(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr, Index rank)
    : rank_(rank), v_(qr.matrixQR().leftCols(rank)), t_(Eigen::MatrixXd::Zero(rank, rank))
  {
    this->v_.triangularView<Eigen::StrictlyUpper>().setZero();
    this->v_.diagonal().setOnes();
    const Eigen::MatrixXd products = this->v_.transpose() * this->v_;
    for (Index k = 0; k < rank; ++k)
    {
      const double factor = qr.hCoeffs()[k];
      this->t_(k, k) = factor;
      this->t_.col(k).head(k) = this->t_.topLeftCorner(k, k) * (-factor * products.col(k).head(k));
    }
  }

  /// M Z
  Eigen::MatrixXd times(const Eigen::MatrixXd& m) const
  {
    const Index count = m.cols() - this->rank_;
    return m.rightCols(count) -
      dense_product(dense_product(dense_product(m, this->v_), this->t_),
        this->v_.bottomRows(count).transpose());
  }
  /// Z
  Eigen::MatrixXd matrix() const
  {
    const Index count = this->v_.rows() - this->rank_;
    Eigen::MatrixXd z =
      -dense_product(this->v_, dense_product(this->t_, this->v_.bottomRows(count).transpose()));
    z.bottomRows(count).diagonal().array() += 1.0;
    return z;
  }

private:
  Index rank_;
  Eigen::MatrixXd v_, t_;
};
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

  // Positions: D = particular b + Z z with rows Z = 0; Z is the tail of the orthogonal factor,
  // which is kept as reflections.
  this->particular_ = Eigen::MatrixXd::Zero(size, asked);
  Eigen::MatrixXd covariance(space.covariance.rows(), size);
  for (Index c = 0; c < size; ++c)
  {
    const Index from = this->open_[static_cast<std::size_t>(c)];
    covariance.col(c) = space.basis_scale[from] * space.covariance.col(from);
  }
  Eigen::MatrixXd reduced = std::move(open_stiffness), free_space;
  Index rank = 0;
  if (asked > 0 && size > 0)
  {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(size, asked);
    qr.setThreshold(position_rank);
    qr.compute(rows.transpose());
    rank = qr.rank();
    for (Index r = rank; r < asked; ++r)
    {
      this->redundant_.push_back(
        this->positions_[static_cast<std::size_t>(qr.colsPermutation().indices()[r])] %
        static_cast<Index>(pose.size()));
    }
    if (rank > 0)
    {
      Eigen::MatrixXd range = Eigen::MatrixXd::Identity(size, rank);
      range.applyOnTheLeft(qr.householderQ());
      const Eigen::MatrixXd met = rows * range; // full column rank
      this->particular_ =
        range * met.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(asked, asked));
      const OrthogonalTail tail(qr, rank);
      free_space = tail.matrix();
      covariance = tail.times(covariance);
      reduced = tail.times(tail.times(reduced).transpose()); // H is symmetric
    }
  }
  if (rank == 0)
  {
    free_space = Eigen::MatrixXd::Identity(size, size);
  }
  // B = Z L^-T, C = K B; in single precision that would do for C, but not for directions that are
  // nearly the same.
  this->basis_.resize(size, 0);
  if (reduced.rows() > 0)
  {
    DenseCholesky cholesky;
    if (cholesky.factor(reduced) && cholesky.reciprocal_condition() > 1e3 * energy_rank)
    {
      this->basis_ = std::move(free_space);
      cholesky.solve_right(this->basis_);
      cholesky.solve_right(covariance);
    }
    else
    {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(reduced);
      const double largest = std::max(eigen.eigenvalues().maxCoeff(), 0.0);
      const Index seen = (eigen.eigenvalues().array() > energy_rank * largest).count(); // the last
      const Eigen::MatrixXd directions = eigen.eigenvectors().rightCols(seen) *
        eigen.eigenvalues().tail(seen).cwiseSqrt().cwiseInverse().asDiagonal();
      this->basis_ = dense_product(free_space, directions);
      covariance = dense_product(covariance, directions);
    }
  }
  for (Index r = 0; r < size; ++r)
  {
    const double scale = space.basis_scale[this->open_[static_cast<std::size_t>(r)]];
    this->particular_.row(r) *= scale;
    this->basis_.row(r) *= scale;
  }
  this->position_rows_.resize(asked, 4 * space.columns);
  for (Index r = 0; r < asked; ++r)
  {
    this->position_rows_.row(r) =
      space.pivot_rows.row(this->positions_[static_cast<std::size_t>(r)]);
  }
  this->iteration_.set_matrix(covariance, 1.0);
  const double unit = std::sqrt(space.rest_energy);
  this->has_single_ = std::isnormal(unit);
  if (this->has_single_)
  {
    this->single_iteration_.set_matrix(covariance, unit);
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
  Rows wanted(asked, 3);
  for (Index r = 0; r < asked; ++r)
  {
    const Index h = this->positions_[static_cast<std::size_t>(r)];
    const auto handle = static_cast<std::size_t>(h) % pose.size();
    const Handle& rest = space.handles[handle];
    const Vec3 move = static_cast<std::size_t>(h) < pose.size()
      ? posed_pivot(rest, pose[handle]) - rest.head
      : posed_tail(rest, pose[handle]) - rest.tail;
    wanted.row(r) = move.transpose();
  }
  // D*: the positions met, then the given blocks, that and the load answered with Q = 0.
  Rows star = d;
  if (asked > 0)
  {
    const Rows met =
      thin_product(this->particular_, wanted - thin_product(this->position_rows_, d));
    for (Index r = 0; r < size; ++r)
    {
      star.row(this->open_[static_cast<std::size_t>(r)]) = met.row(r);
    }
  }
  const Rows bent = thin_product(quadratic.stiffness, star);
  Rows open_force(size, 3);
  for (Index r = 0; r < size; ++r)
  {
    const Index row = this->open_[static_cast<std::size_t>(r)];
    open_force.row(r) = bent.row(row) - quadratic.load.row(row);
  }
  const Rows answer = transposed_thin_product(this->basis_, open_force);
  // The answer takes half its square from the energy: H is the identity for it.
  const double star_energy = quadratic.constant + 0.5 * (star.array() * bent.array()).sum() -
    (star.array() * quadratic.load.array()).sum() - 0.5 * answer.squaredNorm();
  const Rows answered = thin_product(this->basis_, answer);
  for (Index r = 0; r < size; ++r)
  {
    star.row(this->open_[static_cast<std::size_t>(r)]) -= answered.row(r);
  }
  std::vector<double> star_covariance = space.rest_covariance;
  {
    const Rows given = thin_product(space.covariance, star);
    for (Index e = 0; e < 9; ++e)
    {
      for (Index k = 0; k < clusters; ++k)
      {
        star_covariance[static_cast<std::size_t>(e * stride + k)] +=
          given(e / 3 * clusters + k, e % 3);
      }
    }
  }

  this->rotations_.resize(static_cast<std::size_t>(9 * stride), 0.0);
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

  const auto start = std::chrono::steady_clock::now();
  const double floor = nothing_bends * space.rest_energy;
  this->energies_.clear();
  ReducedProgress progress{ this->energies_ };
  ReducedLimits limits{ options.tolerance, floor, same_energy * space.rest_energy };
  if (options.budget_microseconds > 0.0)
  {
    limits.deadline = start +
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double, std::micro>(options.budget_microseconds));
  }
  Index single_iterations = 0;
  this->iteration_.begin(stride, star_covariance, this->rotations_);
  if (options.mixed_precision && this->has_single_ && options.max_iterations > 1)
  {
    limits.iterations = options.max_iterations - 1;
    this->single_iteration_.begin(stride, star_covariance, this->rotations_);
    if (this->single_iteration_.run(
          context, limits, options.anderson_window, star_energy, progress))
    {
      this->iteration_.go_on(this->single_iteration_);
      single_iterations = progress.iterations;
    }
    progress.in_time = true; // for one in double precision
  }
  if (!progress.cancelled)
  {
    // What has converged needs one more for its last digits.
    const bool converged = progress.converged;
    limits.iterations = converged ? 1 : options.max_iterations - progress.iterations;
    this->iteration_.run(context, limits, options.anderson_window, star_energy, progress);
    progress.converged |= converged;
  }
  if (progress.cancelled)
  {
    return Status::cancelled();
  }
  this->iteration_.rotations(stride, this->rotations_);
  const double microseconds =
    std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  const Index iterations = progress.iterations;
  const double change = progress.change;
  this->warm_ = true;

  const Rows best = thin_product(this->basis_, this->iteration_.coordinates());
  for (Index r = 0; r < size; ++r)
  {
    const Index row = this->open_[static_cast<std::size_t>(r)];
    d.row(row) = star.row(row) + best.row(r);
  }
  double residual = 0.0;
  std::vector<Index> contradicting;
  if (asked > 0)
  {
    const Rows missed = thin_product(this->position_rows_, d) - wanted;
    for (Index r = 0; r < asked; ++r)
    {
      const double miss = missed.row(r).norm() / std::max(space.diagonal, 1e-300);
      residual = std::max(residual, miss);
      if (miss > contradiction)
      {
        contradicting.push_back(
          this->positions_[static_cast<std::size_t>(r)] % static_cast<Index>(pose.size()));
      }
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
  status.report.set("single_precision_iterations", Report::Value(std::int64_t(single_iterations)));
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
  if (options.tolerance > 0.0 && !progress.converged && options.max_iterations > 0)
  {
    status.code = StatusCode::not_converged;
    status.message = "the energy still fell by " + short_number(change) + " of " +
      short_number(this->energies_.back()) + " in the last of " + std::to_string(iterations) +
      " iterations" + (progress.in_time ? "" : ", when the time budget was spent");
  }
  return status;
}

} // namespace bindpose
