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
  double winding_threshold = 0.5; ///< a point is inside if its winding number is at least this, > 0
  /// Shortest and longest requested edges, in bounding-box diagonals, 1e-4 … 1. Between these
  /// limits, edges are as long as those of the surface and at most as long as the inside is thick.
  /// Neighboring edges differ by at most a third.
  double smallest_edge = 0.005;
  double largest_edge = 0.035;
  double tet_limit = 5e5; ///< smallest_edge is enlarged if more tets are expected, >= 1000
  double time_limit = 60.0; ///< the helper is killed after this many seconds, > 0
  Index memory_limit = 0; ///< largest address space of the helper in MiB, 0: no limit
};

struct RemeshResult
{
  TetMesh mesh; ///< positive tets, no unused vertices
  /// Id of the input vertex with the same coordinates, ascending, then -1 for new vertices, #V.
  std::vector<Index> original_vertices;
  Index boundary_vertices = 0; ///< input vertices on the region's boundary
  /// Between the tets' boundary and the part of the input that bounds the region.
  SurfaceDistance distance;
};

/// Compute well-shaped tets of {winding number >= threshold} by Delaunay refinement in the helper
/// executable bindpose-mesher (CGAL's Mesh_3). Edge lengths are graded from those of the surface.
/// Vertices of the surface are kept if they are far enough from each other for good tets. Any
/// surface works: the isosurface closes its openings, and everything inside (crossing parts, inner
/// walls) is removed. Creases sharper than 30 degrees are kept, except the edges at which surfaces
/// cross.
///
/// Report: the counts of the helper, seconds.*, counts.kept_vertices, counts.boundary_vertices,
/// distance_max and distance_mean (percent of the diagonal).
/// invalid_input: coordinates not finite, ids out of range, a flat surface, an option out of range,
/// or nothing is enclosed. unavailable: no helper. internal_error: the helper failed or ran out of
/// time.
/// Cost: 50 us per tet.
Status remesh_tets(PointsView points, TrianglesView triangles, const WindingNumber& winding,
  const RemeshOptions& options, RemeshResult& result, ExecutionContext& context);

} // namespace bindpose

#endif
