#include "gltf_edit/gltf_pose_error.h"

#include <algorithm>

namespace bindpose
{

namespace
{
using Transforms = std::vector<Eigen::Affine3d>;

/// Return the rest-to-pose maps of all joints, followed by the identity for the joint "rest".
Transforms rest_to_pose_maps(const std::vector<GltfJoint>& joints, const Transforms& posed)
{
  Transforms maps;
  for (std::size_t j = 0; j < joints.size(); ++j)
  {
    maps.push_back(posed[j] * joints[j].rest.inverse());
  }
  maps.push_back(Eigen::Affine3d::Identity());
  return maps;
}

Vec3 moved(const Transforms& maps, const Vec3& p, const double* weights, Index joints)
{
  Vec3 result = p;
  for (Index j = 0; j < joints; ++j)
  {
    if (weights[j] != 0.0)
    {
      result += weights[j] * (maps[j] * p - p);
    }
  }
  return result;
}

Vec3 moved(const Transforms& maps, const Vec3& p, const GltfWeights& packed, Index v)
{
  Vec3 result = p;
  for (Index k = v * packed.weights_per_vertex; k < (v + 1) * packed.weights_per_vertex; ++k)
  {
    result += static_cast<double>(packed.weights[k]) * (maps[packed.joints[k]] * p - p);
  }
  return result;
}
} // namespace

double largest_pose_error(const GltfStoredSkin& skin, const Transforms& exact_maps,
  const Transforms& stored_maps, const Points& exact_points)
{
  const Transforms right = rest_to_pose_maps(skin.joints, exact_maps);
  const Transforms in_file = rest_to_pose_maps(skin.joints, stored_maps);
  const auto joints = static_cast<Index>(skin.joints.size());
  double largest = 0.0;
  for (Index v = 0; v < skin.points.rows(); ++v)
  {
    const Vec3 p = skin.points.row(v);
    const Vec3 to = exact_points.rows() > 0
      ? Vec3(exact_points.row(v))
      : moved(right, p, skin.weights.data() + v * joints, joints);
    largest = std::max(largest, (moved(in_file, p, skin.stored_weights, v) - to).norm());
  }
  return largest;
}

} // namespace bindpose
