/**
 * @class   vtkCrowdDeformation
 * @brief   poses many instances of a mesh, each as rigidly as its own pose allows
 *
 * A mesh is bound once, as by vtkReducedARAP, and posed as often as there are instances; each has a
 * pose and a place of its own (Jacobson et al. 2012: their crowd). What an instance adds to the
 * memory are its points, in single precision, and 72 bytes a cluster.
 *
 * **Input 0, 1**: the mesh at rest with its weights and the handles (see vtkBindAlgorithm).
 * **Input 2**: the instances, as one of
 * - points (vtkPointSet), an instance a point, which stands there: the point is added to where the
 *   posed mesh is;
 * - a vtkTable, an instance a row.
 *   Point (row) arrays, all optional: one named after a handle, with 12 components, is its
 *   `Transform` (3x4, row by row, rest to posed, before the instance is placed), with 3 a
 *   translation; `Mode` has a component a handle; `Placement` is where the instance stands, 12
 *   numbers (3x4) or 3, and comes before the points. A handle without an array has the pose that
 *   input 1 says;
 * - a composite of vtkPolyData (vtkMultiBlockDataSet, vtkPartitionedDataSetCollection, …), an
 *   instance a block: the handles of input 1, each time posed otherwise, as vtkPoseHandles does; a
 *   field data array `Placement` says where it stands.
 *
 * **Output**: a vtkPartitionedDataSetCollection with a data set an instance, named "instance 0", …;
 * cells and arrays are the mesh's own objects, points are floats, normals of a vtkPolyData follow.
 * With OutputType APPENDED all instances in one data set of the mesh's class, with the point array
 * `Instance`. Field data of an instance: `HandleTransforms`, as of vtkReducedARAP, before it is
 * placed.
 *
 * An instance begins with the rotations of its last pose (WarmStart): a crowd that moves needs few
 * iterations.
 *
 * Report: method, counts (instances, not_converged, clusters and more), iterations and
 * single_precision_iterations (of all), row_sum_error, seconds.bind, seconds.solve, seconds.skin.
 * Status NOT_CONVERGED, with an output, when MaximumIterations were not enough for an instance.
 * Errors name the instance.
 *
 * @sa vtkReducedARAP
 */

#ifndef vtkCrowdDeformation_h
#define vtkCrowdDeformation_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkCrowdDeformation : public vtkBindAlgorithm
{
public:
  static vtkCrowdDeformation* New();
  vtkTypeMacro(vtkCrowdDeformation, vtkBindAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The instances: SetInputData(2, instances).
  void SetInstancesData(vtkDataObject* instances) { this->SetInputData(2, instances); }
  void SetInstancesConnection(vtkAlgorithmOutput* instances)
  {
    this->SetInputConnection(2, instances);
  }

  ///@{
  /// As vtkReducedARAP's, all bind parameters.
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
  /// Weights of at most this size count as zero when points are moved, 0 to 1. Default 0. A bind
  /// parameter.
  void SetSmallestWeight(double smallest);
  vtkGetMacro(SmallestWeight, double);
  ///@}

  ///@{
  /// Most iterations of an instance, 0 to 1e6. Default 100.
  vtkSetClampMacro(MaximumIterations, int, 0, 1000000);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /// An instance is solved when an iteration lowers its energy by no more than this share. Default
  /// 1e-6; 0 runs all iterations.
  vtkSetClampMacro(Tolerance, double, 0.0, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /// Iterates that the acceleration looks back on, 0 (none) to 50. Default 5.
  vtkSetClampMacro(AndersonWindow, int, 0, 50);
  vtkGetMacro(AndersonWindow, int);
  ///@}

  ///@{
  /// Whether an instance starts from its last rotations (default on) or from a guess by its
  /// handles' own motions (off: the result depends on the pose only).
  vtkSetMacro(WarmStart, bool);
  vtkGetMacro(WarmStart, bool);
  vtkBooleanMacro(WarmStart, bool);
  ///@}

  ///@{
  /// As vtkReducedARAP's. Default on.
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
  /// One data set an instance, or one of all. Default COLLECTION.
  vtkSetClampMacro(OutputType, int, COLLECTION, APPENDED);
  vtkGetMacro(OutputType, int);
  ///@}

  /// The collection, or the data set of all instances.
  vtkDataObject* GetOutput() { return this->GetOutputDataObject(0); }

protected:
  vtkCrowdDeformation();
  ~vtkCrowdDeformation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bindpose::Status Bind(const PoseInput& input, bindpose::ExecutionContext& context) override;
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

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
  std::unique_ptr<Internals> Internal;
};

#endif
