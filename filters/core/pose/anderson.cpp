// Changes of g and of the residual f = g - x lie in rings, a row each. The normal equations are
// kept up to date: a new change adds a row of products, and a product with the residual itself
// follows from its change, so that a step needs one inner product for each row and one more.
#include "pose/anderson.h"

#include "base/simd.h"

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
    this->factor_.resize(largest_window * this->window_);
  }
}

/// The normal equations by Cholesky's method, in place. By hand, because a solve takes thousands of
/// these five by five, and a library's call for any size costs more than an iteration's products.
bool Anderson::solve(Index count, std::array<double, largest_window>& shares)
{
  double* const l = this->factor_.data();
  std::array<double, largest_window> scale;
  bool good = true;
  for (Index i = 0; i < count; ++i)
  {
    const double square = this->products_(i, i);
    scale[i] = square > 0.0 ? 1.0 / std::sqrt(square) : 0.0;
    double right = scale[i] * this->right_[i];
    double pivot = 1.0 + ridge;
    for (Index j = 0; j < i; ++j)
    {
      double entry = scale[i] * scale[j] * this->products_(i, j);
      for (Index k = 0; k < j; ++k)
      {
        entry -= l[i * largest_window + k] * l[j * largest_window + k];
      }
      entry *= l[j * largest_window + j];
      l[i * largest_window + j] = entry;
      pivot -= entry * entry;
      right -= entry * shares[j];
    }
    good = good && pivot > 0.0;
    const double inverse = 1.0 / std::sqrt(pivot);
    l[i * largest_window + i] = inverse; // the diagonal's reciprocals
    shares[i] = right * inverse;
  }
  for (Index i = count - 1; i >= 0; --i)
  {
    for (Index k = i + 1; k < count; ++k)
    {
      shares[i] -= l[k * largest_window + i] * shares[k];
    }
    shares[i] *= l[i * largest_window + i];
  }
  for (Index i = 0; i < count; ++i)
  {
    shares[i] *= scale[i];
    good = good && std::isfinite(shares[i]);
  }
  return good;
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

  std::array<double, largest_window> shares;
  if (!this->solve(filled, shares))
  {
    return false;
  }
  extrapolate(this->length_, filled, shares.data(), g, this->changes_g_.data(), x);
  return true;
}

} // namespace bindpose
