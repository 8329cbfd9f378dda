#ifndef bindpose_surface_unit_frame_h
#define bindpose_surface_unit_frame_h

#include "base/mesh.h"

namespace bindpose
{

/// Transforms a surface so that its box is centered at the origin and has a diagonal from 1 to 2.
/// This is for programs with absolute tolerances, or that lose digits far from the origin. The
/// scale is a power of two, so that it causes no rounding.
class UnitFrame
{
public:
  /// The box must have a diagonal above 0 and below 1e100.
  explicit UnitFrame(const Box& box);
  Points into(PointsView points) const;
  Points back(PointsView points) const;
  double length_into(double length) const { return length * this->scale_; }

private:
  Vec3 center_;
  double scale_ = 1.0;
};

/// Return invalid_input unless the surface has triangles, is finite, its ids are in range, and its
/// box has a diagonal above 0 and below 1e100.
Status check_frame(PointsView points, TrianglesView triangles);

} // namespace bindpose

#endif
