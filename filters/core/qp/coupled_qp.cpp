// An interior-point method for columns that are coupled by row sums (see coupled_qp.h).
// Let s = w - l and t = u - w be slacks, z, r >= 0 the multipliers of the bounds and y the
// multipliers of the row sums. The optimality conditions are, for every column j over the free
// vertices,
//   A w_j + c_j - z_j + r_j + y = 0,   sum_j w_j = 1,   s z = 0,   t r = 0.
// The Newton step eliminates s, t, z and r. With H_j = A + diag(z_j / s_j + r_j / t_j), the
// remaining system is
//   H_j dw_j + dy = b_j,   sum_j dw_j = p,   so that   S dy = sum_j H_j^-1 b_j - p
// with S = sum_j H_j^-1. Here b_j is the right-hand side after the elimination, and p is the
// residual 1 - sum_j w_j. Every H_j is factored; S is not formed. S has the form of an additive
// Schwarz preconditioner. Where k columns are free, S is about k times the inverse of A. Therefore
// A, weighted by 1 / k, preconditions conjugate gradients for S. One step of conjugate gradients
// takes one solve with every H_j and one product with A.
//
// Some upper bounds follow from the row sum and the lower bounds of the other columns; for example,
// w <= 1 if all weights are >= 0. Such bounds are omitted, because their multipliers would not be
// unique.
//
// The certificate is computed for the projection of the iterate to rows that sum to one and are
// within the bounds. For any such rows w and q_j = Q w_j, the value
//   gap = sum over vertices of q . w - min { q . x : x sums to one, l <= x <= u }
// bounds E(w) - min E from above, independent of the method that computed w. The minimum over x is
// found by raising the entries of x to their upper bounds in the order of ascending q. The
// multiplier -y is the q of the entry that is raised only in part. The second bound of
// certificate.h, which is less sensitive to round-off, is also valid with q + y as gradient. The
// residual is
//   max |w - project(w - q / diag Q)|.
#include "qp/coupled_qp.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "qp/split_form.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bindpose
{

namespace
{
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The weights of one row that are solved for, and the sum that they must have.
struct Row
{
  std::vector<double> value, lower, upper, gradient;
  double sum = 1.0;

  void clear()
  {
    this->value.clear();
    this->lower.clear();
    this->upper.clear();
    this->gradient.clear();
  }
};

/// Replace the values by the nearest values that are within the bounds and have the required sum:
/// add the same shift to all values, then clip them to the bounds.
void project(Row& row)
{
  const std::size_t count = row.value.size();
  double least = 1e300;
  double most = -1e300;
  for (std::size_t k = 0; k < count; ++k)
  {
    least = std::min(least, row.lower[k] - row.value[k]);
    most = std::max(most, row.upper[k] - row.value[k]);
  }
  const auto clipped = [&](std::size_t k, double shift)
  { return std::clamp(row.value[k] + shift, row.lower[k], row.upper[k]); };
  // Bisection finds the clipped entries. The other entries are then computed without iteration.
  for (int step = 0; step < 60 && least < most; ++step)
  {
    const double shift = 0.5 * (least + most);
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k)
    {
      sum += clipped(k, shift);
    }
    (sum < row.sum ? least : most) = shift;
  }
  const double shift = 0.5 * (least + most);
  double missing = row.sum;
  double inside = 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    row.value[k] = clipped(k, shift);
    missing -= row.value[k];
    inside += row.value[k] > row.lower[k] && row.value[k] < row.upper[k];
  }
  for (std::size_t k = 0; k < count && inside > 0.0; ++k)
  {
    if (row.value[k] > row.lower[k] && row.value[k] < row.upper[k])
    {
      row.value[k] = std::clamp(row.value[k] + missing / inside, row.lower[k], row.upper[k]);
    }
  }
}

