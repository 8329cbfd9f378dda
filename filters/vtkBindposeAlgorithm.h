/**
 * @class   vtkBindposeAlgorithm
 * @brief   base class of all Bindpose filters: status, report, progress and cancellation
 *
 * A subclass implements Execute(). It validates and converts the input, calls the kernel, attaches
 * arrays and returns the kernel's status. This class does the rest, so that every filter has the
 * same contract:
 *
 * - **Report.** GetReportJSON() returns the measurements (status, message, warnings, counts,
 *   residuals, seconds per phase, memory …) as a JSON object. Every output carries them as field
 *   data arrays `Report.KEY`. Seconds and memory are left out, so that equal results give equal
 *   files.
 * - **Failure.** A status other than ok and not_converged calls vtkErrorMacro, sets the error code
 *   and leaves all outputs empty except for the report. The pipeline continues (RequestData returns
 *   1), so that downstream filters do not keep stale output. Each downstream Bindpose filter
 *   repeats the failure that it finds on its input.
 * - **Cancel.** SetAbortExecute(1) ends the execution within 200 ms, except during a matrix
 *   factorization that cannot be interrupted. It may be called from any thread or from an observer
 *   of ProgressEvent. The outputs are empty, the status is CANCELED, and no error event is invoked.
 * - **Retry.** After a failure or cancel the next Update() executes again.
 * - **Pieces.** With several processes, most filters depend on the whole input, and the first
 *   process does the work: piece 0 requests every input as a whole, and all other pieces are empty.
 *   If every point (or instance) of an input can be processed alone, GetPiecePort() returns the
 *   port of this input. Every process then works on its own piece of it, and requests all other
 *   inputs as a whole. The results have the same bits as those of one process. Ghost levels are not
 *   requested. If an algorithm is upstream of this port and of another one, the first process does
 *   the work. A filter that requests its inputs itself overrides MakesPieces().
 * - **Blocks.** A composite input at the first port is worked on block by block, and the output is
 *   a composite with the results. Each block has its own bind. A composite at another port must
 *   have one block per block of the first port, or a single block, which is used for all blocks.
 *   The first failure of a block is the status of the filter.
 */

#ifndef vtkBindposeAlgorithm_h
#define vtkBindposeAlgorithm_h

#include "BindposeFiltersModule.h" // for export macro
#include "block_caches.h" // for BlockNumber
#include "vtkAlgorithm.h"
#include <functional> // for std::function
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
    CANCELED = 3,
    UNAVAILABLE = 4,
    INTERNAL_ERROR = 5
  };

  ///@{
  /**
   * Return the outcome of the last execution: one of StatusType, its name ("ok", "invalid_input",
   * …), and a message of one sentence, which is empty on success.
   */
  int GetStatus();
  std::string GetStatusAsString();
  std::string GetStatusMessage();
  ///@}

  /// Return the number of warnings of the last execution; the report contains their texts.
  int GetNumberOfWarnings();

  /// Return the report of the last execution as a JSON object, "{}" before the first execution.
  std::string GetReportJSON();

  /// Return the report of the last execution (C++ only).
  VTK_WRAPEXCLUDE const bindpose::Report& GetReport();

  /// Return the report in the field data of a data object as a JSON object, "{}" if there is none.
  /// Any filter may have written the report. The report in field data contains no seconds.
  static std::string GetReportJSONOf(vtkDataObject* data);

  ///@{
  /**
   * Number of threads; 0 (default) means all cores. The results do not depend on the number of
   * threads, so changing it does not execute the filter again.
   */
  void SetNumberOfThreads(int threads) { this->NumberOfThreads = threads < 0 ? 0 : threads; }
  int GetNumberOfThreads() { return this->NumberOfThreads; }
  ///@}

  ///@{
  /// Data object of an input or output port, as in other VTK filters.
  void SetInputData(vtkDataObject* data) { this->SetInputData(0, data); }
  void SetInputData(int port, vtkDataObject* data) { this->SetInputDataInternal(port, data); }
  vtkDataObject* GetInput(int port = 0);
  vtkDataSet* GetOutput(int port = 0);
  ///@}

  /**
   * Return the input port whose pieces are distributed over several processes. The results of a
   * piece depend only on this piece and on the whole of all other inputs. -1 (default): the output
   * is not computed piece by piece; see Pieces in the class documentation.
   */
  virtual int GetPiecePort() { return -1; }

  /// Return the modification time. After a failure or cancel, the returned time is later than the
  /// modification time of any output, so that the next Update() executes again.
  vtkMTimeType GetMTime() override;

  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

