#ifndef bindpose_winding_welded_surface_h
#define bindpose_winding_welded_surface_h

#include "base/execution.h"
#include "geometry/mesh.h"
#include "winding/exact_frame.h"

#include <vector>

namespace bindpose
{

/// A surface prepared for winding numbers. Equal points are merged, and triangles that use a vertex
/// twice are removed. Duplicate triangles are kept, because each of them contributes to the winding
/// number.
struct WeldedSurface
{
  Points points; ///< vertices in the exact frame (ExactFrame), sorted by coordinates
  Triangles triangles;
  /// #V: id of one input point that was merged into the vertex.
  std::vector<Index> original_vertices;
  /// The edges (see mesh_edges) that the triangles do not use equally often in both directions.
  std::vector<Edge> open_edges;
  Index boundary_edges = 0; ///< number of edges used by one triangle
  Index nonmanifold_edges = 0; ///< number of edges used by three triangles or more
  Index merged_vertices = 0;
  /// Number of removed triangles plus number of remaining triangles without area.
  Index degenerate_triangles = 0;
  /// Number of triangles with the same vertices, in any order, as an earlier triangle.
  Index duplicate_triangles = 0;
};

/// Weld a valid mesh (check_mesh) of fewer than 2^31 points. O(#F log #F), on all threads.
/// @return false if canceled.
bool weld_surface(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const ExactFrame& frame, WeldedSurface& welded);

} // namespace bindpose

#endif
