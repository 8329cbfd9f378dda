#ifndef bindpose_scene_legend_h
#define bindpose_scene_legend_h

#include "scene/colours.h"

#include <string>

class vtkRenderer;

namespace bindpose
{

/// A rectangle of a window, in its pixels from the lower left corner.
struct PixelBox
{
  int x = 0, y = 0, width = 0, height = 0;
};

enum class TextAlign
{
  left,
  center,
  right
};

/// One line of text; (x, y) is the left, middle or right end of its vertical middle.
/// @param size  font size in pixels
void add_text(vtkRenderer* renderer, const std::string& text, double x, double y, int size,
  TextAlign align, bool bold = false, const Rgb& ink = palette::text);

/// A vertical bar with the map's colours, its ticks right of it and the name above it, filling
/// the box; of a map without ticks the name only.
void add_legend(vtkRenderer* renderer, const ColourMap& map, const std::string& name,
  const PixelBox& box, int font_size, const Rgb& ink = palette::text);

/// Width that add_legend needs.
int legend_width(const ColourMap& map, const std::string& name, int font_size);

} // namespace bindpose

#endif
