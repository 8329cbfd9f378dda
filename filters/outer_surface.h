#ifndef outer_surface_h
#define outer_surface_h

#include "conversion.h"

namespace bindpose
{

/// The surface of what a dataset is: the boundary of tets, else the 2D cells. Errors of
/// to_surface().
BINDPOSEFILTERS_EXPORT Status to_outer_surface(vtkDataSet* data, SurfaceInput& surface);

} // namespace bindpose

#endif
