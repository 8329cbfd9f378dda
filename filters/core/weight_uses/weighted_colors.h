#ifndef bindpose_weight_uses_weighted_colors_h
#define bindpose_weight_uses_weighted_colors_h

#include "base/execution.h"
#include "geometry/mesh.h"

#include <cstdint>
#include <vector>

namespace bindpose
{

/// Red, green and blue in sRGB, each 0 to 1: one row per handle or vertex.
using Colors = Points;
using ColorsView = PointsView;

/// Options of weighted_colors(), which computes weighted sums of the colors of all handles.
struct WeightedColorsOptions
{
  /// If true, blend linear light; if false, blend encoded sRGB values. In linear light, mixtures of
  /// saturated colors are not darkened (red and green make yellow, not brown), and the middle
  /// between black and white is lighter.
  bool linear_light = true;
  /// Clamp the result to [0, 1].
  bool clamp = true;
};

/// The result of weighted_colors().
struct WeightedColors
{
  Colors colors; ///< #V x 3
  /// #V: 1 if the blended color was outside of [0, 1] by more than 1e-6 before clamping.
  std::vector<std::uint8_t> out_of_gamut;
};

/// Compute the blended colors c_i = sum_j w_ij c_j. Two numbers measure the quality of the weights:
/// the number of vertices with a color that cannot be displayed, and the number of vertices with a
/// red, green or blue value outside of the range of the handle colors. Both numbers are zero if all
/// weights are >= 0 and all rows sum to one. Report:
/// - counts.out_of_gamut: number of vertices with a color that cannot be displayed;
/// - largest_gamut_violation: largest distance of a blended value from [0, 1], before clamping;
/// - counts.beyond_handles: number of vertices with a value outside of the range of the handle
///   colors;
/// - largest_overshoot: largest distance of a red, green or blue value from the range of this
///   component over all handle colors;
/// - row_sum_error: largest |1 - row sum|.
/// @param weights #V x #handles, finite
/// @param handle_colors #handles x 3, each 0 to 1
Status weighted_colors(ExecutionContext& context, WeightsView weights, ColorsView handle_colors,
  const WeightedColorsOptions& options, WeightedColors& result);

/// Convert an sRGB value to linear light (IEC 61966-2-1), or back. Both functions are odd: a
/// negative argument changes only the sign of the result.
double to_linear_light(double encoded);
double from_linear_light(double linear);

/// Return default colors for handles: eight colors that color-blind people can distinguish (Okabe
/// and Ito). Each further group of eight handles gets the same colors, but lighter than in the
/// group before.
Colors categorical_colors(Index count);

} // namespace bindpose

#endif
