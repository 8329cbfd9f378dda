#ifndef pose_keeper_h
#define pose_keeper_h

#include "posing/pose_shelf.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <functional>
#include <memory>

class KeyStrip;
class PoseList;

/// The poses that are kept: by name in a list, at times as key frames that play. What list and
/// strip ask for is done to the shelf; poses that handles shall be in are only asked for.
class PoseKeeper : public QObject
{
  Q_OBJECT

public:
  /// @param pose  what handles are in
  PoseKeeper(PoseList* list, KeyStrip* strip, std::function<bindpose::Pose()> pose,
    QObject* parent = nullptr);

  /// Whose poses these are; null: nobody's.
  void set_handles(const std::shared_ptr<const bindpose::Handles>& handles);
  const bindpose::PoseShelf& shelf() const { return this->shelf_; }
  /// Another session's, or undo: shelf_changed() is not emitted.
  void set_shelf(const bindpose::PoseShelf& shelf);
  bool is_playing() const { return this->playing_.isActive(); }
  void play(bool play);

Q_SIGNALS:
  /// With the name of the step, or none as long as it goes on; then pose_done() ends it.
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
