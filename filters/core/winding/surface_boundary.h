#ifndef bindpose_winding_surface_boundary_h
#define bindpose_winding_surface_boundary_h

#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// The boundary of a surface in the sense of winding numbers, and the connected components of the
/// surface. The boundary consists of the edges whose directions do not cancel: different numbers of
/// triangles use the edge in its two directions. The boundary determines the winding number up to
/// an integer.
struct SurfaceBoundary
{
  /// A boundary edge. Its direction is the one in which more triangles use the edge.
  struct BoundaryEdge
  {
    Index from, to; ///< vertex ids
    /// Number of triangles that use the edge from `from` to `to`, minus the number that use it from
    /// `to` to `from`; at least 1.
    Index multiplicity;
    Index component;
  };
  /// Triangles that are connected by vertices.
  struct Component
  {
    Index triangles = 0;
    /// Number of boundary edges, with multiplicity; 0: the component is closed.
    Index open_edges = 0;
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
