#ifndef bindpose_widgets_motion_about_h
#define bindpose_widgets_motion_about_h

#include <Eigen/Geometry>

namespace bindpose
{

/// Return the motion that applies a linear map and keeps a point where it is.
inline Eigen::Affine3d motion_about(const Eigen::Vector3d& fixed, const Eigen::Matrix3d& linear)
{
  Eigen::Affine3d motion;
  motion.linear() = linear;
  motion.translation() = fixed - linear * fixed;
  return motion;
}

} // namespace bindpose

#endif
