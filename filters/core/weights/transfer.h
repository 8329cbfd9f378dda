#ifndef bindpose_weights_transfer_h
#define bindpose_weights_transfer_h

#include "base/execution.h"
#include "domain/domain.h"

namespace bindpose
{

/// Options of transfer().
struct TransferOptions
{
  /// A point that is closer to a vertex than this fraction of the mesh's diagonal takes the
  /// vertex's row.
  double coincident = 1e-9;
  /// A point whose distance from the mesh is more than this fraction of the mesh's diagonal counts
  /// as a miss. It still gets the weights of the nearest point of the mesh.
  double reach = 0.05;
};

/// Numbers of points by the way in which their weights were computed.
struct TransferCounts
{
  Index exact = 0; ///< points on a vertex, which get a bitwise copy of the row of the vertex
  Index barycentric = 0; ///< points in an element, whose weights are interpolated
  /// Points outside, within reach; they get the weights of the nearest point of the mesh.
  Index nearest = 0;
  Index misses = 0; ///< points beyond reach, and points that are not finite (the latter get zeros)
  double largest_distance = 0.0; ///< largest distance of a point from the mesh
};

/// Transfer weights (or other rows of values) from the vertices of a mesh to points in or near the
/// mesh. The interpolation is linear in each element, so the row sums are preserved. Cost: O(log
/// #elements) per point.
/// @param values #V x #columns at the mesh's vertices.
/// @param result #points x #columns.
Status transfer(const Domain& mesh, WeightsView values, PointsView points,
  const TransferOptions& options, ExecutionContext& context, Weights& result,
  TransferCounts& counts);

/// Return "exact" if all points are on vertices, "barycentric" if no point is, else "mixed".
const char* transfer_word(const TransferCounts& counts);

} // namespace bindpose

#endif
