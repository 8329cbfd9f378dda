// A factored linear system with Dirichlet values (see free_system.h).
#include "qp/free_system.h"

namespace bindpose
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

FreeSystem::FreeSystem(const SparseMatrix& matrix, const std::vector<Index>& fixed)
  : form_(matrix, fixed)
{
}

Status FreeSystem::factor(ExecutionContext& context, const SparseSolver::Options& options)
{
  if (this->form_.free_vertices.empty())
  {
    return {};
  }
  this->solver_ = SparseSolver(options);
  Status status = this->solver_.analyze(this->form_.lower);
  if (status.ok() && !context.canceled())
  {
    status = explain_no_minimum(this->solver_.factor(this->form_.lower));
  }
  return context.canceled() ? Status::canceled() : status;
}

MatrixXd FreeSystem::minimizers(const MatrixXd& fixed_values) const
{
  return this->form_.extend_to_all(
    this->solver_.solve(-(this->form_.fixed_block * fixed_values)), fixed_values);
}

VectorXd FreeSystem::solve(const MatrixXd& rhs, MatrixXd& w) const
{
  const MatrixXd fixed_values = w(this->form_.fixed, Eigen::all);
  const MatrixXd right = this->form_.free_rows(rhs) - this->form_.fixed_block * fixed_values;
  const MatrixXd x = this->solver_.solve(right);
  w = this->form_.extend_to_all(x, fixed_values);
  if (this->form_.free_vertices.empty())
  {
    return VectorXd::Zero(rhs.cols());
  }
  MatrixXd residuals = right - this->form_.a * x;
  for (Index i = 0; i < residuals.rows(); ++i)
  {
    residuals.row(i) /= this->form_.lower.valuePtr()[this->form_.diagonal[i]];
  }
  return residuals.cwiseAbs().colwise().maxCoeff().transpose();
}

} // namespace bindpose
