/**
 * @class   vtkSurfaceDefects
 * @brief   locates the defects of a surface
 *
 * **Input**: a vtkPointSet with 2D cells (polygons and strips are split into triangles; other cells
 * are ignored and counted). All surfaces are accepted, except those with ids out of range or
 * coordinates that are not finite.
 * **Output**: a vtkPolyData with one cell per defect: vertices, then edges, then triangles. The
 * cell array `Defect` (int) has the values of the first column of this table, in ascending order,
 * and the cell array `DefectName` the strings of the second column:
 *
 * | 0 | duplicate vertex | equal to a point of lower id |
 * | 1 | unreferenced vertex | used by no triangle |
 * | 2 | boundary edge | used by one triangle |
 * | 3 | non-manifold edge | used by three triangles or more |
 * | 4 | misoriented edge | two triangles use it in the same direction |
 * | 5 | degenerate triangle | has no area |
 * | 6 | duplicate triangle | has the corners of a triangle of lower id, in any order |
 * | 7 | crossing triangle | intersects another triangle beyond shared vertices and edges |
 * | 8 | inward component | belongs to a closed component that is inside out |
 *
 * Further cell arrays are `OriginalCellIds` (the input's cell; -1: none), `CrossedCellIds` (lowest
 * id of the cells that a crossing triangle intersects; -1: none), `Component` (index of the
 * connected component; -1: none) and `InwardComponent` (index among the components that are inside
 * out; -1: none). Point array: `OriginalPointIds`. Edges, components and crossings are those of the
 * surface after equal points are merged. Otherwise every edge of an STL file, which stores three
 * separate points per triangle, would be a boundary edge.
 *
 * Report: counts.{vertices, triangles, duplicate_vertices, unreferenced_vertices,
 * degenerate_triangles, duplicate_triangles, boundary_edges, nonmanifold_edges, misoriented_edges,
 * components, inward_components, self_intersections (pairs), crossing_triangles,
 * triangulated_cells, ignored_cells}, closed
 * ("yes" if the triangles use every edge equally often in both directions), seconds.*.
 *
 * The status is INVALID_INPUT for a dataset without 2D cells, ids out of range, or coordinates that
 * are not finite.
 * Cost: 0.5 s for 100k triangles, mostly for the search for crossings.
 *
 * @sa vtkTetrahedralizeSurface vtkWindingNumberField vtkFeatureEdges
 */

#ifndef vtkSurfaceDefects_h
#define vtkSurfaceDefects_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkSurfaceDefects : public vtkBindposeAlgorithm
{
public:
  static vtkSurfaceDefects* New();
  vtkTypeMacro(vtkSurfaceDefects, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Values of the array `Defect`.
  enum DefectType
  {
    DUPLICATE_VERTEX = 0,
    UNREFERENCED_VERTEX = 1,
    BOUNDARY_EDGE = 2,
    NONMANIFOLD_EDGE = 3,
    MISORIENTED_EDGE = 4,
    DEGENERATE_TRIANGLE = 5,
    DUPLICATE_TRIANGLE = 6,
    SELF_INTERSECTION = 7,
    INWARD_COMPONENT = 8
  };

protected:
  vtkSurfaceDefects() = default;
  ~vtkSurfaceDefects() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkSurfaceDefects(const vtkSurfaceDefects&) = delete;
  void operator=(const vtkSurfaceDefects&) = delete;
};

#endif
