// Finds the kernel of the method in the registry of weight methods.
#include "vtkUnconstrainedWeights.h"

#include "weights/weight_methods.h"

#include "vtkObjectFactory.h"

using namespace bindpose;

vtkStandardNewMacro(vtkUnconstrainedWeights);

vtkUnconstrainedWeights::vtkUnconstrainedWeights() = default;

vtkUnconstrainedWeights::~vtkUnconstrainedWeights() = default;

void vtkUnconstrainedWeights::SetMethod(const std::string& word)
{
  this->SetBindParameter(this->Method, word);
}

void vtkUnconstrainedWeights::SetPower(double value)
{
  this->SetBindParameter(this->Power, value);
}

void vtkUnconstrainedWeights::SetSmoothing(double value)
{
  this->SetBindParameter(this->Smoothing, value);
}

void vtkUnconstrainedWeights::SetHeat(double value)
{
  this->SetBindParameter(this->Heat, value);
}

Status vtkUnconstrainedWeights::Solve(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result)
{
  const WeightMethod* method = find_weight_method(this->Method);
  if (!method || method->constrained)
  {
    return Status::invalid_input(
      "unknown method '" + this->Method + "': expected one of " + weight_method_words(false));
  }
  WeightsOptions filter_options = options;
  filter_options.power = this->Power;
  filter_options.smoothing = this->Smoothing;
  filter_options.heat = this->Heat;
  return method->kernel(context, problem, filter_options, result);
}

void vtkUnconstrainedWeights::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "Power: " << this->Power << "\n";
  os << indent << "Smoothing: " << this->Smoothing << "\n";
  os << indent << "Heat: " << this->Heat << "\n";
}
