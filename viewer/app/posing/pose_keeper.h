#ifndef app_posing_pose_keeper_h
#define app_posing_pose_keeper_h

#include "poses/pose_shelf.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <functional>
#include <memory>

class KeyStrip;
class PoseList;

/// Manages the shelf, which contains all stored poses: named poses and key frames. It changes the
/// shelf when the list of poses or the strip of key frames requests a change, and it plays the key
/// frames. This class does not set the pose of the handles; it requests a pose by signals.
class PoseKeeper : public QObject
{
  Q_OBJECT

public:
  /// @param pose  returns the pose of the handles
  PoseKeeper(PoseList* list, KeyStrip* strip, std::function<bindpose::Pose()> pose,
    QObject* parent = nullptr);

  /// Set the handles of the poses; null: no handles.
  void set_handles(const std::shared_ptr<const bindpose::Handles>& handles);
  const bindpose::PoseShelf& shelf() const { return this->shelf_; }
  /// Set the shelf, from a session or by undo, without emitting shelf_changed().
  void set_shelf(const bindpose::PoseShelf& shelf);
  bool is_playing() const { return this->playing_.isActive(); }
  void play(bool play);

Q_SIGNALS:
  /// Emitted to request this pose of the handles. `step` is the name of the undo step. During
  /// playback, scrubbing or blending `step` is empty, and pose_done() is emitted at the end.
  void pose_wanted(const bindpose::Pose& pose, const QString& step);
  void pose_done(const QString& step);
  void shelf_changed(const QString& step);
  void failed(const QString& sentence);

private:
  void connect_list();
  void connect_strip();
  void change_shelf(const QString& step);
  void show_shelf();
  void tick();
  void scrub(double seconds);
  void set_key();
  bindpose::Pose key_pose(double seconds) const;

  PoseList* list_;
  KeyStrip* strip_;
  std::function<bindpose::Pose()> pose_;
  std::shared_ptr<const bindpose::Handles> handles_;
  bindpose::PoseShelf shelf_;
  bindpose::Pose blend_from_;
  double key_time_ = 0.0;
  QTimer playing_;
  QElapsedTimer key_clock_;
};

#endif
