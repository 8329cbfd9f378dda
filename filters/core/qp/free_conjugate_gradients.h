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
  double reduction = 0.05; ///< fraction to which the energy norm of the error is reduced
};

/// Change x by preconditioned conjugate gradients, so that the residual r at the free vertices
/// decreases. The entries of x at the other vertices do not change.
/// @param multiply p -> A p.
/// @param at_bound one entry per vertex: 0 for free vertices.
/// @param r the residual b - A x; its entries at vertices that are not free are ignored.
/// @return the number of steps. After maximum_steps, the reduction is not tested: the norm may
/// still be too large.
int free_conjugate_gradients(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& multiply,
  const Preconditioner& preconditioner, const std::vector<char>& at_bound,
  const FreeConjugateGradientsOptions& options, Eigen::VectorXd r, Eigen::VectorXd& x);

} // namespace bindpose

#endif
