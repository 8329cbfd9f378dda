#include "render/drawing.h"

#include "vtkImageData.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace bindpose::test
{

Pixel Drawing::at(const Vec3& point, std::size_t tile) const
{
  const Eigen::Vector2d position = this->geometry.project(tile, point);
  return pixel_at(this->image, position[0], position[1]);
}

long long Drawing::count(const std::function<bool(const Pixel&)>& predicate) const
{
  int size[3];
  this->image->GetDimensions(size);
  long long result = 0;
  for (int y = 0; y < size[1]; ++y)
  {
    for (int x = 0; x < size[0]; ++x)
    {
      result += predicate(pixel_at(this->image, x, y));
    }
  }
  return result;
}

Eigen::AlignedBox2d Drawing::extent(const std::function<bool(const Pixel&)>& predicate) const
{
  int size[3];
  this->image->GetDimensions(size);
  Eigen::AlignedBox2d box;
  for (int y = 0; y < size[1]; ++y)
  {
    for (int x = 0; x < size[0]; ++x)
    {
      if (predicate(pixel_at(this->image, x, y)))
      {
        box.extend(Eigen::Vector2d(x, y)).extend(Eigen::Vector2d(x + 1, y + 1));
      }
    }
  }
  return box;
}

Drawing draw(const std::vector<Tile>& tiles, const PictureOptions& options)
{
  Drawing drawing;
  const Status status = render_to_image(tiles, options, drawing.image, &drawing.geometry);
  EXPECT_TRUE(status.ok()) << status.message;
  return drawing;
}

bool is_background(const Pixel& p)
{
  return p.r == 255 && p.g == 255 && p.b == 255;
}

double lightness(const Pixel& p)
{
  return 0.299 * p.r + 0.587 * p.g + 0.114 * p.b;
}

double distance(const Pixel& p, const Rgb& color)
{
  return std::max({ std::abs(p.r - 255.0 * color[0]), std::abs(p.g - 255.0 * color[1]),
    std::abs(p.b - 255.0 * color[2]) });
}

double hue_distance(const Pixel& p, const Rgb& color)
{
  const double pixel_sum = std::max(1, p.r + p.g + p.b);
  const double sum = color[0] + color[1] + color[2];
  return std::max({ std::abs(p.r / pixel_sum - color[0] / sum),
    std::abs(p.g / pixel_sum - color[1] / sum), std::abs(p.b / pixel_sum - color[2] / sum) });
}

} // namespace bindpose::test
