#ifndef bindpose_winding_segment_crossing_h
#define bindpose_winding_segment_crossing_h

#include "base/mesh.h"

#include <array>

namespace bindpose
{

enum class Crossing
{
  none,
  outwards, ///< along the triangle's normal
  inwards,
  unclear
};

/// What the segment from p to r does with a triangle, by signs of volumes in doubles: unclear where
/// round-off could have made one of them, so also where the segment meets an edge, or p or r lies
/// in the plane.
Crossing crossing(const Vec3& p, const Vec3& r, const std::array<Vec3, 3>& corners);

} // namespace bindpose

#endif
