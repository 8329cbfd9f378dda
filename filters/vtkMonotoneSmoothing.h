/**
 * @class   vtkMonotoneSmoothing
 * @brief   smooths data on a mesh and keeps only the selected local extrema
 *
 * Topological simplification: the filter selects a list of extrema. Among all functions w whose
 * only local extrema are those of the list, it computes a smooth function near the data. This
 * function minimizes E(w) + DataWeight * (integral of (w - data)^2), where E is the biharmonic or
 * triharmonic energy (see Order). Internally the mesh is scaled to size 1 and the data to a range
 * of 1. Therefore the result does not depend on units, or on the position and rotation of the mesh.
 *
 * **Input**: tets (of positive volume) or a triangle surface, as for vtkWeightsAlgorithm, with a
 * point array of one component: the active scalars, or the array set by SetInputArrayToProcess(0,
 * 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name).
 *
 * **List of extrema**: the point array `Extrema` (above 0 a maximum, below 0 a minimum, 0 neither;
 * see SetExtremaArrayName) if the mesh has it. Otherwise the list contains the extrema of the data
 * whose persistence is above Persistence, or the NumberOfExtrema most persistent ones. A connected
 * component must have at least one listed maximum and one listed minimum, or no listed extremum. A
 * component without listed extrema becomes constant, with a warning.
 *
 * With KeepValues the extrema keep the data's values. With a DataWeight of 0 only these values
 * matter: the result is the smoothest function with the listed extrema and values. This gives
 * weights with arbitrary extrema. (A weight of vtkMonotoneWeights, in contrast, has its maximum on
 * one handle and its minima on the other handles.)
 *
 * **Output**: input 0 with the double point array `Smoothed` (SetResultArrayName), the active
 * scalars, and `SmoothedExtrema`, the list that was used. This array (signed chars) can be edited
 * and used as the input array `Extrema`. Field data: `SmoothedRelativeGap` and
 * `SmoothedKKTResidual`, the optimality certificate of the quadratic program (duality gap and
 * residual). **Output 1**: the local extrema of the result (vtkPolyData, one vertex per extremum):
 * point arrays `Kind` (1 maximum, -1 minimum), `Value`, `DataValue`, `Persistence` (fraction of the
 * range), `PointId`, `Listed` (1: in the list; 0: not in the list). The order constraints exclude
 * extrema that are not in the list; if one has a persistence above 1e-3, it is output nevertheless.
 *
 * Points that belong only to cells without area or volume keep their data. Constant data do not
 * change, with a warning.
 *
 * Report: method, extrema_from (list, persistence or count), counts.{vertices, components, maxima,
 * minima, data_extrema (with a persistence above 1e-3), floods (passes of the algorithm that finds
 * the order constraints)}, interior_extrema (not in the list), relative_gap, kkt_residual,
 * order_violation, iterations, energy.{total, smoothness, data}, rounds[].energy, data_length
 * (detail finer than about six times this length is removed; in the mesh's unit),
 * largest_difference and rms_difference to the data, extrema[].{vertex, kind, value, data,
 * persistence}. Errors: no array, an array with several components or with values that are not
 * finite, a list without a maximum or minimum in a connected component, values at extrema
 * (KeepValues) that no function with the listed extrema can have. The status is NOT_CONVERGED if
 * the certificate exceeds Tolerance.
 *
 * Cost: 15 to 30 factorizations of the energy's matrix, and again 15 to 30 for each rebuild.
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
   * Weight (>= 0) of the data term relative to the smoothness. Detail finer than about six data
   * lengths is smoothed away. The data length is DataWeight^(-1 / (2 Order)) times the size of the
   * mesh. With the default DataWeight of 1e6, the factor is 0.03 for Order 2 and 0.1 for Order 3.
   * The size is sqrt(12) times the root mean square distance from the centroid; for a box it equals
   * the diagonal. For a DataWeight of 0 see the class documentation.
   */
  vtkSetMacro(DataWeight, double);
  vtkGetMacro(DataWeight, double);
  ///@}

  ///@{
  /// Name of the point array with the list of extrema. Default "Extrema". If the name is empty, no
  /// such array is used.
  void SetExtremaArrayName(const std::string& name);
  std::string GetExtremaArrayName() { return this->ExtremaArrayName; }
  ///@}

  ///@{
  /// Threshold that is used if the mesh has no point array of extrema (see ExtremaArrayName):
  /// extrema of the data are kept if their persistence exceeds this fraction of the data's range.
  /// At least 0 and below 1, default 0.05.
  vtkSetMacro(Persistence, double);
  vtkGetMacro(Persistence, double);
  ///@}

  ///@{
  /// Number of extrema that are kept if the mesh has no point array of extrema (see
  /// ExtremaArrayName): the most persistent ones, and at least a maximum and a minimum per
  /// connected component. Default 0: use Persistence.
  vtkSetMacro(NumberOfExtrema, vtkIdType);
  vtkGetMacro(NumberOfExtrema, vtkIdType);
  ///@}

  ///@{
  /// Constrain extrema to the data's values. Default off: the values at extrema are unknowns too.
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
   * Guide function, which determines the direction in which the result increases along each edge.
   * UNCONSTRAINED (default): the minimizer without order constraints, after the removal of all
   * extrema that are not in the list. This guide is nearest to the data. HARMONIC: the harmonic
   * function with the extrema as boundary values, which does not depend on the data between them.
   */
  vtkSetClampMacro(Guide, int, 0, 1);
  vtkGetMacro(Guide, int);
  ///@}

  ///@{
  /// Number of rebuilds, >= 0, default 1. A rebuild derives the order constraints from the result
  /// and solves again. Rebuilding ends early if it does not lower the energy. The energy never
  /// increases.
  vtkSetMacro(Rebuilds, int);
  vtkGetMacro(Rebuilds, int);
  ///@}

  ///@{
  /// Minimum difference that each order constraint requires between two neighboring points, as a
  /// fraction (0 to 1) of the data's range. Default 0. If Epsilon is above 0, the extrema are
  /// strict.
  vtkSetMacro(Epsilon, double);
  vtkGetMacro(Epsilon, double);
  ///@}

  ///@{
  /// Tolerance (above 0, below 1): largest accepted relative duality gap and KKT residual of the
  /// optimality certificate. Default 1e-6; 1e-9 is strict.
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /// Maximum number of iterations per solve. Default 100.
  vtkSetMacro(MaximumIterations, int);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /// Memory limit of the whole process in MiB; 0 (default): the available memory of the machine. A
  /// computation that needs more is refused before the factorization.
  vtkSetClampMacro(MemoryLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(MemoryLimit, int);
  ///@}

  ///@{
  /// Name of the result array. Default "Smoothed".
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
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

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
