#ifndef cell_check_h
#define cell_check_h

#include "base/status.h"

class vtkDataObject;

namespace bindpose
{

/// Check the cells of a vtkPolyData or vtkUnstructuredGrid, because VTK reads them without a check
/// and crashes: the offsets ascend from 0 to the number of point ids, and each cell has as many
/// points as its type requires. Ids are not checked. Other objects are valid.
Status check_cells(vtkDataObject* data);

} // namespace bindpose

#endif
