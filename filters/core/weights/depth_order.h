#ifndef bindpose_weights_depth_order_h
#define bindpose_weights_depth_order_h

#include "base/execution.h"
#include "base/mesh.h"

namespace bindpose
{

struct DepthOrderOptions
{
  /// Difference in `front` between the first and the last handle of the list if all layers are
  /// equal, in layers, >= 0. Handles later in the list are in front. Does not affect `depth`.
  double tie = 1e-3;
};

struct DepthOrder
{
  Eigen::VectorXd depth; ///< #V: sum_j w_j d_j; exactly the common layer if all layers are equal
  Eigen::VectorXd front; ///< #V: depth with ties broken; larger values are in front
};

/// Compute which part of a planar shape is in front where a pose makes parts overlap. Each handle
/// has a layer (any real number), and its weights extend the layer over the shape. Parts that are
/// near but not connected get the depth of their own handles. Rows that do not sum to one are
/// divided by their sum, so that no layer is pulled toward zero. A row of zeros gets the depth 0.
/// Report: least_depth, largest_depth.
/// @param weights #V x #handles, finite
/// @param layers one per handle, finite
Status depth_order(WeightsView weights, const Eigen::VectorXd& layers,
  const DepthOrderOptions& options, ExecutionContext& context, DepthOrder& result);

} // namespace bindpose

#endif
