#ifndef bindpose_inside_tet_improvement_h
#define bindpose_inside_tet_improvement_h

#include "base/execution.h"
#include "base/mesh.h"

#include <functional>
#include <vector>

namespace bindpose
{

struct ImproveOptions
{
  /// Tets with a dihedral angle below this are improved, degrees.
  double angle = 12.0;
  /// Held vertices of tets that remain below this angle may move, degrees.
  double least_angle = 8.5;
  Index passes = 20; ///< largest number of passes over the tets that are too flat
  bool keep_boundary = false; ///< no boundary triangle changes, except as coplanar allows
  /// With keep_boundary: a boundary edge may be swapped if its two triangles are coplanar within
  /// this length. 0: no boundary edge is swapped.
  double coplanar = 0.0;
  /// Vertices may be added inside, near tets below insert_angle that no other step improves.
  bool insert = false;
  double insert_angle = 8.0; ///< degrees
  /// A step may reduce the smallest angle of the tets that it touches by this factor if it improves
  /// enough other tets, 0 … 1. 1: no step may reduce it.
  double slack = 1.0;
  /// Approximate limit of computed qualities per tet, 40 ns each. The total is at most 25 million
  /// plus 400 per tet.
  double effort = 2000.0;
};

/// Counts of the changes.
struct Improvement
{
  Index moved_vertices = 0; ///< vertices that were not held
  Index released_vertices = 0; ///< held vertices that moved
  Index removed_tets = 0; ///< flat tets at the boundary, or separate tets
  Index collapsed_edges = 0; ///< vertices that are no longer used
  Index inserted_vertices = 0; ///< new vertices inside
};

/// Move p along the unit vector n, at most `reach` in either direction, onto the surface that must
/// contain the boundary. It is called from several threads. @return false if it does not meet the
/// surface there.
using OntoSurface = std::function<bool(Vec3& p, const Vec3& n, double reach)>;

/// Improve the flattest tets of a mesh by replacing edges and facets between tets (Freitag and
/// Ollivier-Gooch, Tetrahedral Mesh Improvement Using Swapping and Smoothing, 1997) and by moving
/// vertices. If these steps fail, edges are contracted into one of their ends, under the link
/// condition (Dey, Edelsbrunner, Guha, Nekhayev, Topology Preserving Edge Contraction, 1999), or
/// vertices are inserted. Every step lowers the sum of log(sin(angle) / sin(smallest dihedral
/// angle)) over the tets that it touches. No step reduces the smallest angle of these tets, except
/// as slack allows.
///
/// The boundary is kept, with these exceptions:
/// - Flat tets at the boundary and separate tets that remain flat are removed.
/// - Boundary edges within 15 degrees of flat may be swapped.
/// - Boundary vertices may move along `surface` (none does if it is empty).
/// - Boundary edges may be contracted if that turns their triangles by at most 15 degrees.
///
/// Vertices at creases of more than 40 degrees do not move. They are contracted along the crease
/// only, its ends and corners never. Held vertices neither move nor disappear.
///
/// The tets must be positive and meet in common facets. held: #V. Points keep their ids, used or
/// not; new points are appended. The result is the same for any number of threads.
/// Cost: some 40 us of one thread per tet that is too flat, per pass in which its neighborhood has
/// changed.
/// @return false when canceled; the mesh is then valid too.
bool improve_tets(TetMesh& mesh, std::vector<char> held, const OntoSurface& surface,
  const ImproveOptions& options, Improvement& done, ExecutionContext& context);

} // namespace bindpose

#endif
