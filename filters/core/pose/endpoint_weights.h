#ifndef bindpose_pose_endpoint_weights_h
#define bindpose_pose_endpoint_weights_h

#include "base/execution.h"
#include "weights/handles.h"

#include <functional>

namespace bindpose
{

/// How a bone's endpoint weight, 0 at its head and 1 at its tail, goes on through the shape. The
/// integers are those of vtkBoneEndpointWeights.
enum class EndpointMethod : int
{
  projection = 0, ///< onto the bone, clamped (projected_endpoint): knows nothing of the shape
  /// W_tail / (W_head + W_tail) of bounded biharmonic weights with all ends of bones as points:
  /// one problem for all bones.
  joints = 1,
  /// Of least biharmonic energy between 0 and 1 while linear along the bone: a problem for each
  /// bone. It is the weight of the tail in an open cage of one edge.
  bounded = 2
};

/// "projection", "joints", "bounded"
const char* to_string(EndpointMethod method);

/// Bounded biharmonic weights of these handles at the points, rows that sum to one.
using BoundedSolve = std::function<Status(const Handles&, ExecutionContext&, Weights&)>;

/// Endpoint weights of stretchable, twistable bones (Jacobson and Sorkine 2011), see Skinning.
/// Where both ends' weights vanish, joints counts as projection: that takes part with 1e-4 of a
/// weight, so that nothing jumps.
/// @param endpoints #V x #handles, 0 to 1; NaN in the columns of handles that are no bones.
/// Report: method, counts.bones, counts.problems (solved). invalid_input without a bone; what
/// `solve` returns otherwise, its warnings each once.
Status endpoint_weights(PointsView points, const Handles& handles, EndpointMethod method,
  const BoundedSolve& solve, ExecutionContext& context, Weights& endpoints);

} // namespace bindpose

#endif
