#ifndef bindpose_winding_exact_frame_h
#define bindpose_winding_exact_frame_h

#include "base/mesh.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

/// What makes the coordinates of a box's content small without rounding: x -> (x - shift) * scale.
///
/// Shifted by the box's centre along each axis only where the box lies far from 0 compared with its
/// size (there the subtraction is exact: Sterbenz), and scaled by a power of two. So what is given
/// is looked at as it is, of size about 1 and near the origin, whatever its units and place.
struct ExactFrame
{
  Vec3 shift = Vec3::Zero();
  double scale = 1.0;
  /// What lies within this distance touches: a few units in the last place of the largest
  /// coordinate (2^-49 of it), after scaling.
  double tolerance = 0.0;

  ExactFrame() = default;
  explicit ExactFrame(const Box& box)
  {
    // Halves before differences: these would overflow in a box as large as doubles are.
    const Vec3 half = 0.5 * box.upper - 0.5 * box.lower;
    const Vec3 center = box.lower + half;
    for (int k = 0; k < 3; ++k)
    {
      this->shift[k] = std::abs(center[k]) > 2.0 * half[k] ? center[k] : 0.0;
    }
    const double largest =
      std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
    const double radius = half.maxCoeff();
    if (radius > 0.0)
    {
      constexpr int largest_exponent = 1023;
      this->scale = std::ldexp(1.0, std::min(-std::ilogb(radius), largest_exponent));
    }
    this->tolerance = largest * this->scale * 0x1.0p-49;
  }
  Vec3 operator()(const Vec3& p) const { return (p - this->shift) * this->scale; }
};

} // namespace bindpose

#endif
