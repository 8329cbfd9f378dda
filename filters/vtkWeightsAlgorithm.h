/**
 * @class   vtkWeightsAlgorithm
 * @brief   what the filters that compute weights share: ports, arrays, bind cache
 *
 * Weights tell how much each handle moves each vertex. A subclass says which: bounded biharmonic,
 * monotone, or without bounds.
 *
 * **Input 0**: the mesh, a vtkUnstructuredGrid of tets (of positive volume) or a triangle surface
 * (vtkPolyData or grid with 2D cells; polygons are split for the computation).
 * **Input 1**: the handles, a vtkPolyData (see filters/README.md): points, bones and regions. They
 * may lie anywhere. Regions need an integer point array of labels on the mesh (RegionArrayName).
 * **Output**: input 0 with the double point array `Weights`, a component a handle, named after it;
 * rows sum to one. Handles that are no vertices become some: the cells around them are split, new
 * points are added behind the mesh's own (point arrays are interpolated; labels are kept where all
 * around agree, else 0; OriginalPointIds is -1), and the output then has nothing but tets or
 * triangles. KeepMesh leaves the mesh as it is and takes the corners of the cell that holds a
 * handle instead.
 *
 * **Output 1**: local extrema of the columns as solved for, away from handles, with a persistence
 * above 1e-3 (vtkPolyData, a vertex each): point arrays `Kind` (1 maximum, -1 minimum), `Handle`
 * (column), `Value`, `Persistence` (share of the column's range).
 * **Output 2**: the tets that a surface's weights were solved on, with `Weights` and what
 * vtkTetrahedralizeSurface says of them; empty when the mesh itself was solved on (Domain).
 *
 * KeepRaw adds the point array `RawWeights`: the columns as they were solved for, which the
 * certificate is about; their rows need not sum to one.
 *
 * **Terms** of bounded and monotone weights (vtkUnconstrainedWeights takes none), by point arrays
 * of the mesh where it has them, under the names below (an empty name: not looked for):
 * - `Rigidity`, >= 0: weights are nearly constant where it is large. 1 stiffens everything longer
 *   than a hundredth of the mesh's diagonal, whatever its unit or resolution; gradients fall with 1
 *   / rigidity. Adds 1/2 int rho |grad w|^2 to the energy, rho = 1e4 / diagonal^2 times the array.
 * - `RigidSet`, whole numbers: every weight is constant, exactly, on the points of one label > 0. A
 *   set with a point of a handle has that point's weights.
 * - `WeightsLower`, `WeightsUpper`, a component a handle: least and largest weight at each point;
 *   NaN: that of the handle, which is the cell array `WeightBounds` of the handles (two
 * components), or without one (or NaN) that of SetBounds(). All of them hold for RawWeights;
 * dividing rows by their sums can leave them (report: normalised_bounds_violation),
 * PartitionOfUnity COUPLED does not.
 * - `PinnedWeights`, a component a handle: weights that are given; NaN: free. They stay when rows
 *   are divided by their sums: the row's others make up what is left.
 * - `SymmetricPoint`, the id of each point's mirror point or -1: handles that are each other's
 *   mirror image get mirrored weights w_a(v) = w_b(mirror of v), exactly, of least energy together;
 *   or SetMirrorNormal(). Points without a mirror, and handles whose mirror image is no handle, are
 *   left alone.
 *
 * Where a surface's weights are solved in tets of its inside, rigidity is that of the nearest place
 * of the surface, all else is asked of its own points alone; a lattice (EMBEDDING) has none of
 * them, and AUTO takes the volume then. Previews take no terms.
 *
 * **Certificate**, in field data, a value a column, of the columns as solved for (before rows are
 * divided by their sums): `WeightsRelativeGap` (how far the energy is above its minimum at most, as
 * a share), `WeightsKKTResidual`, `WeightsMinimum`, `WeightsMaximum`, `WeightsInteriorExtrema`
 * (local extrema away from handles with a persistence above 1e-3), and `WeightsRowSumError`.
 *
 * Vertices in no cell get rows of zeros, and the unsigned char point array `WeightsMask` is 0 there
 * (it is present only then). A connected part without a handle follows the nearest one, with a
 * warning; on a lattice it is held by the parts that it touches, or by the nearest one, and has the
 * weights that come from there. Handles outside are moved to the nearest place of the mesh, with a
 * warning.
 *
 * **Bind cache.** The weights are kept while the mesh's points and cells, its labels, the handles'
 * rest (points, cells, names, kinds) and this filter's parameters stay: editing Transform, Mode,
 * Stretch or Twist of the handles never solves again and hands on the same array objects.
 * GetNumberOfBinds() counts.
 *
 * Report: method, binds, stage (of previews), counts.{vertices, tets | triangles, handles,
 * components, inserted_vertices}, handles[].{name, kind, constrained_vertices, distance_outside,
 * relative_gap, kkt_residual, energy, iterations, factorisations, interior_extrema}, relative_gap
 * and kkt_residual (the worst column's), bounds_violation, normalised_bounds_violation (with
 * bounds), counts.capped_vertices and influences.{largest_difference, rms_difference} (from the
 * weights without MaximumInfluences), partition.{of_unity, energy, largest_difference,
 * rms_difference} (COUPLED, from weights that were divided by their sums), counts.{linked_parts,
 * links} (parts without a handle on a lattice, and what holds them), handles[].mirror (with
 * mirrors), row_sum_error, largest_snap (in edge
 * lengths), iterations, memory_estimate_bytes (what the process would hold at most, by an estimate
 * made before the factorisations; of bounded and monotone weights), seconds.{insert, analyse,
 * weights} and, summed over handles, which are solved at the same time, seconds.{factor, solve}.
 *
 * Status not_converged (with the result) when a column misses Tolerance within MaximumIterations.
 * Errors: empty or invalid mesh, tets without volume, no handles, two at the same place, a region
 * whose label no vertex has, not enough memory, terms that contradict a handle or each other
 * (handle and point are named).
 */

