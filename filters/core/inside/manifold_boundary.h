#ifndef bindpose_inside_manifold_boundary_h
#define bindpose_inside_manifold_boundary_h

#include "base/mesh.h"

namespace bindpose
{

/// The boundary of tets as a closed 2-manifold, oriented outwards: where more than two of its
/// triangles meet at an edge, those that the tets between them connect are neighbors, and vertices
/// are there once for every fan of triangles around them. An edge that would then join the same two
/// vertices as another one is split at its middle. Points that no boundary triangle uses are left
/// out. No two tets may overlap, and each facet has at most two tets.
/// Cost: O(#T log #T).
TriangleMesh manifold_boundary(const TetMesh& tets);

} // namespace bindpose

#endif
