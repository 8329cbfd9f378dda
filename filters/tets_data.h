#ifndef tets_data_h
#define tets_data_h

#include "BindposeFiltersModule.h" // for export macro
#include "inside/tetrahedralize.h"

#include "vtkSmartPointer.h"

class vtkUnstructuredGrid;

namespace bindpose
{

/// Output 0 of vtkTetrahedralizeSurface: tets with `OriginalPointIds`, `WindingNumber`, `Label`,
/// `MinDihedralAngle` and, of embed, `InsideFraction`.
BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkUnstructuredGrid> to_unstructured_grid(
  const TetrahedralizeResult& result);

} // namespace bindpose

#endif
