#include "app/handles/handle_commands.h"

#include "app/handles/handle_selection.h"
#include "app/parts/window_keys.h"
#include "document/document.h"

#include "handle_edit_cells.h"
#include "surface/surface_probe.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <QAction>
#include <QColorDialog>
#include <QInputDialog>
#include <QMenu>

#include <algorithm>
#include <cmath>

namespace app::handles
{

using namespace bindpose;

namespace
{
constexpr HandleMode all_modes[] = { HandleMode::automatic, HandleMode::full, HandleMode::position,
  HandleMode::free, HandleMode::tail, HandleMode::ends };

/// Return the name of the action that sets this handle mode.
std::string name_of(HandleMode mode)
{
  return std::string("fixes.") + to_string(mode);
}

/// Convert indices of handles to the kernels' type.
std::vector<Index> to_indices(const std::vector<int>& handles)
{
  return { handles.begin(), handles.end() };
}
} // namespace

HandleCommands::HandleCommands(
  HandleSelection* selection, Document* document, QWidget* view_widget, QWidget* list)
  : QObject(selection), selection_(selection), document_(document), view_widget_(view_widget),
    menu_(new QMenu(view_widget)), mode_menu_(new QMenu(tr("&Fixes"), view_widget)),
    mirror_(new QMenu(tr("&Mirror"), view_widget)), parents_(new QMenu(tr("&Parent"), view_widget))
{
  this->make_actions();
  for (const auto& [name, action] : this->actions_)
  {
    action->setShortcutContext(Qt::WidgetShortcut);
    view_widget->addAction(action);
    list->addAction(action);
  }
  QObject::connect(this->parents_, &QMenu::aboutToShow, this, &HandleCommands::fill_parents);
  this->fill(this->menu_);
}

HandleCommands::~HandleCommands() = default;

// ---- Menus -------------------------------------------------------------------------------------

template <typename Action>
QAction* HandleCommands::add(const std::string& name, const QString& text, Action action)
{
  auto* new_action = new QAction(text, this);
  new_action->setObjectName(QString::fromStdString(name));
  new_action->setShortcut(QKeySequence(QString::fromStdString(parts::keys_of(name.c_str()))));
  QObject::connect(new_action, &QAction::triggered, this, action);
  this->actions_[name] = new_action;
  return new_action;
}

void HandleCommands::make_actions()
{
  this->add("rename", tr("&Rename…"), [this] { this->ask_for_name(); });
  this->add("color", tr("&Color…"), [this] { this->ask_for_color(); });
  this->add(
    "no_color", tr("Default color of the mod&e"), [this] { this->set_color(std::nullopt); });
  this->add("lock", tr("&Locked"), [this](bool locked) { this->set_locked(locked); })
    ->setCheckable(true);
  this->add("reset", tr("R&eset"), [this] { this->reset(); });
  this->add("snap", tr("&Snap to the surface"), [this] { this->snap(); });
  this->add(
    "cage_edge", tr("Cage ed&ge between two vertices"), [this] { this->toggle_cage_edge(); });
  this->add("delete", tr("&Delete"), [this] { this->remove(); });
  this->add("select_all", tr("Select &all"), [this] { this->select_all(); });
  const QString axes[] = { tr("Left to right (&X)"), tr("Bottom to top (&Y)"),
    tr("Back to front (&Z)") };
  for (int axis = 0; axis < 3; ++axis)
  {
    this->mirror_->addAction(this->add(
      std::string("mirror.") + "xyz"[axis], axes[axis], [this, axis] { this->mirror(axis); }));
  }
  const QString modes[] = { tr("&Position and rotation"), tr("Position &only"), tr("&Nothing"),
    tr("A bone's &tail"), tr("A bone's &ends"), tr("&Automatic") };
  for (const HandleMode mode : all_modes)
  {
    QAction* action = this->add(
      name_of(mode), modes[static_cast<int>(mode)], [this, mode] { this->set_handle_mode(mode); });
    action->setCheckable(true);
    this->mode_menu_->addAction(action);
  }
}

QAction* HandleCommands::action(const std::string& name) const
{
  const auto found = this->actions_.find(name);
  return found == this->actions_.end() ? nullptr : found->second;
}

void HandleCommands::fill(QMenu* menu)
{
  menu->addAction(this->action("rename"));
  menu->addAction(this->action("color"));
  menu->addAction(this->action("no_color"));
  menu->addAction(this->action("lock"));
  menu->addMenu(this->mode_menu_);
  menu->addMenu(this->parents_);
  menu->addSeparator();
  menu->addAction(this->action("reset"));
  menu->addAction(this->action("snap"));
  menu->addMenu(this->mirror_);
  menu->addAction(this->action("cage_edge"));
  menu->addSeparator();
  menu->addAction(this->action("select_all"));
  menu->addAction(this->action("delete"));
}

void HandleCommands::update()
{
  const Handles& handles = this->document_->handles();
  const std::vector<int> selected = this->selection_->selected();
  const bool any_selected = !selected.empty();
  const auto all = [&](HandleKind kind)
  {
    return std::all_of(
      selected.begin(), selected.end(), [&](int k) { return handles[k].kind == kind; });
  };
  for (const auto& [name, action] : this->actions_)
  {
    action->setEnabled(any_selected);
  }
  for (QMenu* menu : { this->mode_menu_, this->mirror_, this->parents_ })
  {
    menu->setEnabled(any_selected);
  }
  this->action("rename")->setEnabled(selected.size() == 1);
  this->action("snap")->setEnabled(any_selected && this->document_->surface());
  this->action("cage_edge")->setEnabled(selected.size() == 2 && all(HandleKind::cage_vertex));
  this->action("select_all")->setEnabled(!handles.empty());
  this->action("lock")->setChecked(any_selected &&
    std::all_of(selected.begin(), selected.end(), [this](int k) { return this->is_locked(k); }));
  const Pose pose = this->document_->pose();
  for (const HandleMode mode : all_modes)
  {
    QAction* action = this->action(name_of(mode));
    action->setEnabled(any_selected && (!constrains_tail(mode) || all(HandleKind::bone)));
    action->setChecked(any_selected &&
      std::all_of(selected.begin(), selected.end(),
        [&](int k) { return pose[static_cast<std::size_t>(k)].mode == mode; }));
  }
}

void HandleCommands::fill_parents()
{
  this->parents_->clear();
  const Handles& handles = this->document_->handles();
  const std::vector<int> selected = this->selection_->selected();
  const auto has_parent = [&](int parent)
  {
    return std::all_of(
      selected.begin(), selected.end(), [&](int k) { return handles[k].parent == parent; });
  };
  for (int parent = -1; parent < static_cast<int>(handles.size()); ++parent)
  {
    if (std::find(selected.begin(), selected.end(), parent) != selected.end())
    {
      continue;
    }
    // Escape ampersands, because a single ampersand in a menu's text underlines the next letter.
    const QString name =
      parent < 0 ? tr("None") : QString::fromStdString(handles[parent].name).replace('&', "&&");
    QAction* action =
      this->parents_->addAction(name, this, [this, parent] { this->set_parent(parent); });
    action->setCheckable(true);
    action->setChecked(has_parent(parent));
  }
}

// ---- Commands ----------------------------------------------------------------------------------

void HandleCommands::ask_for_name()
{
  const std::vector<int> selected = this->selection_->selected();
  if (selected.size() != 1)
  {
    return;
  }
  const int handle = selected[0];
  auto* dialog = new QInputDialog(this->view_widget_->window());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(tr("Rename"));
  dialog->setLabelText(tr("Name of the handle"));
  dialog->setTextValue(QString::fromStdString(this->document_->handles()[handle].name));
  QObject::connect(dialog, &QInputDialog::textValueSelected, this,
    [this, handle](const QString& name) { this->rename(handle, name); });
  dialog->open();
}

bool HandleCommands::rename(int handle, const QString& name)
{
  if (handle >= static_cast<int>(this->document_->handles().size()))
  {
    return false;
  }
  return this->selection_->rename(handle, name.trimmed());
}

void HandleCommands::ask_for_color()
{
  auto* dialog = new QColorDialog(QColor("#f2942e"), this->view_widget_->window());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(tr("Color of the handle"));
  QObject::connect(dialog, &QColorDialog::colorSelected, this,
    [this](const QColor& color) { this->set_color(color); });
  dialog->open();
}

void HandleCommands::set_color(const std::optional<QColor>& color)
{
  const std::vector<int> selected = this->selection_->selected();
  std::optional<std::array<double, 3>> rgb;
  if (color)
  {
    rgb = { color->redF(), color->greenF(), color->blueF() };
  }
  Q_EMIT this->selection_->about_to_edit();
  if (!rgb && !this->document_->editable_handles()->GetCellData()->GetArray("Color"))
  {
    return; // no handle has a color of its own
  }
  for (const int handle : selected)
  {
    set_handle_color(
      this->document_->editable_handles(), this->document_->handle_cells()[handle], rgb);
  }
  if (!selected.empty())
  {
    this->selection_->commit(this->selection_->step_name(tr("color"), selected));
  }
}

bool HandleCommands::is_locked(int handle) const
{
  vtkDataArray* locked = this->document_->editable_handles()->GetCellData()->GetArray("Locked");
  const Index cell = this->document_->handle_cells()[handle];
  return locked && cell < locked->GetNumberOfTuples() && locked->GetComponent(cell, 0) != 0.0;
}

void HandleCommands::set_locked(bool locked)
{
  const std::vector<int> selected = this->selection_->selected();
  Q_EMIT this->selection_->about_to_edit();
  for (const int handle : selected)
  {
    set_handle_locked(
      this->document_->editable_handles(), this->document_->handle_cells()[handle], locked);
  }
  if (!selected.empty())
  {
    this->selection_->commit(
      this->selection_->step_name(locked ? tr("lock") : tr("unlock"), selected));
  }
}

/// Remove the selected handles. For regions, remove their labels from the surface, too.
void HandleCommands::remove()
{
  const std::vector<int> selected = this->selection_->selected();
  if (selected.empty())
  {
    return;
  }
  vtkPolyData* surface = this->document_->work().surface;
  vtkDataArray* labels = surface ? surface->GetPointData()->GetArray("RegionId") : nullptr;
  vtkSmartPointer<vtkDataArray> remaining_labels;
  for (const int handle : selected)
  {
    const Handle& target = this->document_->handles()[handle];
    if (target.kind != HandleKind::region || !labels)
    {
      continue;
    }
    if (!remaining_labels)
    {
      remaining_labels.TakeReference(labels->NewInstance());
      remaining_labels->DeepCopy(labels);
    }
    for (vtkIdType v = 0; v < remaining_labels->GetNumberOfTuples(); ++v)
    {
      if (remaining_labels->GetComponent(v, 0) == static_cast<double>(target.region_id))
      {
        remaining_labels->SetComponent(v, 0, 0.0);
      }
    }
  }
  this->selection_->edit(
    this->selection_->step_name(tr("delete"), selected),
    [&](const Handles& before, EditedHandles& after)
    { return remove_handles(before, to_indices(selected), after); },
    remaining_labels);
}

double HandleCommands::center_coordinate(int axis) const
{
  vtkPolyData* shape =
    this->document_->surface() ? this->document_->surface() : this->document_->editable_handles();
  const double* bounds = shape->GetBounds();
  const double lower = bounds[2 * axis];
  const double upper = bounds[2 * axis + 1];
  const double center_coordinate = 0.5 * (lower + upper);
  constexpr double tolerance = 0.02;
  return std::abs(center_coordinate) <= tolerance * (upper - lower) ? 0.0 : center_coordinate;
}

void HandleCommands::mirror(int axis)
{
  const std::vector<int> selected = this->selection_->selected();
  if (selected.empty())
  {
    return;
  }
  const Vec3 normal = Vec3::Unit(axis);
  const Vec3 plane_point = this->center_coordinate(axis) * normal;
  this->selection_->edit(this->selection_->step_name(tr("mirror"), selected),
    [&](const Handles& before, EditedHandles& after)
    { return mirror_handles(before, to_indices(selected), plane_point, normal, after); });
}

void HandleCommands::snap()
{
  const std::vector<int> selected = this->selection_->selected();
  SurfaceInput surface;
  if (selected.empty() || !to_surface(this->document_->work().surface, surface).ok())
  {
    return;
  }
  const SurfaceProbe probe(surface.points.view(), surface.triangles.view());
  this->selection_->edit(this->selection_->step_name(tr("snap to the surface:"), selected),
    [&](const Handles& before, EditedHandles& after)
    { return snap_to_surface(before, to_indices(selected), probe, after); });
}

void HandleCommands::set_parent(int parent)
{
  const std::vector<int> selected = this->selection_->selected();
  if (selected.empty())
  {
    return;
  }
  this->selection_->edit(this->selection_->step_name(tr("parent of"), selected),
    [&](const Handles& before, EditedHandles& after)
    {
      Status status;
      Handles list = before;
      for (const int handle : selected)
      {
        // Edit one handle after the other; these edits do not change the indices of handles.
        status = bindpose::set_parent(list, handle, parent, after);
        if (!status.ok())
        {
          return status;
        }
        list = after.handles;
      }
      return status;
    });
}

void HandleCommands::toggle_cage_edge()
{
  const std::vector<int> selected = this->selection_->selected();
  if (selected.size() != 2)
  {
    return;
  }
  this->selection_->edit(tr("cage edge"),
    [&](const Handles& before, EditedHandles& after)
    { return bindpose::toggle_cage_edge(before, selected[0], selected[1], after); });
}

void HandleCommands::set_handle_mode(HandleMode mode)
{
  const std::vector<int> selected = this->selection_->selected();
  Pose pose = this->document_->pose();
  for (const int handle : selected)
  {
    pose[static_cast<std::size_t>(handle)].mode = mode;
  }
  if (!selected.empty())
  {
    this->document_->set_pose(pose, this->selection_->step_name(tr("mode of"), selected));
  }
  this->update(); // check the entry again, because a click on a checked entry unchecks it
}

void HandleCommands::reset()
{
  const std::vector<int> selected = this->selection_->selected();
  Q_EMIT this->selection_->about_to_edit();
  Pose pose = this->document_->pose();
  for (const int handle : selected)
  {
    HandlePose& target = pose[static_cast<std::size_t>(handle)];
    const HandleMode mode = target.mode;
    target = HandlePose();
    target.mode = mode;
  }
  if (!selected.empty())
  {
    this->document_->set_pose(pose, this->selection_->step_name(tr("reset"), selected));
  }
}

void HandleCommands::select_all()
{
  std::vector<int> all;
  for (std::size_t k = 0; k < this->document_->handles().size(); ++k)
  {
    all.push_back(static_cast<int>(k));
  }
  this->selection_->select(all);
}

} // namespace app::handles
