#ifndef bindpose_pose_reduced_iteration_h
#define bindpose_pose_reduced_iteration_h

#include "base/aligned_vector.h"
#include "base/execution.h"
#include "base/thin_product.h"
#include "pose/anderson.h"

#include <chrono>
#include <optional>
#include <vector>

namespace bindpose
{

/// What an alternation stops at, in units of the energy.
struct ReducedLimits
{
  double tolerance = 0.0; ///< ends when an iteration lowers the energy by at most this share of it
  double least_energy = 0.0; ///< a lower one counts as this much, for the tolerance
  double same_energy = 0.0; ///< energies this far apart are equal but for round-off
  Index iterations = 0; ///< at most
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
};

/// How far an alternation came.
struct ReducedProgress
{
  std::vector<double>& energies; ///< after each half-step; grows
  Index iterations = 0;
  double change = 0.0; ///< of the energy, in the last iteration
  bool converged = false;
  bool in_time = true;
  bool cancelled = false;
};

/// The alternation of reduced as-rigid-as-possible in its own coordinates Y, as told in
/// reduced_solver.cpp:
///     S = S* + C Y,   Q = best rotations of S - I,   Y = C^T Q,
/// with Anderson acceleration. Scalar: float or double. In float it stops where round-off hides
/// whether the energy still falls; numbers are in units in which C is of size one.
///
/// Cost of an iteration: 36 #clusters #columns multiply-adds and a fit of #clusters rotations; C is
/// read once.
template <typename Scalar>
class ReducedIteration
{
public:
  using Columns =
    Eigen::Map<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>, 0, Eigen::OuterStride<>>;

  /// C, to be filled: entry (i, column) of cluster k in row i #clusters + k.
  Columns matrix(Index clusters, Index columns);
  /// Takes another one's.
  /// @param unit what C is divided by.
  template <typename Other>
  void set_matrix(const ReducedIteration<Other>& from, double unit);

  /// S* and rotations in planes of `stride`: entry (i, j) of matrix k at (3 i + j) stride + k.
  void begin(Index stride, const std::vector<double>& star, const std::vector<double>& rotations);

  /// After begin(), to go on where another one has come to that began with the same. Rotations that
  /// nothing determines stay those of begin().
  template <typename Other>
  void go_on(const ReducedIteration<Other>& from);

  /// Alternates from there on. `star_energy` is added to all energies. False when something was not
  /// finite: then the energies are what they were.
  bool run(ExecutionContext& context, const ReducedLimits& limits, Index window, double star_energy,
    ReducedProgress& progress);

  /// The last rotations, in planes as those of begin().
  void rotations(Index stride, std::vector<double>& planes) const;

  /// Y: #columns x 3.
  Coordinates coordinates() const;

private:
  template <typename Other>
  friend class ReducedIteration;
  void set_size(Index clusters, Index columns);
  void set_star(Index stride, const std::vector<double>& star);
  double local_step(AlignedVector<Scalar>& iterate);
  double global_step(AlignedVector<Scalar>& iterate);

  // A column of C, of S^T and of Q^T has three planes of #clusters and zeros up to whole tiles.
  Index clusters_ = 0, columns_ = 0;
  Index rows_ = 0; ///< of a column
  Index length_ = 0; ///< of a column of Y
  double unit_ = 1.0;
  AlignedVector<Scalar> covariance_; ///< C, columns in groups of four
  AlignedVector<Scalar> star_; ///< S*
  AlignedVector<Scalar> turns_; ///< Q
  AlignedVector<Scalar> plain_, tried_; ///< iterates: three columns of Y, then S
  std::optional<Anderson<Scalar>> anderson_; ///< kept for its memory
  bool has_iterate_ = false; ///< else rotations to begin with
  double magnitude_ = 0.0; ///< of what an energy is the difference
};

} // namespace bindpose

#endif
