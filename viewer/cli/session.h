#ifndef bindpose_cli_session_h
#define bindpose_cli_session_h

#include "base/status.h"
#include "cli/arguments.h"
#include "cli/progress_bar.h"
#include "io/atomic_file.h"

#include "vtkDataSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <chrono>

class vtkBindposeAlgorithm;

namespace bindpose::cli
{

/// Exit codes of the program.
int exit_code(StatusCode code);

/// What of an algorithm's report goes into the verb's.
enum class Merge
{
  nothing, ///< its warnings and its total as seconds.STAGE
  numbers, ///< the same, and all numbers but its phases
  all ///< warnings, numbers and seconds by phase
};

/// One run of a verb: runs algorithms with progress and cancel, keeps what they report, and ends
/// with the report file, one line for an error, and the exit code.
///
/// Steps return false when the verb cannot go on; the session then knows why.
class Session
{
public:
  explicit Session(Arguments arguments);

  const Arguments& arguments() const { return this->arguments_; }
  Report& report() { return this->report_; }
  bool failed() const { return !this->status_.usable(); }

  bool fail(Status status);
  bool invalid(const std::string& sentence) { return this->fail(Status::invalid_input(sentence)); }
  /// Print and report a warning, each sentence once.
  void warn(const std::string& sentence);
  /// Show progress of work that is not done by an algorithm, as a fraction of the verb's main work.
  void show(double fraction, const std::string& what)
  {
    this->bar_.show(this->of_whole(fraction), what);
  }

  /// Bring the algorithm up to date as the stage [begin, end] of the verb's main work: what comes
  /// between reading and writing. Its warnings and errors are the session's, nothing is printed by
  /// VTK.
  bool run(vtkBindposeAlgorithm* algorithm, const std::string& stage, double begin, double end,
    Merge merge);
  /// The same, but a failure is only returned, for callers with another way out. A cancel counts
  /// for the session in any case.
  Status try_run(vtkBindposeAlgorithm* algorithm, const std::string& stage, double begin,
    double end, Merge merge);

  /// Reads a mesh, volume or handle file; null when it fails.
  vtkSmartPointer<vtkDataSet> read(const std::string& path);
  /// The same for handle files (.tgf), too.
  vtkSmartPointer<vtkDataSet> read_any(const std::string& path);
  /// The value of --handles: a file, auto[:N] points on the surface, skeleton[:N] bones in it; null
  /// when it fails.
  vtkSmartPointer<vtkPolyData> read_handles(const std::string& value, vtkDataSet* surface);

  /// The report can be written.
  bool check_report();
  /// The output can have this ending and can be written: asked before the work, not after.
  bool check_output(const std::string& path, const std::string& endings);
  bool write(vtkDataSet* data, const std::string& path);
  /// To the temporary file of `file`, which gets its name by commit(): for files that are to be
  /// there all or none.
  bool write_uncommitted(vtkDataSet* data, const std::string& path, AtomicFile& file);
  bool commit(AtomicFile& file);
  /// A rig as glTF: mesh with weights, its handles (null: none), and frames of an animation.
  bool write_rig(vtkDataSet* mesh, vtkPolyData* handles,
    const std::vector<vtkSmartPointer<vtkDataSet>>& frames, double frames_per_second, bool morph,
    const std::string& path);
  bool write_text(const std::string& text, const std::string& path);

  /// Ends the verb: report, error line. Returns the exit code.
  int finish();

private:
  /// The same as a stage [begin, end] of the whole run.
  Status try_stage(vtkBindposeAlgorithm* algorithm, const std::string& stage, double begin,
    double end, Merge merge);
  bool run_stage(vtkBindposeAlgorithm* algorithm, const std::string& stage, double begin,
    double end, Merge merge);
  /// Run what prepares the main work, and let that begin `share` of the whole later.
  bool run_before(vtkBindposeAlgorithm* algorithm, const std::string& stage, double share);
  double of_whole(double fraction) const;

  std::string who() const { return "bindpose " + this->arguments_.verb; }
  void write_report();

  Arguments arguments_;
  ProgressBar bar_;
  double main_begin_ = 0.0; ///< where the main work begins, as a fraction of the whole
  Status status_;
  std::vector<std::string> warnings_;
  Report report_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace bindpose::cli

#endif
