#ifndef grid_request_h
#define grid_request_h

#include "base/mesh.h"
#include "base/status.h"
#include "base/sample_grid.h"

namespace bindpose
{

/// User settings of a grid around an object. The first of dimensions, spacing, count and
/// samples_along_longest_side that is given determines the resolution.
struct GridRequest
{
  int dimensions[3] = { 0, 0, 0 }; ///< samples along x, y, z; all 0: not given
  double spacing[3] = { 0.0, 0.0, 0.0 }; ///< between samples; all 0: not given
  Index count = 0; ///< maximum number of samples in total, at least 8; 0: not given
  int samples_along_longest_side = 64;
  double bounds[6] = { 0.0, -1.0, 0.0, -1.0, 0.0, -1.0 }; ///< lower end above upper end: not given
  double padding = 0.1; ///< on every side of `around`, in diagonals, unless bounds are given
  int flat = -1; ///< axis along which there is neither padding nor more than one sample; -1: none
};

/// Compute the grid that covers the bounds, or the padded box; its extent starts at 0. Voxels are
/// cubes unless spacing is given, or both bounds and dimensions. Return invalid_input for invalid
/// requests and for more than 1e12 samples.
Status make_grid(const GridRequest& request, const Box& around, SampleGrid& grid);

} // namespace bindpose

#endif
