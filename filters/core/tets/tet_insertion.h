#ifndef bindpose_tets_tet_insertion_h
#define bindpose_tets_tet_insertion_h

// Insertion of vertices into a tet mesh and splitting of long boundary edges.

#include "base/execution.h"
#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// Split edges of the boundary that are longer than `longest` (a length > 0) at their midpoints,
/// longest first, until there are `most_tets` tets. The tets must be positive and conforming.
/// Vertices keep their ids; new vertices are appended.
/// @return false if canceled; the mesh is also valid in this case.
bool split_long_edges(ExecutionContext& context, TetMesh& mesh, double longest, Index most_tets);

/// Insert vertices at positions inside the mesh (#P x 3). Each vertex replaces the tets whose
/// circumspheres contain it, except tets that are not visible from the vertex (Shewchuk,
/// Constrained Delaunay Tetrahedralizations and Provably Good Boundary Recovery, 2002). The
/// boundary does not change. The tets must be positive and conforming. vertices: #P, the id of the
/// new vertex at each position, or -1 if no vertex could be inserted there. The result is the same
/// for any number of threads. Cost: about 1 us per tet of the mesh, plus 30 us per inserted vertex
/// on one thread. The cost is many times higher if all vertices are on one sphere or ellipsoid.
/// @return false if canceled; the mesh is also valid in this case.
bool insert_vertices(
  ExecutionContext& context, TetMesh& mesh, const Points& positions, std::vector<Index>& vertices);

} // namespace bindpose

#endif
