#ifndef bindpose_pose_skinning_eigenmodes_h
#define bindpose_pose_skinning_eigenmodes_h

#include "base/execution.h"
#include "base/laplacian.h"

#include <vector>

namespace bindpose
{

struct Eigenmodes
{
  Weights modes; ///< #V x count, each scaled so that its largest entry is 1
  Eigen::VectorXd eigenvalues; ///< ascending, 1 / length^2
};

/// Compute skinning eigenmodes: weights w with the least energy for their size, L w = lambda M w,
/// that are zero at some vertices. As weights of additional transforms they span the smoothest
/// deformations of lowest energy that do not move these vertices. Benchekroun et al. 2023, Fast
/// complementary dynamics via skinning eigenmodes.
///
/// The paper makes modes orthogonal to the deformations of the rig, so that they never compete with
/// it. Here they vanish at handles, as all extra weights do. Handles in mode full then have exactly
/// their transform, and the energy distributes the motion that modes and handles could both
/// produce.
///
/// @param stiffness L, positive semi-definite.
/// @param mass diagonal of M; vertices without mass are left out.
/// @param zero vertices where modes vanish. A part of the mesh without such a vertex has a constant
/// mode of eigenvalue 0, because it can move as a whole.
///
/// The result has fewer modes if there are fewer free vertices. The status is not_converged if the
/// eigenvalue solver did not find all modes; the result contains those that it found. Cost: one
/// sparse factorization and a few solves per mode. The result has the same bits for any number of
/// threads.
Status skinning_eigenmodes(ExecutionContext& context, const SparseMatrix& stiffness,
  const Eigen::VectorXd& mass, const std::vector<Index>& zero, Index count, Eigenmodes& result);

/// Return the vertices at a handle's point in weight space: their row of weights equals the row of
/// the handle's largest weight.
std::vector<Index> handle_vertices(WeightsView weights);

} // namespace bindpose

#endif
