#ifndef body_motion_h
#define body_motion_h

#include "kernel_job.h"

#include "posing/body.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <functional>
#include <memory>

class PosePanel;

/// The motion of the shape by itself, as the panel wants it: a body that is bound, beside the
/// window where that takes long, and steps in real time.
class BodyMotion : public QObject
{
  Q_OBJECT

public:
  /// @param pose  what handles are in; for_step: as a body is to be held, the handle in the hand
  ///   along
  BodyMotion(
    PosePanel* panel, std::function<bindpose::Pose(bool for_step)> pose, QObject* parent = nullptr);

  /// Whose motion it is; null: nobody's. There is no body before begin().
  void set_source(std::shared_ptr<const bindpose::PoseSource> source);
  /// With a new body, bound by the panel's options; at rest in the handles' pose.
  void begin();
  void end();
  /// The panel's options are others: begins anew where they need another bind.
  void options_changed();
  void cancel_bind() { this->job_.cancel(); }

  void play(bool play);
  bool is_playing() const { return this->playing_.isActive(); }
  void step(int steps);
  /// To time zero.
  void restart();

  /// Null before it is begun; not to be asked while it is bound.
  bindpose::Body* body() const { return this->body_.get(); }
  bool has_started() const
  {
    return this->body_ && !this->job_.is_running() && this->body_->has_started();
  }
  /// Of the surface, where the body has taken them; none before it has started.
  const bindpose::Points& points() const { return this->points_; }
  /// Of the last step.
  const bindpose::Status& status() const { return this->status_; }

Q_SIGNALS:
  /// The shape is another one.
  void moved();
  void played();
  void failed(const QString& sentence);

private:
  void bound();
  void fail(const bindpose::Status& status);
  void tick();
  void show_time();

  PosePanel* panel_;
  std::function<bindpose::Pose(bool)> pose_;
  std::shared_ptr<const bindpose::PoseSource> source_;
  std::shared_ptr<bindpose::Body> body_;
  bindpose::Points points_;
  bindpose::Status status_;
  QTimer playing_;
  QElapsedTimer clock_;
  double due_ = 0.0; ///< seconds of the clock that have been stepped
  KernelJob job_; // last: it ends before what it works on
};

#endif
