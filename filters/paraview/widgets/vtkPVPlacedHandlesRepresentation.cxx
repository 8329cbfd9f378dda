// The base class edits a handle dataset in place. This class creates the dataset from the text. It
// writes the text again when the modification time of the dataset has changed.
#include "vtkPVPlacedHandlesRepresentation.h"

#include "conversion.h"
#include "handle_edit_cells.h"
#include "handle_tgf.h"
#include "outer_surface.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <vector>

using bindpose::EditedHandles;
using bindpose::Handle;
using bindpose::HandleKind;
using bindpose::Handles;
using bindpose::Index;
using bindpose::Status;

namespace
{
/// Return the index of the handle in a cell; -1 if the cell is no handle.
Index handle_of_cell(const std::vector<Index>& cells, vtkIdType cell)
{
  const auto found = std::find(cells.begin(), cells.end(), static_cast<Index>(cell));
  return found == cells.end() ? -1 : static_cast<Index>(found - cells.begin());
}

/// Convert indices of handles after an edit to the indices of the same handles before the edit.
/// `before[i]` is the index before the edit for index i after the edit. -1 stays -1.
void map_through(const std::vector<Index>& before, std::vector<Index>& indices)
{
  for (Index& index : indices)
  {
    index = index < 0 ? -1 : before[static_cast<std::size_t>(index)];
  }
}

/// Add a bone between two handles. If one of them is a point, the point is removed and its position
/// becomes an end of the new bone. If one of them is a bone, its tail becomes an end of the new
/// bone. If `from` is a bone, it becomes the parent of the new bone.
Status add_bone_between(const Handles& before, Index from, Index to, EditedHandles& after)
{
  const auto position = [&before](Index handle)
  {
    const Handle& end = before[static_cast<std::size_t>(handle)];
    return end.kind == HandleKind::bone ? end.tail : end.head;
  };
  Handle bone;
  bone.kind = HandleKind::bone;
  bone.head = position(from);
  bone.tail = position(to);
  std::vector<Index> points;
  for (const Index end : { from, to })
  {
    if (before[static_cast<std::size_t>(end)].kind == HandleKind::point)
    {
      points.push_back(end);
    }
  }
  EditedHandles without_points;
  Status status = bindpose::remove_handles(before, points, without_points);
  if (!status.ok())
  {
    return status;
  }
  if (before[static_cast<std::size_t>(from)].kind == HandleKind::bone)
  {
    const auto parent = std::find(without_points.source.begin(), without_points.source.end(), from);
    bone.parent = static_cast<Index>(parent - without_points.source.begin());
  }
  status = bindpose::add_handle(without_points.handles, bone, after);
  map_through(without_points.source, after.source);
  map_through(without_points.copied_from, after.copied_from);
  return status;
}

Status connect(const Handles& before, Index from, Index to, EditedHandles& after)
{
  const HandleKind kinds[2] = { before[static_cast<std::size_t>(from)].kind,
    before[static_cast<std::size_t>(to)].kind };
  const bool cage[2] = { kinds[0] == HandleKind::cage_vertex, kinds[1] == HandleKind::cage_vertex };
  if (cage[0] && cage[1])
  {
    return bindpose::toggle_cage_edge(before, from, to, after);
  }
  if (cage[0] || cage[1])
  {
    return Status::invalid_input(
      "a cage vertex can only be connected with another cage vertex; select two of them");
  }
  return add_bone_between(before, from, to, after);
}
} // namespace

vtkStandardNewMacro(vtkPVPlacedHandlesRepresentation);

vtkPVPlacedHandlesRepresentation::vtkPVPlacedHandlesRepresentation()
{
  this->SetHandles(this->PlacedHandles);
  this->FormattedTime = this->PlacedHandles->GetMTime();
  this->SetEditMode(ADD_POINTS);
}

vtkPVPlacedHandlesRepresentation::~vtkPVPlacedHandlesRepresentation() = default;

// ---- The text and the dataset ------------------------------------------------------------------

void vtkPVPlacedHandlesRepresentation::SetHandlesText(const char* text)
{
  const std::string value = text ? text : "";
  // ParaView sends back the text of every edit. Ignore this text, because reading it would end the
  // edit.
  if (value == this->GetHandlesText())
  {
    return;
  }
  this->CancelWidgetInteraction();
  this->FinishCage();
  // The cancel has restored the handles from before the edit. ReadText() replaces these handles, so
  // do not write their text.
  this->FormattedTime = this->PlacedHandles->GetMTime();
  this->HandlesText = value;
  if (this->ReadText())
  {
    this->ClearSelection();
    this->SetHoveredHandle(-1);
    this->Modified();
  }
}

