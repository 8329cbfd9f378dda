// The alternation of local and global steps, in single or double precision (notation:
// reduced_solver.cpp).
//
// Y and S are computed in one pass over C. C is read in groups of four columns that fit into the
// first-level cache. The product of a group with Q gives four rows of Y. Then the product of the
// group with these rows is added to S. An iterate consists of both Y and S, and both are
// extrapolated with the same coefficients. Therefore an extrapolated iterate usually needs no
// product with C. If the coefficients are so large that the extrapolated S would be mostly
// round-off, S is computed by a product with C instead.
//
// Let E* be the terms that do not depend on Q. The energies are
//
//     after a local step   E* + 1/2 |Y|^2 - <Q, S>,
//     after a global step  E* - 1/2 |Y|^2 - <Q, S*>.
//
// In single precision both energies have an error of about a millionth of |Y|^2 and <Q, S*>.
// Smaller changes of the energy are not significant.
#include "arap/reduced_iteration.h"

#include "base/packs.h"
#include "pose/rotation_fit.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
/// Round-off of an energy, as a fraction of the sum of the absolute values of its terms.
template <typename Scalar>
constexpr double energy_noise = sizeof(Scalar) == 4 ? 2e-7 : 0.0;

/// Largest sum of absolute coefficients (Anderson::coefficient_sum()) for which the extrapolated S
/// is accurate enough.
template <typename Scalar>
constexpr double maximum_coefficient_sum = sizeof(Scalar) == 4 ? 3.0 : 1e4;

constexpr Index columns_at_once = 4;

/// Number of rows per tile; matrices are padded to whole tiles. A tile is one pack of AVX-512, two
/// of AVX2 or four of SSE.
template <typename Scalar>
constexpr Index tile_rows = 64 / sizeof(Scalar);

/// Compute y_j = A^T q_j for a few columns of A and j = 0, 1, 2.
template <Index count, int bytes, typename Scalar>
BINDPOSE_ALWAYS_INLINE void dot_columns(
  Index rows, const Scalar* a, const Scalar* q, Scalar* y, Index length)
{
  constexpr Index lanes = PackOf<Scalar, bytes>::lanes, packs = tile_rows<Scalar> / lanes;
  using Pack = typename PackOf<Scalar, bytes>::Pack;
  Pack sums[count][3][packs] = {};
  for (Index r = 0; r < rows; r += tile_rows<Scalar>)
  {
    for (Index p = 0; p < packs; ++p)
    {
      const Scalar* const from = q + r + p * lanes;
      const Pack q0 = pack_at<bytes>(from), q1 = pack_at<bytes>(from + rows),
                 q2 = pack_at<bytes>(from + 2 * rows);
      for (Index c = 0; c < count; ++c)
      {
        const Pack entry = pack_at<bytes>(a + c * rows + r + p * lanes);
        sums[c][0][p] += entry * q0;
        sums[c][1][p] += entry * q1;
        sums[c][2][p] += entry * q2;
      }
    }
  }
  for (Index c = 0; c < count; ++c)
  {
    for (Index j = 0; j < 3; ++j)
    {
      const Scalar* const sum = reinterpret_cast<const Scalar*>(sums[c][j]);
      y[j * length + c] = sum_lanes(pack_at(sum) + pack_at(sum + tile_rows<Scalar> / 2));
    }
  }
}

/// Compute Y = C^T Q and S = S* + C Y.
template <int bytes, typename Scalar>
BINDPOSE_ALWAYS_INLINE void multiply_both(Index rows, Index columns, const Scalar* covariance,
  const Scalar* q, const Scalar* unrotated_covariance, Scalar* y, Index length, Scalar* s)
{
  constexpr Index count = bytes / 16; // the sums of `count` columns need twelve registers
  std::copy_n(unrotated_covariance, 3 * rows, s);
  for (Index c = 0; c < columns; c += columns_at_once)
  {
    const Scalar* const a = covariance + c * rows;
    for (Index i = 0; i < columns_at_once; i += count)
    {
      dot_columns<count, bytes>(rows, a + i * rows, q, y + c + i, length);
    }
    add_columns<columns_at_once, bytes>(rows, a, y + c, length, s);
  }
}

