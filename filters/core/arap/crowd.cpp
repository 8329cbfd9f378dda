// Poses of many instances. All instances use one ReducedSpace and one ReducedSolver. The rotations
// of an instance are moved into the solver before its solve and copied back afterward.
#include "arap/crowd.h"

namespace bindpose
{

template <typename Elements>
Status Crowd::bind_elements(ExecutionContext& context, PointsView points, const Elements& elements,
  WeightsView weights, const Handles& handles, const ReducedArapOptions& options)
{
  *this = Crowd();
  ReducedArapOptions single = options;
  single.skinning.single_precision = true;
  Status status = this->space_.bind(context, points, elements, weights, handles, single);
  this->zero_load_ = ReducedSpace::Rows::Zero(4 * this->space_.columns, 3);
  return status;
}

Status Crowd::bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
  WeightsView weights, const Handles& handles, const ReducedArapOptions& options)
{
  return this->bind_elements(context, points, triangles, weights, handles, options);
}

Status Crowd::bind(ExecutionContext& context, PointsView points, TetsView tets, WeightsView weights,
  const Handles& handles, const ReducedArapOptions& options)
{
  return this->bind_elements(context, points, tets, weights, handles, options);
}

Status Crowd::solve(
  ExecutionContext& context, const std::vector<Pose>& poses, const ReducedSolveOptions& options)
{
  Status all;
  std::int64_t iterations = 0, single_iterations = 0, not_converged = 0;
  this->rotations_.resize(poses.size());
  this->transforms_.resize(poses.size());
  ReducedSpace::Rows d;
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    if (context.canceled())
    {
      return Status::canceled();
    }
    if (this->rotations_[i].empty())
    {
      this->solver_.discard_rotations();
    }
    else
    {
      this->solver_.set_rotations(std::move(this->rotations_[i]));
    }
    Status status = this->solver_.solve(
      context, this->space_, { this->space_.stiffness, this->zero_load_ }, poses[i], options, d);
    if (!status.usable())
    {
      // After a failure, the instance keeps the transforms of its last successful solve. Its next
      // solve starts without previous rotations.
      this->rotations_[i].clear();
      if (status.code != StatusCode::canceled)
      {
        status.message = "instance " + std::to_string(i) + ": " + status.message;
      }
      return status;
    }
    this->rotations_[i] = this->solver_.rotations();
    this->transforms_[i] = this->space_.transforms_of(d, poses[i]);
    iterations += static_cast<std::int64_t>(status.report.number("iterations", 0));
    single_iterations +=
      static_cast<std::int64_t>(status.report.number("single_precision_iterations", 0));
    if (status.code == StatusCode::not_converged)
    {
      not_converged += 1;
    }
    if (all.warnings.empty())
    {
      all.warnings = std::move(status.warnings);
    }
  }
  if (not_converged > 0)
  {
    all.code = StatusCode::not_converged;
    all.message = std::to_string(not_converged) + " of " + std::to_string(poses.size()) +
      " instances did not converge within the maximum number of iterations";
  }
  all.report.set("counts.instances", static_cast<std::int64_t>(poses.size()));
  all.report.set("counts.not_converged", not_converged);
  all.report.set("iterations", iterations);
  all.report.set("single_precision_iterations", single_iterations);
  return all;
}

Status Crowd::deform(ExecutionContext& context, PointsView rest, std::vector<FloatPoints>& posed,
  const std::vector<Affine>& placements) const
{
  return this->space_.skinning.linear_blend_many(
    context, rest, this->transforms_, posed, placements);
}

Status Crowd::deform(ExecutionContext& context, PointsView rest, const std::vector<float*>& posed,
  const std::vector<Affine>& placements) const
{
  return this->space_.skinning.linear_blend_many(
    context, rest, this->transforms_, posed, placements);
}

Status Crowd::deform_normals(ExecutionContext& context, PointsView rest_normals,
  std::vector<FloatPoints>& posed, const std::vector<Affine>& placements) const
{
  posed.resize(this->transforms_.size());
  Points normals;
  for (std::size_t i = 0; i < posed.size(); ++i)
  {
    const Status status = this->space_.skinning.linear_blend_normals(
      context, rest_normals, this->transforms_[i], normals);
    if (!status.ok())
    {
      return status;
    }
    if (!placements.empty())
    {
      // Normals transform by the cofactor matrix of a map; its columns are cross products of the
      // map's columns.
      const Eigen::Matrix3d linear = placements[i].leftCols<3>();
      Eigen::Matrix3d cofactor;
      cofactor << linear.col(1).cross(linear.col(2)), linear.col(2).cross(linear.col(0)),
        linear.col(0).cross(linear.col(1));
      normals = (normals * cofactor.transpose()).rowwise().normalized().eval();
    }
    posed[i] = normals.cast<float>();
  }
  return {};
}

} // namespace bindpose
