#ifndef bindpose_surface_unit_frame_h
#define bindpose_surface_unit_frame_h

#include "geometry/mesh.h"

namespace bindpose
{

/// Transforms a surface so that its bounding box is centered at the origin and has a diagonal from
/// 1 to 2. The transformation is used for programs that have absolute tolerances or lose digits far
/// from the origin. The scale is a power of two, so that scaling causes no rounding.
class UnitFrame
{
public:
  /// The box must have a diagonal above 0 and below 1e100.
  explicit UnitFrame(const Box& box);
  /// Transform points into the frame.
  Points to_frame(PointsView points) const;
  /// Transform points of the frame back to the original coordinates.
  Points from_frame(PointsView points) const;
  double length_in_frame(double length) const { return length * this->scale_; }

private:
  Vec3 center_;
  double scale_ = 1.0;
};

/// Return invalid_input unless the surface has triangles, its coordinates are finite, its ids are
/// in range, and the diagonal of its bounding box is above 0 and below 1e100.
Status check_frame(PointsView points, TrianglesView triangles);

} // namespace bindpose

#endif
