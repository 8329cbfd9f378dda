#ifndef bindpose_weights_scaled_mesh_h
#define bindpose_weights_scaled_mesh_h

#include "base/laplacian.h"
#include "weights/domain.h"

namespace bindpose
{

/// What energies are made of: the mesh scaled to diagonal 1 about its centre, so that units and
/// place do not show in what is solved for.
struct ScaledMesh
{
  Points points;
  double diagonal = 1.0; ///< of the mesh, what was scaled to 1
  SparseMatrix stiffness; ///< cotangent
  Eigen::VectorXd mass; ///< lumped, the largest is 1
  double mass_unit = 1.0; ///< the largest before that
};

/// @param used #V: vertices that count for the diagonal.
ScaledMesh scale_mesh(const Domain& domain, const std::vector<char>& used);

} // namespace bindpose

#endif
