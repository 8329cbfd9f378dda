#include "window_menus.h"

#include "document/document.h"
#include "help_boxes.h"
#include "key_strip.h"
#include "main_window.h"
#include "pose_panel.h"
#include "posing.h"
#include "viewport.h"
#include "volume_view.h"
#include "window_sessions.h"

#include <QAction>
#include <QActionGroup>
#include <QKeySequence>
#include <QMenu>
#include <QMenuBar>
#include <QRegularExpression>
#include <QUndoStack>

namespace
{
QString word_of(QString text)
{
  static const QRegularExpression other("[^a-z0-9]+");
  text = text.remove('&').toLower().replace(other, "_");
  return text.endsWith('_') ? text.chopped(1) : text;
}

/// Entries get object names, for tours and tests: of the menu and their text, "edit.bind".
void name_actions(const QMenuBar* bar)
{
  for (const QAction* menu : bar->actions())
  {
    for (QAction* entry : menu->menu()->actions())
    {
      if (entry->objectName().isEmpty() && !entry->isSeparator() && !entry->menu())
      {
        entry->setObjectName(word_of(menu->text()) + '.' + word_of(entry->text()));
      }
    }
  }
}
} // namespace

WindowMenus::WindowMenus(MainWindow* window) : QObject(window), window_(window)
{
  this->add_file_menu();
  this->add_edit_menu();
  this->add_view_menu();
  QMenu* help = window->menuBar()->addMenu(tr("&Help"));
  this->add(help, tr("&Mouse and keys"), QKeySequence(Qt::Key_F1),
    [window] { show_mouse_and_keys(window); });
  this->add(help, tr("&About Bindpose"), QKeySequence(), [window] { show_about(window); });
  name_actions(window->menuBar());
}

template <typename Action>
QAction* WindowMenus::add(QMenu* menu, const QString& text, const QKeySequence& keys, Action action)
{
  QAction* entry = menu->addAction(text);
  entry->setShortcut(keys);
  QObject::connect(entry, &QAction::triggered, this->window_, action);
  return entry;
}

void WindowMenus::add_file_menu()
{
  MainWindow* window = this->window_;
  QMenu* file = window->menuBar()->addMenu(tr("&File"));
  this->add(file, tr("&Open…"), QKeySequence::Open, [window] { window->choose_and_open(); });
  QMenu* recent = file->addMenu(tr("Open &recent"));
  recent->setToolTipsVisible(true);
  QObject::connect(recent, &QMenu::aboutToShow, this,
    [window, recent] { window->sessions()->fill_recent(recent); });
  file->addSeparator();
  this->save_ = this->add(
    file, tr("&Save session"), QKeySequence::Save, [window] { window->sessions()->save(); });
  this->save_as_ = this->add(file, tr("Save session &as…"),
    QKeySequence(Qt::CTRL + Qt::SHIFT + Qt::Key_S), [window] { window->sessions()->save_as(); });
  file->addSeparator();
  this->save_shape_ = this->add(
    file, tr("Save s&hape as…"), QKeySequence(), [window] { window->export_as("shape"); });
  this->save_pose_ =
    this->add(file, tr("Save &pose as…"), QKeySequence(), [window] { window->export_as("pose"); });
  this->save_picture_ = this->add(
    file, tr("Save p&icture as…"), QKeySequence(), [window] { window->export_as("picture"); });
  file->addSeparator();
  this->add(file, tr("&Quit"), QKeySequence::Quit, [window] { window->close(); });
}

void WindowMenus::add_edit_menu()
{
  MainWindow* window = this->window_;
  QMenu* edit = window->menuBar()->addMenu(tr("&Edit"));
  QAction* undo = window->history()->createUndoAction(this, tr("&Undo"));
  undo->setShortcut(QKeySequence::Undo);
  QAction* redo = window->history()->createRedoAction(this, tr("&Redo"));
  redo->setShortcuts(
    { QKeySequence(Qt::CTRL + Qt::SHIFT + Qt::Key_Z), QKeySequence(Qt::CTRL + Qt::Key_Y) });
  edit->addAction(undo);
  edit->addAction(redo);
  edit->addSeparator();
  this->bind_ =
    this->add(edit, tr("&Bind"), QKeySequence(Qt::CTRL + Qt::Key_B), [window] { window->bind(); });
  this->rest_pose_ = this->add(edit, tr("Back to &rest"), QKeySequence(Qt::CTRL + Qt::Key_R),
    [window] { window->document()->back_to_rest(); });
}

void WindowMenus::add_view_menu()
{
  MainWindow* window = this->window_;
  QMenu* view = window->menuBar()->addMenu(tr("&View"));
  this->add(view, tr("&Whole shape"), QKeySequence(Qt::Key_Home),
    [window]
    {
      window->viewport()->reset_view();
      window->viewport()->refresh();
    });
  view->addSeparator();
  this->add(view, tr("&Rest or posed"), QKeySequence(Qt::Key_R),
    [window] { window->posing()->look_at_rest(!window->posing()->looks_at_rest()); });
  this->add(view, tr("&Play or pause"), QKeySequence(Qt::Key_Space),
    [window] { window->posing()->play_keys(!window->posing()->is_playing()); });
  this->add(view, tr("&Set a key"), QKeySequence(Qt::Key_K),
    [window] { Q_EMIT window->strip()->key_wanted(); });
  view->addSeparator();
  this->methods_ = new QActionGroup(this);
  for (int k = 0; k < bindpose::pose_method_count; ++k)
  {
    QAction* method = this->add(view, method_name(static_cast<bindpose::PoseMethod>(k)),
      QKeySequence(Qt::Key_1 + k), [window, k] { window->set_method(k); });
    method->setCheckable(true);
    this->methods_->addAction(method);
  }
  this->show_method(0);
}

void WindowMenus::show_method(int method)
{
  this->methods_->actions()[method]->setChecked(true);
}

void WindowMenus::update()
{
  const Document* document = this->window_->document();
  const bool ready = document->surface() && document->handle_data();
  this->save_->setEnabled(!this->window_->is_empty());
  this->save_as_->setEnabled(!this->window_->is_empty());
  this->save_shape_->setEnabled(document->surface());
  this->save_picture_->setEnabled(!this->window_->is_empty());
  this->save_pose_->setEnabled(document->handle_data());
  this->bind_->setEnabled(ready && !this->window_->is_binding());
  this->rest_pose_->setEnabled(document->is_bound());
  this->methods_->setEnabled(ready);
}
