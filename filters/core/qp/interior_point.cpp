// A primal-dual interior-point method for one column, with a slack for every inequality.
//
// The problem over the free vertices x is
//   min 1/2 x'Ax + c'x  subject to  Bx + h = s >= 0,
// where the rows of B are x >= l, x <= u and the ordered pairs. With multipliers z >= 0 the
// optimality conditions are
//   Ax + c - B'z = 0,   Bx + h - s = 0,   s z = 0.
// Newton's step for s z = target eliminates s and z and requires one factorization of
//   A + B' diag(z/s) B.
// This matrix has the pattern of A: bounds change only its diagonal, and pairs are edges of the
// mesh, which the pattern of A includes. So one ordering and one symbolic analysis serve all
// iterations.
//
// If available, the factorization is in single precision. The factor is the preconditioner of one
// or two steps of conjugate gradients in double precision (float_cholesky.cpp). If these steps are
// not accurate enough, the matrix is factored in double precision. With ordered pairs this always
// happens, because their multipliers span too many orders of magnitude.
//
// Slacks are separate variables: Bx + h = s holds only in the limit. An iterate may therefore
// violate the bounds temporarily. Separate slacks save about a third of the iterations, compared
// with slacks that are computed from x. Each factorization is used for a predictor, Mehrotra's
// corrector and a few of Gondzio's centrality correctors. Without pairs, the primal and the dual
// step have different lengths; with pairs, the lengths are equal. In both cases the choice was
// measured to be best.
//
// Near the minimum the central path converges slowly. Let mu be the mean of the products s z. The
// error of a tiny weight that is not at a bound decreases only like the square root of mu. So when
// the weights change little, a projected Newton method with the last factor is tried
// (projected_newton.cpp). If it does not converge, the interior-point method continues from its
// last iterate, which the attempt does not change.
//
// The result is never the interior iterate but its projection to the bounds (and to the order of
// the pairs). The certificate is computed for that projection.
#include "qp/interior_point.h"

#include "base/stopwatch.h"
#include "linear/refined_solve.h"
#include "qp/column_problem.h"
#include "qp/pair_rows.h"
#include "qp/projected_newton.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The solve of one column. Vectors over constraints have one entry per constraint: first x >= l
/// for each bounded vertex, then x <= u for each bounded vertex, then each pair.
class InteriorPoint
{
public:
  /// @param in_single whether factors in single precision may be used.
  InteriorPoint(ExecutionContext& context, const SplitForm& matrices, const BoxQpOptions& options,
    const BoxQpColumn& column, const VectorXd& unconstrained, const ColumnStart& start,
    const InverseForm& inverse, BoxQpWorkspace& workspace, bool in_single)
    : matrices_(matrices), options_(options), column_(column), unconstrained_(unconstrained),
      start_(start), inverse_(inverse), workspace_(workspace), context_(context),
      problem_(matrices, column), pairs_(matrices, problem_, column), float_is_accurate_(in_single)
  {
  }

  BoxQpSolution run();

private:
  Status set_up();
  void set_start(bool central);
  void balance_start();
  void raise_slacks(double least);
  VectorXd apply(const VectorXd& x) const; // Compute B x.
  VectorXd apply_transposed(const VectorXd& y) const; // Compute B' y.
  Status factor(const VectorXd& d);
  struct Direction
  {
    VectorXd x, s, z;
  };
  Status factor_double();
  MatrixXd multiply(const MatrixXd& x) const;
  bool solve_refined(const VectorXd& rhs, double accuracy, VectorXd& x);
  Direction solve(const VectorXd& target, double accuracy);
  double finish_by_newton(double small_change);
  static double longest_step(const VectorXd& at, const VectorXd& direction);
  void step_lengths(const Direction& d, double& primal, double& dual) const;
  Direction find_direction();
  void certify_iterate(bool second_bound = false);

