/**
 * @class   vtkCrowdDeformation
 * @brief   poses many instances of a mesh, each as rigidly as its own pose allows
 *
 * The filter binds a mesh once, like vtkReducedARAP, and poses the mesh once per instance. Each
 * instance has its own pose and placement. Jacobson et al., "Fast Automatic Skinning
 * Transformations", 2012, pose a crowd in this way. Each instance needs memory for its points in
 * single precision and 72 bytes per cluster, a set of vertices that share one fitted rotation.
 *
 * **Inputs 0 and 1**: the mesh at rest with its weights and the handles (see vtkBindAlgorithm).
 * **Input 2**: the instances, as one of
 * - points (vtkPointSet), one point per instance: the point is added to the positions of the posed
 *   mesh;
 * - a vtkTable, one row per instance. The following arrays of the points or rows are optional. An
 *   array named after a handle contains its `Transform`, with 12 components (a 3x4 matrix, row by
 *   row, from rest to posed, applied before the placement) or 3 (a translation). `Mode` has one
 *   component per handle. `Placement` positions the instance, with 12 components (a 3x4 matrix) or
 *   3 (a translation), and takes precedence over the points. A handle without an array has the pose
 *   of input 1;
 * - a composite of vtkPolyData (vtkMultiBlockDataSet, vtkPartitionedDataSetCollection, …), one
 *   block per instance: the handles of input 1 in the pose of the instance, as vtkPoseHandles
 *   returns them. The field data array `Placement` positions the instance.
 *
 * **Output**: a vtkPartitionedDataSetCollection with one dataset per instance, named "instance 0",
 * … Cells and arrays are the mesh's own objects; points are floats; normals of a vtkPolyData are
 * updated. With OutputType APPENDED the output is one dataset of the mesh's class with all
 * instances and the point array `Instance`. Field data of an instance: `HandleTransforms`, as in
 * vtkReducedARAP, before the placement.
 *
 * **Pieces and blocks.** Each process poses its own piece of the instances with the whole mesh. An
 * instance gets the same bits as on one process if it starts from the same rotations. The indices
 * of instances (in names, messages and the array `Instance`) start at 0 in each piece, and the
 * report counts only the piece. A composite mesh requires OutputType APPENDED.
 *
 * An instance starts from the rotations of its last pose (WarmStart), so a moving crowd needs few
 * iterations.
 *
 * Report: method, counts (instances, not_converged, clusters and more), iterations and
 * single_precision_iterations (summed over instances), row_sum_error, seconds.bind, seconds.solve,
 * seconds.skin. The status is NOT_CONVERGED, with an output, if an instance did not converge within
 * MaximumIterations. Error messages name the instance.
 *
 * @sa vtkReducedARAP
 */

#ifndef vtkCrowdDeformation_h
#define vtkCrowdDeformation_h

#include "BindposeFiltersModule.h" // for export macro
#include "block_caches.h" // for BlockCaches
#include "vtkBindAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkCrowdDeformation : public vtkBindAlgorithm
{
public:
  static vtkCrowdDeformation* New();
  vtkTypeMacro(vtkCrowdDeformation, vtkBindAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Set the instances, like SetInputData(2, instances).
  void SetInstancesData(vtkDataObject* instances) { this->SetInputData(2, instances); }
  void SetInstancesConnection(vtkAlgorithmOutput* instances)
  {
    this->SetInputConnection(2, instances);
  }

  /// Return the port of the instances. Each process can pose its own piece of the instances,
  /// because instances do not depend on each other.
  int GetPiecePort() override { return 2; }

  ///@{
  /// Energy, number of clusters, and number and type of extra weights; see the setters of the same
  /// names in vtkArapAlgorithm and vtkReducedPoseAlgorithm. All four are bind parameters: a change
  /// runs the bind again.
  void SetEnergy(int energy);
  vtkGetMacro(Energy, int);
  void SetNumberOfClusters(int clusters);
  vtkGetMacro(NumberOfClusters, int);
  void SetNumberOfExtraWeights(int extra);
  vtkGetMacro(NumberOfExtraWeights, int);
  void SetExtraWeightsKind(int kind);
  vtkGetMacro(ExtraWeightsKind, int);
  ///@}

  ///@{
  /// Weights up to this value are treated as zero when points are moved; at least 0 and less than
  /// 1. Default 0. This is a bind parameter.
  void SetSmallestWeight(double smallest);
  vtkGetMacro(SmallestWeight, double);
  ///@}

  ///@{
  /// Maximum number of iterations per instance, 0 to 1e6. Default 100.
  vtkSetClampMacro(MaximumIterations, int, 0, 1000000);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /// Convergence tolerance: an instance is solved when an iteration lowers its energy by no more
  /// than this fraction. Default 1e-6; 0 runs all iterations.
  vtkSetClampMacro(Tolerance, double, 0.0, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /// Number of previous iterates that the acceleration uses, 0 (none) to 50. Default 5.
  vtkSetClampMacro(AndersonWindow, int, 0, 50);
  vtkGetMacro(AndersonWindow, int);
  ///@}

  ///@{
  /// Initial rotations of an instance. On (the default): the rotations of its last pose. Off: an
  /// estimate based on the motions of its handles, so that the result depends only on the pose.
  vtkSetMacro(WarmStart, bool);
  vtkGetMacro(WarmStart, bool);
  vtkBooleanMacro(WarmStart, bool);
  ///@}

  ///@{
  /// See vtkReducedARAP::SetMixedPrecision. Default on.
  vtkSetMacro(MixedPrecision, bool);
  vtkGetMacro(MixedPrecision, bool);
  vtkBooleanMacro(MixedPrecision, bool);
  ///@}

  enum OutputTypes
  {
    COLLECTION = 0,
    APPENDED = 1
  };

  ///@{
  /// Type of output: one dataset per instance (COLLECTION, the default), or one dataset with all
  /// instances (APPENDED).
  vtkSetClampMacro(OutputType, int, COLLECTION, APPENDED);
  vtkGetMacro(OutputType, int);
  ///@}

  /// Return the output: the collection, or the dataset of all instances.
  vtkDataObject* GetOutput() { return this->GetOutputDataObject(0); }

protected:
  vtkCrowdDeformation();
  ~vtkCrowdDeformation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bool TakesComposite(int port) override { return port == 2; }
  bindpose::Status Bind(
    bindpose::ExecutionContext& context, const bindpose::PoseInput& input) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkCrowdDeformation(const vtkCrowdDeformation&) = delete;
  void operator=(const vtkCrowdDeformation&) = delete;

  int Energy = 0;
  int NumberOfClusters = 0;
  int NumberOfExtraWeights = 0;
  int ExtraWeightsKind = 0;
  double SmallestWeight = 0.0;
  int MaximumIterations = 100;
  double Tolerance = 1e-6;
  int AndersonWindow = 5;
  bool WarmStart = true;
  bool MixedPrecision = true;
  int OutputType = COLLECTION;
  struct Internals;
  bindpose::BlockCaches<Internals> Internal;
};

#endif
