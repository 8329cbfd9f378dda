#include "poser/body.h"

#include "pose/found_rotations.h"
#include "poser/reduced_poser.h"

#include <tuple>

namespace bindpose
{

namespace
{
auto as_tuple(const BodyOptions& o)
{
  return std::tie(o.gravity, o.down_axis, o.stiffness, o.damping, o.steps_per_second);
}

bool same_pose(const Pose& a, const Pose& b)
{
  bool is_same = a.size() == b.size();
  for (std::size_t k = 0; is_same && k < a.size(); ++k)
  {
    is_same = a[k].mode == b[k].mode && a[k].transform == b[k].transform &&
      a[k].stretch == b[k].stretch && a[k].twist == b[k].twist;
  }
  return is_same;
}

/// Return `before` if it equals `value`; otherwise return a shared copy of `value`.
template <typename Value, typename Same>
std::shared_ptr<const Value> reuse_if_equal(
  const std::shared_ptr<const Value>& before, const Value& value, const Same& is_same)
{
  return before && is_same(*before, value) ? before : std::make_shared<const Value>(value);
}

ReducedDynamicsOptions kernel_options(const BodyOptions& options, double diagonal)
{
  ReducedDynamicsOptions result;
  result.time_step = 1.0 / options.steps_per_second;
  result.gravity[options.down_axis] = -options.gravity * diagonal;
  result.stiffness = options.stiffness * diagonal * diagonal;
  result.damping = options.damping;
  result.solve.max_iterations = 50;
  return result;
}
} // namespace

bool operator==(const BodyOptions& a, const BodyOptions& b)
{
  return as_tuple(a) == as_tuple(b);
}

bool Body::is_bound(const PoseOptions& options) const
{
  PoseOptions reduced = options;
  reduced.method = PoseMethod::reduced_arap;
  return this->bound_ && same_bind(*this->bound_, reduced);
}

Status Body::bind(ExecutionContext& context, const PoseOptions& options)
{
  if (this->is_bound(options))
  {
    return {};
  }
  const PoseSource& source = *this->source_;
  this->bound_.reset();
  this->rotations_ = PoseRotations();
  this->run_ = BodyRun();
  if (!source.has_weights())
  {
    return Status::invalid_input("dynamics needs weights: bind first");
  }
  Status status = check_tets(source, options);
  if (!status.ok())
  {
    return status;
  }
  status = bind_to_source(context, source, options, this->body_);
  if (status.usable() && options.use_tet_energy)
  {
    // Skin the surface's points with the same weights as ReducedPoser. These weights are computed
    // from the weights of a ReducedArap that is bound to the same tets.
    ReducedArap arap;
    Status surface_status = bind_to_source(context, source, options, arap);
    surface_status = surface_status.usable()
      ? bind_surface_skinning(context, source, arap, this->surface_skinning_)
      : surface_status;
    status = surface_status.usable() ? status : surface_status;
  }
  if (status.usable())
  {
    this->diagonal_ = bounding_box(source.points, source.triangles).diagonal();
    this->bound_ = options;
    this->bound_->method = PoseMethod::reduced_arap;
    this->binds_ += 1;
  }
  return status;
}

const PoseRotations* Body::rotations()
{
  if (!this->bound_ || !this->has_started())
  {
    return nullptr;
  }
  update_rotations(*this->source_, this->body_.groups(), this->body_.rotations(),
    this->bound_->use_tet_energy, this->rotations_);
  return &this->rotations_;
}

Status Body::move_surface(ExecutionContext& context, Points& posed) const
{
  Phase phase(context, "skin", 0.5, 1.0);
  return this->bound_->use_tet_energy ? this->surface_skinning_.linear_blend(context,
                                          this->source_->points, this->body_.transforms(), posed)
                                      : this->body_.deform(context, this->source_->points, posed);
}

Status Body::restart(ExecutionContext& context, const Pose& pose, Points& posed)
{
  if (!this->bound_)
  {
    return Status::invalid_input("the mesh is not bound: bind first");
  }
  ReducedSolveOptions rest_options;
  rest_options.max_iterations = 1000;
  const Pose start = resolve_automatic_modes(this->source_->handles, pose);
  const Status status = this->body_.start(context, start, rest_options);
  if (!status.usable())
  {
    return status;
  }
  this->run_ = BodyRun();
  this->run_.start = std::make_shared<const Pose>(pose);
  this->is_complete_ = true;
  const Status moved = this->move_surface(context, posed);
  return moved.ok() ? status : moved;
}

Status Body::step(
  ExecutionContext& context, const Pose& pose, const BodyOptions& options, Points& posed)
{
  if (!this->bound_ || !this->run_.start)
  {
    return Status::invalid_input("the simulation has not been started");
  }
  Status status;
  {
    Phase phase(context, "solve", 0.0, 0.5);
    const Pose resolved = resolve_automatic_modes(this->source_->handles, pose);
    status = this->body_.step(context, resolved, kernel_options(options, this->diagonal_));
    if (!status.usable())
    {
      return status;
    }
    const std::string unused = unused_stretch(resolved, stretch_use(this->bound_->method));
    if (!unused.empty())
    {
      status.warnings.push_back(unused);
    }
    status.report.set("seconds.solve", phase.seconds());
  }
  if (this->run_.steps.size() < longest_run)
  {
    const BodyRun::Step before = this->run_.steps.empty()
      ? BodyRun::Step{ this->run_.start, nullptr }
      : this->run_.steps.back();
    this->run_.steps.push_back({ reuse_if_equal(before.pose, pose, same_pose),
      reuse_if_equal(before.options, options,
        [](const BodyOptions& a, const BodyOptions& b) { return a == b; }) });
  }
  else
  {
    this->is_complete_ = false;
  }
  const Status moved = this->move_surface(context, posed);
  return moved.ok() ? status : moved;
}

Status Body::play(ExecutionContext& context, const BodyRun& recorded_run,
  const std::function<bool(std::size_t step, const Points& posed)>& on_step)
{
  if (!recorded_run.start)
  {
    return Status::invalid_input("no recorded simulation is available for playback");
  }
  // Copy the run, because `recorded_run` may be a reference to the body's own run, which restart()
  // clears.
  const BodyRun run = recorded_run;
  Points posed;
  Status status = this->restart(context, *run.start, posed);
  bool should_continue = status.usable() && on_step(0, posed);
  for (std::size_t k = 0; should_continue && k < run.steps.size(); ++k)
  {
    status = this->step(context, *run.steps[k].pose, *run.steps[k].options, posed);
    should_continue = status.usable() && on_step(k + 1, posed);
  }
  return status;
}

} // namespace bindpose
