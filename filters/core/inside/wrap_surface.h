#ifndef bindpose_inside_wrap_surface_h
#define bindpose_inside_wrap_surface_h

#include "base/execution.h"
#include "base/mesh.h"

namespace bindpose
{

struct WrapOptions
{
  /// Radius of the carving ball, in bounding-box diagonals, 0.0001 … 1. The wrap's edges are at
  /// most about twice as long, and it closes gaps narrower than 2 alpha. Triangles and seconds grow
  /// with 1 / alpha^2.
  double alpha = 0.02;
  /// Distance of the wrap's vertices from the surface, in bounding-box diagonals, 0.000001 … 1. A
  /// smaller offset follows creases with more triangles.
  double offset = 0.001;
  double time_limit = 120.0; ///< the helper is killed after this many seconds, > 0
  Index memory_limit = 0; ///< largest address space of the helper in MiB, 0: no limit
};

/// Compute a closed surface that contains given triangles (Portaneri, Rouxel-Labbé, Hemmer,
/// Cohen-Steiner, Alliez, Alpha Wrapping with an Offset, 2022), by the helper executable
/// bindpose-mesher. The triangles may be open, crossing, loose or without thickness, and of any
/// orientation.
///
/// The wrap is 2-manifold, without crossings and oriented outwards. It follows the surface wherever
/// a ball of radius alpha reaches the surface from outside. Its vertices are at the distance
/// `offset` from the surface. Its triangles may be nearer, and at corners they may touch the
/// surface. Parts that are nearer to each other than 2 alpha are joined. A part that is closed
/// except for gaps of 2 alpha becomes solid, including everything inside. An open part becomes a
/// shell of thickness 2 offset.
///
/// `wrap_points` (#W x 3) and `wrap_triangles` (#G x 3) contain no vertices of the input.
///
/// invalid_input: coordinates not finite or larger than 1e100, ids out of range, no triangles, all
/// points equal, an option out of range. unavailable: no helper. internal_error: the helper failed,
/// or ran out of time or memory. Cost: about 0.13 ms per triangle of the wrap. With the defaults
/// the wrap of an elephant has 5,000 triangles, with half the alpha 12,000.
Status wrap_surface(PointsView points, TrianglesView triangles, const WrapOptions& options,
  Points& wrap_points, Triangles& wrap_triangles, ExecutionContext& context);

} // namespace bindpose

#endif
