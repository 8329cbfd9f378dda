#ifndef bindpose_inside_thick_solid_h
#define bindpose_inside_thick_solid_h

// Closed surfaces around open, flat or thin triangles.

#include "base/execution.h"
#include "geometry/mesh.h"
#include "winding/winding_number.h"

namespace bindpose
{

/// Options of thick_solid().
struct ThickSolidOptions
{
  /// Threshold > 0: a point is inside if its winding number is at least this value.
  double winding_threshold = 0.5;
  /// Approximate number of triangles of the result, 100 … 10000000. The edges of the triangles are
  /// about as long as a lattice cube. Gaps narrower than 1.2 edge lengths are closed.
  Index triangles = 20000;
  /// If true, a layer of 0.6 cubes is added around all triangles, not only around those that the
  /// lattice would miss. Parts that touch or are nearer to each other than 1.2 cubes are joined.
  bool join_near_parts = false;
};

/// Compute a closed surface around the volume that triangles enclose. Parts thinner than a lattice
/// cube are thickened: triangles that the lattice would miss get a layer of 0.6 cubes on both
/// sides. Therefore open, flat and thin parts are kept, and gaps narrower than 1.2 cubes near them
/// are closed. The surface is computed by isosurface stuffing (lattice_tets.h) and made manifold
/// (manifold_boundary.h). It is closed and may touch but not cross itself. Cavities are kept.
///
/// `winding` is the winding number of the triangles. The result is the same for any number of
/// threads.
///
/// The report contains resolution (number of cubes along the longest side of the surface's box) and
/// counts.thickened_triangles.
/// @return canceled or ok. The surface must have a diagonal above 0 (check_frame). Cost: about 1 us
/// per triangle, 1 us per lattice vertex and 10 us per triangle of the result, in addition to the
/// winding numbers of the lattice vertices.
Status thick_solid(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const WindingNumber& winding, const ThickSolidOptions& options, TriangleMesh& solid);

} // namespace bindpose

#endif
