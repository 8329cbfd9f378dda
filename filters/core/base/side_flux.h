#ifndef bindpose_base_side_flux_h
#define bindpose_base_side_flux_h

#include "base/sparse_matrix.h"
#include "base/triangle_sides.h"

namespace bindpose
{

/// Return the matrix N of the flux out of triangles through the given sides (#V x #V): N_ij is the
/// integral of phi_i n . grad phi_j over the sides. n lies in the plane of the triangle and is
/// normal to the side.
SparseMatrix side_flux(
  PointsView points, TrianglesView triangles, const std::vector<TriangleSide>& sides);

} // namespace bindpose

#endif
