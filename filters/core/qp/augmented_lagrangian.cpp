// An augmented Lagrangian method for one column with ordered pairs.
//
// The problem over the free vertices x is
//   min 1/2 x'Ax + c'x  subject to  l <= x <= u  and  Bx + h = s >= 0,
// where the rows of B are the ordered pairs. With multipliers lambda >= 0 and penalties rho > 0 of
// the pairs, the method alternates two steps:
//   x = argmin 1/2 x'Ax + c'x + sum (max(0, lambda - rho s)^2 - lambda^2) / (2 rho),  l <= x <= u
//   lambda = max(0, lambda - rho s)
// A pair is active if lambda - rho s > 0. The first step is a projected Newton method with the
// matrix
//   A + B' diag(rho of the active pairs) B.
// This matrix has the pattern of A, because pairs are edges of the mesh. So one ordering and one
// symbolic analysis serve all columns. Each Newton system is solved by conjugate gradients. The
// preconditioner is the last factor in single precision. If conjugate gradients do not converge in
// a few steps, the active pairs have changed too much since this factor, and a new factor is
// computed.
//
// The multipliers of active pairs need not be unique (pairs can form cycles if their direction is
// ignored). The penalties make every step well-defined nevertheless. An active-set method that
// treats active pairs as equations would have to remove redundant pairs.
//
// The final x is changed as little as necessary to satisfy the pairs. The certificate is computed
// for this result.
#include "qp/augmented_lagrangian.h"

