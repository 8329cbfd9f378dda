#ifndef bindpose_arap_skinning_eigenmodes_h
#define bindpose_arap_skinning_eigenmodes_h

#include "base/execution.h"
#include "geometry/laplacian.h"

#include <vector>

namespace bindpose
{

/// Result of skinning_eigenmodes().
struct Eigenmodes
{
  Weights modes; ///< #V x count; each column is scaled so that its largest entry is 1
  Eigen::VectorXd eigenvalues; ///< eigenvalue of each mode, ascending, in 1 / length^2
};

/// Compute skinning eigenmodes: solutions w of L w = lambda M w that are zero at the vertices
/// `fixed_vertices`, for the smallest eigenvalues lambda. Used as weights of additional transforms,
/// the modes span smooth deformations of low energy that do not move these vertices. Method:
/// Benchekroun et al. 2023, Fast complementary dynamics via skinning eigenmodes.
///
/// In the paper, modes are orthogonal to the deformations of the rig. Here they are zero at
/// handles, like all extra weights. Therefore the transforms of handles in mode full are exact. If
/// handles and modes can produce the same motion, the energy determines the contribution of each.
///
/// @param stiffness L, positive semi-definite.
/// @param mass diagonal of M; modes are zero at vertices without mass.
/// @param fixed_vertices vertices at which modes are zero. A part of the mesh without such a vertex
/// has a constant mode of eigenvalue 0, because it can move as a whole.
///
/// The result has fewer modes if there are fewer free vertices. The status is not_converged if the
/// eigenvalue solver did not find all modes; the result contains the modes that it found. Cost: one
/// sparse factorization and a few solves per mode. The result has the same bits for any number of
/// threads.
Status skinning_eigenmodes(ExecutionContext& context, const SparseMatrix& stiffness,
  const Eigen::VectorXd& mass, const std::vector<Index>& fixed_vertices, Index count,
  Eigenmodes& result);

/// For each handle, take the vertex at which the handle's weight is largest. Return all vertices
/// whose row of weights equals the row of one of these vertices.
std::vector<Index> handle_vertices(WeightsView weights);

} // namespace bindpose

#endif
