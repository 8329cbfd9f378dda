// A projected Newton method with inexact solves (see projected_newton.h). In each round, each
// vertex of the active set makes a Newton step of its own, which usually moves it to its bound. For
// the other vertices, a few iterations of preconditioned conjugate gradients reduce the gradient.
// Values outside of the bounds are projected back to them.
#include "qp/projected_newton.h"

#include "linear/symmetric_product.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

using Eigen::VectorXd;

namespace
{
/// Return the value of vertex i that minimizes the energy while all other values stay the same.
/// Bounds are ignored.
double newton_step(const SplitForm& matrices, const VectorXd& gradient, const VectorXd& x, Index i)
{
  return x[i] - gradient[i] / matrices.lower.valuePtr()[matrices.diagonal[i]];
}
} // namespace

std::vector<char> vertices_at_bounds(const SplitForm& matrices, const ColumnProblem& problem,
  const VectorXd& gradient, const VectorXd& x, double bound_margin)
{
  std::vector<char> at_bound(problem.pinned);
  for (Index i = 0; i < x.size(); ++i)
  {
    const double to = newton_step(matrices, gradient, x, i);
    at_bound[i] =
      at_bound[i] || to <= problem.lower[i] + bound_margin || to >= problem.upper[i] - bound_margin;
  }
  return at_bound;
}

double projected_newton(const ExecutionContext& context, const SplitForm& matrices,
  const ColumnProblem& problem, const Preconditioner& preconditioner, int rounds,
  double small_change, VectorXd& x)
{
  constexpr FreeConjugateGradientsOptions cg_options{ 4, 0.05 };
  const Index n = x.size();
  const SparseMatrix& a = matrices.a;
  std::vector<char> at_bound;
  VectorXd g = symmetric_product(a, x) + problem.c;
  double largest_change = 1.0;
  double before = 1e300;
  // Stop if the largest change does not decrease, because then the active set is still
  // wrong.
  for (int round = 0; round < rounds && largest_change > small_change &&
       largest_change < 0.9 * before && !context.canceled();
       ++round)
  {
    before = round == 0 ? 1e300 : largest_change;
    at_bound = vertices_at_bounds(matrices, problem, g, x, near_bound(small_change));
    VectorXd start = x;
    for (Index i = 0; i < n; ++i)
    {
      if (at_bound[i] && !problem.pinned[i])
      {
        start[i] = std::clamp(newton_step(matrices, g, x, i), problem.lower[i], problem.upper[i]);
      }
    }
    VectorXd next = start;
    free_conjugate_gradients([&a](const VectorXd& p) { return symmetric_product(a, p); },
      preconditioner, at_bound, cg_options, -(g + symmetric_product(a, start - x)), next);
    for (Index i = 0; i < n; ++i)
    {
      next[i] = problem.pinned[i] ? x[i] : std::clamp(next[i], problem.lower[i], problem.upper[i]);
    }
    largest_change = (next - x).cwiseAbs().maxCoeff();
    g += symmetric_product(a, next - x);
    x = next;
    if (round > 0 &&
      largest_change * std::pow(largest_change / before, rounds - 1 - round) > small_change)
    {
      break; // at this rate the remaining rounds do not suffice to converge
    }
  }
  return largest_change;
}

} // namespace bindpose
