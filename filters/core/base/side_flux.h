#ifndef bindpose_base_side_flux_h
#define bindpose_base_side_flux_h

#include "base/laplacian.h"
#include "base/triangle_sides.h"

namespace bindpose
{

/// N (#V x #V): N_ij is the integral over these sides of triangles of phi_i n . grad phi_j, what
/// flows out of each triangle there; n lies in the triangle.
SparseMatrix side_flux(
  PointsView points, TrianglesView triangles, const std::vector<TriangleSide>& sides);

} // namespace bindpose

#endif
