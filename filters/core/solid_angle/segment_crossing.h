#ifndef bindpose_solid_angle_segment_crossing_h
#define bindpose_solid_angle_segment_crossing_h

// Crossing test between a segment and a triangle in double precision. Cases that are uncertain
// because of round-off are reported as undecided.

#include "geometry/mesh.h"

#include <array>

namespace bindpose
{

/// How a segment crosses a triangle.
enum class Crossing
{
  none,
  outwards, ///< the segment crosses in the direction of the triangle's normal
  inwards,
  undecided
};

/// Classify how the segment from p to r crosses a triangle, from the signs of volumes in doubles.
/// The result is `undecided` if round-off could have changed a sign. This includes segments that
/// touch an edge and segments that begin or end in the plane of the triangle.
Crossing crossing(const Vec3& p, const Vec3& r, const std::array<Vec3, 3>& corners);

} // namespace bindpose

#endif
