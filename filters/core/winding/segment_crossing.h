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

/// Classify how the segment from p to r crosses a triangle, by signs of volumes in doubles. The
/// result is `unclear` if round-off could have changed a sign. This includes segments that meet an
/// edge, and segments that begin or end in the plane of the triangle.
Crossing crossing(const Vec3& p, const Vec3& r, const std::array<Vec3, 3>& corners);

} // namespace bindpose

#endif
