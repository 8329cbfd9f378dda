/**
 * @class   vtkWindingNumberField
 * @brief   generalized winding number of a surface on a grid or at given points
 *
 * The winding number tells how many times a surface wraps around a point: 1 inside and 0 outside a
 * closed surface whose triangles turn counter-clockwise seen from outside, 2 where two such
 * surfaces overlap, and a smooth number in between near the holes of an open one. It is defined for
 * any triangles: open, crossing, doubled, non-manifold, a soup. Only their orientation counts.
 *
 * **Input 0**: the surface, a vtkPointSet with 2D cells (polygons and strips are split into
 * triangles; other cells are ignored and counted). Without 2D cells its lines are a curve in a
 * plane across x, y or z, counter-clockwise around its inside; the field is that of the plane, and
 * the grid one sample thick. Without lines its points are samples of a surface, with point normals
 * that face outwards and areas (AreaArrayName): a field that means something from about a sample's
 * spacing on (`Report.spacing`).
 * **Input 1** (optional): any vtkDataSet, at whose points, or cell centers with SampleCellCenters,
 * the field is evaluated.
 * **Output 0**: a vtkImageData, or a copy of input 1, with point arrays (cell arrays)
 * - `WindingNumber`, the active scalars, double or float (OutputPrecision). On the surface the
 *   principal value: 1/2 on a smooth face. NaN, and a warning, where coordinates are not finite.
 * - `OnSurface`, unsigned char: 1 where a triangle touches the point, else 0.
 * - `Inside` with ComputeInside, unsigned char: 1 where the winding number is at least WindingThreshold.
 * - `WindingNumberGradient` with ComputeGradient, three components: that of the smooth part, the
 *   jump across the surface left out; 0 everywhere for a closed surface. That of oriented points
 *   has no jump: it is large where they are near.
 *
 * **Output 1**: where the surface is open, a vtkPolyData with one line for every edge whose
 * triangles' directions do not cancel, along that direction; cell arrays `Multiplicity` (by how
 * many triangles they are more than those the other way) and `Component`, point array
 * `OriginalPointIds`. Its field data has a tuple for each connected component of the surface:
 * `ComponentTriangles`, `ComponentOpenEdges` (by multiplicity, 0: closed) and `ComponentVolume`
 * (holes filled by caps; below 0: inside out). Empty for curves and points. Winding numbers depend
 * on this boundary alone, but for whole numbers.
 *
 * The grid covers the surface's bounds (of the points that its 2D cells use), padded by Padding
 * times their diagonal, or Bounds. How fine it is: Dimensions, else Spacing, else
 * TargetNumberOfSamples, else Resolution. Voxels are cubes unless Spacing, or both
 * Bounds and Dimensions, say otherwise. Its place depends on the surface, so asking for information
 * updates the input. Sub-extents are honoured, with the same bits as in the whole, so that a grid
 * of any size can be had in parts (vtkImageDataStreamer, pieces).
 *
 * **Methods.** EXACT is exact to round-off (1e-12). FAST keeps within Tolerance, says so in
 * `Report.error_bound`, and what it measured against exact values in `Report.measured_error`. AUTO
 * is exact for closed surfaces and for those with few open edges, else FAST; `Report.method` and
 * `Report.method_reason` tell what was taken and why. Measured on one core, 90k triangles: a
 * closed surface costs 4 ns a voxel and 40 ns a scattered point; an open one, FAST at 1e-3, 0.03 to
 * 0.1 us a voxel and 0.1 to 0.2 us a point; EXACT 15 ns more a point for every open edge, 20 to
 * 100 us when those are many.
 *
 * The filter builds a structure for the surface and keeps it until the surface or one of Method,
 * Tolerance and OrientPatches changes; another grid or other points are only evaluated. FAST also
 * builds again for a number of samples of another size class (a power of 4), because the structure
 * that takes the least time in total depends on it. GetNumberOfBuilds() counts.
 *
 * Report: method, method_reason, error_bound and measured_error (FAST), builds, counts.{vertices,
 * triangles, boundary_edges, nonmanifold_edges, open_edges, components, merged_vertices,
 * degenerate_triangles, duplicate_triangles, triangulated_cells, ignored_cells, turned_triangles,
 * turned_components, queries, on_surface, not_finite}, volume (by the divergence theorem, holes
 * filled by caps), winding_volume (sum of the samples times a voxel's volume, when the whole grid
 * was asked for), seconds.{build, evaluate}.
 *
 * Errors: invalid_input for a surface without 2D cells, with ids out of range or coordinates that
 * are not finite, for grids that make no sense or do not fit into memory; the message names what is
 * wrong.
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
#include "vtkBindposeAlgorithm.h"
#include <memory> // for std::unique_ptr

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

  /// Ways to compute; see above.
  enum MethodType
  {
    AUTO = 0,
    EXACT = 1,
    FAST = 2
  };

  ///@{
  /// AUTO (default), EXACT or FAST.
  vtkSetClampMacro(Method, int, AUTO, FAST);
  vtkGetMacro(Method, int);
  void SetMethodToAuto() { this->SetMethod(AUTO); }
  void SetMethodToExact() { this->SetMethod(EXACT); }
  void SetMethodToFast() { this->SetMethod(FAST); }
  ///@}

  ///@{
  /// Largest error of FAST, 1e-8 … 0.1; default 1e-3.
  vtkSetClampMacro(Tolerance, double, 1e-8, 0.1);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Turn triangles so that neighbours agree (the smaller part of a patch gives way) and closed
   * components that are inside out, before anything else; default off. The input stays as it is;
   * counts.turned_triangles and counts.turned_components tell what was done.
   */
  vtkSetMacro(OrientPatches, bool);
  vtkGetMacro(OrientPatches, bool);
  vtkBooleanMacro(OrientPatches, bool);
  ///@}

  ///@{
  /// Point array with the areas of oriented points; default "Area". Areas are estimated when there
  /// is none.
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
  /// Samples along x, y, z, each at least 1; 0, 0, 0 (default): not given.
  vtkSetVector3Macro(Dimensions, int);
  vtkGetVector3Macro(Dimensions, int);
  ///@}

  ///@{
  /// Distance of samples along x, y, z, in world units, above 0; 0, 0, 0 (default): not given.
  vtkSetVector3Macro(Spacing, double);
  vtkGetVector3Macro(Spacing, double);
  ///@}

  ///@{
  /// The finest grid of cubic voxels with at most this many samples, 8 or more; 0 (default): not
  /// given.
  vtkSetClampMacro(TargetNumberOfSamples, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(TargetNumberOfSamples, vtkIdType);
  ///@}

  ///@{
  /// Samples along the grid's longest side, at least 2; default 64.
  vtkSetClampMacro(Resolution, int, 2, VTK_INT_MAX);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * Box that the grid covers: xmin, xmax, ymin, ymax, zmin, zmax, in world units. Empty (a lower
   * end above its upper end, the default): the surface's bounds, padded.
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}

  ///@{
  /// What is added on each side of the surface's bounds, as a fraction of their diagonal; 0 or
  /// more, default 0.1. Not used with Bounds.
  vtkSetClampMacro(Padding, double, 0.0, 1000.0);
  vtkGetMacro(Padding, double);
  ///@}

  ///@{
  /// Where to evaluate instead of on a grid (input 1).
  void SetPointsConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetPointsData(vtkDataSet* data);
  ///@}

  ///@{
  /// Evaluate at the centers of input 1's cells, not at its points; default off.
  vtkSetMacro(SampleCellCenters, bool);
  vtkGetMacro(SampleCellCenters, bool);
  vtkBooleanMacro(SampleCellCenters, bool);
  ///@}

  ///@{
  /// Add the array `WindingNumberGradient`, per world unit; default off.
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
  /// Inside is where the winding number is at least this; default 0.5.
  vtkSetMacro(WindingThreshold, double);
  vtkGetMacro(WindingThreshold, double);
  ///@}

  ///@{
  /// Type of the values: vtkAlgorithm::DOUBLE_PRECISION (default; DEFAULT_PRECISION means the same)
  /// or SINGLE_PRECISION. They are computed in double in any case.
  vtkSetClampMacro(OutputPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPrecision, int);
  ///@}

  /// Where the surface is open: output 1.
  vtkPolyData* GetBoundaryOutput();

  /// How often a surface was built; evaluating it elsewhere does not count.
  vtkGetMacro(NumberOfBuilds, int);

protected:
  vtkWindingNumberField();
  ~vtkWindingNumberField() override;

  bool MakesPieces() override { return true; }
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

private:
  vtkWindingNumberField(const vtkWindingNumberField&) = delete;
  void operator=(const vtkWindingNumberField&) = delete;

  /// The whole grid that options and input ask for.
  bindpose::Status Grid(vtkPointSet* input, bindpose::SampleGrid& grid);
  /// Makes what is in Built unless that still holds.
  bindpose::Status Build(
    vtkPointSet* input, long long queries, bindpose::ExecutionContext& context);

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
  vtkTimeStamp CompositeTime; // when a composite input was last seen
  struct Cache;
  std::unique_ptr<Cache> Built;
};

#endif
