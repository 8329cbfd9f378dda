#ifndef bindpose_weights_weighted_colors_h
#define bindpose_weights_weighted_colors_h

#include "base/execution.h"
#include "base/mesh.h"

#include <cstdint>
#include <vector>

namespace bindpose
{

/// Red, green and blue in sRGB, each 0 to 1: one row per handle or vertex.
using Colors = Points;
using ColorsView = PointsView;

struct WeightedColorsOptions
{
  /// Blend amounts of light (linear sRGB) instead of encoded values. Mixtures of strong colors then
  /// do not darken (red and green make yellow, not brown), and the middle between black and white
  /// is lighter.
  bool linear_light = true;
  /// Clamp the result to [0, 1].
  bool clamp = true;
};

struct WeightedColors
{
  Colors colors; ///< #V x 3
  /// #V: 1 if the blend was outside of [0, 1] by more than 1e-6 before clamping.
  std::vector<std::uint8_t> out_of_gamut;
};

/// Compute c_i = sum_j w_ij c_j, and measures of the quality of the weights: the number of vertices
/// whose color cannot be displayed, and the number that have more or less of a primary than any
/// handle (a new hue). Both are zero for weights that are at least 0 and sum to one.
/// Report: counts.out_of_gamut and largest_gamut_violation (distance from [0, 1], of the values
/// that are blended, before clamping), counts.beyond_handles and largest_overshoot (the same for
/// the smallest and the largest value of each primary over the handles), row_sum_error.
/// @param weights #V x #handles, finite
/// @param handle_colors #handles x 3, each 0 to 1
Status weighted_colors(WeightsView weights, ColorsView handle_colors,
  const WeightedColorsOptions& options, ExecutionContext& context, WeightedColors& result);

/// Convert an sRGB value to an amount of light (IEC 61966-2-1), or back. Both functions are odd, so
/// negative values stay negative.
double to_linear_light(double encoded);
double from_linear_light(double linear);

/// Return colors for handles that have none: eight that color-blind people can distinguish (Okabe
/// and Ito), then the same colors again, lighter.
Colors categorical_colors(Index count);

} // namespace bindpose

#endif
