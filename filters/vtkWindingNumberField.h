/**
 * @class   vtkWindingNumberField
 * @brief   generalized winding number of a surface on a grid or at given points
 *
 * The winding number is how many times a surface wraps around a point. For a closed surface whose
 * triangles are counter-clockwise seen from outside, it is 1 inside and 0 outside. It is 2 where
 * two such surfaces overlap. Near the holes of an open surface, it changes smoothly between these
 * values. It is defined for any triangles: open, crossing, doubled, non-manifold, or a soup. Only
 * their orientation matters.
 *
 * **Input 0**: the surface, a vtkPointSet with 2D cells (polygons and strips are split into
 * triangles; other cells are ignored and counted). If the input has no 2D cells, its lines are a
 * curve in a plane perpendicular to x, y or z, counter-clockwise around its inside. The field is
 * then the winding number in that plane, and the grid is one sample thick. If the input has no
 * lines either, its points are samples of a surface, with point normals that face outwards and
 * areas (AreaArrayName). Their field is meaningful at distances above about the spacing of the
 * samples (`Report.spacing`).
 * **Input 1** (optional): any vtkDataSet. The field is evaluated at its points, or at its cell
 * centers with SampleCellCenters.
 * **Output 0**: a vtkImageData, or a copy of input 1, with point arrays (or cell arrays)
 * - `WindingNumber`, the active scalars, double or float (OutputPrecision). On the surface the
 *   value is the principal value: 1/2 on a smooth face. At points whose coordinates are not finite,
 *   the value is NaN, with a warning.
 * - `OnSurface`, unsigned char: 1 where a triangle touches the point, else 0.
 * - `Inside` with ComputeInside, unsigned char: 1 where the winding number reaches
 *   WindingThreshold.
 * - `WindingNumberGradient` with ComputeGradient, three components: the gradient of the smooth
 *   part, without the jump at the surface; it is 0 everywhere for a closed surface. The field of
 *   oriented points has no jump; its gradient is large near the points.
 *
 * **Output 1**: the open boundary of the surface, a vtkPolyData with one line for every edge that
 * the triangles use more often in one direction than in the other. The line has the more frequent
 * direction. Its cell arrays are `Multiplicity` (the excess of triangles in this direction over
 * those in the other direction) and `Component`, its point array is `OriginalPointIds`. Its field
 * data arrays have one tuple per connected component of the surface: `ComponentTriangles`,
 * `ComponentOpenEdges` (with multiplicity, 0: closed) and `ComponentVolume` (holes filled by caps;
 * below 0: inside out). The output is empty for curves and points. Surfaces with the same boundary
 * have winding numbers that differ only by integers.
 *
 * The grid covers either Bounds or the bounds of the points used by the surface's 2D cells, padded
 * by Padding times their diagonal. The first of Dimensions, Spacing, TargetNumberOfSamples and
 * Resolution that is set determines the resolution. Voxels are cubes unless Spacing is set, or both
 * Bounds and Dimensions are. The position of the grid depends on the surface, so a request for
 * information updates the input. Sub-extents are supported, and their values have the same bits as
 * in the whole grid. A grid of any size can therefore be computed in parts (vtkImageDataStreamer,
 * pieces).
 *
 * **Methods.** EXACT is exact to round-off (1e-12). FAST keeps the error within Tolerance. Its
 * error bound is in `Report.error_bound`, and its measured error in `Report.measured_error`. AUTO
 * is EXACT for closed surfaces and for those with few open edges, otherwise FAST; `Report.method`
 * and `Report.method_reason` state the choice and its reason. Measured on one core with 90k
 * triangles: a closed surface costs 4 ns per voxel and 40 ns per scattered point. An open surface
 * costs 0.03 to 0.1 us per voxel and 0.1 to 0.2 us per point with FAST at a tolerance of 1e-3. With
 * EXACT it costs 15 ns more per point for every open edge: 20 to 100 us if there are many.
 *
 * The filter builds an acceleration structure for the surface and caches it until the surface,
 * Method, Tolerance or OrientPatches changes. A change of the grid or of the points only needs a
 * new evaluation. FAST also builds again if the number of samples is in another size class (a power
 * of 4), because the structure with the lowest total time depends on the number of samples.
 * GetNumberOfBuilds() counts the builds.
 *
 * Report: method, method_reason, error_bound and measured_error (FAST), builds, counts.{vertices,
 * triangles, boundary_edges, nonmanifold_edges, open_edges, components, merged_vertices,
 * degenerate_triangles, duplicate_triangles, triangulated_cells, ignored_cells, turned_triangles,
 * turned_components, queries, on_surface, not_finite}, volume (by the divergence theorem, holes
 * filled by caps), winding_volume (sum of the samples times a voxel's volume, if the whole grid was
 * requested), seconds.{build, evaluate}.
 *
 * Errors: invalid_input for a surface without 2D cells, with ids out of range or coordinates that
 * are not finite, and for grids that are invalid or do not fit into memory. The message names the
 * cause.
 *
 * @par Thanks:
 * Jacobson, Kavan, Sorkine-Hornung, "Robust Inside-Outside Segmentation using Generalized Winding
 * Numbers", ACM Transactions on Graphics 32(4), 2013. Barill, Dickson, Schmidt, Levin, Jacobson,
 * "Fast Winding Numbers for Soups and Clouds", ACM Transactions on Graphics 37(4), 2018.
 *
 * @sa vtkTetrahedralizeSurface vtkSelectEnclosedPoints
 */

