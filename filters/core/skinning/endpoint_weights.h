#ifndef bindpose_skinning_endpoint_weights_h
#define bindpose_skinning_endpoint_weights_h

// Endpoint weights of bones, which are 0 at the head and 1 at the tail, for stretchable, twistable
// bones (Jacobson and Sorkine 2011).

#include "base/execution.h"
#include "handles/handles.h"

#include <functional>

namespace bindpose
{

/// Method that extends a bone's endpoint weight, 0 at its head and 1 at its tail, over the shape.
/// The integers are those of vtkBoneEndpointWeights.
enum class EndpointMethod : int
{
  /// Projection onto the bone, clamped (fraction_along_bone); independent of the shape.
  projection = 0,
  /// W_tail / (W_head + W_tail), where W are bounded biharmonic weights of point handles at the
  /// ends of all bones. One problem is solved for all bones.
  joints = 1,
  /// The function with values from 0 to 1 that is linear along the bone and has the minimum
  /// biharmonic energy. It is the weight of the tail in an open cage of one edge. One problem is
  /// solved per bone.
  bounded = 2
};

/// Return "projection", "joints" or "bounded".
const char* to_string(EndpointMethod method);

/// Return invalid_input for an endpoint weight outside [0, 1], with its handle and point. NaN is
/// valid.
/// @param array  name of the array, for the message
Status check_endpoint_weights(
  WeightsView endpoints, const Handles& handles, const std::string& array);

/// Function that computes bounded biharmonic weights of handles at the points. The rows must sum to
/// one.
using BoundedSolve = std::function<Status(ExecutionContext&, const Handles&, Weights&)>;

/// Compute endpoint weights of stretchable, twistable bones (Jacobson and Sorkine 2011), see
/// Skinning. Let p be the result of method `projection`. The method `joints` computes
///   (W_tail + 1e-4 p) / (W_head + W_tail + 1e-4).
/// Therefore its result changes continuously to p where W_head and W_tail vanish.
/// @param endpoints #V x #handles, values from 0 to 1; NaN in the columns of handles that are not
/// bones.
/// @return invalid_input if there is no bone; otherwise the status of `solve`, with each warning
/// once. The report contains method, counts.bones and counts.problems (number of solved problems).
Status endpoint_weights(ExecutionContext& context, PointsView points, const Handles& handles,
  EndpointMethod method, const BoundedSolve& solve, Weights& endpoints);

} // namespace bindpose

#endif