  const SplitForm& matrices_;
  const BoxQpOptions& options_;
  const BoxQpColumn& column_;
  const VectorXd& unconstrained_; // #V
  const ColumnStart& start_;
  const InverseForm& inverse_;
  BoxQpWorkspace& workspace_;
  ExecutionContext& context_;

  const ColumnProblem problem_;
  std::vector<Index> unpinned_; // free indices of vertices that are not pinned
  std::vector<Index> bounded_; // the entries of unpinned_ whose vertices have bounds
  PairRows pairs_;
  VectorXd h_; // constant terms h of the constraints
  VectorXd x_, s_, z_;
  VectorXd rd_, rp_; // residuals of the first two optimality conditions
  VectorXd z_over_s_; // z / s
  // Terms that the bounds add to A's diagonal, and the weights z / s of the pairs.
  VectorXd bound_diagonal_, pair_diagonal_;
  VectorXd inverse_diagonal_; // 1 / diagonal of the factored matrix
  double shift_ = 0.0; // largest diagonal shift that a factorization in single precision has needed
  bool in_single_ = false; // whether the last factorization is in single precision
  bool float_is_accurate_;
  Status failure_; // status of a factorization that failed within solve()
  double mu_ = 0.0;
  BoxQpSolution best_;
  BoxQpSolution result_;
};

Status InteriorPoint::set_up()
{
  const ColumnProblem& problem = this->problem_;
  for (Index i = 0; i < problem.c.size(); ++i)
  {
    if (!problem.pinned[i])
    {
      this->unpinned_.push_back(i);
      if (std::isfinite(problem.lower[i]) && std::isfinite(problem.upper[i]))
      {
        this->bounded_.push_back(i);
      }
    }
  }
  const Status status = this->pairs_.prepare();
  if (!status.ok())
  {
    return status;
  }
  const auto nb = static_cast<Index>(this->bounded_.size());
  this->h_.resize(2 * nb + this->pairs_.count());
  for (Index i = 0; i < nb; ++i)
  {
    this->h_[i] = -this->problem_.lower[this->bounded_[i]];
    this->h_[nb + i] = this->problem_.upper[this->bounded_[i]];
  }
  this->h_.tail(this->pairs_.count()) = this->pairs_.constants();
  return {};
}

VectorXd InteriorPoint::apply(const VectorXd& x) const
{
  const auto nb = static_cast<Index>(this->bounded_.size());
  VectorXd y(this->h_.size());
  for (Index i = 0; i < nb; ++i)
  {
    y[i] = x[this->bounded_[i]];
    y[nb + i] = -y[i];
  }
  y.tail(this->pairs_.count()) = this->pairs_.apply(x);
  return y;
}

VectorXd InteriorPoint::apply_transposed(const VectorXd& y) const
{
  const auto nb = static_cast<Index>(this->bounded_.size());
  VectorXd x = VectorXd::Zero(this->problem_.c.size());
  for (Index i = 0; i < nb; ++i)
  {
    x[this->bounded_[i]] = y[i] - y[nb + i];
  }
  this->pairs_.add_transposed(y.tail(this->pairs_.count()), x);
  return x;
}

