#ifndef bindpose_scene_colours_h
#define bindpose_scene_colours_h

#include "vtkLookupTable.h"
#include "vtkSmartPointer.h"

#include <array>
#include <string>
#include <vector>

namespace bindpose
{

/// Red, green, blue in [0, 1].
using Rgb = std::array<double, 3>;

/// The house's colours, one place for pictures and window.
namespace palette
{
constexpr Rgb surface{ 0.83, 0.80, 0.76 }; ///< a shape without data: warm grey
constexpr Rgb cut{ 0.52, 0.74, 0.75 }; ///< tets that a cut lays open
constexpr Rgb cut_edges{ 0.17, 0.30, 0.33 }; ///< their edges
constexpr Rgb curve{ 0.05, 0.46, 0.32 }; ///< boundary curves: green, which no map holds
constexpr Rgb line{ 0.16, 0.16, 0.18 }; ///< isolines, frames
constexpr Rgb outline{ 0.24, 0.23, 0.22 }; ///< where a shape turns away
constexpr Rgb edges{ 0.44, 0.42, 0.40 }; ///< triangle edges of a surface
constexpr Rgb text{ 0.16, 0.16, 0.18 }; ///< labels on a light background
constexpr Rgb white{ 1.0, 1.0, 1.0 }; ///< paper
constexpr Rgb gradient_top{ 0.90, 0.91, 0.93 }; ///< gradient background, above
constexpr Rgb gradient_bottom{ 0.98, 0.98, 0.97 }; ///< and below
constexpr Rgb dark_text{ 0.90, 0.90, 0.89 }; ///< labels on a dark background
constexpr Rgb dark_gradient_top{ 0.20, 0.21, 0.23 };
constexpr Rgb dark_gradient_bottom{ 0.13, 0.13, 0.14 };
constexpr Rgb missing{ 0.62, 0.58, 0.60 }; ///< not a number
} // namespace palette

/// The sequential map at t in [0, 1] (clamped): from near the plain surface's grey over green and
/// teal to deep blue. Lightness falls strictly and evenly, so it reads the same for colour-blind
/// eyes and in grey print.
Rgb sequential_colour(double t);

/// The winding number's map: blue at 0, white at 0.5, orange at 1; darker and of another hue,
/// with a jump, below -0.02 (violet, deep at -1) and above 1.02 (brown, deep at 2), so that
/// inside-out and doubly covered places show at once. 0.02 is the tolerance for rounding and for
/// open surfaces far away.
Rgb winding_colour(double winding_number);

/// The diverging map at t in [-1, 1] (clamped): white at 0, ever darker blue below, orange to brown
/// above. Lightness falls evenly on both sides; colour-blind eyes tell blue from orange.
Rgb diverging_colour(double t);

/// How values become colours, and how the legend tells it.
struct ColourMap
{
  vtkSmartPointer<vtkLookupTable> table;
  double lower = 0.0; ///< of the table and the legend
  double upper = 1.0;
  std::vector<double> ticks; ///< values that the legend names
  int decimals = 1; ///< of their texts; -1: shortest text with three digits
  std::vector<std::string> texts; ///< of the ticks, instead of their numbers; empty: the numbers
  bool downwards = false; ///< the legend begins above, as a list does
};

/// Ten bands of equal colour over [0, 1].
ColourMap weight_map();
/// The same colours in ten bands over [lower, upper], or smooth with bands = 0.
ColourMap sequential_map(double lower, double upper, int bands);
/// diverging_colour over [lower, upper], white at the centre, which lies within; equal distances
/// from it are equally dark.
ColourMap diverging_map(double lower, double upper, double centre);
/// winding_colour over [-1, 2]; what lies beyond looks like the ends.
ColourMap winding_map();

/// The map's colour of a value; beyond the ends the end's.
Rgb colour_of(const ColourMap& map, double value);
/// A legend of single values: for each, from below, a field in its colour of the map.
ColourMap level_map(const ColourMap& map, const std::vector<double>& levels);
/// The map with the levels among its ticks; ticks that would touch them are left out.
ColourMap with_levels(ColourMap map, const std::vector<double>& levels);
/// Of short_number, as legends write values.
constexpr int legend_digits = 3;

} // namespace bindpose

#endif
