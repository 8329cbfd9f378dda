#ifndef bindpose_tets_manifold_boundary_h
#define bindpose_tets_manifold_boundary_h

#include "geometry/mesh.h"

namespace bindpose
{

/// Return the boundary of tets as a closed 2-manifold, oriented outwards. An edge with more than
/// two boundary triangles is duplicated. Each copy of the edge joins two triangles that bound the
/// same fan of tets around the edge. Each vertex is duplicated so that there is one copy per fan of
/// triangles. If two edges then join the same two vertices, both edges are split at their
/// midpoints. Points that no boundary triangle uses are removed. Tets must not overlap, and each
/// facet must have at most two tets. Cost: O(#T log #T).
TriangleMesh manifold_boundary(const TetMesh& tets);

} // namespace bindpose

#endif
