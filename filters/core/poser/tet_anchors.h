#ifndef bindpose_poser_tet_anchors_h
#define bindpose_poser_tet_anchors_h

#include "geometry/mesh.h"

#include <array>
#include <vector>

namespace bindpose
{

/// Positions of a surface's points relative to tets, so that the surface can move with the tets. A
/// point that is identical to a tet's vertex moves with that vertex, bit for bit. Any other point
/// moves with the tet that contains it or is nearest to it.
class TetAnchors
{
public:
  TetAnchors() = default;
  TetAnchors(PointsView surface, PointsView tet_points, TetsView tets);

  /// Return, for each surface point, the vertex of its tet with the largest barycentric coordinate.
  std::vector<Index> nearest_vertices() const;

  /// Compute the surface's points for moved tet points.
  void move(PointsView surface, PointsView tet_points, PointsView moved, Points& posed) const;

private:
  /// A tet and the position of a surface point relative to it. If the point is identical to a
  /// vertex of the tet, vertices[0] is this vertex, and the coordinates are 1, 0, 0, 0.
  struct Anchor
  {
    std::array<Index, 4> vertices;
    std::array<double, 4> coordinates; ///< barycentric coordinates of the point
  };
  std::vector<Anchor> anchors_;
};

} // namespace bindpose

#endif
