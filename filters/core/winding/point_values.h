#ifndef bindpose_winding_point_values_h
#define bindpose_winding_point_values_h

#include "base/execution.h"
#include "base/mesh.h"

#include <functional>

namespace bindpose
{

/// Winding numbers of many points, on all threads: body(begin, end, flags) writes values[begin …
/// end) and flags[0 … end - begin), 1 for a point that touches what winds, else 0. Blocks take some
/// milliseconds at so many nanoseconds a point, so that a cancel is seen in time.
/// `on_surface` gets the flags unless it is null.
/// Reports counts.queries, counts.on_surface and, with a warning, counts.not_finite: values that
/// are NaN, as those of points that are no numbers must be.
Status point_values(ExecutionContext& context, Index count, double nanoseconds_a_point,
  const double* values, unsigned char* on_surface,
  const std::function<void(Index begin, Index end, unsigned char* flags)>& body);

/// Their derivatives, each on its own: body(i) writes those of point i. cancelled: not all are
/// there.
Status point_gradients(ExecutionContext& context, Index count, double nanoseconds_a_point,
  const std::function<void(Index i)>& body);

} // namespace bindpose

#endif
