// Pose time of reduced as-rigid-as-possible (Jacobson et al. 2012; bind time: reduced_space.cpp).
//
// With displacements D from rest (V' = V + M D) and Q = R - I for the rotations, the solver
// minimizes
//
//     E(D, Q) = 1/2 <D, H D> - <P, D> - <Q, S0 + K D>,
//
// where H is the stiffness, P a load and S0 + K D are the covariances. H, K and S0 are projected at
// bind time. The deformation energy (P = 0) has no constant term and no term that is linear in D
// alone, because rest with R = I is its minimum. A handle in mode full prescribes its block of D.
// The other unknowns are D = D* + B Y. D* is the displacement of minimum energy that satisfies the
// constrained positions with Q = 0. The columns of B span the displacements that do not change the
// constrained positions. They are orthonormal in H (B^T H B = I). With C = K B one iteration is
//
//     S = S* + C Y                   covariances
//     Q = best rotations of S - I    the local step
//     Y = C^T Q                      the global step
//
// S and Y are each computed by one product with the same dense matrix C. The energies after the two
// steps are
//
//     after a local step   E = E* + 1/2 |Y|^2 - <Q, S>,
//     after a global step  E = E* - 1/2 |Y|^2 - <Q, S*>,   E* = 1/2 <D*, H D*> - <P, D*>.
//
// Anderson acceleration extrapolates Y, whose squared length is in units of the energy. C Y is
// extrapolated with the same coefficients, so an extrapolated Y usually needs no product with C.
// The extrapolated Y is accepted if its energy, with the best rotations for it, is at most the
// energy of the plain Y. The last iterate is always a plain iterate.
//
// reduced_basis.cpp computes B. Displacements that affect neither the energy nor a constraint
// remain zero.
#include "arap/reduced_solver.h"

#include "base/number_text.h"
#include "linear/thin_product.h"
#include "pose/pivot_rotation.h"
#include "pose/rotation_fit.h"

#include <chrono>
#include <cmath>

