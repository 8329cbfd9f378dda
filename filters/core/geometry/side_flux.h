#ifndef bindpose_geometry_side_flux_h
#define bindpose_geometry_side_flux_h

#include "geometry/triangle_sides.h"
#include "linear/sparse_matrix.h"

namespace bindpose
{

/// Return the matrix N of the flux out of triangles through the given sides (#V x #V): N_ij is the
/// integral of phi_i n . grad phi_j over the sides, with hat functions phi. The outward normal n
/// lies in the plane of the triangle and is normal to the side.
SparseMatrix side_flux(
  PointsView points, TrianglesView triangles, const std::vector<TriangleSide>& sides);

} // namespace bindpose

#endif