protected:
  vtkBindposeAlgorithm();
  ~vtkBindposeAlgorithm() override;

  ///@{
  /// Handle the pipeline passes before RequestData. The default implementations return 1.
  virtual int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output);
  virtual int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output);
  virtual int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output);
  ///@}

  /// Report whether the filter implements pieces itself and does not use GetPiecePort(). If true,
  /// Execute() must produce only the requested piece or extent, and RequestUpdateExtent() must
  /// request only the necessary input. Default: false; see Pieces in the class documentation.
  virtual bool MakesPieces() { return false; }

  /// Report whether a failure of an input ends the execution with the status of this input. If
  /// false, Execute() is called with failed inputs, too. Default: true.
  virtual bool EndsWithFailedInput() { return true; }

  /// Report whether Execute() accepts a whole composite at an input port. If false (default),
  /// Execute() is called once per block; see Blocks in the class documentation.
  virtual bool TakesComposite(int vtkNotUsed(port)) { return false; }

  /// Accept composites at an input port in addition to the port's data type. Call this function in
  /// FillInputPortInformation() for all ports but the first. If a port does not accept composites,
  /// the executive calls the filter once per block. A writer would then write all blocks to the
  /// same file, so writers call this function for their first port, too.
  static void AcceptBlocks(vtkInformation* port);

  /// Request the whole input, not a piece. Call this in RequestUpdateExtent().
  static void RequestWholeInput(vtkInformation* input);

  ///@{
  /// Return the index of the requested piece (0 without a request), and the number of pieces of the
  /// request (1 without a request).
  static int GetPiece(vtkInformation* output);
  static int GetNumberOfPieces(vtkInformation* info);
  ///@}

  /// Report whether one of several pieces is requested and the input at GetPiecePort() has no
  /// points and no rows. The output of such a piece is empty, which is not an error: a process may
  /// have no part of the data.
  bool IsEmptyPiece(vtkInformationVector** input, vtkInformationVector* output);

  /// Return the number of the block that Execute() works on. The caches of a filter
  /// (bindpose::BlockCaches) use this number to select the cache of the block.
  const bindpose::BlockNumber& GetBlock() const { return this->Block; }

  /**
   * Do the filter's work. Outputs are new or contain old data: write or Initialize() all of them.
   * The report of the returned status is attached to every output. An exception becomes
   * INTERNAL_ERROR.
   */
  virtual bindpose::Status Execute(bindpose::ExecutionContext& context,
    vtkInformationVector** input, vtkInformationVector* output) = 0;

  /**
   * Do work outside of the pipeline, with the filter's number of threads, abort flag and progress
   * events. The status becomes that of the filter until the next execution. No error or warning
   * event is invoked. The report has the status, the message, the warnings and the seconds per
   * phase, but no memory, which would take longer to measure than short work takes.
   * @return whether the status is usable
   */
  bool ExecuteDirectly(
    const std::function<bindpose::Status(bindpose::ExecutionContext& context)>& work);

  /**
   * Do work that has no status, such as reading the time steps of a file in RequestInformation(),
   * with the filter's number of threads, abort flag and progress events. An abort before this call
   * has no effect.
   */
  void WithContext(const std::function<void(bindpose::ExecutionContext& context)>& work);

private:
  vtkBindposeAlgorithm(const vtkBindposeAlgorithm&) = delete;
  void operator=(const vtkBindposeAlgorithm&) = delete;

  int RequestData(vtkInformationVector** input, vtkInformationVector* output);
  void ReportProgress(double fraction, const std::string& phase);
  void CountBlocks(vtkInformationVector** input);
  bool HasBlocks(int port, vtkDataObject* data);
  bool WorksByPieces(vtkInformationVector** input);

  int NumberOfThreads = 0;
  bindpose::BlockNumber Block;
  bool ExecuteAgain = false;
  vtkTimeStamp RetryTime;
  std::unique_ptr<bindpose::Status> LastStatus;
};

#endif
