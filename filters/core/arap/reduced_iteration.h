#ifndef bindpose_arap_reduced_iteration_h
#define bindpose_arap_reduced_iteration_h

// Alternation of local and global steps of reduced as-rigid-as-possible, in single or double
// precision (notation: reduced_solver.cpp).

#include "arap/anderson.h"
#include "base/aligned_vector.h"
#include "base/execution.h"
#include "linear/thin_product.h"

#include <chrono>
#include <optional>
#include <vector>

namespace bindpose
{

/// Stopping criteria of the alternation between local and global steps. The divisor of C (see
/// set_matrix()) does not affect energies.
struct ReducedLimits
{
  /// The run ends if an iteration lowers the energy by at most this fraction of the energy.
  double tolerance = 0.0;
  double minimum_energy = 0.0; ///< lower bound for the energy in the convergence test
  double energy_tolerance =
    0.0; ///< energies whose difference is at most this are equal up to round-off
  Index iterations = 0; ///< maximum number of iterations
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
};

/// Result of an alternation.
struct ReducedProgress
{
  std::vector<double>& energies; ///< run() appends the energy after each local and each global step
  Index iterations = 0;
  double change = 0.0; ///< decrease of the energy in the last iteration
  bool converged = false;
  bool within_deadline = true;
  bool canceled = false;
};

/// The alternation of reduced as-rigid-as-possible in its coordinates Y, as described in
/// reduced_solver.cpp:
///
///     S = S* + C Y,   Q = (best rotations of S) - I,   Y = C^T Q,
///
/// with Anderson acceleration. Scalar: float or double. In single precision the alternation stops
/// when the decrease of the energy is smaller than the round-off. set_matrix() can divide C by a
/// number, so that all values are in the range of Scalar.
///
/// Cost of an iteration: 36 #clusters #columns multiply-adds and #clusters rotation fits; C is read
/// once.
template <typename Scalar>
class ReducedIteration
{
public:
  using Columns =
    Eigen::Map<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>, 0, Eigen::OuterStride<>>;

  /// Return the matrix C, which the caller must fill. Entry (i, column) of cluster k is in row
  /// i * #clusters + k.
  Columns matrix(Index clusters, Index columns);
  /// Copy the matrix C of another ReducedIteration object, and divide the copy by `unit`.
  template <typename Other>
  void set_matrix(const ReducedIteration<Other>& from, double unit);

  /// Set S* and the initial rotations. Entry (i, j) of matrix k is at (3 i + j) * stride + k in
  /// both arrays.
  void begin(Index stride, const std::vector<double>& unrotated_covariance,
    const std::vector<double>& rotations);

  /// Continue from the last iterate of another ReducedIteration object whose begin() had the same
  /// arguments. Call this after begin(). If the covariances do not determine a rotation, the
  /// rotation of begin() is kept.
  template <typename Other>
  void continue_from(const ReducedIteration<Other>& from);

  /// Run the alternation. `unrotated_energy` is added to all energies. Return false if a value is
  /// not finite; in this case the list of energies is unchanged.
  bool run(ExecutionContext& context, const ReducedLimits& limits, Index window,
    double unrotated_energy, ReducedProgress& progress);

  /// Write the rotations of the last local step to `planes`. Entry (i, j) of rotation k has the
  /// index (3 i + j) * stride + k, as in begin().
  void rotations(Index stride, std::vector<double>& planes) const;

  /// Return Y, #columns x 3.
  Coordinates coordinates() const;

private:
  template <typename Other>
  friend class ReducedIteration;
  void set_size(Index clusters, Index columns);
  void set_unrotated_covariance(Index stride, const std::vector<double>& unrotated_covariance);
  double local_step(AlignedVector<Scalar>& iterate);
  double global_step(AlignedVector<Scalar>& iterate);

  // A column of C, of S^T or of Q^T consists of three blocks of #clusters values (one per
  // coordinate) and is padded with zeros to whole tiles.
  Index clusters_ = 0, columns_ = 0;
  Index rows_ = 0; ///< padded length of a column of C, S^T or Q^T
  Index length_ = 0; ///< padded length of a column of Y
  double unit_ = 1.0;
  AlignedVector<Scalar> covariance_; ///< C, with the columns in groups of four
  AlignedVector<Scalar> unrotated_covariance_; ///< S*: covariances of D*
  AlignedVector<Scalar> rotation_deltas_; ///< Q: rotations minus the identity
  /// Plain and extrapolated iterate. Each consists of three columns of Y, followed by S.
  AlignedVector<Scalar> iterate_, trial_;
  std::optional<Anderson<Scalar>> anderson_; ///< accelerator, stored to reuse its memory
  bool has_iterate_ = false; ///< false: the iteration starts from initial rotations
  double magnitude_ = 0.0; ///< sum of the absolute values of the energy's terms
};

} // namespace bindpose

#endif
