#ifndef bindpose_weight_uses_depth_order_h
#define bindpose_weight_uses_depth_order_h

#include "base/execution.h"
#include "geometry/mesh.h"

namespace bindpose
{

/// Options of depth_order().
struct DepthOrderOptions
{
  /// Offset (>= 0) of the last handle, in layers. To compute `front`, an offset is added to the
  /// layer of each handle. The offsets increase linearly with the index of the handle, from 0 for
  /// the first handle. Therefore later handles are in front of earlier handles with an equal layer.
  /// `depth` does not depend on this option.
  double tie_offset = 1e-3;
};

/// The result of depth_order().
struct DepthOrder
{
  /// #V: the depth sum_j w_j d_j of each vertex, where d_j is the layer of handle j. If all layers
  /// are equal, the depth is exactly this layer.
  Eigen::VectorXd depth;
  Eigen::VectorXd front; ///< #V: depth plus the effect of `tie_offset`; larger values are in front
};

/// Compute the order in which parts of a planar shape are drawn if they overlap in a pose. Each
/// handle has a layer (any real number), and the weights interpolate the layers over the shape. If
/// two parts are near each other but not connected, each part gets the depths of its own handles.
/// Rows that do not sum to one are divided by their sum, so that the size of the sum does not
/// affect the depth. A row of zeros gets the depth 0. Report: least_depth, largest_depth (smallest
/// and largest entry of `depth`).
/// @param weights #V x #handles, finite
/// @param layers one per handle, finite
Status depth_order(ExecutionContext& context, WeightsView weights, const Eigen::VectorXd& layers,
  const DepthOrderOptions& options, DepthOrder& result);

} // namespace bindpose

#endif
