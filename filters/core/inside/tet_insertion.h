#ifndef bindpose_inside_tet_insertion_h
#define bindpose_inside_tet_insertion_h

#include "base/execution.h"
#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// Split edges of the boundary that are longer than `longest` (a length > 0) at their midpoints,
/// longest first, until there are `most_tets` tets. The tets must be positive and meet in common
/// facets. Vertices keep their ids; new ones are appended.
/// @return false when canceled; the mesh is then valid too.
bool split_long_edges(TetMesh& mesh, double longest, Index most_tets, ExecutionContext& context);

/// Insert vertices at #P x 3 positions inside. Each vertex replaces the tets whose circumspheres
/// contain it, except those not visible from it (Shewchuk, Constrained Delaunay Tetrahedralizations
/// and Provably Good Boundary Recovery, 2002). The boundary does not change. The requirements are
/// those of split_long_edges(). vertices: #P, the new vertex, or -1 if it could not be inserted.
/// The result is the same for any number of threads.
/// Cost: about 1 us per tet, and 30 us of one thread per vertex; many times that if all vertices
/// are on one sphere or ellipsoid.
/// @return false when canceled; the mesh is then valid too.
bool insert_vertices(
  TetMesh& mesh, const Points& places, std::vector<Index>& vertices, ExecutionContext& context);

} // namespace bindpose

#endif
