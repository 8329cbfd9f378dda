#ifndef cell_sizes_h
#define cell_sizes_h

#include "base/status.h"

class vtkDataObject;

namespace bindpose
{

/// Check that each cell of a vtkPolyData or vtkUnstructuredGrid has as many points as its type
/// requires, because VTK reads them without a check and crashes. Other objects are valid.
Status check_cell_sizes(vtkDataObject* data);

} // namespace bindpose

#endif
