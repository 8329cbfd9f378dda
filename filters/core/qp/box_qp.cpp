// The solver of the quadratic programs of all columns (see box_qp.h). A, the block of free vertices
// in Q, is analyzed once.
//
// A is first factored in single precision. This factor is used if conjugate gradients,
// preconditioned with it, solve a test system to double precision (good_accuracy). Otherwise A is
// factored in double precision. Single precision usually suffices for biharmonic energies and
// rarely for triharmonic energies.
//
// Then the starts of all columns are computed together (splitting_start.cpp). Each column is solved
// from its start (active_set.cpp), in a workspace that the next column reuses. The interior-point
// method (interior_point.cpp) solves columns without a start, and columns whose start does not lead
// to the minimizer.
#include "qp/box_qp.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/per_thread.h"
#include "base/stopwatch.h"
#include "linear/refined_solve.h"
#include "qp/active_set.h"
#include "qp/augmented_lagrangian.h"
#include "qp/column_problem.h"
#include "qp/interior_point.h"
#include "qp/splitting_start.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <utility>

namespace bindpose
{

namespace
{
using Eigen::VectorXd;

/// Relative residuals of linear systems in A: the target of the refinement, and the largest
/// acceptable residual.
constexpr double target_accuracy = 1e-14;
constexpr double good_accuracy = 1e-12;

/// Limit the number of threads of a context while this object exists; 0: no limit.
class ThreadLimit
{
public:
  ThreadLimit(ExecutionContext& context, int most)
    : context_(context), previous_threads_(context.threads())
  {
    if (most > 0)
    {
      context.set_threads(std::min(thread_count(this->previous_threads_), most));
    }
  }
  ~ThreadLimit() { this->context_.set_threads(this->previous_threads_); }
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
  ExecutionContext& context_;
  const int previous_threads_;
};
} // namespace

struct BoxQp::Impl : SplitForm
{
  class ColumnsSolve;
  using SplitForm::SplitForm;

  BoxQpOptions options;
  mutable SparseSolver solver; // solver in double precision; all other solvers share its analysis
  // Solver in single precision, with the analysis of `solver`; not analyzed if single precision is
  // unavailable.
  FloatCholesky single;
  FloatCholesky float_factor; // A's factor, if single precision is accurate enough
  bool float_is_accurate = false;
  mutable bool has_double_factor = false; // whether `solver` contains A's factor
  VectorXd inverse_diagonal; // 1 / diagonal of A
  double memory_estimate = 0.0;
  int maximum_threads = 0; // maximum number of threads that the memory allows; 0: no limit
  mutable std::mutex solver_mutex;
  mutable PerThread<BoxQpWorkspace> thread_workspaces;

