#ifndef bindpose_tets_improve_options_h
#define bindpose_tets_improve_options_h

#include "geometry/mesh.h"

#include <functional>

namespace bindpose
{

/// Options of improve_tets().
struct ImproveOptions
{
  /// Limit in degrees: tets whose smallest dihedral angle is below this limit are improved.
  double angle = 12.0;
  /// Limit in degrees: a held (constrained) vertex may move if the smallest dihedral angle of a tet
  /// at the vertex remains below this limit. 0: held vertices never move.
  double release_angle = 8.5;
  Index passes = 20; ///< maximum number of passes over the tets that are too flat
  /// Whether boundary triangles stay unchanged, except as `coplanar` allows.
  bool keep_boundary = false;
  /// With keep_boundary: a boundary edge may be swapped if its two triangles are coplanar within
  /// this length. 0: no boundary edge is swapped.
  double coplanar = 0.0;
  /// Whether vertices may be inserted near tets whose smallest angle is below insert_angle, if no
  /// other step improves these tets.
  bool insert = false;
  double insert_angle = 8.0; ///< degrees
  /// A step may reduce the smallest angle of the tets that it touches to this fraction (0 … 1) of
  /// its old value, if the step improves enough other tets. 1: no step may reduce the angle.
  double slack = 1.0;
  /// Limit of the work: approximate maximum number of computed tet qualities per tet of the mesh.
  /// One tet quality takes 40 ns. For large meshes, a second, lower limit applies: in total, 25
  /// million tet qualities plus 400 per tet.
  double effort = 2000.0;
};

/// Move p along the unit vector n, at most `reach` in either direction, onto the surface on which
/// the boundary of the tets must lie. Called from several threads. @return false if p cannot reach
/// the surface in this way.
using OntoSurface = std::function<bool(Vec3& p, const Vec3& n, double reach)>;

} // namespace bindpose

#endif
