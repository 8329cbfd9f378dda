#include "app/tour/simulated_user.h"

#include "app/handles/handle_commands.h"
#include "app/handles/handle_editing.h"
#include "app/handles/shape_handles.h"
#include "app/handles/side_panel.h"
#include "app/parts/value_row.h"
#include "app/posing/body_motion.h"
#include "app/posing/key_strip.h"
#include "app/posing/pose_ghost.h"
#include "app/posing/pose_panel.h"
#include "app/posing/posing.h"
#include "app/posing/sequence_export.h"
#include "app/tets/tet_inspection.h"
#include "app/view/viewport.h"
#include "app/volume/winding_volume.h"
#include "app/weights/binding.h"
#include "app/weights/weight_inspection.h"
#include "app/window/main_window.h"
#include "app/window/panel_column.h"
#include "document/document.h"

#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkRenderer.h"

#include <QAbstractButton>
#include <QAbstractSpinBox>
#include <QAction>
#include <QApplication>
#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QFileInfo>
#include <QKeyEvent>
#include <QKeySequence>
#include <QLineEdit>
#include <QMenuBar>
#include <QMimeData>
#include <QMouseEvent>
#include <QScrollArea>
#include <QTimer>
#include <QUrl>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

namespace app::tour
{

using namespace bindpose;

namespace
{
/// Scroll the enclosing scroll areas until the widget and a margin below it are visible.
void scroll_to(QWidget* widget)
{
  for (QWidget* each = widget; each; each = each->parentWidget())
  {
    if (auto* area = qobject_cast<QScrollArea*>(each))
    {
      constexpr int margin = 150; // margin in pixels
      area->ensureWidgetVisible(widget, 0, margin);
    }
  }
}
} // namespace

view::Viewport* SimulatedUser::viewport() const
{
  return this->window_->findChild<view::Viewport*>();
}

// ---- The mouse ---------------------------------------------------------------------------------

QPoint SimulatedUser::pixel_of_fractions(double x, double y) const
{
  const view::Viewport* viewport = this->viewport();
  return { static_cast<int>(std::lround(x * (viewport->width() - 1))),
    static_cast<int>(std::lround(y * (viewport->height() - 1))) };
}

int SimulatedUser::number_of(const QString& handle) const
{
  const Handles& handles = this->window_->document()->handles();
  const auto found = std::find_if(handles.begin(), handles.end(),
    [name = handle.toStdString()](const Handle& each) { return each.name == name; });
  return found == handles.end() ? -1 : static_cast<int>(found - handles.begin());
}

QString SimulatedUser::find_handle_position(
  const QString& handle, double bone_fraction, QPoint& position) const
{
  const int number = this->number_of(handle);
  if (number < 0)
  {
    return QObject::tr("unknown handle '%1'").arg(handle);
  }
  view::Viewport* viewport = this->viewport();
  auto* representation = viewport->handle_widget()->GetHandleSetRepresentation();
  const Index cell = this->window_->document()->handle_cells()[static_cast<std::size_t>(number)];
  Vec3 head, tail;
  representation->GetPosedHead(cell, head.data());
  representation->GetPosedTail(cell, tail.data());
  const Vec3 world_position = head + bone_fraction * (tail - head);
  vtkRenderer* renderer = viewport->renderer();
  renderer->SetWorldPoint(world_position.x(), world_position.y(), world_position.z(), 1.0);
  renderer->WorldToDisplay();
  position = this->from_display(renderer->GetDisplayPoint());
  return {};
}

QString SimulatedUser::find_gizmo_position(int part, QPoint& position) const
{
  auto* representation = this->viewport()->handle_widget()->GetHandleSetRepresentation();
  double pixel[2] = { 0.0, 0.0 };
  if (!representation->GetGizmoGrip(part, pixel))
  {
    return QObject::tr("this part of the gizmo is not visible");
  }
  position = this->from_display(pixel);
  return {};
}

QPoint SimulatedUser::from_display(const double* pixel) const
{
  const view::Viewport* viewport = this->viewport();
  const double scale = viewport->devicePixelRatioF();
  return { static_cast<int>(std::floor(pixel[0] / scale)),
    viewport->height() - 1 - static_cast<int>(std::floor(pixel[1] / scale)) };
}

void SimulatedUser::send(QEvent::Type type, const QPoint& position, Qt::MouseButton button,
  Qt::MouseButtons held, Qt::KeyboardModifiers keys)
{
  view::Viewport* viewport = this->viewport();
  QMouseEvent event(type, position, viewport->mapToGlobal(position), button, held, keys);
  QApplication::sendEvent(viewport, &event);
}

void SimulatedUser::press(
  const QPoint& position, Qt::MouseButton button, Qt::KeyboardModifiers held)
{
  // a click on the 3D view gives it the focus
  this->viewport()->setFocus(Qt::MouseFocusReason);
  this->buttons_ |= button;
  this->send(QEvent::MouseButtonPress, position, button, this->buttons_, held);
}

void SimulatedUser::move(const QPoint& position, Qt::KeyboardModifiers held)
{
  this->send(QEvent::MouseMove, position, Qt::NoButton, this->buttons_, held);
}

void SimulatedUser::release(
  const QPoint& position, Qt::MouseButton button, Qt::KeyboardModifiers held)
{
  this->buttons_ &= ~Qt::MouseButtons(button);
  this->send(QEvent::MouseButtonRelease, position, button, this->buttons_, held);
}

void SimulatedUser::double_click(
  const QPoint& position, Qt::MouseButton button, Qt::KeyboardModifiers held)
{
  this->press(position, button, held);
  this->release(position, button, held);
  this->buttons_ |= button;
  this->send(QEvent::MouseButtonDblClick, position, button, this->buttons_, held);
  this->release(position, button, held);
}

void SimulatedUser::wheel(const QPoint& position, double turns, Qt::KeyboardModifiers held)
{
  view::Viewport* viewport = this->viewport();
  constexpr int notch = 120; // angle of one wheel notch in eighths of a degree (Qt's unit)
  const QPoint angle(0, static_cast<int>(std::lround(notch * turns)));
  QWheelEvent event(position, viewport->mapToGlobal(position), QPoint(), angle, this->buttons_,
    held, Qt::NoScrollPhase, false);
  QApplication::sendEvent(viewport, &event);
}

void SimulatedUser::leave()
{
  // While a button is pressed, the 3D view grabs the mouse, so Qt would send no leave event.
  if (this->buttons_ == Qt::NoButton)
  {
    QEvent event(QEvent::Leave);
    QApplication::sendEvent(this->viewport(), &event);
  }
}

void SimulatedUser::scrub(double seconds)
{
  this->leave();
  posing::KeyTrack* track = this->window_->findChild<posing::KeyStrip*>()->track();
  const QPoint position(track->pixel(seconds), track->height() / 2);
  for (const QEvent::Type type : { QEvent::MouseButtonPress, QEvent::MouseButtonRelease })
  {
    const bool is_press = type == QEvent::MouseButtonPress;
    QMouseEvent event(type, position, track->mapToGlobal(position), Qt::LeftButton,
      is_press ? Qt::LeftButton : Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(track, &event);
  }
}

// ---- Files, keys and menus ---------------------------------------------------------------------

QString SimulatedUser::drop(const QString& file)
{
  this->leave();
  QMimeData data;
  data.setUrls({ QUrl::fromLocalFile(QFileInfo(file).absoluteFilePath()) });
  const QPoint position = this->window_->rect().center();
  QDragEnterEvent enter(position, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  enter.ignore();
  QApplication::sendEvent(this->window_, &enter);
  if (!enter.isAccepted())
  {
    return QObject::tr("the window does not accept files now");
  }
  QDropEvent drop(position, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(this->window_, &drop);
  return drop.isAccepted() ? QString() : QObject::tr("the file cannot be opened");
}

QString SimulatedUser::type(const QString& text, const QString& field)
{
  this->leave();
  for (QWidget* each : this->window_->findChildren<QWidget*>())
  {
    const bool accepts_text =
      qobject_cast<QLineEdit*>(each) || qobject_cast<QAbstractSpinBox*>(each);
    if (!accepts_text || each->accessibleName() != field || !each->isVisible())
    {
      continue;
    }
    if (!each->isEnabled())
    {
      return QObject::tr("the field '%1' is disabled").arg(field);
    }
    scroll_to(each);
    each->setFocus(Qt::MouseFocusReason);
    if (QApplication::focusWidget() != each)
    {
      return QObject::tr("the field '%1' cannot receive keyboard input").arg(field);
    }
    auto* line = qobject_cast<QLineEdit*>(each);
    line = line ? line : each->findChild<QLineEdit*>();
    line->selectAll();
    for (const QChar letter : text)
    {
      QKeyEvent press(QEvent::KeyPress, letter.toUpper().unicode(), Qt::NoModifier, letter);
      QApplication::sendEvent(each, &press);
    }
    return {};
  }
  return QObject::tr("no field '%1' is visible").arg(field);
}

QString SimulatedUser::press_key(const QString& keys)
{
  const QKeySequence sequence = QKeySequence::fromString(keys, QKeySequence::PortableText);
  if (sequence.count() != 1 || (sequence[0] & ~Qt::KeyboardModifierMask) == Qt::Key_unknown)
  {
    return QObject::tr("unknown key '%1'").arg(keys);
  }
  const auto held = Qt::KeyboardModifiers(sequence[0] & Qt::KeyboardModifierMask);
  const int key = sequence[0] & ~static_cast<int>(Qt::KeyboardModifierMask);
  QWidget* focus = QApplication::focusWidget();
  focus = focus ? focus : this->viewport();
  const bool letter =
    key >= Qt::Key_Space && key <= Qt::Key_AsciiTilde && !(held & Qt::ControlModifier);
  const QString text = letter
    ? (held & Qt::ShiftModifier ? QString(QChar(key)) : QString(QChar(key)).toLower())
    : QString();
  // Offer the key to the widget with the focus first. In Qt, this widget receives a key before the
  // shortcuts of the menus.
  QKeyEvent first(QEvent::ShortcutOverride, key, held, text);
  first.ignore();
  QApplication::sendEvent(focus, &first);
  if (!first.isAccepted())
  {
    for (QAction* each : this->window_->findChildren<QAction*>())
    {
      if (each->isEnabled() && each->shortcuts().contains(sequence))
      {
        each->trigger();
        return {};
      }
    }
  }
  QKeyEvent press(QEvent::KeyPress, key, held, text);
  QApplication::sendEvent(focus, &press);
  QKeyEvent release(QEvent::KeyRelease, key, held, text);
  QApplication::sendEvent(focus, &release);
  return {};
}

QStringList SimulatedUser::actions() const
{
  QStringList names;
  for (const QAction* each : this->window_->findChildren<QAction*>())
  {
    if (!each->objectName().isEmpty() && !each->menu())
    {
      names << each->objectName();
    }
  }
  return names;
}

QAction* SimulatedUser::action(const QString& name) const
{
  return name.isEmpty() ? nullptr : this->window_->findChild<QAction*>(name);
}

QString SimulatedUser::trigger(const QString& name)
{
  QAction* found = this->action(name);
  if (!found)
  {
    return QObject::tr("unknown menu entry '%1'").arg(name);
  }
  if (!found->isEnabled())
  {
    return QObject::tr("the menu entry '%1' is disabled").arg(name);
  }
  found->trigger();
  return {};
}

// ---- Panels ------------------------------------------------------------------------------------

QString SimulatedUser::push_button(const QString& text)
{
  this->leave();
  bool found_button = false;
  for (QAbstractButton* each : this->window_->findChildren<QAbstractButton*>())
  {
    QString name = each->text();
    name.remove('&');
    while (!name.isEmpty() && !name[0].isLetterOrNumber())
    {
      name.remove(0, 1); // the heading of a section begins with a mark
    }
    if (name != text || !each->isVisible())
    {
      continue;
    }
    found_button = true;
    if (each->isEnabled())
    {
      each->click();
      QApplication::processEvents(); // let Qt lay out the widgets that have appeared
      scroll_to(each);
      return {};
    }
  }
  return found_button ? QObject::tr("the button '%1' is disabled").arg(text)
                      : QObject::tr("no button '%1' is visible").arg(text);
}

QString SimulatedUser::choose(const QString& key, const QVariant& value)
{
  this->leave();
  const OptionInfo* option = find_option(key);
  if (!option)
  {
    return QObject::tr("unknown option '%1'").arg(key);
  }
  const QVariant checked = checked_option(*option, value);
  if (!checked.isValid())
  {
    return QObject::tr("the option '%1' cannot have the value %2").arg(key, value.toString());
  }
  QObject* found = this->window_->findChild<window::PanelColumn*>()->findChild<QObject*>(key);
  auto* widget = qobject_cast<QWidget*>(found);
  const QString disabled = QObject::tr("the option '%1' is disabled").arg(key);
  const QString missing =
    QObject::tr("the option '%1' cannot have the choice %2").arg(key, value.toString());
  if (widget && !widget->isEnabled())
  {
    return disabled;
  }
  scroll_to(widget);
  if (auto* box = qobject_cast<QCheckBox*>(found))
  {
    if (box->isChecked() != checked.toBool())
    {
      box->click();
    }
  }
  else if (auto* list = qobject_cast<QComboBox*>(found))
  {
    if (checked.toInt() >= list->count())
    {
      return missing;
    }
    if (!(list->model()->flags(list->model()->index(checked.toInt(), list->modelColumn())) &
          Qt::ItemIsEnabled))
    {
      return disabled;
    }
    list->setCurrentIndex(checked.toInt());
    Q_EMIT list->activated(checked.toInt());
  }
  else if (auto* group = qobject_cast<QButtonGroup*>(found))
  {
    QAbstractButton* button = group->button(checked.toInt());
    if (!button)
    {
      return missing;
    }
    if (!button->isEnabled())
    {
      return disabled;
    }
    button->click();
  }
  else if (auto* row = qobject_cast<parts::ValueRow*>(found))
  {
    row->choose(checked.toDouble());
  }
  else
  {
    return QObject::tr("the option '%1' is not in any panel").arg(key);
  }
  return {};
}

const QStringList& SimulatedUser::panel_names()
{
  // The names are in the same order as PanelColumn::Panel.
  static const QStringList names{ "pose", "weights", "tets", "volume" };
  return names;
}

QString SimulatedUser::show_panel(const QString& name)
{
  this->leave();
  const int panel = panel_names().indexOf(name);
  if (panel < 0)
  {
    return QObject::tr("unknown panel '%1': expected one of %2")
      .arg(name, panel_names().join(", "));
  }
  this->window_->findChild<window::PanelColumn*>()->show_panel(panel);
  return this->window_->findChild<window::PanelColumn*>()->shown_panel() == panel
    ? QString()
    : QObject::tr("the panel '%1' is not available").arg(name);
}

QString SimulatedUser::select(const QString& handle)
{
  this->leave();
  const int number = this->number_of(handle);
  if (number < 0)
  {
    return QObject::tr("unknown handle '%1'").arg(handle);
  }
  this->window_->findChild<handles::SidePanel*>()->select_handle(number);
  return {};
}

QString SimulatedUser::set_mode(const QString& mode)
{
  this->leave();
  const std::vector<int> selected =
    this->window_->findChild<handles::SidePanel*>()->selected_handles();
  if (selected.empty())
  {
    return QObject::tr("no handle is selected");
  }
  const auto& words = handle_mode_words;
  const auto* found = std::find(std::begin(words), std::end(words), mode.toStdString());
  const auto number = static_cast<int>(found - std::begin(words));
  const Handles& handles = this->window_->document()->handles();
  const bool bones = std::all_of(selected.begin(), selected.end(),
    [&](int handle) { return handles[static_cast<std::size_t>(handle)].kind == HandleKind::bone; });
  if (found == std::end(words) || (constrains_tail(static_cast<HandleMode>(number)) && !bones))
  {
    return selected.size() > 1
      ? QObject::tr("the mode '%1' is not available for these handles").arg(mode)
      : QObject::tr("the mode '%1' is not available for this handle").arg(mode);
  }
  this->window_->findChild<handles::HandleEditing*>()->commands()->set_handle_mode(
    static_cast<HandleMode>(number));
  return {};
}

// ---- Waiting -----------------------------------------------------------------------------------

namespace
{
bool is_busy(posing::Deformation* deformation)
{
  return deformation->is_binding() ||
    (deformation->can_pose() && !deformation->is_settled() && !deformation->is_canceled() &&
      deformation->error().isEmpty());
}
} // namespace

bool is_idle(const window::MainWindow* window)
{
  const posing::PoseController* posing = window->findChild<posing::PoseController*>();
  const bool simulates_motion =
    window->findChild<handles::SidePanel*>()->pose()->simulates_motion();
  const bool is_ghost_shown = posing->ghost()->display_mode() != posing::PoseGhost::hidden;
  return !window->findChild<weights::Binding*>()->is_running() &&
    !window->findChild<tets::TetInspection*>()->is_busy() &&
    !window->findChild<weights::WeightInspection*>()->is_busy() &&
    !window->findChild<volume::WindingVolume*>()->is_running() &&
    !window->findChild<handles::ShapeHandles*>()->is_running() &&
    !posing->pose_manager()->is_playing() && !posing->motion()->is_playing() &&
    !posing->sequence_export()->is_running() &&
    (simulates_motion || !is_busy(posing->deformation())) &&
    (!simulates_motion || !posing->motion()->body() || posing->motion()->has_started()) &&
    (!is_ghost_shown || !is_busy(posing->compared_deformation()));
}

bool wait_until(const std::function<bool()>& condition, double seconds)
{
  QElapsedTimer clock;
  clock.start();
  QTimer wake; // Wakes the event loop, because the condition may become true without an event.
  wake.start(5);
  while (!condition())
  {
    if (1e-3 * static_cast<double>(clock.elapsed()) >= seconds)
    {
      return false;
    }
    QApplication::processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents);
  }
  return true;
}

} // namespace app::tour
