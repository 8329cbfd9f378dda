/**
 * @class   vtkWeightsAlgorithm
 * @brief   base class of the filters that compute weights: ports, arrays and bind cache
 *
 * The weight of a handle at a vertex is the fraction of the handle's motion that the vertex
 * follows. The subclasses compute bounded biharmonic, monotone and unconstrained weights.
 *
 * **Input 0**: the mesh, a vtkUnstructuredGrid of tets (of positive volume) or a triangle surface
 * (vtkPolyData or grid with 2D cells; polygons are split for the computation).
 * **Input 1**: the handles, a vtkPolyData (see filters/README.md): points, bones and regions, at
 * any position. Regions need an integer point array of labels on the mesh (RegionArrayName).
 * **Output**: input 0 with the double point array `Weights`, with one component per handle, named
 * after the handle. Rows (one per point) sum to one. Handles that are not at vertices become
 * vertices: the cells around them are split and new points are added after the mesh's own points.
 * Point arrays are interpolated. Integer labels are not interpolated: a new point gets the label of
 * the surrounding points if they all have the same label, and 0 otherwise. The OriginalPointIds of
 * a new point is -1. The output then contains only tets or triangles. With KeepMesh on, the mesh
 * does not change, and the corners of the cell that contains a handle represent the handle.
 *
 * **Output 1**: local extrema of the weights before normalization (division of each row by its
 * sum). Only extrema away from handles and with a persistence above 1e-3 are listed. The output is
 * a vtkPolyData with one vertex per extremum and the point arrays `Kind` (1 maximum, -1 minimum),
 * `Handle` (column), `Value` and `Persistence` (fraction of the column's range).
 * **Output 2**: the tets on which a surface's weights were solved, with `Weights` and the arrays of
 * vtkTetrahedralizeSurface. It is empty if the weights were solved on the mesh itself (see Domain).
 *
 * KeepRaw adds the point array `RawWeights`: the weights before normalization. The certificate
 * applies to this array. Its rows need not sum to one.
 *
 * **Terms** are additional constraints and energies of bounded and monotone weights. They are point
 * arrays of the mesh with the names below. All are optional; an empty name disables the array.
 * vtkUnconstrainedWeights has no terms.
 * - `Rigidity`, >= 0: weights are nearly constant where the rigidity is large. The value 1 stiffens
 *   all features longer than a hundredth of the mesh's diagonal, for any unit and resolution;
 *   gradients decrease with 1 / rigidity. The term adds 1/2 int rho |grad w|^2 to the energy, where
 *   rho is 1e4 / diagonal^2 times the rigidity.
 * - `RigidSet`, integers: every weight is exactly constant on the points with the same label > 0. A
 *   set that contains a point of a handle gets the weights of that point.
 * - `WeightsLower`, `WeightsUpper`, one component per handle: smallest and largest weight at each
 *   point. NaN means the bounds of the handle, in the handles' cell array `WeightBounds` (two
 *   components). If that array is missing or NaN, the bounds of SetBounds() are used. All bounds
 *   apply to RawWeights. Normalization can violate the bounds (report:
 *   normalized_bounds_violation); PartitionOfUnity COUPLED does not violate them.
 * - `PinnedWeights`, one component per handle: prescribed weights; NaN: not prescribed.
 *   Normalization does not change prescribed weights; it scales only the other weights of the row.
 * - `SymmetricPoint`, the id of each point's mirror point, or -1: two handles a and b that are
 *   mirror images of each other get weights w_a(v) = w_b(mirror of v). The symmetry is exact: it is
 *   a constraint of the minimization. SetMirrorNormal() is an alternative to this array. Points
 *   without a mirror point, and handles whose mirror image is not a handle, are not affected.
 *
 * If the weights of a surface are solved in tets of its inside, each tet has the rigidity of the
 * nearest position of the surface. All other terms apply to the surface's own points only. A
 * lattice (EMBEDDING) supports no terms; AUTO uses the volume if there are terms. Previews ignore
 * terms.
 *
 * The **certificate** of optimality is stored in field data arrays, one value per column. It
 * applies to the weights before normalization: `WeightsRelativeGap` (upper bound of the relative
 * distance of the energy from its minimum), `WeightsKKTResidual`, `WeightsMinimum`,
 * `WeightsMaximum`, `WeightsInteriorExtrema` (local extrema away from handles with a persistence
 * above 1e-3), and `WeightsRowSumError`.
 *
 * Vertices that belong to no cell get rows of zeros. In this case, and only then, the output has
 * the unsigned char point array `WeightsMask`, which is 0 at these vertices. A connected component
 * without a handle gets the weights of the nearest handle, with a warning. On a lattice such a
 * component is linked to the components that it touches, or to the nearest component, and gets
 * their weights. Handles outside of the mesh are moved to its nearest point, with a warning.
 *
 * **Bind cache.** The weights are cached. They are solved again only after a change of the mesh's
 * points, cells or labels, of the handles' rest data (points, cells, names, kinds) or of this
 * filter's parameters. Editing Transform, Mode, Stretch or Twist of the handles does not solve
 * again; the output then has the same array objects. GetNumberOfBinds() counts the solves.
 *
 * Report: method, binds, stage (of previews), counts.{vertices, tets | triangles, handles,
 * components, inserted_vertices}, handles[].{name, kind, constrained_vertices, distance_outside,
 * relative_gap, kkt_residual, energy, iterations, factorizations, interior_extrema}, relative_gap
 * and kkt_residual (of the worst column), bounds_violation, normalized_bounds_violation (with
 * bounds), counts.capped_vertices and influences.{largest_difference, rms_difference} (differences
 * from the weights without MaximumInfluences), partition.{of_unity, energy, largest_difference,
 * rms_difference} (COUPLED; differences from mode NORMALIZE),
 * counts.{covered_openings, linked_parts, links} (on a lattice: openings that other parts cover,
 * components without a handle, and links of both),
 * handles[].mirror (with mirrors), row_sum_error, largest_snap (in edge lengths), iterations,
 * memory_estimate_bytes (estimated peak memory of the process, computed before the factorizations;
 * for bounded and monotone weights), seconds.{insert, analyze, weights}, and seconds.{factor,
 * solve}, which are sums over handles that are solved in parallel.
 *
 * The status is not_converged (with the result) if a column does not reach Tolerance within
 * MaximumIterations. Errors: an empty or invalid mesh, tets without volume, no handles, two handles
 * at the same position, a region whose label no vertex has, not enough memory, terms that
 * contradict a handle or each other (the message names handle and point).
 */