/// Compute S = S* + C Y.
template <int bytes, typename Scalar>
BINDPOSE_ALWAYS_INLINE void multiply_once(Index rows, Index columns, const Scalar* covariance,
  const Scalar* unrotated_covariance, const Scalar* y, Index length, Scalar* s)
{
  std::copy_n(unrotated_covariance, 3 * rows, s);
  for (Index c = 0; c < columns; c += columns_at_once)
  {
    add_columns<columns_at_once, bytes>(rows, covariance + c * rows, y + c, length, s);
  }
}

#define BINDPOSE_PRODUCTS(version, bytes, Scalar)                                             \
  version void products(Index rows, Index columns, const Scalar* covariance, const Scalar* q, \
    const Scalar* unrotated_covariance, Scalar* y, Index length, Scalar* s)                   \
  {                                                                                           \
    multiply_both<bytes>(rows, columns, covariance, q, unrotated_covariance, y, length, s);   \
  }                                                                                           \
  version void product(Index rows, Index columns, const Scalar* covariance,                   \
    const Scalar* unrotated_covariance, const Scalar* y, Index length, Scalar* s)             \
  {                                                                                           \
    multiply_once<bytes>(rows, columns, covariance, unrotated_covariance, y, length, s);      \
  }
BINDPOSE_SIMD_WIDTHS(BINDPOSE_PRODUCTS, float)
BINDPOSE_SIMD_WIDTHS(BINDPOSE_PRODUCTS, double)
#undef BINDPOSE_PRODUCTS

Index padded(Index count, Index to)
{
  return (count + to - 1) / to * to;
}
} // namespace

template <typename Scalar>
void ReducedIteration<Scalar>::set_size(Index clusters, Index columns)
{
  constexpr Index tile = tile_rows<Scalar>;
  this->clusters_ = clusters;
  this->columns_ = columns;
  this->rows_ = padded(3 * clusters, tile);
  this->anderson_.reset();
  this->length_ = padded(columns, tile);
  // Only the padding is set to zero. Zeroing the whole matrix would take a large part of the time
  // of a change of modes.
  this->covariance_.resize(
    static_cast<std::size_t>(this->rows_ * padded(columns, columns_at_once)));
  Scalar* to = this->covariance_.data() + 3 * clusters;
  for (Index c = 0; c < columns; ++c, to += this->rows_)
  {
    std::fill_n(to, this->rows_ - 3 * clusters, Scalar(0));
  }
  std::fill(this->covariance_.begin() + static_cast<std::ptrdiff_t>(this->rows_ * columns),
    this->covariance_.end(), Scalar(0));
  const auto size = static_cast<std::size_t>(3 * this->rows_);
  this->unrotated_covariance_.assign(size, Scalar(0));
  this->rotation_deltas_.assign(size, Scalar(0));
  this->iterate_.assign(size + static_cast<std::size_t>(3 * this->length_), Scalar(0));
}

template <typename Scalar>
typename ReducedIteration<Scalar>::Columns ReducedIteration<Scalar>::matrix(
  Index clusters, Index columns)
{
  this->set_size(clusters, columns);
  this->unit_ = 1.0;
  return { this->covariance_.data(), 3 * clusters, columns, Eigen::OuterStride<>(this->rows_) };
}

template <typename Scalar>
template <typename Other>
void ReducedIteration<Scalar>::set_matrix(const ReducedIteration<Other>& from, double unit)
{
  this->set_size(from.clusters_, from.columns_);
  this->unit_ = unit;
  const double factor = from.unit_ / unit;
  for (Index c = 0; c < this->columns_; ++c)
  {
    const Other* const column = from.covariance_.data() + c * from.rows_;
    Scalar* const to = this->covariance_.data() + c * this->rows_;
    for (Index r = 0; r < 3 * this->clusters_; ++r)
    {
      to[r] = static_cast<Scalar>(factor * column[r]);
    }
  }
}

