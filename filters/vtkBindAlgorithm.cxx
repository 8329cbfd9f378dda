// The cache key contains the modification times of the arrays that a bind reads. It contains no
// modification time of a dataset. Editing `Transform` raises the handle dataset's time, and an
// upstream filter that executes again raises its output's time, but neither changes the input of
// the bind.
#include "vtkBindAlgorithm.h"

#include "base/execution.h"
#include "bind_key.h"
#include "io/expression.h"
#include "pose/found_rotations.h"
#include "pose/pose_file.h"
#include "pose_input.h"
#include "weights_input.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <Eigen/LU>

#include <cmath>
#include <optional>

using namespace bindpose;

struct vtkBindAlgorithm::Cache
{
  bool valid = false;
  BindKey key;
  Handles handles;
  std::vector<Index> cells;
  SharedMatrix<Points> points;
  SharedMatrix<Weights> weights;
  Status status; // status of the bind: its report and warnings are part of every output

  // State of the current execution; `bound_now` is true if this execution has computed the bind.
  bool bound_now = false;
  std::vector<std::string> pose_warnings;
  Pose pose;
  std::optional<PoseInput> input;
};

namespace
{
/// Threshold below which a transform is singular: determinant / (norm of the linear part)^3.
constexpr double volume_tolerance = 1e-12;

/// Apply the text of a pose file to a pose. The text must contain one pose, for time 0.
Status apply_pose_text(const std::string& text, const Handles& handles, Pose& pose)
{
  // Create the parser only for expressions, because its constructor takes longer than most poses.
  std::optional<ExpressionParser> parser;
  PoseSequence sequence;
  Status status = parse_pose_file(text, handles, sequence,
    [&parser](const std::string& expression, double t, double& value)
    {
      if (!parser)
      {
        parser.emplace();
      }
      return parser->evaluate(expression, t, value);
    });
  if (status.ok() && sequence.sequence)
  {
    status = Status::invalid_input("the text has a sequence of frames; expected one pose");
  }
  if (status.ok())
  {
    pose = apply_edits(sequence.frames[0], handles, pose);
  }
  return status;
}

/// Return warnings that name the handles in mode full whose transform is a reflection or is
/// singular.
std::vector<std::string> transform_warnings(const Handles& handles, const Pose& pose)
{
  std::vector<Index> mirrored, collapsed;
  for (std::size_t h = 0; h < pose.size(); ++h)
  {
    const Eigen::Matrix3d linear = pose[h].transform.leftCols<3>();
    const double volume = linear.determinant(), size = linear.norm();
    if (!constrains_transform(pose[h].mode))
    {
      continue;
    }
    if (!(std::abs(volume) > volume_tolerance * size * size * size))
    {
      collapsed.push_back(static_cast<Index>(h));
    }
    else if (volume < 0.0)
    {
      mirrored.push_back(static_cast<Index>(h));
    }
  }
  std::vector<std::string> warnings;
  if (!mirrored.empty())
  {
    warnings.push_back("the transforms of these handles are reflections, which invert the mesh: " +
      quoted_names(handles, mirrored));
  }
  if (!collapsed.empty())
  {
    warnings.push_back(
      "the transforms of these handles scale a direction to zero, which flattens the mesh: " +
      quoted_names(handles, collapsed));
  }
  return warnings;
}
} // namespace

vtkBindAlgorithm::vtkBindAlgorithm() : BindCache(this->GetBlock())
{
  this->BindTime.Modified();
}

vtkBindAlgorithm::~vtkBindAlgorithm() = default;

void vtkBindAlgorithm::SetArrayName(const std::string& name)
{
  this->SetBindParameter(this->ArrayName, name);
}

std::vector<std::string> vtkBindAlgorithm::BindArrays()
{
  return std::vector<std::string>(this->NeedsWeights() ? 1 : 0, this->ArrayName);
}

void vtkBindAlgorithm::BindModified()
{
  this->BindTime.Modified();
  this->Modified();
}

int vtkBindAlgorithm::RequestInformation(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  // The executive copies the time steps of port 0 (the mesh). If another port (the poses) has time
  // steps, they replace those of the mesh.
  using SDDP = vtkStreamingDemandDrivenPipeline;
  vtkInformation* info = output->GetInformationObject(0);
  for (int port = this->GetNumberOfInputPorts() - 1; port > 0; --port)
  {
    vtkInformation* poses = input[port]->GetInformationObject(0);
    if (poses && poses->Has(SDDP::TIME_RANGE()))
    {
      info->CopyEntry(poses, SDDP::TIME_RANGE());
      info->Remove(SDDP::TIME_STEPS());
      if (poses->Has(SDDP::TIME_STEPS()))
      {
        info->CopyEntry(poses, SDDP::TIME_STEPS());
      }
      break;
    }
  }
  return 1;
}

