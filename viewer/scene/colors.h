#ifndef bindpose_scene_colors_h
#define bindpose_scene_colors_h

#include "vtkLookupTable.h"
#include "vtkSmartPointer.h"

#include <array>
#include <string>
#include <vector>

class vtkProperty;

namespace bindpose
{

// Color maps of values, and the fixed colors of pictures.

/// Red, green, blue in [0, 1].
using Rgb = std::array<double, 3>;

/// Set the color of a surface or a line.
void set_color(vtkProperty* property, const Rgb& color);

/// The colors of Bindpose, used in pictures and in the window.
namespace palette
{
constexpr Rgb surface{ 0.83, 0.80, 0.76 }; ///< a shape without data: warm gray
constexpr Rgb cut{ 0.52, 0.74, 0.75 }; ///< tets that a cut exposes
constexpr Rgb cut_edges{ 0.17, 0.30, 0.33 }; ///< edges of the exposed tets
constexpr Rgb curve{ 0.05, 0.46, 0.32 }; ///< boundary curves: green, which no color map contains
constexpr Rgb line{ 0.16, 0.16, 0.18 }; ///< color of isolines and frames
constexpr Rgb outline{ 0.24, 0.23, 0.22 }; ///< silhouette of a shape
constexpr Rgb edges{ 0.44, 0.42, 0.40 }; ///< triangle edges of a surface
constexpr Rgb text{ 0.16, 0.16, 0.18 }; ///< labels on a light background
constexpr Rgb white{ 1.0, 1.0, 1.0 }; ///< white background
constexpr Rgb gradient_top{ 0.90, 0.91, 0.93 }; ///< gradient background, top
constexpr Rgb gradient_bottom{ 0.98, 0.98, 0.97 }; ///< gradient background, bottom
constexpr Rgb dark_text{ 0.90, 0.90, 0.89 }; ///< labels on a dark background
constexpr Rgb dark_gradient_top{ 0.20, 0.21, 0.23 };
constexpr Rgb dark_gradient_bottom{ 0.13, 0.13, 0.14 };
constexpr Rgb missing{ 0.62, 0.58, 0.60 }; ///< not a number
} // namespace palette

/// Return the color of the sequential map at t in [0, 1] (clamped). The map begins near the gray of
/// a surface without data, passes through green and teal, and ends at deep blue. Lightness
/// decreases strictly and evenly, so that the order of values is also visible to color-blind
/// viewers and in gray prints.
Rgb sequential_color(double t);

/// Return the color of a winding number: blue at 0, white at 0.5, orange at 1. Below -0.02 the
/// color jumps to a darker violet, which is deepest at -1. Above 1.02 the color jumps to a darker
/// brown, which is deepest at 2. Inside-out and doubly covered regions therefore stand out. The
/// tolerance of 0.02 allows for rounding and for the effect of distant open surfaces.
Rgb winding_color(double winding_number);

/// Return the color of the diverging map at t in [-1, 1] (clamped): white at 0, increasingly dark
/// blue below, orange to brown above. Lightness decreases evenly on both sides; color-blind viewers
/// can distinguish blue from orange.
Rgb diverging_color(double t);

/// The mapping of values to colors and its legend.
struct ColorMap
{
  vtkSmartPointer<vtkLookupTable> table;
  double lower = 0.0; ///< lower end of the table and the legend
  double upper = 1.0;
  std::vector<double> ticks; ///< values that are labeled in the legend
  /// Number of decimals of the tick texts; -1: as few as necessary, and at most three significant
  /// digits.
  int decimals = 1;
  std::vector<std::string> texts; ///< texts of the ticks; empty: the values
  bool first_at_top = false; ///< true: the first entry is at the top; false: at the bottom
};

/// Return the map of weights: ten bands of one color each over [0, 1].
ColorMap weight_map();
/// Return a map with the colors of weight_map(), in `bands` bands over [lower, upper], or without
/// bands if `bands` is 0.
ColorMap sequential_map(double lower, double upper, int bands);
/// Return a map of diverging_color() over [lower, upper], white at `center`, which must be within
/// the range. Values at equal distances from the center are equally dark.
ColorMap diverging_map(double lower, double upper, double center);
/// Return a map of winding_color() over [-1, 2]. Values outside get the color of the nearest end.
ColorMap winding_map();

/// Return the map's color of a value. Values outside get the color of the nearest end.
Rgb color_of(const ColorMap& map, double value);
/// Return a color map for a legend of single levels, which must be in ascending order. The legend
/// has one field per level, in the color that `map` gives to the level. The lowest level is at the
/// bottom.
ColorMap level_map(const ColorMap& map, const std::vector<double>& levels);
/// Add the levels to the ticks of the map. Ticks whose texts would overlap the text of a level are
/// removed.
ColorMap with_levels(ColorMap map, const std::vector<double>& levels);
/// Maximum number of significant digits of values in legends; see short_number().
constexpr int legend_digits = 3;

} // namespace bindpose

#endif
