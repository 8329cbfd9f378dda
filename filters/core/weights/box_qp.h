#ifndef bindpose_weights_box_qp_h
#define bindpose_weights_box_qp_h

#include "base/execution.h"
#include "base/sparse_solver.h"
#include "weights/certificate.h"

#include <memory>

namespace bindpose
{

struct BoxQpOptions
{
  /// Both the relative duality gap and the natural residual must get below it. 1e-6 by default;
  /// 1e-9 is "tight" and near the limit of double precision on fine meshes. Range (0, 1).
  double tolerance = 1e-6;
  /// Iterations a column, each one factorisation. 1 to 3 are usual, 5 to 20 where the guess at the
  /// bounds is not good enough, 25 with ordered pairs.
  int maximum_iterations = 100;
  SparseSolver::Options solver;
};

/// One column to solve for; all columns share Q and the fixed vertices.
struct BoxQpColumn
{
  Eigen::VectorXd fixed_values; ///< values at the fixed vertices, in their order
  /// Vertices that this column alone fixes besides, and their values.
  std::vector<Index> pinned;
  Eigen::VectorXd pinned_values;
  /// Of all other vertices: [0, 1] unless given. lower < upper (equal: pin the vertex), either both
  /// finite or both infinite.
  Bounds bounds;
  /// Pairs that must stay ordered, by some distance if need be; without a cycle, both ends of every
  /// pair joined by an entry of Q. Pairs between vertices that are not free are ignored.
  std::vector<OrderedPair> pairs;
  Eigen::VectorXd start; ///< #V, a guess; empty: the minimiser without bounds
  double energy = 0.0; ///< the minimum, roughly; 0: that without bounds
};

struct BoxQpSolution
{
  Status status; ///< ok, not_converged or cancelled; internal_error when a factorisation fails
  Eigen::VectorXd w; ///< #V, within the bounds exactly and with all pairs ordered exactly
  Certificate certificate;
  Eigen::VectorXd multipliers; ///< of column.pairs, >= 0
  int iterations = 0;
  int factorisations = 0;
  double factor_seconds = 0.0;
  double solve_seconds = 0.0; ///< everything but factorisations
};

/// min 1/2 w' Q w subject to l <= w <= u (0 and 1 by default) and given values at the fixed
/// vertices, for many columns. One symbolic analysis serves all of them. Splitting guesses all
/// columns at once and finds the bounds that hold them; from there an active-set method solves for
/// each column, and a primal-dual interior-point method where that does not lead to the minimiser
/// and where there are ordered pairs.
///
/// Stops on the certificate only (see Certificate), never on iterations: not reaching it within the
/// budget is not_converged, with the best iterate and its numbers. Cost a column with CHOLMOD, when
/// there are eight, in F, the time of one factorisation of Q in double precision: 3 to 6 F on
/// lattices of real shapes with 9k to 11k vertices, three to five times that where the
/// interior-point method is needed; with ordered pairs 12 to 13 F on a box of 5k; with Eigen's
/// backend 10 to 25 F. Memory: a factor in single precision of Q and one a thread, with a third
/// more for its work (63k vertices: 1.4 GB in all with one thread); with ordered pairs or where
/// single precision fails, a factor in double precision a thread as well.
///
/// Hintermueller, Ito and Kunisch 2003; Mehrotra 1992; Gondzio 1996; Jacobson et al. 2011 and 2012
/// for the problems.
class BoxQp
{
public:
  /// @param q symmetric positive semi-definite, #V x #V, definite on the vertices left free.
  /// @param fixed ids of the fixed vertices, each once.
  BoxQp(const SparseMatrix& q, std::vector<Index> fixed, const BoxQpOptions& options);
  ~BoxQp();
  BoxQp(const BoxQp&) = delete;
  BoxQp& operator=(const BoxQp&) = delete;

  /// Analyses and factors Q once. Must succeed before anything else is called. Phase "analyse".
  /// internal_error before anything is factored when memory will not do for these columns.
  /// @param columns that solve_all() will be asked for. Where memory will not do for a factor a
  /// thread, solve_all() takes fewer threads.
  Status prepare(ExecutionContext& context, const std::vector<BoxQpColumn>& columns = {});

  /// #V x m: the minimisers without bounds for m columns of fixed values (#fixed x m).
  Eigen::MatrixXd unconstrained(const Eigen::MatrixXd& fixed_values) const;
  /// #free x m: the inverse of Q's free block times m columns; NaN where memory will not do for it.
  Eigen::MatrixXd inverse(const Eigen::MatrixXd& rhs) const;

  /// The same for columns with pinned vertices, with the certificate of a problem without bounds:
  /// gap = 1/2 g' A^-1 g, which is E(w) - min E exactly, and residual = max |g / diag Q|.
  std::vector<BoxQpSolution> solve_unbounded(
    const std::vector<BoxQpColumn>& columns, ExecutionContext& context) const;

  /// Solves for one column.
  BoxQpSolution solve(const BoxQpColumn& column, ExecutionContext& context) const;

  /// Solves for all columns on the context's threads: the same bits for any number of threads.
  /// Stops early when cancelled; columns that were not reached then say cancelled.
  std::vector<BoxQpSolution> solve_all(
    const std::vector<BoxQpColumn>& columns, ExecutionContext& context) const;

  Index free_count() const;
  Index analyses() const;
  Index factorisations() const;
  /// Bytes that the process will hold at most, as estimated by prepare() after the analysis.
  double memory_estimate() const;
  /// Has analysed the pattern of Q's free block.
  const SparseSolver& solver() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The status of the first column that has no result; ok when all have one.
Status worst_of(const std::vector<BoxQpSolution>& solutions);

} // namespace bindpose

#endif