#ifndef vtkWindingNumberField_h
#define vtkWindingNumberField_h

#include "BindposeFiltersModule.h" // for export macro
#include "block_caches.h" // for BlockCaches
#include "vtkBindposeAlgorithm.h"

class vtkPointSet;
class vtkPolyData;

namespace bindpose
{
struct SampleGrid;
} // namespace bindpose

class BINDPOSEFILTERS_EXPORT vtkWindingNumberField : public vtkBindposeAlgorithm
{
public:
  static vtkWindingNumberField* New();
  vtkTypeMacro(vtkWindingNumberField, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Methods of computation; see Methods in the class documentation.
  enum MethodType
  {
    AUTO = 0,
    EXACT = 1,
    FAST = 2
  };

  ///@{
  /// Method of computation: AUTO (default), EXACT or FAST.
  vtkSetClampMacro(Method, int, AUTO, FAST);
  vtkGetMacro(Method, int);
  void SetMethodToAuto() { this->SetMethod(AUTO); }
  void SetMethodToExact() { this->SetMethod(EXACT); }
  void SetMethodToFast() { this->SetMethod(FAST); }
  ///@}

  ///@{
  /// FAST: largest allowed error. Must be 1e-8 to 0.1; default 1e-3.
  vtkSetClampMacro(Tolerance, double, 1e-8, 0.1);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Repair the orientation before all other steps; default off. In each patch of connected
   * triangles the smaller part is flipped, so that neighbors are consistent. Then closed components
   * that are inside out are flipped. The input does not change. counts.turned_triangles and
   * counts.turned_components are the numbers of flipped triangles and components.
   */
  vtkSetMacro(OrientPatches, bool);
  vtkGetMacro(OrientPatches, bool);
  vtkBooleanMacro(OrientPatches, bool);
  ///@}

  ///@{
  /// Name of the point array with the areas of oriented points; default "Area". If it is missing,
  /// the areas are estimated.
  void SetAreaArrayName(const std::string& name)
  {
    if (this->AreaArrayName != name)
    {
      this->AreaArrayName = name;
      this->Modified();
    }
  }
  std::string GetAreaArrayName() { return this->AreaArrayName; }
  ///@}

  ///@{
  /// Numbers of samples along x, y, z. Each must be at least 1. If all are 0 (default), another
  /// option determines the numbers.
  vtkSetVector3Macro(Dimensions, int);
  vtkGetVector3Macro(Dimensions, int);
  ///@}

  ///@{
  /// Distances between samples along x, y, z, in world units. Each must be above 0. If all are 0
  /// (default), another option determines the distances.
  vtkSetVector3Macro(Spacing, double);
  vtkGetVector3Macro(Spacing, double);
  ///@}

  ///@{
  /// Maximum number of samples. Must be at least 8. The voxels are cubes, as small as this maximum
  /// allows. If the maximum is 0 (default), Resolution determines the grid.
  vtkSetClampMacro(TargetNumberOfSamples, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(TargetNumberOfSamples, vtkIdType);
  ///@}

  ///@{
  /// Number of samples along the grid's longest side, at least 2; default 64.
  vtkSetClampMacro(Resolution, int, 2, VTK_INT_MAX);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * Box that the grid covers: xmin, xmax, ymin, ymax, zmin, zmax, in world units. Empty (a lower
   * end above its upper end, the default): the padded bounds of the surface.
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}

  ///@{
  /// Distance that is added on each side of the surface's bounds, as a fraction of the diagonal of
  /// the bounds. Must be 0 to 1000; default 0.1. Not used with Bounds.
  vtkSetClampMacro(Padding, double, 0.0, 1000.0);
  vtkGetMacro(Padding, double);
  ///@}

  ///@{
  /// Input 1: points at which to evaluate the field. Without input 1, the field is evaluated on a
  /// grid.
  void SetPointsConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetPointsData(vtkDataSet* data);
  ///@}

  ///@{
  /// Evaluate at the centers of input 1's cells instead of at its points; default off.
  vtkSetMacro(SampleCellCenters, bool);
  vtkGetMacro(SampleCellCenters, bool);
  vtkBooleanMacro(SampleCellCenters, bool);
  ///@}

  ///@{
  /// Add the array `WindingNumberGradient`: derivatives of the winding number along x, y, z per
  /// world unit. Default off.
  vtkSetMacro(ComputeGradient, bool);
  vtkGetMacro(ComputeGradient, bool);
  vtkBooleanMacro(ComputeGradient, bool);
  ///@}

  ///@{
  /// Add the array `Inside`; default off.
  vtkSetMacro(ComputeInside, bool);
  vtkGetMacro(ComputeInside, bool);
  vtkBooleanMacro(ComputeInside, bool);
  ///@}

  ///@{
  /// Winding number at or above which the array `Inside` is 1; default 0.5.
  vtkSetMacro(WindingThreshold, double);
  vtkGetMacro(WindingThreshold, double);
  ///@}

  ///@{
  /// Type of the values: vtkAlgorithm::DOUBLE_PRECISION (default; DEFAULT_PRECISION means the same)
  /// or SINGLE_PRECISION. The values are always computed in double precision.
  vtkSetClampMacro(OutputPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPrecision, int);
  ///@}

  /// Return the port of the query points if it is connected. Otherwise return -1; pieces of the
  /// output are then sub-extents of the grid.
  int GetPiecePort() override { return this->GetNumberOfInputConnections(1) > 0 ? 1 : -1; }

  /// Return the open boundary of the surface: output 1.
  vtkPolyData* GetBoundaryOutput();

  /// Number of acceleration structures that were built so far. Evaluations that reuse the cached
  /// structure do not change the number.
  vtkGetMacro(NumberOfBuilds, int);

protected:
  vtkWindingNumberField();
  ~vtkWindingNumberField() override;

  bool MakesPieces() override { return this->GetPiecePort() < 0; }
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkWindingNumberField(const vtkWindingNumberField&) = delete;
  void operator=(const vtkWindingNumberField&) = delete;

  /// Compute the whole grid from the options and the input.
  bindpose::Status Grid(vtkPointSet* input, bindpose::SampleGrid& grid);
  /// Compute the contents of BuildCache unless they are still valid.
  /// @param points points of the queries, nullptr for a grid
  bindpose::Status Build(
    bindpose::ExecutionContext& context, vtkPointSet* input, vtkDataSet* points, long long queries);

  int Method = AUTO;
  double Tolerance = 1e-3;
  bool OrientPatches = false;
  std::string AreaArrayName = "Area";
  int Dimensions[3] = { 0, 0, 0 };
  double Spacing[3] = { 0.0, 0.0, 0.0 };
  vtkIdType TargetNumberOfSamples = 0;
  int Resolution = 64;
  double Bounds[6] = { 0.0, -1.0, 0.0, -1.0, 0.0, -1.0 };
  double Padding = 0.1;
  bool SampleCellCenters = false;
  bool ComputeGradient = false;
  bool ComputeInside = false;
  double WindingThreshold = 0.5;
  int OutputPrecision = DOUBLE_PRECISION;
  int NumberOfBuilds = 0;
  struct Cache;
  bindpose::BlockCaches<Cache> BuildCache;
};

#endif
