#ifndef bindpose_weights_transfer_h
#define bindpose_weights_transfer_h

#include "base/execution.h"
#include "weights/domain.h"

namespace bindpose
{

struct TransferOptions
{
  /// A point that lies on a vertex, closer than this share of the mesh's diagonal, takes its row.
  double coincident = 1e-9;
  /// A point farther from the mesh than this share of its diagonal still gets the weights of the
  /// nearest place, but counts as a miss. 0.05 by default.
  double reach = 0.05;
};

/// How many points got their weights in which way.
struct TransferCounts
{
  Index exact = 0; ///< on a vertex: its row, bit by bit
  Index barycentric = 0; ///< inside of an element (on a surface: on it)
  Index nearest = 0; ///< outside, within reach: from the nearest point of the nearest element
  Index misses = 0; ///< beyond reach, or not finite (these get zeros)
  double largest_distance = 0.0; ///< from a point to the mesh
};

/// Carries weights (or any rows) from the vertices of a mesh to points in or near it. Linear within
/// elements, so rows that sum to one still do. Cost: O(log #elements) a point.
/// @param values #V x #columns at the mesh's vertices.
/// @param result #points x #columns.
Status transfer(const Domain& mesh, WeightsView values, PointsView points,
  const TransferOptions& options, ExecutionContext& context, Weights& result,
  TransferCounts& counts);

/// "exact" when all points lie on vertices, "barycentric" when none does, else "mixed".
const char* transfer_word(const TransferCounts& counts);

} // namespace bindpose

#endif
