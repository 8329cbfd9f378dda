// Connects the kernels bindpose::unconstrained_weights() and bindpose::baseline_weights() to VTK.
#include "vtkUnconstrainedWeights.h"

#include "weights/baseline_weights.h"
#include "weights/unconstrained_weights.h"

#include "vtkObjectFactory.h"

#include <algorithm>

using namespace bindpose;

vtkStandardNewMacro(vtkUnconstrainedWeights);

vtkUnconstrainedWeights::vtkUnconstrainedWeights() = default;

vtkUnconstrainedWeights::~vtkUnconstrainedWeights() = default;

void vtkUnconstrainedWeights::SetMethod(int value)
{
  value = std::clamp<int>(value, HARMONIC, BONE_HEAT);
  this->SetBindParameter(this->Method, value);
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

Status vtkUnconstrainedWeights::Solve(const WeightsProblem& problem, const WeightsOptions& options,
  ExecutionContext& context, WeightsResult& result)
{
  if (this->Method >= INVERSE_DISTANCE)
  {
    BaselineWeightsOptions own;
    static_cast<WeightsOptions&>(own) = options;
    own.method = static_cast<BaselineMethod>(this->Method);
    own.power = this->Power;
    own.smoothing = this->Smoothing;
    own.heat = this->Heat;
    return baseline_weights(problem, own, context, result);
  }
  UnconstrainedWeightsOptions own;
  static_cast<WeightsOptions&>(own) = options;
  own.method = static_cast<UnconstrainedMethod>(this->Method);
  return unconstrained_weights(problem, own, context, result);
}

void vtkUnconstrainedWeights::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "Power: " << this->Power << "\n";
  os << indent << "Smoothing: " << this->Smoothing << "\n";
  os << indent << "Heat: " << this->Heat << "\n";
}
