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

/// Stopping criteria of the alternation, in units of the energy.
struct ReducedLimits
{
  /// The run ends if an iteration lowers the energy by at most this fraction.
  double tolerance = 0.0;
  double least_energy = 0.0; ///< a lower energy counts as this much in the tolerance
  double same_energy = 0.0; ///< energies that differ by at most this are equal up to round-off
  Index iterations = 0; ///< largest number of iterations
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
};

/// Result of an alternation.
struct ReducedProgress
{
  std::vector<double>& energies; ///< after each half-step; appended to
  Index iterations = 0;
  double change = 0.0; ///< decrease of the energy in the last iteration
  bool converged = false;
  bool in_time = true;
  bool canceled = false;
};

/// The alternation of reduced as-rigid-as-possible in its coordinates Y, as described in
/// reduced_solver.cpp:
///     S = S* + C Y,   Q = best rotations of S - I,   Y = C^T Q,
/// with Anderson acceleration. Scalar: float or double. In single precision it stops when round-off
/// hides whether the energy still falls. Numbers are in units in which C has size one.
///
/// Cost of an iteration: 36 #clusters #columns multiply-adds and a fit of #clusters rotations; C is
/// read once.
template <typename Scalar>
class ReducedIteration
{
public:
  using Columns =
    Eigen::Map<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>, 0, Eigen::OuterStride<>>;

  /// Return the matrix C for the caller to fill: entry (i, column) of cluster k is in row
  /// i #clusters + k.
  Columns matrix(Index clusters, Index columns);
  /// Copy the matrix of another iteration.
  /// @param unit divisor of C.
  template <typename Other>
  void set_matrix(const ReducedIteration<Other>& from, double unit);

  /// Set S* and the rotations, in planes of `stride`: entry (i, j) of matrix k is at
  /// (3 i + j) stride + k.
  void begin(Index stride, const std::vector<double>& star, const std::vector<double>& rotations);

  /// Continue from the last iterate of another iteration that began with the same values. Call it
  /// after begin(). Rotations that the covariances do not determine stay those of begin().
  template <typename Other>
  void go_on(const ReducedIteration<Other>& from);

  /// Run the alternation. `star_energy` is added to all energies. Return false if a number was not
  /// finite; the energies are then unchanged.
  bool run(ExecutionContext& context, const ReducedLimits& limits, Index window, double star_energy,
    ReducedProgress& progress);

  /// Write the last rotations, in planes as in begin().
  void rotations(Index stride, std::vector<double>& planes) const;

  /// Return Y, #columns x 3.
  Coordinates coordinates() const;

private:
  template <typename Other>
  friend class ReducedIteration;
  void set_size(Index clusters, Index columns);
  void set_star(Index stride, const std::vector<double>& star);
  double local_step(AlignedVector<Scalar>& iterate);
  double global_step(AlignedVector<Scalar>& iterate);

  // A column of C, of S^T and of Q^T has three planes of #clusters, padded with zeros to whole
  // tiles.
  Index clusters_ = 0, columns_ = 0;
  Index rows_ = 0; ///< length of such a column
  Index length_ = 0; ///< length of a column of Y, padded
  double unit_ = 1.0;
  AlignedVector<Scalar> covariance_; ///< C, columns in groups of four
  AlignedVector<Scalar> star_; ///< S*
  AlignedVector<Scalar> turns_; ///< Q
  AlignedVector<Scalar> plain_, tried_; ///< iterates: three columns of Y, then S
  std::optional<Anderson<Scalar>> anderson_; ///< kept to reuse its memory
  bool has_iterate_ = false; ///< false: the iteration starts from rotations
  double magnitude_ = 0.0; ///< sum of the terms whose difference is the energy
};

} // namespace bindpose

#endif
