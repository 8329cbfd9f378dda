// Writes and reads session files. Writing: companion files are written first, under names that
// contain a hash of their contents. Then one rename replaces the session file, and companions that
// the new session does not name are deleted. Reading: everything is checked before it is used.
// Paths of inputs are relative to the session file.
#include "document/session.h"

#include "document/dataset_json.h"
#include "document/dataset_view.h"
#include "document/opened_file.h"
#include "document/work_inputs.h"

#include "conversion.h"
#include "guarded_read.h"
#include "io/atomic_file.h"
#include "io/json_depth.h"
#include "io/text_scanner.h"
#include "pictures/picture_file.h"
#include "scene/volume.h"
#include "xml_names.h"

#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkXMLImageDataWriter.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QRegularExpression>

#include <csignal>

using namespace bindpose;
using nlohmann::json;

namespace
{
constexpr qint64 maximum_session_bytes = 256LL << 20;
constexpr int hash_digits = 12;

// ---- Writing -----------------------------------------------------------------------------------

template <typename Writer>
Status write_xml(vtkDataSet* data, const std::string& path)
{
  vtkSmartPointer<vtkDataSet> escaped;
  Status status = escape_names(data, escaped);
  if (!status.ok())
  {
    return status;
  }
  vtkNew<Writer> writer;
  writer->SetInputData(escaped);
  writer->SetFileName(path.c_str());
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone(); // compression would be so slow that users notice an autosave
  writer->SetHeaderTypeToUInt64();
  if (writer->Write() != 1 || writer->GetErrorCode() != 0)
  {
    return Status::failure(
      StatusCode::internal_error, "the data could not be written; the disk may be full");
  }
  return {};
}

/// Return the prefix of companion names: "NAME." for NAME.bindpose.
QString companion_stem(const QString& session)
{
  return QFileInfo(session).completeBaseName() + '.';
}

/// Remove the session file's companions that are not in `referenced_names`, and unfinished files of
/// killed processes.
void remove_stale_companions(const QString& session, const QStringList& referenced_names)
{
  QDir folder(QFileInfo(session).absolutePath());
  const QString stem = QRegularExpression::escape(companion_stem(session));
  const auto anchored = [](const QString& pattern)
  { return QRegularExpression(QRegularExpression::anchoredPattern(pattern)); };
  const QRegularExpression companion_pattern = anchored(stem +
    QString("(surface-[0-9a-f]{%1}\\.vtp|tets-[0-9a-f]{%1}\\.vtu|volume-[0-9a-f]{%1}\\.vti)")
      .arg(hash_digits));
  const QRegularExpression unfinished =
    anchored(stem + R"(((surface|tets|volume)\.)?part-(\d+)-\d+\.(vtp|vtu|vti|bindpose))");
  for (const QString& name : folder.entryList(QDir::Files))
  {
    const auto left = unfinished.match(name);
    const bool is_orphaned = left.hasMatch() && ::kill(left.captured(3).toInt(), 0) != 0;
    if (is_orphaned ||
      (companion_pattern.match(name).hasMatch() && !referenced_names.contains(name)))
    {
      folder.remove(name);
    }
  }
}

json source_to_json(const Source& source, const QDir& folder)
{
  return { { "path", folder.relativeFilePath(source.path).toStdString() },
    { "sha256", source.checksum.toStdString() } };
}

json camera_to_json(const SessionView::Camera& camera)
{
  return { { "position", camera.position }, { "focal_point", camera.focal_point },
    { "up", camera.up }, { "angle", camera.angle }, { "scale", camera.scale },
    { "parallel", camera.parallel } };
}

// ---- Reading -----------------------------------------------------------------------------------

std::array<double, 3> read_triple(const json& value, const char* value_name)
{
  std::array<double, 3> result{};
  if (!value.is_array() || value.size() != 3)
  {
    throw SessionError(std::string(value_name) + " must be a list of three numbers");
  }
  for (int k = 0; k < 3; ++k)
  {
    result[k] = json_number(value[k], value_name);
  }
  return result;
}

SessionView view_from_json(const json& value)
{
  SessionView view;
  view.panel = json_integer(json_at(value, "panel"), "the panel number", 0, 100);
  const json& camera = json_at(value, "camera");
  if (!camera.is_null())
  {
    view.camera.emplace();
    view.camera->position = read_triple(json_at(camera, "position"), "the camera's position");
    view.camera->focal_point =
      read_triple(json_at(camera, "focal_point"), "the camera's focal point");
    view.camera->up = read_triple(json_at(camera, "up"), "the camera's up direction");
    view.camera->angle = json_number(json_at(camera, "angle"), "the camera's angle");
    view.camera->scale = json_number(json_at(camera, "scale"), "the camera's scale");
    const json& parallel = json_at(camera, "parallel");
    if (!parallel.is_boolean() || view.camera->angle <= 0.0 || view.camera->angle >= 180.0 ||
      view.camera->scale <= 0.0)
    {
      throw SessionError("the camera must have an angle between 0 and 180 degrees, a positive "
                         "scale and a Boolean value 'parallel'");
    }
    view.camera->parallel = parallel.get<bool>();
  }
  return view;
}

/// Reads a session from its parsed text. Paths are relative to `folder_`.
class SessionReader
{
public:
  SessionReader(const json& text, const QString& path)
    : text_(text), folder_(QFileInfo(path).absolutePath())
  {
  }

