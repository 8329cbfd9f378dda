#include "cli/session.h"

#include "base/memory.h"
#include "cli/interrupt.h"
#include "cli/suggestion.h"
#include "file_kind.h"
#include "gltf/gltf_skin.h"
#include "io/report_json.h"
#include "io/text_scanner.h"
#include "report_field_data.h"
#include "vtkAssetReader.h"
#include "vtkAutomaticHandles.h"
#include "vtkBindposeAlgorithm.h"
#include "vtkFarthestPointHandles.h"
#include "vtkGLTFSkinWriter.h"
#include "vtkHandleFileReader.h"
#include "vtkMeshFileReader.h"
#include "vtkMeshFileWriter.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <iostream>

namespace bindpose::cli
{

int exit_code(StatusCode code)
{
  switch (code)
  {
    case StatusCode::ok:
      return 0;
    case StatusCode::invalid_input:
    case StatusCode::unavailable:
      return 2;
    case StatusCode::not_converged:
      return 3;
    case StatusCode::canceled:
      return 4;
    case StatusCode::internal_error:
      break;
  }
  return 5;
}

namespace
{
/// The range of the progress bar for one algorithm.
struct Stage
{
  ProgressBar* bar;
  std::string name;
  double begin;
  double end;
};

void on_progress(vtkObject* caller, unsigned long, void* stage_data, void*)
{
  auto* algorithm = static_cast<vtkAlgorithm*>(caller);
  const auto* stage = static_cast<Stage*>(stage_data);
  if (interrupted())
  {
    // Repeat the request to abort, because the pipeline clears the request when it starts the
    // algorithm.
    algorithm->SetAbortExecute(1);
  }
  const char* phase = algorithm->GetProgressText();
  const bool has_phase = phase && *phase && stage->name != phase;
  const std::string text = has_phase ? stage->name + ": " + phase : stage->name;
  stage->bar->show(stage->begin + algorithm->GetProgress() * (stage->end - stage->begin), text);
}

// Expected fractions of a run's total time.
constexpr double reading_fraction = 0.02;
constexpr double choosing_points_fraction = 0.01;
constexpr double finding_bones_fraction = 0.2;
constexpr double main_end_fraction = 0.97; ///< fraction at which writing begins
/// The main work begins at this fraction at the latest, even if there are many input files.
constexpr double latest_main_begin = 0.5;

bool starts_with(const std::string& text, const std::string& begin)
{
  return text.compare(0, begin.size(), begin) == 0;
}

ProgressStyle progress_style(const Arguments& arguments)
{
  return arguments.has("quiet")             ? ProgressStyle::none
    : arguments.text("progress") == "lines" ? ProgressStyle::lines
                                            : ProgressStyle::bar;
}

} // namespace

Session::Session(Arguments arguments)
  : arguments_(std::move(arguments)), bar_(progress_style(arguments_))
{
}

bool Session::fail(Status status)
{
  if (!this->failed())
  {
    this->status_ = std::move(status);
  }
  return false;
}

void Session::warn(const std::string& sentence)
{
  // Ignore repetitions: a filter that is updated once per frame repeats its warnings.
  if (std::find(this->warnings_.begin(), this->warnings_.end(), sentence) != this->warnings_.end())
  {
    return;
  }
  this->warnings_.push_back(sentence);
  if (!this->arguments_.has("quiet"))
  {
    this->bar_.clear();
    std::cerr << this->command_name() << ": warning: " << sentence << "\n";
  }
}

double Session::overall_fraction(double fraction) const
{
  return this->main_begin_ + fraction * (main_end_fraction - this->main_begin_);
}

Status Session::try_run(vtkBindposeAlgorithm* algorithm, const std::string& stage_name,
  double begin, double end, Merge merge)
{
  return this->try_stage(
    algorithm, stage_name, this->overall_fraction(begin), this->overall_fraction(end), merge);
}

Status Session::try_stage(vtkBindposeAlgorithm* algorithm, const std::string& stage_name,
  double begin, double end, Merge merge)
{
  if (interrupted())
  {
    this->fail(Status::canceled());
    return Status::canceled();
  }
  Stage stage{ &this->bar_, stage_name, begin, end };
  vtkNew<vtkCallbackCommand> progress;
  progress->SetCallback(on_progress);
  progress->SetClientData(&stage);
  // An observer that does nothing keeps VTK from printing messages. The status contains the same
  // messages.
  vtkNew<vtkCallbackCommand> silent;
  const unsigned long observers[] = { algorithm->AddObserver(vtkCommand::ProgressEvent, progress),
    algorithm->AddObserver(vtkCommand::ErrorEvent, silent),
    algorithm->AddObserver(vtkCommand::WarningEvent, silent) };
  algorithm->SetNumberOfThreads(this->arguments_.integer("threads"));
  {
    const AbortOnInterrupt abort(algorithm);
    this->bar_.show(begin, stage_name);
    if (algorithm->GetNumberOfOutputPorts() == 0)
    {
      algorithm->UpdateWholeExtent(); // a writer has no output to update
    }
    else
    {
      algorithm->Update();
    }
  }
  for (const unsigned long observer : observers)
  {
    algorithm->RemoveObserver(observer);
  }
  Status status;
  status.code = static_cast<StatusCode>(algorithm->GetStatus());
  status.message = algorithm->GetStatusMessage();
  if (status.code == StatusCode::canceled)
  {
    this->fail(status);
  }
  if (algorithm->GetNumberOfOutputPorts() == 0)
  {
    return status;
  }
  status.report = algorithm->GetReport();
  const Report::Value* entry = status.report.find("warnings[]");
  if (const auto* warnings = entry ? std::get_if<std::vector<std::string>>(entry) : nullptr)
  {
    for (const std::string& warning : *warnings)
    {
      if (!this->ignores_losses_ || warning.find(not_kept_phrase) == std::string::npos)
      {
        this->warn(warning);
      }
    }
  }
  if (!status.usable() && merge != Merge::all)
  {
    return status;
  }
  // With Merge::all, the report of a failed algorithm is merged too, because the report describes
  // the input and what the algorithm has tried.
  for (const auto& [key, value] : status.report.entries())
  {
    const bool seconds = starts_with(key, "seconds.");
    const bool is_writer_entry = key == "status" || key == "message" || key == "warnings[]" ||
      key == "seconds.total" || key == "peak_memory_bytes";
    if (is_writer_entry || merge == Merge::nothing || (seconds && merge != Merge::all))
    {
      continue;
    }
    if (seconds)
    {
      this->report_.add(key, status.report.number(key, 0.0));
    }
    else
    {
      this->report_.set(key, value);
    }
  }
  if (merge != Merge::all)
  {
    this->report_.add("seconds." + stage_name, status.report.number("seconds.total", 0.0));
  }
  if (status.code == StatusCode::not_converged && this->status_.ok())
  {
    this->status_.code = status.code;
    this->status_.message = status.message;
  }
  return status;
}

bool Session::run(
  vtkBindposeAlgorithm* algorithm, const std::string& stage, double begin, double end, Merge merge)
{
  const Status status = this->try_run(algorithm, stage, begin, end, merge);
  return status.usable() || this->fail(status);
}

bool Session::run_stage(
  vtkBindposeAlgorithm* algorithm, const std::string& stage, double begin, double end, Merge merge)
{
  const Status status = this->try_stage(algorithm, stage, begin, end, merge);
  return status.usable() || this->fail(status);
}

bool Session::run_before(vtkBindposeAlgorithm* algorithm, const std::string& stage, double fraction)
{
  const double begin = this->main_begin_;
  this->main_begin_ = std::min(begin + fraction, std::max(begin, latest_main_begin));
  return this->run_stage(algorithm, stage, begin, this->main_begin_, Merge::nothing);
}

vtkSmartPointer<vtkDataSet> Session::read(const std::string& path)
{
  vtkNew<vtkMeshFileReader> reader;
  reader->SetFileName(path.c_str());
  if (!this->run_before(reader, "read", reading_fraction))
  {
    return nullptr;
  }
  return reader->GetOutput();
}

vtkSmartPointer<vtkDataSet> Session::read_any(const std::string& path)
{
  if (file_extension(path) == "tgf")
  {
    return this->read_handles(path, nullptr);
  }
  const std::string extension = file_extension(path);
  if (is_listed(extension, vtkAssetReader::GetFileExtensions()) &&
    !is_listed(extension, vtkMeshFileReader::GetFileExtensions()))
  {
    vtkSmartPointer<vtkPolyData> mesh, handles;
    this->read_asset(path, mesh, handles);
    return mesh;
  }
  return this->read(path);
}

bool Session::read_asset(const std::string& path, vtkSmartPointer<vtkPolyData>& mesh,
  vtkSmartPointer<vtkPolyData>& handles)
{
  vtkNew<vtkAssetReader> reader;
  reader->SetFileName(path.c_str());
  if (!this->run_before(reader, "read", reading_fraction))
  {
    return false;
  }
  mesh = vtkPolyData::SafeDownCast(reader->GetOutputDataObject(0));
  handles = vtkPolyData::SafeDownCast(reader->GetOutputDataObject(1));
  return true;
}

vtkSmartPointer<vtkPolyData> Session::read_handles(const std::string& value, vtkDataSet* surface)
{
  const std::size_t colon = value.find(':');
  const std::string word = value.substr(0, colon);
  if ((word != "auto" && word != "skeleton") || !surface)
  {
    if (file_extension(value).empty() && surface)
    {
      this->invalid("--handles '" + value +
        "' is not valid: expected auto[:N], skeleton[:N] or a file .tgf, .vtp, .glb or .gltf" +
        suggestion(word, { "auto", "skeleton" }));
      return nullptr;
    }
    vtkNew<vtkHandleFileReader> reader;
    reader->SetFileName(value.c_str());
    return this->run_before(reader, "read", reading_fraction)
      ? vtkPolyData::SafeDownCast(reader->GetOutput())
      : nullptr;
  }
  Index count = word == "auto" ? 8 : 0;
  if (colon != std::string::npos &&
    (!parse_index(value.substr(colon + 1), count) || count < 1 || count > 100000))
  {
    this->invalid("--handles " + word + ":N needs an integer N between 1 and 100000 (got '" +
      value.substr(colon + 1) + "')");
    return nullptr;
  }
  if (word == "skeleton")
  {
    vtkNew<vtkAutomaticHandles> bones;
    bones->SetInputData(surface);
    bones->SetMaximumBones(static_cast<int>(count));
    return this->run_before(bones, "handles", finding_bones_fraction)
      ? vtkPolyData::SafeDownCast(bones->GetOutput())
      : nullptr;
  }
  vtkNew<vtkFarthestPointHandles> handles;
  handles->SetInputData(surface);
  handles->SetNumberOfHandles(static_cast<int>(count));
  return this->run_before(handles, "handles", choosing_points_fraction)
    ? vtkPolyData::SafeDownCast(handles->GetOutput())
    : nullptr;
}

bool Session::check_report()
{
  const std::string path = this->arguments_.text("report");
  if (path.empty() || path == "-")
  {
    return true;
  }
  const Status status = AtomicFile::check(path, this->arguments_.has("overwrite"));
  if (!status.ok())
  {
    this->arguments_.values.erase("report"); // finish() must not try to write the report
    return this->fail(status);
  }
  return true;
}

bool Session::check_output(const std::string& path, const std::string& extensions)
{
  // check for an interrupt, because a sequence calls this function for up to 100,000 files
  if (interrupted())
  {
    return this->fail(Status::canceled());
  }
  Status status = check_extension(path, extensions);
  if (status.ok())
  {
    status = AtomicFile::check(path, this->arguments_.has("overwrite"));
  }
  return status.ok() || this->fail(status);
}

bool Session::write(vtkDataSet* data, const std::string& path)
{
  vtkNew<vtkMeshFileWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName(path.c_str());
  writer->SetOverwrite(this->arguments_.has("overwrite"));
  return this->run_stage(writer, "write", main_end_fraction, 1.0, Merge::nothing);
}

bool Session::write_rig(vtkGLTFSkinWriter* writer)
{
  writer->SetOverwrite(this->arguments_.has("overwrite"));
  // Give the writer an empty report, so that the loop below adds the prefix "gltf." only to the
  // writer's entries, not to those of the verb.
  const Report verb_report = this->report_;
  this->report_ = Report();
  const bool written = this->run_stage(writer, "write", main_end_fraction, 1.0, Merge::numbers);
  Report report = verb_report;
  for (const auto& [key, value] : this->report_.entries())
  {
    report.set(starts_with(key, "seconds.") ? key : "gltf." + key, value);
  }
  this->report_ = report;
  return written;
}

bool Session::write_uncommitted(vtkDataSet* data, const std::string& path, AtomicFile& file)
{
  Status status = file.open(path, this->arguments_.has("overwrite"));
  if (!status.ok())
  {
    return this->fail(status);
  }
  vtkNew<vtkMeshFileWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName(file.temporary().c_str());
  writer->SetOverwrite(true);
  status = this->try_run(writer, "write", 1.0, 1.0, Merge::nothing);
  const std::size_t offset = status.message.find(file.temporary());
  if (offset != std::string::npos)
  {
    status.message.replace(offset, file.temporary().size(), path);
  }
  return status.usable() || this->fail(status);
}

bool Session::commit(AtomicFile& file)
{
  const Status status = file.commit();
  return status.ok() || this->fail(status);
}

bool Session::write_text(const std::string& text, const std::string& path)
{
  const Status status = write_file_atomically(path, text, this->arguments_.has("overwrite"));
  return status.ok() || this->fail(status);
}

void Session::write_report()
{
  const std::string path = this->arguments_.text("report");
  if (path.empty())
  {
    return;
  }
  Report report;
  report.set("status", to_string(this->status_.code));
  report.set("message", this->status_.message);
  if (!this->warnings_.empty())
  {
    report.set("warnings[]", this->warnings_);
  }
  report.merge(this->report_);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - this->start_;
  report.set("seconds.total", elapsed.count());
  report.set("peak_memory_bytes", static_cast<std::int64_t>(peak_memory()));
  const std::string text = to_json(report) + "\n";
  if (path == "-")
  {
    std::cout << text << std::flush;
    if (!std::cout)
    {
      this->invalid("cannot write the report to the standard output");
    }
  }
  else
  {
    this->write_text(text, path);
  }
}

int Session::finish()
{
  this->bar_.clear();
  this->write_report();
  if (!this->status_.ok())
  {
    std::cerr << this->command_name() << ": "
              << (this->status_.message.empty() ? to_string(this->status_.code)
                                                : this->status_.message.c_str())
              << "\n";
  }
  return exit_code(this->status_.code);
}

} // namespace bindpose::cli
