#ifndef app_posing_pose_list_widget_h
#define app_posing_pose_list_widget_h

#include <QStringList>
#include <QWidget>

class QListWidget;
class QPushButton;
class QSlider;

namespace app::posing
{

/// A list of the stored poses. Users store the current pose, and rename (by a double click), apply,
/// blend or delete a stored pose.
class PoseListWidget : public QWidget
{
  Q_OBJECT

public:
  explicit PoseListWidget(QWidget* parent = nullptr);

  void set_names(const QStringList& names);
  int selected_entry() const;
  void select_entry(int entry);
  void set_ready(bool ready);

Q_SIGNALS:
  void store_requested();
  void apply_requested(int entry);
  void remove_requested(int entry);
  void renamed(int entry, const QString& name);
  /// Emitted when the user has moved the slider. `fraction` is its position, from 0 (the current
  /// pose) to 1 (the selected pose, whose index is `entry`). blend_ended() is emitted when the
  /// slider is released.
  void blended(int entry, double fraction);
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

} // namespace app::posing

#endif
