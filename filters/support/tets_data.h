#ifndef tets_data_h
#define tets_data_h

#include "BindposeFiltersModule.h" // for export macro
#include "inside/tetrahedralize.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkUnstructuredGrid;

namespace bindpose
{

/// Return output 0 of vtkTetrahedralizeSurface: tets with the arrays `OriginalPointIds`,
/// `WindingNumber`, `Label`, `MinDihedralAngle` and the field data `Method`. The method embed adds
/// `InsideFraction`.
/// @param method  name of the meshing method, as in the report
BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkUnstructuredGrid> to_unstructured_grid(
  const TetrahedralizeResult& result, const std::string& method);

} // namespace bindpose

#endif