Status vtkBindAlgorithm::Prepare(
  ExecutionContext& context, vtkInformationVector** input, const std::string& pose)
{
  auto* mesh = vtkPointSet::GetData(input[0], 0);
  auto* handle_data = vtkPolyData::GetData(input[1], 0);
  if (!mesh || mesh->GetNumberOfPoints() == 0)
  {
    return Status::invalid_input("the mesh to pose is empty");
  }
  vtkDataArray* weights =
    this->NeedsWeights() ? mesh->GetPointData()->GetArray(this->ArrayName.c_str()) : nullptr;
  if (!weights && this->NeedsWeights())
  {
    return missing_weights_error(mesh, this->ArrayName);
  }
  if (!handle_data && this->NeedsHandles())
  {
    return Status::invalid_input("the input has no handles");
  }

  BindKey key;
  key.add(this->BindTime.GetMTime());
  for (vtkObject* object : bind_objects(mesh, this->BindArrays()))
  {
    key.add(object);
  }
  if (handle_data)
  {
    for (vtkObject* object : bind_objects(handle_data))
    {
      key.add(object);
    }
  }
  const bool bind = !this->BindCache->valid || this->BindCache->key != key;
  if (bind)
  {
    this->BindCache.reset();
  }
  Cache& bound = *this->BindCache;
  if (bind)
  {
    Status status;
    if (handle_data)
    {
      status = to_handles(handle_data, bound.handles, &bound.cells);
    }
    if (!status.ok())
    {
      return status;
    }
    if (weights)
    {
      status = check_weights(weights, mesh->GetNumberOfPoints(), bound.handles);
      if (!status.ok())
      {
        return status;
      }
      bound.weights = to_matrix(weights);
    }
    bound.points = to_points(mesh);
    if (!bound.points.view().allFinite())
    {
      return Status::invalid_input("the mesh has a coordinate that is not a finite number");
    }
  }
  Status status;
  if (handle_data)
  {
    status = to_pose(handle_data, bound.handles, bound.cells, bound.pose);
    if (status.ok() && !pose.empty())
    {
      status = apply_pose_text(pose, bound.handles, bound.pose);
    }
    if (status.ok() && this->FindsRotations())
    {
      bound.pose = resolve_automatic_modes(bound.handles, bound.pose);
    }
  }
  if (!status.ok())
  {
    return status;
  }
  bound.pose_warnings = transform_warnings(bound.handles, bound.pose);
  bound.pose_warnings.insert(
    bound.pose_warnings.end(), status.warnings.begin(), status.warnings.end());
  bound.input.emplace(PoseInput{ mesh, bound.points.view(), bound.weights.view(), bound.handles,
    bound.pose, handle_data, bound.cells });
  bound.bound_now = bind;
  if (bind)
  {
    Phase phase(context, "bind", 0.0, 0.8);
    const Status bind_status = this->Bind(context, *bound.input);
    if (!bind_status.usable())
    {
      return bind_status;
    }
    bound.status.report.merge(bind_status.report);
    bound.status.warnings.insert(
      bound.status.warnings.end(), bind_status.warnings.begin(), bind_status.warnings.end());
    bound.key = key;
    bound.valid = true;
    this->NumberOfBinds += 1;
  }
  return {};
}

const PoseInput& vtkBindAlgorithm::GetPoseInput() const
{
  return *this->BindCache->input;
}

Status vtkBindAlgorithm::WithBindReport(const Status& posed) const
{
  const Cache& bound = *this->BindCache;
  Status total = posed;
  Report report;
  report.set("counts.vertices", static_cast<int>(bound.points.view().rows()));
  report.set("counts.handles", static_cast<int>(bound.handles.size()));
  report.set("binds", this->NumberOfBinds);
  report.merge(bound.status.report);
  report.merge(posed.report);
  total.report = report;
  total.warnings.insert(
    total.warnings.begin(), bound.pose_warnings.begin(), bound.pose_warnings.end());
  if (bound.bound_now)
  {
    total.warnings.insert(
      total.warnings.begin(), bound.status.warnings.begin(), bound.status.warnings.end());
  }
  return total;
}

void vtkBindAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "NumberOfBinds: " << this->NumberOfBinds << "\n";
}
