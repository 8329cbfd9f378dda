// Connects the kernel bindpose::ReducedDynamics to VTK. The executive calls the filter once per
// time step that is not simulated yet (CONTINUE_EXECUTING, like other temporal filters), so that
// the handles can be requested at the time of each step.
//
// Simulated steps are valid until an input changes. The modification times of the pose arrays
// cannot detect such a change, because these arrays are also replaced at every time step. Instead
// the filter compares the pipeline modification times of the inputs, which change whenever an
// algorithm upstream changes.
#include "vtkReducedDynamics.h"

#include "arap/reduced_dynamics.h"
#include "arap_input.h"
#include "frame_times.h"
#include "pose_input.h"

#include "vtkDataArray.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>

using namespace bindpose;
using SDDP = vtkStreamingDemandDrivenPipeline;

vtkStandardNewMacro(vtkReducedDynamics);

struct vtkReducedDynamics::Internals
{
  ReducedDynamics body;
  bool started = false;
  Index target = 0; ///< time step that is requested
  Index next = 0; ///< time step for which the handles are requested; 0 starts the simulation
  bool must_continue = false; ///< more time steps are needed after this one
  /// Pipeline modification time of each input at the last request. If one of them changes, the
  /// simulation starts again, except in interactive mode.
  std::vector<vtkMTimeType> upstream;
};

vtkReducedDynamics::vtkReducedDynamics() : Internal(new Internals) {}

vtkReducedDynamics::~vtkReducedDynamics() = default;

void vtkReducedDynamics::SetTimeStep(double seconds)
{
  this->SetMotionParameter(this->TimeStep, seconds);
}

void vtkReducedDynamics::SetGravity(double x, double y, double z)
{
  for (const auto& [component, value] : { std::pair(0, x), std::pair(1, y), std::pair(2, z) })
  {
    this->SetMotionParameter(this->Gravity[component], value);
  }
}

void vtkReducedDynamics::SetGravity(const double gravity[3])
{
  this->SetGravity(gravity[0], gravity[1], gravity[2]);
}

void vtkReducedDynamics::SetDensity(double density)
{
  this->SetMotionParameter(this->Density, density);
}

void vtkReducedDynamics::SetStiffness(double stiffness)
{
  this->SetMotionParameter(this->Stiffness, stiffness);
}

void vtkReducedDynamics::SetDamping(double damping)
{
  this->SetMotionParameter(this->Damping, damping);
}

void vtkReducedDynamics::SetMaximumIterations(int iterations)
{
  iterations = std::clamp(iterations, 1, 1000000);
  this->SetMotionParameter(this->MaximumIterations, iterations);
}

void vtkReducedDynamics::SetTolerance(double tolerance)
{
  tolerance = std::clamp(tolerance, 0.0, 1.0);
  this->SetMotionParameter(this->Tolerance, tolerance);
}

void vtkReducedDynamics::SetMixedPrecision(bool mixed)
{
  this->SetMotionParameter(this->MixedPrecision, mixed);
}

void vtkReducedDynamics::SetInteractive(bool interactive)
{
  this->SetMotionParameter(this->Interactive, interactive);
}

void vtkReducedDynamics::Restart()
{
  this->Internal->started = false;
  this->Modified();
}

int vtkReducedDynamics::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  vtkInformation* info = output->GetInformationObject(0);
  std::vector<double> times;
  const bool timed = !this->Interactive && this->TimeStep > 0.0;
  for (int step = 0; timed && step <= this->NumberOfSteps; ++step)
  {
    times.push_back(step * this->TimeStep);
  }
  set_time_steps(info, times);
  return 1;
}

int vtkReducedDynamics::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  this->Superclass::RequestUpdateExtent(request, input, output);
  Internals& state = *this->Internal;
  std::vector<vtkMTimeType> upstream;
  for (int port = 0; port < 2; ++port)
  {
    auto* executive = this->GetNumberOfInputConnections(port) > 0
      ? vtkDemandDrivenPipeline::SafeDownCast(this->GetInputExecutive(port, 0))
      : nullptr;
    upstream.push_back(executive ? executive->GetPipelineMTime() : 0);
  }
  state.started = state.started && (this->Interactive || state.upstream == upstream);
  state.upstream = upstream;
  vtkInformation* info = output->GetInformationObject(0);
  const auto done = state.body.state().steps;
  if (this->Interactive)
  {
    state.target = state.next = state.started ? done + 1 : 0;
    return 1;
  }
  const bool timed = info->Has(SDDP::UPDATE_TIME_STEP()) != 0 && this->TimeStep > 0.0;
  // At a time between two steps the earlier step is shown. The 1e-6 allows for round-off in the
  // times of steps.
  state.target = timed ? static_cast<Index>(std::floor(std::clamp(
                           info->Get(SDDP::UPDATE_TIME_STEP()) / this->TimeStep + 1e-6, 0.0, 1e7)))
                       : this->Step;
  state.started = state.started && done <= state.target;
  state.next = !state.started ? 0 : std::min(done + 1, state.target);
  if (this->GetNumberOfInputConnections(1) > 0)
  {
    input[1]->GetInformationObject(0)->Set(
      SDDP::UPDATE_TIME_STEP(), static_cast<double>(state.next) * this->TimeStep);
  }
  return 1;
}

