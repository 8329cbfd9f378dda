#ifndef bindpose_qp_box_qp_column_h
#define bindpose_qp_box_qp_column_h

#include "linear/sparse_solver.h"
#include "qp/certificate.h"

#include <vector>

namespace bindpose
{

/// Options of BoxQp, the solver of the quadratic programs of bounded weights.
struct BoxQpOptions
{
  /// Tolerance (above 0, below 1): upper limit of the relative duality gap and of the natural
  /// residual. 1e-9 is near the limit of double precision on fine meshes.
  double tolerance = 1e-6;
  /// Largest number of iterations per column, each with one factorization. Usual numbers are 1 to
  /// 3, or 5 to 20 with ordered pairs or if the guess of the active bounds is poor.
  int maximum_iterations = 100;
  SparseSolver::Options solver;
};

/// One column of the weights to solve for. All columns share Q and the fixed vertices.
struct BoxQpColumn
{
  Eigen::VectorXd fixed_values; ///< values at the fixed vertices, in the order of these vertices
  /// Vertices that have a given value in this column only, in addition to the fixed vertices.
  std::vector<Index> pinned;
  Eigen::VectorXd pinned_values; ///< values at the pinned vertices
  /// Bounds of the vertices that are neither fixed nor pinned, [0, 1] by default. lower < upper is
  /// required, so a vertex with equal bounds must be pinned instead. Either both bounds of a vertex
  /// are finite or both are infinite.
  Bounds bounds;
  /// Pairs of vertices whose values must be in a given order, optionally with a minimum difference.
  /// The pairs must not form a cycle, and Q must store an entry for every pair. Pairs of two
  /// vertices with given values are ignored.
  std::vector<OrderedPair> pairs;
  Eigen::VectorXd start; ///< #V, initial guess; empty: the minimizer without bounds
  double energy = 0.0; ///< estimate of the minimum energy; 0: use the minimum without bounds
};

/// The solution of one column.
struct BoxQpSolution
{
  Status status; ///< ok, not_converged or canceled; internal_error if a factorization fails
  Eigen::VectorXd w; ///< #V: the weights; they satisfy bounds and pairs exactly
  Certificate certificate;
  Eigen::VectorXd multipliers; ///< Lagrange multipliers of column.pairs, >= 0
  int iterations = 0;
  int factorizations = 0;
  double factor_seconds = 0.0;
  double solve_seconds = 0.0; ///< time of everything except factorizations
};

} // namespace bindpose

#endif
