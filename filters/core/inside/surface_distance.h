#ifndef bindpose_inside_surface_distance_h
#define bindpose_inside_surface_distance_h

#include "inside/region_boundary.h"

namespace bindpose
{

/// How far two surfaces are from each other.
struct SurfaceDistance
{
  double maximum = 0.0; ///< infinity when one of them is empty
  double mean = 0.0; ///< by area, of the direction in which it is larger
  Index samples = 0;
};

/// Distances between the boundary of tets and the surface, where that bounds the region: from the
/// surface's vertices and centres of triangles to the boundary, and back from the boundary's,
/// except where the surface has a hole and the boundary is a lid over it: where the region ends at
/// no triangle. Parts of the region that the tets lack, and of the tets outside of it, count. Cost
/// about 10 us a sample.
/// @return false when cancelled.
bool measure_distance(const TetMesh& mesh, const RegionBoundary& region, SurfaceDistance& distance,
  ExecutionContext& context);

} // namespace bindpose

#endif
