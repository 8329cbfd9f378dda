#ifndef bindpose_weights_weight_solve_h
#define bindpose_weights_weight_solve_h

#include "weights/column_groups.h"

#include <functional>

namespace bindpose
{

/// Solve the quadratic programs of all columns, with all optional terms, for bounded and monotone
/// weights. The columns are solved separately or coupled. They are solved a second time if the
/// number of influences is limited.
/// @param guide adds the ordered pairs of monotone weights to the columns of a group before they
/// are solved; may be empty. Progress phase "guide".
Status solve_weights(const WeightsProblem& problem, int order, const std::string& method,
  const WeightsOptions& options, const std::function<Status(ColumnGroup&)>& guide,
  ExecutionContext& context, WeightsResult& result);

} // namespace bindpose

#endif
