#ifndef side_panel_h
#define side_panel_h

#include "handle_tree.h"

#include "weights/surface_weights.h"

#include <QFrame>

#include <vector>

class QComboBox;
class QLabel;
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
  /// @param handles  the list that handles are selected in; it is elsewhere
  explicit SidePanel(HandleTree* handles, QWidget* parent = nullptr);

  /// Other handles; the column that is shown is kept by its name.
  void set_handles(const std::vector<HandleTree::Row>& handles);
  void set_mode(int handle, int mode);
  /// It alone; -1: none.
  void select_handle(int handle);
  void select_handles(const std::vector<int>& handles);
  /// Those that are selected in the list, the last one selected at the end.
  const std::vector<int>& selected_handles() const { return this->handles_->selected(); }
  /// The first of them, of which the values are shown; -1: none.
  int selected_handle() const
  {
    return this->selected_handles().empty() ? -1 : this->selected_handles().front();
  }
  HandleTree* handle_list() const { return this->handles_; }

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
  /// Where they are solved.
  bindpose::WeightsDomain domain() const;
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
  void show_mode();

  HandleTree* handles_;
  QLabel* mode_label_;
  QComboBox* mode_;
  QComboBox* kind_;
  QComboBox* domain_;
  QLabel* shown_label_;
  QComboBox* shown_;
  QPushButton* bind_;
  QPushButton* cancel_;
  QProgressBar* bar_;
  QLabel* note_;
  QPushButton* rest_;
  PosePanel* pose_;
  HandleFields* fields_;
  PoseList* poses_;
  bool stopping_ = false; // cancel was pressed, the bind has not ended yet
};

#endif
