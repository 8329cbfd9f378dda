#ifndef bindpose_skinning_rotation_centers_h
#define bindpose_skinning_rotation_centers_h

#include "base/execution.h"
#include "geometry/mesh.h"

namespace bindpose
{

/// Options of rotation_centers(), which computes optimized centers of rotation for skinning (Le and
/// Hodgins 2016).
struct RotationCentersOptions
{
  /// Width (above 0) of the similarity function, sigma in the paper.
  double width = 0.1;
  /// Weights up to this threshold (at least 0, less than 1) count as zero. Weights below 1e-4 have
  /// no visible effect, and most weights in dense rows are smaller than that.
  double smallest_weight = 1e-4;
  /// Threshold (at least 0, less than 1): a vertex ignores a pair of handles if the product of
  /// their two weights is less than this fraction of the vertex's largest product. If there are
  /// many handles, most pairs are ignored.
  double smallest_pair = 1e-3;
  /// For each pair of handles, elements with similar weights are grouped. Within a group, weights
  /// differ by at most this value (>= 0) and are replaced by their mean. 0: only equal weights are
  /// grouped, which is the exact formula. With 0.015, centers move by less than a thousandth of the
  /// size of the shape.
  double group_size = 0.015;
};

/// Compute a center of rotation for each vertex (Le and Hodgins 2016, Real-time skeletal skinning
/// with optimized centers of rotation). The center is a weighted mean of the positions in the
/// shape. A position counts more if its weights are more similar to the weights of the vertex:
///
///     p(i) = integral of s(W_i, W_x) x dx / integral of s(W_i, W_x) dx,
///     s(a, b) = sum over pairs j < k of a_j a_k b_j b_k exp(-((a_j b_k - a_k b_j) / width)^2).
///
/// Each integral is computed as a sum over the elements. The integrand is evaluated at the centroid
/// of an element, with W_x equal to the mean weights of the element's corners. A vertex with fewer
/// than two nonzero weights has no similar element. The center of such a vertex is the vertex
/// itself; the motion of the vertex does not depend on the center.
///
/// Cost: each vertex loops over the groups of each pair of its handles, typically hundreds of
/// groups, at about 2 ns per group with AVX2. Memory: 48 bytes per group; per element, 8 bytes for
/// each handle and 8 more for each handle with a weight in the element. The report contains
/// counts.groups (of all pairs) and counts.centers (number of vertices with a computed center). The
/// result has the same bits for any number of threads and on any machine. Return invalid_input if
/// an option is out of range, a weight is not finite, or the numbers of rows and points differ.
/// Elements must be valid (check_mesh).
Status rotation_centers(ExecutionContext& context, const RotationCentersOptions& options,
  PointsView points, TetsView tets, WeightsView weights, Points& centers);
Status rotation_centers(ExecutionContext& context, const RotationCentersOptions& options,
  PointsView points, TrianglesView triangles, WeightsView weights, Points& centers);

} // namespace bindpose

#endif
