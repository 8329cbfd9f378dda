/**
 * @class   vtkBindposeAlgorithm
 * @brief   what all filters of Bindpose share: status, report, progress, cancel
 *
 * A subclass implements Execute(): validate, convert, call the kernel, attach arrays, and return
 * the kernel's status. This class does the rest, so that every filter keeps the same contract:
 *
 * - **Report.** GetReportJSON() returns what was measured (status, message, warnings, counts,
 *   residuals, seconds per phase, memory …) as a JSON object. Every output carries it as field data
 *   arrays `Report.KEY`, without seconds and memory: equal results are equal files.
 * - **Failure.** A status that is neither ok nor not_converged calls vtkErrorMacro, sets the error
 *   code and leaves all outputs empty but for the report. The pipeline goes on (RequestData
 *   returns 1), so that downstream filters do not keep stale output: each of ours repeats the
 *   status it finds on its input.
 * - **Cancel.** SetAbortExecute(1), from any thread or from an observer of ProgressEvent, ends the
 *   execution within 200 ms (but for a single named factorisation). Outputs are empty, the status
 *   is CANCELLED; no error event.
 * - **Again.** After a failure or cancel the next Update() executes again.
 * - **Pieces.** With several processes the first one does the work: every input is asked for as a
 *   whole by piece 0, and all other pieces are empty. A filter that makes its pieces itself
 *   overrides MakesPieces().
 */

#ifndef vtkBindposeAlgorithm_h
#define vtkBindposeAlgorithm_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkAlgorithm.h"
#include <memory> // for std::unique_ptr
#include <string> // for std::string

class vtkDataSet;

namespace bindpose
{
class ExecutionContext;
class Report;
struct Status;
} // namespace bindpose

class BINDPOSEFILTERS_EXPORT vtkBindposeAlgorithm : public vtkAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkBindposeAlgorithm, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Outcomes, in the order of bindpose::StatusCode.
  enum StatusType
  {
    OK = 0,
    NOT_CONVERGED = 1,
    INVALID_INPUT = 2,
    CANCELLED = 3,
    UNAVAILABLE = 4,
    INTERNAL_ERROR = 5
  };

  ///@{
  /**
   * Outcome of the last execution: one of StatusType, its word ("ok", "invalid_input", …), and one
   * sentence that is empty when all went well.
   */
  int GetStatus();
  std::string GetStatusAsString();
  std::string GetStatusMessage();
  ///@}

  /// Report of the last execution as a JSON object; "{}" before the first.
  std::string GetReportJSON();

  /// The same for C++.
  VTK_WRAPEXCLUDE const bindpose::Report& GetReport();

  /// The report that a data object carries, whoever made it, as a JSON object; "{}" when it has
  /// none. It has no seconds.
  static std::string GetReportJSONOf(vtkDataObject* data);

  ///@{
  /**
   * Threads to use; 0 (default) for all cores. Results do not depend on it, so changing it does
   * not execute the filter again.
   */
  void SetNumberOfThreads(int threads) { this->NumberOfThreads = threads < 0 ? 0 : threads; }
  int GetNumberOfThreads() { return this->NumberOfThreads; }
  ///@}

  ///@{
  /// The data object of an input or output port, as other VTK filters have them.
  void SetInputData(vtkDataObject* data) { this->SetInputData(0, data); }
  void SetInputData(int port, vtkDataObject* data) { this->SetInputDataInternal(port, data); }
  vtkDataObject* GetInput(int port = 0);
  vtkDataSet* GetOutput(int port = 0);
  ///@}

  /// Later than any output after a failure or cancel, so that the next Update() executes again.
  vtkMTimeType GetMTime() override;

  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

protected:
  vtkBindposeAlgorithm();
  ~vtkBindposeAlgorithm() override;

  ///@{
  /// The pipeline's earlier passes; each returns 1 unless a subclass has something to do.
  virtual int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output);
  virtual int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output);
  virtual int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output);
  ///@}

  /// Whether Execute() makes the piece or extent that is asked for, and RequestUpdateExtent() what
  /// it needs. Default: no, see above.
  virtual bool MakesPieces() { return false; }

  /// Asks for all of an input, for RequestUpdateExtent().
  static void AskForAll(vtkInformation* input);

  /// The piece of an output that is asked for.
  static int GetPiece(vtkInformation* output);

  /**
   * The filter's work. Outputs are fresh or stale: write or Initialize() all of them. What the
   * returned status reports is attached to every output. May throw: an exception becomes
   * INTERNAL_ERROR.
   */
  virtual bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) = 0;

private:
  vtkBindposeAlgorithm(const vtkBindposeAlgorithm&) = delete;
  void operator=(const vtkBindposeAlgorithm&) = delete;

  int RequestData(vtkInformationVector** input, vtkInformationVector* output);

  int NumberOfThreads = 0;
  bool ExecuteAgain = false;
  vtkTimeStamp RetryTime;
  std::unique_ptr<bindpose::Status> LastStatus;
};

#endif
