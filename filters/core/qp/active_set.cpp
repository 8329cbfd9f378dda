// The active-set method of BoxQp (see active_set.h). The active set consists of the vertices whose
// weight is kept at a bound. Only the block of the matrix A (see active_set.h) without these
// vertices is factored. The factor gives exact solutions while the active set does not change. It
// is a good preconditioner if only few vertices enter or leave this set. If projected_newton() does
// not converge with a factor, the next factor is computed for the active set at that time.
#include "qp/active_set.h"

#include "base/stopwatch.h"
#include "linear/symmetric_product.h"
#include "qp/projected_newton.h"

#include <algorithm>

namespace bindpose
{

namespace
{
using Eigen::VectorXd;

/// Compute the certificate of a column's weights w.
/// @param inverse multiplies by A^-1. It is called only if round-off makes the first bound of the
/// certificate too large.
Certificate certify_column(const SplitForm& matrices, const BoxQpColumn& column,
  const ColumnProblem& problem, double tolerance, const InverseForm& inverse, const VectorXd& w)
{
  const BoundedEnergy energy{ matrices.q, problem.is_column_free, column.bounds };
  const Certificate first = certify(energy, w);
  return first.relative_gap <= tolerance || first.kkt_residual > tolerance
    ? first
    : certify(energy, w, {}, VectorXd(), inverse);
}
} // namespace

BoxQpSolution active_set(ExecutionContext& context, const SplitForm& matrices,
  const BoxQpOptions& options, const BoxQpColumn& column, const ColumnStart& start,
  const InverseForm& inverse, BoxQpWorkspace& workspace)
{
  const Stopwatch watch;
  constexpr int maximum_factorizations = 10;
  // Number of factorizations that are exempt from the test for stalling.
  constexpr int unchecked_factorizations = 2;
  // The test for stalling: let c be the largest change of a weight in the last Newton round after a
  // factorization. Each c must be less than this fraction of the smallest earlier c.
  constexpr double required_ratio = 0.5;
  constexpr int rounds = 6; // maximum number of Newton rounds per factorization
  const double tolerance = options.tolerance;
  const double small_change = converged_newton_change(tolerance);
  const ColumnProblem problem(matrices, column);
  BoxQpSolution solution;
  // Approximate error of the start. A weight within this distance of a bound may be at the bound.
  constexpr double start_error = 1e-4;
  VectorXd x = start.x;
  std::vector<char> at_bound = start.at_bound;
  for (Index i = 0; i < x.size(); ++i)
  {
    const double error = start_error * std::min(1.0, problem.upper[i] - problem.lower[i]);
    at_bound[i] = at_bound[i] || x[i] < problem.lower[i] + error || x[i] > problem.upper[i] - error;
  }
  const int most = std::min(maximum_factorizations, options.maximum_iterations);
  const bool all_pinned = std::all_of(
    problem.pinned.begin(), problem.pinned.end(), [](char pinned) { return pinned != 0; });
  double largest_change = all_pinned ? 0.0 : 1e300;
  double smallest_change = 1e300;
  const auto certified = [&]
  {
    solution.w = problem.extend_to_all(matrices, x);
    solution.certificate =
      certify_column(matrices, column, problem, tolerance, inverse, solution.w);
    return std::max(solution.certificate.relative_gap, solution.certificate.kkt_residual) <=
      tolerance;
  };
  while (!(largest_change <= small_change && certified()))
  {
    const bool stalled = solution.iterations > unchecked_factorizations &&
      !(largest_change < required_ratio * smallest_change);
    if (stalled || solution.iterations >= most || context.canceled())
    {
      solution.status = Status::failure(StatusCode::not_converged, "");
      break;
    }
    smallest_change = std::min(smallest_change, largest_change);
    if (solution.iterations > 0)
    {
      at_bound = vertices_at_bounds(matrices, problem, symmetric_product(matrices.a, x) + problem.c,
        x, near_bound(small_change));
    }
    const Stopwatch factor_watch;
    const Status factored = workspace.single.factor_block(context, matrices.lower, at_bound);
    solution.factorizations += 1;
    solution.factor_seconds += factor_watch.seconds();
    if (!factored.ok())
    {
      solution.status = Status::failure(StatusCode::not_converged, factored.message);
      break;
    }
    largest_change = projected_newton(
      context, matrices, problem,
      [&](const VectorXd& r, VectorXd& z)
      {
        workspace.single.solve(r, z);
        for (Index i = 0; i < r.size(); ++i)
        {
          // The factor does not contain the vertices that were at a bound when it was computed. For
          // these vertices, the preconditioner divides the residual by the diagonal.
          z[i] = at_bound[i] ? r[i] / matrices.lower.valuePtr()[matrices.diagonal[i]] : z[i];
        }
      },
      rounds, small_change, x);
    solution.iterations += 1;
  }
  // After the maximum number of iterations, a certified iterate is a valid result even if the
  // weights still change.
  if (!solution.status.ok() && certified() && solution.iterations >= options.maximum_iterations)
  {
    solution.status = Status();
  }
  if (context.canceled())
  {
    solution.status = Status::canceled();
  }
  solution.solve_seconds = watch.seconds() - solution.factor_seconds;
  return solution;
}

} // namespace bindpose
