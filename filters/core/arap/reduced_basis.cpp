// Basis of the displacements that a choice of modes leaves undetermined, by a robust and a quick
// method (see ReducedBasis for the notation). H is the stiffness, K the covariance, and the rows of
// A are the constrained positions.
//
// Robust method. The constraints are A D = g. A pivoted QR decomposition of A^T detects redundant
// positions. The last columns Z of its orthogonal factor span the displacements that satisfy A D =
// 0. The basis is B = Z L^-T with L L^T = Z^T H Z. If L is ill-conditioned, B consists of scaled
// eigenvectors of nonzero energy instead.
//
// Quick method. H does not depend on the modes. It is factored once for all unknowns: L L^T = H, D
// = E z with E = L^-T, and the energy is |z|^2 / 2. A choice of modes then affects only its
// constraints G z = g. Here G = A E, and A has one more row for each unknown that a handle in mode
// full prescribes. The last columns Z of the orthogonal factor of G^T give B = E Z and C = (K E) Z.
// C is computed by applying reflections to K E.
//
// Unless H contains masses, a translation u of the whole shape has no energy: H u = 0 and K u = 0.
// In this case H is factored without one of the unknowns, and D = u t + E z with an additional
// unknown t. The constraints determine t: a reflection of the constraints removes t from all
// constraints except the first one. All other constraints then contain only z.
//
// If one of the following conditions does not hold, the quick method returns false and the robust
// method is used.
// - L is well-conditioned. Removing unknowns or adding constraints does not increase the condition
//   number. Therefore the robust method would not remove a direction.
// - The condition number of A A^T for the positions is at most 1e6, so that of A^T is at most 1000.
//   In a QR decomposition, each pivot is between the smallest and the largest singular value.
//   Therefore each pivot of the robust method would be at least 1/1000 of the first pivot, and no
//   position is redundant.
// - The triangular factor of G^T is well-conditioned, and the component of u in the constraints is
//   not small.
#include "arap/reduced_basis.h"

#include "linear/dense_product.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
/// A direction has no energy if its eigenvalue is below this fraction of the largest eigenvalue.
constexpr double energy_rank = 1e-12;
/// A constrained position is redundant if its pivot in the QR decomposition is below this fraction
/// of the largest QR pivot.
constexpr double position_rank = 1e-9;
/// The quick method requires that the reciprocal condition numbers of A A^T and of the triangular
/// factor of G^T are above this value.
constexpr double independence_tolerance = 1e-6;
/// The robust method is faster if #constraints * unknowns_per_constraint > #unknowns.
constexpr Index unknowns_per_constraint = 4;
/// Number of columns of a triangular matrix that are multiplied per block.
constexpr Index triangle_columns = 192;

double norm_of_rows(const Eigen::MatrixXd& m)
{
  return m.cwiseAbs().rowwise().sum().maxCoeff();
}
} // namespace

Reflections::Reflections(const Eigen::MatrixXd& packed, const Eigen::VectorXd& factors, Index rank)
  : v_(packed.leftCols(rank)), t_(Eigen::MatrixXd::Zero(rank, rank))
{
  this->v_.triangularView<Eigen::StrictlyUpper>().setZero();
  this->v_.diagonal().setOnes();
  const Eigen::MatrixXd products = dense_product(this->v_.transpose(), this->v_);
  for (Index k = 0; k < rank; ++k)
  {
    const double factor = factors[k];
    this->t_(k, k) = factor;
    this->t_.col(k).head(k) = this->t_.topLeftCorner(k, k).triangularView<Eigen::Upper>() *
      (-factor * products.col(k).head(k));
  }
  this->tail_ = dense_product(this->t_, this->v_.bottomRows(this->v_.rows() - rank).transpose());
}

void Reflections::times_tail(const Eigen::MatrixXd& m, Eigen::Ref<Eigen::MatrixXd> product) const
{
  product = m.rightCols(this->tail_.cols());
  add_dense_product(-dense_product(m, this->v_), this->tail_, product);
}

Eigen::MatrixXd Reflections::times_tail(const Eigen::MatrixXd& m) const
{
  Eigen::MatrixXd product(m.rows(), this->tail_.cols());
  this->times_tail(m, product);
  return product;
}

