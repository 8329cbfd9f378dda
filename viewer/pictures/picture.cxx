// Renders datasets to a picture. A picture has three layers: the background over the whole window;
// one renderer per tile (dataset), all with the same camera; text and legend on top. The picture is
// drawn in parts at a higher resolution, and each pixel is the average of its samples. The driver's
// antialiasing is not sufficient, because it smooths neither isolines nor color bands.
#include "pictures/picture.h"

#include "base/number_text.h"
#include "conversion.h"
#include "io/atomic_file.h"
#include "look_file.h"
#include "pictures/display.h"
#include "pictures/legend.h"
#include "pictures/tile_actors.h"
#include "pictures/window_picture.h"
#include "scene/categories.h"
#include "scene/extrema.h"
#include "scene/volume.h"

#include "vtkCamera.h"
#include "vtkDataSet.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{
namespace
{
/// A color map with its name.
struct Legend
{
  ColorMap map;
  std::string name;
};

struct Layout
{
  std::vector<PixelBox> tiles; // the area of each tile in the window
  std::vector<PixelBox> label_boxes; // area of the label below each tile
  std::vector<PixelBox> legends; // areas of the legends right of the tiles, from top to bottom
  int font = 12; // window pixels
  double title_y = 0.0;
};

Status check_options(const std::vector<Tile>& tiles, const PictureOptions& options)
{
  const auto is_in_range = [](double value, double lower, double upper)
  { return value >= lower && value <= upper; };
  if (!is_in_range(options.width, 16, 8192) || !is_in_range(options.height, 16, 8192))
  {
    return Status::invalid_input(
      "the width and height of a picture must be from 16 to 8192 pixels, got " +
      std::to_string(options.width) + " x " + std::to_string(options.height));
  }
  if (!is_in_range(options.scale, 1, largest_scale_factor))
  {
    return Status::invalid_input("the scale factor of a picture must be from 1 to " +
      std::to_string(largest_scale_factor) + ", got " + std::to_string(options.scale));
  }
  const Status size = check_picture_size(
    std::int64_t(options.width) * options.scale, std::int64_t(options.height) * options.scale);
  if (!size.ok())
  {
    return size;
  }
  if (!is_in_range(options.supersampling, 1, 4))
  {
    return Status::invalid_input("supersampling must be from 1 to 4");
  }
  if (!is_in_range(options.section, 0.0, 1.0))
  {
    return Status::invalid_input(
      "the position of the section must be between 0 (back) and 1 (front)");
  }
  if (options.section_plane &&
    (!options.section_plane->origin.allFinite() || !options.section_plane->normal.allFinite() ||
      options.section_plane->normal.norm() <= 0.0))
  {
    return Status::invalid_input(
      "the section plane must have a finite point and a finite nonzero normal");
  }
  if (!(options.shrink > 0.0 && options.shrink <= 1.0))
  {
    return Status::invalid_input("the size of shrunk tets must be above 0 and at most 1");
  }
  if (!is_in_range(options.view.zoom, 1e-3, 1e3))
  {
    return Status::invalid_input("the zoom must be between 0.001 and 1000");
  }
  for (const double level : options.isosurfaces)
  {
    if (!std::isfinite(level))
    {
      return Status::invalid_input("the level of an isosurface must be a finite number");
    }
  }
  if (options.isosurfaces.size() > 16)
  {
    return Status::invalid_input("a picture can show at most 16 isosurfaces, got " +
      std::to_string(options.isosurfaces.size()));
  }
  for (const Tile& tile : tiles)
  {
    for (const auto& data : tile.context)
    {
      const bool empty = data && data->GetNumberOfPoints() == 0 && !is_defect_data(data);
      if (!data || empty || vtkImageData::SafeDownCast(data))
      {
        return Status::invalid_input("the context of a picture must be a surface, tets or curves");
      }
    }
  }
  if (!std::isfinite(options.view.azimuth) || !std::isfinite(options.view.elevation))
  {
    return Status::invalid_input("azimuth and elevation must be finite numbers of degrees");
  }
  const std::string& up = options.view.up;
  if (up != "auto" && up != "x" && up != "y" && up != "z")
  {
    return Status::invalid_input("up must be auto, x, y or z, got '" + up + "'");
  }
  if (options.columns < 0)
  {
    return Status::invalid_input("the number of columns must not be negative");
  }
  if (tiles.empty())
  {
    return Status::invalid_input("the picture has no data to draw");
  }
  for (std::size_t i = 0; i < tiles.size(); ++i)
  {
    if ((!tiles[i].data || tiles[i].data->GetNumberOfPoints() == 0) && !tiles[i].handles)
    {
      return Status::invalid_input(tiles.size() == 1
          ? std::string("the dataset is empty")
          : "dataset " + std::to_string(i + 1) + " of the picture is empty");
    }
  }
  return Status();
}

bool has_tets(const Tile& tile)
{
  TetInput tets;
  return vtkPointSet::SafeDownCast(tile.data) && to_tets(tile.data, tets).ok();
}

// Return an error if shrinking, a slice or a section plane is requested but would have no effect.
Status check_tets(const std::vector<Tile>& tiles, const PictureOptions& options)
{
  const bool tets = std::any_of(tiles.begin(), tiles.end(), has_tets);
  if (options.shrink < 1.0 && !tets)
  {
    return Status::invalid_input("shrinking needs tets, but the picture has none");
  }
  if (options.slice && (!tets || !options.cut || options.shrink < 1.0))
  {
    return Status::invalid_input(!tets ? "a slice needs tets, but the picture has none"
        : options.cut                  ? "a slice cannot be combined with shrunk tets"
                                       : "a slice needs a section");
  }
  const bool volumes = std::any_of(tiles.begin(), tiles.end(),
    [](const Tile& tile) { return vtkImageData::SafeDownCast(tile.data) != nullptr; });
  if (options.section_plane && !tets && !volumes)
  {
    return Status::invalid_input(
      "a section plane needs tets or a volume, but the picture has none");
  }
  return {};
}

// Count all defects of the picture. A dataset that several tiles show is counted once.
std::vector<Category> all_defects(const std::vector<Tile>& tiles, bool& any)
{
  std::vector<Category> categories = defect_categories();
  std::vector<vtkDataSet*> counted;
  const auto add = [&](vtkDataSet* data)
  {
    if (is_defect_data(data) && std::find(counted.begin(), counted.end(), data) == counted.end())
    {
      counted.push_back(data);
      count_defects(vtkPolyData::SafeDownCast(data), categories);
    }
  };
  for (const Tile& tile : tiles)
  {
    add(tile.data);
    any = any || tile.defects;
    add(tile.defects);
    for (const auto& data : tile.context)
    {
      add(data);
    }
  }
  any = any || !counted.empty();
  return categories;
}

// Check whether the data allows the requested isosurfaces and volume rendering. Warn of levels that
// no value reaches.
Status check_volumes(
  const std::vector<Tile>& tiles, const PictureOptions& options, const Coloring& coloring)
{
  if (coloring.subtracted_data && !options.isosurfaces.empty())
  {
    return Status::invalid_input("a difference cannot be shown by isosurfaces; use a slice");
  }
  if (options.volume && coloring.kind != Coloring::Kind::winding)
  {
    return Status::invalid_input("volume rendering supports only the array WindingNumber of a "
                                 "volume (a .vti file), without a range");
  }
  Status result;
  double lower = 1e300;
  double upper = -1e300;
  for (const Tile& tile : tiles)
  {
    if (!vtkImageData::SafeDownCast(tile.data))
    {
      continue;
    }
    const Status status = check_volume(tile.data, coloring.array);
    if (!status.ok())
    {
      return status;
    }
    lower = std::min(lower, status.report.number("volume.minimum", lower));
    upper = std::max(upper, status.report.number("volume.maximum", upper));
  }
  if (lower > upper)
  {
    return Status::invalid_input("isosurfaces need a volume (a .vti file)");
  }
  for (const double level : options.isosurfaces)
  {
    if (!(level > lower && level <= upper))
    {
      result.warnings.push_back("no isosurface at " + short_number(level, legend_digits) +
        ": the values range from " + short_number(lower, legend_digits) + " to " +
        short_number(upper, legend_digits));
    }
  }
  return result;
}

bool needs_depth_sort(const std::vector<Tile>& tiles, const PictureOptions& options)
{
  return options.isosurfaces.size() > 1 ||
    std::any_of(tiles.begin(), tiles.end(),
      [](const Tile& tile)
      {
        return !tile.context.empty() || tile.defects ||
          (tile.look && tile.look->surface.is_translucent());
      });
}

// Choose the number of columns of tiles for which the shapes appear as large as possible.
int choose_columns(int count, double width, double height, double shape_aspect)
{
  int best = 1;
  double best_size = 0.0;
  for (int columns = 1; columns <= count; ++columns)
  {
    const int rows = (count + columns - 1) / columns;
    const double size = std::min(width / columns / shape_aspect, height / rows);
    if (size > best_size * (1.0 + 1e-9))
    {
      best_size = size;
      best = columns;
    }
  }
  return best;
}

// Largest fraction of the picture's height that lists of names may occupy.
constexpr double maximum_list_fraction = 0.94;

// Return the color map of the legend. Without isosurfaces, the result is the map itself. For
// isosurfaces, the result has one field per level. If there is also a volume rendering, the result
// is the map with the levels as additional ticks.
ColorMap make_legend_map(const PictureOptions& options, const ColorMap& map)
{
  if (options.isosurfaces.empty())
  {
    return map;
  }
  return options.volume ? with_levels(map, options.isosurfaces)
                        : level_map(map, options.isosurfaces);
}

// Place the legends at the right border, each as high as necessary. The stack of legends is
// centered vertically. Lists that do not fit are shortened.
int place_legends(std::vector<Legend>& legends, int width, int top, Layout& layout)
{
  const int margin = layout.font;
  for (Legend& legend : legends)
  {
    if (legend.map.first_at_top)
    {
      legend.map = shorten_legend(legend.map,
        static_cast<int>(maximum_list_fraction * top / legends.size() / (1.25 * margin)) - 3);
    }
  }
  int right = width;
  int height = 0;
  for (const Legend& legend : legends)
  {
    PixelBox box;
    box.width = legend_width(legend.map, legend.name, layout.font);
    // Height as a multiple of the font size: a constant for a color bar, 1.7 per entry for a list.
    const double fields = legend.map.texts.empty() ? 17.5 : 1.7 * legend.map.texts.size();
    const double height_fraction = legend.map.first_at_top
      ? maximum_list_fraction / legends.size()
      : 0.62 / std::min<double>(legends.size(), 1.5);
    box.height = static_cast<int>(std::min(height_fraction * top, (2.5 + fields) * layout.font));
    height += box.height + (height > 0 ? 2 * margin : 0);
    right = std::min(right, width - margin - box.width - margin / 2);
    layout.legends.push_back(box);
  }
  int y = (top + height) / 2;
  for (PixelBox& box : layout.legends)
  {
    y -= box.height;
    box.x = right + margin / 2;
    box.y = y;
    y -= 2 * margin;
  }
  return right;
}

Layout make_layout(const std::vector<Tile>& tiles, const PictureOptions& options,
  std::vector<Legend>& legends, double shape_aspect)
{
  const int scale = options.supersampling * options.scale;
  const int width = options.width * scale;
  const int height = options.height * scale;
  Layout layout;
  layout.font = scale *
    std::clamp(
      static_cast<int>(std::lround(std::min(options.width, options.height) / 42.0)), 10, 40);
  int top = height;
  if (!options.title.empty())
  {
    top -= static_cast<int>(2.6 * layout.font);
    layout.title_y = height - 1.5 * layout.font;
  }
  const int right = place_legends(legends, width, top, layout);
  const int count = static_cast<int>(tiles.size());
  const int columns = options.columns > 0 ? std::min(options.columns, count)
                                          : choose_columns(count, right, top, shape_aspect);
  const int rows = (count + columns - 1) / columns;
  const bool labeled =
    std::any_of(tiles.begin(), tiles.end(), [](const Tile& tile) { return !tile.label.empty(); });
  const int label_height = labeled ? static_cast<int>(2.0 * layout.font) : 0;
  for (int i = 0; i < count; ++i)
  {
    const int column = i % columns;
    const int row = i / columns;
    PixelBox box;
    box.x = right * column / columns;
    box.width = right * (column + 1) / columns - box.x;
    box.y = top * (rows - row - 1) / rows;
    box.height = top * (rows - row) / rows - box.y;
    PixelBox label = box;
    label.height = label_height;
    layout.label_boxes.push_back(label);
    box.y += label_height;
    box.height = std::max(1, box.height - label_height);
    layout.tiles.push_back(box);
  }
  return layout;
}

Eigen::Matrix4d world_to_pixel(vtkCamera* camera, const PixelBox& box, double scale)
{
  vtkMatrix4x4* matrix = camera->GetCompositeProjectionTransformMatrix(
    static_cast<double>(box.width) / box.height, -1.0, 1.0);
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> projection(
    matrix->GetData());
  Eigen::Matrix4d viewport = Eigen::Matrix4d::Identity();
  viewport(0, 0) = 0.5 * box.width / scale;
  viewport(0, 3) = (box.x + 0.5 * box.width) / scale;
  viewport(1, 1) = 0.5 * box.height / scale;
  viewport(1, 3) = (box.y + 0.5 * box.height) / scale;
  return viewport * projection;
}

Points all_points(const std::vector<Tile>& tiles, const PictureOptions& options,
  const Coloring& coloring, const Frame* frame)
{
  std::vector<Points> parts;
  Index count = 0;
  for (const Tile& tile : tiles)
  {
    parts.push_back(shown_points(tile, options, coloring, frame));
    count += parts.back().rows();
  }
  Points points(count, 3);
  Index row = 0;
  for (const Points& part : parts)
  {
    points.middleRows(row, part.rows()) = part;
    row += part.rows();
  }
  return points;
}
} // namespace

