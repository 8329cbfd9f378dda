#ifndef bindpose_winding_surface_boundary_h
#define bindpose_winding_surface_boundary_h

#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// Where a surface is open in the sense of winding numbers: the edges whose directions do not
/// cancel, and its connected parts. Winding numbers depend on this boundary alone, but for whole
/// numbers.
struct SurfaceBoundary
{
  /// Runs the way most triangles run along it.
  struct BoundaryEdge
  {
    Index from, to; ///< vertex ids
    Index multiplicity; ///< by how many triangles these are more than those the other way, 1 …
    Index component;
  };
  /// Connected by vertices.
  struct Component
  {
    Index triangles = 0;
    Index open_edges = 0; ///< its boundary edges with their multiplicities; 0: closed
    /// By the divergence theorem, holes filled by caps: above 0 when it faces outwards, below 0
    /// when it is inside out.
    double volume = 0.0;
  };

  std::vector<BoundaryEdge> edges;
  std::vector<Component> components;
};

/// Boundary of a welded surface: its edges as mesh_edges() gives them, and the caps that
/// boundary_caps() makes of them. O(n).
SurfaceBoundary surface_boundary(
  PointsView points, TrianglesView triangles, const std::vector<Edge>& edges, TrianglesView caps);

} // namespace bindpose

#endif
