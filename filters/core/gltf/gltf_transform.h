#ifndef bindpose_gltf_gltf_transform_h
#define bindpose_gltf_gltf_transform_h

#include "geometry/mesh.h"

namespace bindpose
{

/// The transform x -> translation + rotation * (scale .* x) of a glTF node.
struct Trs
{
  Vec3 translation = Vec3::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Vec3 scale = Vec3::Ones();

  Eigen::Affine3d affine() const;
};

/// Approximate an affine map by its translation, the rotation R of the polar decomposition M = R P
/// of its linear part M, and the diagonal of P. The result is exact if P is diagonal, which means
/// that the map has no shear along the node's axes. If the map mirrors, the scales are negative.
Trs nearest_trs(const Eigen::Affine3d& map);

} // namespace bindpose

#endif
