// Pose time of full as-rigid-as-possible: the alternation of local and global steps (bind time:
// full_arap_bind.cpp).
//
// With displacements D from rest and Q = R - I for the rotations R, the energy is
//
//     E(D, Q) = 1/2 <D, L D> - <Q, S0 + K D>.
//
// L is the stiffness, S0 + K D are the covariances, and K^T Q is the force on the vertices. There
// is no constant term and no term that is linear in D alone, because rest with R = I is a minimum.
// The local step fits R to the covariances. The global step solves L D = K^T Q under the handles'
// constraints.
//
// Anderson acceleration treats a local and a global step together as one function g of D, and
// accelerates the iteration to the fixed point of g. All iterates satisfy the constraints, so
// extrapolated iterates also satisfy them. An extrapolated iterate is accepted if its energy, with
// the best rotations for it, is at most the energy of the plain iterate g(D).
//
// In exact arithmetic no step raises the energy. If the handles' constraints are nearly dependent,
// the condition number of the constraints limits the accuracy of the global step. If a global step
// raises the energy by more than round-off, the points before this step are kept and the iterations
// end.
#include "arap/full_arap.h"

#include "arap/anderson.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "pose/pivot_rotation.h"
#include "pose/rotation_fit.h"

#include <chrono>
#include <cmath>
#include <map>

