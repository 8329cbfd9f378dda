#ifndef bindpose_winding_point_values_h
#define bindpose_winding_point_values_h

#include "base/execution.h"
#include "geometry/mesh.h"

#include <functional>

namespace bindpose
{

/// Beyond this distance from the origin, in units of the geometry's size, the winding number is 0
/// in double precision.
constexpr double zero_distance = 1e20;

/// Compute the winding numbers of many points on all threads. body(begin, end, flags) must write
/// values[begin … end) and flags[0 … end - begin): 1 for a point that touches the geometry, else 0.
/// It must write NaN for points that are not finite. The block size is chosen from
/// `nanoseconds_per_point`, so that a block takes a few milliseconds and a cancel request is
/// noticed in time. If `on_surface` is not null, the flags are copied to it. The status reports
/// counts.queries, counts.on_surface and, with a warning, counts.not_finite (the number of NaN
/// values).
Status point_values(ExecutionContext& context, Index count, double nanoseconds_per_point,
  const double* values, unsigned char* on_surface,
  const std::function<void(Index begin, Index end, unsigned char* flags)>& body);

/// Compute the derivatives at many points on all threads. body(i) must write the derivatives at
/// point i. If the returned status is canceled, the derivatives are incomplete.
Status point_gradients(ExecutionContext& context, Index count, double nanoseconds_per_point,
  const std::function<void(Index i)>& body);

} // namespace bindpose

#endif