  /// Estimate the memory of the factors and limit the number of threads, because each thread needs
  /// a workspace. Return an error if the memory does not suffice for one workspace.
  /// @param in_single_precision whether A is factored in single precision.
  Status plan_memory(const std::vector<BoxQpColumn>& columns, int threads, bool in_single_precision)
  {
    const bool ordered = std::any_of(columns.begin(), columns.end(),
      [](const BoxQpColumn& column) { return !column.pairs.empty(); });
    const auto count = static_cast<double>(columns.size());
    const auto vertices = static_cast<double>(this->q.rows());
    const double in_double_precision = this->solver.factor_bytes();
    // Memory that does not depend on the number of workspaces: the factor of A, and five vectors
    // per column for given values, minimizer without bounds, start and solution.
    const double shared_bytes =
      (in_single_precision ? this->single.factor_bytes() : in_double_precision) +
      5.0 * sizeof(double) * vertices * std::max(count, 1.0);
    // Memory per workspace: the matrix, about 40 vectors and the factors.
    const double bytes_per_column = columns.empty()
      ? 0.0
      : static_cast<double>(this->lower.nonZeros()) * (sizeof(double) + sizeof(int)) +
        40.0 * sizeof(double) * vertices + this->single.factor_bytes() +
        this->single.workspace_bytes() +
        (ordered || !this->single.is_analyzed() ? in_double_precision : 0.0);
    const double left = remaining_memory(this->options.solver.memory_limit);
    const double target_threads = std::min(count, static_cast<double>(thread_count(threads)));
    const double affordable_threads = bytes_per_column > 0.0
      ? std::floor((left - shared_bytes) / bytes_per_column)
      : target_threads;
    const double workspaces =
      std::clamp(affordable_threads, std::min(1.0, count), std::max(target_threads, 1.0));
    this->maximum_threads = static_cast<int>(workspaces);
    this->memory_estimate = resident_memory() + shared_bytes + workspaces * bytes_per_column;
    return check_memory("solving for " + std::to_string(columns.size()) + " columns on " +
        std::to_string(this->q.rows()) + " vertices",
      shared_bytes + workspaces * bytes_per_column, this->options.solver.memory_limit);
  }
  std::unique_ptr<BoxQpWorkspace> make_workspace() const
  {
    auto workspace = std::make_unique<BoxQpWorkspace>();
    workspace->solver = this->solver.clone();
    workspace->single = this->single.clone();
    workspace->matrix = this->lower;
    return workspace;
  }
  /// Compute A^-1 b for all columns of b, to the limit of double precision. The result depends only
  /// on the right-hand sides, not on earlier solves.
  /// @return false if this accuracy is not reached. Possible reasons: the memory does not suffice
  /// for a factor in double precision, or the context is canceled.
  bool solve_a(
    const ExecutionContext* context, const Eigen::MatrixXd& rhs, Eigen::MatrixXd& x) const
  {
    x = Eigen::MatrixXd::Zero(rhs.rows(), rhs.cols());
    if (rhs.size() == 0 ||
      (this->float_is_accurate && this->refined(context, rhs, x) <= good_accuracy))
    {
      return true;
    }
    const std::lock_guard<std::mutex> lock(this->solver_mutex);
    if (!this->has_double_factor && !(context && context->canceled()))
    {
      this->has_double_factor = this->solver.factor(this->lower).ok();
    }
    if (this->has_double_factor)
    {
      x = this->solver.solve(rhs);
      x += this->solver.solve(rhs - this->a * x);
    }
    return this->has_double_factor;
  }
  /// Return A^-1 rhs, for certificates. All entries of the result are NaN if solve_a() fails.
  Eigen::MatrixXd inverse_of_a(const Eigen::MatrixXd& rhs) const
  {
    Eigen::MatrixXd x;
    if (!this->solve_a(nullptr, rhs, x))
    {
      x.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    return x;
  }
  /// Solve with the factor in single precision and refinement.
  /// @return the relative residual that was reached.
  double refined(
    const ExecutionContext* context, const Eigen::MatrixXd& rhs, Eigen::MatrixXd& x) const
  {
    constexpr int most_steps = 40;
    return refined_solve(
      this->float_factor,
      [this](const Eigen::MatrixXd& p) { return Eigen::MatrixXd(this->a.transpose() * p); },
      this->inverse_diagonal, rhs, { target_accuracy, most_steps, context }, x);
  }
  /// Factor A in single precision. Discard the factor if it is not accurate enough for a typical
  /// right-hand side.
  Status factor_single(const ExecutionContext& context)
  {
    this->inverse_diagonal.resize(this->lower.rows());
    for (Index i = 0; i < this->inverse_diagonal.size(); ++i)
    {
      this->inverse_diagonal[i] = 1.0 / this->lower.valuePtr()[this->diagonal[i]];
    }
    this->float_factor = this->single.clone();
    const Status status = this->float_factor.factor(context, this->lower, 0.0);
    this->float_factor.release_workspace();
    Eigen::MatrixXd x;
    const VectorXd ones = VectorXd::Ones(this->fixed_block.cols());
    this->float_is_accurate =
      status.ok() && this->refined(&context, this->fixed_block * ones, x) <= good_accuracy;
    if (!this->float_is_accurate)
    {
      this->float_factor = FloatCholesky();
    }
    return status.code == StatusCode::canceled ? status : Status();
  }
  /// Multiply A^-1 with the free entries of r (#V). The result (#V) is 0 at fixed vertices.
  VectorXd inverse(const VectorXd& r) const
  {
    return this->extend_to_all(this->inverse_of_a(this->free_rows(r)),
      Eigen::MatrixXd::Zero(static_cast<Index>(this->fixed.size()), 1));
  }
  /// Return the values of the fixed vertices, one column per problem.
  Eigen::MatrixXd fixed_values_of(const std::vector<BoxQpColumn>& columns) const
  {
    Eigen::MatrixXd values(
      static_cast<Index>(this->fixed.size()), static_cast<Index>(columns.size()));
    for (std::size_t j = 0; j < columns.size(); ++j)
    {
      values.col(static_cast<Index>(j)) = columns[j].fixed_values;
    }
    return values;
  }
  /// Return the minimizers without bounds (#V x m). The minimizers are used even if solve_a()
  /// fails, because every final result has its own certificate.
  Eigen::MatrixXd minimizers(
    const ExecutionContext* context, const Eigen::MatrixXd& fixed_values) const
  {
    Eigen::MatrixXd x;
    this->solve_a(context, -(this->fixed_block * fixed_values), x);
    return this->extend_to_all(x, fixed_values);
  }
};

/// Solve all columns. The active-set method solves the columns with a start and without ordered
/// pairs. The augmented Lagrangian method solves the columns with a start and ordered pairs. The
/// interior-point method solves all columns that are left.
class BoxQp::Impl::ColumnsSolve
{
public:
  ColumnsSolve(ExecutionContext& context, const BoxQp::Impl& qp,
    const std::vector<BoxQpColumn>& columns, Eigen::MatrixXd unconstrained,
    std::vector<BoxQpSolution>& solutions)
    : qp_(qp), columns_(columns), unconstrained_(std::move(unconstrained)), solutions_(solutions),
      context_(context), inverse_([&qp](const VectorXd& r) { return qp.inverse(r); })
  {
  }