  void read(Session& session)
  {
    Work& work = session.work;
    this->read_handles(work);
    work.options = options_from_json(json_at(this->text_, "options"));
    work.stored_poses =
      std::make_shared<const StoredPoses>(stored_poses_from_json(json_at(this->text_, "poses")));
    session.view = view_from_json(json_at(this->text_, "view"));
    const json& inputs = json_at(this->text_, "inputs");
    const json& companions = json_at(this->text_, "companions");
    if (!inputs.is_object() || !companions.is_object())
    {
      throw SessionError("the values of 'inputs' and 'companions' must be objects");
    }
    if (this->text_.contains("saved_as"))
    {
      session.saved_as =
        QString::fromStdString(json_text(this->text_["saved_as"], "the value of 'saved_as'"));
    }
    const QString name =
      QString::fromStdString(json_text(json_at(this->text_, "name"), "the session name"));
    this->read_mesh(inputs, companions, name, session);
    this->read_other_inputs(inputs, companions, session);
  }

private:
  void read_handles(Work& work)
  {
    const json& handles = json_at(this->text_, "handles");
    const json& pose = json_at(this->text_, "pose");
    if (!pose.is_array())
    {
      throw SessionError("the pose must be a list");
    }
    if (!handles.is_null())
    {
      work.handles = handles_from_json(handles);
      Handles list;
      const Status status = to_handles(work.handles, list);
      if (!status.ok())
      {
        throw SessionError(status.message);
      }
      if (pose.size() != list.size())
      {
        throw SessionError("the pose has " + std::to_string(pose.size()) + " entries; expected " +
          std::to_string(list.size()) + ", one per handle");
      }
      for (const json& handle_pose : pose)
      {
        work.pose.push_back(pose_from_json(handle_pose));
      }
    }
    const json& bound = json_at(this->text_, "bound_handles");
    if (bound.is_object())
    {
      work.bound_handles = handles_from_json(bound);
    }
    else if (bound == "handles")
    {
      work.bound_handles = work.handles;
    }
    else if (!bound.is_null())
    {
      throw SessionError("the bound handles must be an object, 'handles' or null");
    }
  }

  Source source(const json& input) const
  {
    Source source;
    const QString path =
      QString::fromStdString(json_text(json_at(input, "path"), "the path of a file"));
    source.path = QDir::cleanPath(this->folder_.absoluteFilePath(path));
    source.checksum =
      QByteArray::fromStdString(json_text(json_at(input, "sha256"), "the checksum of a file"));
    return source;
  }

  /// Read and return a companion; null if the session has none. If the companion file is missing or
  /// its checksum differs, set `is_damaged` and return null. Throw SessionError if the file is
  /// unchanged but cannot be read.
  vtkSmartPointer<vtkDataSet> companion(
    const json& companions, const char* role, bool& is_damaged) const
  {
    if (!companions.contains(role))
    {
      return nullptr;
    }
    const Source file = this->source(companions[role]);
    if (file.checksum.isEmpty() || checksum_of(file.path) != file.checksum)
    {
      is_damaged = true;
      return nullptr;
    }
    ExecutionContext context;
    vtkSmartPointer<vtkDataSet> data;
    const Status status = read_guarded(context, file.path.toStdString(), data);
    if (!status.ok())
    {
      // The checksum shows that the companion file has not changed since the session was saved, but
      // this program cannot read it. Do not open the session without the companion: if the user
      // then saved the session, the companion file would be deleted.
      throw SessionError(status.message);
    }
    return data;
  }

