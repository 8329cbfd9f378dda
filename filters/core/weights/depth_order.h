#ifndef bindpose_weights_depth_order_h
#define bindpose_weights_depth_order_h

#include "base/execution.h"
#include "base/mesh.h"

namespace bindpose
{

struct DepthOrderOptions
{
  /// Where layers are equal, handles later in the list are in front: by this much of a layer from
  /// the first to the last, >= 0. Part of `front` only, never of `depth`.
  double tie = 1e-3;
};

struct DepthOrder
{
  Eigen::VectorXd depth; ///< #V: sum_j w_j d_j. Equal layers: that layer, everywhere.
  Eigen::VectorXd front; ///< #V: depth, with ties told apart; what is larger is in front
};

/// Which part of a planar shape is in front of which, where a pose makes them overlap: each handle
/// has a layer, whole or not, and its weights carry it over the shape. Of near parts that are not
/// connected each has its own handles' depth.
/// Rows that do not sum to one are divided by their sum, so that no layer is nearer to zero than it
/// should be; a row of zeros gets the depth 0.
/// Report: least_depth, largest_depth.
/// @param weights #V x #handles, finite
/// @param layers one a handle, finite
Status depth_order(WeightsView weights, const Eigen::VectorXd& layers,
  const DepthOrderOptions& options, ExecutionContext& context, DepthOrder& result);

} // namespace bindpose

#endif