/// Minimize gradient . x over all rows x that are within the bounds and have the required sum:
/// raise the entries from their lower bounds, in the order of ascending gradients.
/// @return the gradient of the entry that is raised only in part.
double minimize_over_row(const Row& row, std::vector<std::size_t>& order, std::vector<double>& x)
{
  order.resize(row.value.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b)
    { return row.gradient[a] != row.gradient[b] ? row.gradient[a] < row.gradient[b] : a < b; });
  x = row.lower;
  double left = row.sum - std::accumulate(x.begin(), x.end(), 0.0);
  for (const std::size_t k : order)
  {
    const double range = row.upper[k] - row.lower[k];
    if (left <= range)
    {
      x[k] += std::max(0.0, left);
      return row.gradient[k];
    }
    x[k] = row.upper[k];
    left -= range;
  }
  return row.gradient[order.back()];
}

class CoupledQp
{
public:
  CoupledQp(ExecutionContext& context, const SparseMatrix& q, const std::vector<Index>& fixed,
    const std::vector<BoxQpColumn>& columns, const BoxQp& prepared, const BoxQpOptions& options)
    : matrices_(q, fixed), columns_(columns), prepared_(prepared), options_(options),
      context_(context), n_(static_cast<Index>(this->matrices_.free_vertices.size())),
      m_(static_cast<Index>(columns.size()))
  {
  }

  CoupledSolution run(const MatrixXd& start);

private:
  Status set_up();
  void set_start(const MatrixXd& start);
  Status factor();
  MatrixXd solve_columns(const MatrixXd& rhs);
  VectorXd sums_of_inverse(const VectorXd& y);
  void find_multipliers(const VectorXd& rhs, double accuracy, VectorXd& y);
  struct Direction
  {
    MatrixXd x, s, t, z, r;
    VectorXd y;
  };
  Direction solve(
    const MatrixXd& target_s, const MatrixXd& target_t, double accuracy, const VectorXd& guess);
  void step_lengths(const Direction& d, double& primal, double& dual) const;
  void certify_iterate();
  void row_of(Index i, const MatrixXd& w, const MatrixXd* gradient, Row& row) const;

  const SplitForm matrices_;
  const std::vector<BoxQpColumn>& columns_;
  const BoxQp& prepared_;
  const BoxQpOptions& options_;
  ExecutionContext& context_;
  const Index n_; // number of free vertices
  const Index m_; // number of columns

  MatrixXd given_values_; // #V x m: fixed and pinned values, 0 elsewhere
  MatrixXd is_solved_; // n x m: 1 where a weight is solved for, else 0
  MatrixXd lower_, upper_; // n x m
  MatrixXd has_upper_bound_; // n x m: 1 if the upper bound is used, 0 if it is omitted
  VectorXd sum_; // n: required sum of a row's solved weights
  std::vector<char> is_coupled_; // n: 1 if at least two weights of the row are solved for, else 0
  MatrixXd c_; // n x m: linear terms
  MatrixXd x_, s_, t_, z_, r_;
  VectorXd y_;
  MatrixXd rd_, rs_, rt_; // residuals
  VectorXd rp_;
  MatrixXd d_; // n x m: terms added to A's diagonal
  // For the preconditioner, n entries each: the diagonal scaling, and the smallest entry of each
  // row of d_.
  VectorXd row_scale_, smallest_d_;
  std::vector<SparseSolver> solvers_;
  CoupledSolution result_, best_;
  double factor_seconds_ = 0.0;
};

