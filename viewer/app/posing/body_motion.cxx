// Moves the shape as a body with mass, in real time with fixed time steps. Steps that cannot be
// computed in time are skipped. The body then moves more slowly than in real time, but its time
// steps do not become longer.
#include "app/posing/body_motion.h"

#include "app/posing/pose_panel.h"

#include <algorithm>
#include <cmath>

namespace app::posing
{

using namespace bindpose;

namespace
{
constexpr int frame_interval = 16; // milliseconds
/// Maximum number of time steps per displayed frame. Simulated time that would need more steps is
/// skipped.
constexpr int maximum_steps = 4;
/// A body is bound in the background if its number of vertices times its number of handles is at
/// least this value. A body that is simulated in tets is always bound in the background.
constexpr Index immediate_bind_limit = 20000;
} // namespace

BodyMotion::BodyMotion(PosePanel* panel, std::function<Pose(bool for_step)> pose, QObject* parent)
  : QObject(parent), panel_(panel), get_pose_(std::move(pose))
{
  this->play_timer_.setTimerType(Qt::PreciseTimer);
  this->play_timer_.setInterval(frame_interval);
  QObject::connect(&this->play_timer_, &QTimer::timeout, this, &BodyMotion::tick);
  QObject::connect(&this->job_, &parts::KernelJob::finished, this, &BodyMotion::bound);
  QObject::connect(&this->job_, &parts::KernelJob::progress, panel, &PosePanel::set_progress);
  QObject::connect(panel, &PosePanel::play_requested, this, &BodyMotion::play);
  QObject::connect(panel, &PosePanel::step_requested, this, [this] { this->step(1); });
  QObject::connect(panel, &PosePanel::restart_requested, this, &BodyMotion::restart);
}

void BodyMotion::set_source(std::shared_ptr<const PoseSource> source)
{
  this->job_.cancel();
  this->end();
  this->source_ = std::move(source);
}

void BodyMotion::end()
{
  this->play(false);
  this->points_.resize(0, 3);
  this->body_.reset();
}

void BodyMotion::begin()
{
  this->play(false);
  this->points_.resize(0, 3);
  if (!this->source_ || this->job_.is_running())
  {
    return; // when a running bind has ended, bound() calls begin() again or restarts the body
  }
  const PoseOptions options = this->panel_->options();
  this->body_ = std::make_shared<Body>(this->source_);
  const Index size =
    this->source_->points.rows() * static_cast<Index>(this->source_->handles.size());
  if (size < immediate_bind_limit && !options.use_tet_energy)
  {
    ExecutionContext context;
    const Status status = this->body_->bind(context, options);
    if (status.usable())
    {
      this->restart();
    }
    else
    {
      this->fail(status);
    }
    return;
  }
  this->panel_->set_binding(true);
  this->job_.start([body = this->body_, options](ExecutionContext& context)
    { return body->bind(context, options); });
}

void BodyMotion::options_changed()
{
  if (this->body_ && !this->job_.is_running() && !this->body_->is_bound(this->panel_->options()))
  {
    this->begin();
  }
}

void BodyMotion::bound()
{
  this->panel_->set_binding(false);
  const Status status = this->job_.status();
  const bool needs_rebind =
    !this->body_ || (status.usable() && !this->body_->is_bound(this->panel_->options()));
  if (needs_rebind && this->panel_->simulates_motion())
  {
    this->begin(); // the source or the options have changed during the bind
  }
  else if (status.usable())
  {
    this->restart();
  }
  else if (status.code != StatusCode::canceled)
  {
    this->fail(status);
  }
}

void BodyMotion::fail(const Status& status)
{
  Q_EMIT this->failed(tr("Cannot move: %1.").arg(QString::fromStdString(status.message)));
}

void BodyMotion::restart()
{
  if (!this->body_ || this->job_.is_running())
  {
    return;
  }
  ExecutionContext context;
  this->status_ = this->body_->restart(context, this->get_pose_(false), this->points_);
  if (!this->status_.usable())
  {
    this->fail(this->status_);
  }
  this->show_time();
  Q_EMIT this->moved();
}

void BodyMotion::play(bool play)
{
  if (play && this->has_started())
  {
    Q_EMIT this->playback_started();
    this->clock_.start();
    this->simulated_until_ = 0.0;
    this->play_timer_.start();
  }
  else
  {
    this->play_timer_.stop(); // no timer runs while the window is idle
  }
  this->panel_->set_playing(this->is_playing());
}

void BodyMotion::tick()
{
  const double step = 1.0 / this->panel_->body_options().steps_per_second;
  const double now = 1e-9 * static_cast<double>(this->clock_.nsecsElapsed());
  const int due_steps = static_cast<int>(std::floor((now - this->simulated_until_) / step));
  if (due_steps > 0)
  {
    this->simulated_until_ =
      due_steps > maximum_steps ? now : this->simulated_until_ + due_steps * step;
    this->step(std::min(due_steps, maximum_steps));
  }
}

void BodyMotion::step(int steps)
{
  if (!this->has_started() || this->job_.is_running())
  {
    return;
  }
  const Pose pose = this->get_pose_(true);
  const BodyOptions options = this->panel_->body_options();
  for (int k = 0; k < steps; ++k)
  {
    ExecutionContext context;
    const Status status = this->body_->step(context, pose, options, this->points_);
    if (!status.usable())
    {
      this->play(false);
      this->fail(status);
      return;
    }
    this->status_ = status;
  }
  this->show_time();
  Q_EMIT this->moved();
}

void BodyMotion::show_time()
{
  this->panel_->set_time(this->has_started()
      ? tr("Time %1 s%2")
          .arg(this->body_->time(), 0, 'f', 2)
          .arg(this->body_->run_is_complete() ? QString()
                                              : tr("; only the first 10 minutes are recorded"))
      : QString());
}

} // namespace app::posing
