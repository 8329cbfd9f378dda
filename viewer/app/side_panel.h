#ifndef side_panel_h
#define side_panel_h

#include <QFrame>
#include <QStringList>

#include <vector>

class QComboBox;
class QLabel;
class QListWidget;
class QProgressBar;
class QPushButton;
class HandleFields;
class PoseList;
class PosePanel;

/// The panel right of the picture: bind, show, pose. It holds no state of the work; it tells what
/// the user wants by signals and shows what the window tells it.
class SidePanel : public QFrame
{
  Q_OBJECT

public:
  explicit SidePanel(QWidget* parent = nullptr);

  /// Other handles, of which the column that is shown is kept by its name: one line a handle: its
  /// name, its mode (bindpose::HandleMode), and whether it is a bone, which has modes of its own.
  void set_handles(const QStringList& names, const QList<int>& modes, const QList<bool>& bones);
  void set_mode(int handle, int mode);
  /// It alone; -1: none.
  void select_handle(int handle);
  void select_handles(const std::vector<int>& handles);
  /// Those that are selected in the list, the last one selected at the end.
  const std::vector<int>& selected_handles() const { return this->selected_; }
  /// The first of them, of which the values are shown; -1: none.
  int selected_handle() const { return this->selected_.empty() ? -1 : this->selected_.front(); }
  QListWidget* handle_list() const { return this->handles_; }

  /// Ready: a surface and handles are there. Bound: weights are there.
  void set_state(bool ready, bool binding, bool bound);
  void set_progress(double fraction, const QString& phase);
  /// One or two lines under the bind button: certificate, or what to do next.
  void set_note(const QString& text);
  void set_method(int method);

  PosePanel* pose() const { return this->pose_; }
  HandleFields* fields() const { return this->fields_; }
  PoseList* poses() const { return this->poses_; }

  /// True when monotone weights are wanted.
  bool monotone() const;
  /// Column of the weights that is shown, -1: shaded.
  int shown_column() const;
  void show_column(int column);

Q_SIGNALS:
  /// The method of the next bind is another one.
  void bind_method_changed();
  void bind_wanted();
  void cancel_wanted();
  void column_chosen(int column);
  void method_chosen(int method);
  /// Others are selected.
  void handles_chosen();
  /// For all that are selected.
  void mode_chosen(int mode);
  void rest_wanted();

private:
  int room_for_names() const;
  void list_changed();
  void show_mode();

  QListWidget* handles_;
  QLabel* mode_label_;
  QComboBox* mode_;
  QComboBox* kind_;
  QComboBox* shown_;
  QPushButton* bind_;
  QPushButton* cancel_;
  QProgressBar* bar_;
  QLabel* note_;
  QPushButton* rest_;
  PosePanel* pose_;
  HandleFields* fields_;
  PoseList* poses_;
  QStringList names_;
  QList<int> modes_;
  QList<bool> bones_;
  std::vector<int> selected_;
  bool stopping_ = false; // cancel was pressed, the bind has not ended yet
};

#endif
