#ifndef bindpose_planar_planar_shape_h
#define bindpose_planar_planar_shape_h

#include "base/execution.h"
#include "winding/curve_winding_number.h"

#include <vector>

namespace bindpose
{

/// Options of planar_shape(), which triangulates the inside of curves in the plane.
struct PlanarShapeOptions
{
  /// Threshold > 0: points with at least this winding number are inside. With 0.5, the gap of an
  /// open curve is closed approximately along the straight line between its ends. With 1.5, only
  /// regions that are enclosed twice are inside.
  double winding_threshold = 0.5;
  /// Smallest angle of a triangle in degrees, 0 … 33, except where curves or bones form a smaller
  /// angle. Angles up to 20.6 can always be reached, larger angles usually.
  double min_angle = 30.0;
  /// Longest edge of a triangle, as a fraction of the diagonal of the curves' bounding box; 0: no
  /// limit. Smooth weights need vertices in the interior.
  double edge = 0.02;
  double time_limit = 120.0; ///< time limit of the helper process in seconds, > 0
  Index memory_limit = 0; ///< limit of the helper process's address space in MiB, 0: no limit
};

/// Constraints of the mesh in addition to the curves. Handles do not contribute to the winding
/// number.
struct PlanarHandles
{
  PlanePoints points; ///< #H x 2; each point that is inside becomes a vertex
  /// #B x 2: indices in `points` of the two ends of each bone. The part of the bone that is inside
  /// becomes a chain of edges.
  Segments bones;
};

/// The result of planar_shape().
struct PlanarShape
{
  PlanePoints points; ///< #V x 2: positions of the vertices; no vertex is unused
  Triangles triangles; ///< #F x 3, counter-clockwise
  Eigen::VectorXd winding_numbers; ///< #F: winding numbers at the triangles' centers
  /// #V: input ids of the vertices. Vertices of the curves come first, in ascending order of their
  /// ids; all other vertices have -1.
  std::vector<Index> original_vertices;
  /// #H: vertex at each handle point; -1: the point is outside.
  std::vector<Index> handle_vertices;
};

/// Triangulate the region that is enclosed by curves in the plane, with good angles. A constrained
/// Delaunay triangulation contains all segments and their crossings. Triangles whose mean
/// generalized winding number (Jacobson, Kavan, Sorkine-Hornung, 2013) is at least the threshold
/// are kept, and subdivided by Delaunay refinement (Ruppert; Shewchuk).
///
/// Curves may be open, cross, overlap or branch; they are split exactly where they intersect. Their
/// direction is counter-clockwise around the inside and clockwise around holes. If curves enclose a
/// negative total area, all of them are reversed, with a warning. The gap of an open curve is
/// closed by straight edges between its vertices. Curves inside of the shape remain edges of the
/// mesh. If several vertices are equal, the vertex with the lowest id is used.
///
/// Report: counts.points, counts.segments, counts.crossings (new vertices at crossings),
/// counts.open_ends, counts.vertices, counts.triangles, counts.kept_points, counts.outside_handles,
/// area, min_angle (degrees, of the mesh), longest_edge (length), turned (1: curves were reversed),
/// grid (length; 0: no grid was used). A grid is used if curves come closer to each other than
/// 1e-12 of the diagonal, or than 8 units in the last place of the coordinates. Points nearer to
/// each other than `grid` are then merged.
///
/// Return one of these errors:
/// - invalid_input: coordinates that are not finite, ids out of range, no segment, all points on
///   one line, a winding number that is below the threshold everywhere, or options out of range;
/// - unavailable: the helper executable bindpose-mesher is missing;
/// - internal_error: the helper failed, or the curves cross too often.
/// Cost: about 20 us per segment and 4 us per triangle, plus 20 ms for starting the helper.
Status planar_shape(ExecutionContext& context, PlanePointsView points, SegmentsView segments,
  const PlanarHandles& handles, const PlanarShapeOptions& options, PlanarShape& shape);

} // namespace bindpose

#endif
