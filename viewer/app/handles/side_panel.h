#ifndef app_handles_side_panel_h
#define app_handles_side_panel_h

#include "app/handles/handle_tree.h"

#include "weights/surface_weights.h"
#include "weights/weight_methods.h"

#include <QFrame>

#include <vector>

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;

namespace app::posing
{
class HandleFields;
class PoseListWidget;
class PosePanel;
} // namespace app::posing

namespace app::handles
{

/// The panel to the right of the 3D view for binding and posing, and for selecting the displayed
/// weight. The panel stores no data of the document. It emits signals when the user requests
/// something, and the window sets the displayed values.
class SidePanel : public QFrame
{
  Q_OBJECT

public:
  /// @param handles  the list in which handles are selected; it is outside this panel
  explicit SidePanel(HandleTree* handles, QWidget* parent = nullptr);

  /// Replace the handles. The panel continues to display the weights of the handle with the same
  /// name as before. If this handle no longer exists, no column of the weights is displayed.
  void set_handles(const std::vector<HandleTree::Row>& handles);
  void set_mode(int handle, int mode);
  /// Select only this handle; -1: none.
  void select_handle(int handle);
  void select_handles(const std::vector<int>& handles);
  /// Return the handles that are selected in the list, in the order of their selection.
  const std::vector<int>& selected_handles() const { return this->handles_->selected(); }
  /// Return the first selected handle, whose values are shown; -1: none.
  int selected_handle() const
  {
    return this->selected_handles().empty() ? -1 : this->selected_handles().front();
  }
  HandleTree* handle_list() const { return this->handles_; }

  /// Enable the widgets that apply. `ready`: a surface and handles are open. `binding`: a bind is
  /// running. `bound`: the surface has weights.
  void set_state(bool ready, bool binding, bool bound);
  void set_progress(double fraction, const QString& phase);
  /// Set the one or two lines under the bind button: the accuracy of the weights (certificate), or
  /// a hint for the next action.
  void set_note(const QString& text);
  void set_method(int method);

  posing::PosePanel* pose() const { return this->pose_; }
  posing::HandleFields* fields() const { return this->fields_; }
  posing::PoseListWidget* poses() const { return this->poses_; }

  /// Return the weight method that the user has chosen.
  const bindpose::WeightMethod& method() const;
  /// Return the domain on which weights are solved.
  bindpose::WeightsDomain domain() const;
  /// Return the displayed column of the weights. If it is -1, the surface has its plain color.
  int shown_column() const;
  void show_column(int column);

Q_SIGNALS:
  /// Emitted when the user has chosen another method for the next bind.
  void bind_method_changed();
  void bind_requested();
  void cancel_requested();
  void column_chosen(int column);
  void method_chosen(int method);
  /// Emitted when the selection has changed.
  void handles_chosen();
  /// Emitted when the user has chosen a mode for all selected handles.
  void mode_chosen(int mode);
  void rest_requested();

private:
  int available_name_width() const;
  void show_mode();

  HandleTree* handles_;
  QLabel* mode_label_;
  QComboBox* mode_;
  QComboBox* method_box_;
  QComboBox* domain_;
  QLabel* shown_label_;
  QComboBox* column_box_;
  QPushButton* bind_;
  QPushButton* cancel_;
  QProgressBar* bar_;
  QLabel* note_;
  QPushButton* rest_;
  posing::PosePanel* pose_;
  posing::HandleFields* fields_;
  posing::PoseListWidget* poses_;
  bool stopping_ = false; // the user has pressed Cancel, but the bind has not ended yet
};

} // namespace app::handles

#endif
