#ifndef bindpose_inside_wrap_surface_h
#define bindpose_inside_wrap_surface_h

#include "base/execution.h"
#include "base/mesh.h"

namespace bindpose
{

struct WrapOptions
{
  /// Radius of the ball that carves, as a fraction of the surface's diagonal, 0.0001 … 1. The
  /// wrap's edges are at most about twice as long, and it closes gaps that are narrower than 2
  /// alpha. #triangles and seconds grow with 1 / alpha^2.
  double alpha = 0.02;
  /// How far outside of the surface the wrap's vertices lie, as a fraction of the diagonal,
  /// 0.000001 … 1. Smaller ones follow creases with more triangles.
  double offset = 0.001;
  double time_limit = 120.0; ///< seconds after which the helper is killed, > 0
  Index memory_limit = 0; ///< MiB of address space for the helper, 0: no limit
};

/// A closed surface that holds any triangles in it: open, crossing, loose, of no thickness, however
/// oriented (Portaneri, Rouxel-Labbé, Hemmer, Cohen-Steiner, Alliez, Alpha Wrapping with an Offset,
/// 2022), by the helper executable bindpose-mesher. It is 2-manifold, without crossings, oriented
/// outwards, and follows the surface wherever a ball of radius alpha reaches it from outside: its
/// vertices lie at the distance `offset` from the surface, while its triangles may come nearer, at
/// corners so near that they touch. Parts that are nearer to each other than 2 alpha are joined.
/// What is closed up to gaps of 2 alpha becomes solid, whatever lies inside; what is open becomes a
/// shell of thickness 2 offset.
///
/// `wrap_points` (#W x 3) and `wrap_triangles` (#G x 3) are all new.
///
/// invalid_input: not finite, larger than 1e100, ids out of range, no triangles, all in one point,
/// an option out of range. unavailable: no helper. internal_error: the helper failed, ran out of
/// time or memory. Cost: about 0.13 ms a triangle of the wrap; the defaults give an elephant 5,000
/// of them, half the alpha 12,000.
Status wrap_surface(PointsView points, TrianglesView triangles, const WrapOptions& options,
  Points& wrap_points, Triangles& wrap_triangles, ExecutionContext& context);

} // namespace bindpose

#endif
