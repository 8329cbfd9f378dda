// Bounded biharmonic weights: the general solve of weight_solve.h without constraints on extrema.
#include "weights/bounded_biharmonic_weights.h"

#include "weights/weight_solve.h"

namespace bindpose
{

Status bounded_biharmonic_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result)
{
  result = {};
  if (options.order != 2 && options.order != 3)
  {
    return Status::invalid_input("the order of bounded weights must be 2 or 3");
  }
  return solve_weights(context, problem, options.order,
    options.order == 2 ? "bounded-biharmonic" : "bounded-triharmonic", options, {}, result);
}

} // namespace bindpose