  void read_mesh(
    const json& inputs, const json& companions, const QString& name, Session& session) const
  {
    Work& work = session.work;
    const auto bound_handles = work.bound_handles;
    bool is_damaged = false;
    const auto surface = this->companion(companions, "surface", is_damaged);
    const auto tets = this->companion(companions, "tets", is_damaged);
    const bool has_input = inputs.contains("mesh");
    const Source source = has_input ? this->source(inputs["mesh"]) : Source();
    const QByteArray current_checksum = has_input ? checksum_of(source.path) : QByteArray();
    const QString file = QFileInfo(source.path).fileName();
    if (surface)
    {
      const Status status = use_mesh(surface, name, source, work);
      if (!status.ok())
      {
        throw SessionError("the surface is not valid: " + status.message);
      }
      work.differs_from_file = true;
      work.weighted_tets = vtkUnstructuredGrid::SafeDownCast(tets);
      if (has_input && current_checksum == source.checksum)
      {
        std::vector<std::string> warnings;
        work.look = read_look(source.path.toStdString(), work.surface, warnings);
        for (const std::string& warning : warnings)
        {
          session.notes << QString::fromStdString(warning);
        }
      }
      if (has_input && current_checksum != source.checksum)
      {
        session.notes << (current_checksum.isEmpty()
            ? tr("%1 is missing; the mesh saved with the session is shown.")
            : tr("%1 has changed since the session was saved; the mesh saved with the session is "
                 "shown."))
                           .arg(file);
      }
    }
    else if (has_input)
    {
      OpenedFile opened;
      const bool read = !current_checksum.isEmpty() &&
        read_file(source.path.toStdString(), opened).ok() &&
        use_mesh(opened.data, name, Source{ source.path, current_checksum }, work).ok();
      if (!read)
      {
        session.missing_inputs.push_back({ "mesh", source.path, source.checksum });
        session.notes << (current_checksum.isEmpty()
            ? tr("%1 is missing; the session was opened without it.")
            : tr("%1 cannot be read; the session was opened without it."))
                           .arg(file);
      }
      else if (current_checksum != source.checksum)
      {
        session.notes << tr("%1 has changed since the session was saved.").arg(file);
      }
      work.look = read ? opened.look : nullptr;
    }
    if (is_damaged)
    {
      session.notes << tr(
        "A file with results next to the session file is missing or damaged: bind again.");
    }
    // Replace the bound handles that use_mesh() has set. The bound handles in the session file are
    // correct for any surface.
    work.bound_handles = bound_handles;
    if (!surface && is_damaged)
    {
      work.bound_handles = nullptr;
    }
  }

  void read_other_inputs(const json& inputs, const json& companions, Session& session) const
  {
    Work& work = session.work;
    bool is_damaged = false;
    work.volume = vtkImageData::SafeDownCast(this->companion(companions, "volume", is_damaged));
    if (work.volume && !check_volume(work.volume, "WindingNumber").ok())
    {
      work.volume = nullptr;
      is_damaged = true;
    }
    if (work.volume)
    {
      work.volume_name = tr("winding numbers");
    }
    if (is_damaged)
    {
      session.notes << tr(
        "The volume file next to the session file is missing or damaged: compute it again.");
    }
    const auto add_missing_input = [&](const char* role, const Source& source)
    {
      session.missing_inputs.push_back({ role, source.path, source.checksum });
      session.notes << tr("%1 is missing; the session was opened without it.")
                         .arg(QFileInfo(source.path).fileName());
    };
    if (inputs.contains("handles"))
    {
      // The session file contains the handles, so the handle file is not read. Only the path and
      // the checksum of this file are needed.
      work.handle_source = this->source(inputs["handles"]);
    }
    if (inputs.contains("picture"))
    {
      work.picture_source = this->source(inputs["picture"]);
      if (!read_picture(work.picture_source.path.toStdString(), work.picture).ok())
      {
        work.picture = nullptr;
        add_missing_input("picture", work.picture_source);
      }
    }
    for (const char* role : { "volume", "curves" })
    {
      if (!inputs.contains(role))
      {
        continue;
      }
      const Source source = this->source(inputs[role]);
      const bool is_volume = std::string(role) == "volume";
      OpenedFile opened;
      const bool read = read_file(source.path.toStdString(), opened).ok() &&
        opened.kind == (is_volume ? OpenedFile::Kind::volume : OpenedFile::Kind::curves);
      if (!read)
      {
        add_missing_input(role, source);
      }
      else if (is_volume)
      {
        work.volume = vtkImageData::SafeDownCast(opened.data);
        work.volume_name = QFileInfo(source.path).fileName();
        work.volume_source = source;
      }
      else
      {
        work.curves = vtkPolyData::SafeDownCast(opened.data);
        work.curve_source = source;
      }
    }
  }

