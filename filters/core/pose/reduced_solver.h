#ifndef bindpose_pose_reduced_solver_h
#define bindpose_pose_reduced_solver_h

#include "pose/reduced_basis.h"
#include "pose/reduced_iteration.h"
#include "pose/reduced_space.h"

namespace bindpose
{

/// The rotations that a solve begins with.
enum class ReducedStart
{
  last, ///< those of the last solve (a guess in the first): few iterations, twists add up
  guess, ///< near full handles theirs, elsewhere one that fits all pivots: depends on the pose only
  rest ///< none
};

struct ReducedSolveOptions
{
  /// Ends when an iteration lowers the energy by no more than this share of it (or of 1e-6 of
  /// the rest energy, a strain of a few 1e-6). 0: runs all iterations, cannot fail to converge.
  double tolerance = 1e-6;
  Index max_iterations = 100;
  ReducedStart start = ReducedStart::last;
  /// Iterates that acceleration looks back on, at most largest_anderson_window; 0: none.
  Index anderson_window = 5;
  /// Ends after the iteration in which this much time has passed; 0: no limit. How many iterations
  /// that allows depends on the machine: as max_iterations they give the same bits again.
  double budget_microseconds = 0.0;
  /// Iterates in single precision until its round-off hides whether the energy falls, and from
  /// there, at least once, in double precision. Off: in double precision from the start.
  bool mixed_precision = true;
};

/// Minimises 1/2 <D, H D> - <P, D> - (what rotations gain) over displacements D of a ReducedSpace
/// and rotations of its clusters, under the constraints of a pose. For reduced as-rigid-as-possible
/// H is the stiffness and P zero; a step in time adds masses to H and their momentum to P.
class ReducedSolver
{
public:
  /// What is minimised besides the space's own part.
  struct Quadratic
  {
    const Eigen::MatrixXd& stiffness; ///< H, 4 #columns x 4 #columns
    const ReducedSpace::Rows& load; ///< P, as D
    double constant = 0.0; ///< added to energies
  };

  /// Forgets factors: H is another one, or the space is.
  void reset();

  /// See ReducedArap::solve(). D and transforms() are the result.
  Status solve(ExecutionContext& context, const ReducedSpace& space, const Quadratic& quadratic,
    const Pose& pose, const ReducedSolveOptions& options, ReducedSpace::Rows& d);

  /// The next solve starts from a guess.
  void forget() { this->warm_ = false; }

  /// Rotations of the last solve in the space's planes, to be kept and given back.
  const std::vector<double>& rotations() const { return this->rotations_; }
  void set_rotations(std::vector<double> rotations);

  /// Energy after each half-step of the last solve: start, local, global, local, global, …
  const std::vector<double>& energies() const { return this->energies_; }

private:
  void factor(const ReducedSpace& space, const Eigen::MatrixXd& stiffness, const Pose& pose);
  void start_rotations(const ReducedSpace& space, const Pose& pose);

  // ---- per choice of modes
  std::vector<HandleMode> modes_;
  std::vector<Index> positions_; ///< pivots and tails that are held: rows of pivot_rows
  std::vector<Index> redundant_;
  Eigen::MatrixXd position_rows_; ///< positions x 4 #columns: their displacements
  ReducedBasis basis_; ///< B and what goes with it
  ReducedIteration<double> iteration_; ///< with C = K M B
  ReducedIteration<float> single_iteration_; ///< where single precision can hold C
  bool has_single_ = false;

  // ---- state
  std::vector<double> rotations_; ///< planes, see ReducedSpace
  bool warm_ = false;
  std::vector<double> energies_;
};

} // namespace bindpose

#endif
