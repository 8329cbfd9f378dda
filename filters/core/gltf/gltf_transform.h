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

/// Approximate an affine map by the translation, the rotation of the polar decomposition M = R P of
/// its linear part, and the diagonal of P. The result is exact if P is diagonal; the map then has
/// no shear relative to its own axes. If the map mirrors, the scales are negative.
Trs nearest_trs(const Eigen::Affine3d& map);

} // namespace bindpose

#endif
