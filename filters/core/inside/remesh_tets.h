#ifndef bindpose_inside_remesh_tets_h
#define bindpose_inside_remesh_tets_h

// The method `remesh` of tetrahedralize(): tets by Delaunay refinement with graded edge lengths.

#include "base/execution.h"
#include "geometry/mesh.h"
#include "inside/surface_distance.h"
#include "winding/winding_number.h"

#include <vector>

namespace bindpose
{

/// Options of remesh_tets().
struct RemeshOptions
{
  /// Threshold > 0: a point is inside if its winding number is at least this value.
  double winding_threshold = 0.5;
  /// Shortest and longest requested edges, in bounding-box diagonals, 1e-4 … 1. Between these
  /// limits, edges are as long as the edges of the surface, but not longer than the local thickness
  /// of the inside. The lengths of neighboring edges differ by at most a third.
  double smallest_edge = 0.005;
  double largest_edge = 0.035;
  /// Maximum expected number of tets, >= 1000. If more tets are expected, smallest_edge is
  /// increased.
  double tet_limit = 5e5;
  /// Maximum fraction (0 … 1) of the boundary, by area, at which the region or the gap next to the
  /// region is thinner than smallest_edge. If the fraction is larger, remesh_tets() fails before it
  /// refines.
  double maximum_thin_fraction = 1.0;
  double time_limit = 60.0; ///< seconds (> 0) after which the helper is killed
  Index memory_limit = 0; ///< largest address space of the helper in MiB, 0: no limit
};

/// Result of remesh_tets().
struct RemeshResult
{
  TetMesh mesh; ///< positively oriented tets; no vertex is unused
  /// #V: id of the input vertex with the same coordinates; -1 for a new vertex. Vertices of the
  /// input come first, with ascending ids.
  std::vector<Index> original_vertices;
  Index boundary_vertices = 0; ///< number of input vertices on the region's boundary
  /// Distance between the boundary of the tets and the part of the input that bounds the region.
  SurfaceDistance distance;
};

/// Compute well-shaped tets of {winding number >= threshold} by Delaunay refinement in the helper
/// executable bindpose-mesher (CGAL's Mesh_3). Edge lengths are graded from those of the surface.
/// Vertices of the surface are kept if they are far enough from each other for good tets. Any
/// surface works: the isosurface closes its openings, and triangles inside the region (crossing
/// parts, inner walls) are ignored. Creases sharper than 30 degrees are kept, except the edges at
/// which surfaces cross.
///
/// The report contains the counts of the helper, seconds.*, thin_fraction (see
/// maximum_thin_fraction), counts.kept_vertices, counts.boundary_vertices, distance_max and
/// distance_mean (percent of the bounding-box diagonal). The report of a failure contains
/// thin_fraction if this fraction exceeded the limit.
///
/// Return invalid_input if a coordinate is not finite, an id is out of range, the surface is flat,
/// an option is out of range, or the surface encloses no volume; unavailable if there is no helper;
/// internal_error if the helper failed, or exceeded its time limit or maximum_thin_fraction. Cost:
/// 50 us per tet.
Status remesh_tets(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const WindingNumber& winding, const RemeshOptions& options, RemeshResult& result);

} // namespace bindpose

#endif
