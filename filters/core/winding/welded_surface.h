#ifndef bindpose_winding_welded_surface_h
#define bindpose_winding_welded_surface_h

#include "base/execution.h"
#include "base/mesh.h"
#include "winding/exact_frame.h"

#include <vector>

namespace bindpose
{

/// A surface as winding numbers see it: equal points are one vertex, triangles that use a vertex
/// twice are gone. Duplicates stay, for they count.
struct WeldedSurface
{
  Points points; ///< in the frame, sorted by coordinates
  Triangles triangles;
  std::vector<Index> original_vertices; ///< #V: an input id of each
  std::vector<Edge> open_edges; ///< those of mesh_edges() whose directions do not cancel
  Index boundary_edges = 0; ///< used by one triangle
  Index nonmanifold_edges = 0; ///< used by three triangles or more
  Index merged_vertices = 0;
  Index degenerate_triangles = 0; ///< dropped ones, and those without an area
  Index duplicate_triangles = 0; ///< same vertices as another one, in any order
};

/// Welds a valid mesh (check_mesh) of fewer than 2^31 points. O(#F log #F), on all threads. @return
/// false when cancelled.
bool weld_surface(PointsView points, TrianglesView triangles, const ExactFrame& frame,
  ExecutionContext& context, WeldedSurface& welded);

} // namespace bindpose

#endif
