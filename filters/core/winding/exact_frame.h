#ifndef bindpose_winding_exact_frame_h
#define bindpose_winding_exact_frame_h

#include "geometry/mesh.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

/// Transform x -> (x - shift) * scale that makes the coordinates in a box small without rounding.
///
/// Along each axis, the shift is the center of the box if the box is far from 0 compared with its
/// size, otherwise 0. In both cases the subtraction is exact (Sterbenz). The scale is a power of
/// two. Transformed coordinates have a size of about 1 and are near the origin for every unit and
/// position of the input.
struct ExactFrame
{
  Vec3 shift = Vec3::Zero();
  double scale = 1.0;
  /// Objects within this distance of each other count as touching. The tolerance is a few units in
  /// the last place of the largest coordinate (2^-49 times the coordinate), after scaling.
  double tolerance = 0.0;

  ExactFrame() = default;
  explicit ExactFrame(const Box& box)
  {
    // Halve the corners before subtracting them: the difference would overflow for a box as large
    // as the range of doubles.
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
