#include "app/posing/sequence_export.h"

#include "app/view/viewport.h"

#include "document/opened_file.h"
#include "file_kind.h"
#include "helper/scratch_folder.h"
#include "io/atomic_file.h"
#include "pictures/sequence_file.h"
#include "pictures/video_file.h"

#include "conversion.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkGLTFSkinWriter.h"
#include "vtkHandleSetWidget.h"
#include "vtkMeshFileWriter.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRenderWindow.h"

#include <QApplication>
#include <QImage>
#include <QPainter>

#include <deque>
#include <memory>

namespace app::posing
{

using namespace bindpose;

namespace
{
constexpr const char* mesh_extensions = "vtp ply obj off stl";
constexpr const char* rig_extensions = "glb gltf";
constexpr std::size_t maximum_tiles = 12;
constexpr int tile_width = 400; // width in pixels of each frame in a strip of frames

Status cannot_write(const std::string& path)
{
  return Status::invalid_input(path + " cannot be written");
}
} // namespace

SequenceExport::SequenceExport(view::Viewport* viewport) : QObject(viewport), viewport_(viewport)
{
  QObject::connect(&this->job_, &parts::KernelJob::progress, this,
    [this](double fraction) { Q_EMIT this->progress(0.7 * fraction); });
  QObject::connect(&this->job_, &parts::KernelJob::finished, this, &SequenceExport::frames_made);
  QObject::connect(&this->encoder_, &parts::KernelJob::progress, this,
    [this](double fraction) { Q_EMIT this->progress(0.9 + 0.1 * fraction); });
  QObject::connect(&this->encoder_, &parts::KernelJob::finished, this,
    [this] { this->end(this->encoder_.status()); });
}

SequenceExport::~SequenceExport() = default;

QString SequenceExport::patterns()
{
  QString extensions =
    QString("json %1 %2 png %3").arg(mesh_extensions).arg(rig_extensions).arg(video_extensions);
  return "*." + extensions.replace(' ', " *.");
}

void SequenceExport::cancel()
{
  this->job_.cancel();
  this->encoder_.cancel();
}

void SequenceExport::start(const Input& input, const QString& path)
{
  if (this->is_running())
  {
    return;
  }
  this->input_ = input;
  this->path_ = path;
  this->error_.clear();
  this->summary_.clear();
  this->frames_ = std::make_shared<PosedFrames>();
  this->frames_->frames_per_second = input.frames_per_second;
  const std::string extension = file_extension(path.toStdString());
  Status known = check_extension(path.toStdString(),
    std::string("json png ") + mesh_extensions + " " + rig_extensions + " " + video_extensions);
  if (known.ok() && is_listed(extension, video_extensions))
  {
    known = check_ffmpeg(); // check before the frames are computed
  }
  if (known.ok() && extension == "json" && input.run.start)
  {
    known = Status::invalid_input(
      "a motion cannot be exported as a pose file (.json): choose datasets, glTF or pictures");
  }
  if (!known.ok())
  {
    this->error_ = QString::fromStdString(known.message);
    Q_EMIT this->finished();
    return;
  }
  const bool poses_only = extension == "json";
  Q_EMIT this->progress(0.0);
  this->job_.start(
    [frames = this->frames_, input, poses_only](ExecutionContext& context)
    {
      return poses_only   ? Status()
        : input.run.start ? make_frames(context, input.source, input.options, input.run, *frames)
                          : make_frames(context, input.source, input.options, input.poses, *frames);
    });
}

void SequenceExport::frames_made()
{
  Status status = this->job_.status();
  if (status.usable())
  {
    status = this->write();
    Q_EMIT this->rendering_finished();
  }
  if (!this->encoder_.is_running())
  {
    this->end(status);
  }
}

void SequenceExport::end(const Status& status)
{
  if (!status.usable() && status.code != StatusCode::canceled)
  {
    this->error_ = QString::fromStdString(status.message);
  }
  else if (status.code != StatusCode::canceled)
  {
    this->summary_ = tr("%1 frames")
                       .arg(this->frames_->points.empty() ? this->input_.poses.size()
                                                          : this->frames_->points.size());
  }
  this->frames_.reset();
  this->input_ = Input();
  Q_EMIT this->finished();
}

Status SequenceExport::write()
{
  const std::string path = this->path_.toStdString();
  const std::string extension = file_extension(path);
  if (extension == "json")
  {
    return write_poses(
      this->input_.poses, this->input_.source->handles, path, this->input_.frames_per_second);
  }
  return is_listed(extension, rig_extensions) ? this->write_rig(path)
    : is_listed(extension, mesh_extensions)   ? this->write_datasets(path)
    : extension == "png"                      ? this->write_contact_sheet(path)
                                              : this->begin_video(path);
}

vtkSmartPointer<vtkPolyData> SequenceExport::posed_surface(std::size_t frame) const
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->ShallowCopy(this->input_.surface);
  vtkNew<vtkFieldData> own_fields;
  own_fields->ShallowCopy(this->input_.surface->GetFieldData());
  result->SetFieldData(own_fields);
  result->SetPoints(to_vtk_points(this->frames_->points[frame]));
  result->GetPointData()->SetNormals(nullptr); // remove the normals of the rest shape
  if (frame < this->frames_->transforms.size())
  {
    vtkNew<vtkDoubleArray> transforms;
    transforms->SetName("HandleTransforms");
    transforms->SetNumberOfComponents(12);
    for (const Affine& transform : this->frames_->transforms[frame])
    {
      transforms->InsertNextTuple(transform.data());
    }
    own_fields->AddArray(transforms);
  }
  return result;
}