Status CoupledQp::set_up()
{
  const auto& free = this->matrices_.free_vertices;
  this->given_values_ = MatrixXd::Zero(this->matrices_.q.rows(), this->m_);
  this->is_solved_ = MatrixXd::Ones(this->n_, this->m_);
  this->lower_ = MatrixXd::Zero(this->n_, this->m_);
  this->upper_ = MatrixXd::Ones(this->n_, this->m_);
  this->has_upper_bound_ = MatrixXd::Zero(this->n_, this->m_);
  this->sum_ = VectorXd::Ones(this->n_);
  this->is_coupled_.assign(static_cast<std::size_t>(this->n_), 0);
  for (Index j = 0; j < this->m_; ++j)
  {
    const BoxQpColumn& column = this->columns_[j];
    for (std::size_t i = 0; i < this->matrices_.fixed.size(); ++i)
    {
      this->given_values_(this->matrices_.fixed[i], j) = column.fixed_values[static_cast<Index>(i)];
    }
    for (std::size_t i = 0; i < column.pinned.size(); ++i)
    {
      const Index at = this->matrices_.free_index[column.pinned[i]];
      if (at >= 0)
      {
        this->given_values_(column.pinned[i], j) = column.pinned_values[static_cast<Index>(i)];
        this->is_solved_(at, j) = 0.0;
        this->sum_[at] -= column.pinned_values[static_cast<Index>(i)];
      }
    }
    for (Index i = 0; i < this->n_; ++i)
    {
      this->lower_(i, j) = column.bounds.low(free[i]);
      this->upper_(i, j) = column.bounds.high(free[i]);
    }
  }
  constexpr double tolerance = 1e-9;
  for (Index i = 0; i < this->n_; ++i)
  {
    const auto is_solved = this->is_solved_.row(i).array();
    const double least = (is_solved * this->lower_.row(i).array()).sum();
    const double most = (is_solved * this->upper_.row(i).array()).sum();
    if (this->sum_[i] < least - tolerance || this->sum_[i] > most + tolerance)
    {
      this->result_.vertex = free[i];
      return Status::invalid_input("bounds and pins allow no weights that sum to one");
    }
    const auto count = static_cast<Index>(is_solved.sum());
    for (Index j = 0; j < this->m_ && count == 1; ++j)
    {
      if (this->is_solved_(i, j) == 1.0)
      {
        this->given_values_(free[i], j) =
          std::clamp(this->sum_[i], this->lower_(i, j), this->upper_(i, j));
        this->is_solved_(i, j) = 0.0;
        break;
      }
    }
    this->is_coupled_[i] = count > 1;
    for (Index j = 0; j < this->m_ && count > 1; ++j)
    {
      if (this->is_solved_(i, j) == 1.0)
      {
        const double others_lower_sum = least - this->lower_(i, j);
        this->has_upper_bound_(i, j) = this->upper_(i, j) < this->sum_[i] - others_lower_sum;
      }
    }
  }
  this->c_.resize(this->n_, this->m_);
  for (Index j = 0; j < this->m_; ++j)
  {
    this->c_.col(j) = this->matrices_.fixed_block * this->columns_[j].fixed_values;
    this->solvers_.push_back(this->prepared_.solver().clone());
  }
  const auto columns = static_cast<double>(this->m_);
  const auto numbers = static_cast<double>(this->n_) * columns;
  return check_memory("the factors of " + std::to_string(this->m_) + " coupled columns",
    columns * this->prepared_.solver().factor_bytes() + 30.0 * sizeof(double) * numbers,
    this->options_.solver.memory_limit);
}

void CoupledQp::row_of(Index i, const MatrixXd& w, const MatrixXd* gradient, Row& row) const
{
  row.clear();
  row.sum = this->sum_[i];
  for (Index j = 0; j < this->m_; ++j)
  {
    if (this->is_solved_(i, j) == 1.0)
    {
      row.value.push_back(w(i, j));
      row.lower.push_back(this->lower_(i, j));
      row.upper.push_back(this->upper_(i, j));
      row.gradient.push_back(gradient ? (*gradient)(i, j) : 0.0);
    }
  }
}

