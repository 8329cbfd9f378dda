// Decomposition of affine maps for glTF nodes (see gltf_transform.h).
#include "gltf/gltf_transform.h"

#include <Eigen/SVD>

namespace bindpose
{

Eigen::Affine3d Trs::affine() const
{
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.linear() = this->rotation.toRotationMatrix() * this->scale.asDiagonal();
  map.translation() = this->translation;
  return map;
}

Trs nearest_trs(const Eigen::Affine3d& map)
{
  Trs result;
  result.translation = map.translation();
  const Eigen::Matrix3d linear = map.linear();
  // The linear part is M = R P with a positive definite P. If M mirrors, decompose -M instead.
  const double sign = linear.determinant() < 0.0 ? -1.0 : 1.0;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
    sign * linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d rotation = svd.matrixU() * svd.matrixV().transpose();
  // The decomposed matrix U S V^T has no negative determinant. Therefore det(U V^T) is negative
  // only if the smallest singular value is zero. The sign of the last column of U is then
  // arbitrary.
  if (rotation.determinant() < 0.0)
  {
    Eigen::Matrix3d u = svd.matrixU();
    u.col(2) *= -1.0;
    rotation = u * svd.matrixV().transpose();
  }
  result.rotation = Eigen::Quaterniond(rotation).normalized();
  result.scale = (rotation.transpose() * linear).diagonal();
  return result;
}

} // namespace bindpose