Status InteriorPoint::factor(const VectorXd& d)
{
  const Stopwatch watch;
  const auto& matrices = this->matrices_;
  SparseMatrix& matrix = this->workspace_.matrix;
  double* values = matrix.valuePtr();
  std::copy(
    matrices.lower.valuePtr(), matrices.lower.valuePtr() + matrices.lower.nonZeros(), values);
  const auto nb = static_cast<Index>(this->bounded_.size());
  for (Index i = 0; i < nb; ++i)
  {
    values[matrices.diagonal[this->bounded_[i]]] += d[i] + d[nb + i];
  }
  this->pairs_.add_to_matrix(d.tail(this->pairs_.count()), matrix);
  if (static_cast<Index>(this->unpinned_.size()) < matrix.cols())
  {
    SplitForm::decouple(this->problem_.pinned, matrix);
  }
  Status status;
  this->in_single_ = false;
  if (this->workspace_.single.is_analyzed() && this->float_is_accurate_)
  {
    this->bound_diagonal_ = VectorXd::Zero(this->problem_.c.size());
    for (Index i = 0; i < nb; ++i)
    {
      this->bound_diagonal_[this->bounded_[i]] = d[i] + d[nb + i];
    }
    this->pair_diagonal_ = d.tail(this->pairs_.count());
    this->inverse_diagonal_.resize(this->problem_.c.size());
    for (Index i = 0; i < this->problem_.c.size(); ++i)
    {
      this->inverse_diagonal_[i] = 1.0 / values[matrices.diagonal[i]];
    }
    // The factorization fails in single precision if a pivot of the matrix is not positive. A shift
    // of the diagonal then makes it succeed, and conjugate gradients correct the effect of the
    // shift. The next iteration starts with the same shift.
    constexpr double least_shift = 1e-6;
    constexpr double largest_shift = 1e-3;
    do
    {
      status = this->workspace_.single.factor(this->context_, matrix, this->shift_);
      this->result_.factorizations += 1;
    } while (status.code == StatusCode::invalid_input &&
      (this->shift_ = std::max(least_shift, 10.0 * this->shift_)) < 1.5 * largest_shift);
    this->in_single_ = status.ok();
    this->float_is_accurate_ = status.code != StatusCode::invalid_input;
  }
  if (!this->in_single_ && status.code != StatusCode::canceled)
  {
    status = this->factor_double();
  }
  this->result_.factor_seconds += watch.seconds();
  return status;
}

/// Factor the workspace's matrix in double precision.
Status InteriorPoint::factor_double()
{
  const auto& matrices = this->matrices_;
  SparseMatrix& matrix = this->workspace_.matrix;
  double* values = matrix.valuePtr();
  Status status = this->workspace_.solver.factor(matrix);
  this->result_.factorizations += 1;
  // In exact arithmetic all pivots are positive, but round-off can make a pivot negative. In this
  // case the diagonal is scaled up slightly. The Newton step becomes slightly shorter; the
  // minimizer does not change.
  for (double shift = 1e-14; !status.ok() && status.code == StatusCode::invalid_input &&
       shift < 1e-6 && !this->context_.canceled();
       shift *= 100.0)
  {
    for (const int k : matrices.diagonal)
    {
      values[k] *= 1.0 + shift;
    }
    status = this->workspace_.solver.factor(matrix);
    this->result_.factorizations += 1;
  }
  return status;
}

/// Multiply x by the matrix that was factored.
MatrixXd InteriorPoint::multiply(const MatrixXd& x) const
{
  MatrixXd y = this->matrices_.a.transpose() * x + this->bound_diagonal_.asDiagonal() * x;
  this->pairs_.add_product(this->pair_diagonal_, x, y);
  for (std::size_t i = 0; i < this->problem_.pinned.size(); ++i)
  {
    if (this->problem_.pinned[i])
    {
      y.row(static_cast<Index>(i)).setZero();
    }
  }
  return y;
}

/// Solve with the factor in single precision. One or two refinement iterations are usual.
/// @return false if the accuracy was not reached.
bool InteriorPoint::solve_refined(const VectorXd& rhs, double accuracy, VectorXd& x)
{
  MatrixXd result;
  const double residual = refined_solve(
    this->workspace_.single, [this](const MatrixXd& p) { return this->multiply(p); },
    this->inverse_diagonal_, rhs, { accuracy, 20, nullptr }, result);
  x = result;
  return residual <= accuracy;
}

