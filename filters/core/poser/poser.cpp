#include "poser/poser.h"

#include "pose/found_rotations.h"

namespace bindpose
{

bool Poser::is_bound(const PoseOptions& options) const
{
  return this->bound_ && same_bind(*this->bound_, options);
}

Status Poser::bind(ExecutionContext& context, const PoseOptions& options)
{
  if (this->is_bound(options))
  {
    return {};
  }
  if (needs_weights(options.method) && !this->source().has_weights())
  {
    return Status::invalid_input("this method needs weights: bind first");
  }
  this->bound_.reset();
  Status status = finds_rotations(options.method) ? check_tets(this->source(), options) : Status();
  if (status.ok())
  {
    status = this->bind_missing(context, options);
  }
  if (status.usable())
  {
    this->bound_ = options;
    this->binds_ += 1;
  }
  return status;
}

Status Poser::solve(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
  Index maximum_iterations, Points& posed)
{
  if (!this->is_bound(options))
  {
    return Status::invalid_input("the mesh is not bound: bind first");
  }
  Status status = check_pose(this->source().handles, pose);
  if (status.ok())
  {
    const Pose resolved = finds_rotations(options.method)
      ? resolve_automatic_modes(this->source().handles, pose)
      : pose;
    status = this->pose(context, resolved, options, maximum_iterations, posed);
    const std::string unused = unused_stretch(resolved, stretch_use(options.method));
    if (status.usable() && !unused.empty())
    {
      status.warnings.push_back(unused);
    }
  }
  return status;
}

Status check_tets(const PoseSource& source, const PoseOptions& options)
{
  return !options.use_tet_energy || source.has_tets()
    ? Status()
    : Status::invalid_input(
        "there are no tets with weights: bind in a volume first, or use a surface energy");
}

} // namespace bindpose
