// Color maps. Each map is defined by a few anchor colors and interpolated in CIE Lab, where equal
// distances look equal. The lightness of the anchors decreases evenly from 92 to 22.
#include "scene/colors.h"

#include "base/number_text.h"

#include "vtkLookupTable.h"
#include "vtkMath.h"
#include "vtkProperty.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{
namespace
{
Rgb mix(const Rgb& a, const Rgb& b, double t)
{
  std::array<double, 3> lab_a{};
  std::array<double, 3> lab_b{};
  vtkMath::RGBToLab(a.data(), lab_a.data());
  vtkMath::RGBToLab(b.data(), lab_b.data());
  std::array<double, 3> lab{};
  for (int k = 0; k < 3; ++k)
  {
    lab[k] = lab_a[k] + t * (lab_b[k] - lab_a[k]);
  }
  Rgb rgb{};
  vtkMath::LabToRGB(lab.data(), rgb.data());
  for (double& c : rgb)
  {
    c = std::clamp(c, 0.0, 1.0);
  }
  return rgb;
}

// CIE Lab values, so that the lightness of the anchors is explicit.
const std::array<std::array<double, 3>, 6> sequential_anchors = { { { 92, 0, 6 }, { 78, -18, 16 },
  { 64, -24, -2 }, { 50, -15, -20 }, { 36, 6, -38 }, { 22, 22, -42 } } };

vtkSmartPointer<vtkLookupTable> make_table(double lower, double upper, int count)
{
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(count);
  table->SetTableRange(lower, upper);
  table->SetNanColor(palette::missing[0], palette::missing[1], palette::missing[2], 1.0);
  return table;
}

// Return five to seven round values in a range, at distances of 1, 2 or 5 times a power of ten.
std::vector<double> round_ticks(double lower, double upper)
{
  const double rough = (upper - lower) / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : { 5.0, 2.0, 1.0 })
  {
    if (factor * power >= rough)
    {
      step = factor * power;
    }
  }
  std::vector<double> ticks;
  for (double i = std::ceil(lower / step - 1e-9); i * step <= upper + 1e-9 * step; ++i)
  {
    ticks.push_back(i * step);
  }
  return ticks;
}
} // namespace

void set_color(vtkProperty* property, const Rgb& color)
{
  property->SetColor(color[0], color[1], color[2]);
}

Rgb sequential_color(double t)
{
  const double scaled = std::clamp(t, 0.0, 1.0) * (sequential_anchors.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(scaled), sequential_anchors.size() - 2);
  const double s = scaled - static_cast<double>(first);
  std::array<double, 3> lab{};
  for (int k = 0; k < 3; ++k)
  {
    lab[k] = (1.0 - s) * sequential_anchors[first][k] + s * sequential_anchors[first + 1][k];
  }
  Rgb rgb{};
  vtkMath::LabToRGB(lab.data(), rgb.data());
  for (double& c : rgb)
  {
    c = std::clamp(c, 0.0, 1.0);
  }
  return rgb;
}

Rgb winding_color(double winding_number)
{
  const Rgb outside{ 0.44, 0.65, 0.82 };
  const Rgb middle{ 0.98, 0.97, 0.95 };
  const Rgb inside{ 0.90, 0.58, 0.36 };
  const Rgb negative[2] = { { 0.52, 0.47, 0.77 }, { 0.20, 0.10, 0.45 } };
  const Rgb doubled[2] = { { 0.72, 0.33, 0.17 }, { 0.36, 0.08, 0.05 } };
  const double w = winding_number;
  if (w < -0.02)
  {
    return mix(negative[0], negative[1], std::clamp(-w, 0.0, 1.0));
  }
  if (w > 1.02)
  {
    return mix(doubled[0], doubled[1], std::clamp(w - 1.0, 0.0, 1.0));
  }
  const double t = std::clamp(w, 0.0, 1.0);
  return t < 0.5 ? mix(outside, middle, 2.0 * t) : mix(middle, inside, 2.0 * t - 1.0);
}

Rgb diverging_color(double t)
{
  const Rgb white{ 0.97, 0.97, 0.96 };
  const Rgb sides[2][3] = { { { 0.56, 0.75, 0.89 }, { 0.22, 0.48, 0.73 }, { 0.08, 0.18, 0.42 } },
    { { 0.96, 0.72, 0.47 }, { 0.79, 0.38, 0.12 }, { 0.42, 0.12, 0.03 } } };
  const Rgb* side = sides[t < 0.0 ? 0 : 1];
  const double scaled = 3.0 * std::min(std::abs(t), 1.0);
  const int first = std::min(static_cast<int>(scaled), 2);
  return mix(first == 0 ? white : side[first - 1], side[first], scaled - first);
}

