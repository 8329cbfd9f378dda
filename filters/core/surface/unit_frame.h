#ifndef bindpose_surface_unit_frame_h
#define bindpose_surface_unit_frame_h

#include "base/mesh.h"

namespace bindpose
{

/// Where a surface's box has its centre at the origin and a diagonal from 1 to 2, for programs that
/// know absolute tolerances or lose digits far from the origin. The scale is a power of two: no
/// digits are lost by it.
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

/// invalid_input unless the surface has triangles, is finite, its ids are in range, and its box has
/// a diagonal above 0 and below 1e100.
Status check_frame(PointsView points, TrianglesView triangles);

} // namespace bindpose

#endif