namespace bindpose
{

namespace
{
using Rows = ReducedSpace::Rows;

/// Energies whose difference is at most this fraction of the rest energy are equal up to round-off.
constexpr double energy_tolerance = 1e-15;
} // namespace

void ReducedSolver::reset()
{
  *this = ReducedSolver();
}

void ReducedSolver::set_rotations(std::vector<double> rotations)
{
  this->rotations_ = std::move(rotations);
  this->has_rotations_ = true;
}

void ReducedSolver::factor(
  const ReducedSpace& space, const Eigen::MatrixXd& stiffness, const Pose& pose)
{
  this->modes_ = modes_of(pose);
  this->positions_.clear();
  const auto handles = static_cast<Index>(pose.size());
  std::vector<Index> free_dofs;
  for (Index h = 0; h < handles; ++h)
  {
    const HandleMode mode = this->modes_[static_cast<std::size_t>(h)];
    if (constrains_pivot(mode))
    {
      this->positions_.push_back(h);
    }
    if (constrains_tail(mode))
    {
      this->positions_.push_back(h + handles);
    }
  }
  for (Index j = 0; j < space.columns; ++j)
  {
    if (j >= handles || !constrains_transform(this->modes_[static_cast<std::size_t>(j)]))
    {
      for (Index a = 0; a < 4; ++a)
      {
        free_dofs.push_back(4 * j + a);
      }
    }
  }
  this->position_rows_ = space.pivot_rows(this->positions_, Eigen::all);
  this->basis_.make(space, stiffness, free_dofs, this->position_rows_);
  this->redundant_.clear();
  for (const Index r : this->basis_.redundant())
  {
    this->redundant_.push_back(this->positions_[static_cast<std::size_t>(r)] % handles);
  }
  this->basis_.extract_covariance(
    this->iteration_.matrix(space.groups.count, this->basis_.coordinates()));
  const double unit = std::sqrt(space.rest_energy);
  this->has_single_precision_ = std::isnormal(unit);
  if (this->has_single_precision_)
  {
    this->single_iteration_.set_matrix(this->iteration_, unit);
  }
}

/// Compute initial rotations from the pose only. The rotation of a cluster is a blend over all
/// handles, with their mean weights in the cluster. A handle in mode full contributes the linear
/// part of its transform. Every other handle contributes the same rotation, which best fits the
/// whole pose (pivot_rotation()).
void ReducedSolver::start_rotations(const ReducedSpace& space, const Pose& pose)
{
  const double pivot_radius = 0.3 * space.radius;
  const Eigen::Matrix3d global_rotation = pivot_rotation(space.handles, pose, pivot_radius);
  for (Index k = 0; k < space.groups.count; ++k)
  {
    Eigen::Matrix3d blend = 1e-9 * global_rotation;
    for (std::size_t h = 0; h < pose.size(); ++h)
    {
      const double w = space.cluster_weights(k, static_cast<Index>(h));
      blend += w *
        (constrains_transform(pose[h].mode) ? Eigen::Matrix3d(pose[h].transform.leftCols<3>())
                                            : global_rotation);
    }
    Eigen::Matrix3d rotation = global_rotation;
    fit_rotation(blend.transpose(), rotation);
    for (Index e = 0; e < 9; ++e)
    {
      this->rotations_[static_cast<std::size_t>(e * space.stride + k)] = rotation(e / 3, e % 3);
    }
  }
}

Status ReducedSolver::solve(ExecutionContext& context, const ReducedSpace& space,
  const Quadratic& quadratic, const Pose& given, const ReducedSolveOptions& options, Rows& d)
{
  Status status = check_pose(space.handles, given);
  if (!status.ok())
  {
    return status;
  }
  const bool needs_frame = !space.frame.is_identity();
  const Pose framed = needs_frame ? to_frame(space.frame, given) : Pose();
  const Pose& pose = needs_frame ? framed : given;
  if (!same_modes(this->modes_, pose))
  {
    this->factor(space, quadratic.stiffness, pose);
  }
  if (!this->redundant_.empty())
  {
    status.warnings.push_back("the position constraints of these handles are redundant (other "
                              "constraints determine them, or all weights at them are zero): " +
      quoted_names(space.handles, this->redundant_));
  }

  // The constraints of this pose are the blocks of D that handles in mode full prescribe, and the
  // targets of the constrained positions.
  const Index clusters = space.groups.count, stride = space.stride;
  d = Rows::Zero(4 * space.columns, 3);
  for (std::size_t h = 0; h < pose.size(); ++h)
  {
    if (constrains_transform(pose[h].mode))
    {
      const auto j = static_cast<Index>(h);
      d.middleRows<4>(4 * j) = space.block_of(pose[h].transform, j);
    }
  }
  const auto position_count = static_cast<Index>(this->positions_.size());
  Rows targets(position_count, 3);
  for (Index r = 0; r < position_count; ++r)
  {
    const Index h = this->positions_[static_cast<std::size_t>(r)];
    const auto handle = static_cast<std::size_t>(h) % pose.size();
    const Handle& rest = space.handles[handle];
    const Vec3 move = static_cast<std::size_t>(h) < pose.size()
      ? posed_pivot(rest, pose[handle]) - rest.head
      : posed_tail(rest, pose[handle]) - rest.tail;
    targets.row(r) = move.transpose();
  }
  const ReducedBasis::UnrotatedMinimizer minimizer = this->basis_.unrotated_minimizer(
    space, quadratic.stiffness, quadratic.load, d, targets - thin_product(this->position_rows_, d));
  const double unrotated_energy = quadratic.constant + minimizer.energy;
  std::vector<double> unrotated_covariance = space.rest_covariance;
  for (Index e = 0; e < 9; ++e)
  {
    for (Index k = 0; k < clusters; ++k)
    {
      unrotated_covariance[static_cast<std::size_t>(e * stride + k)] +=
        minimizer.covariance(e / 3 * clusters + k, e % 3);
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
  else if (options.start == ReducedStart::guess || !this->has_rotations_)
  {
    this->start_rotations(space, pose);
  }

  const auto start = std::chrono::steady_clock::now();
  const double floor = negligible_energy * space.rest_energy;
  this->energies_.clear();
  ReducedProgress progress{ this->energies_ };
  ReducedLimits limits{ options.tolerance, floor, energy_tolerance * space.rest_energy };
  if (options.budget_microseconds > 0.0)
  {
    limits.deadline = start +
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double, std::micro>(options.budget_microseconds));
  }
  Index single_iterations = 0;
  this->iteration_.begin(stride, unrotated_covariance, this->rotations_);
  if (options.mixed_precision && this->has_single_precision_ && options.max_iterations > 1)
  {
    limits.iterations = options.max_iterations - 1;
    this->single_iteration_.begin(stride, unrotated_covariance, this->rotations_);
    if (this->single_iteration_.run(
          context, limits, options.anderson_window, unrotated_energy, progress))
    {
      this->iteration_.continue_from(this->single_iteration_);
      single_iterations = progress.iterations;
    }
    progress.within_deadline = true; // always allow one iteration in double precision
  }
  if (!progress.canceled)
  {
    // A result that converged in single precision needs one more iteration in double precision for
    // its last digits.
    const bool converged = progress.converged;
    limits.iterations = converged ? 1 : options.max_iterations - progress.iterations;
    this->iteration_.run(context, limits, options.anderson_window, unrotated_energy, progress);
    progress.converged |= converged;
  }
  if (progress.canceled)
  {
    return Status::canceled();
  }
  this->iteration_.rotations(stride, this->rotations_);
  const double microseconds =
    std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  const Index iterations = progress.iterations;
  const double change = progress.change;
  this->has_rotations_ = true;

  d = this->basis_.displacement(minimizer, this->iteration_.coordinates());
  double residual = 0.0;
  std::vector<Index> contradicting;
  if (position_count > 0)
  {
    const Rows violations = thin_product(this->position_rows_, d) - targets;
    for (Index r = 0; r < position_count; ++r)
    {
      const double violation = violations.row(r).norm() / std::max(space.diagonal, 1e-300);
      residual = std::max(residual, violation);
      if (violation > contradiction_tolerance)
      {
        contradicting.push_back(
          this->positions_[static_cast<std::size_t>(r)] % static_cast<Index>(pose.size()));
      }
    }
  }
  if (!contradicting.empty())
  {
    status.warnings.push_back(
      "these handles have contradictory or unreachable positions, with a largest error of " +
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
  if (position_count > 0)
  {
    status.report.set("constraint_residual", Report::Value(residual));
  }
  if (options.tolerance > 0.0 && !progress.converged && options.max_iterations > 0)
  {
    status.code = StatusCode::not_converged;
    status.message = "the energy still decreased by " + short_number(change) + " of " +
      short_number(this->energies_.back()) + " in the last of " + std::to_string(iterations) +
      " iterations" + (progress.within_deadline ? "" : ", when the time budget was used up");
  }
  return status;
}

} // namespace bindpose