  static QString tr(const char* text) { return QObject::tr(text); }

  const json& text_;
  QDir folder_;
};
} // namespace

Status SessionFile::write_companion(
  const QString& session, const QString& role, vtkDataSet* data, Companion& companion)
{
  const QDir folder(QFileInfo(session).absolutePath());
  if (companion.data == data && companion.session == session && folder.exists(companion.name))
  {
    return {};
  }
  const bool is_tets = role == "tets";
  const bool is_volume = role == "volume";
  const QString extension = is_tets ? "vtu" : is_volume ? "vti" : "vtp";
  AtomicFile file;
  const QString path_without_hash =
    folder.filePath(companion_stem(session) + role + '.' + extension);
  Status status = file.open(path_without_hash.toStdString(), true);
  if (!status.ok())
  {
    return status;
  }
  // Do not pass `data` to the VTK writer: the window may use `data` at the same time, and the
  // writer changes its input (cached ranges, pipeline information). Pass a dataset that only shares
  // the values.
  const vtkSmartPointer<vtkDataSet> view = view_of(data);
  if (!view)
  {
    return Status::invalid_input(
      "cannot write " + path_without_hash.toStdString() + ": expected a surface, tets or a volume");
  }
  status = is_tets ? write_xml<vtkXMLUnstructuredGridWriter>(view, file.temporary())
    : is_volume    ? write_xml<vtkXMLImageDataWriter>(view, file.temporary())
                   : write_xml<vtkXMLPolyDataWriter>(view, file.temporary());
  const QString temporary = QString::fromStdString(file.temporary());
  const QByteArray checksum = status.ok() ? checksum_of(temporary) : QByteArray();
  if (checksum.isEmpty())
  {
    return Status::invalid_input("cannot write " + path_without_hash.toStdString() + ": " +
      (status.ok() ? "the data could not be read back; the disk may be full" : status.message));
  }
  const QString name = QString("%1%2-%3.%4")
                         .arg(companion_stem(session), role,
                           QString::fromLatin1(checksum.left(hash_digits)), extension);
  if (!folder.exists(name) || checksum_of(folder.filePath(name)) != checksum)
  {
    status = file.commit_synced_as(folder.filePath(name).toStdString());
  }
  companion = { data, session, name, checksum };
  return status;
}

struct SessionFile::PreparedSession
{
  QString path; // absolute path of the session file
  json text; // contents of the session file; write() adds the companions
  // Datasets to write as companions, because no input file contains them; may be null.
  vtkSmartPointer<vtkPolyData> surface;
  vtkSmartPointer<vtkUnstructuredGrid> tets;
  vtkSmartPointer<vtkImageData> volume;
};

