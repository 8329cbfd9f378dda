#ifndef bindpose_base_side_flux_h
#define bindpose_base_side_flux_h

#include "base/laplacian.h"
#include "base/triangle_sides.h"

namespace bindpose
{

/// Return N (#V x #V): N_ij is the integral of phi_i n . grad phi_j over these sides of triangles,
/// the flux out of each triangle. n lies in the plane of the triangle.
SparseMatrix side_flux(
  PointsView points, TrianglesView triangles, const std::vector<TriangleSide>& sides);

} // namespace bindpose

#endif
