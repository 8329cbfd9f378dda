#ifndef app_posing_deformation_h
#define app_posing_deformation_h

#include "app/parts/kernel_job.h"
#include "poser/poser.h"

#include <QObject>

#include <map>
#include <memory>

namespace app::posing
{

/// Poses the surface of the window with one method, fast or slow, without blocking the window.
/// - Long binds run in the background.
/// - The fast methods (skinning and reduced as-rigid-as-possible) compute each pose immediately,
///   once they are bound.
/// - The slow methods solve in slices of a few iterations, in the background. Every new pose begins
///   with a short slice, which a drag does not interrupt, so that the shape follows the mouse.
///   While the mouse rests, slices become longer until the solve has converged. When a handle moves
///   again, a long slice is canceled, and the solve continues from its current state with the new
///   pose.
class Deformation : public QObject
{
  Q_OBJECT

public:
  explicit Deformation(QObject* parent = nullptr);
  ~Deformation() override;

  /// Set the source: the surface, its weights and its handles; null: nothing to pose. All binds of
  /// the previous source are discarded.
  void set_source(std::shared_ptr<const bindpose::PoseSource> source);
  const bindpose::PoseSource* source() const { return this->source_.get(); }
  void set_options(const bindpose::PoseOptions& options);
  const bindpose::PoseOptions& options() const { return this->options_; }
  /// Report whether there is a source, and weights if the method needs them.
  bool can_pose() const;

  /// Request the surface in this pose. A fast method computes the surface immediately, unless it
  /// must run a long bind first. In all other cases the surface is computed in the background.
  void set_pose(const bindpose::Pose& pose);
  /// Cancel a running bind or solve. A call of bind(), or a change of the source or the options,
  /// starts the canceled work again.
  void cancel();
  bool is_canceled() const { return this->canceled_; }
  /// Restart the bind or the solve that cancel() has canceled.
  void bind();

  /// Return the points of the last computed pose. Before a pose was computed, return the points of
  /// the source at rest.
  const bindpose::Points& points() const { return this->points_; }
  /// Return the status of points(), with the kernel's report.
  const bindpose::Status& status() const { return this->status_; }
  /// Return the handles' transforms that a fast method has computed together with points(). Return
  /// null if the method is slow or computes no transforms.
  const std::vector<bindpose::Affine>* found();
  /// Return the rotations that the method fitted for points(); null if it fits none.
  const bindpose::PoseRotations* rotations();
  bool is_binding() const { return this->binding_; }
  /// Report whether points() are final: the solve for the current pose has ended.
  bool is_settled() const { return this->settled_; }
  /// Return the reason why the current pose could not be computed: one sentence, or empty.
  const QString& error() const { return this->error_; }
  /// Return the total number of binds of all methods for the current source.
  bindpose::Index binds() const;
  /// Return how many running solves were canceled because a handle had moved again.
  int restarts() const { return this->restarts_; }

Q_SIGNALS:
  /// Emitted when new points were computed in the background. Not emitted for points that
  /// set_pose() computes immediately.
  void points_computed();
  void bind_progress(double fraction, const QString& phase);
  /// Emitted when a bind has begun or ended.
  void binding_changed();
  /// Emitted when posing has failed; error() returns the reason.
  void failed();

private:
  bool has_solution() const;
  std::shared_ptr<bindpose::Poser> poser();
  void advance();
  void bind_in_background(const std::shared_ptr<bindpose::Poser>& poser);
  void solve_immediately(bindpose::Poser& poser);
  void solve_in_background(const std::shared_ptr<bindpose::Poser>& poser);
  void job_finished();
  void set_binding(bool binding);
  void fail(const bindpose::Status& status);
  void report_result(const bindpose::Status& status);

  std::shared_ptr<const bindpose::PoseSource> source_;
  bindpose::PoseOptions options_;
  bindpose::Pose pose_;
  int pose_number_ = 0;
  std::map<bindpose::PoseMethod, std::shared_ptr<bindpose::Poser>> posers_;
  bindpose::Points points_;
  /// Rotations that belong to points_; empty unless points_ were computed in the background.
  bindpose::PoseRotations rotations_;
  bindpose::Status status_;
  QString error_;
  bool binding_ = false;
  bool settled_ = false;
  bool canceled_ = false;
  /// True while set_pose() runs. The signals points_computed() and failed() are not emitted then,
  /// because the caller of set_pose() reads the points itself.
  bool is_setting_pose_ = false;
  int restarts_ = 0;

  /// The task of the running job.
  struct Task
  {
    std::shared_ptr<bindpose::Poser> poser; ///< poser that the task uses; null: no task
    bool bind = false;
    bool stale = false; ///< true: the result of the task must be discarded
    bindpose::Index slice = 0;
    int pose_number = 0;
    std::shared_ptr<bindpose::Points> points;
    std::shared_ptr<bindpose::PoseRotations> rotations;
  };
  Task task_;
  bindpose::Index slice_ = 0; ///< iterations of the next slice
  bindpose::Index iterations_done_ = 0; ///< iterations that were computed for the current pose
  parts::KernelJob
    job_; // last member, so that the job ends before the data that it uses is destroyed
};

} // namespace app::posing

#endif
