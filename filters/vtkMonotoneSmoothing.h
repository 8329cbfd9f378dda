/**
 * @class   vtkMonotoneSmoothing
 * @brief   smooths data on a mesh and leaves the extrema that are asked for, no other
 *
 * Topological simplification: of all functions whose only local extrema are the given ones, the one
 * that is smooth and near to the data: the least of int |k-harmonic derivative of w|^2 + DataWeight
 * int (w - data)^2, on the mesh scaled to size 1 and data scaled to a range of 1, so that units,
 * place and turn of both do not show.
 *
 * **Input**: tets (of positive volume) or a triangle surface, as of vtkWeightsAlgorithm, with a
 * point array of one component: the active scalars, or what SetInputArrayToProcess(0, 0, 0,
 * vtkDataObject::FIELD_ASSOCIATION_POINTS, name) says.
 *
 * **Which extrema**: those of the point array `Extrema` (above 0 a maximum, below 0 a minimum, 0
 * neither; see SetExtremaArrayName) where the mesh has it; else those of the data that are more
 * persistent than Persistence, or the NumberOfExtrema most persistent ones. Every connected part
 * needs a maximum and a minimum; a part where the list has none becomes constant, with a warning.
 *
 * With KeepValues the extrema keep the data's values. A DataWeight of 0 leaves nothing of the data
 * but these: the smoothest function with such extrema through such values. That is the way to
 * weights with extrema of one's own choice (those of vtkMonotoneWeights have their maximum on one
 * handle and their minima on the others).
 *
 * **Output**: input 0 with the double point array `Smoothed` (SetResultArrayName), the active
 * scalars, and `SmoothedExtrema`, the list that was used (signed chars), which can be edited and
 * given back. Field data: `SmoothedRelativeGap` and `SmoothedKKTResidual`, the certificate of the
 * quadratic program. **Output 1**: its local extrema (vtkPolyData, a vertex each): point arrays
 * `Kind` (1 maximum, -1 minimum), `Value`, `DataValue`, `Persistence` (share of the range),
 * `PointId`, `Listed` (0: an extremum with a persistence above 1e-3 that is not in the list; there
 * is none).
 *
 * Points in no cell that has a size keep their data. Constant data stay as they are, with a
 * warning.
 *
 * Report: method, extrema_from (list, persistence or count), counts.{vertices, components, maxima,
 * minima, data_extrema (with a persistence above 1e-3), floods}, interior_extrema (not in the
 * list), relative_gap, kkt_residual, order_violation, iterations, energy.{total, smoothness, data},
 * rounds[].energy, data_length (detail finer than about six times this goes, in the mesh's unit),
 * largest_difference and rms_difference to the data, extrema[].{vertex, kind, value, data,
 * persistence}. Errors: no array, one with several components or with values that are not finite, a
 * list without a maximum or minimum in a connected part, kept values that no such function can
 * have. NOT_CONVERGED when the certificate is not reached.
 *
 * Cost: 15 to 30 factorisations of the energy, for each rebuild again.
 *
 * @par Thanks:
 * Jacobson, Weinkauf, Sorkine, "Smooth Shape-Aware Functions with Controlled Extrema", Computer
 * Graphics Forum 31(5), 2012. Tierny, Pascucci, "Generalized Topological Simplification of Scalar
 * Fields on Surfaces", IEEE TVCG 18(12), 2012.
 *
 * @sa vtkMonotoneWeights
 */

