#ifndef grid_request_h
#define grid_request_h

#include "base/status.h"
#include "geometry/mesh.h"
#include "geometry/sample_grid.h"

namespace bindpose
{

/// User settings of a grid of samples around an object. The first of dimensions, spacing, count and
/// samples_along_longest_side that is specified determines the resolution.
struct GridRequest
{
  int dimensions[3] = { 0, 0, 0 }; ///< number of samples along x, y, z; 0, 0, 0: not specified
  double spacing[3] = { 0.0, 0.0, 0.0 }; ///< sample distance along x, y, z; 0, 0, 0: not specified
  Index count = 0; ///< maximum number of samples in total, at least 8; 0: not specified
  int samples_along_longest_side = 64;
  /// Lower and upper bound along x, y, z; lower > upper: not specified.
  double bounds[6] = { 0.0, -1.0, 0.0, -1.0, 0.0, -1.0 };
  /// Distance added on each side of the box `data_bounds` (see make_grid), as a fraction of the
  /// box's diagonal. Not used if `bounds` is specified.
  double padding = 0.1;
  int flat_axis = -1; ///< axis with one sample and without padding; -1: no such axis
};

/// Compute the grid that covers `request.bounds`, or the padded box `data_bounds` if there are no
/// bounds. The extent of the grid starts at 0. Voxels are cubes unless spacing is specified, or
/// both bounds and dimensions are specified. Return invalid_input for invalid requests and for more
/// than 1e12 samples.
Status make_grid(const GridRequest& request, const Box& data_bounds, SampleGrid& grid);

} // namespace bindpose

#endif