void CoupledQp::set_start(const MatrixXd& start)
{
  this->x_.resize(this->n_, this->m_);
  Row row;
  for (Index i = 0; i < this->n_; ++i)
  {
    const Index v = this->matrices_.free_vertices[i];
    for (Index j = 0; j < this->m_; ++j)
    {
      this->x_(i, j) = this->is_solved_(i, j) == 1.0 ? start(v, j) : this->given_values_(v, j);
    }
    if (this->is_coupled_[i])
    {
      this->row_of(i, this->x_, nullptr, row);
      project(row);
      for (Index j = 0, k = 0; j < this->m_; ++j)
      {
        if (this->is_solved_(i, j) == 1.0)
        {
          this->x_(i, j) = row.value[k++];
        }
      }
    }
  }
  MatrixXd gradient = this->matrices_.a.transpose() * this->x_ + this->c_;
  double energy = 0.0;
  for (Index j = 0; j < this->m_; ++j)
  {
    energy += 0.5 * this->x_.col(j).dot(gradient.col(j));
  }
  // The initial barrier weight is mu = mu_per_energy * energy / number of solved weights. With 0.1
  // or 0.01 for mu_per_energy, 1.5 times as many iterations are needed (measured).
  constexpr double least = 1e-2;
  constexpr double mu_per_energy = 1.0;
  const double mu = mu_per_energy * std::abs(energy) / std::max(1.0, this->is_solved_.sum());
  this->s_ = (this->x_ - this->lower_).cwiseMax(least * (this->upper_ - this->lower_));
  this->t_ = (this->upper_ - this->x_).cwiseMax(least * (this->upper_ - this->lower_));
  this->z_ = (mu * this->s_.cwiseInverse()).cwiseProduct(this->is_solved_);
  this->r_ = (mu * this->t_.cwiseInverse()).cwiseProduct(this->has_upper_bound_);
  gradient -= this->z_ - this->r_;
  this->y_ = VectorXd::Zero(this->n_);
  for (Index i = 0; i < this->n_; ++i)
  {
    if (this->is_coupled_[i])
    {
      this->y_[i] = -gradient.row(i).cwiseProduct(this->is_solved_.row(i)).sum() /
        this->is_solved_.row(i).sum();
    }
  }
}

Status CoupledQp::factor()
{
  const Stopwatch watch;
  this->d_ = this->z_.cwiseQuotient(this->s_) + this->r_.cwiseQuotient(this->t_);
  std::vector<Status> statuses(static_cast<std::size_t>(this->m_));
  const bool completed = parallel_for(this->context_, this->m_, 1,
    [&](Index begin, Index end)
    {
      for (Index j = begin; j < end; ++j)
      {
        SparseMatrix matrix = this->matrices_.lower;
        double* values = matrix.valuePtr();
        for (Index i = 0; i < this->n_; ++i)
        {
          for (int k = matrix.outerIndexPtr()[i]; k < matrix.outerIndexPtr()[i + 1]; ++k)
          {
            const Index other = matrix.innerIndexPtr()[k];
            values[k] = other == i                                                 ? values[k]
              : this->is_solved_(i, j) == 1.0 && this->is_solved_(other, j) == 1.0 ? values[k]
                                                                                   : 0.0;
          }
          values[this->matrices_.diagonal[i]] += this->d_(i, j);
        }
        Status& status = statuses[j];
        status = this->solvers_[j].factor(matrix);
        for (double shift = 1e-14; status.code == StatusCode::invalid_input && shift < 1e-6;
             shift *= 100.0)
        {
          for (const int k : this->matrices_.diagonal)
          {
            values[k] *= 1.0 + shift;
          }
          status = this->solvers_[j].factor(matrix);
        }
      }
    });
  this->result_.factorizations += static_cast<int>(this->m_);
  for (const Status& status : statuses)
  {
    if (!status.ok())
    {
      return status;
    }
  }
  // For the preconditioner, compute two values per vertex from the columns in which the vertex is
  // solved for: the smallest entry of d_, and the effective number of columns.
  const VectorXd diagonal = this->matrices_.a.diagonal();
  this->row_scale_ = VectorXd::Zero(this->n_);
  this->smallest_d_ = VectorXd::Zero(this->n_);
  for (Index i = 0; i < this->n_; ++i)
  {
    double least = 1e300;
    for (Index j = 0; j < this->m_; ++j)
    {
      least = this->is_solved_(i, j) == 1.0 ? std::min(least, this->d_(i, j)) : least;
    }
    double count = 0.0;
    for (Index j = 0; j < this->m_ && this->is_coupled_[i]; ++j)
    {
      count += this->is_solved_(i, j) * (diagonal[i] + least) / (diagonal[i] + this->d_(i, j));
    }
    this->smallest_d_[i] = this->is_coupled_[i] ? least : 0.0;
    this->row_scale_[i] = count > 0.0 ? 1.0 / std::sqrt(count) : 0.0;
  }
  this->factor_seconds_ += watch.seconds();
  return completed && !this->context_.canceled() ? Status() : Status::canceled();
}

