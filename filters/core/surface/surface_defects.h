#ifndef bindpose_surface_surface_defects_h
#define bindpose_surface_surface_defects_h

#include "surface/surface_repair.h"

#include <vector>

namespace bindpose
{

/// What can be unclean about a surface, in the order of what it is seen at: a vertex, an edge, a
/// triangle. The order is the one of the array `Defect`.
enum class Defect
{
  duplicate_vertex, ///< equal to a vertex of lower id
  unreferenced_vertex,
  boundary_edge, ///< of one triangle
  nonmanifold_edge, ///< of three triangles or more
  misoriented_edge, ///< of two triangles that run the same way
  degenerate_triangle, ///< no area
  duplicate_triangle, ///< the vertices of a triangle of lower id
  self_intersection, ///< meets another triangle beyond what they share
  inward_component ///< triangle of a closed component that is inside out
};
constexpr int defect_kinds = 9;

/// "duplicate vertex", …
const char* to_string(Defect defect);

/// One place where a surface is unclean.
struct DefectPlace
{
  Defect defect;
  std::vector<Index> vertices; ///< 1, 2 or 3 ids of the input
  Index triangle = -1; ///< of the input, where it is one
  Index crossed = -1; ///< self_intersection: the triangle of lowest id that it meets
  Index component = -1; ///< from 0; -1 for what belongs to none
  Index inward = -1; ///< inward_component: the number of that component, from 0
};

/// Every place that `repaired.found` counts, sorted by defect, then by id. Edges run between the
/// lowest ids of welded vertices. `points` and `triangles` are the surface that was repaired.
/// O(n log n); a triangle that crosses several others is one place.
std::vector<DefectPlace> list_defects(
  PointsView points, TrianglesView triangles, const RepairedSurface& repaired);

} // namespace bindpose

#endif
