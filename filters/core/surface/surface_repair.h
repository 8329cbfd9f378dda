#ifndef bindpose_surface_surface_repair_h
#define bindpose_surface_surface_repair_h

#include "base/execution.h"
#include "base/mesh.h"

#include <utility>
#include <vector>

namespace bindpose
{

/// Counts of the defects of a surface. Edges, components and crossings are those of the surface
/// after equal vertices are welded and triangles without area are removed. Otherwise, in files that
/// repeat the corners of every triangle (STL), all edges would be boundary edges.
struct SurfaceDiagnosis
{
  Index vertices = 0; ///< number of input vertices
  Index triangles = 0; ///< number of input triangles
  Index duplicate_vertices = 0; ///< equal to a vertex of lower id; counts used vertices only
  Index unreferenced_vertices = 0;
  Index degenerate_triangles = 0; ///< three collinear points (exact test)
  Index duplicate_triangles = 0; ///< same vertices as a triangle of lower id, in any order
  Index boundary_edges = 0; ///< used by one triangle
  Index nonmanifold_edges = 0; ///< used by three triangles or more
  Index misoriented_edges = 0; ///< used by two triangles with the same direction
  Index components = 0; ///< connected by vertices
  Index inward_components = 0; ///< closed, not inside another component, of negative volume
  /// Pairs of triangles that meet beyond their shared vertices and edges.
  Index self_intersections = 0;
  Index crossing_triangles = 0; ///< triangles of these pairs
  bool closed = false; ///< the directions cancel at every edge, so winding numbers are integers
  bool flat = false; ///< all points are coplanar (exact test)
};

/// Add the documented keys: counts.vertices, counts.triangles, counts.boundary_edges, ….
void add_to_report(const SurfaceDiagnosis& diagnosis, Report& report);

struct RepairOptions
{
  /// Turn triangles so that neighbors agree (the part of a patch with the smaller area is turned).
  /// Then turn closed components that are inside out, with everything inside them. If false, the
  /// orientation does not change.
  bool orient = true;
  /// Round vertices to a grid of about this fraction of the bounding-box diagonal (a power of two)
  /// before welding. 0: only equal vertices are welded. 2^-20 welds nearly coincident vertices.
  double snap = 0.0;
  /// Find crossing triangles (the only step that is not linear; 0.3 s at 100k triangles).
  bool count_self_intersections = true;
};

/// A surface without equal vertices, unused vertices and triangles without area. It still contains
/// duplicate and crossing triangles, because these contribute to the winding number.
struct RepairedSurface
{
  Points points;
  Triangles triangles;
  std::vector<Index> original_vertices; ///< #V: the lowest input id of the welded vertices
  std::vector<Index> original_triangles; ///< #F: input ids
  /// #input V: the lowest input id welded with the vertex, usually its own.
  std::vector<Index> lowest_equal;
  /// Triangles of closed components that are inside out, ascending, each with the number of its
  /// component, from 0 to found.inward_components - 1.
  std::vector<std::pair<Index, Index>> inward_triangles;
  SurfaceDiagnosis found; ///< defects of the input, before any triangle was turned
  Index turned_triangles = 0; ///< turned to agree with their neighbors
  Index turned_components = 0; ///< closed components that were inside out
  std::vector<std::pair<Index, Index>> crossings; ///< pairs of triangles of this surface
  bool closed = false; ///< found.closed after triangles were turned

  /// Report whether TetGen accepts the surface: it is not flat, has no crossings and no duplicates,
  /// and is closed, also after degenerate triangles were removed.
  bool clean() const
  {
    return this->closed && this->found.self_intersections == 0 &&
      this->found.duplicate_triangles == 0 && !this->found.flat;
  }
};

/// Diagnose and clean up a surface. Return invalid_input for ids out of range and coordinates that
/// are not finite, with the first such id or coordinate. Vertices are never added, and they are
/// moved only by snap. O(n log n).
Status repair_surface(PointsView points, TrianglesView triangles, const RepairOptions& options,
  RepairedSurface& repaired, ExecutionContext& context);

/// Compute only the diagnosis, as printed by `bindpose info`.
Status diagnose_surface(PointsView points, TrianglesView triangles, SurfaceDiagnosis& diagnosis,
  ExecutionContext& context);

} // namespace bindpose

#endif
