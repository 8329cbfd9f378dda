#ifndef handle_shapes_h
#define handle_shapes_h

#include "vtkSmartPointer.h"

#include <Eigen/Core>

#include <array>
#include <vector>

class vtkPolyData;

namespace bindpose
{

/// A color: red, green, blue in [0, 1].
using Color = std::array<double, 3>;

/// Collects balls, bones and the parts of a gizmo in one polydata, so that one actor can draw any
/// number of handles. Each point has a color and a normal. Triangles and normals are oriented
/// outward.
class HandleShapes
{
public:
  /// @param fine  true: balls of 320 triangles; false: of 80 (for hundreds of handles)
  explicit HandleShapes(bool fine) : fine_(fine) {}
  /// Add a smooth ball.
  void add_ball(const Eigen::Vector3d& center, double radius, const Color& color);
  /// Add a bone: an elongated octahedron with flat faces. Four of its corners are at 1/8 of its
  /// length from the head.
  /// @param half_width  distance of these four corners from the axis, world units
  /// @param margin      distance by which every corner moves outward (for the outline), world units
  void add_bone(const Eigen::Vector3d& head, const Eigen::Vector3d& tail, double half_width,
    const Color& color, double margin = 0.0);

  /// Add a round tube along a polyline, with caps at both ends. A closed polyline repeats its first
  /// point at its end.
  void add_tube(const std::vector<Eigen::Vector3d>& path, double radius, const Color& color);
  /// Add a cone with its base.
  void add_cone(
    const Eigen::Vector3d& base, const Eigen::Vector3d& tip, double radius, const Color& color);
  /// Add a box with flat faces along the columns of the frame.
  void add_box(const Eigen::Vector3d& center, const Eigen::Matrix3d& frame,
    const Eigen::Vector3d& half, const Color& color);

  vtkSmartPointer<vtkPolyData> polydata() const;

private:
  void add_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
    const Color& color);
  long long add_vertex(
    const Eigen::Vector3d& position, const Eigen::Vector3d& normal, const Color& color);

  bool fine_;
  std::vector<float> points_;
  std::vector<float> normals_;
  std::vector<unsigned char> colors_;
  std::vector<long long> triangles_;
};

} // namespace bindpose

#endif
