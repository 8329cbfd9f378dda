#ifndef bindpose_weights_weight_solve_h
#define bindpose_weights_weight_solve_h

#include "weights/column_groups.h"

#include <functional>

namespace bindpose
{

/// Solve the quadratic programs of all columns, with all optional terms, for bounded and monotone
/// weights. The columns are solved separately or together (see PartitionOfUnity). If the number of
/// influences is limited, all columns are solved again, with the excluded weights fixed at 0.
/// @param guide called for each group before its columns are solved, to add the ordered pairs of
/// monotone weights; may be empty. Progress phase "guide".
Status solve_weights(ExecutionContext& context, const WeightsProblem& problem, int order,
  const std::string& method, const WeightsOptions& options,
  const std::function<Status(ColumnGroup&)>& guide, WeightsResult& result);

} // namespace bindpose

#endif
