// Solution of a stiffness system with prescribed vertices ("given") and constrained mesh points
// ("held").
//
// Given vertices are eliminated from the system. A connected part of the mesh without a given
// vertex would make the system singular. Therefore one vertex of such a part is grounded (its x is
// 0), and an additional unknown shift t translates the part. This is exact because the forces
// within a part sum to zero. The constraints A x = b of the held points then lead to a small dense
// system for their Lagrange multipliers m and the shifts t:
//
//     A L^-1 A^T m - A 1 t = A L^-1 force - b,    (A 1)^T m = 0.
//
// The matrix 1 has one column per part without a given vertex, with ones at the vertices of the
// part. The second equation states that the multipliers' forces sum to zero in each part. A pivoted
// QR decomposition of A first selects linearly independent points, so that the small system is
// regular.
#include "arap/constrained_stiffness.h"

#include <Eigen/QR>

#include <cmath>

namespace bindpose
{

namespace
{
/// A held point is redundant if its pivot in the QR decomposition is below this fraction of the
/// largest pivot.
constexpr double held_rank = 1e-9;
} // namespace

Status ConstrainedStiffness::prepare(const SparseMatrix& stiffness,
  const std::vector<Index>& part_of_vertex, Index part_count, std::vector<Index> given,
  std::vector<MeshPoint> held)
{
  *this = ConstrainedStiffness();
  this->given_ = std::move(given);
  this->held_ = std::move(held);
  const Index n = stiffness.rows();
  std::vector<char> is_given(static_cast<std::size_t>(n), 0), has_given(part_count, 0);
  std::vector<int> column_of(static_cast<std::size_t>(n), -1);
  for (std::size_t i = 0; i < this->given_.size(); ++i)
  {
    const Index v = this->given_[i];
    is_given[v] = 1;
    column_of[v] = static_cast<int>(i);
    if (part_of_vertex[v] >= 0)
    {
      has_given[part_of_vertex[v]] = 1;
    }
  }
  std::vector<Index> number(static_cast<std::size_t>(part_count), -1);
  this->floating_.assign(static_cast<std::size_t>(n), -1);
  this->row_of_.assign(static_cast<std::size_t>(n), -1);
  for (Index v = 0; v < n; ++v)
  {
    const Index part = part_of_vertex[v];
    if (part < 0 || is_given[v])
    {
      continue;
    }
    bool grounded = false;
    if (!has_given[part])
    {
      grounded = number[part] < 0;
      if (grounded)
      {
        number[part] = static_cast<Index>(this->size_.size());
        this->size_.push_back(0.0);
      }
      this->floating_[v] = number[part];
      this->size_[number[part]] += 1.0;
    }
    if (!grounded)
    {
      this->row_of_[v] = static_cast<Index>(this->unknowns_.size());
      this->unknowns_.push_back(v);
    }
  }

  const auto size = static_cast<Index>(this->unknowns_.size());
  std::vector<Eigen::Triplet<double, int>> inner, border;
  double trace = 0.0;
  for (const Index v : this->unknowns_)
  {
    const int column = static_cast<int>(this->row_of_[v]);
    for (SparseMatrix::InnerIterator it(stiffness, v); it; ++it)
    {
      const Index row = this->row_of_[it.row()];
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
  this->border_.resize(size, static_cast<Index>(this->given_.size()));
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
  this->choose_independent(is_given);
  this->factor_held(size > 0 && trace > 0.0 ? trace / static_cast<double>(size) : 1.0);
  return {};
}

/// Scale the rows of the held points, select independent rows, and compute the matrix that maps the
/// targets of all held points to the targets of the selected points.
void ConstrainedStiffness::choose_independent(const std::vector<char>& is_given)
{
  const auto count = static_cast<Index>(this->held_.size());
  std::vector<Index> used, column(is_given.size(), -1);
  for (const MeshPoint& point : this->held_)
  {
    double square = 0.0;
    for (const auto& [v, share] : point)
    {
      if (is_given[v])
      {
        continue;
      }
      square += share * share;
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
    for (const auto& [v, share] : this->held_[i])
    {
      if (!is_given[v])
      {
        transposed(column[v], i) += this->scale_[i] * share;
      }
    }
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(transposed);
  qr.setThreshold(held_rank);
  const Index rank = qr.rank();
  for (Index i = 0; i < count; ++i)
  {
    (i < rank ? this->kept_ : this->redundant_).push_back(qr.colsPermutation().indices()[i]);
  }
  // All points are linear combinations of the kept points. Targets that contradict this dependence
  // are satisfied in the least-squares sense.
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

void ConstrainedStiffness::factor_held(double unit)
{
  const auto kept = static_cast<Index>(this->kept_.size());
  this->shift_.assign(this->size_.size(), -1);
  Index shifts = 0;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(static_cast<Index>(this->unknowns_.size()), kept);
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(kept, static_cast<Index>(this->size_.size()));
  for (Index i = 0; i < kept; ++i)
  {
    const Index point = this->kept_[i];
    for (const auto& [v, share] : this->held_[point])
    {
      if (this->row_of_[v] >= 0)
      {
        right(this->row_of_[v], i) += this->scale_[point] * share;
      }
      const Index part = this->floating_[v];
      if (part >= 0)
      {
        sums(i, part) += this->scale_[point] * share;
        this->shift_[part] = this->shift_[part] < 0 ? shifts++ : this->shift_[part];
      }
    }
  }
  if (kept == 0)
  {
    return;
  }
  // Scale the stiffness so that the mean of its diagonal entries is 1, by multiplying its inverse
  // by `unit`.
  this->response_ = this->unknowns_.empty() ? right : Eigen::MatrixXd(this->solver_.solve(right));
  this->response_ *= unit;
  Eigen::MatrixXd& small = this->held_system_;
  small = Eigen::MatrixXd::Zero(kept + shifts, kept + shifts);
  small.topLeftCorner(kept, kept) = right.transpose() * this->response_;
  for (std::size_t part = 0; part < this->shift_.size(); ++part)
  {
    if (this->shift_[part] >= 0)
    {
      small.col(kept + this->shift_[part]).head(kept) = -sums.col(static_cast<Index>(part));
      small.row(kept + this->shift_[part]).head(kept) =
        -sums.col(static_cast<Index>(part)).transpose();
    }
  }
  this->multipliers_ =
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(small).pseudoInverse();
}

void ConstrainedStiffness::solve(
  const Rows& force, const Rows& given, const Rows& held, Rows& x) const
{
  const Index n = force.rows(), columns = force.cols();
  const auto size = static_cast<Index>(this->unknowns_.size());
  Eigen::MatrixXd right(size, columns);
  for (Index i = 0; i < size; ++i)
  {
    right.row(i) = force.row(this->unknowns_[i]);
  }
  x.setZero(n, columns);
  if (!this->given_.empty())
  {
    right -= this->border_ * given;
    for (std::size_t i = 0; i < this->given_.size(); ++i)
    {
      x.row(this->given_[i]) = given.row(static_cast<Index>(i));
    }
  }
  Eigen::MatrixXd inner = size > 0 ? this->solver_.solve(right) : right;

  const auto kept = static_cast<Index>(this->kept_.size());
  Eigen::MatrixXd shifts = Eigen::MatrixXd::Zero(static_cast<Index>(this->shift_.size()), columns);
  if (kept > 0)
  {
    const auto count = static_cast<Index>(this->held_.size());
    Eigen::MatrixXd target(count, columns);
    for (Index i = 0; i < count; ++i)
    {
      target.row(i) = held.row(i);
      for (const auto& [v, share] : this->held_[i])
      {
        target.row(i) -= share * x.row(v); // x is 0 except at given vertices
      }
      target.row(i) *= this->scale_[i];
    }
    Eigen::MatrixXd small = Eigen::MatrixXd::Zero(this->multipliers_.rows(), columns);
    small.topRows(kept) = -this->least_squares_ * target;
    for (Index i = 0; i < kept; ++i)
    {
      const Index point = this->kept_[i];
      for (const auto& [v, share] : this->held_[point])
      {
        if (this->row_of_[v] >= 0)
        {
          small.row(i) += this->scale_[point] * share * inner.row(this->row_of_[v]);
        }
      }
    }
    // One step of iterative refinement. If held points are close to each other, the inverse has few
    // correct digits. The resulting violation of a constraint could lower the energy, so the caller
    // could mistake the violation for an improvement.
    Eigen::MatrixXd answer = this->multipliers_ * small;
    answer += this->multipliers_ * (small - this->held_system_ * answer);
    inner.noalias() -= this->response_ * answer.topRows(kept);
    for (std::size_t part = 0; part < this->shift_.size(); ++part)
    {
      if (this->shift_[part] >= 0)
      {
        shifts.row(static_cast<Index>(part)) = answer.row(kept + this->shift_[part]);
      }
    }
  }
  for (Index i = 0; i < size; ++i)
  {
    x.row(this->unknowns_[i]) = inner.row(i);
    const Index part = this->floating_[this->unknowns_[i]];
    if (part >= 0 && this->shift_[part] < 0)
    {
      shifts.row(part) -= inner.row(i) / this->size_[part];
    }
  }
  for (Index v = 0; v < n && !this->shift_.empty(); ++v)
  {
    if (this->floating_[v] >= 0)
    {
      x.row(v) += shifts.row(this->floating_[v]);
    }
  }
}

} // namespace bindpose
