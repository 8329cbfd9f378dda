#ifndef bindpose_planar_planar_shape_h
#define bindpose_planar_planar_shape_h

#include "base/execution.h"
#include "winding/curve_winding_number.h"

#include <vector>

namespace bindpose
{

struct PlanarShapeOptions
{
  /// Inside is where the curves wind around at least this often, above 0. 0.5 is half way through
  /// the curve; 1.5 keeps what is enclosed twice.
  double winding_threshold = 0.5;
  /// Degrees, 0 … 33: smallest angle of a triangle, but where the curves (or bones) themselves meet
  /// at less. Up to 20.6 it can always be had, beyond it mostly.
  double min_angle = 30.0;
  /// Longest edge of a triangle, as a fraction of the diagonal of the curves' box; 0: no bound.
  /// Smooth weights need vertices inside.
  double edge = 0.02;
  double time_limit = 120.0; ///< seconds for all of the helper's work, > 0
  Index memory_limit = 0; ///< MiB of address space for the helper process, 0: no limit
};

/// What has to be part of the mesh beside the curves; it winds around nothing.
struct PlanarHandles
{
  PlanePoints points; ///< #H x 2, each becomes a vertex when it lies inside
  Segments bones; ///< #B x 2 ids of these points: a row of edges, as far as it lies inside
};

struct PlanarShape
{
  PlanePoints points; ///< #V x 2, no stray vertices
  Triangles triangles; ///< #F x 3, counter-clockwise
  Eigen::VectorXd winding_numbers; ///< #F: at the triangles' centres
  std::vector<Index> original_vertices; ///< #V: id of the curves' vertex, ascending, then -1
  std::vector<Index> handle_vertices; ///< #H: vertex at the handle's point, -1 when it is outside
};

/// Quality triangles of what curves in the plane enclose: constrained Delaunay triangulation of all
/// segments and of their crossings, kept where the generalized winding number is at least the
/// threshold (Jacobson, Kavan, Sorkine-Hornung, 2013), then Delaunay refinement (Ruppert;
/// Shewchuk).
///
/// Curves may be open, cross, overlap, branch; they are split exactly where they meet. They run
/// counter-clockwise around what is inside and clockwise around holes; curves that enclose a
/// negative area in all are taken the other way round, and a warning says so. The gap of an open
/// curve is closed by straight edges between its vertices. Curves inside of the shape stay edges of
/// the mesh. Of equal vertices the one with the lowest id is used.
///
/// Report: counts.points, counts.segments, counts.crossings (vertices new by splitting),
/// counts.open_ends, counts.vertices, counts.triangles, counts.kept_points, counts.outside_handles,
/// area, min_angle (degrees, of the mesh), longest_edge (length), turned (1: the other way round),
/// grid (length, 0 for none: where curves come closer to each other than 1e-12 of the diagonal, or
/// than 8 units in the last place of the coordinates, what is nearer than this was merged).
///
/// invalid_input: not finite, ids out of range, no segment, everything on one line, nothing that is
/// wound around often enough, options out of range. unavailable: no helper executable
/// (bindpose-mesher does the work). internal_error: the helper failed, or the curves cross too
/// often. Cost: about 20 us a segment and 4 us a triangle, beside 20 ms for the helper.
Status planar_shape(PlanePointsView points, SegmentsView segments, const PlanarHandles& handles,
  const PlanarShapeOptions& options, PlanarShape& shape, ExecutionContext& context);

} // namespace bindpose

#endif
