#include "document/opened_file.h"

#include "document/work_inputs.h"

#include "file_kind.h"
#include "io/atomic_file.h"
#include "io/dmat.h"
#include "look_file.h"
#include "pictures/picture_file.h"
#include "pose/pose_file.h"
#include "report_field_data.h"
#include "scene/categories.h"
#include "scene/curves.h"

#include "vtkAssetReader.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkGLTFSkinReader.h"
#include "vtkHandleFileReader.h"
#include "vtkImageData.h"
#include "vtkMeshFileReader.h"
#include "vtkMeshFileWriter.h"
#include "vtkNew.h"
#include "vtkPlanarShape.h"
#include "vtkPolyData.h"

#include <QString>
#include <QThread>

#include <algorithm>

using namespace bindpose;

namespace
{
/// Keep VTK from printing an object's errors and warnings, because the status and the report of a
/// reader or writer contain these messages.
void silence_events(vtkObject* object)
{
  vtkNew<vtkCallbackCommand> nothing;
  nothing->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  object->AddObserver(vtkCommand::ErrorEvent, nothing);
  object->AddObserver(vtkCommand::WarningEvent, nothing);
}

bool looks_like_handles(vtkDataSet* data)
{
  auto* polydata = vtkPolyData::SafeDownCast(data);
  return polydata && polydata->GetNumberOfPolys() + polydata->GetNumberOfStrips() == 0;
}

Status update(vtkBindposeAlgorithm* reader)
{
  reader->Update();
  return reader->GetStatus() == vtkBindposeAlgorithm::OK
    ? Status()
    : Status::invalid_input(reader->GetStatusMessage());
}

template <typename Reader>
Status read_with(Reader* reader, const std::string& path, const RunReader& run, OpenedFile& file)
{
  silence_events(reader);
  reader->SetFileName(path.c_str());
  Status status = run ? run(reader) : update(reader);
  if (status.ok())
  {
    file.data = vtkDataSet::SafeDownCast(reader->GetOutput());
    const Report::Value* warnings = reader->GetReport().find("warnings[]");
    file.warnings =
      warnings ? std::get<std::vector<std::string>>(*warnings) : std::vector<std::string>();
  }
  return status;
}

/// Read a file with the mesh as output 0 of the reader, and the handles of its skin as output 1.
template <typename Reader>
Status read_with_handles(const std::string& path, const RunReader& run, OpenedFile& file)
{
  vtkNew<Reader> reader;
  const Status status = read_with(reader.Get(), path, run, file);
  if (status.ok())
  {
    auto* handles = vtkPolyData::SafeDownCast(reader->GetOutputDataObject(1));
    file.handles = handles->GetNumberOfCells() > 0 ? handles : nullptr;
    file.look = read_look(path, file.data, file.warnings);
  }
  return status;
}
} // namespace

Status read_file(const std::string& path, OpenedFile& file, const RunReader& run)
{
  // Qt regards the first thread that uses it as the application's main thread. Use Qt in this
  // thread before the other thread is started below.
  QThread::currentThread();
  // Compute the checksum while the file is read. For a large mesh both take equally long.
  file.checksum = std::async(
    std::launch::async, [name = QString::fromStdString(path)] { return checksum_of(name); });
  if (QString::fromStdString(path).endsWith(".tgf", Qt::CaseInsensitive))
  {
    vtkNew<vtkHandleFileReader> reader;
    file.kind = OpenedFile::Kind::handles;
    return read_with(reader.Get(), path, run, file);
  }
  if (file_extension(path) == "dmat")
  {
    file.kind = OpenedFile::Kind::weights;
    return read_dmat(path, file.weights);
  }
  if (is_picture_file(path))
  {
    vtkSmartPointer<vtkImageData> picture;
    const Status status = read_picture(path, picture);
    file.kind = OpenedFile::Kind::picture;
    file.data = picture;
    return status;
  }
  const std::string extension = file_extension(path);
  if (is_listed(extension, vtkGLTFSkinReader::GetFileExtensions()))
  {
    return read_with_handles<vtkGLTFSkinReader>(path, run, file);
  }
  if (!is_listed(extension, vtkMeshFileReader::GetFileExtensions()) &&
    is_listed(extension, vtkAssetReader::GetFileExtensions()))
  {
    return read_with_handles<vtkAssetReader>(path, run, file);
  }
  vtkNew<vtkMeshFileReader> reader;
  Status status = read_with(reader.Get(), path, run, file);
  if (!status.ok())
  {
    return status;
  }
  if (vtkImageData::SafeDownCast(file.data))
  {
    file.kind = OpenedFile::Kind::volume;
    return status;
  }
  if (is_defect_data(file.data))
  {
    return Status::invalid_input("surface defects cannot be opened directly; open the surface and "
                                 "show its defects in the Tets panel");
  }
  file.kind = is_curve_data(file.data) ? OpenedFile::Kind::curves
    : looks_like_handles(file.data)    ? OpenedFile::Kind::handles
                                       : OpenedFile::Kind::mesh;
  if (file.kind == OpenedFile::Kind::mesh)
  {
    file.look = read_look(path, file.data, file.warnings);
  }
  return status;
}

std::shared_ptr<const FileLook> read_look(
  const std::string& path, vtkDataSet* mesh, std::vector<std::string>& warnings)
{
  auto* surface = vtkPolyData::SafeDownCast(mesh);
  if (!surface || surface->GetNumberOfPolys() == 0 ||
    !is_listed(file_extension(path), vtkAssetReader::GetFileExtensions()))
  {
    return nullptr;
  }
  const auto look = std::make_shared<FileLook>();
  ExecutionContext context;
  const Status status = read_look_file(context, path, *look);
  for (const std::string& warning : status.warnings)
  {
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
    {
      warnings.push_back(warning);
    }
  }
  if (!status.ok())
  {
    warnings.push_back("the materials and textures of the mesh are not drawn: " + status.message);
    return nullptr;
  }
  const bool fits = look->surface.point_count == surface->GetNumberOfPoints();
  return fits && !look->surface.is_plain() ? look : nullptr;
}

Status make_shape(
  vtkImageData* picture, bool is_whole_image, vtkSmartPointer<vtkPolyData>& shape, bool& is_cut_out)
{
  vtkNew<vtkPlanarShape> planar;
  silence_events(planar);
  planar->SetInputData(0, picture);
  planar->SetRectangle(is_whole_image);
  planar->Update();
  if (planar->GetStatus() != vtkBindposeAlgorithm::OK)
  {
    return Status::invalid_input(planar->GetStatusMessage());
  }
  shape = vtkPolyData::SafeDownCast(planar->GetOutput());
  is_cut_out = read_report(shape).text("domain") == "alpha";
  return {};
}

Status write_shape(vtkPolyData* shape, const std::string& path)
{
  vtkNew<vtkMeshFileWriter> writer;
  silence_events(writer);
  writer->SetInputData(shape);
  writer->SetFileName(path.c_str());
  writer->OverwriteOn();
  writer->Update();
  return writer->GetStatus() == vtkBindposeAlgorithm::OK
    ? Status()
    : Status::invalid_input(writer->GetStatusMessage());
}

Status write_poses(const std::vector<Pose>& poses, const Handles& handles, const std::string& path,
  double frames_per_second)
{
  std::string text;
  Status status = format_pose_file(poses, frames_per_second, handles, text);
  if (status.usable())
  {
    const Status written = write_file_atomically(path, text, true);
    if (!written.ok())
    {
      return written;
    }
  }
  return status;
}
