#ifndef app_posing_pose_list_h
#define app_posing_pose_list_h

#include <QStringList>
#include <QWidget>

class QListWidget;
class QPushButton;
class QSlider;

/// The list of stored poses: store, rename (by a double click), apply, blend, delete.
class PoseList : public QWidget
{
  Q_OBJECT

public:
  explicit PoseList(QWidget* parent = nullptr);

  void set_names(const QStringList& names);
  int chosen() const;
  void choose(int entry);
  void set_ready(bool ready);

Q_SIGNALS:
  void store_wanted();
  void apply_wanted(int entry);
  void remove_wanted(int entry);
  void renamed(int entry, const QString& name);
  /// Emitted when the user has moved the slider. `share` is its position, from 0 (the current pose)
  /// to 1 (the selected pose, whose index is `entry`). blend_ended() is emitted when the slider is
  /// released.
  void blended(int entry, double share);
  void blend_ended();

private:
  void enable();

  QListWidget* list_;
  QPushButton* store_;
  QPushButton* apply_;
  QPushButton* remove_;
  QSlider* slider_;
  bool ready_ = false;
};

#endif
