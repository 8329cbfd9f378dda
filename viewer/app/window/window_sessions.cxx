#include "app/window/window_sessions.h"

#include "app/parts/error_bar.h"
#include "app/parts/notice_bar.h"
#include "app/view/viewport.h"
#include "app/weights/binding.h"
#include "app/window/option_links.h"
#include "app/window/panel_column.h"
#include "document/document.h"
#include "document/recent_files.h"

#include "vtkCamera.h"
#include "vtkRenderer.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLocale>
#include <QMenu>
#include <QMessageBox>

#include <algorithm>

namespace app::window
{

using namespace bindpose;

WindowSessions::WindowSessions(const SessionParts& parts)
  : QObject(parts.window), parts_(parts), autosave_(
                                            [this]
                                            {
                                              Session session = this->session();
                                              session.saved_as = this->path_;
                                              return session;
                                            })
{
  QObject::connect(parts.document, &Document::changed, &this->autosave_, &Autosave::schedule_save);
  QObject::connect(&this->autosave_, &Autosave::failed, parts.errors,
    [errors = parts.errors](const QString& message)
    { errors->show_message(message, parts::ErrorKind::save_session); });
}

WindowSessions::~WindowSessions() = default;

// ---- Contents of a session ---------------------------------------------------------------------

Session WindowSessions::session() const
{
  this->parts_.links->store_all();
  Session session;
  session.work = this->parts_.document->work();
  session.view.panel = this->parts_.panels->shown_panel();
  vtkCamera* camera = this->parts_.viewport->renderer()->GetActiveCamera();
  SessionView::Camera& stored_camera = session.view.camera.emplace();
  std::copy_n(camera->GetPosition(), 3, stored_camera.position.begin());
  std::copy_n(camera->GetFocalPoint(), 3, stored_camera.focal_point.begin());
  std::copy_n(camera->GetViewUp(), 3, stored_camera.up.begin());
  stored_camera.angle = camera->GetViewAngle();
  stored_camera.scale = camera->GetParallelScale();
  stored_camera.parallel = camera->GetParallelProjection() != 0;
  return session;
}

void WindowSessions::show(const Session& session)
{
  this->parts_.binding->cancel();
  this->parts_.document->replace(session.work);
  this->parts_.panels->show_panel(session.view.panel);
  if (session.view.camera)
  {
    const SessionView::Camera& stored_camera = *session.view.camera;
    vtkRenderer* renderer = this->parts_.viewport->renderer();
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->SetPosition(stored_camera.position.data());
    camera->SetFocalPoint(stored_camera.focal_point.data());
    camera->SetViewUp(stored_camera.up.data());
    camera->SetViewAngle(stored_camera.angle);
    camera->SetParallelScale(stored_camera.scale);
    if (!stored_camera.parallel)
    {
      Q_EMIT this->perspective_requested();
    }
    camera->SetParallelProjection(stored_camera.parallel);
    renderer->ResetCameraClippingRange();
  }
  this->show_notes(session);
  this->parts_.viewport->refresh();
}

/// Show the messages of a session, with a button to locate a missing file.
void WindowSessions::show_notes(const Session& session)
{
  this->parts_.missing->hide();
  if (session.notes.isEmpty())
  {
    return;
  }
  QList<parts::NoticeBar::Choice> choices;
  if (!session.missing_inputs.empty())
  {
    const QString path = session.missing_inputs.front().path;
    choices << parts::NoticeBar::Choice{ tr("Locate…"),
      [this, path]
      {
        const QString found = QFileDialog::getOpenFileName(this->parts_.window,
          tr("Locate %1").arg(QFileInfo(path).fileName()), QFileInfo(path).absolutePath());
        if (!found.isEmpty())
        {
          Q_EMIT this->open_requested(found);
        }
      } };
  }
  this->parts_.missing->offer(session.notes.join(' '), choices, tr("Close"));
}

QString WindowSessions::name() const
{
  const Work& work = this->parts_.document->work();
  return !this->path_.isEmpty() ? QFileInfo(this->path_).completeBaseName()
    : work.surface              ? work.name
    : work.volume               ? work.volume_name
                                : QString();
}

// ---- Files -------------------------------------------------------------------------------------

bool WindowSessions::open(const QString& path)
{
  Session session;
  const Status status = read_session(path, session);
  if (!status.ok())
  {
    this->parts_.errors->show_message(QString::fromStdString(status.message));
    return false;
  }
  if (!this->confirm_close())
  {
    return false;
  }
  this->path_ = QFileInfo(path).absoluteFilePath();
  this->show(session);
  return true;
}

bool WindowSessions::write(const QString& path)
{
  const QString absolute = QFileInfo(path).absoluteFilePath();
  const Status status = this->file_.write(absolute, this->session());
  if (!status.ok())
  {
    this->parts_.errors->show_message(
      tr("Cannot save the session: %1.").arg(QString::fromStdString(status.message)),
      parts::ErrorKind::save_session);
    return false;
  }
  this->path_ = absolute;
  this->parts_.errors->succeeded(parts::ErrorKind::save_session);
  this->parts_.document->set_saved();
  Q_EMIT this->changed();
  RecentFiles::add(absolute);
  return true;
}

bool WindowSessions::save()
{
  return this->path_.isEmpty() ? this->save_as() : this->write(this->path_);
}

bool WindowSessions::save_as()
{
  QFileDialog dialog(this->parts_.window, tr("Save the session"),
    QFileInfo(this->path_).absolutePath(), tr("Sessions (*.%1)").arg(session_extension));
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setDefaultSuffix(session_extension);
  const QString name = this->name();
  dialog.selectFile(
    (name.isEmpty() ? tr("work") : QFileInfo(name).completeBaseName()) + '.' + session_extension);
  return dialog.exec() == QDialog::Accepted && this->write(dialog.selectedFiles().front());
}

bool WindowSessions::confirm_close()
{
  if (!this->parts_.document->is_changed(!this->path_.isEmpty()))
  {
    return true;
  }
  QMessageBox question(QMessageBox::Question, "Bindpose",
    tr("Save the changes to %1?").arg(this->name().isEmpty() ? tr("the work") : this->name()),
    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, this->parts_.window);
  question.setInformativeText(tr("Unsaved changes will be lost."));
  question.setDefaultButton(QMessageBox::Save);
  switch (question.exec())
  {
    case QMessageBox::Save:
      return this->save();
    case QMessageBox::Discard:
      return true;
    default:
      return false;
  }
}

void WindowSessions::fill_recent(QMenu* menu)
{
  menu->clear();
  const QStringList paths = RecentFiles::list();
  for (const QString& path : paths)
  {
    const QFileInfo file(path);
    QString folder = file.absolutePath();
    const QString home = QDir::homePath();
    if (folder == home || folder.startsWith(home + '/'))
    {
      folder.replace(0, home.size(), "~");
    }
    const QFontMetrics metrics = menu->fontMetrics();
    constexpr int name_width = 260;
    constexpr int folder_width = 320;
    QAction* entry = menu->addAction(
      QString("%1\t%2")
        .arg(metrics.elidedText(file.fileName(), Qt::ElideMiddle, name_width),
          file.exists() ? metrics.elidedText(folder, Qt::ElideMiddle, folder_width) : tr("missing"))
        .replace('&', "&&"));
    entry->setData(path);
    entry->setToolTip(path);
    entry->setEnabled(file.exists());
    QObject::connect(
      entry, &QAction::triggered, this, [this, path] { Q_EMIT this->open_requested(path); });
  }
  if (paths.isEmpty())
  {
    menu->addAction(tr("No recent files"))->setEnabled(false);
    return;
  }
  menu->addSeparator();
  QObject::connect(
    menu->addAction(tr("Clear the list")), &QAction::triggered, this, &RecentFiles::clear);
}

// ---- After a crash -----------------------------------------------------------------------------

void WindowSessions::offer_recovery(const QString& root)
{
  this->recovered_ = RecoveredWork::find(root.isEmpty() ? Autosave::default_root() : root);
  if (!this->recovered_)
  {
    return;
  }
  const QString save_time = QLocale().toString(this->recovered_->time(), QLocale::ShortFormat);
  const auto discard = [this, root]
  {
    this->recovered_->remove();
    this->offer_recovery(root); // offer the work of another crashed process, if there is any
  };
  this->parts_.recovery->offer(
    tr("Bindpose did not close properly. The work from %1 can be restored.").arg(save_time),
    { { tr("&Restore"), [this] { this->recover(); } }, { tr("Discard"), discard } }, tr("Later"));
}

void WindowSessions::recover()
{
  Session session;
  const Status status = read_session(this->recovered_->path(), session);
  if (!status.ok())
  {
    this->parts_.errors->show_message(QString::fromStdString(status.message));
    return;
  }
  if (!this->confirm_close())
  {
    this->offer_recovery(
      QFileInfo(QFileInfo(this->recovered_->path()).absolutePath()).absolutePath());
    return;
  }
  this->path_ = session.saved_as;
  this->show(session);
  this->parts_.document->set_unsaved();
  Q_EMIT this->changed();
  if (this->autosave_.save().ok())
  {
    this->recovered_->remove(); // the folder of this process now contains the recovered work
  }
  this->recovered_.reset();
}

} // namespace app::window
