#ifndef bindpose_base_point_order_h
#define bindpose_base_point_order_h

#include "base/mesh.h"

#include <cstdint>
#include <vector>

namespace bindpose
{

/// The places 0 … #points - 1 in an order in which those that follow each other lie near each
/// other: what one point needs from memory is there for the next. Points that are not finite come
/// somewhere. Cost: a few nanoseconds a point.
std::vector<std::int32_t> order_by_place(const std::vector<Vec3>& points);

} // namespace bindpose

#endif
