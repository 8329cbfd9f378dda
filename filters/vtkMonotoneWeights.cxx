// Connects the kernel bindpose::monotone_weights() to VTK.
#include "vtkMonotoneWeights.h"

#include "weights/monotone_weights.h"

#include "vtkObjectFactory.h"

#include <algorithm>

using namespace bindpose;

vtkStandardNewMacro(vtkMonotoneWeights);

vtkMonotoneWeights::vtkMonotoneWeights() = default;

vtkMonotoneWeights::~vtkMonotoneWeights() = default;

void vtkMonotoneWeights::SetOrder(int value)
{
  value = std::clamp(value, 2, 3);
  this->SetBindParameter(this->Order, value);
}

Status vtkMonotoneWeights::Solve(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result)
{
  WeightsOptions filter_options = options;
  filter_options.order = this->Order;
  return monotone_weights(context, problem, filter_options, result);
}

void vtkMonotoneWeights::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Order: " << this->Order << "\n";
}
