#ifndef bindpose_qp_box_qp_h
#define bindpose_qp_box_qp_h

#include "base/execution.h"
#include "linear/sparse_solver.h"
#include "qp/box_qp_column.h"

#include <memory>

namespace bindpose
{

/// Solve min 1/2 w' Q w subject to l <= w <= u (0 and 1 by default) and given values at the fixed
/// vertices, for many columns w. One symbolic analysis serves all columns. A splitting method
/// guesses the solutions and the active bounds of all columns together. An active-set method then
/// solves each column, starting from its guess. For a column with ordered pairs, an augmented
/// Lagrangian method starts from the guess. A primal-dual interior-point method solves the columns
/// that these methods do not solve, and all columns if single precision is unavailable.
/// A column has converged if its optimality certificate (see Certificate) is within the tolerance.
/// If it has not converged after maximum_iterations, the status is not_converged, and the result is
/// the best iterate with its certificate.
///
/// Cost per column for eight columns, in units of F, the time of one factorization of Q in double
/// precision. The first three values are for CHOLMOD:
/// - 3 to 6 F on lattices of real shapes with 9k to 11k vertices;
/// - three to five times as much with the interior-point method;
/// - 12 to 13 F with ordered pairs, on a box of 5k vertices;
/// - 10 to 25 F with Eigen's solver.
///
/// Memory, in units of one factor of Q in single precision: 1 for the common factor, and 4/3 per
/// thread (1 for the thread's factor and 1/3 for its workspace). With 63k vertices and one thread,
/// the total is 1.4 GB. If single precision fails, each thread also stores a factor in double
/// precision.
///
/// Hintermueller, Ito and Kunisch 2003; Bertsekas 1982; Mehrotra 1992; Gondzio 1996; Jacobson et
/// al. 2011 and 2012 for the problems.
class BoxQp
{
public:
  /// @param q symmetric positive semi-definite, #V x #V, positive definite on the free vertices.
  /// @param fixed ids of the fixed vertices, each once.
  BoxQp(const SparseMatrix& q, std::vector<Index> fixed, const BoxQpOptions& options);
  ~BoxQp();
  BoxQp(const BoxQp&) = delete;
  BoxQp& operator=(const BoxQp&) = delete;

  /// Analyze and factor Q once. This function must succeed before any other member function is
  /// called. It reports progress as phase "analyze". If the memory is insufficient for
  /// `columns`, return internal_error before any factorization.
  /// @param columns the columns that solve_all() will receive. If the memory does not suffice for
  /// one factor per thread, solve_all() uses fewer threads.
  Status prepare(ExecutionContext& context, const std::vector<BoxQpColumn>& columns = {});

  /// Return the weights (#V x m) that minimize the energy without bounds, for m columns of fixed
  /// values (#fixed x m).
  Eigen::MatrixXd unconstrained(const Eigen::MatrixXd& fixed_values) const;
  /// Multiply the inverse of Q's block of free vertices by m columns (#free x m). Return NaN if the
  /// memory is insufficient.
  Eigen::MatrixXd inverse(const Eigen::MatrixXd& rhs) const;

  /// Solve like unconstrained(), for columns with pinned vertices. The certificate is that of a
  /// problem without bounds, where g is the gradient and A is Q's block of free vertices:
  ///   gap = 1/2 g' A^-1 g = E(w) - min E exactly,   residual = max |g / diag Q|.
  std::vector<BoxQpSolution> solve_unbounded(
    ExecutionContext& context, const std::vector<BoxQpColumn>& columns) const;

  /// Solve one column.
  BoxQpSolution solve(ExecutionContext& context, const BoxQpColumn& column) const;

  /// Solve all columns on the context's threads. The result is bitwise the same for any number of
  /// threads. After a cancel, columns that were not solved have the status canceled.
  std::vector<BoxQpSolution> solve_all(
    ExecutionContext& context, const std::vector<BoxQpColumn>& columns) const;

  Index free_count() const;
  Index analyses() const;
  Index factorizations() const;
  /// Return the estimated peak memory of the process in bytes. prepare() computes it after the
  /// analysis.
  double memory_estimate() const;
  /// Return the solver that has analyzed the pattern of Q's block of free vertices.
  const SparseSolver& solver() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Return the status of the first column without a usable result; ok if all results are usable.
Status first_failure(const std::vector<BoxQpSolution>& solutions);

} // namespace bindpose

#endif
