#ifndef bindpose_scene_silhouette_h
#define bindpose_scene_silhouette_h

#include "base/mesh.h"

#include <array>
#include <vector>

namespace bindpose
{

/// Who looks at a surface: from a place, or in a parallel view along a direction.
struct Eye
{
  Vec3 place = Vec3::Zero();
  Vec3 direction = -Vec3::UnitZ(); ///< of sight
  bool parallel = false;
};

/// Where a surface turns away from the eye: its edges between a triangle that faces the eye and one
/// that does not, whichever way triangles are turned, and the edges of one triangle only. Which
/// triangles meet is found once, the edges anew for every pose and view.
class Silhouette
{
public:
  /// Points at the same place are one, so that what is drawn may be parted along sharp edges.
  /// Cost: a sort of the points and of the triangles' sides.
  /// @param points     #V x 3, at rest
  /// @param triangles  #F x 3, of these points
  Silhouette(PointsView points, TrianglesView triangles);

  using Edge = std::array<Index, 2>; ///< points
  /// Cost: one pass over triangles, one over edges, on all cores.
  void find(PointsView points, const Eye& eye, std::vector<Edge>& edges);

private:
  struct Side // small: all of them are read for every frame
  {
    std::array<int, 2> points;
    int triangle;
    int other; ///< -1: none
    bool same_way; ///< both run along it in the same direction: one of them is turned over
  };
  TrianglesView triangles_;
  std::vector<Side> sides_;
  std::vector<signed char> facing_; ///< scratch, of each triangle
};

} // namespace bindpose

#endif
