// Reduced as-rigid-as-possible: combines a ReducedSpace computed at bind time, a ReducedSolver, and
// the resulting transforms.
#include "arap/reduced_arap.h"

#include "pose/rotation_fit.h"

namespace bindpose
{

template <typename Elements>
Status ReducedArap::bind_elements(ExecutionContext& context, PointsView points,
  const Elements& elements, WeightsView weights, const Handles& handles,
  const ReducedArapOptions& options)
{
  *this = ReducedArap();
  Status status = this->space_.bind(context, points, elements, weights, handles, options);
  this->zero_load_ = ReducedSpace::Rows::Zero(4 * this->space_.columns, 3);
  this->transforms_.assign(static_cast<std::size_t>(this->space_.columns), identity_affine());
  return status;
}

Status ReducedArap::bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
  WeightsView weights, const Handles& handles, const ReducedArapOptions& options)
{
  return this->bind_elements(context, points, triangles, weights, handles, options);
}

Status ReducedArap::bind(ExecutionContext& context, PointsView points, TetsView tets,
  WeightsView weights, const Handles& handles, const ReducedArapOptions& options)
{
  return this->bind_elements(context, points, tets, weights, handles, options);
}

Status ReducedArap::solve(ExecutionContext& context, const Pose& pose, const SolveOptions& options)
{
  ReducedSpace::Rows d;
  Status status = this->solver_.solve(
    context, this->space_, { this->space_.stiffness, this->zero_load_ }, pose, options, d);
  if (status.usable())
  {
    this->transforms_ = this->space_.transforms_of(d, pose);
  }
  return status;
}

Status ReducedArap::deform(ExecutionContext& context, PointsView rest, PointsOutput posed) const
{
  return this->space_.skinning.linear_blend(context, rest, this->transforms_, posed);
}

Status ReducedArap::weights(ExecutionContext& context, Weights& weights) const
{
  // Compute the weights by linear blend skinning of vertices at the origin. If the transform of one
  // column is a unit translation and all other transforms are the identity, the displacement of
  // each vertex equals its weight in this column. One blend yields the weights of three columns,
  // because each of the three columns is translated along a separate axis.
  const Index columns = this->space_.columns;
  const Points origin = Points::Zero(this->space_.skinning.vertex_count(), 3);
  Points moved;
  weights.resize(origin.rows(), columns);
  for (Index first = 0; first < columns; first += 3)
  {
    std::vector<Affine> steps(static_cast<std::size_t>(columns), identity_affine());
    const Index count = std::min<Index>(3, columns - first);
    for (Index k = 0; k < count; ++k)
    {
      steps[static_cast<std::size_t>(first + k)](k, 3) = 1.0;
    }
    const Status status = this->space_.skinning.linear_blend(context, origin, steps, moved);
    if (!status.ok())
    {
      return status;
    }
    weights.middleCols(first, count) = moved.leftCols(count);
  }
  return {};
}

Status ReducedArap::deform_normals(
  ExecutionContext& context, PointsView rest_normals, PointsOutput posed_normals) const
{
  return this->space_.skinning.linear_blend_normals(
    context, rest_normals, this->transforms_, posed_normals);
}

std::vector<Eigen::Matrix3d> ReducedArap::rotations() const
{
  return rotation_matrices(
    this->space_.groups.count, this->space_.stride, this->solver_.rotations());
}

} // namespace bindpose
