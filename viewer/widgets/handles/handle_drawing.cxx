// Draws handles and bars. Sizes are in pixels: every ball gets the world radius that corresponds to
// its size in pixels at its position. An outline is a slightly larger copy of the same shape, of
// which only the back faces are drawn.
#include "handle_drawing.h"

#include <algorithm>

namespace bindpose
{
namespace
{
constexpr double outline_pixels = 1.6;
constexpr double bar_pixels = 0.9;
constexpr double highlight_scale = 1.2;
} // namespace

Color lighter(const Color& color)
{
  Color result = color;
  for (double& c : result)
  {
    c += 0.45 * (1.0 - c);
  }
  return result;
}

void draw_handles(const ScreenView& view, const std::vector<HandleRecord>& records,
  const std::vector<HandleData::Bar>& bars, const HandleSizes& sizes,
  const HandleAppearance& appearance, const HandleMarks& marks, HandleShapes& solid,
  HandleShapes& outline)
{
  for (const HandleData::Bar& bar : bars)
  {
    const double pixel = appearance.pixel_scale * view.pixel_length_at(0.5 * (bar.from + bar.to));
    solid.add_tube({ bar.from, bar.to }, bar_pixels * pixel, appearance.outline);
  }
  for (std::size_t i = 0; i < records.size(); ++i)
  {
    const HandleRecord& record = records[i];
    if (!record.is_handle())
    {
      continue;
    }
    const auto cell = static_cast<vtkIdType>(i);
    const bool is_highlighted = cell == marks.hovered || cell == marks.active;
    const bool selected =
      std::find(marks.selected.begin(), marks.selected.end(), cell) != marks.selected.end();
    const Color base = record.color
      ? Color{ (*record.color)[0], (*record.color)[1], (*record.color)[2] }
      : appearance.modes[record.is_free() ? 2
            : record.mode > 0             ? 1
                                          : 0];
    const Color color = is_highlighted ? lighter(base) : base;
    const Color edge = selected ? appearance.selected : appearance.outline;
    const double growth = is_highlighted ? highlight_scale : 1.0;
    const double line = appearance.pixel_scale * outline_pixels * (selected ? 1.6 : 1.0);
    // A selected handle has two outlines: an inner one in the color `selected`, and an outer one in
    // the color `outline`. On any background, at least one of the two is visible.
    const double rim = line + appearance.pixel_scale * outline_pixels;
    const auto add_ball = [&](const Vec3& center, double size)
    {
      const double pixel = view.pixel_length_at(center);
      solid.add_ball(center, size * growth * pixel, color);
      outline.add_ball(center, (size * growth + line) * pixel, edge);
      if (selected)
      {
        outline.add_ball(center, (size * growth + rim) * pixel, appearance.outline);
      }
    };
    if (!record.is_bone())
    {
      add_ball(record.head, sizes.ball);
      continue;
    }
    const double pixel = view.pixel_length_at(0.5 * (record.head + record.tail));
    const double width = growth * sizes.half_width((record.tail - record.head).norm(), pixel);
    solid.add_bone(record.head, record.tail, width, color);
    outline.add_bone(record.head, record.tail, width, edge, line * pixel);
    if (selected)
    {
      outline.add_bone(record.head, record.tail, width, appearance.outline, rim * pixel);
    }
    add_ball(record.head, sizes.end());
    add_ball(record.tail, sizes.end());
  }
}

Eigen::Vector2d label_anchor(const ScreenView& view, const HandleRecord& record, double ball)
{
  const Eigen::Vector2d display = view.to_display(0.5 * (record.head + record.tail)).head<2>();
  Eigen::Vector2d label_direction(1.0, 0.0);
  if (record.is_bone())
  {
    const Eigen::Vector2d segment_vector = display - view.to_display(record.head).head<2>();
    if (segment_vector.norm() > 0.0)
    {
      label_direction = Eigen::Vector2d(segment_vector.y(), -segment_vector.x()).normalized();
      label_direction *= label_direction.x() < 0.0 ? -1.0 : 1.0;
    }
  }
  return display + ball * Eigen::Vector2d(1.9 * label_direction.x(), 2.4 * label_direction.y());
}

} // namespace bindpose
