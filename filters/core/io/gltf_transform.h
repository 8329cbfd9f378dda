#ifndef bindpose_io_gltf_transform_h
#define bindpose_io_gltf_transform_h

#include "base/mesh.h"

namespace bindpose
{

/// The map x -> translation + rotation * (scale .* x) of a glTF node.
struct Trs
{
  Vec3 translation = Vec3::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Vec3 scale = Vec3::Ones();

  Eigen::Affine3d affine() const;
};

/// Return the translation, the rotation of the polar decomposition M = R P and the diagonal of P.
/// The result equals the map if the map has no shear in its own axes. If the map mirrors, the
/// scales are negative.
Trs nearest_trs(const Eigen::Affine3d& map);

} // namespace bindpose

#endif
