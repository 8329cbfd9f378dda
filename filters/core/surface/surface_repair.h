#ifndef bindpose_surface_surface_repair_h
#define bindpose_surface_surface_repair_h

#include "base/execution.h"
#include "base/mesh.h"

#include <utility>
#include <vector>

namespace bindpose
{

/// What is unclean about a surface. Edges, components and crossings are those of the surface with
/// equal vertices welded and triangles of no area left out, so that files that repeat the corners
/// of every triangle (STL) are not all boundary.
struct SurfaceDiagnosis
{
  Index vertices = 0; ///< of the input
  Index triangles = 0; ///< of the input
  Index duplicate_vertices = 0; ///< equal to a vertex of lower id, used ones only
  Index unreferenced_vertices = 0;
  Index degenerate_triangles = 0; ///< their three points lie on one line, exactly
  Index duplicate_triangles = 0; ///< same vertices as a triangle of lower id, in any order
  Index boundary_edges = 0; ///< used by one triangle
  Index nonmanifold_edges = 0; ///< used by three triangles or more
  Index misoriented_edges = 0; ///< used by two triangles that run the same way
  Index components = 0; ///< connected by vertices
  Index inward_components = 0; ///< closed, not inside another one, of negative volume
  Index self_intersections = 0; ///< pairs of triangles that meet beyond what they share
  Index crossing_triangles = 0; ///< triangles of these pairs
  bool closed = false; ///< at every edge the directions cancel: winding numbers are integers
  bool flat = false; ///< all points lie in one plane, exactly
};

/// counts.vertices, counts.triangles, counts.boundary_edges, … : the documented keys.
void add_to_report(const SurfaceDiagnosis& diagnosis, Report& report);

struct RepairOptions
{
  /// Turns triangles so that neighbours agree (the smaller area of a patch gives way), then closed
  /// components that are inside out, with all that lies in them. Off: orientation stays.
  bool orient = true;
  /// Rounds vertices to a grid of about this fraction of the diagonal (a power of two) before
  /// welding; 0: only equal vertices are welded. 2^-20 rescues nearly coincident vertices.
  double snap = 0.0;
  /// Look for crossing triangles (the only step that is not linear; 0.3 s at 100k triangles).
  bool count_self_intersections = true;
};

/// A surface without equal vertices, stray vertices and triangles of no area. Duplicates and
/// crossings are still there: they count in the winding number.
struct RepairedSurface
{
  Points points;
  Triangles triangles;
  std::vector<Index> original_vertices; ///< #V: the lowest input id among the welded ones
  std::vector<Index> original_triangles; ///< #F: input ids
  std::vector<Index> lowest_equal; ///< #input V: the lowest input id welded with it, itself mostly
  /// Triangles of closed components that are inside out, ascending, and the number of that
  /// component, from 0 to found.inward_components - 1.
  std::vector<std::pair<Index, Index>> inward_triangles;
  SurfaceDiagnosis found; ///< in the input, before any triangle was turned
  Index turned_triangles = 0; ///< turned to agree with their neighbours
  Index turned_components = 0; ///< closed components turned right side out
  std::vector<std::pair<Index, Index>> crossings; ///< pairs of triangles of this surface
  bool closed = false; ///< found.closed, but after triangles were turned

  /// Closed, nothing crosses, nothing twice, no gap left by a dropped triangle: TetGen takes it.
  bool clean() const
  {
    return this->closed && this->found.self_intersections == 0 &&
      this->found.duplicate_triangles == 0 && !this->found.flat;
  }
};

/// Diagnoses and cleans up. invalid_input for ids out of range and coordinates that are not finite,
/// naming the first. Never adds or moves a vertex (but for snap). O(n log n).
Status repair_surface(PointsView points, TrianglesView triangles, const RepairOptions& options,
  RepairedSurface& repaired, ExecutionContext& context);

/// The diagnosis alone, as `bindpose info` prints it.
Status diagnose_surface(PointsView points, TrianglesView triangles, SurfaceDiagnosis& diagnosis,
  ExecutionContext& context);

} // namespace bindpose

#endif
