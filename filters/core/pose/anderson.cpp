// Changes of g and of the residual f = g - x lie in rings, a row each. The normal equations are
// kept up to date: a new change adds a row of products, and a product with the residual itself
// follows from its change, so that a step needs one inner product for each row and one more.
#include "pose/anderson.h"

#include "base/simd.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
constexpr Index tile = 8;
typedef double Pack __attribute__((vector_size(tile * sizeof(double)), aligned(8), may_alias));

/// Of products scaled to ones on the diagonal: changes nearer to parallel than this share out
/// evenly instead of cancelling in large numbers.
constexpr double ridge = 1e-10;

/// change = now - last, last = now
BINDPOSE_SIMD_CLONES void take_change(
  Index count, const double* __restrict now, double* __restrict last, double* __restrict change)
{
  for (Index i = 0; i < count; ++i)
  {
    change[i] = now[i] - last[i];
    last[i] = now[i];
  }
}

/// The same for the residual g - x.
BINDPOSE_SIMD_CLONES void take_residual_change(Index count, const double* __restrict g,
  const double* __restrict x, double* __restrict last, double* __restrict change)
{
  for (Index i = 0; i < count; ++i)
  {
    const double now = g[i] - x[i];
    change[i] = now - last[i];
    last[i] = now;
  }
}

/// x = g - sum of shares times rows
BINDPOSE_SIMD_CLONES void extrapolate(Index count, Index rows, const double* shares,
  const double* __restrict g, const double* __restrict changes, double* __restrict x)
{
  Index i = 0;
  for (; i + 2 * tile <= count; i += 2 * tile)
  {
    Pack a = *reinterpret_cast<const Pack*>(g + i);
    Pack b = *reinterpret_cast<const Pack*>(g + i + tile);
    for (Index r = 0; r < rows; ++r)
    {
      a -= *reinterpret_cast<const Pack*>(changes + r * count + i) * shares[r];
      b -= *reinterpret_cast<const Pack*>(changes + r * count + i + tile) * shares[r];
    }
    *reinterpret_cast<Pack*>(x + i) = a;
    *reinterpret_cast<Pack*>(x + i + tile) = b;
  }
  for (; i < count; ++i)
  {
    double sum = g[i];
    for (Index r = 0; r < rows; ++r)
    {
      sum -= changes[r * count + i] * shares[r];
    }
    x[i] = sum;
  }
}
} // namespace

BINDPOSE_SIMD_CLONES double packed_dot(Index count, const double* a, const double* b)
{
  Pack first = {}, second = {};
  Index i = 0;
  for (; i + 2 * tile <= count; i += 2 * tile)
  {
    first += *reinterpret_cast<const Pack*>(a + i) * *reinterpret_cast<const Pack*>(b + i);
    second +=
      *reinterpret_cast<const Pack*>(a + i + tile) * *reinterpret_cast<const Pack*>(b + i + tile);
  }
  for (; i + tile <= count; i += tile)
  {
    first += *reinterpret_cast<const Pack*>(a + i) * *reinterpret_cast<const Pack*>(b + i);
  }
  first += second;
  double sum = ((first[0] + first[4]) + (first[2] + first[6])) +
    ((first[1] + first[5]) + (first[3] + first[7]));
  for (; i < count; ++i)
  {
    sum += a[i] * b[i];
  }
  return sum;
}

Anderson::Anderson(Index window, Index size, Index carried, Dot dot)
  : window_(std::clamp<Index>(window, 0, largest_window)), size_(size), length_(size + carried),
    dot_(std::move(dot)), products_(Eigen::MatrixXd::Zero(this->window_, this->window_)),
    right_(Eigen::VectorXd::Zero(this->window_))
{
  if (this->window_ > 0)
  {
    this->changes_g_.resize(this->window_ * this->length_);
    this->changes_f_.resize(this->window_ * this->size_);
    this->last_g_.resize(this->length_);
    this->last_f_.resize(this->size_);
  }
}

bool Anderson::next(const double* g, double* x)
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
  double* const change = this->changes_f_.data() + at * this->size_;
  take_change(this->length_, g, this->last_g_.data(), this->changes_g_.data() + at * this->length_);
  take_residual_change(this->size_, g, x, this->last_f_.data(), change);
  for (Index i = 0; i < filled; ++i)
  {
    const double product = this->dot_(change, this->changes_f_.data() + i * this->size_);
    this->products_(at, i) = this->products_(i, at) = product;
    this->right_[i] += product;
  }
  this->right_[at] = this->dot_(change, this->last_f_.data());

  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
    largest_window, largest_window>; // on the stack
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, largest_window, 1>;
  Vector scale(filled), shares(filled);
  Matrix matrix(filled, filled);
  for (Index i = 0; i < filled; ++i)
  {
    const double square = this->products_(i, i);
    scale[i] = square > 0.0 ? 1.0 / std::sqrt(square) : 0.0;
    shares[i] = scale[i] * this->right_[i];
    for (Index j = 0; j < i; ++j)
    {
      matrix(i, j) = scale[i] * scale[j] * this->products_(i, j);
    }
    matrix(i, i) = 1.0 + ridge;
  }
  Eigen::LLT<Eigen::Ref<Matrix>> factor(matrix);
  if (factor.info() != Eigen::Success)
  {
    return false;
  }
  factor.solveInPlace(shares);
  shares.array() *= scale.array();
  if (!shares.allFinite())
  {
    return false;
  }
  extrapolate(this->length_, filled, shares.data(), g, this->changes_g_.data(), x);
  return true;
}

} // namespace bindpose