template <typename Scalar>
void ReducedIteration<Scalar>::set_unrotated_covariance(
  Index stride, const std::vector<double>& unrotated_covariance)
{
  const double scale = 1.0 / (this->unit_ * this->unit_);
  for (Index e = 0; e < 9; ++e)
  {
    const double* const from = unrotated_covariance.data() + e * stride;
    Scalar* const to =
      this->unrotated_covariance_.data() + e % 3 * this->rows_ + e / 3 * this->clusters_;
    for (Index k = 0; k < this->clusters_; ++k)
    {
      to[k] = static_cast<Scalar>(scale * from[k]);
    }
  }
}

template <typename Scalar>
void ReducedIteration<Scalar>::begin(Index stride, const std::vector<double>& unrotated_covariance,
  const std::vector<double>& rotations)
{
  this->set_unrotated_covariance(stride, unrotated_covariance);
  for (Index e = 0; e < 9; ++e)
  {
    const double rest = e % 4 == 0 ? 1.0 : 0.0;
    const double* const from = rotations.data() + e * stride;
    Scalar* const to =
      this->rotation_deltas_.data() + e / 3 * this->rows_ + e % 3 * this->clusters_;
    for (Index k = 0; k < this->clusters_; ++k)
    {
      to[k] = static_cast<Scalar>(from[k] - rest);
    }
  }
  this->has_iterate_ = false;
}

template <typename Scalar>
template <typename Other>
void ReducedIteration<Scalar>::continue_from(const ReducedIteration<Other>& from)
{
  const double y_unit = from.unit_ / this->unit_, s_unit = y_unit * y_unit;
  for (Index j = 0; j < 3; ++j)
  {
    const Other* const y = from.iterate_.data() + j * from.length_;
    for (Index c = 0; c < this->columns_; ++c)
    {
      this->iterate_[static_cast<std::size_t>(j * this->length_ + c)] =
        static_cast<Scalar>(y_unit * y[c]);
    }
    const Other* const s = from.iterate_.data() + 3 * from.length_ + j * from.rows_;
    Scalar* const to = this->iterate_.data() + 3 * this->length_ + j * this->rows_;
    for (Index k = 0; k < 3 * this->clusters_; ++k)
    {
      to[k] = static_cast<Scalar>(s_unit * s[k]);
    }
  }
  this->has_iterate_ = true;
}

template <typename Scalar>
double ReducedIteration<Scalar>::local_step(AlignedVector<Scalar>& iterate)
{
  const Scalar* const s = iterate.data() + 3 * this->length_;
  fit_rotation_deltas(this->clusters_,
    MatrixPlanes<const Scalar>{ s, this->clusters_, this->rows_ },
    MatrixPlanes<Scalar>{ this->rotation_deltas_.data(), this->rows_, this->clusters_ });
  return 0.5 * packed_dot(3 * this->length_, iterate.data(), iterate.data()) -
    packed_dot(3 * this->rows_, this->rotation_deltas_.data(), s);
}

template <typename Scalar>
double ReducedIteration<Scalar>::global_step(AlignedVector<Scalar>& iterate)
{
  products(this->rows_, this->columns_, this->covariance_.data(), this->rotation_deltas_.data(),
    this->unrotated_covariance_.data(), iterate.data(), this->length_,
    iterate.data() + 3 * this->length_);
  const double half_square = 0.5 * packed_dot(3 * this->length_, iterate.data(), iterate.data());
  const double linear_term =
    packed_dot(3 * this->rows_, this->rotation_deltas_.data(), this->unrotated_covariance_.data());
  this->magnitude_ = half_square + std::abs(linear_term);
  return -half_square - linear_term;
}

