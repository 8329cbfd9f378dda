// Draws legends from flat quads and lines of text. vtkScalarBarActor is not used, because it scales
// its text to the available space, so that the font size would differ between pictures.
#include "pictures/legend.h"

#include "base/number_text.h"

#include "vtkActor2D.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCoordinate.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkProperty2D.h"
#include "vtkRenderer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bindpose
{
namespace
{
std::string tick_text(const ColorMap& map, std::size_t tick)
{
  if (!map.texts.empty())
  {
    return map.texts[tick];
  }
  if (map.decimals < 0)
  {
    return short_number(map.ticks[tick], legend_digits);
  }
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", map.decimals, map.ticks[tick]);
  return text;
}

// Return an upper bound of the width of bold text, in pixels. The bound determines the reserved
// space.
double text_width(const std::string& text, int font_size)
{
  return 0.66 * font_size * static_cast<double>(text.size());
}

// Return the estimated width of text that is not bold, in pixels. Long texts use the average width
// of a letter, because the differences between letters average out. Short texts use text_width().
double estimated_width(const std::string& text, int font_size)
{
  constexpr std::size_t long_text_size = 8;
  return text.size() > long_text_size ? 0.54 * font_size * static_cast<double>(text.size())
                                      : text_width(text, font_size);
}

int bar_width(int font_size)
{
  return static_cast<int>(1.1 * font_size);
}

class FlatShapes
{
public:
  void add_box(double x0, double y0, double x1, double y1, const Rgb& color)
  {
    const vtkIdType corners[4] = { this->points_->InsertNextPoint(x0, y0, 0.0),
      this->points_->InsertNextPoint(x1, y0, 0.0), this->points_->InsertNextPoint(x1, y1, 0.0),
      this->points_->InsertNextPoint(x0, y1, 0.0) };
    this->quads_->InsertNextCell(4, corners);
    for (const double c : color)
    {
      this->colors_->InsertNextValue(static_cast<unsigned char>(std::lround(255.0 * c)));
    }
  }

  void add_to(vtkRenderer* renderer)
  {
    this->colors_->SetName("Colors");
    vtkNew<vtkPolyData> data;
    data->SetPoints(this->points_);
    data->SetPolys(this->quads_);
    data->GetCellData()->SetScalars(this->colors_);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(data);
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    renderer->AddActor2D(actor);
  }

  FlatShapes() { this->colors_->SetNumberOfComponents(3); }

private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> quads_;
  vtkNew<vtkUnsignedCharArray> colors_;
};
} // namespace

void add_text(vtkRenderer* renderer, const std::string& text, double x, double y, int size,
  TextAlignment align, bool bold, const Rgb& text_color)
{
  if (text.empty())
  {
    return;
  }
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  vtkTextProperty* property = actor->GetTextProperty();
  property->SetFontFamilyToArial();
  property->SetFontSize(size);
  property->SetBold(bold);
  property->SetColor(text_color[0], text_color[1], text_color[2]);
  property->SetVerticalJustificationToCentered();
  property->SetJustification(align == TextAlignment::left ? VTK_TEXT_LEFT
      : align == TextAlignment::center                    ? VTK_TEXT_CENTERED
                                                          : VTK_TEXT_RIGHT);
  actor->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  actor->SetPosition(x, y);
  renderer->AddActor2D(actor);
}

int legend_width(const ColorMap& map, const std::string& name, int font_size)
{
  double ticks = 0.0;
  for (std::size_t i = 0; i < map.ticks.size(); ++i)
  {
    ticks = std::max(ticks, estimated_width(tick_text(map, i), font_size));
  }
  const double bar = bar_width(font_size) + 0.6 * font_size + ticks;
  return static_cast<int>(std::ceil(std::max(bar, text_width(name, font_size))));
}

void add_legend(vtkRenderer* renderer, const ColorMap& map, const std::string& name,
  const PixelBox& box, int font_size, const Rgb& text_color)
{
  const double name_height = 2.0 * font_size;
  // half the height of a tick's text extends below the bar
  const double bottom = box.y + 0.5 * font_size;
  const double top = box.y + box.height - name_height;
  const double left = box.x;
  const double right = box.x + bar_width(font_size);
  const double line = std::max(1.0, std::round(font_size / 14.0));
  add_text(renderer, name, left, box.y + box.height - 0.5 * font_size, font_size,
    TextAlignment::left, true, text_color);
  if (map.ticks.empty())
  {
    return; // without ticks only the name is drawn
  }
  FlatShapes shapes;
  shapes.add_box(left - line, bottom - line, right + line, top + line, text_color);
  const int count = static_cast<int>(map.table->GetNumberOfTableValues());
  for (int i = 0; i < count; ++i)
  {
    Rgb color{};
    double rgba[4];
    map.table->GetTableValue(i, rgba);
    std::copy_n(rgba, 3, color.begin());
    const int row = map.first_at_top ? count - 1 - i : i;
    shapes.add_box(left, bottom + (top - bottom) * row / count, right,
      bottom + (top - bottom) * (row + 1) / count, color);
  }
  for (std::size_t i = 0; i < map.ticks.size(); ++i)
  {
    const double tick = map.first_at_top ? map.lower + map.upper - map.ticks[i] : map.ticks[i];
    const double y = bottom + (top - bottom) * (tick - map.lower) / (map.upper - map.lower);
    shapes.add_box(right, y - 0.5 * line, right + 0.3 * font_size, y + 0.5 * line, text_color);
    add_text(renderer, tick_text(map, i), right + 0.6 * font_size, y, font_size,
      TextAlignment::left, false, text_color);
  }
  shapes.add_to(renderer);
}

} // namespace bindpose
