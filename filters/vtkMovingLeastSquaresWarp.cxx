// Connects the kernel bindpose::MovingLeastSquares to VTK.
#include "vtkMovingLeastSquaresWarp.h"

#include "pose_input.h"
#include "skinning/moving_least_squares.h"

#include "vtkObjectFactory.h"

using namespace bindpose;

vtkStandardNewMacro(vtkMovingLeastSquaresWarp);

struct vtkMovingLeastSquaresWarp::Internals
{
  MovingLeastSquares warp;
};

vtkMovingLeastSquaresWarp::vtkMovingLeastSquaresWarp() : Internal(this->GetBlock()) {}

vtkMovingLeastSquaresWarp::~vtkMovingLeastSquaresWarp() = default;

void vtkMovingLeastSquaresWarp::SetExponent(double exponent)
{
  this->SetBindParameter(this->Exponent, exponent);
}

Status vtkMovingLeastSquaresWarp::Bind(ExecutionContext& context, const PoseInput& input)
{
  MovingLeastSquaresOptions options;
  options.exponent = this->Exponent;
  return this->Internal->warp.bind(context, options, input.points, input.handles);
}

StretchUse vtkMovingLeastSquaresWarp::GetStretchUse()
{
  return StretchUse::tails;
}

Status vtkMovingLeastSquaresWarp::Deform(
  ExecutionContext& context, const PoseInput& input, PosedPoints& posed)
{
  Phase phase(context, "warp", 0.8, 1.0);
  Status status = this->Internal->warp.warp(context, input.handles, input.pose, posed.points);
  status.report.set("method", "mls");
  status.report.set("exponent", this->Exponent);
  return status;
}

void vtkMovingLeastSquaresWarp::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Exponent: " << this->Exponent << "\n";
}
