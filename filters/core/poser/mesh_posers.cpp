#include "poser/mesh_posers.h"

namespace bindpose
{

const PoseRotations* FullPoser::rotations()
{
  if (!this->bound())
  {
    return nullptr;
  }
  update_rotations(this->source(), this->arap_.groups(), this->arap_.rotations(),
    this->bound()->use_tet_energy, this->rotations_);
  return &this->rotations_;
}

Status FullPoser::bind_missing(ExecutionContext& context, const PoseOptions& options)
{
  const PoseSource& source = this->source();
  this->rotations_ = PoseRotations();
  Phase phase(context, "bind");
  FullArapOptions full;
  full.energy = options.energy;
  if (options.use_tet_energy)
  {
    this->anchors_ = TetAnchors(source.points, source.tet_points, source.tets);
    return this->arap_.bind(context, source.tet_points, source.tets, source.handles, full);
  }
  full.region_ids = source.arrays.region_ids;
  return this->arap_.bind(context, source.points, source.triangles, source.handles, full);
}

Status FullPoser::pose(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
  Index maximum_iterations, Points& posed)
{
  Phase phase(context, "solve");
  FullArap::SolveOptions solve;
  solve.max_iterations = maximum_iterations > 0 ? maximum_iterations : solve.max_iterations;
  Status status = this->arap_.solve(context, pose, solve);
  if (!status.usable())
  {
    return status;
  }
  if (options.use_tet_energy)
  {
    this->anchors_.move(
      this->source().points, this->source().tet_points, this->arap_.posed(), posed);
  }
  else
  {
    posed = this->arap_.posed();
  }
  status.report.set("seconds.solve", phase.seconds());
  return status;
}

Status VariationalPoser::bind_missing(ExecutionContext& context, const PoseOptions& options)
{
  const PoseSource& source = this->source();
  Phase phase(context, "bind");
  VariationalSurfaceOptions variational = source.arrays;
  variational.order = options.order;
  variational.boundary = options.boundary;
  return this->surface_.bind(context, source.points, source.triangles, source.handles, variational);
}

Status VariationalPoser::pose(ExecutionContext& context, const Pose& pose,
  const PoseOptions& /*options*/, Index /*most_iterations*/, Points& posed)
{
  Phase phase(context, "solve");
  Status status = this->surface_.solve(context, pose);
  if (status.usable())
  {
    posed = this->surface_.posed();
    status.report.set("seconds.solve", phase.seconds());
  }
  return status;
}

} // namespace bindpose
