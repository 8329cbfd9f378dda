#include "poser/reduced_poser.h"

#include "transfer/transfer.h"

namespace bindpose
{

ReducedArapOptions reduced_options(const PoseOptions& options)
{
  ReducedArapOptions reduced;
  reduced.energy = options.energy;
  reduced.extra_weights = options.extra_weights;
  reduced.extra_kind = options.extra_kind;
  return reduced;
}

Status bind_surface_skinning(
  ExecutionContext& context, const PoseSource& source, const ReducedArap& arap, Skinning& skinning)
{
  Weights columns;
  Status status = arap.weights(context, columns);
  if (!status.usable())
  {
    return status;
  }
  // Interpolate the handle weights and the extra weights from the tets' vertices to the surface's
  // points. Then replace the handle weights by those of the source, which need no interpolation.
  Domain domain;
  domain.points = source.tet_points;
  domain.tets = source.tets;
  Weights weights;
  TransferCounts counts;
  status = transfer(context, domain, columns, source.points, {}, weights, counts);
  if (!status.usable())
  {
    return status;
  }
  weights.leftCols(source.weights.cols()) = source.weights;
  return skinning.bind(context, weights);
}

const PoseRotations* ReducedPoser::rotations()
{
  if (!this->bound())
  {
    return nullptr;
  }
  update_rotations(this->source(), this->arap_.groups(), this->arap_.rotations(),
    this->bound()->use_tet_energy, this->rotations_);
  return &this->rotations_;
}

Status ReducedPoser::bind_missing(ExecutionContext& context, const PoseOptions& options)
{
  this->rotations_ = PoseRotations();
  Phase phase(context, "bind");
  Status status = bind_to_source(context, this->source(), options, this->arap_);
  if (status.usable() && options.use_tet_energy)
  {
    const Status surface_status =
      bind_surface_skinning(context, this->source(), this->arap_, this->surface_skinning_);
    status = surface_status.usable() ? status : surface_status;
  }
  return status;
}

Status ReducedPoser::pose(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
  Index maximum_iterations, Points& posed)
{
  Status status;
  {
    Phase phase(context, "solve", 0.0, 0.5);
    ReducedArap::SolveOptions solve;
    solve.max_iterations = maximum_iterations > 0 ? maximum_iterations : options.iterations;
    solve.budget_microseconds = options.budget_microseconds;
    status = this->arap_.solve(context, pose, solve);
    if (!status.usable())
    {
      return status;
    }
    status.report.set("seconds.solve", phase.seconds());
  }
  Phase phase(context, "skin", 0.5, 1.0);
  const PoseSource& source = this->source();
  const Status moved = options.use_tet_energy
    ? this->surface_skinning_.linear_blend(context, source.points, this->arap_.transforms(), posed)
    : this->arap_.deform(context, source.points, posed);
  status.report.set("seconds.skin", phase.seconds());
  return moved.ok() ? status : moved;
}

} // namespace bindpose
