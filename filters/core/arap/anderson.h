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
/// combination of the last differences between successive values of g. The coefficients are those
/// for which the same combination of residual differences is nearest to the residual g(x) - x. The
/// next x is thus a linear combination of values of g whose coefficients sum to one. Therefore it
/// satisfies all linear constraints that these values satisfy. The caller decides whether an
/// extrapolated x is acceptable, for example by an energy that must not rise. If it is not
/// acceptable, the caller continues from g(x) and calls clear_history(). Method: Peng et al. 2018,
/// Anderson acceleration for geometry optimization and physics simulation.
///
/// The caller can add carried values, which are linear functions of x (such as a gradient). They
/// are stored behind x in memory and combined like x, but they are not part of the residual.
///
/// Scalar: float or double.
///
/// Cost of next(): window + 1 inner products, and window + 1 multiply-adds for each carried value.
template <typename Scalar>
class Anderson
{
public:
  /// Inner product of two residuals.
  using Dot = std::function<double(const Scalar*, const Scalar*)>;

  /// @param window number of previous iterates to combine, 0 (no acceleration) to
  /// largest_anderson_window.
  /// @param size number of entries of x.
  /// @param extra_size number of carried values, which are stored behind x in memory.
  Anderson(Index window, Index size, Index extra_size, Dot dot);

  Index window() const { return this->window_; }

  /// Discard the previous iterates.
  void clear_history() { this->count_ = 0; }

  /// Compute the extrapolated iterate x from g = g(x); both arrays include the carried values.
  /// Return false and leave x unchanged if there are no previous iterates or the coefficients are
  /// not finite.
  bool next(const Scalar* g, Scalar* x);

  /// Sum of the absolute values of the last coefficients. The round-off of the carried values in an
  /// extrapolated iterate is at most about this factor times their round-off in g(x).
  double coefficient_sum() const { return this->coefficient_sum_; }

private:
  bool solve(Index count, std::array<double, largest_anderson_window>& coefficients);

  Index window_, size_, length_;
  Dot dot_;
  Index count_ = 0; ///< number of calls of next() since clear_history()
  double coefficient_sum_ = 0.0;
  AlignedVector<Scalar> changes_g_, changes_f_; ///< ring buffers of `window` differences of g and f
  AlignedVector<Scalar> last_g_, last_f_;
  Eigen::MatrixXd products_; ///< inner products of the differences of the residual
  Eigen::VectorXd right_; ///< inner products of each difference with the last residual
  std::vector<double> factor_; ///< Cholesky factor, in rows of largest_anderson_window
};

/// Return the sum of a_i b_i. The function adds in 16 running sums (32 for floats) in a fixed order
/// on every processor, so the bits of the result are the same everywhere.
double packed_dot(Index count, const double* a, const double* b);
double packed_dot(Index count, const float* a, const float* b);

} // namespace bindpose

#endif