#include "base/stopwatch.h"
#include "linear/symmetric_product.h"
#include "qp/column_problem.h"
#include "qp/free_conjugate_gradients.h"
#include "qp/pair_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bindpose
{

namespace
{
using Eigen::VectorXd;

// The constants were measured on lattices and conforming tets of real surfaces, with 1k to 10k
// vertices and fifteen handles. Penalties above 1e4 make the linear systems too ill-conditioned for
// single precision.

/// Penalties, as multiples of the smaller diagonal entry of A at the two vertices of a pair.
constexpr double first_penalty = 3.0;
constexpr double largest_penalty = 3e3;
/// The penalties are raised if two conditions hold. First, the largest violation of a pair is more
/// than this fraction of the largest violation before the minimization. Second, the minimization
/// took few Newton steps.
constexpr double slow_decrease = 0.2;
constexpr double penalty_factor = 4.0;
constexpr int few_newton_steps = 3;
/// Options of the conjugate gradients in each Newton step.
constexpr FreeConjugateGradientsOptions cg_options{ 8, 0.05 };
constexpr int maximum_factorizations = 50;
/// Maximum number of Newton steps in total. It is needed because the multipliers of contradictory
/// pairs grow without limit.
constexpr int maximum_newton_steps = 300;
/// Maximum number of successive Newton steps that do not reduce the residual.
constexpr int maximum_idle_steps = 40;

class AugmentedLagrangian
{
public:
  AugmentedLagrangian(ExecutionContext& context, const SplitForm& matrices,
    const BoxQpOptions& options, const BoxQpColumn& column, const VectorXd& start,
    const InverseForm& inverse, BoxQpWorkspace& workspace)
    : matrices_(matrices), options_(options), column_(column), inverse_(inverse),
      workspace_(workspace), context_(context), problem_(matrices, column),
      pairs_(matrices, problem_, column), own_diagonal_(matrices.a.diagonal()), x_(start)
  {
  }

  BoxQpSolution run();

private:
  void evaluate();
  double lagrangian(const VectorXd& x) const;
  void find_bounds();
  VectorXd multiply(const VectorXd& p) const;
  Status newton_step();
  Status factor();
  VectorXd newton_direction();
  VectorXd move(const VectorXd& direction, double step) const;
  bool certify_iterate();

  const SplitForm& matrices_;
  const BoxQpOptions& options_;
  const BoxQpColumn& column_;
  const InverseForm& inverse_;
  BoxQpWorkspace& workspace_;
  ExecutionContext& context_;
  const ColumnProblem problem_;
  PairRows pairs_;
  const VectorXd own_diagonal_; // diagonal of A

  VectorXd x_; // current iterate; one entry per free vertex, within the bounds
  VectorXd lambda_, rho_; // multipliers and penalties, one entry per row of B
  // evaluate() computes the following members from x_, lambda_ and rho_.
  VectorXd next_lambda_; // max(0, lambda - rho s)
  VectorXd gradient_; // gradient of the augmented Lagrangian
  double violation_ = 0.0; // largest -s
  double residual_ = 0.0; // natural residual of the minimization (see Certificate)
  // The following members describe the Newton system.
  VectorXd active_rho_; // rho of active pairs, else 0
  VectorXd diagonal_; // diagonal of A + B' diag(active_rho_) B
  std::vector<char> at_bound_; // per free vertex: 1 if it moves to a bound
  bool needs_factor_ = true;
  std::vector<char> excluded_; // per free vertex: 1 if it is not in the last factor
  // Which vertices are treated as at a bound. True: only vertices whose value is already at a
  // bound. False: also vertices that the next step would move to a bound.
  bool only_reached_bounds_ = false;
  BoxQpSolution solution_;
};

/// Compute the members that depend on x_, lambda_ and rho_.
void AugmentedLagrangian::evaluate()
{
  const VectorXd s = this->pairs_.apply(this->x_) + this->pairs_.constants();
  this->next_lambda_ = (this->lambda_ - this->rho_.cwiseProduct(s)).cwiseMax(0.0);
  this->gradient_ = symmetric_product(this->matrices_.a, this->x_) + this->problem_.c;
  this->pairs_.add_transposed(-this->next_lambda_, this->gradient_);
  this->violation_ = s.size() > 0 ? std::max(0.0, -s.minCoeff()) : 0.0;
  this->residual_ = 0.0;
  for (Index i = 0; i < this->x_.size(); ++i)
  {
    if (!this->problem_.pinned[i])
    {
      const double to = std::clamp(this->x_[i] - this->gradient_[i] / this->own_diagonal_[i],
        this->problem_.lower[i], this->problem_.upper[i]);
      this->residual_ = std::max(this->residual_, std::abs(this->x_[i] - to));
    }
  }
}

double AugmentedLagrangian::lagrangian(const VectorXd& x) const
{
  const VectorXd s = this->pairs_.apply(x) + this->pairs_.constants();
  const VectorXd active = (this->lambda_ - this->rho_.cwiseProduct(s)).cwiseMax(0.0);
  return 0.5 * x.dot(symmetric_product(this->matrices_.a, x)) + this->problem_.c.dot(x) +
    0.5 * active.cwiseAbs2().cwiseQuotient(this->rho_).sum();
}

/// Choose the vertices that move to a bound in the next Newton step: those for which a Newton step
/// of the vertex alone would reach or cross the bound.
void AugmentedLagrangian::find_bounds()
{
  const ColumnProblem& problem = this->problem_;
  this->at_bound_ = problem.pinned;
  for (Index i = 0; i < this->x_.size(); ++i)
  {
    const double x = this->x_[i];
    const double to = x - this->gradient_[i] / this->diagonal_[i];
    const bool may_stay =
      !this->only_reached_bounds_ || x == problem.lower[i] || x == problem.upper[i];
    this->at_bound_[i] =
      this->at_bound_[i] || (may_stay && (to <= problem.lower[i] || to >= problem.upper[i]));
  }
}

/// Multiply p by the matrix of the Newton system.
VectorXd AugmentedLagrangian::multiply(const VectorXd& p) const
{
  VectorXd y = symmetric_product(this->matrices_.a, p);
  this->pairs_.add_product(this->active_rho_, p, y);
  return y;
}

/// Factor the matrix of the Newton system, without the vertices that move to a bound.
Status AugmentedLagrangian::factor()
{
  const Stopwatch watch;
  SparseMatrix& matrix = this->workspace_.matrix;
  const SparseMatrix& lower = this->matrices_.lower;
  std::copy(lower.valuePtr(), lower.valuePtr() + lower.nonZeros(), matrix.valuePtr());
  this->pairs_.add_to_matrix(this->active_rho_, matrix);
  const Status status =
    this->workspace_.single.factor_block(this->context_, matrix, this->at_bound_);
  this->excluded_ = this->at_bound_;
  this->needs_factor_ = false;
  this->solution_.factorizations += 1;
  this->solution_.iterations += 1;
  this->solution_.factor_seconds += watch.seconds();
  return status;
}

/// Return the direction of a Newton step. Each vertex at a bound moves as in a Newton step of this
/// vertex alone. The step of the other vertices minimizes the quadratic model.
VectorXd AugmentedLagrangian::newton_direction()
{
  const Index n = this->x_.size();
  VectorXd direction = VectorXd::Zero(n);
  for (Index i = 0; i < n; ++i)
  {
    if (this->at_bound_[i] && !this->problem_.pinned[i])
    {
      direction[i] = std::clamp(this->x_[i] - this->gradient_[i] / this->diagonal_[i],
                       this->problem_.lower[i], this->problem_.upper[i]) -
        this->x_[i];
    }
  }
  const int steps =
    free_conjugate_gradients([this](const VectorXd& p) { return this->multiply(p); },
      [&](const VectorXd& r, VectorXd& z)
      {
        this->workspace_.single.solve(r, z);
        for (Index i = 0; i < n; ++i)
        {
          // The factor does not contain the vertices that were at a bound when it was computed. For
          // these vertices, the preconditioner divides the residual by the diagonal.
          z[i] = this->excluded_[i] ? r[i] / this->diagonal_[i] : z[i];
        }
      },
      this->at_bound_, cg_options, -(this->gradient_ + this->multiply(direction)), direction);
  this->needs_factor_ = steps == cg_options.maximum_steps;
  return direction;
}

/// Return the point at a step along a direction, clamped to the bounds.
VectorXd AugmentedLagrangian::move(const VectorXd& direction, double step) const
{
  VectorXd x = this->x_ + step * direction;
  for (Index i = 0; i < x.size(); ++i)
  {
    x[i] = this->problem_.pinned[i]
      ? this->x_[i]
      : std::clamp(x[i], this->problem_.lower[i], this->problem_.upper[i]);
  }
  return x;
}

/// Try one projected Newton step.
Status AugmentedLagrangian::newton_step()
{
  this->active_rho_ = (this->next_lambda_.array() > 0.0).select(this->rho_, 0.0);
  this->diagonal_ = this->own_diagonal_;
  this->pairs_.add_diagonal(this->active_rho_, this->diagonal_);
  this->find_bounds();
  const Status status = this->needs_factor_ ? this->factor() : Status();
  if (!status.ok())
  {
    return status;
  }
  const VectorXd direction = this->newton_direction();
  VectorXd next = this->move(direction, 1.0);
  const double slope = this->gradient_.dot(next - this->x_);
  if (slope > 0.0 && !this->only_reached_bounds_)
  {
    // The step would increase the energy, because too many vertices would move to a bound at once.
    // In the next step, only vertices that are already at a bound are treated as at the bound.
    this->only_reached_bounds_ = true;
    return {};
  }
  // Armijo's rule. Ignore differences below the round-off of the energy.
  constexpr double sufficient_decrease = 1e-4;
  constexpr double round_off = 1e-15;
  constexpr double smallest_step = 1e-3;
  const double before = this->lagrangian(this->x_);
  double step = 1.0;
  while (step > smallest_step &&
    this->lagrangian(next) >
      before + sufficient_decrease * step * std::min(slope, 0.0) + round_off * std::abs(before))
  {
    step *= 0.5;
    next = this->move(direction, step);
  }
  this->x_ = std::move(next);
  return {};
}

/// Project the iterate and compute its certificate.
/// @return whether the certificate is within the tolerance.
bool AugmentedLagrangian::certify_iterate()
{
  this->solution_.w = this->problem_.extend_to_all(this->matrices_, this->x_);
  this->pairs_.enforce(this->solution_.w);
  this->solution_.multipliers = this->pairs_.extend_to_all_pairs(this->lambda_);
  const BoundedEnergy energy{ this->matrices_.q, this->problem_.is_column_free,
    this->column_.bounds };
  Certificate& certificate = this->solution_.certificate;
  certificate = certify(energy, this->solution_.w, this->column_.pairs, this->solution_.multipliers,
    this->context_.canceled() ? InverseForm() : this->inverse_);
  return std::max(certificate.relative_gap, certificate.kkt_residual) <= this->options_.tolerance;
}

BoxQpSolution AugmentedLagrangian::run()
{
  const Stopwatch watch;
  const double tolerance = this->options_.tolerance;
  const double maximum_converged_change = converged_change(tolerance);
  // Let r be the largest violation of a pair. The minimization for given multipliers ends if the
  // residual is at most max(required_residual * tolerance, residual_per_violation * r).
  double required_residual = 0.3;
  constexpr double residual_per_violation = 0.1;
  this->solution_.status = this->pairs_.prepare();
  if (!this->solution_.status.ok())
  {
    return std::move(this->solution_);
  }
  const VectorXd penalty_unit = this->pairs_.smallest_diagonals();
  double penalty = first_penalty;
  this->lambda_ = VectorXd::Zero(this->pairs_.count());
  this->rho_ = penalty * penalty_unit;
  const int most_factorizations =
    std::min(maximum_factorizations, this->options_.maximum_iterations);
  VectorXd previous = this->x_; // iterate at the last change of the multipliers
  double previous_violation = std::numeric_limits<double>::infinity();
  int newton_steps = 0;
  int newton_steps_at_change = 0;
  // Smallest residual since the last change of the multipliers.
  double smallest_residual = std::numeric_limits<double>::infinity();
  int idle_steps = 0;
  bool has_converged = false;
  Status status;
  while (true)
  {
    this->evaluate();
    if (this->residual_ <=
      std::max(required_residual * tolerance, residual_per_violation * this->violation_))
    {
      const double change = (this->x_ - previous).cwiseAbs().maxCoeff();
      const int steps = newton_steps - newton_steps_at_change;
      this->lambda_ = this->next_lambda_;
      if (this->violation_ <= tolerance && change <= maximum_converged_change)
      {
        has_converged = this->certify_iterate();
        required_residual *= 0.2; // after a failed certificate, require a smaller residual
      }
      if (has_converged)
      {
        break;
      }
      if (this->violation_ > tolerance && this->violation_ > slow_decrease * previous_violation &&
        steps <= few_newton_steps && penalty < largest_penalty)
      {
        penalty = std::min(penalty * penalty_factor, largest_penalty);
        this->rho_ = penalty * penalty_unit;
        this->needs_factor_ = true;
      }
      previous = this->x_;
      previous_violation = this->violation_;
      newton_steps_at_change = newton_steps;
      smallest_residual = std::numeric_limits<double>::infinity();
      this->only_reached_bounds_ = false;
      this->evaluate();
    }
    idle_steps = this->residual_ < smallest_residual ? 0 : idle_steps + 1;
    smallest_residual = std::min(smallest_residual, this->residual_);
    if (this->context_.canceled() || !this->gradient_.allFinite() ||
      newton_steps >= maximum_newton_steps || idle_steps > maximum_idle_steps ||
      (this->needs_factor_ && this->solution_.factorizations >= most_factorizations))
    {
      break;
    }
    status = this->newton_step();
    if (!status.ok())
    {
      break;
    }
    ++newton_steps;
  }
  if (!has_converged)
  {
    // After the maximum number of iterations, a certified iterate is a valid result even if the
    // weights still change.
    this->lambda_ = this->next_lambda_;
    const bool certified = this->certify_iterate();
    this->solution_.status = this->context_.canceled() ? Status::canceled()
      : certified && this->solution_.iterations >= this->options_.maximum_iterations
      ? Status()
      : Status::failure(StatusCode::not_converged, status.message);
  }
  this->solution_.solve_seconds = watch.seconds() - this->solution_.factor_seconds;
  return std::move(this->solution_);
}
} // namespace

BoxQpSolution augmented_lagrangian(ExecutionContext& context, const SplitForm& matrices,
  const BoxQpOptions& options, const BoxQpColumn& column, const VectorXd& start,
  const InverseForm& inverse, BoxQpWorkspace& workspace)
{
  return AugmentedLagrangian(context, matrices, options, column, start, inverse, workspace).run();
}

} // namespace bindpose
