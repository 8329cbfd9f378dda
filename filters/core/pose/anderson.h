#ifndef bindpose_pose_anderson_h
#define bindpose_pose_anderson_h

#include "base/aligned_vector.h"
#include "base/mesh.h"

#include <array>
#include <functional>
#include <vector>

namespace bindpose
{

constexpr Index largest_anderson_window = 50;

/// Anderson acceleration of an iteration x <- g(x) whose fixed point is sought: the next x is g(x)
/// less a combination of the last changes of g, namely the one that makes the same combination of
/// the last changes of the residual g(x) - x cancel g(x) - x best. Where x obeys linear
/// constraints, the extrapolated x does, too: shares of iterates sum to one. Whether an
/// extrapolated x is any good is the caller's to decide (by an energy that must not rise); if not,
/// it goes on from g(x) and calls forget(). Peng et al. 2018, Anderson acceleration for geometry
/// optimization and physics simulation.
///
/// Numbers that are linear functions of x (like a gradient) can be carried along: they follow x in
/// memory, take part in the combinations, but not in the residual.
///
/// Scalar: float or double.
///
/// Cost of next(): window + 1 inner products, and as many multiply-adds for each number carried.
template <typename Scalar>
class Anderson
{
public:
  /// Inner product of two residuals.
  using Dot = std::function<double(const Scalar*, const Scalar*)>;

  /// @param window iterates that are looked back on, 0 (no acceleration) to
  /// largest_anderson_window.
  /// @param size of x; @param carried how many numbers follow it.
  Anderson(Index window, Index size, Index carried, Dot dot);

  Index window() const { return this->window_; }

  /// The next iterate has no past.
  void forget() { this->count_ = 0; }

  /// g is g(x), both with what they carry; x becomes the extrapolated iterate. False, and x is what
  /// it was, when there is nothing to extrapolate from yet or nothing finite comes out.
  bool next(const Scalar* g, Scalar* x);

  /// Sum of the sizes of the last shares: how much larger than an iterate's the round-off of what
  /// was carried along may be.
  double reach() const { return this->reach_; }

private:
  bool solve(Index count, std::array<double, largest_anderson_window>& shares);

  Index window_, size_, length_;
  Dot dot_;
  Index count_ = 0; ///< iterates seen
  double reach_ = 0.0;
  AlignedVector<Scalar> changes_g_, changes_f_; ///< rings of `window` rows
  AlignedVector<Scalar> last_g_, last_f_;
  Eigen::MatrixXd products_; ///< of the changes of the residual
  Eigen::VectorXd right_; ///< of each change with the last residual
  std::vector<double> factor_; ///< rows of largest_anderson_window
};

/// Sum of a_i b_i in eight running sums, or sixteen of floats, whatever the processor: the same
/// bits everywhere.
double packed_dot(Index count, const double* a, const double* b);
double packed_dot(Index count, const float* a, const float* b);

} // namespace bindpose

#endif
