#include "monkey.h"

#include "app/handles/side_panel.h"
#include "app/posing/body_motion.h"
#include "app/posing/pose_panel.h"
#include "app/posing/posing.h"
#include "app/posing/sequence_export.h"
#include "app/tets/tet_inspection.h"
#include "app/view/viewport.h"
#include "app/volume/winding_volume.h"
#include "app/weights/binding.h"
#include "app/weights/weight_inspection.h"
#include "app/window/main_window.h"
#include "document/document.h"

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QDialog>
#include <QTimer>
#include <QUndoStack>

namespace bindpose::test
{

namespace
{
/// Report whether an action is excluded because it would open a file dialog or quit.
bool is_excluded(const QString& name)
{
  return name == "file.quit" || name == "file.open" || name.startsWith("file.save");
}
} // namespace

Monkey::Monkey(app::window::MainWindow* window, unsigned seed, std::vector<QString> files)
  : window_(window), user_(window), random_(seed), files_(std::move(files))
{
}

double Monkey::number(double lowest, double highest)
{
  const double fraction = static_cast<double>(this->random_()) / 4294967295.0;
  return lowest + fraction * (highest - lowest);
}

void Monkey::note(const std::string& kind, const QString& what)
{
  ++this->events_;
  ++this->counts_[kind];
  this->last_events_.push_back(kind + " " + what.toStdString());
  constexpr std::size_t maximum_events = 60;
  if (this->last_events_.size() > maximum_events)
  {
    this->last_events_.erase(this->last_events_.begin());
  }
}

std::string Monkey::event_log() const
{
  std::string event_log;
  for (const std::string& event : this->last_events_)
  {
    event_log += "  " + event + '\n';
  }
  return event_log;
}

/// Return a random position in the view, or sometimes outside of it. Half of the positions are on
/// handles.
QPoint Monkey::random_position()
{
  const Handles& handles = this->window_->document()->handles();
  QPoint position =
    this->user_.pixel_of_fractions(this->number(-0.05, 1.05), this->number(-0.05, 1.05));
  if (!handles.empty() && this->pick(2) == 0)
  {
    const auto& name =
      handles[static_cast<std::size_t>(this->pick(static_cast<int>(handles.size())))].name;
    this->user_.find_handle_position(QString::fromStdString(name), this->pick(2), position);
    position += QPoint(this->pick(5) - 2, this->pick(5) - 2);
  }
  return position;
}

Qt::MouseButton Monkey::random_button()
{
  const int which = this->pick(10);
  return which < 8 ? Qt::LeftButton : which == 8 ? Qt::RightButton : Qt::MiddleButton;
}

Qt::KeyboardModifiers Monkey::random_modifiers()
{
  const int which = this->pick(12);
  return which == 0 ? Qt::ShiftModifier
    : which == 1    ? Qt::ControlModifier
    : which == 2    ? Qt::AltModifier
                    : Qt::NoModifier;
}

void Monkey::drag()
{
  const QPoint from = this->random_position();
  const QPoint offset(this->pick(241) - 120, this->pick(241) - 120);
  const Qt::MouseButton button = this->random_button();
  const Qt::KeyboardModifiers modifiers = this->random_modifiers();
  const int moves = 1 + this->pick(6);
  this->note(
    "drag", QString("%1 %2 by %3 %4").arg(from.x()).arg(from.y()).arg(offset.x()).arg(offset.y()));
  this->user_.move(from, modifiers);
  this->user_.press(from, button, modifiers);
  for (int k = 1; k <= moves; ++k)
  {
    this->user_.move(from + offset * k / moves, modifiers);
    QApplication::processEvents();
    if (this->pick(25) == 0)
    {
      this->press_random_key(); // press a key during the drag
    }
  }
  if (this->pick(12) != 0) // with a probability of 1/12, the mouse button stays down
  {
    this->user_.release(from + offset, button, modifiers);
  }
}

void Monkey::press_random_key()
{
  static const char* const keys[] = { "Esc", "Return", "Tab", "Backspace", "Delete", "Home", "Left",
    "Right", "Up", "Down", "Space", "1", "2", "3", "4", "5", "6", "7", "8", "9", "0", ".", "-", "G",
    "R", "S", "X", "Y", "Z", "K", "W", "E", "P", "Q", "A", "D", "Shift+X", "Shift+Y", "Shift+Tab",
    "Ctrl+Z", "Ctrl+Y", "Ctrl+Shift+Z", "Ctrl+B", "Ctrl+R", "Ctrl+A", "F2", "PgUp", "PgDown" };
  const char* key = keys[this->pick(static_cast<int>(std::size(keys)))];
  this->note("key", key);
  this->user_.press_key(key);
}

void Monkey::trigger_random_action()
{
  const QStringList names = this->user_.actions();
  const QString name = names.isEmpty() ? QString() : names[this->pick(names.size())];
  if (!is_excluded(name))
  {
    this->note("action", name);
    this->user_.trigger(name);
  }
}

void Monkey::choose_random_option()
{
  const OptionInfo& option =
    option_table()[static_cast<std::size_t>(this->pick(static_cast<int>(option_table().size())))];
  QVariant value = this->pick(2) == 0;
  if (option.initial.type() == QVariant::Int)
  {
    value = this->pick(8);
  }
  else if (option.initial.type() == QVariant::Double)
  {
    value = this->number(std::max(option.lowest, -2.0), std::min(option.highest, 200.0));
  }
  this->note("option", QString("%1 %2").arg(option.key, value.toString()));
  this->user_.choose(option.key, value);
}

/// Click a random visible button. Buttons that open a file dialog are excluded.
void Monkey::click_random_button()
{
  QStringList texts;
  for (const QAbstractButton* each : this->window_->findChildren<QAbstractButton*>())
  {
    QString text = each->text();
    while (!text.isEmpty() && !text[0].isLetterOrNumber())
    {
      text.remove(0, 1);
    }
    if (each->isVisible() && each->isEnabled() && !text.isEmpty() &&
      !text.endsWith(QStringLiteral("…")) && !text.startsWith("Locate"))
    {
      texts << text;
    }
  }
  if (!texts.isEmpty())
  {
    const QString text = texts[this->pick(texts.size())];
    this->note("push", text);
    this->user_.push_button(text);
  }
}

void Monkey::perform_random_action()
{
  const Document* document = this->window_->document();
  switch (this->pick(28))
  {
    case 0:
    case 1:
    case 2:
    case 3:
    case 4:
    case 5:
      this->drag();
      break;
    case 6:
    case 7:
    {
      const QPoint position = this->random_position();
      this->note("click", QString("%1 %2").arg(position.x()).arg(position.y()));
      const Qt::MouseButton button = this->random_button();
      this->user_.move(position);
      this->user_.press(position, button, this->random_modifiers());
      this->user_.release(position, button);
      break;
    }
    case 8:
    {
      const QPoint position = this->random_position();
      this->note("double click", QString("%1 %2").arg(position.x()).arg(position.y()));
      this->user_.double_click(position, Qt::LeftButton);
      break;
    }
    case 9:
      this->note("wheel", QString());
      this->user_.wheel(this->random_position(), this->number(-3.0, 3.0));
      break;
    case 10:
    case 11:
      this->note("release", QString());
      for (const Qt::MouseButton button : { Qt::LeftButton, Qt::RightButton, Qt::MiddleButton })
      {
        if (this->user_.buttons() & button)
        {
          this->user_.release(this->random_position(), button);
        }
      }
      break;
    case 12:
    case 13:
    case 14:
      this->press_random_key();
      break;
    case 15:
    case 16:
      this->trigger_random_action();
      break;
    case 17:
    case 18:
    case 19:
      this->choose_random_option();
      break;
    case 20:
      this->note("panel", QString());
      this->user_.show_panel(app::tour::SimulatedUser::panel_names()[this->pick(
        app::tour::SimulatedUser::panel_names().size())]);
      break;
    case 21:
      this->click_random_button();
      break;
    case 22:
      this->note("bind", QString());
      this->pick(3) == 0 ? this->window_->findChild<app::weights::Binding*>()->cancel()
                         : this->window_->findChild<app::weights::Binding*>()->start();
      break;
    case 23:
      for (int steps = this->pick(6); steps >= 0; --steps)
      {
        this->note("undo, redo", QString());
        this->user_.trigger(this->pick(3) == 0 ? "edit.redo" : "edit.undo");
      }
      break;
    case 24:
    {
      // Keep the window small, because software rendering is slow.
      const QSize size(640 + this->pick(300), 480 + this->pick(200));
      this->note("resize", QString("%1 x %2").arg(size.width()).arg(size.height()));
      this->window_->resize(size);
      break;
    }
    case 25:
    {
      const QString& file =
        this->files_[static_cast<std::size_t>(this->pick(static_cast<int>(this->files_.size())))];
      if (this->pick(3) == 0)
      {
        this->note("open", file);
        this->window_->open(file);
      }
      break;
    }
    case 26:
    {
      const int handles = static_cast<int>(document->handles().size());
      if (handles > 0)
      {
        const int handle = this->pick(handles);
        this->note("select, mode", QString::number(handle));
        this->window_->findChild<app::handles::SidePanel*>()->select_handle(handle);
        if (this->pick(2) == 0)
        {
          this->window_->set_mode(handle, this->pick(3));
        }
      }
      break;
    }
    default:
      this->note("scrub", QString());
      this->user_.scrub(this->number(0.0, 2.0));
  }
}

void Monkey::play(int events)
{
  QTimer watch; // the timer also runs in the event loop of a dialog
  QObject::connect(&watch, &QTimer::timeout, &watch,
    []
    {
      for (QWidget* over : { QApplication::activeModalWidget(), QApplication::activePopupWidget() })
      {
        if (over)
        {
          over->close();
        }
      }
    });
  watch.start(30);
  for (int k = 0; k < events; ++k)
  {
    this->perform_random_action();
    QApplication::processEvents();
  }
}

void Monkey::stop_activity()
{
  for (const Qt::MouseButton button : { Qt::LeftButton, Qt::RightButton, Qt::MiddleButton })
  {
    if (this->user_.buttons() & button)
    {
      this->user_.release(this->user_.pixel_of_fractions(0.5, 0.5), button);
    }
  }
  this->user_.press_key("Esc"); // Esc ends a drag that was started by a key
  this->window_->findChild<app::weights::Binding*>()->cancel();
  this->window_->findChild<app::tets::TetInspection*>()->cancel();
  this->window_->findChild<app::weights::WeightInspection*>()->cancel();
  this->window_->findChild<app::volume::WindingVolume*>()->cancel();
  this->window_->findChild<app::posing::PoseController*>()->pose_manager()->play(false);
  this->window_->findChild<app::posing::PoseController*>()->motion()->play(false);
  this->window_->findChild<app::posing::PoseController*>()->sequence_export()->cancel();
}

} // namespace bindpose::test
