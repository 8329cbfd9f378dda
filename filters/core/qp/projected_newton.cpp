// A projected Newton method with inexact solves (see projected_newton.h). In each round, held
// vertices move to their bounds. For the other vertices, a few iterations of preconditioned
// conjugate gradients reduce the gradient. Values outside of the bounds are projected back to them.
#include "qp/projected_newton.h"

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

std::vector<char> held_vertices(const SplitForm& matrices, const ColumnProblem& problem,
  const VectorXd& gradient, const VectorXd& x)
{
  std::vector<char> held(problem.pinned);
  for (Index i = 0; i < x.size(); ++i)
  {
    const double to = newton_step(matrices, gradient, x, i);
    held[i] = held[i] || to <= problem.lower[i] || to >= problem.upper[i];
  }
  return held;
}

double projected_newton(const ExecutionContext& context, const SplitForm& matrices,
  const ColumnProblem& problem, const Preconditioner& preconditioner, int rounds, double enough,
  VectorXd& x)
{
  constexpr int steps = 4; // maximum iterations of conjugate gradients per round
  // Conjugate gradients end earlier if the energy norm of the error has decreased to this fraction.
  constexpr double reduction = 0.05;
  const Index n = x.size();
  // A is symmetric. Products with its transpose are faster.
  const SparseMatrix& a = matrices.a;
  std::vector<char> held;
  const auto release = [&](VectorXd& v)
  {
    for (Index i = 0; i < n; ++i)
    {
      v[i] = held[i] ? 0.0 : v[i];
    }
  };
  VectorXd g = a.transpose() * x + problem.c;
  VectorXd r, z, p, ap;
  double moved = 1.0;
  double before = 1e300;
  // Stop if the largest change does not decrease, because then the set of held vertices is still
  // wrong.
  for (int round = 0;
       round < rounds && moved > enough && moved < 0.9 * before && !context.canceled(); ++round)
  {
    before = round == 0 ? 1e300 : moved;
    held = held_vertices(matrices, problem, g, x);
    VectorXd start = x;
    for (Index i = 0; i < n; ++i)
    {
      if (held[i] && !problem.pinned[i])
      {
        start[i] = std::clamp(newton_step(matrices, g, x, i), problem.lower[i], problem.upper[i]);
      }
    }
    r = -(g + a.transpose() * (start - x));
    release(r);
    VectorXd next = start;
    double first = 0.0;
    double last = 0.0;
    for (int k = 0; k < steps; ++k)
    {
      preconditioner(r, z);
      release(z);
      const double now = r.dot(z);
      if (!(now > 0.0) || now <= reduction * reduction * first)
      {
        break;
      }
      first = k == 0 ? now : first;
      p = k == 0 ? z : VectorXd(z + (now / last) * p);
      last = now;
      ap = a.transpose() * p;
      release(ap);
      const double curvature = p.dot(ap);
      if (!(curvature > 0.0))
      {
        break;
      }
      next += (now / curvature) * p;
      r -= (now / curvature) * ap;
    }
    for (Index i = 0; i < n; ++i)
    {
      next[i] = problem.pinned[i] ? x[i] : std::clamp(next[i], problem.lower[i], problem.upper[i]);
    }
    moved = (next - x).cwiseAbs().maxCoeff();
    g += a.transpose() * (next - x);
    x = next;
    if (round > 0 && moved * std::pow(moved / before, rounds - 1 - round) > enough)
    {
      break; // at this rate the remaining rounds do not suffice to converge
    }
  }
  return moved;
}

} // namespace bindpose