Eigen::MatrixXd Reflections::tail() const
{
  Eigen::MatrixXd z = -dense_product(this->v_, this->tail_);
  z.bottomRows(this->tail_.cols()).diagonal().array() += 1.0;
  return z;
}

Coordinates Reflections::reflect(const Coordinates& x) const
{
  return x - thin_product(this->v_, thin_product(this->t_, transposed_thin_product(this->v_, x)));
}

Coordinates Reflections::reflect_transposed(const Coordinates& x) const
{
  return x -
    thin_product(this->v_, transposed_thin_product(this->t_, transposed_thin_product(this->v_, x)));
}

void ReducedBasis::make(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
  const std::vector<Index>& free_dofs, const Eigen::MatrixXd& position_rows)
{
  if (!this->make_fast(space, stiffness, free_dofs, position_rows))
  {
    this->make_robust(space, stiffness, free_dofs, position_rows);
  }
}

void ReducedBasis::factor_full_matrix(const ReducedSpace& space, const Eigen::MatrixXd& stiffness)
{
  FullFactorization& factorization = this->factorization_;
  factorization.tried = true;
  for (Index i = 0; i < stiffness.rows(); ++i)
  {
    if (space.basis_scale[i] > 0.0)
    {
      factorization.rows.push_back(i);
    }
  }
  // The translation u has equal entries in the translation rows of all handles and 0 in the rows of
  // extra weights, because the weights of the handles sum to one. The unknown that u changes most
  // is omitted.
  const auto handles = static_cast<Index>(space.handles.size());
  const auto shift_of = [&](Index i)
  { return i % 4 == 3 && i < 4 * handles ? 1.0 / space.basis_scale[i] : 0.0; };
  const auto largest = std::max_element(factorization.rows.begin(), factorization.rows.end(),
    [&](Index a, Index b) { return shift_of(a) < shift_of(b); });
  if (largest == factorization.rows.end() || shift_of(*largest) == 0.0)
  {
    return;
  }
  std::rotate(largest, largest + 1, factorization.rows.end());
  auto size = static_cast<Index>(factorization.rows.size());
  factorization.scale = space.basis_scale(factorization.rows);
  factorization.shift.resize(size);
  for (Index q = 0; q < size; ++q)
  {
    factorization.shift[q] = shift_of(factorization.rows[static_cast<std::size_t>(q)]);
  }
  factorization.shift.normalize();
  Eigen::MatrixXd h = factorization.scale.asDiagonal() *
    stiffness(factorization.rows, factorization.rows) * factorization.scale.asDiagonal();
  Eigen::MatrixXd k =
    space.covariance(Eigen::all, factorization.rows) * factorization.scale.asDiagonal();
  if ((h * factorization.shift).norm() > energy_rank * h.norm())
  {
    factorization.shift.resize(0);
  }
  else if ((k * factorization.shift).norm() > energy_rank * k.norm())
  {
    return;
  }
  else
  {
    size -= 1;
    h.conservativeResize(size, size);
    k.conservativeResize(Eigen::NoChange, size);
  }
  if (size == 0 || !factorization.cholesky.factor(std::move(h)) ||
    !(factorization.cholesky.reciprocal_condition() > 1e3 * energy_rank))
  {
    return;
  }
  factorization.directions = Eigen::MatrixXd::Identity(size, size);
  factorization.cholesky.solve_right(factorization.directions);
  factorization.covariance = std::move(k);
  factorization.cholesky.solve_right(factorization.covariance);
  factorization.good = true;
}

