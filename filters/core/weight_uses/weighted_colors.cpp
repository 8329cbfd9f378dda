// Blend handle colors (see weighted_colors.h). The blend is a product of matrices, computed block
// by block. Colors are decoded to linear light before the blend and encoded after it. The encoding
// curve is monotone and maps 0 to 0 and 1 to 1, so a color is outside of the gamut after encoding
// if and only if it is outside before.
#include "weight_uses/weighted_colors.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace bindpose
{

namespace
{
constexpr Index colors_per_block = 4096;
/// A color is out of gamut if one of its components is outside of [0, 1] by more than this
/// tolerance. The tolerance is larger than the errors of weights (about 1e-9) and far smaller than
/// visible differences (about 1 / 255).
constexpr double gamut_tolerance = 1e-6;

/// Results of one block of vertices.
struct Tally
{
  Index out_of_gamut = 0;
  Index beyond_handles = 0;
  double gamut_violation = 0.0;
  double overshoot = 0.0;
  double row_sum_error = 0.0;
  Index first_nonfinite = -1; ///< the first vertex whose blended color is not finite; -1: none
};

double distance_outside(const Vec3& color, const Vec3& lower, const Vec3& upper)
{
  return std::max({ 0.0, (lower.array() - color.array()).maxCoeff(),
    (color.array() - upper.array()).maxCoeff() });
}
} // namespace

double to_linear_light(double encoded)
{
  const double x = std::abs(encoded);
  const double y = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  return std::copysign(y, encoded);
}

double from_linear_light(double linear)
{
  const double x = std::abs(linear);
  const double y = x <= 0.0031308 ? 12.92 * x : 1.0 + 1.055 * (std::pow(x, 1.0 / 2.4) - 1.0);
  return std::copysign(y, linear);
}

Colors categorical_colors(Index count)
{
  static constexpr double palette[8][3] = { { 230, 159, 0 }, { 86, 180, 233 }, { 0, 158, 115 },
    { 240, 228, 66 }, { 0, 114, 178 }, { 213, 94, 0 }, { 204, 121, 167 }, { 90, 90, 90 } };
  Colors colors(count, 3);
  for (Index j = 0; j < count; ++j)
  {
    // Each further group of eight colors is lighter: the distance of each color from white is half
    // of that in the previous group.
    const double full = std::ldexp(1.0, -static_cast<int>(std::min<Index>(j / 8, 30)));
    for (int k = 0; k < 3; ++k)
    {
      colors(j, k) = 1.0 - full * (1.0 - palette[j % 8][k] / 255.0);
    }
  }
  return colors;
}

Status weighted_colors(ExecutionContext& context, WeightsView weights, ColorsView handle_colors,
  const WeightedColorsOptions& options, WeightedColors& result)
{
  const Index rows = weights.rows();
  if (weights.cols() != handle_colors.rows() || weights.cols() == 0)
  {
    return Status::invalid_input("the weights have " + std::to_string(weights.cols()) +
      " columns, but there are " + std::to_string(handle_colors.rows()) + " colors");
  }
  for (Index j = 0; j < handle_colors.rows(); ++j)
  {
    const auto color = handle_colors.row(j).array();
    if (!(color >= 0.0).all() || !(color <= 1.0).all())
    {
      return Status::invalid_input(
        "the color of handle " + std::to_string(j) + " must have components from 0 to 1");
    }
  }
  Colors blended = handle_colors;
  if (options.linear_light)
  {
    blended = blended.unaryExpr(&to_linear_light);
  }
  const Vec3 minimum_color = blended.colwise().minCoeff().transpose();
  const Vec3 maximum_color = blended.colwise().maxCoeff().transpose();

  result.colors.resize(rows, 3);
  result.out_of_gamut.assign(static_cast<std::size_t>(rows), 0);
  std::vector<Tally> tallies(
    static_cast<std::size_t>((rows + colors_per_block - 1) / colors_per_block));
  const bool done = parallel_for(context, rows, colors_per_block,
    [&](Index begin, Index end)
    {
      Tally& tally = tallies[static_cast<std::size_t>(begin / colors_per_block)];
      for (Index v = begin; v < end; ++v)
      {
        Vec3 color = (weights.row(v) * blended).transpose();
        if (!color.allFinite())
        {
          tally.first_nonfinite = tally.first_nonfinite < 0 ? v : tally.first_nonfinite;
          continue;
        }
        const double gamut = distance_outside(color, Vec3::Zero(), Vec3::Ones());
        const double overshoot = distance_outside(color, minimum_color, maximum_color);
        result.out_of_gamut[static_cast<std::size_t>(v)] = gamut > gamut_tolerance;
        tally.out_of_gamut += gamut > gamut_tolerance;
        tally.beyond_handles += overshoot > gamut_tolerance;
        tally.gamut_violation = std::max(tally.gamut_violation, gamut);
        tally.overshoot = std::max(tally.overshoot, overshoot);
        tally.row_sum_error = std::max(tally.row_sum_error, std::abs(weights.row(v).sum() - 1.0));
        if (options.clamp)
        {
          color = color.cwiseMax(0.0).cwiseMin(1.0);
        }
        if (options.linear_light)
        {
          color = color.unaryExpr(&from_linear_light);
        }
        result.colors.row(v) = color.transpose();
      }
    });
  if (!done)
  {
    return Status::canceled();
  }
  Tally all;
  for (const Tally& tally : tallies)
  {
    if (tally.first_nonfinite >= 0)
    {
      return Status::invalid_input(
        "a weight of vertex " + std::to_string(tally.first_nonfinite) + " is not a finite number");
    }
    all.out_of_gamut += tally.out_of_gamut;
    all.beyond_handles += tally.beyond_handles;
    all.gamut_violation = std::max(all.gamut_violation, tally.gamut_violation);
    all.overshoot = std::max(all.overshoot, tally.overshoot);
    all.row_sum_error = std::max(all.row_sum_error, tally.row_sum_error);
  }
  Status status;
  status.report.set("counts.out_of_gamut", all.out_of_gamut);
  status.report.set("largest_gamut_violation", all.gamut_violation);
  status.report.set("counts.beyond_handles", all.beyond_handles);
  status.report.set("largest_overshoot", all.overshoot);
  status.report.set("row_sum_error", all.row_sum_error);
  return status;
}

} // namespace bindpose
