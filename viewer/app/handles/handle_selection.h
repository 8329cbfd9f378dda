#ifndef app_handles_handle_selection_h
#define app_handles_handle_selection_h

#include "base/status.h"
#include "handle_edit_cells.h"

#include <QObject>

#include <string>
#include <vector>

class Document;
class vtkDataArray;
class vtkHandleSetRepresentation;

namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::handles
{

/// The selected handles and edits of them. Each edit is one undo step of the document. Handles are
/// selected in the 3D view or in the list. This class stores the names of the selected handles, so
/// handles stay selected if an edit changes their indices.
class HandleSelection : public QObject
{
  Q_OBJECT

public:
  HandleSelection(Document* document, view::Viewport* viewport);

  /// Return the indices of the selected handles, in the order of their selection.
  std::vector<int> selected() const;
  /// Select only these handles.
  void select(const std::vector<int>& handles);
  void select_names(const std::vector<std::string>& names);

  /// Edit the handles in one undo step and select the new handles. If that is impossible, emit
  /// edit_refused() and return false. `labels`, if not null, become the region labels of the
  /// surface in the same step.
  bool edit(
    const QString& step, const bindpose::HandleListEdit& edit, vtkDataArray* labels = nullptr);
  /// Make one undo step of changes that were already written to the handle dataset
  /// (Document::editable_handles()). `labels` has the same meaning as in edit().
  bool commit(const QString& step, vtkDataArray* labels = nullptr);
  /// Rename a handle. Return false, and emit edit_refused(), if the name is empty or belongs to
  /// another handle.
  bool rename(int handle, const QString& name);
  /// Return the name of an undo step for these handles: `step`, followed by the handle's name if
  /// there is one handle, otherwise by the number of handles.
  QString step_name(const QString& step, const std::vector<int>& handles) const;

  /// Update after the document's handles have changed.
  void handles_changed();
  /// Store the selection of the 3D view after the user has changed it.
  void read_view();

Q_SIGNALS:
  /// Emitted before an edit. Connected objects must then end all interactions with the mouse.
  void about_to_edit();
  void changed();
  void edit_refused(const QString& message);

private:
  vtkHandleSetRepresentation* representation() const;
  void show();
  void refuse(const bindpose::Status& status);

  Document* document_;
  view::Viewport* viewport_;
  std::vector<std::string> names_; ///< names of the selected handles
  bool is_committing_ = false;
};

} // namespace app::handles

#endif
