#ifndef screen_view_h
#define screen_view_h

#include <Eigen/Core>
#include <Eigen/LU>

class vtkRenderer;

namespace bindpose
{

/// The ray from the eye through a pixel of the window.
struct Ray
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< start of the ray, in the near plane
  /// Direction of the ray: unit vector, away from the eye.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
};

/// A renderer's camera at one moment. It maps world positions to the screen and back. The camera is
/// read once, so that each of hundreds of positions costs only a small matrix product.
class ScreenView
{
public:
  explicit ScreenView(vtkRenderer* renderer);

  /// Return display coordinates in pixels, from the window's lower left corner; z is the depth, 0
  /// near to 1 far.
  Eigen::Vector3d to_display(const Eigen::Vector3d& world) const;
  Ray ray(const Eigen::Vector2d& display) const;
  /// Return the world length of a pixel at a position; 0 behind the eye.
  double pixel_length_at(const Eigen::Vector3d& position) const;
  /// Return the unit vector from the eye to a position.
  Eigen::Vector3d direction_to(const Eigen::Vector3d& position) const;

  const Eigen::Vector3d& forward() const { return this->forward_; }
  const Eigen::Vector3d& right() const { return this->right_; }
  const Eigen::Vector3d& up() const { return this->up_; }

private:
  Eigen::Matrix4d to_clip_;
  Eigen::Matrix4d from_clip_;
  Eigen::Vector2d lower_; // display coordinates of the viewport's corners: lower left, upper right
  Eigen::Vector2d upper_;
  Eigen::Vector3d eye_;
  Eigen::Vector3d forward_;
  Eigen::Vector3d right_;
  Eigen::Vector3d up_;
  bool parallel_ = false;
  // world length of a pixel; in a perspective view, at distance 1 from the eye
  double pixel_slope_ = 0.0;
};

/// Intersect a ray with a plane. Return false if there is no intersection in front of the ray's
/// origin.
bool intersect_plane(const Ray& ray, const Eigen::Vector3d& position, const Eigen::Vector3d& normal,
  Eigen::Vector3d& hit);

} // namespace bindpose

#endif