namespace
{
void report_categories(
  const std::vector<Category>& categories, const std::string& key, Report& report)
{
  std::vector<std::string> names;
  std::vector<std::int64_t> counts;
  for (const Category& category : categories)
  {
    if (category.count > 0)
    {
      names.push_back(category.name);
      counts.push_back(category.count);
    }
  }
  if (!names.empty())
  {
    report.set(key + ".name", names);
    report.set(key + ".count", counts);
  }
}
} // namespace

Eigen::Vector2d PictureGeometry::project(std::size_t tile, const Vec3& point) const
{
  return (this->tiles.at(tile).world_to_pixel * point.homogeneous()).hnormalized().head<2>();
}

Status render_to_image(const std::vector<Tile>& tiles, const PictureOptions& requested,
  vtkSmartPointer<vtkImageData>& image, PictureGeometry* geometry)
{
  PictureOptions options = requested;
  std::sort(options.isosurfaces.begin(), options.isosurfaces.end());
  options.isosurfaces.erase(
    std::unique(options.isosurfaces.begin(), options.isosurfaces.end()), options.isosurfaces.end());
  std::vector<Tile> view_tiles = tiles;
  view_tiles.insert(view_tiles.end(), options.undrawn_tiles.begin(), options.undrawn_tiles.end());
  Status status =
    tiles.empty() ? check_options(tiles, options) : check_options(view_tiles, options);
  Coloring coloring;
  if (status.ok())
  {
    status = choose_coloring(view_tiles, options, coloring);
  }
  if (status.ok() && (options.volume || !options.isosurfaces.empty()))
  {
    status = check_volumes(tiles, options, coloring);
  }
  std::vector<std::vector<Extremum>> extrema(tiles.size());
  if (status.ok() && options.extrema)
  {
    status = find_extrema(tiles, coloring, extrema);
  }
  const Status tets_status = status.ok() ? check_tets(tiles, options) : Status();
  if (!tets_status.ok())
  {
    return tets_status;
  }
  if (!status.ok())
  {
    return status;
  }
  if (!can_render())
  {
    return Status::failure(StatusCode::unavailable, no_display_message());
  }

  const Points all = all_points(view_tiles, options, coloring, nullptr);
  if (all.rows() == 0)
  {
    return Status::invalid_input("the picture has no data to draw");
  }
  if (!all.allFinite())
  {
    return Status::invalid_input("a coordinate is not finite");
  }
  const Frame frame = choose_frame(bounding_box(all), options.view.up);
  const Points points = all_points(view_tiles, options, coloring, &frame);
  const Vec3 size = bounding_box(points).size();
  const int horizontal_axis = 3 - frame.up - frame.depth;
  const double shape_aspect = std::clamp((size[horizontal_axis] + 1e-9 * size.norm() + 1e-300) /
      (size[frame.up] + 1e-9 * size.norm() + 1e-300),
    0.2, 5.0);
  std::vector<Legend> legends;
  // colors of clusters have no names, so they get no legend
  const bool has_ticks = !coloring.map.ticks.empty();
  if (options.legend && coloring.kind != Coloring::Kind::none && has_ticks)
  {
    legends.push_back({ make_legend_map(options, coloring.map), coloring.legend_name() });
  }
  bool with_defects = false;
  const std::vector<Category> defects = all_defects(tiles, with_defects);
  if (options.legend && with_defects)
  {
    legends.push_back({ category_map(defects), "Defects" });
    legends.back().name = legends.back().map.texts.empty() ? "No defects" : "Defects";
  }
  const std::vector<Category> extrema_counts = count_extrema(extrema);
  if (options.legend && options.extrema)
  {
    legends.push_back({ category_map(extrema_counts), "Extrema" });
    legends.back().name = legends.back().map.texts.empty() ? "No extrema" : "Extrema";
  }
  const Layout layout = make_layout(tiles, options, legends, shape_aspect);
  const int samples = options.supersampling;
  const int scale = samples * options.scale;
  const int width = options.width * scale;
  const int height = options.height * scale;

  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetAlphaBitPlanes(1);
  // With several samples per pixel, the driver cannot sort translucent surfaces by depth.
  window->SetMultiSamples(samples > 1 && !needs_depth_sort(tiles, options) ? 4 : 0);
  window->SetNumberOfLayers(3);

  vtkNew<vtkRenderer> background_renderer;
  background_renderer->SetLayer(0);
  const bool transparent = options.background == Background::transparent;
  const bool gradient = options.background == Background::gradient;
  const Rgb lower = gradient ? palette::gradient_bottom : palette::white;
  background_renderer->SetBackground(lower[0], lower[1], lower[2]);
  background_renderer->SetGradientBackground(gradient);
  background_renderer->SetBackground2(
    palette::gradient_top[0], palette::gradient_top[1], palette::gradient_top[2]);
  window->AddRenderer(background_renderer);

  DrawnCounts drawn_counts;
  std::vector<std::int64_t> extrema_drawn;
  vtkNew<vtkCamera> camera;
  const PixelBox& first = layout.tiles.front();
  fit_camera(camera, points, frame, options.view, static_cast<double>(first.width) / first.height);
  for (std::size_t i = 0; i < tiles.size(); ++i)
  {
    const PixelBox& box = layout.tiles[i];
    vtkNew<vtkRenderer> renderer;
    renderer->SetLayer(1);
    renderer->SetViewport(static_cast<double>(box.x) / width, static_cast<double>(box.y) / height,
      static_cast<double>(box.x + box.width) / width,
      static_cast<double>(box.y + box.height) / height);
    renderer->SetActiveCamera(camera);
    window->AddRenderer(renderer);
    add_lights(renderer);
    drawn_counts.extrema = 0;
    const Status drawn =
      add_tile(renderer, tiles[i], options, coloring, extrema[i], frame, scale, drawn_counts);
    if (!drawn.ok())
    {
      return drawn;
    }
    extrema_drawn.push_back(drawn_counts.extrema);
    if (geometry)
    {
      PictureGeometry::TileView view;
      view.world_to_pixel = world_to_pixel(camera, box, samples);
      view.x = box.x / samples;
      view.y = box.y / samples;
      view.width = box.width / samples;
      view.height = box.height / samples;
      geometry->tiles.resize(i);
      geometry->tiles.push_back(view);
    }
  }

  vtkNew<vtkRenderer> text_renderer;
  text_renderer->SetLayer(2);
  text_renderer->InteractiveOff();
  window->AddRenderer(text_renderer);
  add_text(text_renderer, options.title, 0.5 * width, layout.title_y,
    static_cast<int>(1.25 * layout.font), TextAlignment::center, true);
  for (std::size_t i = 0; i < tiles.size(); ++i)
  {
    const PixelBox& box = layout.label_boxes[i];
    add_text(text_renderer, tiles[i].label, box.x + 0.5 * box.width, box.y + 0.55 * box.height,
      layout.font, TextAlignment::center);
  }
  for (std::size_t i = 0; i < legends.size(); ++i)
  {
    add_legend(text_renderer, legends[i].map, legends[i].name, layout.legends[i], layout.font);
  }

  WindowPicture picture;
  picture.width = options.width * options.scale;
  picture.height = options.height * options.scale;
  picture.samples = samples;
  picture.transparent = transparent;
  const Status drawn = draw_in_tiles(window, picture, image);
  if (!drawn.ok())
  {
    return drawn;
  }

  status.report.set("picture.width", picture.width);
  status.report.set("picture.height", picture.height);
  status.report.set("picture.tiles", static_cast<int>(tiles.size()));
  if (drawn_counts.tets > 0)
  {
    status.report.set("picture.tets", drawn_counts.tets);
  }
  status.report.merge(coloring.numbers);
  if (options.extrema)
  {
    report_extrema(extrema, extrema_drawn, status.report);
  }
  report_categories(coloring.categories, "picture.colors[]", status.report);
  report_categories(defects, "picture.defects[]", status.report);
  if (coloring.kind != Coloring::Kind::none && coloring.categories.empty())
  {
    status.report.set("picture.array",
      Report::Value(coloring.by == ColorBy::quality ? std::string("quality") : coloring.array));
    if (!coloring.component_name.empty())
    {
      status.report.set("picture.component", Report::Value(coloring.component_name));
    }
    status.report.set("picture.range",
      Report::Value(std::vector<double>{ coloring.map.lower, coloring.map.upper }));
  }
  if (!options.isosurfaces.empty())
  {
    status.report.set("picture.isosurfaces", Report::Value(options.isosurfaces));
  }
  return status;
}

Status write_png(vtkImageData* image, const std::string& path, bool overwrite)
{
  AtomicFile file;
  Status status = file.open(path, overwrite);
  if (!status.ok())
  {
    return status;
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(file.temporary().c_str());
  writer->Write();
  if (writer->GetErrorCode() != vtkErrorCode::NoError)
  {
    return Status::invalid_input("cannot write '" + path + "'");
  }
  return file.commit();
}

Status render_to_png(const std::vector<Tile>& tiles, const PictureOptions& options,
  const std::string& path, bool overwrite)
{
  // Report a problem with the path before the work starts.
  Status status = AtomicFile::check(path, overwrite);
  vtkSmartPointer<vtkImageData> image;
  if (status.ok())
  {
    status = render_to_image(tiles, options, image);
  }
  if (status.ok())
  {
    const Status written = write_png(image, path, overwrite);
    if (!written.ok())
    {
      return written;
    }
  }
  return status;
}

} // namespace bindpose