template <typename Scalar>
bool ReducedIteration<Scalar>::run(ExecutionContext& context, const ReducedLimits& limits,
  Index window, double unrotated_energy, ReducedProgress& progress)
{
  const double unit = this->unit_ * this->unit_;
  std::vector<double>& energies = progress.energies;
  const std::size_t first = energies.size();
  if (!this->has_iterate_)
  {
    energies.push_back(unrotated_energy + unit * this->global_step(this->iterate_));
  }
  // If there is only one iteration, the usual case in double precision, there is no previous
  // iterate for the extrapolation.
  const bool accelerates = window > 0 && limits.iterations > 1;
  if (accelerates && (!this->anderson_ || this->anderson_->window() != window))
  {
    this->anderson_.emplace(window, 3 * this->length_, 3 * this->rows_,
      [size = 3 * this->length_](const Scalar* a, const Scalar* b)
      { return packed_dot(size, a, b); });
  }
  if (accelerates)
  {
    this->anderson_->clear_history();
    this->trial_ = this->iterate_;
  }
  bool above_noise = true;
  Index iterations = 0;
  progress.converged = false;
  while (iterations < limits.iterations && !progress.converged && progress.within_deadline &&
    above_noise)
  {
    if (iterations % 64 == 63 && context.canceled())
    {
      progress.canceled = true;
      break;
    }
    bool accelerated = accelerates && iterations > 0 &&
      this->anderson_->next(this->iterate_.data(), this->trial_.data());
    if (accelerated && this->anderson_->coefficient_sum() > maximum_coefficient_sum<Scalar>)
    {
      product(this->rows_, this->columns_, this->covariance_.data(),
        this->unrotated_covariance_.data(), this->trial_.data(), this->length_,
        this->trial_.data() + 3 * this->length_);
    }
    const double energy_before = energies.back();
    const double noise = energy_noise<Scalar> * unit * this->magnitude_;
    double energy =
      unrotated_energy + unit * this->local_step(accelerated ? this->trial_ : this->iterate_);
    if (accelerated && !(energy <= energy_before + limits.energy_tolerance))
    {
      this->anderson_->clear_history();
      energy = unrotated_energy + unit * this->local_step(this->iterate_);
      accelerated = false;
    }
    energies.push_back(energy);
    if (!accelerated && accelerates)
    {
      this->trial_ = this->iterate_;
    }
    energy = unrotated_energy + unit * this->global_step(this->iterate_);
    energies.push_back(energy);
    ++iterations;
    if (!std::isfinite(energy))
    {
      energies.resize(first);
      return false;
    }
    // After a change of precision, the first energy cannot be compared with the energy before it.
    if (iterations > 1 || !this->has_iterate_)
    {
      progress.change = energy_before - energy;
      above_noise = noise == 0.0 || progress.change > noise;
      progress.converged = limits.tolerance > 0.0 && above_noise &&
        progress.change <= limits.tolerance * std::max(energy, limits.minimum_energy);
    }
    // Reading the clock takes about as much time as fitting several rotations. Therefore the clock
    // is read only if there is a deadline.
    progress.within_deadline = limits.deadline == limits.deadline.max() ||
      std::chrono::steady_clock::now() < limits.deadline;
  }
  progress.iterations += iterations;
  return true;
}

template <typename Scalar>
void ReducedIteration<Scalar>::rotations(Index stride, std::vector<double>& planes) const
{
  for (Index e = 0; e < 9; ++e)
  {
    const double rest = e % 4 == 0 ? 1.0 : 0.0;
    const Scalar* const from =
      this->rotation_deltas_.data() + e / 3 * this->rows_ + e % 3 * this->clusters_;
    double* const to = planes.data() + e * stride;
    for (Index k = 0; k < this->clusters_; ++k)
    {
      to[k] = from[k] + rest;
    }
  }
}

template <typename Scalar>
Coordinates ReducedIteration<Scalar>::coordinates() const
{
  return this->unit_ *
    Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, 3>, 0, Eigen::OuterStride<>>(
      this->iterate_.data(), this->columns_, 3, Eigen::OuterStride<>(this->length_))
      .template cast<double>();
}

template class ReducedIteration<float>;
template class ReducedIteration<double>;
template void ReducedIteration<float>::set_matrix(const ReducedIteration<double>&, double);
template void ReducedIteration<double>::continue_from(const ReducedIteration<float>&);

} // namespace bindpose
