#ifndef bindpose_shapes_silhouette_h
#define bindpose_shapes_silhouette_h

#include "geometry/mesh.h"

#include <array>
#include <vector>

namespace bindpose
{

/// The eye that looks at a surface: at a position, or in a parallel view along a direction.
struct Eye
{
  Vec3 position = Vec3::Zero();
  Vec3 direction = -Vec3::UnitZ(); ///< viewing direction
  bool parallel = false;
};

/// Silhouette edges of a surface: edges between a triangle that faces the eye and a triangle that
/// faces away, and edges of only one triangle. The orientation of the triangles has no effect. The
/// adjacency of triangles is computed once, the silhouette edges for every pose and view.
class Silhouette
{
public:
  /// Build the adjacency. Points at the same position are treated as one point, because a drawn
  /// surface is split along sharp edges. The cost is a sort of the points and of the triangle
  /// edges.
  /// @param points     #V x 3, at rest
  /// @param triangles  #F x 3, ids of these points
  Silhouette(PointsView points, TrianglesView triangles);

  using Edge = std::array<Index, 2>; ///< point ids
  /// Find the silhouette edges. The cost is one pass over triangles and one over edges, on all
  /// cores.
  void find(PointsView points, const Eye& eye, std::vector<Edge>& edges);

private:
  struct Side // small, because all sides are read in every frame
  {
    std::array<int, 2> points;
    int triangle;
    int other; ///< triangle on the other side; -1 if there is none
    /// True if both triangles traverse the edge in the same direction, so their orientations
    /// differ.
    bool same_direction;
  };
  TrianglesView triangles_;
  std::vector<Side> sides_;
  std::vector<signed char> facing_; ///< temporary: whether each triangle faces the eye
};

} // namespace bindpose

#endif