namespace bindpose
{

namespace
{
/// A rise of the energy is round-off if it is at most this fraction of the sum of the absolute
/// values of the energy's terms.
constexpr double rounding = 1e-12;
/// Number of items per block. The block sizes affect the round-off of the sums; the number of
/// threads does not.
constexpr Index groups_per_block = 512;
constexpr Index vertices_per_block = 1024;
constexpr Index numbers_per_block = 16384;

double dot(ExecutionContext& context, Index count, const double* a, const double* b)
{
  return parallel_sum(context, count, numbers_per_block,
    [&](Index begin, Index end) { return packed_dot(end - begin, a + begin, b + begin); });
}
} // namespace

Status FullArap::prepare(const Pose& pose)
{
  this->modes_.clear();
  this->grips_.choose(pose);
  Status status = this->system_.prepare(this->stiffness_, this->parts_.component_of_vertex,
    this->parts_.count, this->grips_.prescribed(), this->grips_.constrained());
  if (!status.ok())
  {
    return status;
  }
  this->factorizations_ += 1;
  this->modes_ = modes_of(pose);
  return status;
}

/// Compute initial rotations from the pose only. Each handle prescribes a matrix at its constrained
/// points. For a handle in mode full, this matrix is the linear part of the transform. For any
/// other handle, it is the rotation that best fits the whole pose (pivot_rotation()). Laplace's
/// equation extends the matrices over the mesh. The results are projected to rotations.
void FullArap::start_rotations(const Pose& pose)
{
  const Eigen::Matrix3d global_rotation = pivot_rotation(this->handles_, pose, 0.3 * this->radius_);
  Rows prescribed = Rows::Zero(static_cast<Index>(this->grips_.prescribed().size()), 9), field;
  Rows constrained = Rows::Zero(static_cast<Index>(this->grips_.constrained().size()), 9);
  Eigen::VectorXd handle_counts = Eigen::VectorXd::Zero(prescribed.rows());
  for (const MeshGrips::Constraint& constraint : this->grips_.constraints())
  {
    const HandlePose& handle = pose[constraint.handle];
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> delta =
      (constrains_transform(handle.mode) ? Eigen::Matrix3d(handle.transform.leftCols<3>())
                                         : global_rotation) -
      Eigen::Matrix3d::Identity();
    const Eigen::Map<const Eigen::Matrix<double, 1, 9>> row(delta.data());
    if (constraint.prescribed >= 0)
    {
      prescribed.row(constraint.prescribed) += row;
      handle_counts[constraint.prescribed] += 1.0;
    }
    else if (constraint.constrained >= 0)
    {
      constrained.row(constraint.constrained) = row;
    }
  }
  prescribed.array().colwise() /= handle_counts.array();
  this->system_.solve(Rows::Zero(this->rest_.rows(), 9), prescribed, constrained, field);
  for (Index k = 0; k < this->groups_.count; ++k)
  {
    Eigen::Matrix3d blend = Eigen::Matrix3d::Zero();
    double count = 0.0;
    for (const int v : this->group_vertices_[k])
    {
      if (v >= 0)
      {
        const Vec3 x = field.row(v).segment<3>(0), y = field.row(v).segment<3>(3),
                   z = field.row(v).segment<3>(6);
        blend.row(0) += x.transpose();
        blend.row(1) += y.transpose();
        blend.row(2) += z.transpose();
        count += 1.0;
      }
    }
    blend = (blend / count + Eigen::Matrix3d::Identity()).eval();
    Eigen::Matrix3d rotation = global_rotation;
    fit_rotation(blend.transpose(), rotation);
    for (Index e = 0; e < 9; ++e)
    {
      this->rotations_[e * this->stride_ + k] = rotation(e / 3, e % 3);
    }
  }
}

/// Compute the covariances of D, the rotations that best fit them, and the energy term
/// `rotation_term_`.
bool FullArap::local_step(ExecutionContext& context, const Rows& d)
{
  const Index count = this->groups_.count, stride = this->stride_;
  const Index blocks = (count + groups_per_block - 1) / groups_per_block;
  std::vector<double> block_sums(blocks, 0.0);
  const bool done = parallel_for(context, count, groups_per_block,
    [&](Index begin, Index end)
    {
      for (Index k = begin; k < end; ++k)
      {
        Eigen::Matrix3d s = Eigen::Matrix3d::Zero();
        for (Index t = this->group_terms_.begin[k]; t < this->group_terms_.begin[k + 1]; ++t)
        {
          const double* b = this->group_terms_.b.data() + 3 * t;
          const double* moved = d.data() + 3 * Index(this->group_terms_.item[t]);
          s += Eigen::Map<const Vec3>(b) * Eigen::Map<const Vec3>(moved).transpose();
        }
        for (Index e = 0; e < 9; ++e)
        {
          this->covariance_[e * stride + k] =
            this->rest_covariance_[e * stride + k] + s(e / 3, e % 3);
        }
      }
      fit_rotations(
        end - begin, stride, this->covariance_.data() + begin, this->rotations_.data() + begin);
      double sum = 0.0;
      for (Index k = begin; k < end; ++k)
      {
        for (Index e = 0; e < 9; ++e)
        {
          const double delta = this->rotations_[e * stride + k] - (e % 4 == 0 ? 1.0 : 0.0);
          sum += delta * this->covariance_[(3 * (e % 3) + e / 3) * stride + k];
        }
      }
      block_sums[begin / groups_per_block] = sum;
    });
  this->rotation_term_ = 0.0;
  for (const double sum : block_sums)
  {
    this->rotation_term_ += sum;
  }
  return done;
}

/// Compute the displacements D that minimize the energy for the current rotations.
bool FullArap::global_step(ExecutionContext& context, Rows& d)
{
  const Index count = this->groups_.count, stride = this->stride_;
  const Index blocks = (count + groups_per_block - 1) / groups_per_block;
  std::vector<double> block_sums(blocks, 0.0);
  bool done = parallel_for(context, count, groups_per_block,
    [&](Index begin, Index end)
    {
      double sum = 0.0;
      for (Index k = begin; k < end; ++k)
      {
        for (Index e = 0; e < 9; ++e)
        {
          const double delta = this->rotations_[e * stride + k] - (e % 4 == 0 ? 1.0 : 0.0);
          this->rotation_deltas_[9 * k + e] = delta;
          sum += delta * this->rest_covariance_[(3 * (e % 3) + e / 3) * stride + k];
        }
      }
      block_sums[begin / groups_per_block] = sum;
    });
  this->rest_rotation_term_ = 0.0;
  for (const double sum : block_sums)
  {
    this->rest_rotation_term_ += sum;
  }
  const Index n = this->rest_.rows();
  this->force_.resize(n, 3);
  done = done &&
    parallel_for(context, n, vertices_per_block,
      [&](Index begin, Index end)
      {
        for (Index v = begin; v < end; ++v)
        {
          Vec3 sum = Vec3::Zero();
          for (Index t = this->vertex_terms_.begin[v]; t < this->vertex_terms_.begin[v + 1]; ++t)
          {
            const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> delta(
              this->rotation_deltas_.data() + 9 * Index(this->vertex_terms_.item[t]));
            sum += delta * Eigen::Map<const Vec3>(this->vertex_terms_.b.data() + 3 * t);
          }
          this->force_.row(v) = sum.transpose();
        }
      });
  if (done)
  {
    this->system_.solve(this->force_, this->prescribed_, this->constrained_, d);
  }
  return done && !context.canceled();
}

/// Return 1/2 <D, L D>.
double FullArap::quadratic(ExecutionContext& context, const Rows& d) const
{
  return 0.5 *
    parallel_sum(context, d.rows(), vertices_per_block,
      [&](Index begin, Index end)
      {
        double sum = 0.0;
        for (Index v = begin; v < end; ++v)
        {
          Vec3 force = Vec3::Zero();
          for (SparseMatrix::InnerIterator it(this->stiffness_, v); it; ++it)
          {
            force += it.value() * Eigen::Map<const Vec3>(d.data() + 3 * it.row());
          }
          sum += force.dot(Eigen::Map<const Vec3>(d.data() + 3 * v));
        }
        return sum;
      });
}

Status FullArap::solve(ExecutionContext& context, const Pose& pose, const SolveOptions& options)
{
  Status status = check_pose(this->handles_, pose);
  if (!status.ok())
  {
    return status;
  }
  if (this->frame_.is_identity())
  {
    return this->solve_in_frame(context, pose, options);
  }
  status = this->solve_in_frame(context, to_frame(this->frame_, pose), options);
  if (status.usable())
  {
    this->posed_ = this->frame_.from_frame(this->posed_);
  }
  return status;
}

Status FullArap::solve_in_frame(
  ExecutionContext& context, const Pose& pose, const SolveOptions& options)
{
  Status status;
  if (!same_modes(this->modes_, pose))
  {
    Phase phase(context, "factor", 0.0, 0.2);
    status = this->prepare(pose);
    if (!status.ok())
    {
      this->modes_.clear();
      return status;
    }
  }
  if (context.canceled())
  {
    return Status::canceled();
  }
  status.warnings = this->grips_.redundancy(pose, this->system_.redundant());
  this->grips_.targets(pose, this->prescribed_, this->constrained_);

  const Index n = this->rest_.rows();
  ProgressRange iterating(context, 0.2, 1.0);
  if (options.start == Start::rest)
  {
    for (Index e = 0; e < 9; ++e)
    {
      std::fill_n(
        this->rotations_.begin() + e * this->stride_, this->groups_.count, e % 4 == 0 ? 1.0 : 0.0);
    }
  }
  else if (options.start == Start::guess || !this->has_rotations_)
  {
    this->start_rotations(pose);
  }
  this->has_rotations_ = false; // rotations are valid only after a successful solve
  double magnitude = 0.0; // sum of the absolute values of the terms of the last energy
  const auto energy_after_global = [&](const Rows& g)
  {
    const double quadratic_term = this->quadratic(context, g);
    const double work = n > 0 ? dot(context, 3 * n, this->force_.data(), g.data()) : 0.0;
    magnitude = std::abs(quadratic_term) + std::abs(work) + std::abs(this->rest_rotation_term_);
    return quadratic_term - work - this->rest_rotation_term_;
  };
  Rows g, d; // the plain iterate and the candidate iterate
  if (!this->global_step(context, g))
  {
    return Status::canceled();
  }
  d = g;
  this->energies_.assign(1, energy_after_global(g));
  const double floor = negligible_energy * this->rest_energy_;
  Anderson<double> anderson(options.anderson_window, 3 * n, 0,
    [&](const double* a, const double* b) { return dot(context, 3 * n, a, b); });
  Index iterations = 0;
  bool converged = false, accelerated = false;
  double change = 0.0, rise = 0.0;
  const auto start = std::chrono::steady_clock::now();
  while (iterations < options.max_iterations && !converged)
  {
    const double total = static_cast<double>(options.max_iterations);
    ProgressRange range(context, static_cast<double>(iterations) / total,
      static_cast<double>(iterations + 1) / total);
    const double energy_before = this->energies_.back();
    bool done = this->local_step(context, d);
    double energy = this->quadratic(context, d) - this->rotation_term_;
    if (accelerated && done && !(energy <= energy_before))
    {
      d = g;
      anderson.clear_history();
      done = this->local_step(context, d);
      energy = this->quadratic(context, d) - this->rotation_term_;
    }
    this->energies_.push_back(energy);
    if (!done || !this->global_step(context, g))
    {
      return Status::canceled();
    }
    const double energy_after = energy_after_global(g);
    ++iterations;
    if (energy_after > energy + rounding * magnitude)
    {
      rise = energy_after - energy;
      g.swap(d);
      break;
    }
    this->energies_.push_back(energy_after);
    change = energy_before - this->energies_.back();
    converged = options.tolerance > 0.0 &&
      change <= options.tolerance * std::max(this->energies_.back(), floor);
    accelerated =
      !converged && iterations < options.max_iterations && anderson.next(g.data(), d.data());
    if (!accelerated)
    {
      d = g;
    }
  }
  const double microseconds =
    std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  if (context.canceled())
  {
    return Status::canceled();
  }
  this->has_rotations_ = true;

  const double residual = this->grips_.residual(pose, g, status.warnings);
  for (Index v = 0; v < n; ++v)
  {
    if (this->leader_[v] >= 0)
    {
      g.row(v) = g.row(this->leader_[v]);
    }
  }
  this->posed_ = this->rest_ + g;

  status.report.set("energy", std::max(this->energies_.back(), 0.0));
  status.report.set("iterations", iterations);
  status.report.set("microseconds_per_iteration",
    iterations > 0 ? microseconds / static_cast<double>(iterations) : 0.0);
  status.report.set(
    "counts.constrained", this->grips_.prescribed().size() + this->grips_.constrained().size());
  if (!this->grips_.constraints().empty())
  {
    status.report.set("constraint_residual", residual);
  }
  const std::string energy = short_number(this->energies_.back());
  if (rise > 0.0)
  {
    status.warnings.push_back("iteration " + std::to_string(iterations) +
      " increased the energy by " + short_number(rise) + " of " + energy +
      " because the constraints of the handles are nearly dependent; the points of the previous "
      "iteration are returned");
    converged = rise <= options.tolerance * std::max(this->energies_.back(), floor);
  }
  if (options.tolerance > 0.0 && !converged && options.max_iterations > 0)
  {
    status.code = StatusCode::not_converged;
    status.message = "the energy still " + std::string(rise > 0.0 ? "increased" : "decreased") +
      " by " + short_number(std::abs(rise > 0.0 ? rise : change)) + " of " + energy +
      " in the last of " + std::to_string(iterations) + " iterations";
  }
  return status;
}

std::vector<Eigen::Matrix3d> FullArap::rotations() const
{
  return rotation_matrices(this->groups_.count, this->stride_, this->rotations_);
}

} // namespace bindpose
