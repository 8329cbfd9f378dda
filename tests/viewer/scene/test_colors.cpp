// Color maps have the documented properties. For example, each band is darker than the previous
// one, and viewers with color blindness can distinguish the colors of winding numbers.
#include "scene/colors.h"

#include "vtkMath.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace bindpose;

namespace
{
double lab_lightness(const Rgb& color)
{
  double lab[3];
  vtkMath::RGBToLab(color.data(), lab);
  return lab[0];
}

double lab_distance(const Rgb& a, const Rgb& b)
{
  double p[3];
  double q[3];
  vtkMath::RGBToLab(a.data(), p);
  vtkMath::RGBToLab(b.data(), q);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

// Return the color that a viewer with one type of color blindness perceives. The matrices of
// Machado, Oliveira and Fernandes 2009 with severity 1 are applied to linear light.
Rgb perceived_color(const std::array<std::array<double, 3>, 3>& matrix, const Rgb& color)
{
  const auto to_linear = [](double c)
  { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  const auto from_linear = [](double c)
  {
    c = std::min(std::max(c, 0.0), 1.0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
  };
  Rgb result{};
  for (int i = 0; i < 3; ++i)
  {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      sum += matrix[i][k] * to_linear(color[k]);
    }
    result[i] = from_linear(sum);
  }
  return result;
}

const std::array<std::array<double, 3>, 3> vision_matrices[4] = {
  { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } },
  { { { 0.152286, 1.052583, -0.204868 }, { 0.114503, 0.786281, 0.099216 },
    { -0.003882, -0.048116, 1.051998 } } }, // protanopia
  { { { 0.367322, 0.860646, -0.227968 }, { 0.280085, 0.672501, 0.047413 },
    { -0.011820, 0.042940, 0.968881 } } }, // deuteranopia
  { { { 1.255528, -0.076749, -0.178779 }, { -0.078411, 0.930809, 0.147602 },
    { 0.004733, 0.691367, 0.303900 } } } // tritanopia
};
} // namespace

TEST(Colors, SequentialGetsDarkerEvenlyForAllEyes)
{
  for (const auto& vision_matrix : vision_matrices)
  {
    double before = lab_lightness(perceived_color(vision_matrix, sequential_color(0.0)));
    for (int i = 1; i <= 9; ++i)
    {
      const double now = lab_lightness(perceived_color(vision_matrix, sequential_color(i / 9.0)));
      EXPECT_LT(now, before - 2.5) << "band " << i;
      before = now;
    }
  }
}

TEST(Colors, WindingNumbersOfFiveKindsAreToldApartByAllEyes)
{
  for (const auto& vision_matrix : vision_matrices)
  {
    const double values[5] = { -1.0, 0.0, 0.5, 1.0, 2.0 };
    for (int i = 0; i < 5; ++i)
    {
      for (int k = 0; k < i; ++k)
      {
        EXPECT_GT(lab_distance(perceived_color(vision_matrix, winding_color(values[i])),
                    perceived_color(vision_matrix, winding_color(values[k]))),
          20.0)
          << values[i] << " and " << values[k];
      }
    }
  }
  // Round-off at 0 and 1 does not change the visible color; a deviation of 0.03 does.
  EXPECT_LT(lab_distance(winding_color(-1e-9), winding_color(1e-9)), 1e-3);
  EXPECT_LT(lab_distance(winding_color(1.0 - 1e-9), winding_color(1.0 + 1e-9)), 1e-3);
  EXPECT_GT(lab_distance(winding_color(-0.03), winding_color(0.0)), 15.0);
  EXPECT_GT(lab_distance(winding_color(1.03), winding_color(1.0)), 15.0);
}

TEST(Colors, TablesMapValuesToTheRightBand)
{
  const ColorMap map = weight_map();
  ASSERT_EQ(map.table->GetNumberOfTableValues(), 10);
  for (int band = 0; band < 10; ++band)
  {
    double rgb[3];
    map.table->GetColor(0.1 * band + 0.05, rgb);
    const Rgb expected = sequential_color(band / 9.0);
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(rgb[k], expected[k], 1.0 / 255.0);
    }
  }
  const ColorMap other = sequential_map(-3.0, 17.0, 0);
  EXPECT_EQ(other.ticks, (std::vector<double>{ 0.0, 5.0, 10.0, 15.0 }));
  const ColorMap constant = sequential_map(4.0, 4.0, 0);
  EXPECT_EQ(constant.ticks, std::vector<double>{ 4.0 });
  EXPECT_GT(constant.upper, constant.lower);
}
