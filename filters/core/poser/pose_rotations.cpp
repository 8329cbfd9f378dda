#include "poser/pose_rotations.h"

#include "poser/tet_anchors.h"

namespace bindpose
{

namespace
{
std::vector<Index> groups_on_surface(
  const PoseSource& source, const RotationGroups& groups, bool in_tets)
{
  // groups.of_vertex is empty if full ARAP groups elements instead of vertices.
  if (!in_tets || groups.of_vertex.empty())
  {
    return groups.of_vertex;
  }
  std::vector<Index> of_point =
    TetAnchors(source.points, source.tet_points, source.tets).nearest_vertices();
  for (Index& each : of_point)
  {
    each = groups.of_vertex[static_cast<std::size_t>(each)];
  }
  return of_point;
}
} // namespace

void take_rotations(const PoseSource& source, const RotationGroups& groups,
  const std::vector<Eigen::Matrix3d>& rotations, bool in_tets, PoseRotations& taken)
{
  if (!taken.of_point)
  {
    taken.of_point =
      std::make_shared<const std::vector<Index>>(groups_on_surface(source, groups, in_tets));
  }
  taken.rotations = rotations;
}

} // namespace bindpose
