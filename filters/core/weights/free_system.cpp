#include "weights/free_system.h"

namespace bindpose
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

FreeSystem::FreeSystem(const SparseMatrix& matrix, const std::vector<Index>& fixed)
  : form_(matrix, fixed)
{
}

Status FreeSystem::factor(const SparseSolver::Options& options, ExecutionContext& context)
{
  if (this->form_.free_vertices.empty())
  {
    return {};
  }
  this->solver_ = SparseSolver(options);
  Status status = this->solver_.analyse(this->form_.lower);
  if (status.ok() && !context.cancelled())
  {
    status = without_minimum(this->solver_.factor(this->form_.lower));
  }
  return context.cancelled() ? Status::cancelled() : status;
}

MatrixXd FreeSystem::minimisers(const MatrixXd& fixed_values) const
{
  MatrixXd w = MatrixXd::Zero(this->form_.q.rows(), fixed_values.cols());
  for (std::size_t i = 0; i < this->form_.fixed.size(); ++i)
  {
    w.row(this->form_.fixed[i]) = fixed_values.row(static_cast<Index>(i));
  }
  const MatrixXd x = this->solver_.solve(-(this->form_.to_fixed * fixed_values));
  for (std::size_t i = 0; i < this->form_.free_vertices.size(); ++i)
  {
    w.row(this->form_.free_vertices[i]) = x.row(static_cast<Index>(i));
  }
  return w;
}

VectorXd FreeSystem::solve(const MatrixXd& rhs, MatrixXd& w) const
{
  const std::vector<Index>& free = this->form_.free_vertices;
  MatrixXd given(static_cast<Index>(this->form_.fixed.size()), rhs.cols());
  for (Index i = 0; i < given.rows(); ++i)
  {
    given.row(i) = w.row(this->form_.fixed[i]);
  }
  MatrixXd right(static_cast<Index>(free.size()), rhs.cols());
  for (Index i = 0; i < right.rows(); ++i)
  {
    right.row(i) = rhs.row(free[i]);
  }
  right -= this->form_.to_fixed * given;
  const MatrixXd x = this->solver_.solve(right);
  MatrixXd residuals = right - this->form_.a * x;
  for (Index i = 0; i < right.rows(); ++i)
  {
    w.row(free[i]) = x.row(i);
    residuals.row(i) /= this->form_.lower.valuePtr()[this->form_.diagonal[i]];
  }
  return free.empty() ? VectorXd::Zero(rhs.cols())
                      : VectorXd(residuals.cwiseAbs().colwise().maxCoeff().transpose());
}

} // namespace bindpose
