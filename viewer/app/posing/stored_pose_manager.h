#ifndef app_posing_stored_pose_manager_h
#define app_posing_stored_pose_manager_h

#include "poses/stored_poses.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <functional>
#include <memory>

namespace app::posing
{

class KeyStrip;
class PoseListWidget;

/// Manages the stored poses: named poses and key frames. This class changes the stored poses when
/// the list of poses or the strip of key frames requests a change, and it plays the key frames. It
/// does not set the pose of the handles, but requests a pose by signals.
class StoredPoseManager : public QObject
{
  Q_OBJECT

public:
  /// @param pose  returns the pose of the handles
  StoredPoseManager(PoseListWidget* list, KeyStrip* strip, std::function<bindpose::Pose()> pose,
    QObject* parent = nullptr);

  /// Set the handles of the poses; null: no handles.
  void set_handles(const std::shared_ptr<const bindpose::Handles>& handles);
  const bindpose::StoredPoses& stored_poses() const { return this->stored_poses_; }
  /// Replace the stored poses by those of a session or of an undo step, without emitting
  /// stored_poses_changed().
  void set_stored_poses(const bindpose::StoredPoses& stored_poses);
  bool is_playing() const { return this->play_timer_.isActive(); }
  void play(bool play);

Q_SIGNALS:
  /// Emitted to request this pose of the handles. `step` is the name of the undo step. During
  /// playback, scrubbing and blending, `step` is empty; pose_step_requested() is emitted when the
  /// playback, scrubbing or blending ends.
  void pose_requested(const bindpose::Pose& pose, const QString& step);
  void pose_step_requested(const QString& step);
  void stored_poses_changed(const QString& step);
  void failed(const QString& message);

private:
  void connect_list();
  void connect_strip();
  void change_stored_poses(const QString& step);
  void show_stored_poses();
  void tick();
  void scrub(double seconds);
  void set_key();
  bindpose::Pose key_pose(double seconds) const;

  PoseListWidget* list_;
  KeyStrip* strip_;
  std::function<bindpose::Pose()> get_pose_;
  std::shared_ptr<const bindpose::Handles> handles_;
  bindpose::StoredPoses stored_poses_;
  bindpose::Pose blend_from_;
  double key_time_ = 0.0;
  QTimer play_timer_;
  QElapsedTimer key_clock_;
};

} // namespace app::posing

#endif
