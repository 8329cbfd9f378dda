#ifndef bindpose_tests_render_drawing_h
#define bindpose_tests_render_drawing_h

// A picture that a test has drawn, and functions that examine its pixels.

#include "pictures/picture.h"
#include "render/harness.h"
#include "scene/colors.h"

#include <functional>

namespace bindpose::test
{

struct Drawing
{
  vtkSmartPointer<vtkImageData> image;
  PictureGeometry geometry;

  Pixel at(const Vec3& point, std::size_t tile = 0) const;
  long long count(const std::function<bool(const Pixel&)>& predicate) const;
  /// Return the smallest rectangle that contains all pixels for which `predicate` returns true. Its
  /// coordinates are in pixels from the lower left corner.
  Eigen::AlignedBox2d extent(const std::function<bool(const Pixel&)>& predicate) const;
};

Drawing draw(const std::vector<Tile>& tiles, const PictureOptions& options);

bool is_background(const Pixel& p);
double lightness(const Pixel& p);
/// Return the largest difference of a channel between pixel and color, from 0 to 255.
double distance(const Pixel& p, const Rgb& color);
/// Return the distance in hue between a lit pixel and a color: the largest difference between their
/// fractions of red, green and blue. Lighting changes the sum of the channels but hardly changes
/// these fractions.
double hue_distance(const Pixel& p, const Rgb& color);

} // namespace bindpose::test

#endif
