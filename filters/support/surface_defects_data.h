#ifndef surface_defects_data_h
#define surface_defects_data_h

#include "BindposeFiltersModule.h" // for export macro
#include "surface/surface_defects.h"

#include "vtkSmartPointer.h"

class vtkPolyData;

namespace bindpose
{

/// Return the defects of a surface (see vtkSurfaceDefects) as separate cells on the surface's
/// points: vertices, lines, triangles, in this order. Point array: `OriginalPointIds`. Cell arrays:
/// - `Defect` (int, see Defect) and `DefectName`;
/// - `OriginalCellIds` and `CrossedCellIds`: ids of cells of the surface; -1: none;
/// - `Component`: index of the component; -1: none;
/// - `InwardComponent`: index among the components that are inside out; -1: none.
///
/// `cell_of_triangle` may be empty, see SurfaceInput.
BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkPolyData> to_polydata(
  const std::vector<DefectOccurrence>& occurrences, PointsView points,
  const std::vector<Index>& cell_of_triangle);

} // namespace bindpose

#endif