bool ReducedBasis::make_fast(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
  const std::vector<Index>& free_dofs, const Eigen::MatrixXd& position_rows)
{
  const Index all = stiffness.rows(), position_count = position_rows.rows();
  if (unknowns_per_constraint * (position_count + all - static_cast<Index>(free_dofs.size())) > all)
  {
    return false;
  }
  if (!this->factorization_.tried)
  {
    this->factor_full_matrix(space, stiffness);
  }
  const FullFactorization& factorization = this->factorization_;
  if (!factorization.good)
  {
    return false;
  }
  const Index unknowns = factorization.directions.rows();
  std::vector<char> is_open(static_cast<std::size_t>(all), 0);
  for (const Index i : free_dofs)
  {
    is_open[static_cast<std::size_t>(i)] = 1;
  }
  std::vector<Index> given_rows;
  this->free_indices_.clear();
  for (Index q = 0; q < static_cast<Index>(factorization.rows.size()); ++q)
  {
    (is_open[static_cast<std::size_t>(factorization.rows[static_cast<std::size_t>(q)])]
        ? this->free_indices_
        : given_rows)
      .push_back(q);
  }
  const auto count = position_count + static_cast<Index>(given_rows.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(count, static_cast<Index>(factorization.rows.size()));
  for (const Index q : this->free_indices_)
  {
    a.col(q).head(position_count) =
      factorization.scale[q] * position_rows.col(factorization.rows[static_cast<std::size_t>(q)]);
  }
  if (position_count > 0)
  {
    DenseCholesky positions;
    if (!positions.factor(
          dense_product(a.topRows(position_count), a.topRows(position_count).transpose())) ||
      !(positions.reciprocal_condition() > independence_tolerance))
    {
      return false;
    }
  }
  for (std::size_t i = 0; i < given_rows.size(); ++i)
  {
    a(position_count + static_cast<Index>(i), given_rows[i]) = 1.0;
  }

  // G = A E, and E is upper triangular.
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(count, unknowns);
  for (Index first = 0; first < unknowns; first += triangle_columns)
  {
    const Index columns = std::min(triangle_columns, unknowns - first), last = first + columns;
    add_dense_product(a.leftCols(last), factorization.directions.block(0, first, last, columns),
      g.middleCols(first, columns));
  }
  const bool shifts = factorization.shift.size() > 0;
  if (shifts)
  {
    this->householder_ = a * factorization.shift;
    const double length = this->householder_.norm();
    if (count == 0 || !(length > independence_tolerance * a.norm()))
    {
      return false;
    }
    this->rho_ = this->householder_[0] < 0.0 ? length : -length;
    this->householder_[0] -= this->rho_;
    this->householder_ *= std::sqrt(2.0) / this->householder_.norm();
    g -= this->householder_ * (this->householder_.transpose() * g).eval();
    this->shift_coupling_ = g.row(0);
  }
  const Index rank = count - (shifts ? 1 : 0);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(g.bottomRows(rank).transpose());
  const Eigen::MatrixXd r = qr.matrixQR().topRows(rank).triangularView<Eigen::Upper>();
  this->inverse_ = Eigen::MatrixXd::Identity(rank, rank);
  r.transpose().triangularView<Eigen::Lower>().solveInPlace(this->inverse_);
  if (rank > 0 &&
    !(independence_tolerance * norm_of_rows(r.transpose()) * norm_of_rows(this->inverse_) < 1.0))
  {
    return false;
  }
  this->reflections_ = Reflections(qr.matrixQR(), qr.hCoeffs(), rank);

  this->is_fast_ = true;
  this->coordinates_ = unknowns - rank;
  this->free_dofs_ = free_dofs;
  this->constraints_ = count;
  this->redundant_.clear();
  this->particular_.resize(0, 0);
  this->basis_.resize(0, 0);
  return true;
}

void ReducedBasis::make_robust(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
  const std::vector<Index>& free_dofs, const Eigen::MatrixXd& position_rows)
{
  this->is_fast_ = false;
  this->free_dofs_ = free_dofs;
  this->redundant_.clear();
  // Unknowns are scaled so that each column of M has root mean square one. An empty column has
  // scale 0.
  const auto size = static_cast<Index>(free_dofs.size()), position_count = position_rows.rows();
  const Eigen::VectorXd scale = space.basis_scale(free_dofs);
  Eigen::MatrixXd reduced =
    scale.asDiagonal() * stiffness(free_dofs, free_dofs) * scale.asDiagonal();
  Eigen::MatrixXd covariance = space.covariance(Eigen::all, free_dofs) * scale.asDiagonal();

  // The displacements that move the constrained positions by b are D = `particular_` b + Z y, with
  // `rows` Z = 0. The columns of Z (`free_space`) are the last columns of the orthogonal factor.
  this->particular_ = Eigen::MatrixXd::Zero(size, position_count);
  Eigen::MatrixXd free_space;
  Index rank = 0;
  if (position_count > 0 && size > 0)
  {
    const Eigen::MatrixXd rows = position_rows(Eigen::all, free_dofs) * scale.asDiagonal();
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(size, position_count);
    qr.setThreshold(position_rank);
    qr.compute(rows.transpose());
    rank = qr.rank();
    for (Index r = rank; r < position_count; ++r)
    {
      this->redundant_.push_back(qr.colsPermutation().indices()[r]);
    }
    if (rank > 0)
    {
      Eigen::MatrixXd range = Eigen::MatrixXd::Identity(size, rank);
      range.applyOnTheLeft(qr.householderQ());
      const Eigen::MatrixXd rows_in_range = rows * range; // this matrix has full column rank
      this->particular_ = range *
        rows_in_range.colPivHouseholderQr().solve(
          Eigen::MatrixXd::Identity(position_count, position_count));
      const Reflections reflections(qr.matrixQR(), qr.hCoeffs(), rank);
      free_space = reflections.tail();
      covariance = reflections.times_tail(covariance);
      // Z^T H Z = (H Z)^T Z, because H is symmetric.
      reduced = reflections.times_tail(reflections.times_tail(reduced).transpose());
    }
  }
  if (rank == 0)
  {
    free_space = Eigen::MatrixXd::Identity(size, size);
  }
  // B = Z L^-T, C = K B. Double precision is needed for C if directions are nearly parallel.
  this->basis_.resize(size, 0);
  if (reduced.rows() > 0)
  {
    DenseCholesky cholesky;
    if (cholesky.factor(reduced) && cholesky.reciprocal_condition() > 1e3 * energy_rank)
    {
      this->basis_ = std::move(free_space);
      cholesky.solve_right(this->basis_);
      cholesky.solve_right(covariance);
    }
    else
    {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(reduced);
      const double largest = std::max(eigen.eigenvalues().maxCoeff(), 0.0);
      // Eigenvalues are in ascending order, so directions with energy are the last ones.
      const Index mode_count = (eigen.eigenvalues().array() > energy_rank * largest).count();
      const Eigen::MatrixXd directions = eigen.eigenvectors().rightCols(mode_count) *
        eigen.eigenvalues().tail(mode_count).cwiseSqrt().cwiseInverse().asDiagonal();
      this->basis_ = dense_product(free_space, directions);
      covariance = dense_product(covariance, directions);
    }
  }
  this->particular_ = scale.asDiagonal() * this->particular_;
  this->basis_ = scale.asDiagonal() * this->basis_;
  this->covariance_ = std::move(covariance);
  this->coordinates_ = this->basis_.cols();
}

void ReducedBasis::extract_covariance(Eigen::Ref<Eigen::MatrixXd> covariance)
{
  if (this->is_fast_)
  {
    this->reflections_.times_tail(this->factorization_.covariance, covariance);
  }
  else
  {
    covariance = this->covariance_;
    this->covariance_.resize(0, 0);
  }
}

void ReducedBasis::add_free(const Coordinates& change, Coordinates& d) const
{
  for (Index r = 0; r < change.rows(); ++r)
  {
    d.row(this->free_dofs_[static_cast<std::size_t>(r)]) += change.row(r);
  }
}

ReducedBasis::UnrotatedMinimizer ReducedBasis::robust_unrotated_minimizer(const ReducedSpace& space,
  const Eigen::MatrixXd& stiffness, const Coordinates& load, const Coordinates& given_blocks,
  const Coordinates& position_residual) const
{
  // First compute a displacement that contains `given_blocks` and satisfies the constrained
  // positions. The load and the elastic force of this displacement cause a response: the
  // combination of columns of B that minimizes the energy. Then add the response.
  UnrotatedMinimizer result;
  result.base_displacement = given_blocks;
  Coordinates& minimizer = result.base_displacement;
  this->add_free(thin_product(this->particular_, position_residual), minimizer);
  const Coordinates elastic_force = thin_product(stiffness, minimizer);
  const Coordinates force = elastic_force - load;
  const Coordinates answer =
    transposed_thin_product(this->basis_, force(this->free_dofs_, Eigen::all));
  // The response lowers the energy by half the squared norm of its coordinates `answer`, because
  // B^T H B = I.
  result.energy = 0.5 * (minimizer.array() * elastic_force.array()).sum() -
    (minimizer.array() * load.array()).sum() - 0.5 * answer.squaredNorm();
  this->add_free(-thin_product(this->basis_, answer), minimizer);
  result.covariance = thin_product(space.covariance, minimizer);
  return result;
}

Eigen::RowVector3d ReducedBasis::shift_of(
  const Coordinates& z, const Eigen::RowVector3d& first) const
{
  return (first - this->shift_coupling_.transpose() * z) / this->rho_;
}

ReducedBasis::UnrotatedMinimizer ReducedBasis::unrotated_minimizer(const ReducedSpace& space,
  const Eigen::MatrixXd& stiffness, const Coordinates& load, const Coordinates& given_blocks,
  const Coordinates& position_residual) const
{
  if (!this->is_fast_)
  {
    return this->robust_unrotated_minimizer(
      space, stiffness, load, given_blocks, position_residual);
  }
  // z is Q times a vector with two parts. The first part satisfies the constraints; the second part
  // is the response to `given_blocks` and the load. The first part is orthogonal to the directions
  // of B, so it causes no response.
  const FullFactorization& factorization = this->factorization_;
  const Index unknowns = factorization.directions.rows(), rank = this->reflections_.rank();
  const bool shifts = rank < this->constraints_;
  UnrotatedMinimizer result;
  result.base_displacement = given_blocks;
  Coordinates right_side = Coordinates::Zero(this->constraints_, 3);
  right_side.topRows(position_residual.rows()) = position_residual;
  if (shifts)
  {
    right_side -= this->householder_ * (this->householder_.transpose() * right_side).eval();
    result.first = right_side.row(0);
  }
  result.z = Coordinates::Zero(unknowns, 3);
  result.z.topRows(rank) = thin_product(this->inverse_, right_side.bottomRows(rank));

  const bool is_given = !given_blocks.isZero(0.0);
  if (!is_given && load.isZero(0.0))
  {
    result.z = this->reflections_.reflect(result.z);
    result.energy = 0.5 * result.z.squaredNorm();
    result.covariance = thin_product(factorization.covariance, result.z);
    return result;
  }
  const Coordinates elastic_force = thin_product(stiffness, given_blocks);
  Coordinates force = Coordinates::Zero(static_cast<Index>(factorization.rows.size()), 3);
  for (const Index q : this->free_indices_)
  {
    const Index row = factorization.rows[static_cast<std::size_t>(q)];
    force.row(q) = factorization.scale[q] * (elastic_force.row(row) - load.row(row));
  }
  const Coordinates gradient =
    transposed_thin_product(factorization.directions, force.topRows(unknowns));
  Coordinates free_gradient = gradient;
  Eigen::RowVector3d shift_gradient = Eigen::RowVector3d::Zero();
  if (shifts)
  {
    shift_gradient = factorization.shift.transpose() * force;
    free_gradient -= this->shift_coupling_ * (shift_gradient / this->rho_);
  }
  const Index free_dofs = unknowns - rank;
  result.z.bottomRows(free_dofs) =
    -this->reflections_.reflect_transposed(free_gradient).bottomRows(free_dofs);
  result.z = this->reflections_.reflect(result.z);
  result.energy = 0.5 * (given_blocks.array() * elastic_force.array()).sum() -
    (given_blocks.array() * load.array()).sum() + (gradient.array() * result.z.array()).sum() +
    0.5 * result.z.squaredNorm();
  if (shifts)
  {
    result.energy += shift_gradient.dot(this->shift_of(result.z, result.first));
  }
  result.covariance = thin_product(factorization.covariance, result.z);
  if (is_given)
  {
    result.covariance += thin_product(space.covariance, given_blocks);
  }
  return result;
}

Coordinates ReducedBasis::displacement(const UnrotatedMinimizer& from, const Coordinates& y) const
{
  Coordinates d = from.base_displacement;
  if (!this->is_fast_)
  {
    this->add_free(thin_product(this->basis_, y), d);
    return d;
  }
  const FullFactorization& factorization = this->factorization_;
  Coordinates z = Coordinates::Zero(factorization.directions.rows(), 3);
  z.bottomRows(y.rows()) = y;
  z = from.z + this->reflections_.reflect(z);
  Coordinates in_units = Coordinates::Zero(static_cast<Index>(factorization.rows.size()), 3);
  in_units.topRows(z.rows()) = thin_product(factorization.directions, z);
  if (factorization.shift.size() > 0)
  {
    in_units += factorization.shift * this->shift_of(z, from.first);
  }
  for (const Index q : this->free_indices_)
  {
    d.row(factorization.rows[static_cast<std::size_t>(q)]) +=
      factorization.scale[q] * in_units.row(q);
  }
  return d;
}

} // namespace bindpose
