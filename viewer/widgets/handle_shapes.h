#ifndef handle_shapes_h
#define handle_shapes_h

#include "vtkSmartPointer.h"

#include <Eigen/Core>

#include <array>
#include <vector>

class vtkPolyData;

namespace bindpose
{

/// Red, green, blue in [0, 1].
using Colour = std::array<double, 3>;

/// Collects balls, bones and the parts of a gizmo into one polydata with point normals and a colour
/// per point, wound outwards: one actor draws any number of handles.
class HandleShapes
{
public:
  /// @param fine  balls of 320 triangles, else of 80 (for hundreds of handles)
  explicit HandleShapes(bool fine) : fine_(fine) {}
  /// A smooth ball.
  void add_ball(const Eigen::Vector3d& center, double radius, const Colour& colour);
  /// An elongated octahedron with flat sides, 1/8 of its length behind the head at its widest.
  /// @param half_width  distance of the four waist corners from the axis, world units
  /// @param margin      moves every corner outwards (for the outline hull), world units
  void add_bone(const Eigen::Vector3d& head, const Eigen::Vector3d& tail, double half_width,
    const Colour& colour, double margin = 0.0);

  /// A round tube along a polyline, closed at both ends; a closed one ends where it begins.
  void add_tube(const std::vector<Eigen::Vector3d>& path, double radius, const Colour& colour);
  /// A cone with its base.
  void add_cone(
    const Eigen::Vector3d& base, const Eigen::Vector3d& tip, double radius, const Colour& colour);
  /// A box with flat sides along the columns of the frame.
  void add_box(const Eigen::Vector3d& center, const Eigen::Matrix3d& frame,
    const Eigen::Vector3d& half, const Colour& colour);

  vtkSmartPointer<vtkPolyData> polydata() const;

private:
  void add_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
    const Colour& colour);
  long long add_vertex(
    const Eigen::Vector3d& place, const Eigen::Vector3d& normal, const Colour& colour);

  bool fine_;
  std::vector<float> points_;
  std::vector<float> normals_;
  std::vector<unsigned char> colours_;
  std::vector<long long> triangles_;
};

} // namespace bindpose

#endif
