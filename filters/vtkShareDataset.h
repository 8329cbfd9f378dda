/**
 * @class   vtkShareDataset
 * @brief   gives every process the whole of a dataset that was computed on one or several processes
 *
 * With several processes (MPI), some filters compute their result only on the first process. This
 * filter sends such a result to all processes. Put it before the inputs that filters with pieces
 * request as a whole:
 * <pre>
 *   mesh - weights filter - vtkShareDataset - input 1 of vtkTransferWeights
 *   handles - vtkShareDataset - vtkPoseHandles - input 1 of vtkSkinningDeformation
 * </pre>
 * Without it, every process would compute the weights and the handles itself. In the second line
 * each process poses its own copy of the handles, so a change of the pose causes no new exchange.
 *
 * **Input**: the part of the dataset that a process has, a vtkPolyData or vtkUnstructuredGrid. The
 * filter requests piece i of N from its input, where i is the process and N the number of
 * processes. Usually only process 0 has points; otherwise the parts are appended in the order of
 * the processes. Points are not merged, and ids in arrays are not renumbered.
 *
 * **Output**: the whole dataset, with the same bits on all processes, if the request is for piece 0
 * of 1. Filters request inputs in this way if they need them as a whole. Views and writers instead
 * request one of N pieces on each process. Piece 0 is then the whole dataset and the other pieces
 * are empty, so that nothing occurs twice. In both cases every process stores the whole dataset.
 *
 * **Exchange.** All processes exchange data together, in the first update after a change upstream.
 * A change of the requested piece causes no exchange. If the arrays of all parts are those of the
 * last exchange, the old result is kept. If the part of one process is unusable, all processes get
 * the same status, whose message names this process, and the next update tries again. The filter
 * has its own executive, which takes part in an exchange even if an algorithm upstream (of Bindpose
 * or not) fails on its process. Such a failure therefore does not block the other processes. All
 * processes must update the filter, as ParaView does.
 *
 * The status is INVALID_INPUT for a missing input, for blocks (merge them first), for other
 * classes, for parts of different classes, for ids above 2147483647 in arrays of ids, and for more
 * than 4 GiB.
 *
 * Report: counts.points, counts.cells, counts.parts (processes with points), counts.processes,
 * bytes_sent (by all processes together). They are the same on all processes.
 */

#ifndef vtkShareDataset_h
#define vtkShareDataset_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"
#include <memory> // for std::unique_ptr

class vtkMultiProcessController;

class BINDPOSEFILTERS_EXPORT vtkShareDataset : public vtkBindposeAlgorithm
{
public:
  static vtkShareDataset* New();
  vtkTypeMacro(vtkShareDataset, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Controller of the processes that exchange data. Default: the global controller. If the
  /// controller is null, there is only one process.
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  /// Number of completed exchanges. With only one process, nothing is exchanged; the number then
  /// counts the updates that follow a change upstream.
  vtkGetMacro(NumberOfExchanges, int);

  /// Set the executive. The filter ignores an executive unless it has the class of the default
  /// executive, because executives of other classes do not always take part in exchanges.
  void SetExecutive(vtkExecutive* executive) override;

protected:
  vtkShareDataset();
  ~vtkShareDataset() override;

  vtkExecutive* CreateDefaultExecutive() override;
  bool MakesPieces() override { return true; }
  bool EndsWithFailedInput() override { return false; }
  bool TakesComposite(int) override { return true; }
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkShareDataset(const vtkShareDataset&) = delete;
  void operator=(const vtkShareDataset&) = delete;

  bindpose::Status Exchange(vtkDataObject* part, const bindpose::Status& part_status);
  int GetProcess();
  int GetNumberOfProcesses();

  vtkMultiProcessController* Controller = nullptr;
  int NumberOfExchanges = 0;
  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