/// Compute the Newton step that changes the products s z by `target`, to first order.
/// @param accuracy relative accuracy of the linear solve, if the factor is in single precision.
InteriorPoint::Direction InteriorPoint::solve(const VectorXd& target, double accuracy)
{
  const VectorXd per_s = target.cwiseQuotient(this->s_);
  VectorXd rhs =
    this->apply_transposed(per_s - this->z_over_s_.cwiseProduct(this->rp_)) - this->rd_;
  for (std::size_t i = 0; i < this->problem_.pinned.size(); ++i)
  {
    if (this->problem_.pinned[i])
    {
      rhs[static_cast<Index>(i)] = 0.0;
    }
  }
  Direction d;
  if (this->in_single_ && !this->solve_refined(rhs, accuracy, d.x) && !this->context_.canceled())
  {
    // Single precision is not accurate enough. Use double precision for the rest of this column.
    const Stopwatch watch;
    this->in_single_ = false;
    this->float_is_accurate_ = false;
    this->failure_ = this->factor_double();
    this->result_.factor_seconds += watch.seconds();
  }
  if (!this->in_single_ && this->failure_.ok())
  {
    this->workspace_.solver.solve(rhs, d.x);
  }
  d.s = this->apply(d.x) + this->rp_;
  d.z = per_s - this->z_over_s_.cwiseProduct(d.s);
  return d;
}

double InteriorPoint::longest_step(const VectorXd& at, const VectorXd& direction)
{
  double step = 1e300;
  for (Index i = 0; i < at.size(); ++i)
  {
    if (direction[i] < 0.0)
    {
      step = std::min(step, -at[i] / direction[i]);
    }
  }
  return step;
}

void InteriorPoint::step_lengths(const Direction& d, double& primal, double& dual) const
{
  primal = std::min(1.0, longest_step(this->s_, d.s));
  dual = std::min(1.0, longest_step(this->z_, d.z));
  if (this->pairs_.count() > 0)
  {
    primal = dual = std::min(primal, dual);
  }
}

InteriorPoint::Direction InteriorPoint::find_direction()
{
  const double count = static_cast<double>(this->s_.size());
  const VectorXd products = this->s_.cwiseProduct(this->z_);
  // Relative accuracy of the linear solve for the predictor. A smaller value saves no iteration
  // (measured).
  constexpr double predictor_accuracy = 1e-2;
  const double step_accuracy = this->pairs_.count() == 0 ? 1e-3 : 1e-5;
  Direction d = this->solve(-products, predictor_accuracy);
  double primal;
  double dual;
  this->step_lengths(d, primal, dual);
  const double affine = (this->s_ + primal * d.s).dot(this->z_ + dual * d.z) / count;
  const double sigma = std::pow(affine / this->mu_, 3.0);
  const double target_mu = sigma * this->mu_;
  VectorXd target = VectorXd::Constant(products.size(), target_mu) - products -
    primal * dual * d.s.cwiseProduct(d.z);
  d = this->solve(target, step_accuracy);
  this->step_lengths(d, primal, dual);

  constexpr int correctors = 5;
  // Each corrector is computed for longer steps than the last direction allows: both step lengths
  // are increased by this value, but to at most 1.
  constexpr double step_increase = 0.35;
  for (int k = 0; k < correctors && !this->context_.canceled(); ++k)
  {
    const double p = std::min(1.0, primal + step_increase);
    const double q = std::min(1.0, dual + step_increase);
    VectorXd change(products.size());
    for (Index i = 0; i < change.size(); ++i)
    {
      const double v = (this->s_[i] + p * d.s[i]) * (this->z_[i] + q * d.z[i]);
      const double lowest = 0.1 * target_mu;
      const double highest = 10.0 * target_mu;
      change[i] = v < lowest ? lowest - v : v > highest ? std::max(highest - v, -highest) : 0.0;
    }
    const VectorXd next_target = target + change;
    Direction next = this->solve(next_target, step_accuracy);
    double next_primal;
    double next_dual;
    this->step_lengths(next, next_primal, next_dual);
    if (next_primal + next_dual < primal + dual + 0.01)
    {
      break;
    }
    d = std::move(next);
    target = next_target;
    primal = next_primal;
    dual = next_dual;
  }
  return d;
}