/// Multiply each column j by H_j^-1. The result is 0 for weights that are not solved for.
MatrixXd CoupledQp::solve_columns(const MatrixXd& rhs)
{
  MatrixXd result(this->n_, this->m_);
  parallel_for(this->context_, this->m_, 1,
    [&](Index begin, Index end)
    {
      VectorXd x;
      for (Index j = begin; j < end; ++j)
      {
        this->solvers_[j].solve(VectorXd(rhs.col(j).cwiseProduct(this->is_solved_.col(j))), x);
        result.col(j) = x.cwiseProduct(this->is_solved_.col(j));
      }
    });
  return result;
}

/// Compute S y, the sum of H_j^-1 y over all columns j.
VectorXd CoupledQp::sums_of_inverse(const VectorXd& y)
{
  const MatrixXd parts = this->solve_columns(y.replicate(1, this->m_));
  VectorXd sum = VectorXd::Zero(this->n_);
  for (Index j = 0; j < this->m_; ++j)
  {
    sum += parts.col(j);
  }
  return sum;
}

/// Solve S y = rhs by conjugate gradients.
/// @param y initial guess, then the solution.
void CoupledQp::find_multipliers(const VectorXd& rhs, double accuracy, VectorXd& y)
{
  constexpr int most_steps = 200;
  const auto precondition = [&](const VectorXd& r) -> VectorXd
  {
    const VectorXd scaled = r.cwiseProduct(this->row_scale_);
    return (this->matrices_.a.transpose() * scaled + this->smallest_d_.cwiseProduct(scaled))
      .cwiseProduct(this->row_scale_);
  };
  VectorXd r = rhs - this->sums_of_inverse(y);
  const double target = accuracy * accuracy * rhs.dot(precondition(rhs));
  VectorXd z, p;
  double last_rz = 0.0;
  for (int k = 0; k < most_steps && !this->context_.canceled(); ++k)
  {
    z = precondition(r);
    const double rz = r.dot(z);
    if (!(rz > target))
    {
      break;
    }
    p = k == 0 ? z : VectorXd(z + (rz / last_rz) * p);
    last_rz = rz;
    const VectorXd product = this->sums_of_inverse(p);
    const double curvature = p.dot(product);
    if (!(curvature > 0.0))
    {
      break;
    }
    y += (rz / curvature) * p;
    r -= (rz / curvature) * product;
    this->result_.inner_iterations += 1;
  }
}

