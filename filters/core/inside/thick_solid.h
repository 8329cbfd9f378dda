#ifndef bindpose_inside_thick_solid_h
#define bindpose_inside_thick_solid_h

#include "base/execution.h"
#include "base/mesh.h"
#include "winding/winding_number.h"

namespace bindpose
{

struct ThickSolidOptions
{
  /// A point is inside if its winding number is at least this, > 0.
  double winding_threshold = 0.5;
  /// Approximate number of triangles of the result, 100 … 10000000. Their edges are as long as a
  /// lattice cube. Gaps narrower than 1.2 edges close.
  Index triangles = 20000;
  /// Add the layer around all triangles, instead of only those that the lattice would miss. Parts
  /// that touch or are nearer to each other than 1.2 cubes become one.
  bool join_near_parts = false;
};

/// Compute a closed surface around the volume that triangles enclose. Parts thinner than a lattice
/// cube are thickened: triangles that the lattice would miss get a layer of 0.6 cubes on both
/// sides. Open, flat and thin parts are therefore kept, and gaps narrower than 1.2 cubes near them
/// close. The surface is computed by isosurface stuffing (lattice_tets.h) and separated at pinches
/// (manifold_boundary.h). It is a closed manifold that may touch but not cross itself. Hollows are
/// kept.
///
/// `winding` is the winding number of the triangles. The result is the same for any number of
/// threads.
///
/// Report: resolution (cubes along the longest side of the surface's box),
/// counts.thickened_triangles.
/// @return canceled or ok. The surface must have a diagonal above 0 (check_frame).
/// Cost: about 1 us per triangle, 1 us per lattice vertex and 10 us per triangle of the result, in
/// addition to the winding numbers of the lattice vertices.
Status thick_solid(PointsView points, TrianglesView triangles, const WindingNumber& winding,
  const ThickSolidOptions& options, TriangleMesh& solid, ExecutionContext& context);

} // namespace bindpose

#endif
