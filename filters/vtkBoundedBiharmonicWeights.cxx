// Connects the kernel bindpose::bounded_biharmonic_weights() to VTK.
#include "vtkBoundedBiharmonicWeights.h"

#include "weights/bounded_biharmonic_weights.h"

#include "vtkObjectFactory.h"

#include <algorithm>

using namespace bindpose;

vtkStandardNewMacro(vtkBoundedBiharmonicWeights);

vtkBoundedBiharmonicWeights::vtkBoundedBiharmonicWeights() = default;

vtkBoundedBiharmonicWeights::~vtkBoundedBiharmonicWeights() = default;

void vtkBoundedBiharmonicWeights::SetOrder(int value)
{
  value = std::clamp(value, 2, 3);
  this->SetBindParameter(this->Order, value);
}

Status vtkBoundedBiharmonicWeights::Solve(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result)
{
  WeightsOptions filter_options = options;
  filter_options.order = this->Order;
  return bounded_biharmonic_weights(context, problem, filter_options, result);
}

void vtkBoundedBiharmonicWeights::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Order: " << this->Order << "\n";
}
