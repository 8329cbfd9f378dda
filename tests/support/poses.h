#ifndef bindpose_tests_support_poses_h
#define bindpose_tests_support_poses_h

// Artificial weights and poses.

#include "handles/handles.h"
#include "pose/pose.h"

#include <Eigen/Geometry>

namespace bindpose::test
{

/// Return weights that decrease with the distance from the centers of the handles.
inline Weights distance_weights(const Points& points, const Handles& handles)
{
  Weights weights(points.rows(), static_cast<Index>(handles.size()));
  for (Index v = 0; v < points.rows(); ++v)
  {
    for (Index j = 0; j < weights.cols(); ++j)
    {
      const Handle& handle = handles[static_cast<std::size_t>(j)];
      const Vec3 middle = 0.5 * (handle.head + handle.tail);
      weights(v, j) = 1.0 / (1e-3 + (points.row(v).transpose() - middle).squaredNorm());
    }
    weights.row(v) /= weights.row(v).sum();
  }
  return weights;
}

/// Return a pose that bends, rotates, stretches and twists the shape.
inline Pose some_pose(const Handles& handles, double amount = 1.0)
{
  Pose pose(handles.size());
  for (std::size_t k = 0; k < pose.size(); ++k)
  {
    const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.4 * amount * static_cast<double>(k + 1), Vec3(0.3, 1, 0.2).normalized())
        .toRotationMatrix();
    pose[k].transform.leftCols<3>() = turn;
    pose[k].transform.col(3) = handles[k].head - turn * handles[k].head +
      amount * Vec3(0.1, 0.2 * static_cast<double>(k), 0);
    if (handles[k].kind == HandleKind::bone)
    {
      pose[k].stretch = 1.0 + 0.2 * amount;
      pose[k].twist = Eigen::Vector2d(0, 40.0 * amount);
    }
  }
  return pose;
}

} // namespace bindpose::test

#endif
