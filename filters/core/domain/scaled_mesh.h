#ifndef bindpose_domain_scaled_mesh_h
#define bindpose_domain_scaled_mesh_h

#include "domain/domain.h"
#include "geometry/laplacian.h"

namespace bindpose
{

/// A mesh scaled to diagonal 1 about its center, with the matrices from which energies are
/// assembled. Because of the scaling, units and position do not affect the solution.
struct ScaledMesh
{
  Points points;
  double diagonal = 1.0; ///< original bounding-box diagonal
  SparseMatrix stiffness; ///< cotangent stiffness
  Eigen::VectorXd mass; ///< lumped masses, divided by mass_unit
  double mass_unit = 1.0; ///< largest lumped mass of the scaled mesh
};

/// Scale the mesh and assemble its matrices.
/// @param used #V: 1 for vertices that are included in the bounding box.
ScaledMesh scale_mesh(const Domain& domain, const std::vector<char>& used);

} // namespace bindpose

#endif
