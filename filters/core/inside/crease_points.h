#ifndef bindpose_inside_crease_points_h
#define bindpose_inside_crease_points_h

#include "inside/sizing_field.h"
#include "segmentation/region_boundary.h"

namespace bindpose
{

/// Points at which a mesher needs vertices in order to reproduce the sharp edges of a surface.
struct CreasePoints
{
  std::vector<Index> corners; ///< input vertices at which creases end, branch or change direction
  std::vector<Index> vertices; ///< input vertices on creases, except corners
  /// Evenly spaced points on crease edges that are longer than the sizing field allows.
  Points edge_points;
};

/// Find the creases that bound the region. A crease is an edge that is open or non-manifold, or at
/// which the normals of its two triangles differ by more than `angle` degrees. Vertex ids are in
/// ascending order.
CreasePoints find_creases(
  const RegionBoundary& region, const SizingField& field, double angle = 30.0);

} // namespace bindpose

#endif
