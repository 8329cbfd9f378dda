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

/// Skinning eigenmodes: the weights w of least energy for their size, L w = lambda M w, zero at
/// some vertices. As weights of more transforms they span the smoothest, cheapest deformations that
/// leave these vertices alone. Benchekroun et al. 2023, Fast complementary dynamics via skinning
/// eigenmodes.
///
/// The paper makes modes orthogonal to what the rig can do, so that they never compete with it.
/// Here they vanish where handles are, as all extra weights do: handles in mode full then have
/// their transform to the letter, and what modes and handles share is settled by the energy.
///
/// @param stiffness L, positive semi-definite; @param mass diagonal of M, vertices without any stay
/// out; @param zero vertices where modes vanish. A part of the mesh without such a vertex has a
/// constant mode of eigenvalue 0: it may move as a whole.
///
/// Fewer modes come back when there are fewer free vertices. not_converged when the eigenvalue
/// solver gave up; the modes that it found are there. Cost: one sparse factorisation, a few solves
/// a mode. The same bits whatever the threads.
Status skinning_eigenmodes(ExecutionContext& context, const SparseMatrix& stiffness,
  const Eigen::VectorXd& mass, const std::vector<Index>& zero, Index count, Eigenmodes& result);

/// The vertices that share a handle's place in weight space: their row is that of the handle's
/// largest weight.
std::vector<Index> handle_vertices(WeightsView weights);

} // namespace bindpose

#endif
