#ifndef bindpose_inside_tet_insertion_h
#define bindpose_inside_tet_insertion_h

#include "base/execution.h"
#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// Splits edges of the boundary that are longer than `longest` (a length > 0) in the middle,
/// longest first, until there are `most_tets` tets. The tets must be positive and meet in common
/// facets. Vertices keep their ids, new ones come behind.
/// @return false when cancelled; the mesh is valid all the same.
bool split_long_edges(TetMesh& mesh, double longest, Index most_tets, ExecutionContext& context);

/// Inserts vertices at #P x 3 places inside: each replaces the tets whose circumspheres contain it,
/// except those not visible from it (Shewchuk, Constrained Delaunay Tetrahedralizations and
/// Provably Good Boundary Recovery, 2002). The boundary stays. Needs what split_long_edges() does.
/// vertices: #P, the new vertex, -1 where none could be made. The same on any number of threads.
/// Cost: about 1 us per tet, and 30 us of one thread per vertex; many times that where all vertices
/// lie on one sphere or ellipsoid.
/// @return false when cancelled; the mesh is valid all the same.
bool insert_vertices(
  TetMesh& mesh, const Points& places, std::vector<Index>& vertices, ExecutionContext& context);

} // namespace bindpose

#endif
