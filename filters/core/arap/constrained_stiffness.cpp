// Solution of a stiffness system L x = force in which x is prescribed at some vertices and at some
// other points of the mesh ("constrained points").
//
// Prescribed vertices are eliminated from the system. A connected part of the mesh without a
// prescribed vertex would make the system singular. Therefore x is set to 0 at one vertex of such a
// part, and an additional unknown shift t translates the part. This is exact because the forces
// within a part sum to zero. The constraints A x = b of the constrained points then lead to a small
// dense system for their Lagrange multipliers m and the shifts t:
//
//     A L^-1 A^T m - A 1 t = A L^-1 force - b,    (A 1)^T m = 0.
//
// The matrix 1 has one column per part without a prescribed vertex, with ones at the vertices of
// the part. The second equation states that the multipliers' forces sum to zero in each part. A
// pivoted QR decomposition of A first selects linearly independent points, so that the small system
// is regular.
#include "arap/constrained_stiffness.h"

#include <Eigen/QR>

#include <cmath>

namespace bindpose
{

namespace
{
/// A constrained point is redundant if its pivot in the QR decomposition is below this fraction of
/// the largest pivot.
constexpr double rank_tolerance = 1e-9;
} // namespace

Status ConstrainedStiffness::prepare(const SparseMatrix& stiffness,
  const std::vector<Index>& part_of_vertex, Index part_count, std::vector<Index> prescribed,
  std::vector<MeshPoint> constrained)
{
  *this = ConstrainedStiffness();
  this->prescribed_ = std::move(prescribed);
  this->constrained_ = std::move(constrained);
  const Index n = stiffness.rows();
  std::vector<char> is_prescribed(static_cast<std::size_t>(n), 0),
    part_is_prescribed(part_count, 0);
  std::vector<int> column_of(static_cast<std::size_t>(n), -1);
  for (std::size_t i = 0; i < this->prescribed_.size(); ++i)
  {
    const Index v = this->prescribed_[i];
    is_prescribed[v] = 1;
    column_of[v] = static_cast<int>(i);
    if (part_of_vertex[v] >= 0)
    {
      part_is_prescribed[part_of_vertex[v]] = 1;
    }
  }
  std::vector<Index> floating_index(static_cast<std::size_t>(part_count), -1);
  this->floating_part_.assign(static_cast<std::size_t>(n), -1);
  this->unknown_index_.assign(static_cast<std::size_t>(n), -1);
  for (Index v = 0; v < n; ++v)
  {
    const Index part = part_of_vertex[v];
    if (part < 0 || is_prescribed[v])
    {
      continue;
    }
    bool grounded = false;
    if (!part_is_prescribed[part])
    {
      grounded = floating_index[part] < 0;
      if (grounded)
      {
        floating_index[part] = static_cast<Index>(this->floating_part_sizes_.size());
        this->floating_part_sizes_.push_back(0.0);
      }
      this->floating_part_[v] = floating_index[part];
      this->floating_part_sizes_[floating_index[part]] += 1.0;
    }
    if (!grounded)
    {
      this->unknown_index_[v] = static_cast<Index>(this->unknowns_.size());
      this->unknowns_.push_back(v);
    }
  }

  const auto size = static_cast<Index>(this->unknowns_.size());
  std::vector<Eigen::Triplet<double, int>> inner, border;
  double trace = 0.0;
  for (const Index v : this->unknowns_)
  {
    const int column = static_cast<int>(this->unknown_index_[v]);
    for (SparseMatrix::InnerIterator it(stiffness, v); it; ++it)
    {
      const Index row = this->unknown_index_[it.row()];
      if (row >= 0)
      {
        inner.emplace_back(static_cast<int>(row), column, it.value());
        trace += row == column ? it.value() : 0.0;
      }
      else if (column_of[it.row()] >= 0)
      {
        border.emplace_back(column, column_of[it.row()], it.value());
      }
    }
  }
  this->border_.resize(size, static_cast<Index>(this->prescribed_.size()));
  this->border_.setFromTriplets(border.begin(), border.end());
  if (size > 0)
  {
    SparseMatrix matrix(size, size);
    matrix.setFromTriplets(inner.begin(), inner.end());
    Status status = this->solver_.analyze(matrix);
    if (status.ok())
    {
      status = this->solver_.factor(matrix);
    }
    if (!status.ok())
    {
      status.message = "the stiffness matrix of the mesh cannot be factored, perhaps because "
                       "elements are too thin: " +
        status.message;
      return status;
    }
  }
  this->choose_independent(is_prescribed);
  this->factor_constraints(size > 0 && trace > 0.0 ? trace / static_cast<double>(size) : 1.0);
  return {};
}

/// Scale the constraint matrix's rows (one per constrained point) and select independent rows. Then
/// compute the matrix that maps the targets of all constrained points to the targets of the
/// selected points.
void ConstrainedStiffness::choose_independent(const std::vector<char>& is_prescribed)
{
  const auto count = static_cast<Index>(this->constrained_.size());
  std::vector<Index> used, column(is_prescribed.size(), -1);
  for (const MeshPoint& point : this->constrained_)
  {
    double square = 0.0;
    for (const auto& [v, coordinate] : point)
    {
      if (is_prescribed[v])
      {
        continue;
      }
      square += coordinate * coordinate;
      if (column[v] < 0)
      {
        column[v] = static_cast<Index>(used.size());
        used.push_back(v);
      }
    }
    this->scale_.push_back(square > 0.0 ? 1.0 / std::sqrt(square) : 0.0);
  }
  if (used.empty())
  {
    for (Index i = 0; i < count; ++i)
    {
      this->redundant_.push_back(i);
    }
    this->least_squares_.resize(0, count);
    return;
  }
  Eigen::MatrixXd transposed = Eigen::MatrixXd::Zero(static_cast<Index>(used.size()), count);
  for (Index i = 0; i < count; ++i)
  {
    for (const auto& [v, coordinate] : this->constrained_[i])
    {
      if (!is_prescribed[v])
      {
        transposed(column[v], i) += this->scale_[i] * coordinate;
      }
    }
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(transposed);
  qr.setThreshold(rank_tolerance);
  const Index rank = qr.rank();
  for (Index i = 0; i < count; ++i)
  {
    (i < rank ? this->independent_ : this->redundant_).push_back(qr.colsPermutation().indices()[i]);
  }
  // Each row of the constraint matrix is a linear combination of the selected rows. Targets that
  // contradict these combinations are satisfied in the least-squares sense.
  const Eigen::MatrixXd r = qr.matrixR().topRows(rank);
  Eigen::MatrixXd combination = Eigen::MatrixXd::Identity(count, rank);
  if (rank < count)
  {
    combination.bottomRows(count - rank) =
      r.leftCols(rank).triangularView<Eigen::Upper>().solve(r.rightCols(count - rank)).transpose();
  }
  const Eigen::MatrixXd inverse =
    combination.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(count, count));
  this->least_squares_.resize(rank, count);
  for (Index i = 0; i < count; ++i)
  {
    this->least_squares_.col(qr.colsPermutation().indices()[i]) = inverse.col(i);
  }
}

void ConstrainedStiffness::factor_constraints(double unit)
{
  const auto independent_count = static_cast<Index>(this->independent_.size());
  this->shift_index_.assign(this->floating_part_sizes_.size(), -1);
  Index shifts = 0;
  Eigen::MatrixXd right =
    Eigen::MatrixXd::Zero(static_cast<Index>(this->unknowns_.size()), independent_count);
  Eigen::MatrixXd sums =
    Eigen::MatrixXd::Zero(independent_count, static_cast<Index>(this->floating_part_sizes_.size()));
  for (Index i = 0; i < independent_count; ++i)
  {
    const Index point = this->independent_[i];
    for (const auto& [v, coordinate] : this->constrained_[point])
    {
      if (this->unknown_index_[v] >= 0)
      {
        right(this->unknown_index_[v], i) += this->scale_[point] * coordinate;
      }
      const Index part = this->floating_part_[v];
      if (part >= 0)
      {
        sums(i, part) += this->scale_[point] * coordinate;
        this->shift_index_[part] =
          this->shift_index_[part] < 0 ? shifts++ : this->shift_index_[part];
      }
    }
  }
  if (independent_count == 0)
  {
    return;
  }
  // Replace the stiffness L by L / unit, whose mean diagonal entry is 1. The inverse of L / unit is
  // unit * L^-1.
  this->response_ = this->unknowns_.empty() ? right : Eigen::MatrixXd(this->solver_.solve(right));
  this->response_ *= unit;
  Eigen::MatrixXd& small = this->constraint_system_;
  small = Eigen::MatrixXd::Zero(independent_count + shifts, independent_count + shifts);
  small.topLeftCorner(independent_count, independent_count) = right.transpose() * this->response_;
  for (std::size_t part = 0; part < this->shift_index_.size(); ++part)
  {
    if (this->shift_index_[part] >= 0)
    {
      small.col(independent_count + this->shift_index_[part]).head(independent_count) =
        -sums.col(static_cast<Index>(part));
      small.row(independent_count + this->shift_index_[part]).head(independent_count) =
        -sums.col(static_cast<Index>(part)).transpose();
    }
  }
  this->multipliers_ =
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(small).pseudoInverse();
}

void ConstrainedStiffness::solve(
  const Rows& force, const Rows& prescribed, const Rows& constrained, Rows& x) const
{
  const Index n = force.rows(), columns = force.cols();
  const auto size = static_cast<Index>(this->unknowns_.size());
  Eigen::MatrixXd right(size, columns);
  for (Index i = 0; i < size; ++i)
  {
    right.row(i) = force.row(this->unknowns_[i]);
  }
  x.setZero(n, columns);
  if (!this->prescribed_.empty())
  {
    right -= this->border_ * prescribed;
    for (std::size_t i = 0; i < this->prescribed_.size(); ++i)
    {
      x.row(this->prescribed_[i]) = prescribed.row(static_cast<Index>(i));
    }
  }
  Eigen::MatrixXd inner = size > 0 ? this->solver_.solve(right) : right;

  const auto independent_count = static_cast<Index>(this->independent_.size());
  Eigen::MatrixXd shifts =
    Eigen::MatrixXd::Zero(static_cast<Index>(this->shift_index_.size()), columns);
  if (independent_count > 0)
  {
    const auto count = static_cast<Index>(this->constrained_.size());
    Eigen::MatrixXd target(count, columns);
    for (Index i = 0; i < count; ++i)
    {
      target.row(i) = constrained.row(i);
      for (const auto& [v, coordinate] : this->constrained_[i])
      {
        target.row(i) -= coordinate * x.row(v); // x is 0 except at prescribed vertices
      }
      target.row(i) *= this->scale_[i];
    }
    Eigen::MatrixXd small = Eigen::MatrixXd::Zero(this->multipliers_.rows(), columns);
    small.topRows(independent_count) = -this->least_squares_ * target;
    for (Index i = 0; i < independent_count; ++i)
    {
      const Index point = this->independent_[i];
      for (const auto& [v, coordinate] : this->constrained_[point])
      {
        if (this->unknown_index_[v] >= 0)
        {
          small.row(i) += this->scale_[point] * coordinate * inner.row(this->unknown_index_[v]);
        }
      }
    }
    // One step of iterative refinement. If constrained points are close to each other, the inverse
    // has few correct digits. The resulting violation of a constraint could lower the energy, so
    // the caller could mistake the violation for an improvement.
    Eigen::MatrixXd answer = this->multipliers_ * small;
    answer += this->multipliers_ * (small - this->constraint_system_ * answer);
    inner.noalias() -= this->response_ * answer.topRows(independent_count);
    for (std::size_t part = 0; part < this->shift_index_.size(); ++part)
    {
      if (this->shift_index_[part] >= 0)
      {
        shifts.row(static_cast<Index>(part)) =
          answer.row(independent_count + this->shift_index_[part]);
      }
    }
  }
  for (Index i = 0; i < size; ++i)
  {
    x.row(this->unknowns_[i]) = inner.row(i);
    const Index part = this->floating_part_[this->unknowns_[i]];
    if (part >= 0 && this->shift_index_[part] < 0)
    {
      shifts.row(part) -= inner.row(i) / this->floating_part_sizes_[part];
    }
  }
  for (Index v = 0; v < n && !this->shift_index_.empty(); ++v)
  {
    if (this->floating_part_[v] >= 0)
    {
      x.row(v) += shifts.row(this->floating_part_[v]);
    }
  }
}

} // namespace bindpose
