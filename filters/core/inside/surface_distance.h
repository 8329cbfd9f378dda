#ifndef bindpose_inside_surface_distance_h
#define bindpose_inside_surface_distance_h

#include "inside/region_boundary.h"

namespace bindpose
{

/// Distance between two surfaces.
struct SurfaceDistance
{
  double maximum = 0.0; ///< infinity if one of the surfaces is empty
  double mean = 0.0; ///< area-weighted mean; the maximum over the two directions
  Index samples = 0;
};

/// Measure the distances between the boundary of tets and the part of the surface that bounds the
/// region. They are measured from the vertices and triangle centers of the surface to the boundary,
/// and vice versa. Parts of the boundary that close a hole of the surface are excluded: there is no
/// triangle at the end of the region. Parts of the region without tets, and tets outside the
/// region, increase the distances. Cost: about 10 us per sample.
/// @return false if canceled.
bool measure_distance(const TetMesh& mesh, const RegionBoundary& region, SurfaceDistance& distance,
  ExecutionContext& context);

} // namespace bindpose

#endif
