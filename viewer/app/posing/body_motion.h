#ifndef app_posing_body_motion_h
#define app_posing_body_motion_h

#include "app/parts/kernel_job.h"

#include "poser/body.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <functional>
#include <memory>

namespace app::posing
{

class PosePanel;

/// Moves the shape as a simulated body with mass, with the options of the panel. If the bind of the
/// body takes long, it runs in the background. The time steps are computed in real time.
class BodyMotion : public QObject
{
  Q_OBJECT

public:
  /// @param pose  function that returns the pose of the handles. With `for_step`, it returns the
  /// constraints of a time step: a handle in mode free is constrained only while it is dragged.
  BodyMotion(
    PosePanel* panel, std::function<bindpose::Pose(bool for_step)> pose, QObject* parent = nullptr);

  /// Set the source: the surface, its weights and its handles; null: nothing to move. begin()
  /// creates the body.
  void set_source(std::shared_ptr<const bindpose::PoseSource> source);
  /// Create a new body with the panel's options. The body begins motionless, in the current pose of
  /// the handles.
  void begin();
  void end();
  /// Apply changed options of the panel. If the new options need another bind, create a new body.
  void options_changed();
  void cancel_bind() { this->job_.cancel(); }

  void play(bool play);
  bool is_playing() const { return this->play_timer_.isActive(); }
  void step(int steps);
  /// Restart the simulation at time zero.
  void restart();

  /// Return the body; null before begin(). It must not be used while it is being bound.
  bindpose::Body* body() const { return this->body_.get(); }
  bool has_started() const
  {
    return this->body_ && !this->job_.is_running() && this->body_->has_started();
  }
  /// Return the surface's points after the last step; empty before the body has started.
  const bindpose::Points& points() const { return this->points_; }
  /// Return the status of the last step.
  const bindpose::Status& status() const { return this->status_; }

Q_SIGNALS:
  /// Emitted when the shape has moved.
  void moved();
  void playback_started();
  void failed(const QString& message);

private:
  void bound();
  void fail(const bindpose::Status& status);
  void tick();
  void show_time();

  PosePanel* panel_;
  std::function<bindpose::Pose(bool)> get_pose_;
  std::shared_ptr<const bindpose::PoseSource> source_;
  std::shared_ptr<bindpose::Body> body_;
  bindpose::Points points_;
  bindpose::Status status_;
  QTimer play_timer_;
  QElapsedTimer clock_;
  /// Time of clock_, in seconds, at the end of the last time step (computed or skipped).
  double simulated_until_ = 0.0;
  parts::KernelJob
    job_; // last member, so that the job ends before the data that it uses is destroyed
};

} // namespace app::posing

#endif
