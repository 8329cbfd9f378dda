#include "poser/pose_rotations.h"

#include "poser/tet_anchors.h"

namespace bindpose
{

namespace
{
std::vector<Index> groups_on_surface(
  const PoseSource& source, const RotationGroups& groups, bool in_tets)
{
  // groups.group_of_vertex is empty if full ARAP groups elements instead of vertices.
  if (!in_tets || groups.group_of_vertex.empty())
  {
    return groups.group_of_vertex;
  }
  std::vector<Index> cluster_of_point =
    TetAnchors(source.points, source.tet_points, source.tets).nearest_vertices();
  for (Index& each : cluster_of_point)
  {
    each = groups.group_of_vertex[static_cast<std::size_t>(each)];
  }
  return cluster_of_point;
}
} // namespace

void update_rotations(const PoseSource& source, const RotationGroups& groups,
  const std::vector<Eigen::Matrix3d>& rotations, bool in_tets, PoseRotations& pose_rotations)
{
  if (!pose_rotations.cluster_of_point)
  {
    pose_rotations.cluster_of_point =
      std::make_shared<const std::vector<Index>>(groups_on_surface(source, groups, in_tets));
  }
  pose_rotations.rotations = rotations;
}

} // namespace bindpose