Status SequenceExport::write_datasets(const std::string& path)
{
  const std::size_t count = this->frames_->points.size();
  std::deque<AtomicFile> files(count);
  std::vector<std::string> names;
  for (std::size_t k = 0; k < count; ++k)
  {
    names.push_back(numbered_file(path, static_cast<int>(k)));
    Status status = files[k].open(names[k], true);
    if (status.ok())
    {
      status = write_shape(this->posed_surface(k), files[k].temporary());
    }
    if (!status.ok())
    {
      return status;
    }
    Q_EMIT this->progress(0.7 + 0.3 * static_cast<double>(k) / static_cast<double>(count));
  }
  // Replace existing files only after all new files are complete.
  for (AtomicFile& file : files)
  {
    const Status status = file.commit();
    if (!status.ok())
    {
      return status;
    }
  }
  return write_file_atomically(
    collection_file(path), format_collection(names, this->frames_->frames_per_second), true);
}

Status SequenceExport::write_rig(const std::string& path)
{
  vtkNew<vtkGLTFSkinWriter> writer;
  // Add observers, so that VTK does not print errors and warnings. The writer's status contains
  // these messages.
  vtkNew<vtkCallbackCommand> silent_observer;
  silent_observer->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  writer->AddObserver(vtkCommand::ErrorEvent, silent_observer);
  writer->AddObserver(vtkCommand::WarningEvent, silent_observer);
  const bool joints = !this->frames_->transforms.empty() && this->input_.source->has_weights();
  writer->SetInputData(0, this->input_.surface);
  if (this->input_.source->has_weights())
  {
    writer->SetHandlesData(this->input_.handles);
  }
  for (std::size_t k = 0; k < this->frames_->points.size(); ++k)
  {
    writer->AddFrameData(this->posed_surface(k));
  }
  writer->SetFramesPerSecond(this->frames_->frames_per_second);
  writer->SetAnimation(joints ? vtkGLTFSkinWriter::JOINTS : vtkGLTFSkinWriter::MORPH);
  writer->SetFileName(path.c_str());
  writer->OverwriteOn();
  return writer->Write() == 1 ? Status() : Status::invalid_input(writer->GetStatusMessage());
}

QImage SequenceExport::picture(std::size_t frame)
{
  this->viewport_->move_surface(PointsView(this->frames_->points[frame]));
  this->viewport_->renderWindow()->Render();
  return this->viewport_->grabFramebuffer();
}

/// Write an image file of up to twelve evenly spaced frames, four per row.
Status SequenceExport::write_contact_sheet(const std::string& path)
{
  vtkHandleSetWidget* handles = this->viewport_->handle_widget();
  const bool shown = handles->GetEnabled();
  // hide the handles, because their pose is not the pose of the frame
  handles->SetEnabled(false);
  QImage contact_sheet;
  const std::vector<std::size_t> frame_indices =
    evenly_spaced(this->frames_->points.size(), maximum_tiles);
  const int columns = static_cast<int>(std::min<std::size_t>(frame_indices.size(), 4));
  for (std::size_t k = 0; k < frame_indices.size(); ++k)
  {
    const QImage tile =
      this->picture(frame_indices[k]).scaledToWidth(tile_width, Qt::SmoothTransformation);
    if (contact_sheet.isNull())
    {
      const int rows = (static_cast<int>(frame_indices.size()) + columns - 1) / columns;
      contact_sheet = QImage(columns * tile.width(), rows * tile.height(), QImage::Format_RGB32);
      contact_sheet.fill(Qt::white);
    }
    const int tile_index = static_cast<int>(k);
    QPainter(&contact_sheet)
      .drawImage(tile_index % columns * tile.width(), tile_index / columns * tile.height(), tile);
  }
  handles->SetEnabled(shown);
  AtomicFile file;
  Status status = file.open(path, true);
  if (status.ok())
  {
    status = contact_sheet.save(QString::fromStdString(file.temporary()), "PNG")
      ? file.commit()
      : cannot_write(path);
  }
  return status;
}

Status SequenceExport::begin_video(const std::string& path)
{
  const auto folder = std::make_shared<const ScratchFolder>("frames");
  if (folder->path().empty())
  {
    return Status::failure(StatusCode::unavailable, folder->error());
  }
  vtkHandleSetWidget* handles = this->viewport_->handle_widget();
  const bool shown = handles->GetEnabled();
  handles->SetEnabled(false);
  bool written = true;
  const std::size_t count = this->frames_->points.size();
  for (std::size_t k = 0; k < count && written; ++k)
  {
    written = this->picture(k).save(
      QString::fromStdString(frame_file(folder->path(), static_cast<int>(k))), "PNG");
    Q_EMIT this->progress(0.7 + 0.2 * static_cast<double>(k) / static_cast<double>(count));
  }
  handles->SetEnabled(shown);
  if (!written)
  {
    return cannot_write(folder->path());
  }
  this->encoder_.start(
    [folder, path, frames_per_second = this->frames_->frames_per_second](ExecutionContext& context)
    {
      AtomicFile file;
      Status status = file.open(path, true);
      if (status.ok())
      {
        status = write_video(context, folder->path(), frames_per_second, file.temporary());
      }
      return status.ok() ? file.commit() : status;
    });
  return {};
}

} // namespace app::posing
