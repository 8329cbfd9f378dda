#ifndef cell_check_h
#define cell_check_h

#include "base/status.h"

class vtkDataObject;

namespace bindpose
{

/// Check the cells of a vtkPolyData or vtkUnstructuredGrid: the offsets must ascend from 0 to the
/// number of point ids, and each cell must have as many points as its type requires. VTK reads
/// cells without these checks and crashes if cells are invalid. The point ids are not checked. Data
/// objects of other classes are valid.
Status check_cells(vtkDataObject* data);

} // namespace bindpose

#endif