/// Set the initial x, s and z.
/// @param central if true, use the start that was computed for all columns together (see
/// ColumnStart), if there is one.
void InteriorPoint::set_start(bool central)
{
  const auto& matrices = this->matrices_;
  if (central && this->start_.mu > 0.0)
  {
    this->x_ = this->start_.x;
    this->s_ = (this->apply(this->x_) + this->h_).cwiseMax(1e-12);
    this->z_ = this->start_.mu * this->s_.cwiseInverse();
    return;
  }
  const VectorXd& guess = this->column_.start.size() ? this->column_.start : this->unconstrained_;
  this->x_ = this->problem_.clamp_to_bounds(matrices, guess);
  double energy = this->column_.energy > 0.0
    ? this->column_.energy
    : 0.5 * this->unconstrained_.dot(matrices.q.transpose() * this->unconstrained_);
  const VectorXd feasible = this->problem_.extend_to_all(matrices, this->x_);
  const double feasible_energy = 0.5 * feasible.dot(matrices.q.transpose() * feasible);
  if (!(energy > 1e-9 * feasible_energy))
  {
    // If the minimizer without bounds is constant, its energy is zero. The energy of the start is
    // used instead; the start satisfies bounds and pins.
    energy = feasible_energy;
  }
  // Minimum of the slacks at the start. This value and the factor 10 in mu were measured on boxes
  // and on real shapes. Without the factor, twice as many iterations are needed.
  constexpr double least = 1e-2;
  this->s_ = this->apply(this->x_) + this->h_;
  this->raise_slacks(least);
  const double mu = 10.0 * energy / static_cast<double>(this->s_.size());
  this->z_ = mu * this->s_.cwiseInverse();
}

/// Correct a start that is far from the central path. If the start of a column did not converge in
/// splitting_start(), its multipliers are too small, and the following step lengths are short.
/// Larger multipliers and slacks halve the number of iterations.
void InteriorPoint::balance_start()
{
  const double gap = this->result_.certificate.relative_gap;
  // A start with a larger relative gap is corrected. The relative gaps of good starts are between
  // 1e-3 and 0.5.
  constexpr double maximum_start_gap = 1.0;
  constexpr double least_slack = 1e-3;
  // The new mu is at least mu_per_energy * energy / number of slacks. Values of mu_per_energy
  // from 1 to 10 are equally good (measured).
  constexpr double mu_per_energy = 3.0;
  if (this->start_.mu > 0.0 && gap > maximum_start_gap)
  {
    this->raise_slacks(least_slack);
    const double mu =
      mu_per_energy * this->result_.certificate.energy / static_cast<double>(this->s_.size());
    this->z_ = std::max(mu, this->start_.mu) * this->s_.cwiseInverse();
  }
}

/// Raise all slacks to a minimum.
/// @param least the minimum. For a vertex whose bounds are less than 1 apart, the minimum is
/// `least` times the distance between its bounds.
void InteriorPoint::raise_slacks(double least)
{
  VectorXd floor = VectorXd::Constant(this->h_.size(), least);
  const auto nb = static_cast<Index>(this->bounded_.size());
  for (Index i = 0; i < nb; ++i)
  {
    const Index at = this->bounded_[i];
    floor[i] = floor[nb + i] =
      least * std::min(1.0, this->problem_.upper[at] - this->problem_.lower[at]);
  }
  this->s_ = this->s_.cwiseMax(floor);
}

/// Project the iterate and compute its certificate.
/// @param second_bound if true, always compute the second bound on the gap (see Certificate).
void InteriorPoint::certify_iterate(bool second_bound)
{
  const auto& matrices = this->matrices_;
  this->result_.w = this->problem_.extend_to_all(matrices, this->x_);
  this->pairs_.enforce(this->result_.w);
  this->result_.multipliers = this->pairs_.extend_to_all_pairs(this->z_.tail(this->pairs_.count()));
  const BoundedEnergy problem{ matrices.q, this->problem_.is_column_free, this->column_.bounds };
  Certificate& certificate = this->result_.certificate;
  const bool bounds_everywhere = this->bounded_.size() == this->unpinned_.size();
  certificate = certify(problem, this->result_.w, this->column_.pairs, this->result_.multipliers,
    second_bound || !bounds_everywhere ? this->inverse_ : InverseForm());
  // If the first bound on the gap (see Certificate) is too large although the iterate is near the
  // optimum, the cause is round-off. The second bound on the gap is then needed.
  const double tolerance = this->options_.tolerance;
  if (!second_bound && bounds_everywhere && certificate.relative_gap > tolerance &&
    certificate.kkt_residual <= tolerance &&
    this->s_.dot(this->z_) <= tolerance * certificate.energy)
  {
    certificate = certify(
      problem, this->result_.w, this->column_.pairs, this->result_.multipliers, this->inverse_);
  }
}

