#ifndef bindpose_transfer_inpaint_h
#define bindpose_transfer_inpaint_h

#include "qp/box_qp_column.h"
#include "transfer/surface_match.h"

namespace bindpose
{

/// Options of inpaint_weights().
struct InpaintOptions
{
  SurfaceMatchOptions match;
  /// Matched points that are connected by edges are a group. A group counts as unmatched if its
  /// area (or volume) is less than this fraction (0 … 1) of the largest group in its part of the
  /// target. 0: all groups match. Small groups arise where the target is near another part of the
  /// source.
  double smallest_group = 0.01;
  /// Largest number of weights above 0 in a row; 0: the largest number in a row of the source.
  Index maximum_influences = 0;
  /// Number (>= 0) of smoothing steps after the solve; 0: no smoothing. In each step, a row becomes
  /// 0.8 times itself plus 0.2 times the mean of its neighbors' rows. The steps change the rows of
  /// inpainted vertices, and of vertices within SurfaceMatchOptions::maximum_distance of them.
  int smoothing_steps = 0;
  /// Upper limit (above 0, below 1) of the relative gap and of the residual of a column.
  double tolerance = 1e-6;
  int maximum_iterations = 100; ///< maximum number (>= 1) of iterations per column
  SparseSolver::Options solver;
};

/// The result of inpaint_weights().
struct InpaintedWeights
{
  Weights weights; ///< #target points x #columns
  /// #target points: 1 if the point, or another point at its position, matches.
  std::vector<char> matched;
  /// One certificate per column, for the solution before rows are divided by their sums and before
  /// smoothing. It is zero for a column that is constant in each part of the target.
  std::vector<Certificate> certificates;
};

/// Transfer weights from a mesh to another surface: copy them where the surfaces match, and inpaint
/// the rest. The rows of matched points (see match_surface) are interpolated in the source. All
/// other rows are solved for: they minimize the biharmonic energy of the target with the matched
/// rows as fixed values. In each column, they are bounded by the smallest and the largest fixed
/// value of their part, before rows are divided by their sums: without bounds, the slope at the
/// edge of the matched points would continue, and the inner side of a shell would follow another
/// handle than its outer side. The certificates are those of BoxQp. Points of a target surface at
/// the same position are one vertex of the solve, so a surface may be cut along texture seams.
/// Their normals are computed per point, so a cut can change which points match. If a connected
/// part of the target has no match, its points get the row at the nearest point of the source. The
/// same applies to points in no triangle. A point whose nearest row is zero does not match, nor
/// does a point in a small group.
///
/// If the rows of the source sum to one (within 1 %), the inpainted rows are divided by their sums.
/// If a row has more than `maximum_influences` weights, its largest weights are kept and scaled to
/// the same sum; for solved rows, all columns are then solved again with the other weights fixed at
/// 0. If the sum of a solved row is near 0, the row that selected these weights is used. If the
/// cotangent energy cannot be factored because of extremely thin triangles, the energy of uniform
/// edge weights is used instead, with a warning.
///
/// Report: transfer ("inpaint"), counts.matched, counts.inpainted, counts.small_groups,
/// counts.unmatched_parts, counts.nearest (points that get the nearest row), matched_fraction,
/// relative_gap, kkt_residual, row_sum_error (of the first solution, before rows are divided by
/// their sums), iterations, maximum_influences. Return not_converged if a certificate exceeds the
/// tolerance, and invalid_input for unusable meshes, weights or options. Progress phases "match"
/// and "inpaint".
///
/// Cost: a match per point, and a few factorizations of the biharmonic energy of the inpainted
/// vertices per column that is not constant.
/// Abdrashitov, Raichstat, Monsen, Hill 2023, Robust skin weights transfer via weight inpainting.
Status inpaint_weights(ExecutionContext& context, const Domain& source, WeightsView values,
  const Domain& target, const InpaintOptions& options, InpaintedWeights& result);

} // namespace bindpose

#endif
