#ifndef bindpose_pose_rotation_centres_h
#define bindpose_pose_rotation_centres_h

#include "base/execution.h"
#include "base/mesh.h"

namespace bindpose
{

struct RotationCentresOptions
{
  /// How alike weights must be to count, sigma of the paper; above 0. 0.1 by default.
  double width = 0.1;
  /// Weights below this count as zero, 0 to 1. 1e-4 by default: what a weight of that size turns
  /// and moves is not seen, and most of weights without exact zeros goes away.
  double smallest_weight = 1e-4;
  /// Pairs of a vertex's handles whose product of weights is less than this share of its largest do
  /// not count, 0 to 1. 1e-3 by default: most pairs of many handles are that small.
  double smallest_pair = 1e-3;
  /// Elements whose weights of a pair of handles differ by no more than this are one for that pair,
  /// with the mean of these weights; 0: none but equals, the formula itself. 0.015 by default:
  /// centres move by less than a thousandth of the shape.
  double group_size = 0.015;
};

/// A centre of rotation for each vertex (Le and Hodgins 2016, Real-time skeletal skinning with
/// optimized centers of rotation): the mean place of all of the shape whose weights are like the
/// vertex's,
///
///     p(i) = integral of s(W_i, W_x) x dx / integral of s(W_i, W_x) dx,
///     s(a, b) = sum over pairs j < k of a_j a_k b_j b_k exp(-((a_j b_k - a_k b_j) / width)^2).
///
/// The integral is over the elements, each with the mean of its corners' weights at its centroid.
/// A vertex with less than two weights, to which nothing is similar, is its own centre: whatever
/// the centre, it moves the same.
///
/// Cost: a vertex looks at the groups of each pair of its handles, some hundreds, about 2 ns each
/// with AVX2. Memory: 48 bytes for each group, and for each element as many as it has handles.
/// Report: counts.groups (of all pairs), counts.centers (vertices with one of their own). The same
/// bits for any number of threads and on any machine. invalid_input for options out of range and
/// weights that are not as many rows as points, or not finite; elements must be valid (check_mesh).
Status rotation_centres(ExecutionContext& context, const RotationCentresOptions& options,
  PointsView points, TetsView tets, WeightsView weights, Points& centres);
Status rotation_centres(ExecutionContext& context, const RotationCentresOptions& options,
  PointsView points, TrianglesView triangles, WeightsView weights, Points& centres);

} // namespace bindpose

#endif