/// Continue from the iterate with a projected Newton method. The iterate itself does not change.
/// @param small_change the method has converged if no weight changes by more than this in one
/// round.
/// @return the largest change in the last round. If it is at most `small_change`, result_ contains
/// the new point and its certificate.
double InteriorPoint::finish_by_newton(double small_change)
{
  constexpr int rounds = 6;
  VectorXd x = this->x_;
  for (const Index i : this->unpinned_)
  {
    x[i] = std::clamp(x[i], this->problem_.lower[i], this->problem_.upper[i]);
  }
  const double largest_change = projected_newton(
    this->context_, this->matrices_, this->problem_,
    [this](const VectorXd& r, VectorXd& z)
    {
      if (this->in_single_)
      {
        this->workspace_.single.solve(r, z);
      }
      else
      {
        this->workspace_.solver.solve(r, z);
      }
    },
    rounds, small_change, x);
  if (largest_change <= small_change)
  {
    std::swap(x, this->x_);
    this->certify_iterate(true);
    std::swap(x, this->x_);
  }
  return largest_change;
}

BoxQpSolution InteriorPoint::run()
{
  const Stopwatch watch;
  const auto largest_residual = [](const Certificate& c)
  { return std::max(c.relative_gap, c.kkt_residual); };
  const double tolerance = this->options_.tolerance;
  Status status = this->set_up();
  if (status.ok())
  {
    this->set_start(true);
    this->certify_iterate();
    this->best_ = this->result_;
    this->balance_start();
  }
  // After an iterate is certified, a few more iterations let the weights converge. These iterations
  // do not affect the status.
  constexpr int maximum_settling_iterations = 6;
  const double maximum_converged_change = converged_change(tolerance);
  int settling_iterations = 0;
  // The projected Newton method is tried if no weight changed by more than `newton_change_limit` in
  // the last iteration. It converges many times faster than the central path and requires only
  // solves with the current factor. After larger changes it fails too often (measured). It is also
  // tried once when the first iterate is certified.
  double newton_change_limit = 4e-5;
  int newton_attempts = 0;
  // 5 to 15 iterations are usual. If the form is very ill-conditioned (triharmonic energies of fine
  // meshes), the start that was computed for all columns together can lead to very short steps.
  // Therefore the solve begins again without this start if it has not converged after restart_after
  // iterations. After double_after iterations, the solve continues in double precision.
  constexpr int restart_after = 25;
  constexpr int double_after = 60;
  // With ordered pairs, the method stalls near the end if its factors are in single precision.
  // After this number of iterations without an improvement, double precision is used.
  constexpr int maximum_stalled = 3;
  int stalled = 0;
  double largest_change = this->h_.size() == 0 ? 0.0 : 1.0;
  const auto has_converged = [&]
  {
    return largest_residual(this->best_.certificate) <= tolerance &&
      (largest_change <= maximum_converged_change ||
        settling_iterations > maximum_settling_iterations);
  };
  while (
    status.ok() && !has_converged() && this->result_.iterations < this->options_.maximum_iterations)
  {
    if (this->context_.canceled())
    {
      status = Status::canceled();
      break;
    }
    if (this->result_.iterations == restart_after && this->start_.mu > 0.0 &&
      largest_residual(this->best_.certificate) > tolerance)
    {
      this->set_start(false);
    }
    this->float_is_accurate_ = this->float_is_accurate_ && this->result_.iterations < double_after;
    this->rp_ = this->apply(this->x_) + this->h_ - this->s_;
    this->rd_ = this->matrices_.a.transpose() * this->x_ + this->problem_.c -
      this->apply_transposed(this->z_);
    this->mu_ = this->s_.dot(this->z_) / static_cast<double>(this->s_.size());
    this->z_over_s_ = this->z_.cwiseQuotient(this->s_);
    status = this->factor(this->z_over_s_);
    if (!status.ok() || this->context_.canceled())
    {
      continue;
    }
    const Direction d = this->find_direction();
    if (!this->failure_.ok())
    {
      status = this->failure_;
      break;
    }
    double primal;
    double dual;
    this->step_lengths(d, primal, dual);
    const double step_fraction = 0.995;
    primal = primal < 1.0 ? step_fraction * primal : 1.0;
    dual = dual < 1.0 ? step_fraction * dual : 1.0;
    this->x_ += primal * d.x;
    this->s_ += primal * d.s;
    this->z_ += dual * d.z;
    this->result_.iterations += 1;
    const VectorXd previous = this->result_.w;
    this->certify_iterate();
    largest_change = (this->result_.w - previous).cwiseAbs().maxCoeff();
    settling_iterations += largest_residual(this->best_.certificate) <= tolerance;
    if (!(largest_residual(this->result_.certificate) >= largest_residual(this->best_.certificate)))
    {
      this->best_ = this->result_;
      stalled = 0;
    }
    else if (++stalled >= maximum_stalled && this->pairs_.count() > 0)
    {
      this->float_is_accurate_ = false;
    }
    if (!has_converged() && this->pairs_.count() == 0 &&
      (largest_change <= newton_change_limit ||
        (newton_attempts == 0 && largest_residual(this->best_.certificate) <= tolerance)))
    {
      const BoxQpSolution iterate = this->result_;
      const double small_change = converged_newton_change(tolerance);
      const double left = this->finish_by_newton(small_change);
      if (left <= small_change && largest_residual(this->result_.certificate) <= tolerance)
      {
        this->best_ = this->result_;
        largest_change = 0.0;
      }
      this->result_ = iterate;
      // If the projected Newton method nearly converged, try it again soon. Otherwise wait until
      // the weights change less per iteration.
      newton_change_limit = largest_change * std::clamp(small_change / left, 0.2, 0.8);
      ++newton_attempts;
    }
  }
  this->best_.iterations = this->result_.iterations;
  this->best_.factorizations = this->result_.factorizations;
  this->best_.factor_seconds = this->result_.factor_seconds;
  this->best_.solve_seconds = watch.seconds() - this->result_.factor_seconds;
  this->best_.status = status;
  if (status.ok() && largest_residual(this->best_.certificate) > tolerance)
  {
    this->best_.status.code = StatusCode::not_converged;
  }
  return this->best_;
}
} // namespace

BoxQpSolution interior_point(ExecutionContext& context, const SplitForm& matrices,
  const BoxQpOptions& options, const BoxQpColumn& column, const VectorXd& unconstrained,
  const ColumnStart& start, const InverseForm& inverse, BoxQpWorkspace& workspace)
{
  const auto run = [&](bool in_single)
  {
    return InteriorPoint(
      context, matrices, options, column, unconstrained, start, inverse, workspace, in_single)
      .run();
  };
  BoxQpSolution solution = run(true);
  // With ordered pairs, a column that fails in single precision is solved again in double
  // precision.
  if (!column.pairs.empty() && workspace.single.is_analyzed() && !solution.status.ok() &&
    solution.status.code != StatusCode::canceled)
  {
    BoxQpSolution exact = run(false);
    exact.factorizations += solution.factorizations;
    exact.factor_seconds += solution.factor_seconds;
    exact.solve_seconds += solution.solve_seconds;
    return exact;
  }
  return solution;
}

} // namespace bindpose
