#ifndef bindpose_weights_bone_projection_h
#define bindpose_weights_bone_projection_h

#include "base/mesh.h"

#include <algorithm>

namespace bindpose
{

/// Where a point is along a bone: 0 up to the head, 1 from the tail on, between them its
/// projection. 0 for a bone without length.
inline double projected_endpoint(const Vec3& point, const Vec3& head, const Vec3& vector)
{
  const double length = vector.stableNorm();
  return length > 0.0 ? std::clamp((point - head).dot(vector / length) / length, 0.0, 1.0) : 0.0;
}

} // namespace bindpose

#endif
