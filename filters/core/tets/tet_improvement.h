#ifndef bindpose_tets_tet_improvement_h
#define bindpose_tets_tet_improvement_h

// Improvement of flat tets by local modifications.

#include "base/execution.h"
#include "geometry/mesh.h"
#include "tets/improve_options.h"

#include <vector>

namespace bindpose
{

/// Numbers of applied steps.
struct Improvement
{
  Index moved_vertices = 0; ///< number of moved vertices that were not held
  Index released_vertices = 0; ///< number of moved vertices that were held (constrained)
  /// Number of removed tets: flat tets at the boundary, and tets without a neighbor.
  Index removed_tets = 0;
  Index collapsed_edges = 0; ///< number of contracted edges; each contraction removes one vertex
  Index inserted_vertices = 0; ///< number of new vertices; they are in the interior of the mesh
};

/// Improve the flattest tets of a mesh by swapping edges and facets (Freitag and Ollivier-Gooch,
/// Tetrahedral Mesh Improvement Using Swapping and Smoothing, 1997) and by moving vertices. If
/// these modifications (steps) fail, edges are contracted into one of their ends, under the link
/// condition (Dey, Edelsbrunner, Guha, Nekhayev, Topology Preserving Edge Contraction, 1999), or
/// vertices are inserted. Every step lowers the sum of log(sin(angle) / sin(smallest dihedral
/// angle)) over the tets that it touches. No step reduces the smallest angle of these tets, except
/// as `slack` allows.
///
/// The boundary is kept, with these exceptions:
/// - Flat tets at the boundary are removed. At the end, tets that are still flat and share no facet
///   with another tet are removed too.
/// - Boundary edges within 15 degrees of flat may be swapped.
/// - Boundary vertices may move along `surface`. If `surface` is empty, they do not move.
/// - Boundary edges may be contracted if this rotates the normals of the triangles by at most 15
///   degrees.
///
/// Vertices at creases of more than 40 degrees do not move. Such vertices are contracted along the
/// crease only; the ends and corners of a crease are never contracted. Held vertices neither move
/// nor disappear, except as `release_angle` allows.
///
/// The tets must be positive and conforming. constrained: #V, 1 for held vertices. Points keep
/// their ids and are not removed if they become unused; new points are appended. The result is the
/// same for any number of threads. Cost: about 40 us of one thread per tet that is too flat, in
/// each pass in which its neighborhood has changed.
/// @return false if canceled; the mesh is also valid in this case.
bool improve_tets(ExecutionContext& context, TetMesh& mesh, std::vector<char> constrained,
  const OntoSurface& surface, const ImproveOptions& options, Improvement& improvement);

} // namespace bindpose

#endif
