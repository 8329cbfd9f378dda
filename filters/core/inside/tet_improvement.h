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
  /// Tets with a dihedral angle below this are worked on, degrees.
  double angle = 12.0;
  /// Held vertices of tets that stay below this may move after all, degrees.
  double least_angle = 8.5;
  Index passes = 20; ///< over the tets that are too flat, at most
  bool keep_boundary = false; ///< not one of its triangles changes, but see coplanar
  /// With keep_boundary: boundary edges may be swapped if their two triangles lie in one plane
  /// within this length. 0: none is swapped.
  double coplanar = 0.0;
  /// Vertices may be added inside, near tets below insert_angle that nothing else helps.
  bool insert = false;
  double insert_angle = 8.0; ///< degrees
  /// A step may make the smallest angle of the tets that it touches smaller by this factor if it
  /// makes enough others better, 0 … 1. 1: no step does.
  double slack = 1.0;
  /// At most about this many qualities are computed per tet, 40 ns each; in all no more than 25
  /// million and 400 per tet.
  double effort = 2000.0;
};

/// What it did.
struct Improvement
{
  Index moved_vertices = 0; ///< of those not held
  Index released_vertices = 0; ///< held ones that moved after all
  Index removed_tets = 0; ///< flat ones at the boundary, or by themselves
  Index collapsed_edges = 0; ///< vertices that are no longer used
  Index inserted_vertices = 0; ///< inside
};

/// Moves p along the unit vector n, at most `reach` either way, onto the surface that the boundary
/// is to lie on. Called from several threads. @return false when it is not met there.
using OntoSurface = std::function<bool(Vec3& p, const Vec3& n, double reach)>;

/// Improves the flattest tets of a mesh by replacing edges and facets between tets (Freitag and
/// Ollivier-Gooch, Tetrahedral Mesh Improvement Using Swapping and Smoothing, 1997) and by moving
/// vertices; where that does not help, edges are contracted into one of their ends, under the link
/// condition (Dey, Edelsbrunner, Guha, Nekhayev, Topology Preserving Edge Contraction, 1999), or
/// vertices are inserted. Every step lowers the sum of log(sin(angle) / sin(smallest dihedral
/// angle)) over the tets that it touches, and none makes the worst of them worse (but see slack).
/// The boundary stays but for flat tets on it, tets by themselves that stay flat, edges within 15
/// degrees of flat, vertices that move along `surface` (none when that is empty) and contracted
/// edges of it that turn its triangles by no more than 15 degrees; vertices at creases of more than
/// 40 degrees do not move and are contracted along the crease only, its ends and corners not at
/// all. Held ones do not move and never go. The tets must be positive and meet in common facets.
/// held: #V. Points stay, used or not; new ones come behind. The same on any number of threads.
/// Cost: some 40 us of one thread per tet that is too flat and pass in which its vicinity has
/// changed.
/// @return false when cancelled; the mesh is valid all the same.
bool improve_tets(TetMesh& mesh, std::vector<char> held, const OntoSurface& surface,
  const ImproveOptions& options, Improvement& done, ExecutionContext& context);

} // namespace bindpose

#endif
