// Parallel evaluation of values and derivatives at many points, in blocks whose size depends on the
// time per point.
#include "winding/point_values.h"

#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

namespace bindpose
{

namespace
{
/// Return the number of points per block. Each thread gets several blocks. Blocks are large enough
/// to keep neighbors together and small enough to notice a cancel request in time.
Index block_size(Index count, double nanoseconds_per_point)
{
  constexpr double shortest_block = 8e5, longest_block = 5e6; // nanoseconds
  constexpr double largest_block = 32768.0, target_blocks = 16.0;
  const double nanoseconds = std::max(1.0, nanoseconds_per_point);
  const double maximum = std::clamp(longest_block / nanoseconds, 1.0, largest_block);
  const double minimum = std::min(std::max(shortest_block / nanoseconds, 1.0), maximum);
  return static_cast<Index>(
    std::clamp(static_cast<double>(count) / target_blocks, minimum, maximum));
}
} // namespace

Status point_values(ExecutionContext& context, Index count, double nanoseconds_per_point,
  const double* values, unsigned char* on_surface,
  const std::function<void(Index begin, Index end, unsigned char* flags)>& body)
{
  std::atomic<Index> touching{ 0 };
  std::atomic<Index> nonfinite_count{ 0 };
  const bool done = parallel_for(context, count, block_size(count, nanoseconds_per_point),
    [&](Index begin, Index end)
    {
      std::vector<unsigned char> flag_buffer(
        on_surface ? 0 : static_cast<std::size_t>(end - begin));
      unsigned char* const flags = on_surface ? on_surface + begin : flag_buffer.data();
      body(begin, end, flags);
      touching += std::count(flags, flags + (end - begin), static_cast<unsigned char>(1));
      nonfinite_count +=
        std::count_if(values + begin, values + end, [](double value) { return std::isnan(value); });
    });
  if (!done)
  {
    return Status::canceled();
  }
  Status status;
  status.report.set("counts.queries", count);
  status.report.set("counts.on_surface", touching.load());
  if (nonfinite_count > 0)
  {
    status.report.set("counts.not_finite", nonfinite_count.load());
    status.warnings.push_back(std::to_string(nonfinite_count.load()) + " of " +
      std::to_string(count) +
      " points have a coordinate that is not a finite number; their winding number is NaN");
  }
  return status;
}

Status point_gradients(ExecutionContext& context, Index count, double nanoseconds_per_point,
  const std::function<void(Index i)>& body)
{
  const bool done = parallel_for(context, count, block_size(count, nanoseconds_per_point),
    [&](Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        body(i);
      }
    });
  return done ? Status() : Status::canceled();
}

} // namespace bindpose
