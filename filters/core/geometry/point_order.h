#ifndef bindpose_geometry_point_order_h
#define bindpose_geometry_point_order_h

#include "geometry/mesh.h"

#include <cstdint>
#include <vector>

namespace bindpose
{

/// Return the indices 0 … #points - 1 in a spatial order: consecutive points are near each other,
/// so that data loaded for one point is in the cache for the next. The positions of points that are
/// not finite are unspecified. Cost: a few nanoseconds per point.
std::vector<std::int32_t> spatial_sort(const std::vector<Vec3>& points);

} // namespace bindpose

#endif
