#ifndef bindpose_handles_bone_projection_h
#define bindpose_handles_bone_projection_h

#include "geometry/mesh.h"

#include <algorithm>

namespace bindpose
{

/// Return the position of a point along a bone: its projection onto the bone, 0 at the head and 1
/// at the tail, clamped to [0, 1]. Return 0 for a bone without length.
inline double fraction_along_bone(const Vec3& point, const Vec3& head, const Vec3& vector)
{
  const double length = vector.stableNorm();
  return length > 0.0 ? std::clamp((point - head).dot(vector / length) / length, 0.0, 1.0) : 0.0;
}

} // namespace bindpose

#endif