vtkTypeBool vtkReducedDynamics::ProcessRequest(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  const bool data = request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()) != 0;
  this->Internal->must_continue = false;
  const vtkTypeBool result = this->Superclass::ProcessRequest(request, input, output);
  if (data && this->Internal->must_continue)
  {
    request->Set(SDDP::CONTINUE_EXECUTING(), 1);
  }
  else if (data)
  {
    request->Remove(SDDP::CONTINUE_EXECUTING());
    vtkDataObject* posed = vtkDataObject::GetData(output);
    if (posed && !this->Interactive)
    {
      posed->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(),
        static_cast<double>(this->Internal->target) * this->TimeStep);
    }
  }
  return result;
}

Status vtkReducedDynamics::Execute(
  ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  if (this->GetBlock().composite)
  {
    // The executive calls the filter once per block. It cannot repeat the call for one block to
    // simulate several time steps.
    return Status::invalid_input(
      "a composite mesh cannot be simulated; merge its blocks or extract one");
  }
  return this->Superclass::Execute(context, input, output);
}

Status vtkReducedDynamics::Bind(ExecutionContext& context, const PoseInput& input)
{
  this->Internal->started = false;
  return bind_reduced(context, *this, this->Internal->body, input);
}

Status vtkReducedDynamics::Deform(
  ExecutionContext& context, const PoseInput& input, PosedPoints& posed)
{
  Internals& state = *this->Internal;
  Status status;
  ReducedDynamicsOptions options;
  options.time_step = this->TimeStep;
  options.gravity = Vec3(this->Gravity);
  options.density = this->Density;
  options.stiffness = this->Stiffness;
  options.damping = this->Damping;
  options.solve.tolerance = this->Tolerance;
  options.solve.max_iterations = this->MaximumIterations;
  options.solve.mixed_precision = this->MixedPrecision;
  if (!state.started && state.next > 0)
  {
    // A new bind has reset the simulation, but the handles have the pose of a later time step. Do
    // not simulate now; the next pass requests the handles at time 0.
    state.must_continue = true;
  }
  else
  {
    Phase phase(context, "step", 0.8, 0.9);
    if (state.next == 0)
    {
      ReducedSolveOptions rest_options;
      rest_options.max_iterations = 1000;
      rest_options.mixed_precision = this->MixedPrecision;
      status = state.body.start(context, input.pose, rest_options);
      const Status checked = check_options(options);
      status = checked.ok() ? status : checked;
    }
    else if (state.body.state().steps < state.next)
    {
      status = state.body.step(context, input.pose, options);
    }
    state.started = status.usable();
    if (!status.usable())
    {
      return status;
    }
    state.must_continue = state.body.state().steps < state.target;
  }
  status.report.set("time", Report::Value(state.body.state().time));
  status.report.set("steps", Report::Value(std::int64_t(state.body.state().steps)));
  Phase phase(context, "skin", 0.9, 1.0);
  const Status moved = state.body.deform(context, input.points, posed.points);
  posed.transforms.assign(
    state.body.transforms().begin(), state.body.transforms().begin() + input.weights.cols());
  if (this->GetRotationArrays())
  {
    posed.groups = &state.body.groups();
    posed.rotations = state.body.rotations();
  }
  return moved.ok() ? status : moved;
}

Status vtkReducedDynamics::DeformNormals(
  ExecutionContext& context, const PoseInput& input, const PosedPoints&, PosedPoints& normals)
{
  const SharedMatrix<Weights> rest = to_matrix(input.mesh->GetPointData()->GetNormals());
  const Eigen::Map<const Points> directions(rest.view().data(), rest.view().rows(), 3);
  return this->Internal->body.deform_normals(context, directions, normals.points);
}

void vtkReducedDynamics::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TimeStep: " << this->TimeStep << "\n";
  os << indent << "NumberOfSteps: " << this->NumberOfSteps << "\n";
  os << indent << "Step: " << this->Step << "\n";
  os << indent << "Gravity: (" << this->Gravity[0] << ", " << this->Gravity[1] << ", "
     << this->Gravity[2] << ")\n";
  os << indent << "Density: " << this->Density << "\n";
  os << indent << "Stiffness: " << this->Stiffness << "\n";
  os << indent << "Damping: " << this->Damping << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MixedPrecision: " << (this->MixedPrecision ? "on" : "off") << "\n";
  os << indent << "Interactive: " << (this->Interactive ? "on" : "off") << "\n";
}