  void run()
  {
    constexpr double at_bounds = 0.7; // progress at the end of the active-set method
    std::vector<std::size_t> left; // indices of the columns for the interior-point method
    {
      const ProgressRange range(this->context_, 0.0, at_bounds);
      std::vector<std::size_t> all(this->columns_.size());
      std::iota(all.begin(), all.end(), std::size_t(0));
      const std::vector<ColumnStart> starts = this->find_starts(all, false);
      std::vector<std::size_t> started;
      for (const std::size_t j : all)
      {
        (starts[j].x.size() > 0 ? started : left).push_back(j);
      }
      const ProgressRange solving(this->context_, start_fraction, 1.0);
      this->solve_each(started,
        [&](std::size_t j, BoxQpWorkspace& workspace)
        {
          const BoxQpColumn& column = this->columns_[j];
          return column.pairs.empty()
            ? active_set(this->context_, this->qp_, this->qp_.options, column, starts[j],
                this->inverse_, workspace)
            : augmented_lagrangian(this->context_, this->qp_, this->qp_.options, column,
                starts[j].x, this->inverse_, workspace);
        });
      for (const std::size_t j : started)
      {
        if (this->solutions_[j].status.code == StatusCode::not_converged &&
          this->solutions_[j].iterations < this->qp_.options.maximum_iterations)
        {
          // The interior-point method will replace the status, unless a cancel request prevents its
          // run.
          this->solutions_[j].status = Status::canceled();
          left.push_back(j);
        }
      }
    }
    if (this->context_.canceled())
    {
      return;
    }
    const ProgressRange range(this->context_, at_bounds, 1.0);
    const std::vector<ColumnStart> starts = this->find_starts(left, true);
    const ProgressRange solving(this->context_, start_fraction, 1.0);
    this->solve_each(left,
      [&](std::size_t j, BoxQpWorkspace& workspace)
      {
        const VectorXd unconstrained = this->unconstrained_.col(static_cast<Index>(j));
        BoxQpOptions options = this->qp_.options;
        options.maximum_iterations -= this->solutions_[j].iterations;
        return interior_point(this->context_, this->qp_, options, this->columns_[j], unconstrained,
          starts[j], this->inverse_, workspace);
      });
  }

private:
  // Computing the starts takes this fraction of the progress range of a method (active set or
  // interior point). Solving the columns takes the rest.
  static constexpr double start_fraction = 0.3;

  /// Report whether splitting_start() can compute a start for the column. Three conditions must
  /// hold: single precision is available, the caller gives no start, and the bounds are finite.
  /// With barriers, the column must also have no ordered pairs.
  bool may_split(const BoxQpColumn& column, bool barriers) const
  {
    return this->qp_.single.is_analyzed() && (column.pairs.empty() || !barriers) &&
      column.start.size() == 0 && column.bounds.lower.allFinite() &&
      column.bounds.upper.allFinite();
  }

  /// Return a start for a column with ordered pairs if splitting_start() cannot compute one: the
  /// caller's start or the minimizer without bounds, clamped to the bounds.
  ColumnStart clamped_start(std::size_t j) const
  {
    const BoxQpColumn& column = this->columns_[j];
    ColumnStart start;
    start.x =
      ColumnProblem(this->qp_, column)
        .clamp_to_bounds(this->qp_,
          column.start.size() > 0 ? column.start : this->unconstrained_.col(static_cast<Index>(j)));
    return start;
  }

