// Conjugate gradients for the Newton steps of the projected methods (see
// free_conjugate_gradients.h).
#include "qp/free_conjugate_gradients.h"

namespace bindpose
{

using Eigen::VectorXd;

int free_conjugate_gradients(const std::function<VectorXd(const VectorXd&)>& multiply,
  const Preconditioner& preconditioner, const std::vector<char>& at_bound,
  const FreeConjugateGradientsOptions& options, VectorXd r, VectorXd& x)
{
  const auto zero_at_bounds = [&](VectorXd& v)
  {
    for (Eigen::Index i = 0; i < v.size(); ++i)
    {
      v[i] = at_bound[i] ? 0.0 : v[i];
    }
  };
  zero_at_bounds(r);
  VectorXd z, p;
  double first = 0.0;
  double last_rz = 0.0;
  int step = 0;
  for (; step < options.maximum_steps; ++step)
  {
    preconditioner(r, z);
    zero_at_bounds(z);
    const double rz = r.dot(z);
    if (!(rz > 0.0) || rz <= options.reduction * options.reduction * first)
    {
      break;
    }
    first = step == 0 ? rz : first;
    p = step == 0 ? z : VectorXd(z + (rz / last_rz) * p);
    last_rz = rz;
    VectorXd product = multiply(p);
    zero_at_bounds(product);
    const double curvature = p.dot(product);
    if (!(curvature > 0.0))
    {
      break;
    }
    x += (rz / curvature) * p;
    r -= (rz / curvature) * product;
  }
  return step;
}

} // namespace bindpose
