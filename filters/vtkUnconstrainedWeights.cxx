// Glue around the kernel bindpose::unconstrained_weights().
#include "vtkUnconstrainedWeights.h"

#include "weights/unconstrained_weights.h"

#include "vtkObjectFactory.h"

#include <algorithm>

using namespace bindpose;

vtkStandardNewMacro(vtkUnconstrainedWeights);

vtkUnconstrainedWeights::vtkUnconstrainedWeights() = default;

vtkUnconstrainedWeights::~vtkUnconstrainedWeights() = default;

void vtkUnconstrainedWeights::SetMethod(int value)
{
  value = std::clamp(value, 1, 3);
  if (this->Method != value)
  {
    this->Method = value;
    this->BindModified();
  }
}

Status vtkUnconstrainedWeights::Solve(const WeightsProblem& problem, const WeightsOptions& options,
  ExecutionContext& context, WeightsResult& result)
{
  UnconstrainedWeightsOptions own;
  static_cast<WeightsOptions&>(own) = options;
  own.order = this->Method;
  return unconstrained_weights(problem, own, context, result);
}

void vtkUnconstrainedWeights::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->Method << "\n";
}