/// Compute the Newton step that changes the products s z by target_s and t r by target_t, to first
/// order.
CoupledQp::Direction CoupledQp::solve(
  const MatrixXd& target_s, const MatrixXd& target_t, double accuracy, const VectorXd& guess)
{
  const MatrixXd per_s = target_s.cwiseQuotient(this->s_);
  const MatrixXd per_t = target_t.cwiseQuotient(this->t_);
  const MatrixXd zs = this->z_.cwiseQuotient(this->s_);
  const MatrixXd rt = this->r_.cwiseQuotient(this->t_);
  const MatrixXd b =
    (-this->rd_ + per_s - zs.cwiseProduct(this->rs_) - per_t + rt.cwiseProduct(this->rt_))
      .cwiseProduct(this->is_solved_);
  const MatrixXd first = this->solve_columns(b);
  VectorXd rhs = -this->rp_;
  for (Index j = 0; j < this->m_; ++j)
  {
    rhs += first.col(j);
  }
  Direction d;
  d.y = guess;
  this->find_multipliers(rhs, accuracy, d.y);
  d.x = first - this->solve_columns(d.y.replicate(1, this->m_));
  d.s = d.x + this->rs_;
  d.t = -d.x + this->rt_;
  d.z = (per_s - zs.cwiseProduct(d.s)).cwiseProduct(this->is_solved_);
  d.r = (per_t - rt.cwiseProduct(d.t)).cwiseProduct(this->has_upper_bound_);
  return d;
}

void CoupledQp::step_lengths(const Direction& d, double& primal, double& dual) const
{
  primal = 1.0;
  dual = 1.0;
  for (Index j = 0; j < this->m_; ++j)
  {
    for (Index i = 0; i < this->n_; ++i)
    {
      if (this->is_solved_(i, j) == 1.0)
      {
        primal = d.s(i, j) < 0.0 ? std::min(primal, -this->s_(i, j) / d.s(i, j)) : primal;
        dual = d.z(i, j) < 0.0 ? std::min(dual, -this->z_(i, j) / d.z(i, j)) : dual;
      }
      if (this->has_upper_bound_(i, j) == 1.0)
      {
        primal = d.t(i, j) < 0.0 ? std::min(primal, -this->t_(i, j) / d.t(i, j)) : primal;
        dual = d.r(i, j) < 0.0 ? std::min(dual, -this->r_(i, j) / d.r(i, j)) : dual;
      }
    }
  }
}

