#ifndef bindpose_weight_uses_depth_order_h
#define bindpose_weight_uses_depth_order_h

#include "base/execution.h"
#include "geometry/mesh.h"

namespace bindpose
{

/// Options of depth_order().
struct DepthOrderOptions
{
  /// The difference in `front`, in layers, between the first and the last handle of the list if all
  /// layers are equal, >= 0. It puts handles later in the list in front of earlier ones. Does not
  /// affect `depth`.
  double tie = 1e-3;
};

/// The result of depth_order().
struct DepthOrder
{
  /// #V: the depth sum_j w_j d_j of each vertex, where d_j is the layer of handle j. If all layers
  /// are equal, the depth is exactly this layer.
  Eigen::VectorXd depth;
  Eigen::VectorXd front; ///< #V: depth with ties broken; larger values are in front
};

/// Compute which part of a planar shape is drawn in front where a pose makes parts overlap. Each
/// handle has a layer (any real number), and the weights interpolate the layers over the shape. Two
/// parts that are near each other but not connected get the depths of their own handles. Rows that
/// do not sum to one are divided by their sum, so that their depth is not biased toward zero. A row
/// of zeros gets the depth 0. Report: least_depth, largest_depth.
/// @param weights #V x #handles, finite
/// @param layers one per handle, finite
Status depth_order(WeightsView weights, const Eigen::VectorXd& layers,
  const DepthOrderOptions& options, ExecutionContext& context, DepthOrder& result);

} // namespace bindpose

#endif
