#ifndef bindpose_arap_anderson_h
#define bindpose_arap_anderson_h

#include "base/aligned_vector.h"
#include "geometry/mesh.h"

#include <array>
#include <functional>
#include <vector>

namespace bindpose
{

constexpr Index largest_anderson_window = 50;

/// Anderson acceleration of a fixed-point iteration x <- g(x). The next x is g(x) minus a linear
/// combination of the last differences between successive values of g. The residual g(x) - x has
/// corresponding differences between successive values. The coefficients are chosen so that the
/// same combination of residual differences is nearest to the last residual. The next x is an
/// affine combination of values of g: the coefficients of these values sum to one. Therefore the
/// next x satisfies all linear constraints that the values of g satisfy. The caller decides whether
/// an extrapolated x is acceptable, for example by checking that an energy does not rise. If the
/// extrapolated x is not acceptable, the caller continues from g(x) and calls clear_history().
/// Method: Peng et al. 2018, Anderson acceleration for geometry optimization and physics
/// simulation.
///
/// The caller can append extra values to x, which are linear functions of x (such as a gradient).
/// They are combined like x, but they are not part of the residual.
///
/// Scalar: float or double.
///
/// Cost of next(): window + 1 inner products, and window + 1 multiply-adds for each extra value.
template <typename Scalar>
class Anderson
{
public:
  /// Inner product of two residuals.
  using Dot = std::function<double(const Scalar*, const Scalar*)>;

  /// @param window number of previous iterates to combine, 0 (no acceleration) to
  /// largest_anderson_window.
  /// @param size number of entries of x.
  /// @param extra_size number of extra values, which are stored behind x in memory.
  Anderson(Index window, Index size, Index extra_size, Dot dot);

  Index window() const { return this->window_; }

  /// Discard the previous iterates.
  void clear_history() { this->count_ = 0; }

  /// Replace the iterate x by the extrapolated iterate. Return false and leave x unchanged if there
  /// are no previous iterates or the coefficients are not finite.
  /// @param g the value g(x), followed by its extra values.
  /// @param x the iterate x, followed by its extra values.
  bool next(const Scalar* g, Scalar* x);

  /// Sum of the absolute values of the coefficients that the last call of next() computed. The
  /// extrapolation multiplies the round-off of the extra values by at most about this sum.
  double coefficient_sum() const { return this->coefficient_sum_; }

private:
  bool solve(Index count, std::array<double, largest_anderson_window>& coefficients);

  Index window_, size_, length_;
  Dot dot_;
  Index count_ = 0; ///< number of calls of next() since clear_history()
  double coefficient_sum_ = 0.0;
  // The residual is f = g(x) - x. A difference is the change of g or of f from one call of next()
  // to the next call. The last `window` differences are stored.
  AlignedVector<Scalar> changes_g_, changes_f_; ///< ring buffers of the differences of g and of f
  AlignedVector<Scalar> last_g_, last_f_;
  Eigen::MatrixXd products_; ///< entry (i, j): inner product of differences i and j of f
  Eigen::VectorXd right_; ///< entry i: inner product of difference i of f with the last f
  std::vector<double> factor_; ///< Cholesky factor; each row has largest_anderson_window entries
};

/// Return the sum of a_i b_i. The function adds in 16 running sums (32 for floats) in a fixed order
/// on every processor, so the bits of the result are the same everywhere.
double packed_dot(Index count, const double* a, const double* b);
double packed_dot(Index count, const float* a, const float* b);

} // namespace bindpose

#endif