ColorMap sequential_map(double lower, double upper, int bands)
{
  ColorMap map;
  map.lower = lower;
  // A constant array needs a range of nonzero length.
  map.upper = upper > lower ? upper : lower + std::max(1e-12, 1e-6 * std::abs(lower));
  const int count = bands > 0 ? bands : 256;
  map.table = make_table(map.lower, map.upper, count);
  for (int i = 0; i < count; ++i)
  {
    // Each band has the color of its center, but the first and last bands have the colors of the
    // map's ends.
    const double t = count > 1 ? i / (count - 1.0) : 0.5;
    const Rgb c = sequential_color(t);
    map.table->SetTableValue(i, c[0], c[1], c[2], 1.0);
  }
  map.ticks = upper > lower ? round_ticks(map.lower, map.upper) : std::vector<double>{ lower };
  map.decimals = -1;
  return map;
}

ColorMap diverging_map(double lower, double upper, double center)
{
  ColorMap map;
  // Half the width of the range that is used if all values equal the center.
  const double minimum_half_width = std::max(1e-12, 1e-9 * std::abs(center));
  const bool constant = !(upper - lower > 2.0 * minimum_half_width);
  map.lower = constant ? center - minimum_half_width : lower;
  map.upper = constant ? center + minimum_half_width : upper;
  // Use an odd number of entries, so that the center of a symmetric range has its own entry.
  constexpr int count = 257;
  map.table = make_table(map.lower, map.upper, count);
  const double half_range = std::max(map.upper - center, center - map.lower);
  for (int i = 0; i < count; ++i)
  {
    const double value = map.lower + (map.upper - map.lower) * (i + 0.5) / count;
    const Rgb c = diverging_color((value - center) / half_range);
    map.table->SetTableValue(i, c[0], c[1], c[2], 1.0);
  }
  map.ticks = constant ? std::vector<double>{ center } : round_ticks(map.lower, map.upper);
  map.decimals = -1;
  return map;
}

ColorMap weight_map()
{
  ColorMap map = sequential_map(0.0, 1.0, 10);
  map.ticks = { 0.0, 0.2, 0.4, 0.6, 0.8, 1.0 };
  map.decimals = 1;
  return map;
}

ColorMap winding_map()
{
  ColorMap map;
  map.lower = -1.0;
  map.upper = 2.0;
  // Number of table entries. Each entry covers an interval of 0.01, and winding_color() jumps only
  // at ends of intervals (-0.02 and 1.02).
  constexpr int count = 300;
  map.table = make_table(map.lower, map.upper, count);
  for (int i = 0; i < count; ++i)
  {
    const Rgb c = winding_color(map.lower + (i + 0.5) * (map.upper - map.lower) / count);
    map.table->SetTableValue(i, c[0], c[1], c[2], 1.0);
  }
  map.ticks = { -1.0, 0.0, 0.5, 1.0, 2.0 };
  map.decimals = -1;
  return map;
}

Rgb color_of(const ColorMap& map, double value)
{
  Rgb color{};
  map.table->GetColor(value, color.data());
  return color;
}

ColorMap level_map(const ColorMap& map, const std::vector<double>& levels)
{
  const int count = static_cast<int>(levels.size());
  ColorMap result;
  result.lower = 0.0;
  result.upper = count;
  result.table = make_table(result.lower, result.upper, count);
  for (int i = 0; i < count; ++i)
  {
    const Rgb c = color_of(map, levels[i]);
    result.table->SetTableValue(i, c[0], c[1], c[2], 1.0);
    result.ticks.push_back(i + 0.5);
    result.texts.push_back(short_number(levels[i], legend_digits));
  }
  return result;
}

ColorMap with_levels(ColorMap map, const std::vector<double>& levels)
{
  const double minimum_distance = 0.07 * (map.upper - map.lower);
  std::vector<double> ticks;
  for (const double level : levels)
  {
    if (level >= map.lower && level <= map.upper)
    {
      ticks.push_back(level);
    }
  }
  for (const double tick : map.ticks)
  {
    const auto touches = [&](double level) { return std::abs(level - tick) < minimum_distance; };
    if (std::none_of(ticks.begin(), ticks.end(), touches))
    {
      ticks.push_back(tick);
    }
  }
  map.ticks = ticks;
  map.decimals = -1;
  return map;
}

} // namespace bindpose
