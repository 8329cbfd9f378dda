#ifndef bindpose_surface_surface_defects_h
#define bindpose_surface_surface_defects_h

#include "surface/surface_repair.h"

#include <vector>

namespace bindpose
{

/// Types of defects of a surface, ordered by the element at which they occur: a vertex, an edge, a
/// triangle. The array `Defect` uses the same order.
enum class Defect
{
  duplicate_vertex, ///< equal to a vertex of lower id
  unreferenced_vertex,
  boundary_edge, ///< used by one triangle
  nonmanifold_edge, ///< used by three triangles or more
  misoriented_edge, ///< used by two triangles with the same direction
  degenerate_triangle, ///< no area
  duplicate_triangle, ///< has the vertices of a triangle of lower id
  self_intersection, ///< meets another triangle beyond their shared vertices and edges
  inward_component ///< triangle of a closed component that is inside out
};
constexpr int defect_kinds = 9;

/// Return "duplicate vertex", ….
const char* to_string(Defect defect);

/// One occurrence of a defect.
struct DefectPlace
{
  Defect defect;
  std::vector<Index> vertices; ///< 1, 2 or 3 vertex ids of the input
  Index triangle = -1; ///< input id, if the defect is a triangle
  Index crossed = -1; ///< self_intersection: the triangle of lowest id that it meets
  Index component = -1; ///< from 0; -1 if the defect belongs to no component
  Index inward = -1; ///< inward_component: the number of that component, from 0
};

/// List every defect that `repaired.found` counts, sorted by type, then by id. Edges connect the
/// lowest ids of welded vertices. `points` and `triangles` are the surface that was repaired. O(n
/// log n). A triangle that crosses several others is listed once.
std::vector<DefectPlace> list_defects(
  PointsView points, TrianglesView triangles, const RepairedSurface& repaired);

} // namespace bindpose

#endif
