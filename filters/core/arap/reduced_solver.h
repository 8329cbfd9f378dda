#ifndef bindpose_arap_reduced_solver_h
#define bindpose_arap_reduced_solver_h

// Solver of reduced as-rigid-as-possible for one pose (Jacobson et al. 2012).

#include "arap/reduced_basis.h"
#include "arap/reduced_iteration.h"
#include "arap/reduced_space.h"

namespace bindpose
{

/// Initial rotations of a solve.
enum class ReducedStart
{
  /// Rotations of the last solve (`guess` in the first solve). While a user drags a handle, each
  /// solve then needs few iterations, and twists of more than half a turn can accumulate.
  last,
  /// For each cluster, the rotation nearest to a weighted sum over all handles. A handle in mode
  /// full contributes the linear part of its transform. Every other handle contributes the rotation
  /// that best fits the whole pose. These initial rotations depend only on the pose.
  guess,
  rest ///< identity matrices
};

/// Options of ReducedSolver::solve().
struct ReducedSolveOptions
{
  /// The solve ends if an iteration lowers the energy by at most this fraction of the energy.
  /// If the energy is below 1e-6 * ReducedSpace::rest_energy (a strain of about 1e-3), this bound
  /// replaces the energy in the test. If the tolerance is 0, there is no test, and the solve cannot
  /// return not_converged.
  double tolerance = 1e-6;
  Index max_iterations = 100;
  ReducedStart start = ReducedStart::last;
  /// Number of previous iterates that Anderson acceleration combines, at most
  /// largest_anderson_window; 0: no acceleration.
  Index anderson_window = 5;
  /// The solve ends after the iteration in which this time is exceeded; 0: no limit. With a limit,
  /// the number of iterations depends on the machine. To repeat a result bit for bit, set
  /// max_iterations to the number of iterations in the report.
  double budget_microseconds = 0.0;
  /// If true, iterate in single precision until the decrease of the energy is smaller than the
  /// round-off. Then continue in double precision for at least one iteration. If false, use only
  /// double precision.
  bool mixed_precision = true;
};

/// Minimizes 1/2 <D, H D> - <P, D> - <Q, S0 + K D> over displacements D of a ReducedSpace and
/// rotations R = I + Q of its clusters, under the constraints of a pose. In reduced
/// as-rigid-as-possible H is the stiffness and P is zero. In a time step of ReducedDynamics, H also
/// contains masses and P contains their momentum.
class ReducedSolver
{
public:
  /// H, P and a constant: the terms of the minimization that do not depend on rotations.
  struct Quadratic
  {
    const Eigen::MatrixXd& stiffness; ///< H, 4 #columns x 4 #columns
    const ReducedSpace::Rows& load; ///< P, in the layout of D
    double constant = 0.0; ///< constant added to all energies
  };

  /// Discard the factorization. Call this function after a change of H or of the space.
  void reset();

  /// Solve as described at ReducedArap::solve(). The result is D.
  Status solve(ExecutionContext& context, const ReducedSpace& space, const Quadratic& quadratic,
    const Pose& pose, const ReducedSolveOptions& options, ReducedSpace::Rows& d);

  /// Discard the last rotations, so that the next solve starts with `guess`.
  void discard_rotations() { this->has_rotations_ = false; }

  /// Rotations of the last solve. Entry (i, j) of rotation k has the index (3 i + j) * stride + k,
  /// with ReducedSpace::stride. The caller can store and restore the rotations.
  const std::vector<double>& rotations() const { return this->rotations_; }
  void set_rotations(std::vector<double> rotations);

  /// Energy after each local and global step of the last solve: start, local, global, local,
  /// global, …
  const std::vector<double>& energies() const { return this->energies_; }

private:
  void factor(const ReducedSpace& space, const Eigen::MatrixXd& stiffness, const Pose& pose);
  void start_rotations(const ReducedSpace& space, const Pose& pose);

  // ---- per choice of modes
  std::vector<HandleMode> modes_;
  std::vector<Index> positions_; ///< rows of pivot_rows for the constrained pivots and tails
  std::vector<Index> redundant_;
  /// #positions x 4 #columns: maps D to the displacements of the positions.
  Eigen::MatrixXd position_rows_;
  ReducedBasis basis_; ///< basis B of the displacements
  ReducedIteration<double> iteration_; ///< alternation with C = K B in double precision
  /// Alternation in single precision; valid if single precision can represent C.
  ReducedIteration<float> single_iteration_;
  bool has_single_precision_ = false;

  // ---- state
  std::vector<double> rotations_; ///< rotations of the last solve, in the layout of rotations()
  bool has_rotations_ = false;
  std::vector<double> energies_;
};

} // namespace bindpose

#endif
