#ifndef bindpose_surface_surface_defects_h
#define bindpose_surface_surface_defects_h

#include "surface/surface_repair.h"

#include <vector>

namespace bindpose
{

/// Types of defects of a surface, sorted by the kind of element at which they occur: first
/// vertices, then edges, then triangles. The array `Defect` of the filter uses the same order.
enum class Defect
{
  duplicate_vertex, ///< vertex with the coordinates of a vertex of lower id
  unreferenced_vertex,
  boundary_edge, ///< edge used by one triangle
  nonmanifold_edge, ///< edge used by three triangles or more
  misoriented_edge, ///< edge used by two triangles in the same direction
  degenerate_triangle, ///< triangle with area zero
  duplicate_triangle, ///< triangle with the vertices of a triangle of lower id
  /// Triangle that intersects another triangle outside of their shared vertices and edges.
  self_intersection,
  inward_component ///< triangle of a closed component that is inside out
};
constexpr int defect_kinds = 9;

/// Return the name, for example "duplicate vertex".
const char* to_string(Defect defect);

/// One occurrence of a defect.
struct DefectOccurrence
{
  Defect defect;
  std::vector<Index> vertices; ///< 1, 2 or 3 vertex ids of the input
  Index triangle = -1; ///< input id of the triangle, if the defect is a triangle
  /// for self_intersection: lowest id of the triangles that `triangle` intersects
  Index crossed_triangle = -1;
  Index component = -1; ///< index of the component; -1 if the defect belongs to no component
  Index inward_index = -1; ///< for inward_component: index among the inside-out components
};

/// List every defect that is counted in `repaired.found`, sorted by type, then by id. Edges are
/// given by the lowest ids of the welded vertices. A triangle that intersects several others is
/// listed once. Cost: O(n log n).
/// @param points, triangles the surface from which `repaired` was computed.
std::vector<DefectOccurrence> list_defects(
  PointsView points, TrianglesView triangles, const RepairedSurface& repaired);

} // namespace bindpose

#endif