void CoupledQp::certify_iterate()
{
  const SparseMatrix& q = this->matrices_.q;
  const auto& free = this->matrices_.free_vertices;
  MatrixXd inside(this->n_, this->m_);
  Row row;
  MatrixXd w = this->given_values_;
  for (Index i = 0; i < this->n_; ++i)
  {
    if (!this->is_coupled_[i])
    {
      continue;
    }
    this->row_of(i, this->x_, nullptr, row);
    project(row);
    for (Index j = 0, k = 0; j < this->m_; ++j)
    {
      if (this->is_solved_(i, j) == 1.0)
      {
        w(free[i], j) = row.value[k++];
      }
    }
  }
  Certificate& certificate = this->result_.certificate;
  certificate = {};
  const MatrixXd gradients = q.transpose() * w;
  MatrixXd g(this->n_, this->m_);
  for (Index i = 0; i < this->n_; ++i)
  {
    inside.row(i) = w.row(free[i]);
    g.row(i) = gradients.row(free[i]);
  }
  this->result_.columns.resize(static_cast<std::size_t>(this->m_));
  for (Index j = 0; j < this->m_; ++j)
  {
    BoxQpSolution& column = this->result_.columns[j];
    column.w = w.col(j);
    const double energy = 0.5 * w.col(j).dot(gradients.col(j));
    const double noise = 1e-14 * 0.5 * w.col(j).cwiseAbs2().dot(q.diagonal());
    column.certificate = {};
    column.certificate.energy = energy > noise ? energy : 0.0;
    certificate.energy += column.certificate.energy;
  }
  this->result_.multipliers = VectorXd::Zero(q.rows());
  double gap = 0.0;
  double second_gap = 0.0;
  double diagonal_sum = 0.0;
  MatrixXd residual = MatrixXd::Zero(this->n_, this->m_);
  std::vector<std::size_t> order;
  std::vector<double> x;
  const VectorXd diagonal = this->matrices_.a.diagonal();
  for (Index i = 0; i < this->n_; ++i)
  {
    if (!this->is_coupled_[i])
    {
      continue;
    }
    diagonal_sum += diagonal[i];
    this->row_of(i, inside, &g, row);
    const double critical = minimize_over_row(row, order, x);
    this->result_.multipliers[free[i]] = -critical;
    for (std::size_t k = 0; k < x.size(); ++k)
    {
      gap += (row.gradient[k] - critical) * (row.value[k] - x[k]);
    }
    for (Index j = 0, k = 0; j < this->m_; ++j)
    {
      if (this->is_solved_(i, j) != 1.0)
      {
        continue;
      }
      const double reduced_gradient = row.gradient[k] - critical;
      const double newton = row.value[k] - reduced_gradient / diagonal[i];
      if (newton > row.lower[k] && newton < row.upper[k])
      {
        residual(i, j) = reduced_gradient;
      }
      else
      {
        second_gap += std::max(reduced_gradient * (row.value[k] - row.lower[k]),
          -reduced_gradient * (row.upper[k] - row.value[k]));
      }
      ++k;
    }
    Row moved = row;
    for (std::size_t k = 0; k < row.value.size(); ++k)
    {
      moved.value[k] -= (row.gradient[k] - critical) / diagonal[i];
    }
    project(moved);
    for (std::size_t k = 0; k < row.value.size(); ++k)
    {
      certificate.kkt_residual =
        std::max(certificate.kkt_residual, std::abs(moved.value[k] - row.value[k]));
      certificate.bounds_violation = std::max(
        { certificate.bounds_violation, row.lower[k] - row.value[k], row.value[k] - row.upper[k] });
    }
  }
  const double floor = diagonal_sum > 0.0
    ? 0.5e-12 * diagonal_sum / static_cast<double>(this->n_) * static_cast<double>(this->m_)
    : 1.0;
  const double scale = std::max(certificate.energy, floor);
  if (gap > this->options_.tolerance * scale)
  {
    const MatrixXd inverse = this->prepared_.inverse(residual);
    gap = std::min(gap, second_gap + 0.5 * std::abs(residual.cwiseProduct(inverse).sum()));
  }
  certificate.relative_gap = std::abs(gap) / scale;
  for (BoxQpSolution& column : this->result_.columns)
  {
    column.certificate.relative_gap = certificate.relative_gap;
    column.certificate.kkt_residual = certificate.kkt_residual;
    column.certificate.bounds_violation = certificate.bounds_violation;
  }
}

