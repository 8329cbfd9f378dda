#ifndef bindpose_inside_surface_distance_h
#define bindpose_inside_surface_distance_h

#include "segmentation/region_boundary.h"

namespace bindpose
{

/// Distance between two surfaces.
struct SurfaceDistance
{
  double maximum = 0.0; ///< largest distance; infinity if one of the surfaces is empty
  /// Area-weighted mean distance, the larger of the values of the two directions.
  double mean = 0.0;
  Index samples = 0;
};

/// Measure the distances between the boundary of tets and the part of the surface that bounds the
/// region. Distances are measured from the vertices and triangle centers of the surface to the
/// boundary, and vice versa. Parts of the boundary that close a hole of the surface are excluded;
/// there, the region ends without a triangle. Parts of the region without tets, and tets outside
/// the region, increase the distances. Cost: about 10 us per sample.
/// @return false if canceled.
bool measure_distance(ExecutionContext& context, const TetMesh& mesh, const RegionBoundary& region,
  SurfaceDistance& distance);

} // namespace bindpose

#endif
