// Conjugate gradients for many right-hand sides. Each column has its own step lengths and search
// directions. One call multiplies, and one call preconditions, all columns that have not converged.
// This is several times faster per column than separate calls.
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
  std::vector<Index> open; // columns that have not converged
  for (Index j = 0; j < rhs.cols(); ++j)
  {
    size[j] = squared_norm(rhs.col(j));
    if (!(size[j] <= 0.0))
    {
      open.push_back(j);
    }
  }
  double worst = 0.0;
  // Residuals, preconditioned residuals and search directions of the open columns, one matrix
  // column each.
  MatrixXd r = rhs(Eigen::all, open);
  MatrixXd z;
  MatrixXd p;
  VectorXd last;
  for (int step = 0; step < options.most_steps && !open.empty(); ++step)
  {
    if (options.context && options.context->canceled())
    {
      return 1.0;
    }
    factor.solve(r, z);
    const VectorXd now = r.cwiseProduct(z).colwise().sum();
    p = step == 0 ? z : MatrixXd(z + p * now.cwiseQuotient(last).asDiagonal());
    last = now;
    const MatrixXd product = multiply(p);
    const VectorXd curvature = p.cwiseProduct(product).colwise().sum();
    std::vector<Index> kept; // columns of r that stay open
    for (Index k = 0; k < static_cast<Index>(open.size()); ++k)
    {
      bool ends = !(curvature[k] > 0.0) || !std::isfinite(now[k]);
      if (!ends)
      {
        const double length = now[k] / curvature[k];
        x.col(open[k]) += length * p.col(k);
        r.col(k) -= length * product.col(k);
      }
      const double share = std::sqrt(squared_norm(r.col(k)) / size[open[k]]);
      ends = ends || share <= options.accuracy;
      if (ends || step + 1 == options.most_steps)
      {
        worst = std::max(worst, std::isfinite(share) ? share : 1e300);
      }
      if (!ends)
      {
        kept.push_back(k);
      }
    }
    if (kept.size() < open.size())
    {
      std::vector<Index> still;
      for (const Index k : kept)
      {
        still.push_back(open[k]);
      }
      open = std::move(still);
      r = MatrixXd(r(Eigen::all, kept));
      p = MatrixXd(p(Eigen::all, kept));
      last = VectorXd(last(kept));
    }
  }
  return worst;
}

} // namespace bindpose