std::shared_ptr<const SessionFile::PreparedSession> SessionFile::prepare(
  const QString& path, const Session& session)
{
  const Work& work = session.work;
  const QDir folder(QFileInfo(path).absolutePath());
  auto prepared = std::make_shared<PreparedSession>();
  prepared->path = QFileInfo(path).absoluteFilePath();
  json& text = prepared->text;
  text["bindpose"] = { { "schema", session_schema } };
  text["name"] = work.name.toStdString();
  json& inputs = text["inputs"] = json::object();
  const std::pair<const char*, const Source*> sources[] = { { "mesh", &work.mesh_source },
    { "handles", &work.handle_source }, { "picture", &work.picture_source },
    { "volume", work.volume ? &work.volume_source : nullptr },
    { "curves", work.curves ? &work.curve_source : nullptr } };
  for (const auto& [role, source] : sources)
  {
    if (source && !source->path.isEmpty())
    {
      inputs[role] = source_to_json(*source, folder);
    }
  }
  if (work.surface && work.differs_from_file)
  {
    prepared->surface = work.surface;
    prepared->tets = work.weighted_tets;
  }
  if (work.volume_source.path.isEmpty())
  {
    prepared->volume = work.volume;
  }
  text["handles"] = work.handles ? handles_to_json(work.handles) : json();
  text["bound_handles"] = !work.bound_handles ? json()
    : work.bound_handles == work.handles      ? json("handles")
                                              : handles_to_json(work.bound_handles);
  json& pose = text["pose"] = json::array();
  for (const HandlePose& handle_pose : work.pose)
  {
    pose.push_back(pose_to_json(handle_pose));
  }
  text["poses"] = work.stored_poses ? stored_poses_to_json(*work.stored_poses) : json::object();
  text["options"] = options_to_json(work.options);
  text["view"] = { { "panel", session.view.panel },
    { "camera", session.view.camera ? camera_to_json(*session.view.camera) : json() } };
  if (!session.saved_as.isEmpty())
  {
    text["saved_as"] = session.saved_as.toStdString();
  }
  return prepared;
}

Status SessionFile::write(const QString& path, const Session& session)
{
  return this->write(*prepare(path, session));
}

Status SessionFile::write(const PreparedSession& prepared)
{
  json text = prepared.text;
  json& companions = text["companions"] = json::object();
  QStringList referenced_names;
  const auto add = [&](const char* role, vtkDataSet* data, Companion& companion)
  {
    Status status = this->write_companion(prepared.path, role, data, companion);
    if (status.ok())
    {
      referenced_names << companion.name;
      companions[role] = { { "path", companion.name.toStdString() },
        { "sha256", companion.checksum.toStdString() } };
    }
    return status;
  };
  Status status;
  if (prepared.surface)
  {
    status = add("surface", prepared.surface, this->surface_);
    if (status.ok() && prepared.tets)
    {
      status = add("tets", prepared.tets, this->tets_);
    }
  }
  if (status.ok() && prepared.volume)
  {
    status = add("volume", prepared.volume, this->volume_);
  }
  if (!status.ok())
  {
    return status;
  }
  AtomicFile file;
  status = file.open(prepared.path.toStdString(), true);
  if (!status.ok())
  {
    return status;
  }
  status =
    write_file(file.temporary(), text.dump(1, ' ', false, json::error_handler_t::replace) + '\n');
  if (status.ok())
  {
    status = file.commit_synced();
  }
  if (status.ok())
  {
    remove_stale_companions(prepared.path, referenced_names);
  }
  return status;
}

Status read_session(const QString& path, Session& session)
{
  const std::string name = QFileInfo(path).fileName().toStdString();
  const auto cannot_open = [&name](const std::string& reason)
  { return Status::invalid_input(name + " cannot be opened: " + reason); };
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly))
  {
    return cannot_open("the file does not exist or is not readable");
  }
  if (file.size() > maximum_session_bytes)
  {
    return cannot_open("the file is too large for a session");
  }
  const QByteArray bytes = file.readAll();
  const Status depth =
    check_json_depth({ bytes.constData(), static_cast<std::size_t>(bytes.size()) });
  if (!depth.ok())
  {
    return cannot_open(depth.message);
  }
  try
  {
    const json text = json::parse(bytes.begin(), bytes.end());
    const int schema =
      json_integer(json_at(json_at(text, "bindpose"), "schema"), "the schema version", 1, 1 << 20);
    if (schema > session_schema)
    {
      return cannot_open("the file was written by a newer version of Bindpose");
    }
    Session read;
    SessionReader(text, path).read(read);
    session = std::move(read);
    return {};
  }
  catch (const SessionError& error)
  {
    return cannot_open(error.what());
  }
  catch (const json::exception&)
  {
    return cannot_open("the file is damaged or is not a Bindpose session");
  }
}
