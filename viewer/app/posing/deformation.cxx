// Poses the surface with one method, in the background if the method is slow. All state belongs to
// the window's thread. A job has its own points and the exclusive use of one poser. No other code
// uses that poser until the end of the job is reported.
#include "app/posing/deformation.h"

#include "poser/make_poser.h"

#include <algorithm>
#include <thread>

namespace app::posing
{

using namespace bindpose;

namespace
{
/// A slow method solves in slices of a few iterations. These constants limit the iterations of the
/// first slice of a pose, of any later slice, and of all slices of a pose together. The limit per
/// pose equals that of vtkFullARAP.
constexpr Index first_slice = 2;
constexpr Index longest_slice = 64;
constexpr Index maximum_iterations = 500;

/// Report whether a bind is so small (vertices times columns) that the user does not notice its
/// duration.
bool binds_immediately(const PoseSource& source, const PoseOptions& options)
{
  const auto columns = static_cast<Index>(source.handles.size()) + options.extra_weights;
  const Index vertices = options.use_tet_energy ? source.tet_points.rows() : source.points.rows();
  if (options.method == PoseMethod::rotation_centers ||
    (options.method == PoseMethod::stretchable_bones &&
      options.endpoints != EndpointMethod::projection))
  {
    return false;
  }
  return is_skinning(options.method) ? vertices * columns < 2000000 : vertices * columns < 20000;
}
} // namespace

Deformation::Deformation(QObject* parent) : QObject(parent)
{
  QObject::connect(&this->job_, &parts::KernelJob::finished, this, &Deformation::job_finished);
  QObject::connect(&this->job_, &parts::KernelJob::progress, this,
    [this](double fraction, const QString& phase)
    {
      if (this->task_.bind && !this->task_.stale)
      {
        Q_EMIT this->bind_progress(fraction, phase);
      }
    });
}

Deformation::~Deformation() = default;

void Deformation::set_source(std::shared_ptr<const PoseSource> source)
{
  this->source_ = std::move(source);
  this->posers_.clear();
  this->pose_.clear();
  this->points_ = this->source_ ? this->source_->points : Points();
  this->rotations_ = PoseRotations();
  this->status_ = Status();
  this->error_.clear();
  this->settled_ = false;
  this->canceled_ = false;
  this->task_.stale = true;
  this->job_.cancel();
  this->set_binding(false);
}

void Deformation::set_options(const PoseOptions& options)
{
  if (options == this->options_)
  {
    return;
  }
  this->options_ = options;
  this->rotations_ = PoseRotations();
  this->settled_ = false;
  this->canceled_ = false;
  this->slice_ = first_slice;
  this->iterations_done_ = 0;
  if (this->task_.poser)
  {
    this->task_.stale = true;
    this->job_.cancel();
  }
  this->set_binding(false);
  this->advance();
}

bool Deformation::can_pose() const
{
  return this->source_ && (!needs_weights(this->options_.method) || this->source_->has_weights());
}

void Deformation::set_pose(const Pose& pose)
{
  this->pose_ = pose;
  ++this->pose_number_;
  this->settled_ = false;
  this->slice_ = first_slice;
  this->iterations_done_ = 0;
  if (this->task_.poser && !this->task_.bind && this->task_.slice > first_slice &&
    !this->task_.stale)
  {
    this->task_.stale = true;
    ++this->restarts_;
    this->job_.cancel();
  }
  this->is_setting_pose_ = true;
  this->advance();
  this->is_setting_pose_ = false;
}

void Deformation::cancel()
{
  this->canceled_ = true;
  this->task_.stale = true;
  this->job_.cancel();
  this->set_binding(false);
}

void Deformation::bind()
{
  this->canceled_ = false;
  this->advance();
}

/// Report whether the current poser has solved this pose and is not in use in the background.
bool Deformation::has_solution() const
{
  return this->can_pose() && this->settled_ && this->error_.isEmpty() &&
    !is_slow(this->options_.method);
}

const std::vector<Affine>* Deformation::found()
{
  return this->has_solution() ? this->poser()->found() : nullptr;
}

const PoseRotations* Deformation::rotations()
{
  if (is_slow(this->options_.method))
  {
    return this->rotations_.cluster_of_point ? &this->rotations_ : nullptr;
  }
  return this->has_solution() ? this->poser()->rotations() : nullptr;
}

Index Deformation::binds() const
{
  Index all = 0;
  for (const auto& [method, poser] : this->posers_)
  {
    all += poser->binds();
  }
  return all;
}

std::shared_ptr<Poser> Deformation::poser()
{
  for (const auto& [method, poser] : this->posers_)
  {
    if (same_poser(method, this->options_.method))
    {
      return poser;
    }
  }
  return this->posers_[this->options_.method] = make_poser(this->options_.method, this->source_);
}

/// Start the next task (bind or solve), if there is one and it can start now.
void Deformation::advance()
{
  if (!this->can_pose() || this->pose_.empty() || this->canceled_ || this->settled_)
  {
    return;
  }
  const std::shared_ptr<Poser> poser = this->poser();
  if (this->task_.poser == poser)
  {
    return; // job_finished() calls advance() again
  }
  if (!poser->is_bound(this->options_))
  {
    if (!binds_immediately(*this->source_, this->options_))
    {
      this->set_binding(true);
      this->bind_in_background(poser);
      return;
    }
    ExecutionContext context;
    const Status status = poser->bind(context, this->options_);
    if (!status.usable())
    {
      this->fail(status);
      return;
    }
  }
  if (is_slow(this->options_.method))
  {
    this->solve_in_background(poser);
  }
  else
  {
    this->solve_immediately(*poser);
  }
}

void Deformation::bind_in_background(const std::shared_ptr<Poser>& poser)
{
  if (this->job_.is_running())
  {
    return; // the running task is being canceled
  }
  this->task_ = { poser, true, false, 0, 0, nullptr, nullptr };
  this->job_.start([poser, options = this->options_](ExecutionContext& context)
    { return poser->bind(context, options); });
}

void Deformation::solve_immediately(Poser& poser)
{
  ExecutionContext context;
  this->settled_ = true;
  this->report_result(poser.solve(context, this->pose_, this->options_, 0, this->points_));
}

void Deformation::solve_in_background(const std::shared_ptr<Poser>& poser)
{
  if (this->job_.is_running())
  {
    return;
  }
  auto points = std::make_shared<Points>();
  auto rotations = std::make_shared<PoseRotations>();
  this->task_ = { poser, false, false,
    std::min(this->slice_, maximum_iterations - this->iterations_done_), this->pose_number_, points,
    rotations };
  this->job_.start(
    [poser, points, rotations, pose = this->pose_, options = this->options_,
      slice = this->task_.slice](ExecutionContext& context)
    {
      // Leave one core for the window.
      context.set_threads(std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1));
      Status status = poser->solve(context, pose, options, slice, *points);
      const PoseRotations* found = status.usable() ? poser->rotations() : nullptr;
      *rotations = found ? *found : PoseRotations();
      return status;
    });
}

