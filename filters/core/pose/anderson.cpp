// The changes of g and of the residual f = g - x are stored in ring buffers, one row per change.
// The normal equations are updated incrementally: a new change adds a row of products, and the
// products with the residual follow from that row. A step therefore needs one inner product per row
// and one more.
#include "pose/anderson.h"

#include "base/packs.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
/// Regularization of the normal equations after scaling to a unit diagonal. Changes that are closer
/// to parallel than this get even coefficients instead of large ones of opposite sign.
template <typename Scalar>
constexpr double ridge = sizeof(Scalar) == 4 ? 1e-6 : 1e-10;

/// change = now - last, last = now
template <typename Scalar>
BINDPOSE_ALWAYS_INLINE void take_change_of(
  Index count, const Scalar* __restrict now, Scalar* __restrict last, Scalar* __restrict change)
{
  for (Index i = 0; i < count; ++i)
  {
    change[i] = now[i] - last[i];
    last[i] = now[i];
  }
}

/// residual change = (g - x) - last, last = g - x
template <typename Scalar>
BINDPOSE_ALWAYS_INLINE void take_residual_change_of(Index count, const Scalar* __restrict g,
  const Scalar* __restrict x, Scalar* __restrict last, Scalar* __restrict change)
{
  for (Index i = 0; i < count; ++i)
  {
    const Scalar now = g[i] - x[i];
    change[i] = now - last[i];
    last[i] = now;
  }
}

/// x = g - sum of shares times rows
template <typename Scalar>
BINDPOSE_ALWAYS_INLINE void extrapolate_of(Index count, Index rows, const double* shares,
  const Scalar* __restrict g, const Scalar* __restrict changes, Scalar* __restrict x)
{
  using Pack = typename PackOf<Scalar>::Pack;
  constexpr Index lanes = PackOf<Scalar>::lanes;
  Index i = 0;
  for (; i + 2 * lanes <= count; i += 2 * lanes)
  {
    Pack a = pack_at(g + i), b = pack_at(g + i + lanes);
    for (Index r = 0; r < rows; ++r)
    {
      const auto share = static_cast<Scalar>(shares[r]);
      a -= pack_at(changes + r * count + i) * share;
      b -= pack_at(changes + r * count + i + lanes) * share;
    }
    pack_at(x + i) = a;
    pack_at(x + i + lanes) = b;
  }
  for (; i < count; ++i)
  {
    Scalar sum = g[i];
    for (Index r = 0; r < rows; ++r)
    {
      sum -= changes[r * count + i] * static_cast<Scalar>(shares[r]);
    }
    x[i] = sum;
  }
}

template <typename Scalar>
BINDPOSE_ALWAYS_INLINE double dot_of(Index count, const Scalar* a, const Scalar* b)
{
  using Pack = typename PackOf<Scalar>::Pack;
  constexpr Index lanes = PackOf<Scalar>::lanes;
  Pack low[2] = {}, high[2] = {};
  Index i = 0;
  for (; i + 4 * lanes <= count; i += 4 * lanes)
  {
    low[0] += pack_at(a + i) * pack_at(b + i);
    high[0] += pack_at(a + i + lanes) * pack_at(b + i + lanes);
    low[1] += pack_at(a + i + 2 * lanes) * pack_at(b + i + 2 * lanes);
    high[1] += pack_at(a + i + 3 * lanes) * pack_at(b + i + 3 * lanes);
  }
  for (; i + 2 * lanes <= count; i += 2 * lanes)
  {
    low[0] += pack_at(a + i) * pack_at(b + i);
    high[0] += pack_at(a + i + lanes) * pack_at(b + i + lanes);
  }
  const Pack sums = (low[0] + low[1]) + (high[0] + high[1]);
  double sum = 0.0;
  for (Index k = 0; k < lanes / 2; ++k)
  {
    sum += double(sums[k]) + double(sums[k + lanes / 2]);
  }
  for (; i < count; ++i)
  {
    sum += double(a[i]) * double(b[i]);
  }
  return sum;
}

// Functions with SIMD clones cannot be templates.
#define BINDPOSE_ANDERSON_LOOPS(Scalar)                                                \
  BINDPOSE_SIMD_CLONES void take_change(                                               \
    Index count, const Scalar* now, Scalar* last, Scalar* change)                      \
  {                                                                                    \
    take_change_of(count, now, last, change);                                          \
  }                                                                                    \
  BINDPOSE_SIMD_CLONES void take_residual_change(                                      \
    Index count, const Scalar* g, const Scalar* x, Scalar* last, Scalar* change)       \
  {                                                                                    \
    take_residual_change_of(count, g, x, last, change);                                \
  }                                                                                    \
  BINDPOSE_SIMD_CLONES void extrapolate(Index count, Index rows, const double* shares, \
    const Scalar* g, const Scalar* changes, Scalar* x)                                 \
  {                                                                                    \
    extrapolate_of(count, rows, shares, g, changes, x);                                \
  }
