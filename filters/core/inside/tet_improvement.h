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
  Index passes = 12; ///< over the tets that are too flat, at most
  bool keep_boundary = false; ///< not one of its triangles changes
};

/// What it did.
struct Improvement
{
  Index moved_vertices = 0; ///< of those not held
  Index released_vertices = 0; ///< held ones that moved after all
  Index removed_tets = 0; ///< flat ones at the boundary, or by themselves
  Index collapsed_edges = 0; ///< vertices that are no longer used
};

/// Moves p along the unit vector n, at most `reach` either way, onto the surface that the boundary
/// is to lie on. @return false when it is not met there.
using OntoSurface = std::function<bool(Vec3& p, const Vec3& n, double reach)>;

/// Makes the flattest tets of a mesh better by replacing edges and facets between tets (Freitag and
/// Ollivier-Gooch, Tetrahedral Mesh Improvement Using Swapping and Smoothing, 1997) and by moving
/// vertices; where that does not help, edges are contracted into one of their ends, under the link
/// condition (Dey, Edelsbrunner, Guha, Nekhayev, Topology Preserving Edge Contraction, 1999). No
/// step makes the worst of the tets that it touches worse. The boundary stays but for flat tets on
/// it, tets by themselves that stay flat, edges within 15 degrees of flat, vertices that move along
/// `surface` (none when that is empty) and contracted edges that turn its triangles by no more than
/// 15 degrees; vertices at creases of more than 40 degrees do not move and are contracted along the
/// crease only, its ends and corners not at all. Held ones do not move and never go.
/// The tets must be positive and meet in common facets. held: #V. Points stay, used or not. Cost:
/// some 20 us for each tet that is too flat and pass.
/// @return false when cancelled; the mesh is valid all the same.
bool improve_tets(TetMesh& mesh, std::vector<char> held, const OntoSurface& surface,
  const ImproveOptions& options, Improvement& done, ExecutionContext& context);

} // namespace bindpose

#endif
