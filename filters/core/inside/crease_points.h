#ifndef bindpose_inside_crease_points_h
#define bindpose_inside_crease_points_h

#include "inside/region_boundary.h"
#include "inside/sizing_field.h"

namespace bindpose
{

/// Points by which a mesher finds a surface's sharp edges again.
struct CreasePoints
{
  std::vector<Index> corners; ///< input vertices where creases end, meet or turn
  std::vector<Index> vertices; ///< other input vertices on creases
  Points between; ///< points on crease edges longer than the sizing field wants, evenly spaced
};

/// Creases are edges at which the surface turns by more than `angle` degrees or is open or
/// non-manifold, as far as they bound the region. Ids ascend.
CreasePoints find_creases(
  const RegionBoundary& region, const SizingField& field, double angle = 30.0);

} // namespace bindpose

#endif
