// Evaluate the two bounds of the optimality gap and the natural residual (see certificate.h).
#include "qp/certificate.h"

#include "linear/symmetric_product.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bindpose
{

Certificate certify(const BoundedEnergy& problem, const Eigen::VectorXd& w,
  const std::vector<OrderedPair>& pairs, const Eigen::VectorXd& multipliers,
  const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& inverse)
{
  Eigen::VectorXd g = symmetric_product(problem.q, w);
  const Eigen::VectorXd diagonals = problem.q.diagonal();
  Certificate certificate;
  // A constant column has energy zero. A computed energy at the level of round-off counts as zero.
  certificate.energy = 0.5 * w.dot(g);
  const double noise = 1e-14 * 0.5 * w.cwiseAbs2().dot(diagonals);
  certificate.energy = certificate.energy > noise ? certificate.energy : 0.0;
  double gap = 0.0;
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    const double slack = w[pairs[k].high] - w[pairs[k].low] - pairs[k].minimum_difference;
    const double lambda = multipliers[static_cast<Index>(k)];
    gap += lambda * slack;
    g[pairs[k].high] -= lambda;
    g[pairs[k].low] += lambda;
    certificate.order_violation = std::max(certificate.order_violation, -slack);
  }
  double second_gap = gap;
  Eigen::VectorXd r = Eigen::VectorXd::Zero(inverse ? w.size() : 0);
  double diagonal_sum = 0.0;
  Index free_count = 0;
  for (Index v = 0; v < w.size(); ++v)
  {
    if (!problem.free[v])
    {
      continue;
    }
    const double l = problem.bounds.low(v);
    const double u = problem.bounds.high(v);
    const double diagonal = diagonals[v];
    diagonal_sum += diagonal;
    ++free_count;
    const double contribution = g[v] == 0.0 ? 0.0 : std::max(g[v] * (w[v] - l), -g[v] * (u - w[v]));
    gap += contribution;
    // If a Newton step of this vertex alone stays within the bounds, the vertex belongs to the set
    // R (see Certificate).
    if (inverse && w[v] - g[v] / diagonal > l && w[v] - g[v] / diagonal < u)
    {
      r[v] = g[v];
    }
    else
    {
      second_gap += contribution;
    }
    const double step = std::clamp(w[v] - g[v] / diagonal, l, u);
    certificate.kkt_residual = std::max(certificate.kkt_residual, std::abs(w[v] - step));
    certificate.bounds_violation = std::max({ certificate.bounds_violation, l - w[v], w[v] - u });
  }
  if (inverse)
  {
    gap = std::min(gap, second_gap + 0.5 * std::abs(r.dot(inverse(r))));
  }
  const double floor = free_count ? 0.5e-12 * diagonal_sum / static_cast<double>(free_count) : 1.0;
  certificate.relative_gap = std::abs(gap) / std::max(certificate.energy, floor);
  return certificate;
}

std::string certificate_message(double relative_gap, double kkt_residual, double tolerance)
{
  char numbers[96];
  std::snprintf(numbers, sizeof(numbers), "relative gap %.2g, residual %.2g, tolerance %.2g",
    relative_gap, kkt_residual, tolerance);
  return "are not certified (" + std::string(numbers) + ")";
}

} // namespace bindpose
