#ifndef bindpose_inside_thick_solid_h
#define bindpose_inside_thick_solid_h

#include "base/execution.h"
#include "base/mesh.h"
#include "winding/winding_number.h"

namespace bindpose
{

struct ThickSolidOptions
{
  /// Inside is where the winding number is at least this, > 0.
  double winding_threshold = 0.5;
  /// About as many triangles as the solid's surface gets, 100 … 10000000. Their edges are as long
  /// as a lattice cube; gaps narrower than 1.2 edges close.
  Index triangles = 20000;
  /// Lay the layer around all triangles, not only around those that the lattice would miss: parts
  /// that touch or are nearer to each other than 1.2 cubes become one.
  bool join_near_parts = false;
};

/// The closed surface of what triangles enclose, thickened where that is thinner than a lattice
/// cube: around triangles that the lattice would miss lies a layer of 0.6 cubes to both sides. So
/// open, flat and thin parts stay, and near them gaps narrower than 1.2 cubes close. By isosurface
/// stuffing (lattice_tets.h), cut apart where it pinches (manifold_boundary.h): a closed manifold
/// that may touch, but not cross itself. Hollows stay.
///
/// `winding` is that of the triangles. The same surface for any number of threads.
///
/// Report: resolution (cubes along the longest side of the surface's box),
/// counts.thickened_triangles.
/// @return cancelled or ok. The surface must have a diagonal above 0 (check_frame).
/// Cost: about 1 us per triangle, 1 us per lattice vertex and 10 us per triangle of the result,
/// besides the winding numbers of the lattice vertices.
Status thick_solid(PointsView points, TrianglesView triangles, const WindingNumber& winding,
  const ThickSolidOptions& options, TriangleMesh& solid, ExecutionContext& context);

} // namespace bindpose

#endif
