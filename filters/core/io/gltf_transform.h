#ifndef bindpose_io_gltf_transform_h
#define bindpose_io_gltf_transform_h

#include "base/mesh.h"

namespace bindpose
{

/// x -> translation + rotation * (scale .* x): what a node of glTF holds.
struct Trs
{
  Vec3 translation = Vec3::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Vec3 scale = Vec3::Ones();

  Eigen::Affine3d affine() const;
};

/// The translation, the rotation of the polar decomposition M = R P and the diagonal of P: the map
/// itself when it has no shear in its own axes. A mirrored map keeps its sign in the scales.
Trs nearest_trs(const Eigen::Affine3d& map);

} // namespace bindpose

#endif