#ifndef vtkWeightsAlgorithm_h
#define vtkWeightsAlgorithm_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkMeshAndHandlesAlgorithm.h"
#include "vtkCommand.h" // for vtkCommand::UserEvent
#include <memory> // for std::unique_ptr

namespace bindpose
{
struct TermArrayNames;
struct WeightsOptions;
struct WeightsProblem;
struct WeightsResult;
} // namespace bindpose

class BINDPOSEFILTERS_EXPORT vtkWeightsAlgorithm : public vtkMeshAndHandlesAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkWeightsAlgorithm, vtkMeshAndHandlesAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Largest relative gap and residual of a column, in (0, 1). Default 1e-6; 1e-9 is tight. All
   * parameters here are bind parameters.
   */
  void SetTolerance(double tolerance);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /// Iterations a column, each a factorisation, at least 1. Default 100; 1 to 20 are usual.
  void SetMaximumIterations(int iterations);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * MiB that the whole process may hold; 0 (default): as much as the machine has available. What
   * would take more is refused, with both numbers, before it is factored; where memory will not do
   * for a factor a thread, fewer threads are taken. Weights that are there stay.
   */
  vtkSetClampMacro(MemoryLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(MemoryLimit, int);
  ///@}

  ///@{
  /// Name of the mesh's point array of region labels (0: free). Default "RegionId".
  void SetRegionArrayName(const std::string& name);
  std::string GetRegionArrayName() { return this->RegionArrayName; }
  ///@}

  enum Domains
  {
    SURFACE = 0,
    AUTO = 1,
    VOLUME = 2,
    EMBEDDING = 3,
    CAGE = 4
  };

  ///@{
  /**
   * Where to solve for a surface: on its triangles (SURFACE, the default), in conforming tets of
   * its inside (VOLUME), in a lattice that holds it, in seconds whatever its size (EMBEDDING), in
   * the closed cage that the handles have around it (CAGE), or AUTO: a flat shape on itself, a
   * closed, clean surface in its volume where that is predicted to be well conditioned and cheap,
   * all others in the embedding. With AUTO the embedding also takes over where the first choice
   * fails, with a warning: AUTO ends in certified weights for every surface that a lattice can
   * hold. The output then is the surface as it came, with Weights at its own points, and output 2
   * is the mesh that was solved on. Meshes of tets are solved on directly. Out of range: clamped.
   */
  void SetDomain(int domain);
  vtkGetMacro(Domain, int);
  void SetDomainToSurface() { this->SetDomain(SURFACE); }
  void SetDomainToAuto() { this->SetDomain(AUTO); }
  void SetDomainToVolume() { this->SetDomain(VOLUME); }
  void SetDomainToEmbedding() { this->SetDomain(EMBEDDING); }
  void SetDomainToCage() { this->SetDomain(CAGE); }
  ///@}

  enum Stages
  {
    CERTIFIED = 0,
    PREVIEW = 1
  };

  ///@{
  /**
   * PREVIEW: weights within the time of a factorisation or less, to begin with: biharmonic ones,
   * clamped, whatever the method; the certificate says how far they are from bounded biharmonic
   * ones. CERTIFIED (the default): the method's own. Out of range: clamped.
   */
  void SetStage(int stage);
  vtkGetMacro(Stage, int);
  void SetStageToCertified() { this->SetStage(CERTIFIED); }
  void SetStageToPreview() { this->SetStage(PREVIEW); }
  ///@}

  /// Invoked once while CERTIFIED weights are made, if anybody observes it, on the thread that
  /// updates: the call data is a vtkDoubleArray of the preview's weights at the input's points.
  enum
  {
    PreviewEvent = vtkCommand::UserEvent + 4201
  };

  ///@{
  /// Of EMBEDDING and AUTO: lattice cubes along the longest side, 6 to 1000. Default 0: lattices
  /// of growing resolution are solved until two agree.
  void SetEmbeddingResolution(vtkIdType resolution);
  vtkGetMacro(EmbeddingResolution, vtkIdType);
  ///@}

  ///@{
  /// Whether the mesh stays as it is. Default off: handles become vertices.
  void SetKeepMesh(bool keep);
  vtkGetMacro(KeepMesh, bool);
  vtkBooleanMacro(KeepMesh, bool);
  ///@}

  ///@{
  /// Whether the point array RawWeights is added: the columns before rows are divided by their
  /// sums. Default off.
  void SetKeepRaw(bool keep);
  vtkGetMacro(KeepRaw, bool);
  vtkBooleanMacro(KeepRaw, bool);
  ///@}

  ///@{
  /**
   * Names of the mesh's point arrays of terms; see above. Defaults: Rigidity, RigidSet,
   * WeightsLower, WeightsUpper, PinnedWeights, SymmetricPoint.
   */
  void SetRigidityArrayName(const std::string& name);
  std::string GetRigidityArrayName();
  void SetRigidSetArrayName(const std::string& name);
  std::string GetRigidSetArrayName();
  void SetLowerArrayName(const std::string& name);
  std::string GetLowerArrayName();
  void SetUpperArrayName(const std::string& name);
  std::string GetUpperArrayName();
  void SetPinnedArrayName(const std::string& name);
  std::string GetPinnedArrayName();
  void SetMirrorArrayName(const std::string& name);
  std::string GetMirrorArrayName();
  ///@}

  ///@{
  /**
   * Least and largest weight of every handle where no array says otherwise. Default 0, 1. Handles
   * themselves have weights 0 and 1: only a wider range can be kept.
   */
  void SetBounds(double least, double largest);
  vtkGetVector2Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * Normal of a mirror plane through MirrorOrigin, which stands for the array SymmetricPoint.
   * Default 0 0 0: none.
   */
  void SetMirrorNormal(double x, double y, double z);
  vtkGetVector3Macro(MirrorNormal, double);
  void SetMirrorOrigin(double x, double y, double z);
  vtkGetVector3Macro(MirrorOrigin, double);
  ///@}

  ///@{
  /**
   * Handles with a weight at a point, at most. The largest weights are kept and all weights solved
   * for again within what is left. Default 0: any number.
   */
  void SetMaximumInfluences(int influences);
  vtkGetMacro(MaximumInfluences, int);
  ///@}

  enum PartitionOfUnityMode
  {
    NORMALIZE = 0,
    COUPLED = 1
  };

  ///@{
  /**
   * How rows come to sum to one. NORMALIZE (default): every column is solved for alone, rows are
   * divided by their sums. COUPLED (bounded weights alone): all columns are solved for together
   * with the sums as constraints: the original definition, several times as slow and many times the
   * memory.
   */
  void SetPartitionOfUnity(int mode);
  vtkGetMacro(PartitionOfUnity, int);
  ///@}

  /// How often weights were solved for.
  vtkGetMacro(NumberOfBinds, int);

protected:
  vtkWeightsAlgorithm();
  ~vtkWeightsAlgorithm() override;

  /// Computes the weights of a mesh whose handles are vertices.
  virtual bindpose::Status Solve(const bindpose::WeightsProblem& problem,
    const bindpose::WeightsOptions& options, bindpose::ExecutionContext& context,
    bindpose::WeightsResult& result) = 0;

  /// Whether the weights can have terms.
  virtual bool TakesTerms() const { return false; }

  /// Setters call this: all parameters of these filters belong to the bind.
  void BindModified();
  /// What most setters are.
  template <typename Value>
  void SetBindParameter(Value& parameter, const Value& value)
  {
    if (parameter != value)
    {
      parameter = value;
      this->BindModified();
    }
  }

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

private:
  vtkWeightsAlgorithm(const vtkWeightsAlgorithm&) = delete;
  void operator=(const vtkWeightsAlgorithm&) = delete;

  struct Cache;
  bindpose::Status Bind(
    vtkDataSet* mesh, vtkDataObject* handles, bindpose::ExecutionContext& context, Cache& bound);

  double Tolerance = 1e-6;
  int MaximumIterations = 100;
  int MemoryLimit = 0;
  std::string RegionArrayName = "RegionId";
  int Domain = SURFACE;
  int Stage = CERTIFIED;
  vtkIdType EmbeddingResolution = 0;
  bool KeepMesh = false;
  bool KeepRaw = false;
  double Bounds[2] = { 0.0, 1.0 };
  double MirrorNormal[3] = { 0.0, 0.0, 0.0 };
  double MirrorOrigin[3] = { 0.0, 0.0, 0.0 };
  int MaximumInfluences = 0;
  int PartitionOfUnity = NORMALIZE;
  std::unique_ptr<bindpose::TermArrayNames> TermNames;
  int NumberOfBinds = 0;
  vtkTimeStamp BindTime;
  std::unique_ptr<Cache> Bound;
};

#endif