void Deformation::job_finished()
{
  const Task task = this->task_;
  this->task_ = Task();
  const Status status = this->job_.status();
  if (task.bind && !task.stale)
  {
    this->set_binding(false);
    if (!status.usable())
    {
      this->fail(status);
      return;
    }
    this->status_ = status;
  }
  else if (!task.bind && !task.stale && status.code != StatusCode::canceled)
  {
    if (status.usable())
    {
      this->points_ = std::move(*task.points);
      this->rotations_ = std::move(*task.rotations);
    }
    if (task.pose_number == this->pose_number_)
    {
      this->iterations_done_ += static_cast<Index>(status.report.number("iterations", 0.0));
      this->settled_ =
        status.code != StatusCode::not_converged || this->iterations_done_ >= maximum_iterations;
      this->slice_ = std::min(2 * this->slice_, longest_slice);
    }
    this->report_result(status);
    if (!status.usable())
    {
      return;
    }
  }
  this->advance();
}

void Deformation::set_binding(bool binding)
{
  if (this->binding_ != binding)
  {
    this->binding_ = binding;
    Q_EMIT this->binding_changed();
  }
}

void Deformation::report_result(const Status& status)
{
  if (!status.usable())
  {
    this->fail(status);
    return;
  }
  this->status_ = status;
  this->error_.clear();
  if (!this->is_setting_pose_)
  {
    Q_EMIT this->points_computed();
  }
}

void Deformation::fail(const Status& status)
{
  this->settled_ = true;
  this->status_ = status;
  if (status.code == StatusCode::canceled)
  {
    this->canceled_ = true;
    return;
  }
  this->error_ = QString::fromStdString(status.message);
  if (!this->is_setting_pose_)
  {
    Q_EMIT this->failed();
  }
}

} // namespace app::posing
