// Finds the handle under the mouse. Picking is computed on the screen, without rendering. Every
// position is projected once. The candidate with the best priority is kept, then the nearest to the
// mouse, then the nearest to the camera.
#include "handle_picking.h"

#include <algorithm>
#include <cmath>
#include <tuple>

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace bindpose
{

double HandleSizes::half_width(double length, double pixel) const
{
  return std::clamp(this->bone_width * length, 0.5 * this->ball * pixel, 2.0 * this->ball * pixel);
}

HandlePick pick_handle(const ScreenView& view, const std::vector<HandleRecord>& records,
  const Vector2d& mouse, const HandleSizes& sizes)
{
  HandlePick best;
  std::tuple<int, double, double> best_order{ 4, 0.0, 0.0 };
  vtkIdType cell = -1;
  const auto keep_if_best = [&](HandlePart part, int rank, double distance, double depth)
  {
    const std::tuple<int, double, double> order{ rank, distance, depth };
    if (order < best_order)
    {
      best = { part, cell };
      best_order = order;
    }
  };
  const double ball = sizes.ball + sizes.tolerance;
  const double end = sizes.end() + sizes.tolerance;
  for (const HandleRecord& record : records)
  {
    ++cell;
    if (!record.is_handle() || view.pixel_length_at(record.head) == 0.0)
    {
      continue;
    }
    const Vector3d head = view.to_display(record.head);
    const double to_head = (head.head<2>() - mouse).norm();
    if (!record.is_bone())
    {
      if (to_head <= ball)
      {
        keep_if_best(HandlePart::point, 0, to_head, head[2]);
      }
      continue;
    }
    if (view.pixel_length_at(record.tail) == 0.0)
    {
      continue;
    }
    const Vector3d tail = view.to_display(record.tail);
    const double to_tail = (tail.head<2>() - mouse).norm();
    // At a joint, prefer the tail of the parent bone to the head of the child bone. Users usually
    // want to rotate the parent, and rarely to move the child away from the parent.
    if (to_tail <= end)
    {
      keep_if_best(HandlePart::tail, 1, to_tail, tail[2]);
    }
    if (to_head <= end)
    {
      keep_if_best(HandlePart::head, 2, to_head, head[2]);
    }
    const Vector2d segment_vector = (tail - head).head<2>();
    const double length2 = segment_vector.squaredNorm();
    const double s = length2 > 0.0
      ? std::clamp((mouse - head.head<2>()).dot(segment_vector) / length2, 0.0, 1.0)
      : 0.0;
    const double to_body = (head.head<2>() + s * segment_vector - mouse).norm();
    if (to_body <= sizes.half_width(std::sqrt(length2), 1.0) + sizes.tolerance)
    {
      keep_if_best(HandlePart::body, 3, to_body, head[2] + s * (tail[2] - head[2]));
    }
  }
  return best;
}

} // namespace bindpose
