#ifndef bindpose_posing_tet_anchors_h
#define bindpose_posing_tet_anchors_h

#include "base/mesh.h"

#include <array>
#include <vector>

namespace bindpose
{

/// Where a surface's points lie in tets, so that they follow these: a point that is one of their
/// vertices, bit by bit, takes its place; others move with the tet that holds them or is nearest.
class TetAnchors
{
public:
  TetAnchors() = default;
  TetAnchors(PointsView surface, PointsView tet_points, TetsView tets);

  /// Of each of the surface's points the vertex of its tet that has the greatest share in it.
  std::vector<Index> nearest_vertices() const;

  /// The surface's points when the tets' are moved.
  void move(PointsView surface, PointsView tet_points, PointsView moved, Points& posed) const;

private:
  struct Anchor
  {
    std::array<Index, 4> vertices;
    std::array<double, 4> shares; ///< barycentric; 1, 0, 0, 0 on a vertex
  };
  std::vector<Anchor> anchors_;
};

} // namespace bindpose

#endif
