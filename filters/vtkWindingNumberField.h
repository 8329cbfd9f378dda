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
 * triangles; other cells are ignored and counted).
 * **Input 1** (optional): any vtkDataSet, at whose points the field is evaluated.
 * **Output**: a vtkImageData, or a copy of input 1, with the double point array `WindingNumber` as
 * active scalars. Points on the surface get the principal value: 1/2 on a smooth face. Points of
 * input 1 whose coordinates are not finite get NaN and a warning.
 *
 * The grid covers the surface's bounds (of the points that its 2D cells use), padded by Padding
 * times their diagonal, with SamplesAlongLongestSide samples along its longest side and cubic
 * voxels. SetBounds() replaces the padded bounds; SetDimensions() fixes the number of samples:
 * voxels stay cubic unless both are given. The grid's place depends on the surface, so asking for
 * information updates the input. Sub-extents are honoured, with the same bits as in the whole.
 *
 * All methods are exact to round-off (1e-12); `Report.method` and `Report.method_reason` say which
 * one AUTO took. Cost on one core: a closed surface 0.1 us a point whatever its size, 15 ns more
 * for every edge where the surface is open, 20 to 100 us a point when those are many but
 * most of the surface is connected, and 20 ns times the number of triangles for a soup.
 *
 * Report: method, method_reason, counts.{vertices, triangles, boundary_edges, nonmanifold_edges,
 * open_edges, components, merged_vertices, degenerate_triangles, duplicate_triangles,
 * triangulated_cells, ignored_cells, queries, on_surface, not_finite}, volume (by the divergence
 * theorem; exact for closed surfaces), winding_volume (sum of the samples times a voxel's volume,
 * when the whole grid was asked for), seconds.{build, evaluate}.
 *
 * Errors: invalid_input for a surface without 2D cells, with ids out of range or coordinates that
 * are not finite, and for grids that make no sense; the message names what is wrong.
 *
 * @par Thanks:
 * Jacobson, Kavan, Sorkine-Hornung, "Robust Inside-Outside Segmentation using Generalized Winding
 * Numbers", ACM Transactions on Graphics 32(4), 2013.
 *
 * @sa vtkTetrahedralizeSurface vtkSelectEnclosedPoints
 */

#ifndef vtkWindingNumberField_h
#define vtkWindingNumberField_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkWindingNumberField : public vtkBindposeAlgorithm
{
public:
  static vtkWindingNumberField* New();
  vtkTypeMacro(vtkWindingNumberField, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Ways to compute. AUTO takes the fastest that suits the surface, EXACT the fastest exact one.
  enum MethodType
  {
    AUTO = 0,
    EXACT = 1
  };

  ///@{
  /// AUTO (default) or EXACT. All that AUTO chooses from are exact, so far.
  vtkSetClampMacro(Method, int, AUTO, EXACT);
  vtkGetMacro(Method, int);
  void SetMethodToAuto() { this->SetMethod(AUTO); }
  void SetMethodToExact() { this->SetMethod(EXACT); }
  ///@}

  ///@{
  /**
   * Samples along x, y, z, each at least 1. 0, 0, 0 (default): computed from
   * SamplesAlongLongestSide.
   */
  vtkSetVector3Macro(Dimensions, int);
  vtkGetVector3Macro(Dimensions, int);
  ///@}

  ///@{
  /// Samples along the grid's longest side, at least 2; default 64.
  vtkSetClampMacro(SamplesAlongLongestSide, int, 2, VTK_INT_MAX);
  vtkGetMacro(SamplesAlongLongestSide, int);
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

protected:
  vtkWindingNumberField();
  ~vtkWindingNumberField() override;

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

  int Method = AUTO;
  int Dimensions[3] = { 0, 0, 0 };
  int SamplesAlongLongestSide = 64;
  double Bounds[6] = { 0.0, -1.0, 0.0, -1.0, 0.0, -1.0 };
  double Padding = 0.1;
  vtkTimeStamp CompositeTime; // when a composite input was last seen
};

#endif
