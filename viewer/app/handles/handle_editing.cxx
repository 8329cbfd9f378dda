// Connects the handle widget to the document. The widget edits the document's handles in place and
// reports its actions by events. At the end of every drag and for every placed handle, the changes
// are committed as an undo step with the name of the action.
#include "app/handles/handle_editing.h"

#include "app/handles/edit_tools.h"
#include "app/handles/handle_commands.h"
#include "app/handles/handle_selection.h"
#include "app/handles/region_painting.h"
#include "app/handles/side_panel.h"
#include "app/handles/start_card.h"
#include "app/parts/panel_parts.h"
#include "app/parts/tool_icons.h"
#include "app/parts/window_keys.h"
#include "app/posing/posing.h"
#include "app/view/viewport.h"
#include "document/document.h"

#include "vtkCommand.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkPolyData.h"
#include "vtkRegionBrushRepresentation.h"

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QBoxLayout>
#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QShortcut>
#include <QToolButton>
#include <QTreeWidget>

namespace app::handles
{

using namespace bindpose;

namespace
{
using Representation = vtkHandleSetRepresentation;
} // namespace

HandleEditing::HandleEditing(Document* document, view::Viewport* viewport,
  posing::PoseController* posing, SidePanel* panel, QAction* auto_rig)
  : QObject(viewport), document_(document), viewport_(viewport), posing_(posing), panel_(panel),
    selection_(new HandleSelection(document, viewport)),
    painting_(new RegionPainting(document, viewport))
{
  this->make_actions();
  this->commands_ =
    new HandleCommands(this->selection_, document, viewport, panel->handle_list()->tree());
  this->tools_ = new EditTools({ { auto_rig }, this->modes_->actions(),
                                 this->gizmos_->actions() + QList<QAction*>{ this->local_ } },
    viewport->parentWidget());
  this->bar_ = new ModeBar(this->inside_, viewport);
  this->start_card_ = new StartCard(auto_rig, viewport);
  if (auto* overlay_layout = qobject_cast<QBoxLayout*>(viewport->layout()))
  {
    overlay_layout->insertWidget(0, this->bar_, 0, Qt::AlignLeft | Qt::AlignTop);
    // the legends are on the left, so put the card on the right
    overlay_layout->addWidget(this->start_card_, 0, Qt::AlignRight | Qt::AlignBottom);
  }
  QObject::connect(this->bar_, &ModeBar::done_requested, this, [this] { this->set_mode(pose); });
  QObject::connect(this->bar_, &ModeBar::end_cage_requested, this,
    [this]
    {
      this->representation()->FinishCage();
      this->viewport_->setFocus();
      this->viewport_->refresh();
      this->show_state();
    });
  QObject::connect(
    this->bar_, &ModeBar::radius_chosen, this->painting_, &RegionPainting::set_radius);
  QObject::connect(
    this->bar_, &ModeBar::new_region_requested, this, [this] { this->selection_->select({}); });
  QObject::connect(this->painting_, &RegionPainting::changed, this, &HandleEditing::show_state);
  QObject::connect(
    this->painting_, &RegionPainting::edit_refused, this, &HandleEditing::edit_refused);
  QObject::connect(
    this->selection_, &HandleSelection::edit_refused, this, &HandleEditing::edit_refused);
  QObject::connect(
    this->selection_, &HandleSelection::about_to_edit, this, &HandleEditing::cancel_interaction);
  QObject::connect(
    this->selection_, &HandleSelection::changed, this, &HandleEditing::selection_changed);
  QObject::connect(this->painting_, &RegionPainting::region_painted, this,
    [this](const QString& region)
    {
      this->selection_->select_names(region.isEmpty()
          ? std::vector<std::string>()
          : std::vector<std::string>{ region.toStdString() });
    });
  QObject::connect(panel, &SidePanel::handles_chosen, this, &HandleEditing::list_chosen);
  QTreeWidget* list = panel->handle_list()->tree();
  list->setContextMenuPolicy(Qt::CustomContextMenu);
  QObject::connect(list, &QWidget::customContextMenuRequested, this,
    [this, list](const QPoint& position)
    {
      if (QTreeWidgetItem* item = list->itemAt(position))
      {
        if (!item->isSelected())
        {
          list->setCurrentItem(item);
        }
        this->commands_->menu()->popup(list->viewport()->mapToGlobal(position));
      }
    });
  // A pose was typed, or key frames are played. Leave the edit mode, because it shows the shape at
  // rest. Also cancel a drag that was started by a key, because canceling the drag later would
  // restore the old pose.
  QObject::connect(posing, &posing::PoseController::pose_changed, this,
    [this]
    {
      this->cancel_interaction();
      this->set_mode(pose);
    });
  QObject::connect(document, &Document::option_changed, this,
    [this](const QString& key)
    {
      if (key == "pose.method")
      {
        this->show_state();
      }
    });
  this->connect_widget();
  viewport->installEventFilter(this);
  auto* back = new QShortcut(QKeySequence(Qt::Key_Escape), viewport->window());
  QObject::connect(back, &QShortcut::activated, this, &HandleEditing::step_back);
  this->show_state();
}

// ---- Tools and modes ---------------------------------------------------------------------------

QAction* HandleEditing::add_action(
  QActionGroup* group, const char* name, const QString& text, int value)
{
  auto* action = new QAction(parts::tool_icon(name), text, this);
  const QString keys = QString::fromStdString(parts::keys_of(name));
  action->setObjectName(name);
  action->setCheckable(true);
  action->setData(value);
  if (keys != "Esc") // for Esc, the constructor has a separate shortcut, which calls step_back()
  {
    action->setShortcut(QKeySequence(keys));
  }
  for (const parts::WindowKey& key : parts::window_keys)
  {
    if (QLatin1String(key.action) == name)
    {
      action->setToolTip(QString("%1 (%2)").arg(tr(key.text), keys));
    }
  }
  if (group)
  {
    group->addAction(action);
  }
  return action;
}

void HandleEditing::make_actions()
{
  this->modes_ = new QActionGroup(this);
  this->add_action(this->modes_, "mode.pose", tr("Pose"), pose)->setChecked(true);
  this->add_action(this->modes_, "mode.rest", tr("Rest"), move_rest);
  this->add_action(this->modes_, "mode.points", tr("Points"), add_points);
  this->add_action(this->modes_, "mode.bones", tr("Bones"), add_bones);
  this->add_action(this->modes_, "mode.cage", tr("Cage"), add_cage);
  this->add_action(this->modes_, "mode.regions", tr("Regions"), paint_regions);
  QObject::connect(this->modes_, &QActionGroup::triggered, this,
    [this](QAction* action)
    {
      this->set_mode(action->data().toInt());
      this->viewport_->setFocus();
    });
  this->gizmos_ = new QActionGroup(this);
  this->add_action(this->gizmos_, "gizmo.none", tr("Drag"), Representation::GIZMO_NONE)
    ->setChecked(true);
  this->add_action(this->gizmos_, "gizmo.move", tr("Move"), Representation::GIZMO_MOVE);
  this->add_action(this->gizmos_, "gizmo.turn", tr("Turn"), Representation::GIZMO_TURN);
  this->add_action(this->gizmos_, "gizmo.scale", tr("Scale"), Representation::GIZMO_SCALE);
  this->add_action(this->gizmos_, "gizmo.all", tr("All"), Representation::GIZMO_ALL);
  QObject::connect(this->gizmos_, &QActionGroup::triggered, this,
    [this](QAction* action)
    {
      this->set_mode(pose);
      this->representation()->SetGizmo(action->data().toInt());
      this->viewport_->setFocus();
      this->viewport_->refresh();
    });
  this->local_ = this->add_action(nullptr, "gizmo.local", tr("Local"), 0);
  QObject::connect(this->local_, &QAction::toggled, this,
    [this](bool on)
    {
      this->representation()->SetSpace(on ? Representation::LOCAL : Representation::WORLD);
      this->viewport_->refresh();
    });
  this->inside_ = this->add_action(nullptr, "inside", tr("Place &inside the shape"), 0);
  this->inside_->setChecked(this->representation()->GetPlaceInside() != 0);
  QObject::connect(this->inside_, &QAction::toggled, this,
    [this](bool on)
    {
      this->representation()->SetPlaceInside(on);
      this->viewport_->refresh();
      Q_EMIT this->status_text_changed();
    });
}

QAction* HandleEditing::action(const QString& name) const
{
  return this->findChild<QAction*>(name);
}

void HandleEditing::fill_menu(QMenu* menu)
{
  for (QAction* mode : this->modes_->actions())
  {
    menu->addAction(mode);
  }
  menu->addSeparator();
  QMenu* gizmo = menu->addMenu(tr("&Gizmo"));
  gizmo->addActions(this->gizmos_->actions());
  gizmo->addSeparator();
  gizmo->addAction(this->local_);
  menu->addAction(this->inside_);
  menu->addSeparator();
  this->commands_->fill(menu);
}

void HandleEditing::set_mode(int mode)
{
  if (mode == this->mode_)
  {
    return;
  }
  this->cancel_interaction();
  this->warning_.clear();
  this->mode_ = mode;
  Q_EMIT this->mode_changed(mode);
  // Show the shape at rest in all edit modes, and while regions are painted.
  this->posing_->edit_at_rest(mode != pose);
  this->widget()->SetEditMode(mode == paint_regions ? move_rest : mode);
  this->widget()->SetProcessEvents(mode != paint_regions);
  this->representation()->LeaveHandles();
  this->painting_->set_active(mode == paint_regions);
  if (mode == paint_regions)
  {
    const std::vector<int> selected = this->selection_->selected();
    this->painting_->set_region(selected.empty() ? -1 : selected.back());
  }
  if (mode != pose)
  {
    this->viewport_->setFocus();
  }
  this->show_state();
  this->viewport_->refresh();
}

void HandleEditing::show_rest(bool shown)
{
  if (shown != (this->representation()->GetShowRest() != 0))
  {
    this->cancel_interaction();
    this->representation()->SetShowRest(shown);
    this->viewport_->refresh();
  }
}

void HandleEditing::step_back()
{
  if (this->widget()->IsDragging() || this->painting_->is_painting())
  {
    this->cancel_interaction();
  }
  else if (this->representation()->IsMakingCage())
  {
    QKeyEvent key(QEvent::KeyPress, Qt::Key_Escape, Qt::NoModifier);
    QApplication::sendEvent(this->viewport_, &key);
  }
  else
  {
    this->set_mode(pose);
  }
}

void HandleEditing::cancel_interaction()
{
  this->widget()->CancelDrag();
  this->painting_->cancel();
}

/// Update which actions are enabled and which are checked.
void HandleEditing::show_state()
{
  const bool surface = this->document_->surface();
  const bool handles = this->document_->handle_data();
  for (QAction* mode : this->modes_->actions())
  {
    const int mode_value = mode->data().toInt();
    mode->setEnabled(mode_value == pose ||
      (mode_value == move_rest          ? handles
          : mode_value == paint_regions ? surface
                                        : surface || handles));
    mode->setChecked(mode_value == this->mode_);
  }
  this->gizmos_->setEnabled(handles);
  this->local_->setEnabled(handles);
  this->inside_->setEnabled(surface);
  this->start_card_->setVisible(surface && !handles && this->mode_ == pose);
  this->representation()->SetStretchableBones(
    this->document_->number("pose.method") == static_cast<int>(PoseMethod::stretchable_bones));
  ModeBar::State state;
  const QString titles[] = { QString(), tr("Move rest positions"), tr("Add points"),
    tr("Add bones"), tr("Add a cage"), tr("Paint regions") };
  state.title = titles[this->mode_];
  state.shows_inside = surface && (this->mode_ == add_points || this->mode_ == add_bones);
  state.cage = this->mode_ == add_cage;
  state.making_cage = this->representation()->IsMakingCage();
  state.shows_brush = this->mode_ == paint_regions;
  state.has_region = this->painting_->has_region();
  state.radius = this->painting_->radius();
  this->bar_->show_state(state);
  this->commands_->update();
  Q_EMIT this->status_text_changed();
}

// ---- The widget --------------------------------------------------------------------------------

vtkHandleSetWidget* HandleEditing::widget() const
{
  return this->viewport_->handle_widget();
}

vtkHandleSetRepresentation* HandleEditing::representation() const
{
  return this->widget()->GetHandleSetRepresentation();
}

void HandleEditing::connect_widget()
{
  vtkHandleSetWidget* widget = this->widget();
  widget->AddObserver(
    vtkCommand::SelectionChangedEvent, this->selection_, &HandleSelection::read_view);
  widget->AddObserver(vtkCommand::StartInteractionEvent, this, &HandleEditing::drag_began);
  widget->AddObserver(vtkCommand::InteractionEvent, this, &HandleEditing::drag_continued);
  widget->AddObserver(vtkCommand::EndInteractionEvent, this, &HandleEditing::drag_ended);
  widget->AddObserver(vtkCommand::PlacePointEvent, this, &HandleEditing::handle_placed);
  widget->AddObserver(vtkCommand::WarningEvent, this, &HandleEditing::show_warning);
  widget->AddObserver(vtkCommand::StateChangedEvent, this, &HandleEditing::widget_mode_changed);
  widget->AddObserver(vtkCommand::HighlightEvent, this, &HandleEditing::status_text_changed);
}

void HandleEditing::drag_began()
{
  this->warning_.clear();
  if (this->mode_ == pose)
  {
    this->posing_->drag_began();
  }
}

void HandleEditing::drag_continued()
{
  Q_EMIT this->moved();
  Q_EMIT this->status_text_changed();
}

/// Called when the widget has added or removed a handle.
void HandleEditing::handle_placed()
{
  const QString interaction = QString::fromStdString(this->widget()->GetInteractionName());
  const bool is_addition =
    interaction == "add point" || interaction == "add bone" || interaction == "add cage vertex";
  const std::string name =
    this->representation()->GetHandleName(this->representation()->GetSelectedHandle());
  this->selection_->commit(
    is_addition ? interaction + " " + QString::fromStdString(name) : interaction);
}

void HandleEditing::drag_ended()
{
  if (!this->widget()->GetCanceled())
  {
    const QString interaction = QString::fromStdString(this->widget()->GetInteractionName());
    if (this->mode_ == pose)
    {
      this->document_->commit_pose(
        this->selection_->step_name(interaction, this->selection_->selected()));
    }
    else if (this->mode_ == move_rest)
    {
      this->selection_->commit(
        this->selection_->step_name(tr("move at rest"), this->selection_->selected()));
    }
  }
  this->show_state();
}

void HandleEditing::show_warning(vtkObject* /*caller*/, unsigned long /*event*/, void* message)
{
  this->warning_ = parts::capitalized(QString::fromUtf8(static_cast<const char*>(message))) + ".";
  Q_EMIT this->status_text_changed();
}

void HandleEditing::widget_mode_changed()
{
  this->set_mode(this->representation()->GetEditMode());
}

// ---- The selection -----------------------------------------------------------------------------

void HandleEditing::selection_changed()
{
  const std::vector<int> selected = this->selection_->selected();
  const int last = selected.empty() ? -1 : selected.back();
  this->is_updating_list_ = true;
  this->panel_->select_handles(selected);
  this->is_updating_list_ = false;
  if (this->mode_ == paint_regions)
  {
    this->painting_->set_region(last);
  }
  Q_EMIT this->handle_selected(last);
  this->commands_->update();
  Q_EMIT this->status_text_changed();
}

void HandleEditing::list_chosen()
{
  if (!this->is_updating_list_)
  {
    this->selection_->select(this->panel_->selected_handles());
  }
}

bool HandleEditing::show_menu(const QPoint& position)
{
  const QPoint pixel = this->viewport_->to_vtk(position);
  this->representation()->ComputeInteractionState(pixel.x(), pixel.y());
  const int handle = this->document_->handle_of_cell(this->representation()->GetHoveredHandle());
  if (handle < 0)
  {
    return false;
  }
  if (!this->representation()->IsSelected(this->representation()->GetHoveredHandle()))
  {
    this->selection_->select({ handle });
  }
  this->commands_->menu()->popup(this->viewport_->mapToGlobal(position));
  return true;
}

void HandleEditing::document_changed(int parts)
{
  if (parts & mesh_part)
  {
    this->representation()->SetSurface(this->document_->work().surface);
  }
  if (parts & (mesh_part | handles_part) && !this->document_->surface() &&
    !this->document_->handle_data())
  {
    this->set_mode(pose);
  }
  if (parts & handles_part)
  {
    this->selection_->handles_changed();
  }
  if (parts & (mesh_part | weights_part | handles_part))
  {
    this->painting_->document_changed();
  }
  this->show_state();
}

// ---- The status line ---------------------------------------------------------------------------

QString HandleEditing::message() const
{
  if (!this->warning_.isEmpty())
  {
    return this->warning_;
  }
  if (this->widget()->IsDragging())
  {
    return this->drag_hint();
  }
  const QString refusal = this->refusal();
  return refusal.isEmpty() ? this->mode_hint() : refusal;
}

QString HandleEditing::drag_hint() const
{
  const QString interaction =
    parts::capitalized(QString::fromStdString(this->widget()->GetInteractionName()));
  if (this->mode_ > move_rest)
  {
    return tr("%1: release the button to place it; Ctrl snaps, Esc cancels.").arg(interaction);
  }
  const QString amount = QString::fromStdString(this->representation()->GetInteractionText());
  const QString keys = this->mode_ == pose
    ? tr("X Y Z: axis; digits: value; Shift: fine; Ctrl: snap; Enter: end; Esc: cancel")
    : tr("X Y Z: axis; Shift: fine; Ctrl: snap; Esc: cancel");
  return QString("%1 %2   ·   %3").arg(interaction, amount, keys);
}

/// Return the reason why the handle under the mouse cannot be dragged.
QString HandleEditing::refusal() const
{
  const vtkIdType cell = this->representation()->GetHoveredHandle();
  if (cell < 0 || this->mode_ > move_rest)
  {
    return {};
  }
  const QString name = QString::fromStdString(this->representation()->GetHandleName(cell));
  switch (this->representation()->GetDragRefusal(cell))
  {
    case Representation::IS_FREE:
      return tr("%1 is free: the solver computes its position. Fix its position to drag it.")
        .arg(name);
    case Representation::IS_LOCKED:
      return tr("%1 is locked; select it and press %2 to unlock it.")
        .arg(name, QString::fromStdString(parts::keys_of("lock")));
    case Representation::IS_AT_REST:
      return tr("%1 is shown at rest and cannot be dragged; show the pose to drag it.").arg(name);
    default:
      return {};
  }
}

QString HandleEditing::mode_hint() const
{
  const bool inside =
    this->representation()->GetPlaceInside() && this->representation()->GetSurface();
  const QString placement_text = inside ? tr("inside the shape (I: on its surface)")
                                        : tr("on the surface (I: inside the shape)");
  switch (this->mode_)
  {
    case move_rest:
      return tr("Drag handles, bones and joints to their rest positions; Ctrl snaps, Esc ends.");
    case add_points:
      return tr("Click on the shape to add a point %1; Ctrl snaps, Esc ends.").arg(placement_text);
    case add_bones:
      return tr("Drag from a bone's head to its tail, %1; start at a bone's end to add a child; "
                "Ctrl snaps, Esc ends.")
        .arg(placement_text);
    case add_cage:
      return this->representation()->IsMakingCage()
        ? tr("Click to add vertices; the first vertex closes the cage, Enter leaves it open, Esc "
             "removes the last vertex.")
        : tr("Click to add the first vertex of the cage, on or next to the shape; Esc ends.");
    case paint_regions:
      return tr("Paint %1; Ctrl erases, [ and ] change the brush size, Esc ends.")
        .arg(this->painting_->has_region() ? this->painting_->region() : tr("a new region"));
    default:
      return {};
  }
}

// ---- Keys and the right button -----------------------------------------------------------------

/// Report whether the 3D view handles this key in its current state, for example during a drag.
/// Such a key must not trigger a shortcut of the window.
bool HandleEditing::takes_key(const QKeyEvent* event) const
{
  if (event->modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier))
  {
    return false;
  }
  if (this->widget()->IsDragging() || this->painting_->is_painting())
  {
    return true;
  }
  if (event->key() == Qt::Key_Escape)
  {
    return this->mode_ != pose;
  }
  return this->mode_ == pose && this->widget()->GetEnabled() &&
    !this->representation()->GetShowRest() &&
    this->representation()->GetNumberOfSelectedHandles() > 0 &&
    (event->key() == Qt::Key_G || event->key() == Qt::Key_R || event->key() == Qt::Key_S);
}