CoupledSolution CoupledQp::run(const MatrixXd& start)
{
  const Stopwatch watch;
  const auto largest_residual = [](const Certificate& c)
  { return std::max(c.relative_gap, c.kkt_residual); };
  const double tolerance = this->options_.tolerance;
  Status status = this->set_up();
  if (status.ok())
  {
    this->set_start(start);
    this->certify_iterate();
    this->best_ = this->result_;
  }
  while (status.ok() && largest_residual(this->best_.certificate) > tolerance &&
    this->result_.iterations < this->options_.maximum_iterations)
  {
    this->rd_ = this->matrices_.a.transpose() * this->x_ + this->c_ - this->z_ + this->r_ +
      this->y_.replicate(1, this->m_);
    this->rd_ = this->rd_.cwiseProduct(this->is_solved_);
    this->rs_ = this->x_ - this->lower_ - this->s_;
    this->rt_ = this->upper_ - this->x_ - this->t_;
    this->rp_ = VectorXd::Zero(this->n_);
    for (Index i = 0; i < this->n_; ++i)
    {
      if (this->is_coupled_[i])
      {
        this->rp_[i] = this->sum_[i] - this->x_.row(i).cwiseProduct(this->is_solved_.row(i)).sum();
      }
    }
    status = this->factor();
    if (!status.ok())
    {
      break;
    }
    const double count = this->is_solved_.sum() + this->has_upper_bound_.sum();
    const MatrixXd sz = this->s_.cwiseProduct(this->z_);
    const MatrixXd tr = this->t_.cwiseProduct(this->r_);
    const double mu = (sz.sum() + tr.sum()) / count;
    // Relative accuracy of the multipliers in the predictor. A smaller value saves no iteration
    // (measured).
    constexpr double predictor_accuracy = 1e-1;
    constexpr double step_accuracy = 1e-2;
    Direction d = this->solve(-sz, -tr, predictor_accuracy, VectorXd::Zero(this->n_));
    double primal;
    double dual;
    this->step_lengths(d, primal, dual);
    const double affine = ((this->s_ + primal * d.s).cwiseProduct(this->z_ + dual * d.z).sum() +
                            (this->t_ + primal * d.t).cwiseProduct(this->r_ + dual * d.r).sum()) /
      count;
    const double target = std::pow(affine / mu, 3.0) * mu;
    const MatrixXd target_s =
      (target * this->is_solved_ - sz - primal * dual * d.s.cwiseProduct(d.z));
    const MatrixXd target_t =
      (target * this->has_upper_bound_ - tr - primal * dual * d.t.cwiseProduct(d.r));
    d = this->solve(target_s.cwiseProduct(this->is_solved_),
      target_t.cwiseProduct(this->has_upper_bound_), step_accuracy, d.y);
    this->step_lengths(d, primal, dual);
    const double step_fraction = 0.995;
    primal = primal < 1.0 ? step_fraction * primal : 1.0;
    dual = dual < 1.0 ? step_fraction * dual : 1.0;
    if (this->context_.canceled() || !d.x.allFinite())
    {
      status = this->context_.canceled()
        ? Status::canceled()
        : Status::failure(StatusCode::not_converged,
            "the solver stopped because a step has values that are not finite");
      break;
    }
    this->x_ += primal * d.x;
    this->s_ += primal * d.s;
    this->t_ += primal * d.t;
    this->z_ += dual * d.z;
    this->r_ += dual * d.r;
    this->y_ += dual * d.y;
    // The slacks must stay positive. Slacks of omitted upper bounds are unused and set to one.
    this->s_ = this->s_.array().max(1e-300).matrix();
    this->t_ = (this->has_upper_bound_.array() == 1.0).select(this->t_.array(), 1.0).matrix();
    this->result_.iterations += 1;
    this->certify_iterate();
    if (largest_residual(this->result_.certificate) < largest_residual(this->best_.certificate))
    {
      this->best_ = this->result_;
    }
    this->context_.progress(std::clamp(
      std::log(largest_residual(this->best_.certificate)) / std::log(tolerance), 0.0, 1.0));
  }
  this->best_.iterations = this->result_.iterations;
  this->best_.factorizations = this->result_.factorizations;
  this->best_.inner_iterations = this->result_.inner_iterations;
  this->best_.vertex = this->result_.vertex;
  this->best_.status = status;
  if (status.ok() && largest_residual(this->best_.certificate) > tolerance)
  {
    this->best_.status.code = StatusCode::not_converged;
  }
  const double column_fraction = 1.0 / std::max<double>(1.0, static_cast<double>(this->m_));
  const double seconds = watch.seconds();
  for (BoxQpSolution& column : this->best_.columns)
  {
    column.status = this->best_.status;
    column.iterations = this->best_.iterations;
    column.factorizations = this->best_.iterations;
    column.factor_seconds = column_fraction * this->factor_seconds_;
    column.solve_seconds = column_fraction * (seconds - this->factor_seconds_);
  }
  return this->best_;
}
} // namespace

CoupledSolution solve_coupled_qp(ExecutionContext& context, const SparseMatrix& q,
  const std::vector<Index>& fixed, const std::vector<BoxQpColumn>& columns, const MatrixXd& start,
  const BoxQp& prepared, const BoxQpOptions& options)
{
  return CoupledQp(context, q, fixed, columns, prepared, options).run(start);
}

} // namespace bindpose