#ifndef vtkMonotoneSmoothing_h
#define vtkMonotoneSmoothing_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkMonotoneSmoothing : public vtkBindposeAlgorithm
{
public:
  static vtkMonotoneSmoothing* New();
  vtkTypeMacro(vtkMonotoneSmoothing, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Order k of the energy: 2 biharmonic (default), 3 triharmonic.
  vtkSetClampMacro(Order, int, 2, 3);
  vtkGetMacro(Order, int);
  ///@}

  ///@{
  /**
   * How faithful to be, 0 and more: detail finer than about six times DataWeight^(-1 / 2 k) of the
   * mesh's size is smoothed away; that is 0.03 for the default 1e6 and k = 2, 0.1 for k = 3. The
   * size is sqrt(12) times the root mean square distance from the centroid, a box's diagonal. 0:
   * see above.
   */
  vtkSetMacro(DataWeight, double);
  vtkGetMacro(DataWeight, double);
  ///@}

  ///@{
  /// Name of the point array of extrema, "Extrema" by default; empty: not looked for.
  void SetExtremaArrayName(const std::string& name);
  std::string GetExtremaArrayName() { return this->ExtremaArrayName; }
  ///@}

  ///@{
  /// Without a list: extrema of the data whose persistence is a larger share of the data's range
  /// stay. From 0 to below 1, default 0.05.
  vtkSetMacro(Persistence, double);
  vtkGetMacro(Persistence, double);
  ///@}

  ///@{
  /// Without a list: so many of the most persistent extrema stay, at least a maximum and a minimum
  /// of each connected part. Default 0: by Persistence.
  vtkSetMacro(NumberOfExtrema, vtkIdType);
  vtkGetMacro(NumberOfExtrema, vtkIdType);
  ///@}

  ///@{
  /// Extrema keep the data's values. Default off: they are found, too.
  vtkSetMacro(KeepValues, bool);
  vtkGetMacro(KeepValues, bool);
  vtkBooleanMacro(KeepValues, bool);
  ///@}

  enum GuideType
  {
    UNCONSTRAINED = 0,
    HARMONIC = 1
  };

  ///@{
  /**
   * What says which way the result rises. UNCONSTRAINED (default): the smooth function without any
   * order, freed from other extrema: nearest to the data. HARMONIC: the harmonic function with the
   * extrema as boundary values, which knows nothing of the data between them.
   */
  vtkSetClampMacro(Guide, int, 0, 1);
  vtkGetMacro(Guide, int);
  ///@}

  ///@{
  /// How often the way it rises is taken anew from the result and solved for again; ends early
  /// where that gains nothing. The energy never rises. 0 and more, default 1.
  vtkSetMacro(Rebuilds, int);
  vtkGetMacro(Rebuilds, int);
  ///@}

  ///@{
  /// By which share of the data's range each point is at least above a lower and below a higher
  /// neighbour, 0 to 1. Default 0; above it extrema are strict.
  vtkSetMacro(Epsilon, double);
  vtkGetMacro(Epsilon, double);
  ///@}

  ///@{
  /// Largest relative gap and residual, above 0 and below 1. Default 1e-6; 1e-9 is tight.
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /// Iterations of each solve. Default 100.
  vtkSetMacro(MaximumIterations, int);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /// MiB that the whole process may hold; 0 (default): as much as the machine has available. What
  /// would take more is refused before it is factored.
  vtkSetClampMacro(MemoryLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(MemoryLimit, int);
  ///@}

  ///@{
  /// Name of the array that is made. Default "Smoothed".
  void SetResultArrayName(const std::string& name);
  std::string GetResultArrayName() { return this->ResultArrayName; }
  ///@}

protected:
  vtkMonotoneSmoothing();
  ~vtkMonotoneSmoothing() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

private:
  vtkMonotoneSmoothing(const vtkMonotoneSmoothing&) = delete;
  void operator=(const vtkMonotoneSmoothing&) = delete;

  int Order = 2;
  double DataWeight = 1e6;
  std::string ExtremaArrayName = "Extrema";
  double Persistence = 0.05;
  vtkIdType NumberOfExtrema = 0;
  bool KeepValues = false;
  int Guide = UNCONSTRAINED;
  int Rebuilds = 1;
  double Epsilon = 0.0;
  double Tolerance = 1e-6;
  int MaximumIterations = 100;
  int MemoryLimit = 0;
  std::string ResultArrayName = "Smoothed";
};

#endif
