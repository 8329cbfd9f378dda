#ifndef bindpose_weights_weighted_colors_h
#define bindpose_weights_weighted_colors_h

#include "base/execution.h"
#include "base/mesh.h"

#include <cstdint>
#include <vector>

namespace bindpose
{

/// Red, green and blue, each 0 to 1, as a screen takes them (sRGB): one row a handle or a vertex.
using Colors = Points;
using ColorsView = PointsView;

struct WeightedColorsOptions
{
  /// Blend amounts of light instead of the numbers that a screen takes: mixes of strong colours do
  /// not darken (red and green make yellow, not brown), the middle between black and white is
  /// lighter. On by default.
  bool linear_light = true;
  /// Cut the result to 0 to 1.
  bool clamp = true;
};

struct WeightedColors
{
  Colors colors; ///< #V x 3
  /// #V: 1 where the blend left 0 to 1 by more than 1e-6, before it was clamped.
  std::vector<std::uint8_t> out_of_gamut;
};

/// c_i = sum_j w_ij c_j, and what tells good weights from others: how many vertices leave what can
/// be shown, and how many have more or less of a primary than any handle (a new hue).
/// Weights that are at least 0 and sum to one do neither.
/// Report: counts.out_of_gamut and largest_gamut_violation (distance from 0 to 1, in the numbers
/// that are blended, before clamping), counts.beyond_handles and largest_overshoot (the same
/// against the least and the most of each primary over the handles), row_sum_error.
/// @param weights #V x #handles, finite
/// @param handle_colors #handles x 3, each 0 to 1
Status weighted_colors(WeightsView weights, ColorsView handle_colors,
  const WeightedColorsOptions& options, ExecutionContext& context, WeightedColors& result);

/// The amount of light of a screen's number (IEC 61966-2-1), and back. Odd functions, so that what
/// is below 0 stays below.
double to_linear_light(double encoded);
double from_linear_light(double linear);

/// Colours for handles that have none: eight that the colour-blind can tell apart (Okabe and Ito),
/// then again, lighter.
Colors categorical_colors(Index count);

} // namespace bindpose

#endif
