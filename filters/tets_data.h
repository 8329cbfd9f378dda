#ifndef tets_data_h
#define tets_data_h

#include "BindposeFiltersModule.h" // for export macro
#include "inside/tetrahedralize.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkUnstructuredGrid;

namespace bindpose
{

/// Return output 0 of vtkTetrahedralizeSurface: tets with `OriginalPointIds`, `WindingNumber`,
/// `Label`, `MinDihedralAngle` and, for embed, `InsideFraction`; field data `Method`.
/// @param method  the method as in the report
BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkUnstructuredGrid> to_unstructured_grid(
  const TetrahedralizeResult& result, const std::string& method);

} // namespace bindpose

#endif