/// Replace the dataset by the handles of the text. If the text cannot be read, set TextMessage,
/// change nothing and return false.
bool vtkPVPlacedHandlesRepresentation::ReadText()
{
  vtkNew<vtkPolyData> handles;
  const Status status = bindpose::from_tgf(this->HandlesText, handles);
  this->TextMessage = status.message;
  if (!status.ok())
  {
    return false;
  }
  this->PlacedHandles->ShallowCopy(handles);
  this->PlacedHandles->Modified();
  this->FormattedTime = this->PlacedHandles->GetMTime();
  return true;
}

const char* vtkPVPlacedHandlesRepresentation::GetHandlesText()
{
  // A drag changes the dataset with every motion, so the text is also up to date during the drag.
  if (this->PlacedHandles->GetMTime() != this->FormattedTime)
  {
    std::string text;
    const Status status = bindpose::to_tgf(this->PlacedHandles, text);
    if (status.ok())
    {
      this->HandlesText = text;
    }
    this->TextMessage = status.message;
    this->FormattedTime = this->PlacedHandles->GetMTime();
  }
  return this->HandlesText.c_str();
}

bool vtkPVPlacedHandlesRepresentation::SetShape(vtkDataSet* shape)
{
  bindpose::SurfaceInput surface;
  const bool found = shape && bindpose::to_outer_surface(shape, surface).ok();
  this->SetSurface(
    found ? bindpose::to_polydata(surface.points.view(), surface.triangles.view()).Get() : nullptr);
  return found || !shape;
}

// ---- Edits of the selected handles -------------------------------------------------------------

bool vtkPVPlacedHandlesRepresentation::DeleteSelectedHandles()
{
  Handles handles;
  std::vector<Index> cells;
  Status status = bindpose::to_editable(this->PlacedHandles, handles, cells);
  std::vector<Index> removed;
  for (int number = 0; number < this->GetNumberOfSelectedHandles(); ++number)
  {
    const Index handle = handle_of_cell(cells, this->GetSelectedHandle(number));
    if (handle >= 0)
    {
      removed.push_back(handle);
    }
  }
  if (status.ok() && removed.empty())
  {
    status = Status::invalid_input("no handle is selected; click on the handles to delete");
  }
  if (status.ok())
  {
    this->FinishCage();
    status = bindpose::edit_handles(this->PlacedHandles,
      [&removed](const Handles& before, EditedHandles& after)
      { return bindpose::remove_handles(before, removed, after); });
  }
  return this->FinishEdit(status.message, -1);
}

bool vtkPVPlacedHandlesRepresentation::ConnectSelectedHandles()
{
  const int count = this->GetNumberOfSelectedHandles();
  Handles handles;
  std::vector<Index> cells;
  Status status = bindpose::to_editable(this->PlacedHandles, handles, cells);
  Index ends[2] = { -1, -1 };
  for (int k = 0; k < 2 && count >= 2; ++k)
  {
    ends[k] = handle_of_cell(cells, this->GetSelectedHandle(count - 2 + k));
  }
  if (status.ok() && (ends[0] < 0 || ends[1] < 0))
  {
    status = Status::invalid_input(
      "two handles must be selected; click on the first and Shift-click on the second");
  }
  std::vector<Index> added;
  if (status.ok())
  {
    this->FinishCage();
    status = bindpose::edit_handles(
      this->PlacedHandles,
      [&ends](const Handles& before, EditedHandles& after)
      { return connect(before, ends[0], ends[1], after); },
      nullptr, &added);
  }
  return this->FinishEdit(status.message, added.empty() ? -1 : added.back());
}

/// If an edit was refused, store the reason. Otherwise select the result of the edit. Return
/// whether the handles have changed.
bool vtkPVPlacedHandlesRepresentation::FinishEdit(const std::string& refusal, vtkIdType selected)
{
  if (refusal.empty())
  {
    this->SetHoveredHandle(-1);
    this->SetSelectedHandle(selected);
    this->PlacedHandles->Modified();
    this->Modified();
    this->GetHandlesText();
  }
  this->TextMessage = refusal;
  return refusal.empty();
}

void vtkPVPlacedHandlesRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HandlesText: " << this->GetHandlesText() << "\n";
  os << indent << "TextMessage: " << this->TextMessage << "\n";
}
