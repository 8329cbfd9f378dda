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
constexpr double hot_growth = 1.2;
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

void draw_handles(const ScreenView& view, const std::vector<HandlePlace>& places,
  const std::vector<HandleData::Bar>& bars, const HandleSizes& sizes, const HandleLook& look,
  const HandleMarks& marks, HandleShapes& solid, HandleShapes& outline)
{
  for (const HandleData::Bar& bar : bars)
  {
    const double pixel = look.pixel_scale * view.pixel_at(0.5 * (bar.from + bar.to));
    solid.add_tube({ bar.from, bar.to }, bar_pixels * pixel, look.outline);
  }
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const HandlePlace& place = places[i];
    if (!place.is_handle())
    {
      continue;
    }
    const auto cell = static_cast<vtkIdType>(i);
    const bool hot = cell == marks.hovered || cell == marks.active;
    const bool selected =
      std::find(marks.selected.begin(), marks.selected.end(), cell) != marks.selected.end();
    const Color base = place.color
      ? Color{ (*place.color)[0], (*place.color)[1], (*place.color)[2] }
      : look.modes[place.is_free() ? 2
            : place.mode > 0       ? 1
                                   : 0];
    const Color color = hot ? lighter(base) : base;
    const Color edge = selected ? look.selected : look.outline;
    const double growth = hot ? hot_growth : 1.0;
    const double line = look.pixel_scale * outline_pixels * (selected ? 1.6 : 1.0);
    // Surround the selected handle's outline with another one, so that it is visible on any
    // background.
    const double rim = line + look.pixel_scale * outline_pixels;
    const auto add_ball = [&](const Vec3& center, double size)
    {
      const double pixel = view.pixel_at(center);
      solid.add_ball(center, size * growth * pixel, color);
      outline.add_ball(center, (size * growth + line) * pixel, edge);
      if (selected)
      {
        outline.add_ball(center, (size * growth + rim) * pixel, look.outline);
      }
    };
    if (!place.is_bone())
    {
      add_ball(place.head, sizes.ball);
      continue;
    }
    const double pixel = view.pixel_at(0.5 * (place.head + place.tail));
    const double width = growth * sizes.half_width((place.tail - place.head).norm(), pixel);
    solid.add_bone(place.head, place.tail, width, color);
    outline.add_bone(place.head, place.tail, width, edge, line * pixel);
    if (selected)
    {
      outline.add_bone(place.head, place.tail, width, look.outline, rim * pixel);
    }
    add_ball(place.head, sizes.end());
    add_ball(place.tail, sizes.end());
  }
}

Eigen::Vector2d label_place(const ScreenView& view, const HandlePlace& place, double ball)
{
  const Eigen::Vector2d display = view.to_display(0.5 * (place.head + place.tail)).head<2>();
  Eigen::Vector2d aside(1.0, 0.0);
  if (place.is_bone())
  {
    const Eigen::Vector2d along = display - view.to_display(place.head).head<2>();
    if (along.norm() > 0.0)
    {
      aside = Eigen::Vector2d(along.y(), -along.x()).normalized();
      aside *= aside.x() < 0.0 ? -1.0 : 1.0;
    }
  }
  return display + ball * Eigen::Vector2d(1.9 * aside.x(), 2.4 * aside.y());
}

} // namespace bindpose
