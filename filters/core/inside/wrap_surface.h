#ifndef bindpose_inside_wrap_surface_h
#define bindpose_inside_wrap_surface_h

// Alpha wraps: closed surfaces that contain arbitrary triangles (CGAL's Alpha_wrap_3, in the helper
// executable).

#include "base/execution.h"
#include "geometry/mesh.h"

namespace bindpose
{

/// Options of wrap_surface().
struct WrapOptions
{
  /// Radius of the carving ball, in bounding-box diagonals, 0.0001 … 1. The edges of the wrap are
  /// at most about twice as long as alpha, and the wrap closes gaps narrower than 2 alpha. The
  /// number of triangles and the computing time grow with 1 / alpha^2.
  double alpha = 0.02;
  /// Distance of the wrap's vertices from the surface, in bounding-box diagonals, 0.000001 … 1.
  /// With a smaller offset, the wrap follows creases more closely, but it has more triangles.
  double offset = 0.001;
  double time_limit = 120.0; ///< seconds (> 0) after which the helper is killed
  Index memory_limit = 0; ///< largest address space of the helper in MiB, 0: no limit
};

/// Compute a closed surface that contains all given triangles (Portaneri, Rouxel-Labbé, Hemmer,
/// Cohen-Steiner, Alliez, Alpha Wrapping with an Offset, 2022), by the helper executable
/// bindpose-mesher. The triangles may be open, crossing, loose or without thickness, and of any
/// orientation.
///
/// The wrap is 2-manifold, without crossings and oriented outwards. It follows the surface wherever
/// a ball of radius alpha reaches the surface from outside. Its vertices are at the distance
/// `offset` from the surface. Its triangles may be nearer, and at corners they may touch the
/// surface. Parts that are nearer to each other than 2 alpha are joined. A part whose gaps are
/// narrower than 2 alpha becomes solid, including everything inside. An open part becomes a shell
/// of thickness 2 offset.
///
/// `wrap_points` (#W x 3) and `wrap_triangles` (#G x 3) contain no vertices of the input.
///
/// Return invalid_input if a coordinate is not finite or larger than 1e100, an id is out of range,
/// there are no triangles, all points are equal, or an option is out of range; unavailable if there
/// is no helper; internal_error if the helper failed or exceeded its time or memory limit. Cost:
/// about 0.13 ms per triangle of the wrap. With the default options, the wrap of an elephant has
/// 5,000 triangles. With half of the default alpha, it has 12,000 triangles.
Status wrap_surface(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const WrapOptions& options, Points& wrap_points, Triangles& wrap_triangles);

} // namespace bindpose

#endif
