#ifndef bindpose_transfer_transfer_h
#define bindpose_transfer_transfer_h

#include "base/execution.h"
#include "domain/domain.h"

namespace bindpose
{

/// Options of transfer().
struct TransferOptions
{
  /// A point gets a copy of a vertex's row if its distance from the vertex is at most this fraction
  /// of the mesh's diagonal.
  double coincident = 1e-9;
  /// A point counts as a miss if its distance from the mesh is more than this fraction of the
  /// mesh's diagonal. A miss still gets the weights of the nearest point of the mesh.
  double reach = 0.05;
};

/// Numbers of points, classified by how their weights were computed.
struct TransferCounts
{
  Index exact = 0; ///< points on a vertex; they get a bitwise copy of its row
  Index barycentric = 0; ///< points in an element; their weights are interpolated
  /// Points outside of the mesh but within TransferOptions::reach. They get the weights of the
  /// nearest point of the mesh.
  Index nearest = 0;
  /// Points beyond TransferOptions::reach, and points with a coordinate that is not finite. Points
  /// that are not finite get zero weights.
  Index misses = 0;
  double largest_distance = 0.0; ///< largest distance of a point from the mesh
};

/// Transfer weights (or other rows of values) from the vertices of a mesh to points in or near the
/// mesh. The interpolation is linear in each element, so the row sums are preserved. Cost: O(log
/// #elements) per point.
/// @param values #V x #columns at the mesh's vertices.
/// @param result #points x #columns.
Status transfer(ExecutionContext& context, const Domain& mesh, WeightsView values,
  PointsView points, const TransferOptions& options, Weights& result, TransferCounts& counts);

/// Return "exact" if all points are on vertices, "barycentric" if no point is, else "mixed".
const char* transfer_word(const TransferCounts& counts);

} // namespace bindpose

#endif
