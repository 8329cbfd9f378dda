#ifndef bindpose_poser_bone_endpoints_h
#define bindpose_poser_bone_endpoints_h

#include "domain/domain.h"
#include "skinning/endpoint_weights.h"
#include "weights/surface_weights.h"

namespace bindpose
{

/// Compute the endpoint weights of bones (endpoint_weights) from bounded biharmonic weights at the
/// points of a shape.
/// @param domain  the domain in which the weights are solved if the shape is a surface. A shape of
/// tets is its own domain.
/// @param endpoints  #V x #handles
Status solve_endpoint_weights(ExecutionContext& context, const Domain& shape,
  const Handles& handles, EndpointMethod method, WeightsDomain domain, Weights& endpoints);

} // namespace bindpose

#endif
