#ifndef bindpose_weights_weight_solve_h
#define bindpose_weights_weight_solve_h

#include "weights/column_groups.h"

#include <functional>

namespace bindpose
{

/// What bounded and monotone weights share: the quadratic programs of all columns with all terms,
/// solved alone or coupled, and again where the number of influences is limited.
/// @param guide adds to the columns of a group before they are solved for; may be empty. Phase
/// "guide".
Status solve_weights(const WeightsProblem& problem, int order, const std::string& method,
  const WeightsOptions& options, const std::function<Status(ColumnGroup&)>& guide,
  ExecutionContext& context, WeightsResult& result);

} // namespace bindpose

#endif
