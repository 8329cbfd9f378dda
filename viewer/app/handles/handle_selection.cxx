// The selection is stored as a list of names, because edits change the indices of handles.
#include "app/handles/handle_selection.h"

#include "app/parts/panel_parts.h"
#include "app/view/viewport.h"
#include "document/document.h"

#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkPolyData.h"

namespace app::handles
{

using namespace bindpose;

HandleSelection::HandleSelection(Document* document, view::Viewport* viewport)
  : QObject(viewport), document_(document), viewport_(viewport)
{
}

vtkHandleSetRepresentation* HandleSelection::representation() const
{
  return this->viewport_->handle_widget()->GetHandleSetRepresentation();
}

// ---- The selection -----------------------------------------------------------------------------

std::vector<int> HandleSelection::selected() const
{
  std::vector<int> result;
  for (int k = 0; k < this->representation()->GetNumberOfSelectedHandles(); ++k)
  {
    const int handle =
      this->document_->handle_of_cell(this->representation()->GetSelectedHandle(k));
    if (handle >= 0)
    {
      result.push_back(handle);
    }
  }
  return result;
}

void HandleSelection::select(const std::vector<int>& handles)
{
  std::vector<std::string> names;
  for (const int handle : handles)
  {
    names.push_back(this->document_->handles()[handle].name);
  }
  this->select_names(names);
}

void HandleSelection::select_names(const std::vector<std::string>& names)
{
  this->names_ = names;
  this->show();
}

/// Select the handles in names_ in the 3D view. Names of handles that do not exist now are kept
/// until the next selection, because a redo may restore these handles.
void HandleSelection::show()
{
  const Handles& handles = this->document_->handles();
  this->representation()->SetSelectedHandle(-1);
  for (const std::string& name : this->names_)
  {
    for (std::size_t k = 0; k < handles.size(); ++k)
    {
      const Index cell = this->document_->handle_cells()[k];
      if (handles[k].name == name && !this->representation()->IsSelected(cell))
      {
        this->representation()->ToggleSelected(cell);
      }
    }
  }
  Q_EMIT this->changed();
  this->viewport_->refresh();
}

void HandleSelection::read_view()
{
  this->names_.clear();
  for (int k = 0; k < this->representation()->GetNumberOfSelectedHandles(); ++k)
  {
    this->names_.push_back(
      this->representation()->GetHandleName(this->representation()->GetSelectedHandle(k)));
  }
  Q_EMIT this->changed();
}

void HandleSelection::handles_changed()
{
  if (this->is_committing_)
  {
    this->read_view(); // the 3D view already shows the new selection
  }
  else
  {
    this->show();
  }
}

// ---- Edits -------------------------------------------------------------------------------------

bool HandleSelection::edit(const QString& step, const HandleListEdit& edit, vtkDataArray* labels)
{
  Q_EMIT this->about_to_edit();
  // finish the cage first, because the edit may change the vertices of an unfinished cage
  this->representation()->FinishCage();
  std::vector<Index> new_cell_of_cell;
  std::vector<Index> added;
  const Status status =
    edit_handles(this->document_->editable_handles(), edit, &new_cell_of_cell, &added);
  if (!status.ok())
  {
    this->refuse(status);
    return false;
  }
  std::vector<vtkIdType> selected(added.begin(), added.end());
  for (int k = 0; added.empty() && k < this->representation()->GetNumberOfSelectedHandles(); ++k)
  {
    const auto cell = static_cast<std::size_t>(this->representation()->GetSelectedHandle(k));
    if (cell < new_cell_of_cell.size() && new_cell_of_cell[cell] >= 0)
    {
      selected.push_back(new_cell_of_cell[cell]);
    }
  }
  this->representation()->SetSelectedHandle(-1);
  this->representation()->LeaveHandles();
  for (const vtkIdType cell : selected)
  {
    this->representation()->ToggleSelected(cell);
  }
  return this->commit(step, labels);
}

void HandleSelection::refuse(const Status& status)
{
  Q_EMIT this->edit_refused(parts::capitalized(QString::fromStdString(status.message)) + ".");
}

bool HandleSelection::commit(const QString& step, vtkDataArray* labels)
{
  this->is_committing_ = true;
  const Status status =
    labels ? this->document_->commit_regions(labels, step) : this->document_->commit_handles(step);
  this->is_committing_ = false;
  if (!status.ok())
  {
    this->show();
    this->refuse(status);
  }
  return status.ok();
}

bool HandleSelection::rename(int handle, const QString& name)
{
  Q_EMIT this->about_to_edit();
  const std::string before = this->document_->handles()[handle].name;
  this->is_committing_ = true;
  const Status status = this->document_->rename_handle(handle, name);
  this->is_committing_ = false;
  if (status.ok() && this->representation()->IsSelected(this->document_->handle_cells()[handle]))
  {
    // keep the old name in the list, too, so that the handle stays selected after an undo
    this->names_.push_back(before);
  }
  if (!status.ok())
  {
    this->refuse(status);
  }
  return status.ok();
}

QString HandleSelection::step_name(const QString& step, const std::vector<int>& handles) const
{
  const Handles& all = this->document_->handles();
  return handles.size() == 1 && handles[0] < static_cast<int>(all.size())
    ? QString("%1 %2").arg(step, QString::fromStdString(all[handles[0]].name))
    : tr("%1 %2 handles").arg(step).arg(handles.size());
}

} // namespace app::handles
