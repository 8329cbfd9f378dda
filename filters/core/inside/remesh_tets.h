#ifndef bindpose_inside_remesh_tets_h
#define bindpose_inside_remesh_tets_h

#include "base/execution.h"
#include "base/mesh.h"
#include "inside/surface_distance.h"
#include "winding/winding_number.h"

#include <vector>

namespace bindpose
{

struct RemeshOptions
{
  double winding_threshold = 0.5; ///< inside is where the winding number is at least this, > 0
  /// Shortest and longest edges wanted, as fractions of the surface's diagonal, 1e-4 … 1. Between
  /// them edges are as long as the surface's own, no longer than the inside is thick, and a third
  /// longer from one to the next at most.
  double smallest_edge = 0.005;
  double largest_edge = 0.035;
  double tet_limit = 5e5; ///< smallest_edge is raised when more are to be expected, >= 1000
  double time_limit = 60.0; ///< seconds after which the helper is killed, > 0
  Index memory_limit = 0; ///< MiB of address space for the helper, 0: no limit
};

struct RemeshResult
{
  TetMesh mesh; ///< positive tets, no stray vertices
  /// #V: id of the input vertex with these coordinates, ascending, then -1 for new ones.
  std::vector<Index> original_vertices;
  Index boundary_vertices = 0; ///< input vertices that lie on the region's boundary
  SurfaceDistance distance; ///< between the tets' boundary and the input where it bounds the region
};

/// Tets of good shape of {winding number >= threshold} by Delaunay refinement in the helper
/// executable bindpose-mesher (CGAL's Mesh_3), with edges graded from the surface's own; vertices
/// of the surface stay where they are not too near to each other for good tets. Any surface will
/// do: where it is open, the isosurface closes it; what lies inside (crossing parts, inner walls)
/// is gone. Creases sharper than 30 degrees stay but for the edges at which surfaces cross.
///
/// Report: what the helper counts, seconds.*, counts.kept_vertices, counts.boundary_vertices,
/// distance_max and distance_mean (percent of the diagonal).
/// invalid_input: not finite, ids out of range, flat, an option out of range, encloses nothing.
/// unavailable: no helper. internal_error: the helper failed or ran out of time.
/// Cost: 50 us a tet.
Status remesh_tets(PointsView points, TrianglesView triangles, const WindingNumber& winding,
  const RemeshOptions& options, RemeshResult& result, ExecutionContext& context);

} // namespace bindpose

#endif
