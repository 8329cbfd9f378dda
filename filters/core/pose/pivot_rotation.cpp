// Fit of one rotation to a whole pose (rotation_fit.h). The covariance is a sum over the
// constrained pivots and tails, and over the transforms of handles in mode full.
#include "pose/pivot_rotation.h"

#include "pose/rotation_fit.h"

#include <algorithm>

namespace bindpose
{

Eigen::Matrix3d pivot_rotation(const Handles& handles, const Pose& pose, double pivot_radius)
{
  Vec3 rest_mean = Vec3::Zero(), posed_mean = Vec3::Zero();
  std::vector<std::pair<Vec3, Vec3>> pivots;
  Eigen::Matrix3d s = Eigen::Matrix3d::Zero();
  for (std::size_t h = 0; h < pose.size(); ++h)
  {
    if (constrains_transform(pose[h].mode) || constrains_pivot(pose[h].mode))
    {
      pivots.emplace_back(handles[h].head, posed_pivot(handles[h], pose[h]));
      rest_mean += pivots.back().first;
      posed_mean += pivots.back().second;
    }
    if (constrains_tail(pose[h].mode))
    {
      pivots.emplace_back(handles[h].tail, posed_tail(handles[h], pose[h]));
      rest_mean += pivots.back().first;
      posed_mean += pivots.back().second;
    }
    if (constrains_transform(pose[h].mode))
    {
      s += pivot_radius * pivot_radius * pose[h].transform.leftCols<3>().transpose();
    }
  }
  const double count = std::max<double>(1.0, static_cast<double>(pivots.size()));
  for (const auto& [rest, posed] : pivots)
  {
    s += (rest - rest_mean / count) * (posed - posed_mean / count).transpose();
  }
  Eigen::Matrix3d global_rotation = Eigen::Matrix3d::Identity();
  fit_rotation(s, global_rotation);
  return global_rotation;
}

} // namespace bindpose