  /// Compute starts for the requested columns.
  /// @param requested indices of the columns.
  /// @param barriers compute starts for the interior-point method (see splitting_start).
  /// @return #columns; a start is empty if its column was not requested or cannot have a start, or
  /// if the call was canceled.
  std::vector<ColumnStart> find_starts(const std::vector<std::size_t>& requested, bool barriers)
  {
    const Stopwatch watch;
    std::vector<ColumnStart> starts(this->columns_.size());
    std::vector<std::size_t> chosen;
    std::vector<BoxQpColumn> start_columns;
    Eigen::MatrixXd unconstrained(
      this->unconstrained_.rows(), static_cast<Index>(requested.size()));
    for (const std::size_t j : requested)
    {
      if (this->may_split(this->columns_[j], barriers))
      {
        unconstrained.col(static_cast<Index>(chosen.size())) =
          this->unconstrained_.col(static_cast<Index>(j));
        chosen.push_back(j);
        start_columns.push_back(this->columns_[j]);
      }
      else if (this->qp_.single.is_analyzed() && !this->columns_[j].pairs.empty() && !barriers)
      {
        starts[j] = this->clamped_start(j);
      }
    }
    if (chosen.empty())
    {
      return starts;
    }
    const ProgressRange range(this->context_, 0.0, start_fraction);
    FloatCholesky factorization = this->qp_.single.clone();
    std::vector<ColumnStart> found = splitting_start(
      this->context_, this->qp_, start_columns, barriers, unconstrained, factorization);
    const double seconds = watch.seconds() / static_cast<double>(chosen.size());
    for (std::size_t k = 0; k < chosen.size(); ++k)
    {
      starts[chosen[k]] = std::move(found[k]);
      this->solutions_[chosen[k]].solve_seconds += seconds;
    }
    return starts;
  }

  /// Solve the chosen columns in parallel and add their counts and times to those of earlier
  /// attempts.
  /// @param solve (column, workspace) -> solution; called on any thread.
  template <class Solve>
  void solve_each(const std::vector<std::size_t>& chosen, const Solve& solve)
  {
    parallel_for(this->context_, static_cast<Index>(chosen.size()), 1,
      [&](Index begin, Index end)
      {
        for (Index k = begin; k < end; ++k)
        {
          this->qp_.thread_workspaces.use_object([&] { return this->qp_.make_workspace(); },
            [&](BoxQpWorkspace& workspace)
            {
              BoxQpSolution& before = this->solutions_[chosen[k]];
              BoxQpSolution solution = solve(chosen[k], workspace);
              solution.iterations += before.iterations;
              solution.factorizations += before.factorizations;
              solution.factor_seconds += before.factor_seconds;
              solution.solve_seconds += before.solve_seconds;
              before = std::move(solution);
            });
        }
      });
  }

