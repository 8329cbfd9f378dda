#ifndef bindpose_surface_surface_repair_h
#define bindpose_surface_surface_repair_h

#include "base/execution.h"
#include "geometry/mesh.h"

#include <utility>
#include <vector>

namespace bindpose
{

/// Numbers of the defects of a surface. Edges, components and crossings are counted after equal
/// vertices are welded and triangles with area zero are removed. Otherwise, all edges would be
/// boundary edges in files that repeat the corners of every triangle (STL).
struct SurfaceDiagnosis
{
  Index vertices = 0; ///< number of input vertices
  Index triangles = 0; ///< number of input triangles
  /// Number of used vertices with the coordinates of a vertex of lower id.
  Index duplicate_vertices = 0;
  Index unreferenced_vertices = 0;
  /// number of triangles whose three points are collinear (exact test)
  Index degenerate_triangles = 0;
  /// Number of triangles with the vertices of a triangle of lower id, in any order.
  Index duplicate_triangles = 0;
  Index boundary_edges = 0; ///< number of edges used by one triangle
  Index nonmanifold_edges = 0; ///< number of edges used by three triangles or more
  Index misoriented_edges = 0; ///< number of edges used by two triangles in the same direction
  Index components = 0; ///< number of sets of triangles that are connected by vertices
  /// Number of closed components of negative volume that are not inside another component.
  Index inward_components = 0;
  /// Number of pairs of triangles that intersect outside of their shared vertices and edges.
  Index self_intersections = 0;
  Index crossing_triangles = 0; ///< number of triangles in the pairs of self_intersections
  /// True if, at every edge, equally many triangles use the edge in both directions. Winding
  /// numbers are then integers.
  bool closed = false;
  bool flat = false; ///< true if all points are coplanar (exact test)
};

/// Add the numbers to a report: counts.vertices, counts.triangles, counts.boundary_edges, ….
void add_to_report(const SurfaceDiagnosis& diagnosis, Report& report);

/// Options of repair_surface().
struct RepairOptions
{
  /// Flip triangles so that neighbors have consistent orientations (in each patch, the part with
  /// the smaller area is flipped). Then flip closed components that are inside out, together with
  /// everything inside them. If false, no triangle is flipped.
  bool orient = true;
  /// Before welding, round vertices to a grid. The grid spacing is the power of two that is nearest
  /// to this fraction of the bounding-box diagonal. 2^-20 welds nearly coincident vertices. 0: weld
  /// only equal vertices.
  double snap = 0.0;
  /// Find crossing triangles (the slowest operation; 0.3 s at 100k triangles).
  bool count_self_intersections = true;
};

/// A surface without equal vertices, unused vertices or triangles of area zero. Duplicate and
/// crossing triangles are kept, because they contribute to the winding number.
struct RepairedSurface
{
  Points points;
  Triangles triangles;
  std::vector<Index> original_vertices; ///< #V: the lowest input id of the welded vertices
  std::vector<Index> original_triangles; ///< #F: input ids of the triangles
  /// Per input vertex: lowest id of the input vertices that are welded with it, usually its own id.
  std::vector<Index> representative_of_vertex;
  /// Pairs (triangle, component) for all triangles of closed components that are inside out,
  /// ascending. Components are numbered from 0 to found.inward_components - 1.
  std::vector<std::pair<Index, Index>> inward_triangles;
  SurfaceDiagnosis found; ///< defects of the input, before any triangle was flipped
  Index flipped_triangles = 0; ///< number of triangles flipped to agree with their neighbors
  Index flipped_components = 0; ///< number of closed components that were inside out
  std::vector<std::pair<Index, Index>> crossings; ///< pairs of crossing triangles of this surface
  bool closed = false; ///< value of found.closed after triangles were flipped

  /// Report whether the surface is valid input for TetGen: it is not flat, has no crossings and no
  /// duplicates, and is closed after degenerate triangles were removed.
  bool is_clean() const
  {
    return this->closed && this->found.self_intersections == 0 &&
      this->found.duplicate_triangles == 0 && !this->found.flat;
  }
};

/// Diagnose and clean up a surface. Return invalid_input if an id is out of range or a coordinate
/// is not finite, naming the first such id or coordinate. Vertices are never added, and they are
/// moved only by the option `snap`. Cost: O(n log n).
Status repair_surface(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const RepairOptions& options, RepairedSurface& repaired);

/// Find the crossing triangles of a surface that was repaired without count_self_intersections.
/// @return canceled, with no crossings counted, if the context was canceled
Status find_self_intersections(ExecutionContext& context, RepairedSurface& repaired);

} // namespace bindpose

#endif
