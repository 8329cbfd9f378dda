#ifndef bindpose_pictures_legend_h
#define bindpose_pictures_legend_h

#include "scene/colors.h"

#include <string>

class vtkRenderer;

namespace bindpose
{

/// A rectangle in a window, in pixels from the lower left corner.
struct PixelBox
{
  int x = 0, y = 0, width = 0, height = 0;
};

enum class TextAlignment
{
  left,
  center,
  right
};

/// Add one line of text. Horizontally, `x` is the left end, the center or the right end of the
/// text, as `align` states. Vertically, `y` is the middle of the text.
/// @param size  font size in pixels
void add_text(vtkRenderer* renderer, const std::string& text, double x, double y, int size,
  TextAlignment align, bool bold = false, const Rgb& text_color = palette::text);

/// Add a legend that fills the box: a vertical bar with the map's colors, the ticks on its right,
/// and the name above it. If the map has no ticks, only the name is drawn.
void add_legend(vtkRenderer* renderer, const ColorMap& map, const std::string& name,
  const PixelBox& box, int font_size, const Rgb& text_color = palette::text);

/// Return the width in pixels that add_legend needs.
int legend_width(const ColorMap& map, const std::string& name, int font_size);

} // namespace bindpose

#endif
