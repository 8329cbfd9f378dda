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
class vtkGLTFSkinWriter;

namespace bindpose::cli
{

/// Return the exit code of the program for a status.
int exit_code(StatusCode code);

/// Selects the part of an algorithm's report that is merged into the verb's report.
enum class Merge
{
  nothing, ///< the warnings, and the algorithm's total time as the entry seconds.STAGE
  numbers, ///< `nothing` plus all entries except the times of the algorithm's phases
  all ///< the warnings and all entries, including the times of the algorithm's phases
};

/// One run of a verb (a subcommand such as `weights`). The session runs algorithms, shows their
/// progress, lets signals cancel them, and merges their reports. At the end it writes the report
/// file, prints one line if there is an error, and returns the exit code.
///
/// The methods that run, read, check or write something return false or null if the verb cannot
/// continue. The session then stores the reason.
class Session
{
public:
  explicit Session(Arguments arguments);

  const Arguments& arguments() const { return this->arguments_; }
  Report& report() { return this->report_; }
  bool failed() const { return !this->status_.usable(); }

  bool fail(Status status);
  bool invalid(const std::string& sentence) { return this->fail(Status::invalid_input(sentence)); }
  /// Print and report a warning; repetitions are ignored.
  void warn(const std::string& sentence);
  /// Show the progress of work outside of algorithms, as a fraction of the verb's main work.
  void show(double fraction, const std::string& phase)
  {
    this->bar_.show(this->overall_fraction(fraction), phase);
  }

  /// Update the algorithm. Its progress covers the part [begin, end] of the verb's main work, as
  /// fractions in [0, 1]. The main work is everything between reading and writing. The session
  /// stores the algorithm's warnings and errors; VTK prints nothing.
  bool run(vtkBindposeAlgorithm* algorithm, const std::string& stage, double begin, double end,
    Merge merge);
  /// Run the algorithm like run(), but return a failure instead of storing it in the session,
  /// because the caller has a fallback. A cancel always ends the session.
  Status try_run(vtkBindposeAlgorithm* algorithm, const std::string& stage, double begin,
    double end, Merge merge);

  /// Do not warn about data of files that are not kept, because the session writes no dataset.
  void ignore_losses() { this->ignores_losses_ = true; }
  /// Read a mesh, volume or handle file other than .tgf; return null on failure.
  vtkSmartPointer<vtkDataSet> read(const std::string& path);
  /// Read like read(), including .tgf handle files and the formats that only vtkAssetReader reads.
  vtkSmartPointer<vtkDataSet> read_any(const std::string& path);
  /// Read a glTF file that gets a new rig. Set its meshes and the handles of its joints.
  bool read_asset(const std::string& path, vtkSmartPointer<vtkPolyData>& mesh,
    vtkSmartPointer<vtkPolyData>& handles);
  /// Return the handles for the value of --handles, which is a file, auto[:N] (N points on the
  /// surface) or skeleton[:N] (N bones inside the surface). Return null on failure.
  vtkSmartPointer<vtkPolyData> read_handles(const std::string& value, vtkDataSet* surface);

  /// Check that the report file can be written.
  bool check_report();
  /// Check, before the work, that the output's extension is allowed and the file can be written.
  bool check_output(const std::string& path, const std::string& extensions);
  bool write(vtkDataSet* data, const std::string& path);
  /// Write to the temporary file of `file`, which commit() renames. For a group of files, write all
  /// files before the first commit, so that a failed write leaves no incomplete group.
  bool write_uncommitted(vtkDataSet* data, const std::string& path, AtomicFile& file);
  bool commit(AtomicFile& file);
  /// Run a writer of glTF files. Its report entries get the prefix "gltf.".
  bool write_rig(vtkGLTFSkinWriter* writer);
  bool write_text(const std::string& text, const std::string& path);

  /// End the verb: write the report, print an error line, and return the exit code.
  int finish();

private:
  /// Run the algorithm. Its progress covers the part [begin, end] of the whole run.
  Status try_stage(vtkBindposeAlgorithm* algorithm, const std::string& stage, double begin,
    double end, Merge merge);
  bool run_stage(vtkBindposeAlgorithm* algorithm, const std::string& stage, double begin,
    double end, Merge merge);
  /// Run an algorithm before the main work, and reserve the fraction `fraction` of the whole run
  /// for it.
  bool run_before(vtkBindposeAlgorithm* algorithm, const std::string& stage, double fraction);
  double overall_fraction(double fraction) const;

  std::string command_name() const { return "bindpose " + this->arguments_.verb; }
  void write_report();

  Arguments arguments_;
  ProgressBar bar_;
  double main_begin_ = 0.0; ///< fraction of the whole run at which the main work begins
  Status status_;
  std::vector<std::string> warnings_;
  bool ignores_losses_ = false;
  Report report_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace bindpose::cli

#endif
