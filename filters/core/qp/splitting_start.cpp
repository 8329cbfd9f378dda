// Starts of all columns by Douglas-Rachford splitting (see splitting_start.h). The objective is the
// sum of two functions: a quadratic function, and a function that keeps each vertex within its
// bounds (infinite outside of the bounds, or a barrier). The splitting minimizes the two functions
// alternately, in the metric P, which is a small multiple of A's diagonal:
//   y = the point within the bounds nearest to z, or
//       argmin barrier(y) + 1/2 |y - z|_P^2      (one scalar equation per vertex)
//   x = argmin quadratic(x) + 1/2 |x - (2y - z)|_P^2 = (A + P)^-1 (P (2y - z) - c)
//   z = z + relaxation (x - y)
// In the limit y is the minimizer. Without barriers, a bound of a vertex is active if z is beyond
// this bound. The matrix A + P is the same for all columns and iterations, so the solves of all
// columns use the same factor and run as dense products. Anderson acceleration replaces z by the
// combination of the last few iterates for which x - y would be smallest if the iteration were
// linear.
//
// The constants were measured on boxes and on real shapes with 5k to 70k vertices.
#include "qp/splitting_start.h"

#include "base/flush_denormals.h"
#include "base/parallel.h"
#include "linear/supernode_solve.h"
#include "qp/column_problem.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace bindpose
{

namespace
{
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::VectorXd;
using Eigen::VectorXf;

constexpr double relative_mu = 1e-4; // relative duality gap of a start with barriers
constexpr double metric = 1e-2; // P as a fraction of A's diagonal
constexpr double relaxation = 1.7;
constexpr int steps = 80;
// A column has converged if the squared length of its last step x - y, in the metric P, is at most
// this fraction of its energy.
constexpr double settled_change = 1e-7;
constexpr int memory = 8; // number of past iterations for Anderson acceleration
// A block of columns is solved together on one thread. Wide blocks read the factor less often; if
// there are few columns, narrow blocks use more threads.
constexpr Index narrow_block = 4;
constexpr Index many_columns = 16;

/// Return the solution y in (0, 1) of y - z = mu_per_p / y - mu_per_p / (1 - y), where mu_per_p is
/// mu divided by the vertex's entry of P. Newton's method starts near the bound that is closer to
/// z.
double barrier_step(double z, double mu_per_p)
{
  // Without the barrier of the farther bound the equation is quadratic. Start from the root of this
  // quadratic equation.
  const bool low = z < 0.5;
  const double t = low ? z : 1.0 - z;
  const double root = std::sqrt(t * t + 4.0 * mu_per_p);
  double y = t > 0.0 ? 0.5 * (t + root) : 2.0 * mu_per_p / (root - t);
  y = std::min(y, 0.5);
  for (int k = 0; k < 4; ++k)
  {
    const double other = 1.0 - y;
    const double f = y - t - mu_per_p / y + mu_per_p / other;
    const double slope = 1.0 + mu_per_p / (y * y) + mu_per_p / (other * other);
    const double next = y - f / slope;
    y = next > 0.0 ? next : 0.5 * y;
    if (std::abs(f) < 1e-9 * slope * y)
    {
      break;
    }
  }
  y = std::clamp(y, 1e-300, 1.0);
  return low ? y : 1.0 - y;
}

/// The past iterations of one column, from which the next iterate is extrapolated (Anderson
/// acceleration). Inner products are in the metric P.
class Anderson
{
public:
  explicit Anderson(Index size) : points_(size, memory), changes_(size, memory) {}

  /// Replace z by the next iterate.
  /// @param z point where the iteration was evaluated; replaced by the next point.
  /// @param change result of the iteration minus z.
  void accelerate(VectorXd& z, const VectorXd& change, const VectorXd& weights)
  {
    const FlushDenormals flush; // most numbers below are tiny, and denormals are slow
    const VectorXf f = change.cwiseProduct(weights).cast<float>();
    const VectorXf at = z.cwiseProduct(weights).cast<float>();
    const double size = f.squaredNorm();
    if (this->count_ < 0 || size > 4.0 * this->last_size_)
    {
      this->count_ = 0; // discard past iterations, because the change has grown
    }
    else
    {
      const int slot = this->next_column_;
      this->points_.col(slot) = at - this->last_point_;
      this->changes_.col(slot) = f - this->last_change_;
      this->next_column_ = (slot + 1) % memory;
      this->count_ = std::min(this->count_ + 1, memory);
      this->gram_.row(slot).head(this->count_) =
        (this->changes_.leftCols(this->count_).transpose() * this->changes_.col(slot))
          .cast<double>()
          .transpose();
      this->gram_.col(slot).head(this->count_) =
        this->gram_.row(slot).head(this->count_).transpose();
    }
    this->last_size_ = size;
    this->last_point_ = at;
    this->last_change_ = f;
    z += change;
    if (this->count_ > 0)
    {
      const int m = this->count_;
      MatrixXd gram = this->gram_.topLeftCorner(m, m);
      gram.diagonal() *= 1.0 + 1e-6;
      gram.diagonal().array() += 1e-30;
      const VectorXd gamma =
        gram.ldlt().solve((this->changes_.leftCols(m).transpose() * f).cast<double>());
      if (gamma.allFinite())
      {
        const VectorXf g = gamma.cast<float>();
        z -= (this->points_.leftCols(m) * g + this->changes_.leftCols(m) * g)
               .cast<double>()
               .cwiseQuotient(weights);
      }
    }
    else
    {
      this->next_column_ = 0;
    }
  }

private:
  MatrixXf points_, changes_; // differences of successive z and of successive x - y
  MatrixXd gram_ = MatrixXd::Zero(memory, memory);
  VectorXf last_point_, last_change_;
  double last_size_ = 0.0;
  int count_ = -1; // number of used columns in points_ and changes_; -1: no iteration yet
  int next_column_ = 0;
};
} // namespace

std::vector<ColumnStart> splitting_start(ExecutionContext& context, const SplitForm& matrices,
  const std::vector<BoxQpColumn>& columns, bool barriers, const MatrixXd& unconstrained,
  FloatCholesky& single)
{
  const auto n = static_cast<Index>(matrices.free_vertices.size());
  const auto count = static_cast<Index>(columns.size());
  std::vector<ColumnStart> starts(columns.size());
  VectorXd p(n);
  SparseMatrix shifted = matrices.lower;
  for (Index i = 0; i < n; ++i)
  {
    double& diagonal = shifted.valuePtr()[matrices.diagonal[i]];
    p[i] = metric * diagonal;
    diagonal += p[i];
  }
  if (!single.factor(context, shifted, 0.0).ok())
  {
    return starts;
  }
  const VectorXd weights = p.cwiseSqrt();
  const Index maximum_block = count < many_columns ? narrow_block : maximum_solve_columns;
  const Index blocks = (count + maximum_block - 1) / maximum_block;
  const Index block = (count + blocks - 1) / blocks;
  parallel_for(context, blocks, 1,
    [&](Index begin, Index)
    {
      const Index first = std::min(begin * block, count);
      const Index width = std::min(block, count - first);
      MatrixXd z(n, width), y(n, width), rhs, x;
      std::vector<ColumnProblem> problems;
      VectorXd energy(width); // energies of the minimizers without bounds
      VectorXd mu(width);
      std::vector<Anderson> anderson;
      for (Index k = 0; k < width; ++k)
      {
        const VectorXd unbounded = unconstrained.col(first + k);
        problems.emplace_back(matrices, columns[static_cast<std::size_t>(first + k)]);
        z.col(k) = problems.back().clamp_to_bounds(matrices, unbounded);
        energy[k] = 0.5 * unbounded.dot(matrices.q.transpose() * unbounded);
        mu[k] = barriers ? relative_mu * energy[k] / static_cast<double>(2 * n) : 0.0;
        anderson.emplace_back(n);
      }
      const auto step_to_bounds = [&](Index k)
      {
        const ColumnProblem& problem = problems[static_cast<std::size_t>(k)];
        for (Index i = 0; i < n; ++i)
        {
          const double l = problem.lower[i];
          const double range = problem.upper[i] - l;
          y(i, k) = problem.pinned[i] ? problem.given_values[matrices.free_vertices[i]]
            : mu[k] > 0.0 // the equation is scaled to [0, 1]
            ? l + range * barrier_step((z(i, k) - l) / range, mu[k] / p[i] / (range * range))
            : std::clamp(z(i, k), l, problem.upper[i]);
        }
      };
      std::vector<Index> active(static_cast<std::size_t>(width)); // columns that have not converged
      std::iota(active.begin(), active.end(), 0);
      for (int step = 0; step < steps && !active.empty() && !context.canceled(); ++step)
      {
        rhs.resize(n, static_cast<Index>(active.size()));
        for (std::size_t j = 0; j < active.size(); ++j)
        {
          const Index k = active[j];
          step_to_bounds(k);
          rhs.col(static_cast<Index>(j)) =
            p.cwiseProduct(2.0 * y.col(k) - z.col(k)) - problems[static_cast<std::size_t>(k)].c;
        }
        single.solve(rhs, x);
        std::vector<Index> left;
        for (std::size_t j = 0; j < active.size(); ++j)
        {
          const Index k = active[j];
          VectorXd at = z.col(k);
          const VectorXd change = x.col(static_cast<Index>(j)) - y.col(k);
          const double size = change.cwiseProduct(weights).squaredNorm();
          anderson[static_cast<std::size_t>(k)].accelerate(at, relaxation * change, weights);
          z.col(k) = at;
          if (size > settled_change * energy[k])
          {
            left.push_back(k);
          }
        }
        active = std::move(left);
        if (begin == 0)
        {
          context.progress(static_cast<double>(step) / steps / static_cast<double>(blocks));
        }
      }
      for (Index k = 0; k < width && !context.canceled(); ++k)
      {
        step_to_bounds(k);
        if (!z.col(k).allFinite() || !y.col(k).allFinite() || (barriers && !(mu[k] > 0.0)))
        {
          continue;
        }
        ColumnStart& start = starts[static_cast<std::size_t>(first + k)];
        start.x = y.col(k);
        start.mu = mu[k];
        if (!barriers)
        {
          start.at_bound = problems[static_cast<std::size_t>(k)].pinned;
          for (Index i = 0; i < n; ++i)
          {
            start.at_bound[i] = start.at_bound[i] || z(i, k) != y(i, k);
          }
        }
      }
    });
  return starts;
}

} // namespace bindpose
