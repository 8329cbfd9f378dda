#include "deformation.h"

#include "report_field_data.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkPolyData.h"
#include "vtkReducedARAP.h"
#include "vtkSkinningDeformation.h"

#include <chrono>

namespace
{
/// Errors and warnings go to the window's error bar, not to the terminal.
void keep_quiet(vtkObject*, unsigned long, void*, void*) {}
} // namespace

Deformation::Deformation()
{
  vtkNew<vtkCallbackCommand> quiet;
  quiet->SetCallback(keep_quiet);
  for (vtkObject* filter :
    { static_cast<vtkObject*>(this->skinning_), static_cast<vtkObject*>(this->arap_) })
  {
    filter->AddObserver(vtkCommand::ErrorEvent, quiet);
    filter->AddObserver(vtkCommand::WarningEvent, quiet);
  }
  // A drag shows what it stretches; nobody reads its report.
  this->skinning_->SetStretchLimit(0.0);
  this->arap_->SetStretchLimit(0.0);
}

Deformation::~Deformation() = default;

void Deformation::set_input(vtkPolyData* surface, vtkPolyData* handles)
{
  this->surface_ = surface;
  this->skinning_->SetInputData(0, surface);
  this->skinning_->SetInputData(1, handles);
  this->arap_->SetInputData(0, surface);
  this->arap_->SetInputData(1, handles);
}

void Deformation::clear()
{
  this->set_input(nullptr, nullptr);
}

vtkBindposeAlgorithm* Deformation::filter() const
{
  return this->method_ == reduced_arap ? static_cast<vtkBindposeAlgorithm*>(this->arap_.Get())
                                       : static_cast<vtkBindposeAlgorithm*>(this->skinning_.Get());
}

vtkPolyData* Deformation::posed()
{
  if (!this->surface_)
  {
    return nullptr;
  }
  this->skinning_->SetMethod(this->method_ == dual_quaternion
      ? vtkSkinningDeformation::DUAL_QUATERNION
      : vtkSkinningDeformation::LINEAR_BLEND);
  vtkBindposeAlgorithm* filter = this->filter();
  const auto start = std::chrono::steady_clock::now();
  filter->Update();
  this->milliseconds_ =
    std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutput());
  this->microseconds_ = bindpose::read_report(output).number("microseconds_per_iteration", 0.0);
  this->error_.clear();
  if (filter->GetStatus() > vtkBindposeAlgorithm::NOT_CONVERGED)
  {
    this->error_ = filter->GetStatusMessage();
    return nullptr;
  }
  return output;
}
