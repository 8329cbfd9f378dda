#ifndef bindpose_qp_free_conjugate_gradients_h
#define bindpose_qp_free_conjugate_gradients_h

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace bindpose
{

/// A map r -> z, where z approximates A^-1 r. The map must be linear, symmetric and positive
/// definite.
using Preconditioner = std::function<void(const Eigen::VectorXd& r, Eigen::VectorXd& z)>;

/// Conditions under which free_conjugate_gradients() ends.
struct FreeConjugateGradientsOptions
{
  int maximum_steps = 4;
  /// Target for the energy norm of the error, as a fraction of the initial norm. The norm is
  /// estimated by sqrt(r'z), where r is the residual and z is the preconditioned residual.
  double reduction = 0.05;
};

/// Solve A x = b approximately for the free vertices, by preconditioned conjugate gradients that
/// start from x. The entries of x at the other vertices do not change.
/// @param multiply p -> A p.
/// @param at_bound one entry per vertex: 0 for free vertices.
/// @param r the residual b - A x; its entries at vertices that are not free are ignored.
/// @return the number of steps. If it is maximum_steps, the target may not be reached, because it
/// is not tested after the last step.
int free_conjugate_gradients(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& multiply,
  const Preconditioner& preconditioner, const std::vector<char>& at_bound,
  const FreeConjugateGradientsOptions& options, Eigen::VectorXd r, Eigen::VectorXd& x);

} // namespace bindpose

#endif
