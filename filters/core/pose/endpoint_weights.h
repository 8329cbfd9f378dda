#ifndef bindpose_pose_endpoint_weights_h
#define bindpose_pose_endpoint_weights_h

#include "base/execution.h"
#include "weights/handles.h"

#include <functional>

namespace bindpose
{

/// Method that extends a bone's endpoint weight, 0 at its head and 1 at its tail, over the shape.
/// The integers are those of vtkBoneEndpointWeights.
enum class EndpointMethod : int
{
  /// Projection onto the bone, clamped (projected_endpoint); independent of the shape.
  projection = 0,
  /// W_tail / (W_head + W_tail) of bounded biharmonic weights with the ends of all bones as points:
  /// one problem for all bones.
  joints = 1,
  /// Minimal biharmonic energy between 0 and 1, linear along the bone: one problem per bone. This
  /// is the weight of the tail in an open cage of one edge.
  bounded = 2
};

/// Return "projection", "joints" or "bounded".
const char* to_string(EndpointMethod method);

/// Compute bounded biharmonic weights of the handles at the points; the rows sum to one.
using BoundedSolve = std::function<Status(const Handles&, ExecutionContext&, Weights&)>;

/// Compute endpoint weights of stretchable, twistable bones (Jacobson and Sorkine 2011), see
/// Skinning. In the method `joints`, the projection is blended in with a weight of 1e-4. Where the
/// weights of both ends vanish, the result is therefore the projection, without a jump.
/// @param endpoints #V x #handles, 0 to 1; NaN in the columns of handles that are not bones.
/// @return invalid_input if there is no bone; otherwise the status of `solve`, with each warning
/// once. Report: method, counts.bones, counts.problems (solved).
Status endpoint_weights(PointsView points, const Handles& handles, EndpointMethod method,
  const BoundedSolve& solve, ExecutionContext& context, Weights& endpoints);

} // namespace bindpose

#endif
