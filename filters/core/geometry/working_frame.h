#ifndef bindpose_geometry_working_frame_h
#define bindpose_geometry_working_frame_h

#include "geometry/mesh.h"

#include <string>

namespace bindpose
{

/// The coordinates in which a kernel computes. Usually they are the coordinates of the input. If
/// the input is extremely large or small, the frame scales the shape to a diagonal from 1 to 2, so
/// that squares and volumes neither overflow nor underflow. If the input is far from the origin,
/// the frame scales the shape in the same way and moves it to the origin, so that differences of
/// coordinates lose no digits.
///
/// The scale is a power of two. The shape is moved along an axis only if its distance from the
/// origin along this axis is much larger than its diagonal. Therefore the points of the shape are
/// mapped to the frame and back without rounding.
class WorkingFrame
{
public:
  /// Construct the identity.
  WorkingFrame() = default;

  /// Choose the frame of a shape. The frame is the identity if the box is empty or a single point.
  /// It is also the identity if the diagonal of the box is at least 2^-100 and below 2^101, and the
  /// center of the box is at most 1,024 diagonals from the origin along each axis.
  ///
  /// Return invalid_input, with a coordinate and the id of its point, if
  /// - the diagonal is not between 1e-102 and 1e102, so the volume is not a normal number;
  /// - the shape is so far from the origin that neighboring doubles differ by more than 1e-6 of the
  ///   diagonal.
  /// @param box  the bounding box of all points that the shape uses
  /// @param subject  name of the shape in messages, for example "the surface"
  static Status choose(
    PointsView points, const Box& box, const std::string& subject, WorkingFrame& frame);

  /// Check a mesh by check_mesh(). Then choose the frame from the bounding box of the elements;
  /// points that no element uses are ignored.
  static Status choose(
    PointsView points, TrianglesView triangles, const std::string& subject, WorkingFrame& frame);
  static Status choose(
    PointsView points, TetsView tets, const std::string& subject, WorkingFrame& frame);

  bool is_identity() const { return this->scale_ == 1.0 && this->center_.isZero(0.0); }

  Vec3 point_to_frame(const Vec3& point) const { return (point - this->center_) * this->scale_; }
  Points to_frame(PointsView points) const;
  Vec3 point_from_frame(const Vec3& point) const { return point / this->scale_ + this->center_; }
  Points from_frame(PointsView points) const;

  /// Convert a length (power 1), an area (2), a volume (3) or a quantity per length (-1) between
  /// the units of the input and the units of the frame.
  double size_to_frame(double size, int power) const;
  double size_from_frame(double size, int power) const;

  /// Convert the numbers that the report stores under `key`, if any, from the units of the frame to
  /// the units of the input. `power` has the same meaning as in size_from_frame().
  void convert_report(Report& report, const std::string& key, int power) const;

  const Vec3& center() const { return this->center_; }
  double scale() const { return this->scale_; }

private:
  Vec3 center_ = Vec3::Zero();
  double scale_ = 1.0;
};

} // namespace bindpose

#endif
