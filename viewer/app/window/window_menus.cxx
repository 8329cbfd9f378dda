#include "app/window/window_menus.h"

#include "app/handles/handle_editing.h"
#include "app/handles/handle_tree.h"
#include "app/handles/shape_handles.h"
#include "app/parts/style.h"
#include "app/parts/window_keys.h"
#include "app/posing/key_strip.h"
#include "app/posing/pose_panel.h"
#include "app/posing/posing.h"
#include "app/view/viewport.h"
#include "app/volume/volume_view.h"
#include "app/weights/binding.h"
#include "app/window/exports.h"
#include "app/window/help_boxes.h"
#include "app/window/panel_column.h"
#include "app/window/shortcut_sheet.h"
#include "app/window/window_sessions.h"
#include "document/document.h"

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QKeySequence>
#include <QLineEdit>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QRegularExpression>
#include <QUndoStack>

namespace app::window
{

namespace
{
QList<QKeySequence> shortcuts(const char* name)
{
  QList<QKeySequence> result;
  for (const QString& keys :
    QString::fromStdString(parts::keys_of(name)).split(", ", Qt::SkipEmptyParts))
  {
    result << QKeySequence(keys);
  }
  return result;
}

QString to_identifier(QString text)
{
  static const QRegularExpression other("[^a-z0-9]+");
  text = text.remove('&').toLower().replace(other, "_");
  return text.endsWith('_') ? text.chopped(1) : text;
}

/// Set object names of the menu entries, for tours and tests. A name is made from the texts of the
/// menus and of the entry, for example "edit.bind" or "view.appearance.dark".
void name_actions(const QList<QAction*>& entries, const QString& menu)
{
  for (QAction* entry : entries)
  {
    const QString name =
      menu.isEmpty() ? to_identifier(entry->text()) : menu + '.' + to_identifier(entry->text());
    if (entry->menu())
    {
      name_actions(entry->menu()->actions(), name);
    }
    else if (entry->objectName().isEmpty() && !entry->isSeparator())
    {
      entry->setObjectName(name);
    }
  }
}
} // namespace

WindowMenus::WindowMenus(const MenuParts& parts) : QObject(parts.window), parts_(parts)
{
  QMainWindow* window = parts.window;
  this->add_file_menu();
  this->add_edit_menu();
  QMenu* handles = window->menuBar()->addMenu(tr("H&andles"));
  parts.editing->fill_menu(handles);
  handles->addSeparator();
  parts.shape_handles->fill_menu(handles);
  this->add_view_menu();
  QMenu* help = window->menuBar()->addMenu(tr("&Help"));
  this->add(help, tr("&Mouse and keys"), "keys", [window] { (new ShortcutSheet(window))->show(); });
  this->add(help, tr("&About Bindpose"), "", [window] { show_about(window); });
  name_actions(window->menuBar()->actions(), QString());
}

template <typename Action>
QAction* WindowMenus::add(QMenu* menu, const QString& text, const char* name, Action action)
{
  QAction* entry = menu->addAction(text);
  entry->setShortcuts(shortcuts(name));
  QObject::connect(entry, &QAction::triggered, this, action);
  return entry;
}

void WindowMenus::add_file_menu()
{
  QMenu* file = this->parts_.window->menuBar()->addMenu(tr("&File"));
  this->add(file, tr("&Open…"), "open", [this] { Q_EMIT this->open_requested(); });
  QMenu* recent = file->addMenu(tr("Open &recent"));
  recent->setToolTipsVisible(true);
  QObject::connect(recent, &QMenu::aboutToShow, this,
    [this, recent] { this->parts_.sessions->fill_recent(recent); });
  file->addSeparator();
  this->save_ =
    this->add(file, tr("&Save session"), "save", [this] { this->parts_.sessions->save(); });
  this->save_as_ = this->add(
    file, tr("Save session &as…"), "save_as", [this] { this->parts_.sessions->save_as(); });
  file->addSeparator();
  Exports* exports = this->parts_.exports;
  this->export_shape_ =
    this->add(file, tr("Export s&hape…"), "", [exports] { exports->ask_for_shape(); });
  this->export_rig_ =
    this->add(file, tr("Export ri&g (.glb)…"), "", [exports] { exports->ask_for_rig(); });
  this->export_pose_ =
    this->add(file, tr("Export &pose…"), "", [exports] { exports->ask_for_pose(); });
  this->add(file, tr("Export p&icture…"), "", [exports] { exports->ask_for_picture(); });
  this->export_film_ =
    this->add(file, tr("Export &film…"), "", [exports] { exports->ask_for_film(); });
  file->addSeparator();
  this->add(file, tr("&Quit"), "quit", [this] { this->parts_.window->close(); });
}

void WindowMenus::add_edit_menu()
{
  QMenu* edit = this->parts_.window->menuBar()->addMenu(tr("&Edit"));
  QAction* undo = this->parts_.document->history()->createUndoAction(this, tr("&Undo"));
  undo->setShortcuts(shortcuts("undo"));
  QAction* redo = this->parts_.document->history()->createRedoAction(this, tr("&Redo"));
  redo->setShortcuts(shortcuts("redo"));
  edit->addAction(undo);
  edit->addAction(redo);
  edit->addSeparator();
  this->bind_ = this->add(edit, tr("&Bind"), "bind", [this] { this->parts_.binding->start(); });
  this->rest_pose_ = this->add(
    edit, tr("Back to &rest"), "rest_pose", [this] { this->parts_.document->reset_to_rest(); });
  edit->addSeparator();
  this->find_ = this->add(edit, tr("&Find a handle"), "find",
    [this]
    {
      this->parts_.panels->show_panel(PanelColumn::bind_and_pose);
      this->parts_.panels->handles()->search()->setFocus(Qt::ShortcutFocusReason);
    });
}

void WindowMenus::add_view_menu()
{
  QMenu* view = this->parts_.window->menuBar()->addMenu(tr("&View"));
  this->add(view, tr("&Whole shape"), "whole_shape",
    [this]
    {
      this->parts_.viewport->reset_view();
      this->parts_.viewport->refresh();
    });
  this->flat_view_ = this->add(view, tr("&2D view"), "",
    [this]
    {
      Q_EMIT this->flat_view_requested(!this->parts_.viewport->is_flat());
      this->parts_.viewport->reset_view();
      this->parts_.viewport->refresh();
    });
  this->flat_view_->setCheckable(true);
  this->outlines_ = this->add(view, tr("&Outlines"), "",
    [this] { Q_EMIT this->outlines_requested(!this->parts_.viewport->has_outlines()); });
  this->outlines_->setCheckable(true);
  this->outlines_->setToolTip(
    tr("Dark lines along the silhouette and the open edges of the shape"));
  this->look_ = this->add(view, tr("M&aterials and textures"), "",
    [this] { Q_EMIT this->look_requested(!this->parts_.viewport->shows_look()); });
  this->look_->setCheckable(true);
  this->look_->setToolTip(tr("Materials, textures and vertex colors of the mesh's file"));
  this->timeline_ = this->add(view, tr("Ti&meline"), "",
    [this] { Q_EMIT this->timeline_requested(this->timeline_->isChecked()); });
  this->timeline_->setCheckable(true);
  view->addSeparator();
  this->add(view, tr("&Rest shape or pose"), "look_at_rest",
    [this] { this->parts_.posing->set_rest_view(!this->parts_.posing->is_rest_view()); });
  this->add(view, tr("&Play or pause"), "play",
    [this] {
      this->parts_.posing->pose_manager()->play(!this->parts_.posing->pose_manager()->is_playing());
    });
  this->add(
    view, tr("&Set a key"), "set_key", [this] { Q_EMIT this->parts_.strip->set_key_requested(); });
  view->addSeparator();
  this->methods_ = new QActionGroup(this);
  int key = Qt::Key_1;
  for (const bindpose::PoseMethod each : posing::pose_methods_in_order())
  {
    const auto number = static_cast<int>(each);
    QAction* method = this->add(view, posing::method_name(each), "",
      [this, number] { Q_EMIT this->method_requested(number); });
    method->setData(number);
    method->setShortcut(QKeySequence(key++));
    method->setCheckable(true);
    this->methods_->addAction(method);
  }
  this->show_method(0);
  view->addSeparator();
  QMenu* appearance = view->addMenu(tr("&Appearance"));
  auto* appearance_group = new QActionGroup(this);
  for (const auto& [text, look] :
    { std::pair(tr("Same as the &desktop"), parts::Appearance::system),
      std::pair(tr("&Light"), parts::Appearance::light),
      std::pair(tr("D&ark"), parts::Appearance::dark) })
  {
    QAction* entry =
      this->add(appearance, text, "", [look = look] { parts::choose_appearance(*qApp, look); });
    entry->setCheckable(true);
    entry->setChecked(look == parts::chosen_appearance());
    appearance_group->addAction(entry);
  }
}

void WindowMenus::show_method(int method)
{
  for (QAction* action : this->methods_->actions())
  {
    if (action->data().toInt() == method)
    {
      action->setChecked(true);
    }
  }
}

void WindowMenus::update(const State& state)
{
  const Document* document = this->parts_.document;
  const bool ready = document->surface() && document->handle_data();
  this->save_->setEnabled(!state.is_empty);
  this->save_as_->setEnabled(!state.is_empty);
  this->export_shape_->setEnabled(document->surface());
  this->export_rig_->setEnabled(this->parts_.posing->has_weights());
  this->export_pose_->setEnabled(document->handle_data());
  this->find_->setEnabled(document->handle_data());
  this->export_film_->setEnabled(ready);
  this->bind_->setEnabled(ready && !this->parts_.binding->is_running());
  this->rest_pose_->setEnabled(document->is_bound());
  this->methods_->setEnabled(ready);
  this->flat_view_->setEnabled(state.is_planar && !document->work().volume);
  this->flat_view_->setChecked(this->parts_.viewport->is_flat());
  this->outlines_->setChecked(this->parts_.viewport->has_outlines());
  this->look_->setEnabled(document->work().look != nullptr);
  this->look_->setChecked(this->parts_.viewport->shows_look());
  this->timeline_->setEnabled(document->surface());
  this->timeline_->setChecked(state.shows_timeline);
  this->parts_.shape_handles->update();
}

} // namespace app::window
