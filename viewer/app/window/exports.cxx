#include "app/window/exports.h"

#include "app/parts/error_bar.h"
#include "app/parts/notice_bar.h"
#include "app/parts/panel_parts.h"
#include "app/posing/pose_panel.h"
#include "app/posing/posing.h"
#include "app/posing/sequence_export.h"
#include "app/view/viewport.h"
#include "app/window/picture_dialog.h"
#include "app/window/window_sessions.h"
#include "document/document.h"
#include "document/opened_file.h"

#include "pictures/picture.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkGLTFSkinWriter.h"
#include "vtkImageData.h"
#include "vtkNew.h"

#include <QApplication>
#include <QDesktopServices>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QUrl>

namespace app::window
{

using namespace bindpose;

namespace
{
/// Return a path that is short enough for one line of a bar.
QString short_path(const QString& path)
{
  constexpr int maximum_length = 70;
  return parts::shortened(QDir::toNativeSeparators(path), maximum_length);
}

Status write_rig(vtkPolyData* surface, vtkPolyData* handles, const QString& path)
{
  vtkNew<vtkGLTFSkinWriter> writer;
  // Add observers, so that VTK does not print errors and warnings. The writer's status contains
  // these messages.
  vtkNew<vtkCallbackCommand> silent_observer;
  silent_observer->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  writer->AddObserver(vtkCommand::ErrorEvent, silent_observer);
  writer->AddObserver(vtkCommand::WarningEvent, silent_observer);
  writer->SetInputData(0, surface);
  writer->SetHandlesData(handles);
  writer->SetFileName(path.toStdString().c_str());
  writer->OverwriteOn();
  return writer->Write() == 1 ? Status() : Status::invalid_input(writer->GetStatusMessage());
}
} // namespace

Exports::Exports(const ExportParts& parts) : QObject(parts.window), parts_(parts)
{
  posing::SequenceExport* film = parts.posing->sequence_export();
  QObject::connect(film, &posing::SequenceExport::progress, this, &Exports::show_progress);
  QObject::connect(film, &posing::SequenceExport::finished, this, &Exports::film_finished);
  QObject::connect(parts.bar, &parts::NoticeBar::closed, film, &posing::SequenceExport::cancel);
}

// ---- Ask for a path ----------------------------------------------------------------------------

/// Show a file dialog and return the chosen path; empty if the user cancels.
QString Exports::ask(const QString& title, const QString& filter, const QString& extension)
{
  QFileDialog dialog(this->parts_.window, title, this->folder_, filter);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setDefaultSuffix(extension);
  const QString name = QFileInfo(this->parts_.sessions->name()).completeBaseName();
  dialog.selectFile((name.isEmpty() ? tr("export") : name) + '.' + extension);
  return dialog.exec() == QDialog::Accepted ? dialog.selectedFiles().front() : QString();
}

void Exports::ask_for_shape()
{
  const QString path =
    this->ask(tr("Export the shape"), tr("Shapes (*.vtp *.ply *.obj *.off *.stl)"), "ply");
  if (!path.isEmpty())
  {
    this->save_shape(path);
  }
}

void Exports::ask_for_rig()
{
  const QString path = this->ask(tr("Export the rig"), tr("glTF 2.0 (*.glb *.gltf)"), "glb");
  if (!path.isEmpty())
  {
    this->save_rig(path);
  }
}

void Exports::ask_for_pose()
{
  const QString path = this->ask(tr("Export the pose"), tr("Poses (*.json)"), "json");
  if (!path.isEmpty())
  {
    this->save_pose(path);
  }
}

void Exports::ask_for_picture()
{
  PictureDialog picture(this->parts_.viewport, this->parts_.window);
  if (picture.exec() != QDialog::Accepted)
  {
    return;
  }
  const QString path = this->ask(tr("Export the picture"), tr("Pictures (*.png)"), "png");
  if (!path.isEmpty())
  {
    this->save_picture(path, picture.scale(), picture.is_transparent());
  }
}

void Exports::ask_for_film()
{
  if (!this->parts_.posing->has_animation())
  {
    this->parts_.bar->offer(
      tr("A film requires key frames: pose the shape and set a key (K), move to "
         "another time, pose it again and set another key."),
      { { tr("Show the timeline"), [this] { Q_EMIT this->timeline_requested(); } } }, tr("Close"));
    return;
  }
  const QString path = this->ask(
    tr("Export the film"), tr("Animations (%1)").arg(posing::SequenceExport::patterns()), "gif");
  if (!path.isEmpty())
  {
    this->parts_.posing->export_to(path);
  }
}

// ---- Write -------------------------------------------------------------------------------------

bool Exports::save_shape(const QString& path)
{
  return this->finish(path, write_shape(this->parts_.posing->shape(), path.toStdString()));
}

bool Exports::save_rig(const QString& path)
{
  const Document* document = this->parts_.document;
  QApplication::setOverrideCursor(Qt::WaitCursor); // writing a large mesh takes seconds
  const Status status = write_rig(document->surface(), document->handle_data(), path);
  QApplication::restoreOverrideCursor();
  const auto method = static_cast<PoseMethod>(document->number("pose.method"));
  const bool other = method != PoseMethod::linear_blend && this->parts_.posing->is_posed();
  return this->finish(path, status,
    other ? tr("Other programs pose the rig by linear blend skinning, not by %1.")
              .arg(posing::method_name(method))
          : QString());
}

bool Exports::save_pose(const QString& path)
{
  const Document* document = this->parts_.document;
  return this->finish(
    path, write_poses({ document->pose() }, document->handles(), path.toStdString()));
}

bool Exports::save_picture(const QString& path, int scale, bool transparent)
{
  QApplication::setOverrideCursor(Qt::WaitCursor); // rendering a large image takes seconds
  vtkSmartPointer<vtkImageData> picture;
  Status status = this->parts_.viewport->take_picture(scale, transparent, picture);
  if (status.ok())
  {
    status = write_png(picture, path.toStdString(), true);
  }
  QApplication::restoreOverrideCursor();
  return this->finish(path, status);
}

void Exports::show_progress(double fraction)
{
  if (!this->is_showing_progress_)
  {
    this->is_showing_progress_ = true;
    this->parts_.bar->offer(QString(), {}, tr("Stop"));
  }
  this->parts_.bar->set_message(
    tr("Writing %1 … %2 %")
      .arg(QFileInfo(this->parts_.posing->sequence_export()->path()).fileName())
      .arg(static_cast<int>(100.0 * fraction)));
}

void Exports::film_finished()
{
  const posing::SequenceExport* film = this->parts_.posing->sequence_export();
  this->is_showing_progress_ = false;
  this->parts_.bar->hide();
  if (!film->error().isEmpty())
  {
    this->parts_.errors->show_message(
      tr("Cannot export: %1.").arg(film->error()), parts::ErrorKind::export_file);
  }
  else if (!film->summary().isEmpty()) // the description is empty after a cancel
  {
    this->show_result(film->path(), parts::capitalized(film->summary()) + '.');
  }
}

// ---- Results -----------------------------------------------------------------------------------

bool Exports::finish(const QString& path, const Status& status, const QString& remark)
{
  if (!status.ok())
  {
    this->parts_.errors->show_message(
      tr("Cannot export: %1.").arg(QString::fromStdString(status.message)),
      parts::ErrorKind::export_file);
    return false;
  }
  // The warnings name data that the file cannot represent.
  this->show_result(path,
    status.warnings.empty()
      ? remark
      : parts::capitalized(QString::fromStdString(status.warnings.front())) + '.');
  return true;
}

void Exports::show_result(const QString& path, const QString& remark)
{
  const QString absolute = QFileInfo(path).absoluteFilePath();
  this->folder_ = QFileInfo(absolute).absolutePath();
  this->parts_.errors->succeeded(parts::ErrorKind::export_file);
  this->parts_.bar->offer(QString(),
    { { tr("Show in folder"), [this, absolute] { this->show_in_folder(absolute); } } },
    tr("Close"));
  const QString written = tr("Wrote %1.").arg(short_path(absolute));
  this->parts_.bar->set_message(
    remark.isEmpty() ? written : written + ' ' + remark, QDir::toNativeSeparators(absolute));
}

void Exports::show_in_folder(const QString& path)
{
  const QString folder = QFileInfo(path).absolutePath();
  if (!QDesktopServices::openUrl(QUrl::fromLocalFile(folder)))
  {
    this->parts_.errors->show_message(
      tr("Cannot open the folder %1: no suitable program was found.")
        .arg(QDir::toNativeSeparators(folder)),
      parts::ErrorKind::export_file);
  }
}

} // namespace app::window
