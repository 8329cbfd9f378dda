// Conjugate gradients for many right-hand sides. Each column has its own step lengths and search
// directions. The columns that have not converged are multiplied in one call and preconditioned in
// one call, which is several times faster per column than separate calls.
#include "linear/refined_solve.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bindpose
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

double refined_solve(const FloatCholesky& factor,
  const std::function<MatrixXd(const MatrixXd&)>& multiply, const VectorXd& inverse_diagonal,
  const MatrixXd& rhs, const RefinedSolveOptions& options, MatrixXd& x)
{
  const auto squared_norm = [&](const auto& v) { return v.cwiseAbs2().dot(inverse_diagonal); };
  x = MatrixXd::Zero(rhs.rows(), rhs.cols());
  VectorXd size(rhs.cols());
  std::vector<Index> active; // columns that have not converged
  for (Index j = 0; j < rhs.cols(); ++j)
  {
    size[j] = squared_norm(rhs.col(j));
    if (!(size[j] <= 0.0))
    {
      active.push_back(j);
    }
  }
  double largest_residual = 0.0;
  // Residuals, preconditioned residuals and search directions of the columns that have not
  // converged, one matrix column for each.
  MatrixXd r = rhs(Eigen::all, active);
  MatrixXd z;
  MatrixXd p;
  VectorXd previous_rho;
  for (int step = 0; step < options.most_steps && !active.empty(); ++step)
  {
    if (options.context && options.context->canceled())
    {
      return 1.0;
    }
    factor.solve(r, z);
    const VectorXd rho = r.cwiseProduct(z).colwise().sum();
    p = step == 0 ? z : MatrixXd(z + p * rho.cwiseQuotient(previous_rho).asDiagonal());
    previous_rho = rho;
    const MatrixXd product = multiply(p);
    const VectorXd curvature = p.cwiseProduct(product).colwise().sum();
    std::vector<Index> remaining; // columns of r that have not converged
    for (Index k = 0; k < static_cast<Index>(active.size()); ++k)
    {
      bool finished = !(curvature[k] > 0.0) || !std::isfinite(rho[k]);
      if (!finished)
      {
        const double length = rho[k] / curvature[k];
        x.col(active[k]) += length * p.col(k);
        r.col(k) -= length * product.col(k);
      }
      const double relative_residual = std::sqrt(squared_norm(r.col(k)) / size[active[k]]);
      finished = finished || relative_residual <= options.accuracy;
      if (finished || step + 1 == options.most_steps)
      {
        largest_residual =
          std::max(largest_residual, std::isfinite(relative_residual) ? relative_residual : 1e300);
      }
      if (!finished)
      {
        remaining.push_back(k);
      }
    }
    if (remaining.size() < active.size())
    {
      std::vector<Index> remaining_columns;
      for (const Index k : remaining)
      {
        remaining_columns.push_back(active[k]);
      }
      active = std::move(remaining_columns);
      r = MatrixXd(r(Eigen::all, remaining));
      p = MatrixXd(p(Eigen::all, remaining));
      previous_rho = VectorXd(previous_rho(remaining));
    }
  }
  return largest_residual;
}

} // namespace bindpose