#ifndef vtkWeightsAlgorithm_h
#define vtkWeightsAlgorithm_h

#include "BindposeFiltersModule.h" // for export macro
#include "block_caches.h" // for BlockCaches
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
   * Largest accepted relative gap and residual of a column. Must be above 0 and below 1. Default
   * 1e-6; 1e-9 is strict. All parameters of this class are bind parameters: a change computes the
   * weights again.
   */
  void SetTolerance(double tolerance);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /// Maximum number of iterations per column, at least 1. Default 100. Each iteration needs one
  /// factorization; 1 to 20 iterations are usual.
  void SetMaximumIterations(int iterations);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * Memory limit of the whole process in MiB; 0 (default): the available memory of the machine. A
   * computation that needs more is refused before the factorization, with a message that states the
   * limit and the required memory. If the memory is too small for one factor per thread, fewer
   * threads are used. Changing the limit keeps cached weights.
   */
  vtkSetClampMacro(MemoryLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(MemoryLimit, int);
  ///@}

  ///@{
  /// Name of the mesh's point array of region labels; points with label 0 belong to no region.
  /// Default "RegionId".
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
   * Domain on which the weights of a surface are solved. SURFACE (default): its triangles. VOLUME:
   * conforming tets of its inside. EMBEDDING: a lattice that contains the surface, which takes
   * seconds for any size. CAGE: the closed cage that the handles form around the surface. AUTO
   * solves a flat shape on its triangles, and a closed, clean surface in its volume if a prediction
   * finds that this problem is well conditioned and cheap. AUTO solves all other surfaces in the
   * embedding. If the solve on the triangles or in the volume fails, AUTO also uses the embedding,
   * with a warning. AUTO therefore returns certified weights for every surface that a lattice can
   * represent. Output 0 is the input surface with Weights at its own points, and output 2 is the
   * mesh on which the weights were solved. The option has no effect on meshes of tets, which are
   * solved directly. Values out of range are clamped.
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
   * PREVIEW: clamped biharmonic weights for any method, computed in the time of one factorization
   * or less. The certificate measures their distance from bounded biharmonic weights. CERTIFIED
   * (the default): the weights of the method. Values out of range are clamped.
   */
  void SetStage(int stage);
  vtkGetMacro(Stage, int);
  void SetStageToCertified() { this->SetStage(CERTIFIED); }
  void SetStageToPreview() { this->SetStage(PREVIEW); }
  ///@}

  /// Event that is invoked once while CERTIFIED weights are computed, if the event has an observer.
  /// It is invoked on the thread that updates the filter. The call data is a vtkDoubleArray of the
  /// preview's weights at the input's points.
  enum
  {
    PreviewEvent = vtkCommand::UserEvent + 4201
  };

  ///@{
  /// For EMBEDDING and AUTO: number of lattice cubes along the longest side, 6 to 1000; 0
  /// (default): automatic. Automatic means: up to three lattices of increasing resolution are
  /// solved, until the weights of two successive lattices agree.
  void SetEmbeddingResolution(vtkIdType resolution);
  vtkGetMacro(EmbeddingResolution, vtkIdType);
  ///@}

  ///@{
  /// Off (the default): insert a vertex at each handle that is not at a vertex, and split the cells
  /// around the new vertex. On: insert no vertices, so that the output has the points and cells of
  /// the mesh. The corners of the cell that contains a handle then represent the handle.
  void SetKeepMesh(bool keep);
  vtkGetMacro(KeepMesh, bool);
  vtkBooleanMacro(KeepMesh, bool);
  ///@}

  ///@{
  /// Add the point array RawWeights: the weights before normalization (division of each row by its
  /// sum). Default off.
  void SetKeepRaw(bool keep);
  vtkGetMacro(KeepRaw, bool);
  vtkBooleanMacro(KeepRaw, bool);
  ///@}

  ///@{
  /**
   * Names of the mesh's point arrays of terms; see Terms in the class documentation. Defaults:
   * Rigidity, RigidSet, WeightsLower, WeightsUpper, PinnedWeights, SymmetricPoint.
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
   * Smallest and largest weight of every handle for which no array specifies bounds; default 0 and
   * 1. At the handles themselves weights are 0 or 1, so the range must contain 0 and 1.
   */
  void SetBounds(double smallest, double largest);
  vtkGetVector2Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * Normal of a mirror plane through MirrorOrigin, an alternative to the array SymmetricPoint.
   * Default 0 0 0: no mirror.
   */
  void SetMirrorNormal(double x, double y, double z);
  vtkGetVector3Macro(MirrorNormal, double);
  void SetMirrorOrigin(double x, double y, double z);
  vtkGetVector3Macro(MirrorOrigin, double);
  ///@}

  ///@{
  /**
   * Maximum number of handles with a nonzero weight at a point. The largest weights are kept, and
   * all weights are solved again with the others constrained to zero. Default 0: no limit.
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
   * Method of making rows sum to one. NORMALIZE (default): every column is solved separately, then
   * each row is divided by its sum. COUPLED (bounded weights only): all columns are solved together
   * with the row sums as constraints, as in the original definition (Jacobson et al. 2011). This
   * takes several times as long and many times the memory.
   */
  void SetPartitionOfUnity(int mode);
  vtkGetMacro(PartitionOfUnity, int);
  ///@}

  /// Number of times that the weights were solved.
  vtkGetMacro(NumberOfBinds, int);

protected:
  vtkWeightsAlgorithm();
  ~vtkWeightsAlgorithm() override;

  /// Compute the weights on a mesh in which the handles are vertices.
  virtual bindpose::Status Solve(bindpose::ExecutionContext& context,
    const bindpose::WeightsProblem& problem, const bindpose::WeightsOptions& options,
    bindpose::WeightsResult& result) = 0;

  /// Report whether the method supports terms, i.e. the optional constraints and energies of
  /// TermArrayNames.
  virtual bool TakesTerms() const { return false; }

  /// Mark a parameter as modified; called by setters. All parameters of these filters are bind
  /// parameters.
  void BindModified();
  /// Set a bind parameter, and mark it as modified if its value changes. Most setters call this
  /// function.
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
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkWeightsAlgorithm(const vtkWeightsAlgorithm&) = delete;
  void operator=(const vtkWeightsAlgorithm&) = delete;

  struct Cache;
  bindpose::Status Bind(
    bindpose::ExecutionContext& context, vtkDataSet* mesh, vtkDataObject* handles, Cache& bound);

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
  bindpose::BlockCaches<Cache> BindCache;
};

#endif
