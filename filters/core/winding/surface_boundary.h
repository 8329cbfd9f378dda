#ifndef bindpose_winding_surface_boundary_h
#define bindpose_winding_surface_boundary_h

#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// The boundary of a surface in the sense of winding numbers, and its connected components. The
/// boundary consists of the edges whose directions do not cancel. It determines the winding number
/// up to an integer.
struct SurfaceBoundary
{
  /// Directed like the majority of the triangles at this edge.
  struct BoundaryEdge
  {
    Index from, to; ///< vertex ids
    Index multiplicity; ///< triangles in this direction minus triangles in the other direction, at
                        ///< least 1
    Index component;
  };
  /// Triangles that are connected by vertices.
  struct Component
  {
    Index triangles = 0;
    Index open_edges = 0; ///< boundary edges counted with their multiplicities; 0: closed
    /// Volume by the divergence theorem, with holes closed by caps. It is positive if the component
    /// faces outwards and negative if it is inside out.
    double volume = 0.0;
  };

  std::vector<BoundaryEdge> edges;
  std::vector<Component> components;
};

/// Return the boundary of a welded surface. `edges` come from mesh_edges(), `caps` from
/// boundary_caps(). O(n).
SurfaceBoundary surface_boundary(
  PointsView points, TrianglesView triangles, const std::vector<Edge>& edges, TrianglesView caps);

} // namespace bindpose

#endif