BINDPOSE_ANDERSON_LOOPS(float)
BINDPOSE_ANDERSON_LOOPS(double)
#undef BINDPOSE_ANDERSON_LOOPS
} // namespace

BINDPOSE_SIMD_CLONES double packed_dot(Index count, const double* a, const double* b)
{
  return dot_of(count, a, b);
}

BINDPOSE_SIMD_CLONES double packed_dot(Index count, const float* a, const float* b)
{
  return dot_of(count, a, b);
}

template <typename Scalar>
Anderson<Scalar>::Anderson(Index window, Index size, Index carried, Dot dot)
  : window_(std::clamp<Index>(window, 0, largest_anderson_window)), size_(size),
    length_(size + carried), dot_(std::move(dot)),
    products_(Eigen::MatrixXd::Zero(this->window_, this->window_)),
    right_(Eigen::VectorXd::Zero(this->window_))
{
  if (this->window_ > 0)
  {
    this->changes_g_.resize(this->window_ * this->length_);
    this->changes_f_.resize(this->window_ * this->size_);
    this->last_g_.resize(this->length_);
    this->last_f_.resize(this->size_);
    this->factor_.resize(largest_anderson_window * this->window_);
  }
}

/// Solve the normal equations by Cholesky's method, in place. The factorization is written out
/// because a solve of the pose needs thousands of these small systems (5 x 5), and a library call
/// for any size costs more than the products of an iteration.
template <typename Scalar>
bool Anderson<Scalar>::solve(Index count, std::array<double, largest_anderson_window>& shares)
{
  double* const l = this->factor_.data();
  std::array<double, largest_anderson_window> scale;
  bool good = true;
  for (Index i = 0; i < count; ++i)
  {
    const double square = this->products_(i, i);
    scale[i] = square > 0.0 ? 1.0 / std::sqrt(square) : 0.0;
    double right = scale[i] * this->right_[i];
    double pivot = 1.0 + ridge<Scalar>;
    for (Index j = 0; j < i; ++j)
    {
      double entry = scale[i] * scale[j] * this->products_(i, j);
      for (Index k = 0; k < j; ++k)
      {
        entry -= l[i * largest_anderson_window + k] * l[j * largest_anderson_window + k];
      }
      entry *= l[j * largest_anderson_window + j];
      l[i * largest_anderson_window + j] = entry;
      pivot -= entry * entry;
      right -= entry * shares[j];
    }
    good = good && pivot > 0.0;
    const double inverse = 1.0 / std::sqrt(pivot);
    l[i * largest_anderson_window + i] = inverse; // reciprocals of the diagonal
    shares[i] = right * inverse;
  }
  for (Index i = count - 1; i >= 0; --i)
  {
    for (Index k = i + 1; k < count; ++k)
    {
      shares[i] -= l[k * largest_anderson_window + i] * shares[k];
    }
    shares[i] *= l[i * largest_anderson_window + i];
  }
  for (Index i = 0; i < count; ++i)
  {
    shares[i] *= scale[i];
    good = good && std::isfinite(shares[i]);
  }
  return good;
}

template <typename Scalar>
bool Anderson<Scalar>::next(const Scalar* g, Scalar* x)
{
  if (this->window_ == 0)
  {
    return false;
  }
  if (this->count_++ == 0)
  {
    std::copy_n(g, this->length_, this->last_g_.begin());
    for (Index i = 0; i < this->size_; ++i)
    {
      this->last_f_[i] = g[i] - x[i];
    }
    return false;
  }
  const Index at = (this->count_ - 2) % this->window_;
  const Index filled = std::min(this->count_ - 1, this->window_);
  Scalar* const change = this->changes_f_.data() + at * this->size_;
  take_change(this->length_, g, this->last_g_.data(), this->changes_g_.data() + at * this->length_);
  take_residual_change(this->size_, g, x, this->last_f_.data(), change);
  for (Index i = 0; i < filled; ++i)
  {
    const double product = this->dot_(change, this->changes_f_.data() + i * this->size_);
    this->products_(at, i) = this->products_(i, at) = product;
    this->right_[i] += product;
  }
  this->right_[at] = this->dot_(change, this->last_f_.data());

  std::array<double, largest_anderson_window> shares;
  if (!this->solve(filled, shares))
  {
    return false;
  }
  this->reach_ = 0.0;
  for (Index i = 0; i < filled; ++i)
  {
    this->reach_ += std::abs(shares[i]);
  }
  extrapolate(this->length_, filled, shares.data(), g, this->changes_g_.data(), x);
  return true;
}

template class Anderson<float>;
template class Anderson<double>;

} // namespace bindpose