  const BoxQp::Impl& qp_;
  const std::vector<BoxQpColumn>& columns_;
  const Eigen::MatrixXd unconstrained_; // #V x #columns
  std::vector<BoxQpSolution>& solutions_;
  ExecutionContext& context_;
  const InverseForm inverse_;
};

BoxQp::BoxQp(const SparseMatrix& q, std::vector<Index> fixed, const BoxQpOptions& options)
  : impl_(new Impl(q, std::move(fixed)))
{
  Impl& impl = *this->impl_;
  impl.options = options;
  impl.solver = SparseSolver(options.solver);
}

BoxQp::~BoxQp() = default;

Status BoxQp::prepare(ExecutionContext& context, const std::vector<BoxQpColumn>& columns)
{
  Impl& impl = *this->impl_;
  if (impl.free_vertices.empty())
  {
    return {};
  }
  Status status;
  {
    Phase phase(context, "analyze");
    status = impl.solver.analyze(impl.lower);
    if (status.ok())
    {
      const Status single = impl.single.analyze(impl.solver, impl.lower);
      status = single.code == StatusCode::unavailable ? status : single;
    }
  }
  const Stopwatch watch;
  if (status.ok())
  {
    status = impl.plan_memory(columns, context.threads(), impl.single.is_analyzed());
  }
  if (status.ok() && !context.canceled() && impl.single.is_analyzed())
  {
    status = impl.factor_single(context);
  }
  if (status.ok() && !context.canceled() && !impl.float_is_accurate)
  {
    status = impl.plan_memory(columns, context.threads(), false);
    status = status.ok() ? explain_no_minimum(impl.solver.factor(impl.lower)) : status;
    impl.has_double_factor = status.ok();
  }
  context.add_seconds("factor", watch.seconds());
  return status.ok() && context.canceled() ? Status::canceled() : status;
}

Eigen::MatrixXd BoxQp::unconstrained(const Eigen::MatrixXd& fixed_values) const
{
  return this->impl_->minimizers(nullptr, fixed_values);
}

Eigen::MatrixXd BoxQp::inverse(const Eigen::MatrixXd& rhs) const
{
  return this->impl_->inverse_of_a(rhs);
}

std::vector<BoxQpSolution> BoxQp::solve_unbounded(
  ExecutionContext& context, const std::vector<BoxQpColumn>& columns) const
{
  const Impl& impl = *this->impl_;
  std::vector<BoxQpSolution> solutions(columns.size());
  const Stopwatch watch;
  const Eigen::MatrixXd w = impl.minimizers(&context, impl.fixed_values_of(columns));
  const double seconds = watch.seconds() / std::max<double>(1.0, double(columns.size()));
  for (std::size_t j = 0; j < columns.size() && !context.canceled(); ++j)
  {
    const Stopwatch column_watch;
    BoxQpSolution& solution = solutions[j];
    solution.w = w.col(static_cast<Index>(j));
    std::vector<char> pinned(static_cast<std::size_t>(impl.q.rows()), 0);
    for (std::size_t i = 0; i < columns[j].pinned.size(); ++i)
    {
      pinned[columns[j].pinned[i]] = 1;
      solution.w[columns[j].pinned[i]] = columns[j].pinned_values[static_cast<Index>(i)];
    }
    std::vector<char> no_free_vertices(pinned.size(), 0);
    solution.certificate = certify({ impl.q, no_free_vertices }, solution.w);
    VectorXd g = impl.q.transpose() * solution.w;
    for (Index v = 0; v < g.size(); ++v)
    {
      g[v] = impl.is_free[v] && !pinned[v] ? g[v] : 0.0;
      if (g[v] != 0.0)
      {
        solution.certificate.kkt_residual =
          std::max(solution.certificate.kkt_residual, std::abs(g[v]) / impl.q.coeff(v, v));
      }
    }
    if (solution.certificate.energy > 0.0)
    {
      solution.certificate.relative_gap =
        0.5 * g.dot(impl.inverse(g)) / solution.certificate.energy;
    }
    solution.solve_seconds = seconds + column_watch.seconds();
  }
  return solutions;
}

BoxQpSolution BoxQp::solve(ExecutionContext& context, const BoxQpColumn& column) const
{
  return std::move(this->solve_all(context, { column }).front());
}

std::vector<BoxQpSolution> BoxQp::solve_all(
  ExecutionContext& context, const std::vector<BoxQpColumn>& columns) const
{
  const Impl& impl = *this->impl_;
  std::vector<BoxQpSolution> solutions(columns.size());
  for (std::size_t j = 0; j < columns.size(); ++j)
  {
    solutions[j].status = Status::canceled();
    solutions[j].w = VectorXd::Zero(impl.q.rows());
  }
  Eigen::MatrixXd unbounded = impl.minimizers(&context, impl.fixed_values_of(columns));
  if (!context.canceled())
  {
    const ThreadLimit thread_limit(context, impl.maximum_threads);
    Impl::ColumnsSolve(context, impl, columns, std::move(unbounded), solutions).run();
  }
  return solutions;
}

Index BoxQp::free_count() const
{
  return static_cast<Index>(this->impl_->free_vertices.size());
}

Index BoxQp::analyses() const
{
  return this->impl_->solver.analyses();
}

Index BoxQp::factorizations() const
{
  return this->impl_->solver.factorizations() + this->impl_->single.factorizations();
}

double BoxQp::memory_estimate() const
{
  return this->impl_->memory_estimate;
}

const SparseSolver& BoxQp::solver() const
{
  return this->impl_->solver;
}

Status first_failure(const std::vector<BoxQpSolution>& solutions)
{
  for (const BoxQpSolution& solution : solutions)
  {
    if (!solution.status.usable())
    {
      return solution.status;
    }
  }
  return {};
}

} // namespace bindpose
