#ifndef bindpose_pose_reduced_solver_h
#define bindpose_pose_reduced_solver_h

#include "pose/reduced_basis.h"
#include "pose/reduced_iteration.h"
#include "pose/reduced_space.h"

namespace bindpose
{

/// Initial rotations of a solve.
enum class ReducedStart
{
  /// Rotations of the last solve (a guess in the first solve): few iterations, twists accumulate.
  last,
  /// Rotations of the full handles nearby, elsewhere the rotation that best fits all pivots;
  /// depends on the pose only.
  guess,
  rest ///< identity
};

struct ReducedSolveOptions
{
  /// The solve ends if an iteration lowers the energy by at most this fraction of the energy (or of
  /// 1e-6 of the rest energy, which is a strain of a few 1e-6). 0: run all iterations; the result
  /// is never not_converged.
  double tolerance = 1e-6;
  Index max_iterations = 100;
  ReducedStart start = ReducedStart::last;
  /// Number of previous iterates that acceleration combines, at most largest_anderson_window; 0: no
  /// acceleration.
  Index anderson_window = 5;
  /// The solve ends after the iteration in which this much time has passed; 0: no limit. The number
  /// of iterations then depends on the machine. A solve with this number as max_iterations gives
  /// the same bits.
  double budget_microseconds = 0.0;
  /// If true, iterate in single precision until its round-off hides whether the energy still falls.
  /// Then continue in double precision for at least one iteration. If false, use double precision
  /// only.
  bool mixed_precision = true;
};

/// Minimizes 1/2 <D, H D> - <P, D> - <Q, S0 + K D> over displacements D of a ReducedSpace and
/// rotations R = I + Q of its clusters, under the constraints of a pose. In reduced
/// as-rigid-as-possible H is the stiffness and P is zero. In a time step, masses are added to H and
/// their momentum to P.
class ReducedSolver
{
public:
  /// The terms of the minimization that do not depend on rotations.
  struct Quadratic
  {
    const Eigen::MatrixXd& stiffness; ///< H, 4 #columns x 4 #columns
    const ReducedSpace::Rows& load; ///< P, in the layout of D
    double constant = 0.0; ///< added to all energies
  };

  /// Discard the factors. Call it if H or the space has changed.
  void reset();

  /// Solve as ReducedArap::solve() does; the result is D.
  Status solve(ExecutionContext& context, const ReducedSpace& space, const Quadratic& quadratic,
    const Pose& pose, const ReducedSolveOptions& options, ReducedSpace::Rows& d);

  /// Make the next solve start from a guess.
  void forget() { this->warm_ = false; }

  /// Rotations of the last solve in the space's planes. The caller can store them and restore them
  /// later.
  const std::vector<double>& rotations() const { return this->rotations_; }
  void set_rotations(std::vector<double> rotations);

  /// Energy after each half-step of the last solve: start, local, global, local, global, …
  const std::vector<double>& energies() const { return this->energies_; }

private:
  void factor(const ReducedSpace& space, const Eigen::MatrixXd& stiffness, const Pose& pose);
  void start_rotations(const ReducedSpace& space, const Pose& pose);

  // ---- per choice of modes
  std::vector<HandleMode> modes_;
  std::vector<Index> positions_; ///< constrained pivots and tails: rows of pivot_rows
  std::vector<Index> redundant_;
  Eigen::MatrixXd position_rows_; ///< positions x 4 #columns: displacements of the positions
  ReducedBasis basis_; ///< B
  ReducedIteration<double> iteration_; ///< uses C = K M B
  ReducedIteration<float> single_iteration_; ///< valid if single precision can represent C
  bool has_single_ = false;

  // ---- state
  std::vector<double> rotations_; ///< planes, see ReducedSpace
  bool warm_ = false;
  std::vector<double> energies_;
};

} // namespace bindpose

#endif
