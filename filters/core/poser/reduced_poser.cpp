#include "poser/reduced_poser.h"

#include "weights/transfer.h"

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

Status weights_on_surface(
  ExecutionContext& context, const PoseSource& source, const Weights& in_tets, Weights& weights)
{
  Domain domain;
  domain.points = source.tet_points;
  domain.tets = source.tets;
  TransferCounts counts;
  const Status status = transfer(context, domain, in_tets, source.points, {}, weights, counts);
  if (status.usable())
  {
    weights.leftCols(source.weights.cols()) = source.weights;
  }
  return status;
}

const PoseRotations* ReducedPoser::rotations()
{
  if (!this->bound_)
  {
    return nullptr;
  }
  update_rotations(this->source(), this->arap_.groups(), this->arap_.rotations(),
    this->bound_->in_tets, this->rotations_);
  return &this->rotations_;
}

bool ReducedPoser::is_bound(const PoseOptions& options) const
{
  return this->bound_ && same_bind(*this->bound_, options);
}

Status ReducedPoser::bind_missing(ExecutionContext& context, const PoseOptions& options)
{
  const PoseSource& source = this->source();
  this->bound_.reset();
  this->rotations_ = PoseRotations();
  Status status = check_tets(source, options);
  if (!status.ok())
  {
    return status;
  }
  Phase phase(context, "bind");
  const ReducedArapOptions reduced = reduced_options(options);
  status = options.in_tets ? this->arap_.bind(context, source.tet_points, source.tets,
                               source.tet_weights, source.handles, reduced)
                           : this->arap_.bind(context, source.points, source.triangles,
                               source.weights, source.handles, reduced);
  if (status.usable() && options.in_tets)
  {
    Weights columns, weights;
    Status surface_status = this->arap_.weights(context, columns);
    surface_status =
      surface_status.ok() ? weights_on_surface(context, source, columns, weights) : surface_status;
    surface_status =
      surface_status.usable() ? this->surface_skinning_.bind(context, weights) : surface_status;
    status = surface_status.usable() ? status : surface_status;
  }
  if (status.usable())
  {
    this->bound_ = options;
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
  const Status moved = options.in_tets
    ? this->surface_skinning_.linear_blend(context, source.points, this->arap_.transforms(), posed)
    : this->arap_.deform(context, source.points, posed);
  status.report.set("seconds.skin", phase.seconds());
  return moved.ok() ? status : moved;
}

} // namespace bindpose