bool HandleEditing::eventFilter(QObject* watched, QEvent* event)
{
  switch (event->type())
  {
    case QEvent::PaletteChange: // the desktop changes between light and dark
      for (const QToolButton* button : this->tools_->findChildren<QToolButton*>())
      {
        QAction* action = button->defaultAction();
        action->setIcon(parts::tool_icon(action->objectName().toLatin1()));
      }
      break;
    case QEvent::ShortcutOverride:
      if (this->takes_key(static_cast<QKeyEvent*>(event)))
      {
        event->accept();
        return true;
      }
      break;
    case QEvent::KeyPress:
      if (static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape && this->mode_ == paint_regions &&
        !this->painting_->is_painting())
      {
        this->set_mode(pose);
        return true;
      }
      break;
    case QEvent::MouseButtonPress:
    {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      this->right_pressed_on_handle_ = mouse->button() == Qt::RightButton &&
        !this->widget()->IsDragging() && !this->painting_->is_painting() &&
        this->widget()->GetEnabled() && this->show_menu(mouse->pos());
      return this->right_pressed_on_handle_ || QObject::eventFilter(watched, event);
    }
    case QEvent::MouseButtonRelease:
      if (this->right_pressed_on_handle_ &&
        static_cast<QMouseEvent*>(event)->button() == Qt::RightButton)
      {
        this->right_pressed_on_handle_ = false;
        return true;
      }
      break;
    case QEvent::ContextMenu:
    {
      const auto* menu = static_cast<QContextMenuEvent*>(event);
      if (menu->reason() == QContextMenuEvent::Keyboard && !this->selection_->selected().empty())
      {
        this->commands_->menu()->popup(
          this->viewport_->mapToGlobal(this->viewport_->rect().center()));
      }
      return true; // for the right mouse button, the press event has already shown the menu
    }
    default:
      break;
  }
  return QObject::eventFilter(watched, event);
}

} // namespace app::handles
