#ifndef deformation_h
#define deformation_h

#include "kernel_job.h"
#include "posing/poser.h"

#include <QObject>

#include <map>
#include <memory>

/// One method at work in the window, whatever it takes. Binds that are long run beside it. Skinning
/// and reduced as-rigid-as-possible then pose at once; the slow methods do so in slices beside the
/// window: a short one for every new pose, which drags do not interrupt, so that the shape follows
/// the mouse; while the mouse rests longer and longer ones, until it has converged. A handle that
/// moves on cancels these, and the solve goes on from where it was with the new pose.
class Deformation : public QObject
{
  Q_OBJECT

public:
  explicit Deformation(QObject* parent = nullptr);
  ~Deformation() override;

  /// What is bent; null: nothing. What was bound for another source is forgotten.
  void set_source(std::shared_ptr<const bindpose::PoseSource> source);
  const bindpose::PoseSource* source() const { return this->source_.get(); }
  void set_options(const bindpose::PoseOptions& options);
  const bindpose::PoseOptions& options() const { return this->options_; }
  /// There is a source, and weights if the method needs them.
  bool can_pose() const;

  /// The surface shall be in this pose: at once, if the method is bound and fast.
  void set_pose(const bindpose::Pose& pose);
  /// Stops a bind that is under way; the next change of source, options or bind() begins it again.
  void cancel();
  bool is_cancelled() const { return this->cancelled_; }
  /// Goes on after a cancel.
  void bind();

  /// The newest points, of the last pose that was reached; of the source at rest before any.
  const bindpose::Points& points() const { return this->points_; }
  /// Of these points: the outcome, with the kernel's report.
  const bindpose::Status& status() const { return this->status_; }
  /// The transforms that a fast method found for these points; null where it finds none.
  const std::vector<bindpose::Affine>* found();
  /// And what it turned them by.
  const bindpose::PoseRotations* rotations();
  bool is_binding() const { return this->binding_; }
  /// The points are those of the pose, and nothing will better them.
  bool is_settled() const { return this->settled_; }
  /// Why there are no points of this pose: one sentence, or empty.
  const QString& error() const { return this->error_; }
  /// How often something was bound for the source.
  bindpose::Index binds() const;
  /// How often a solve under way was cancelled because the handle had moved on.
  int restarts() const { return this->restarts_; }

Q_SIGNALS:
  /// New points from beside the window. Not for those that set_pose() made at once.
  void arrived();
  void bind_progress(double fraction, const QString& phase);
  /// Binding began or ended.
  void binding_changed();
  /// With error().
  void failed();

private:
  bool is_found() const;
  std::shared_ptr<bindpose::Poser> poser();
  void advance();
  void bind_beside(const std::shared_ptr<bindpose::Poser>& poser);
  void solve_now(bindpose::Poser& poser);
  void solve_beside(const std::shared_ptr<bindpose::Poser>& poser);
  void job_finished();
  void set_binding(bool binding);
  void fail(const bindpose::Status& status);
  void take(const bindpose::Status& status);

  std::shared_ptr<const bindpose::PoseSource> source_;
  bindpose::PoseOptions options_;
  bindpose::Pose pose_;
  int pose_number_ = 0;
  std::map<bindpose::PoseMethod, std::shared_ptr<bindpose::Poser>> posers_;
  bindpose::Points points_;
  bindpose::PoseRotations rotations_; ///< of points_, where these are found beside the window
  bindpose::Status status_;
  QString error_;
  bool binding_ = false;
  bool settled_ = false;
  bool cancelled_ = false;
  bool asked_at_once_ = false; ///< set_pose() is on the stack: its caller looks by itself
  int restarts_ = 0;

  /// What the job is doing.
  struct Task
  {
    std::shared_ptr<bindpose::Poser> poser; ///< null: nothing
    bool bind = false;
    bool stale = false; ///< its result is not wanted any more
    bindpose::Index slice = 0;
    int pose_number = 0;
    std::shared_ptr<bindpose::Points> points;
    std::shared_ptr<bindpose::PoseRotations> rotations;
  };
  Task task_;
  bindpose::Index slice_ = 0; ///< iterations of the next
  bindpose::Index spent_ = 0; ///< iterations on this pose
  KernelJob job_; // last: it ends before what it works on
};

#endif
