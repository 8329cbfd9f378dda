#ifndef outer_surface_h
#define outer_surface_h

#include "conversion.h"

namespace bindpose
{

/// Return the outer surface of a dataset: the boundary of its tets, or its 2D cells if it is not a
/// mesh of tets. The errors are those of to_surface().
BINDPOSEFILTERS_EXPORT Status to_outer_surface(vtkDataSet* data, SurfaceInput& surface);

} // namespace bindpose

#endif
