#ifndef bindpose_geometry_point_order_h
#define bindpose_geometry_point_order_h

#include "geometry/mesh.h"

#include <cstdint>
#include <vector>

namespace bindpose
{

/// Return the indices 0 … #points - 1 in a spatial order: consecutive points are near each other,
/// so that data loaded for one point is in the cache for the next. Points that are not finite can
/// be anywhere in the order. Cost: a few nanoseconds per point.
std::vector<std::int32_t> spatial_sort(const std::vector<Vec3>& points);

} // namespace bindpose

#endif
