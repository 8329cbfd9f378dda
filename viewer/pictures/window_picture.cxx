// Draws a picture of any size in tiles. A tile shows a part of each renderer's view. The renderer's
// viewport becomes the area of that part in the tile. A copy of the camera covers only the part,
// with a narrower view angle and a shifted window center. The positions of 2D actors are pixels of
// the viewport; they are shifted by the offset of the part from the lower left corner of the view.
// Tiles overlap by a margin that is cut off, because a wide line just outside a tile would not be
// drawn in the tile.
//
// A transparent picture is drawn twice, over black and over white; color and opacity are computed
// from both. This is correct for every drawing method. The framebuffer's own alpha is correct only
// for some methods (not for surfaces that are sorted by depth).
#include "pictures/window_picture.h"

#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkActor2DCollection.h"
#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWidgetRepresentation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <string>

namespace bindpose
{
namespace
{
/// Side length of a tile with its margins, and width of a margin, in samples. Any graphics card can
/// draw a tile of this size.
constexpr int tile_size = 3072;
constexpr int tile_margin = 160;

constexpr std::int64_t maximum_side = 32767;
constexpr std::int64_t maximum_pixels = std::int64_t(1) << 28;

struct Rect
{
  int x = 0, y = 0, width = 0, height = 0;
};

Rect common_part(const Rect& a, const Rect& b)
{
  Rect intersection;
  intersection.x = std::max(a.x, b.x);
  intersection.y = std::max(a.y, b.y);
  intersection.width = std::min(a.x + a.width, b.x + b.width) - intersection.x;
  intersection.height = std::min(a.y + a.height, b.y + b.height) - intersection.y;
  return intersection;
}

/// Makes a renderer show parts of its view; restores the renderer when the object is destroyed.
class TiledRenderer
{
public:
  TiledRenderer(vtkRenderer* renderer, int width, int height)
    : renderer_(renderer), camera_(renderer->GetActiveCamera()), draw_flag_(renderer->GetDraw())
  {
    renderer->GetViewport(this->viewport_.data());
    renderer->GetBackground(this->bottom_color_.data());
    renderer->GetBackground2(this->top_color_.data());
    this->gradient_ = renderer->GetGradientBackground();
    const auto to_pixels = [](double fraction, int size)
    { return static_cast<int>(std::lround(fraction * size)); };
    this->view_area_.x = to_pixels(this->viewport_[0], width);
    this->view_area_.y = to_pixels(this->viewport_[1], height);
    this->view_area_.width = to_pixels(this->viewport_[2], width) - this->view_area_.x;
    this->view_area_.height = to_pixels(this->viewport_[3], height) - this->view_area_.y;
    vtkActor2DCollection* actors_2d = renderer->GetActors2D();
    actors_2d->InitTraversal();
    while (vtkActor2D* actor = actors_2d->GetNextActor2D())
    {
      this->actors_2d_.push_back({ actor, { actor->GetPosition()[0], actor->GetPosition()[1] } });
    }
  }

  ~TiledRenderer()
  {
    this->renderer_->SetViewport(this->viewport_.data());
    this->renderer_->SetActiveCamera(this->camera_);
    this->renderer_->SetDraw(this->draw_flag_);
    this->renderer_->SetBackground(this->bottom_color_.data());
    this->renderer_->SetBackground2(this->top_color_.data());
    this->renderer_->SetGradientBackground(this->gradient_);
    for (const auto& [actor, position] : this->actors_2d_)
    {
      actor->SetPosition(position[0], position[1]);
    }
  }
  TiledRenderer(const TiledRenderer&) = delete;
  TiledRenderer& operator=(const TiledRenderer&) = delete;

  void show(const Rect& tile)
  {
    const Rect part = common_part(this->view_area_, tile);
    const bool is_visible = part.width > 0 && part.height > 0;
    this->renderer_->SetDraw(is_visible ? this->draw_flag_ : 0);
    if (!is_visible)
    {
      return;
    }
    this->renderer_->SetViewport(static_cast<double>(part.x - tile.x) / tile.width,
      static_cast<double>(part.y - tile.y) / tile.height,
      static_cast<double>(part.x + part.width - tile.x) / tile.width,
      static_cast<double>(part.y + part.height - tile.y) / tile.height);
    // The background gradient covers the whole view. Use the colors at the part's lower and upper
    // ends.
    if (this->renderer_->GetGradientBackground())
    {
      const double low = static_cast<double>(part.y - this->view_area_.y) / this->view_area_.height;
      const double high = low + static_cast<double>(part.height) / this->view_area_.height;
      this->renderer_->SetBackground(this->background_color(low).data());
      this->renderer_->SetBackground2(this->background_color(high).data());
    }
    vtkNew<vtkCamera> camera;
    camera->DeepCopy(this->camera_);
    const double fraction = static_cast<double>(part.height) / this->view_area_.height;
    camera->SetParallelScale(fraction * this->camera_->GetParallelScale());
    const double half = std::tan(0.5 * vtkMath::RadiansFromDegrees(this->camera_->GetViewAngle()));
    camera->SetViewAngle(2.0 * vtkMath::DegreesFromRadians(std::atan(fraction * half)));
    // Offset from the center of the view to the center of the part, in units of half the part's
    // size.
    camera->SetWindowCenter(
      (2.0 * (part.x - this->view_area_.x) + part.width - this->view_area_.width) / part.width,
      (2.0 * (part.y - this->view_area_.y) + part.height - this->view_area_.height) / part.height);
    this->renderer_->SetActiveCamera(camera);
    for (const auto& [actor, position] : this->actors_2d_)
    {
      actor->SetPosition(
        position[0] - (part.x - this->view_area_.x), position[1] - (part.y - this->view_area_.y));
    }
  }

  /// Set the background to a gray level if the renderer is in the lowest layer and nothing is drawn
  /// behind it.
  void set_background(double level)
  {
    if (this->renderer_->GetLayer() == 0)
    {
      this->renderer_->GradientBackgroundOff();
      this->renderer_->SetBackground(level, level, level);
    }
  }

private:
  using Color = std::array<double, 3>;
  Color background_color(double height) const
  {
    Color color{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      color[k] = (1.0 - height) * this->bottom_color_[k] + height * this->top_color_[k];
    }
    return color;
  }

  vtkSmartPointer<vtkRenderer> renderer_;
  vtkSmartPointer<vtkCamera> camera_;
  int draw_flag_;
  Color bottom_color_{}, top_color_{}; // lower and upper background colors of the renderer
  bool gradient_ = false;
  std::array<double, 4> viewport_{};
  Rect view_area_; // the area of the renderer's view in the picture
  std::vector<std::pair<vtkSmartPointer<vtkActor2D>, std::array<double, 2>>> actors_2d_;
};

/// The samples of a tile, four bytes per sample.
using Samples = vtkSmartPointer<vtkUnsignedCharArray>;

/// Return the average color of a pixel's samples: red, green and blue in [0, 255].
std::array<double, 3> average(const Samples& pixels, const Rect& tile, int x, int y, int samples)
{
  std::array<int, 3> sums{};
  for (int j = 0; j < samples; ++j)
  {
    const std::size_t row = static_cast<std::size_t>(y * samples + j - tile.y) * tile.width;
    const unsigned char* p = pixels->GetPointer(0) + 4 * (row + x * samples - tile.x);
    for (int i = 0; i < samples; ++i, p += 4)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        sums[k] += p[k];
      }
    }
  }
  std::array<double, 3> mean{};
  std::transform(sums.begin(), sums.end(), mean.begin(),
    [samples](int sum) { return static_cast<double>(sum) / (samples * samples); });
  return mean;
}

/// Fill the part of the image that a tile covers. For a transparent picture, `on_white` and
/// `on_black` are the samples of the tile, drawn on a white and on a black background; their
/// difference gives the opacity. For an opaque picture, `on_white` has the picture's background,
/// and `on_black` is null.
void fill_image(const Samples& on_white, const Samples& on_black, const Rect& tile,
  const Rect& part, int samples, vtkImageData* image)
{
  const auto byte = [](double value)
  { return static_cast<unsigned char>(std::clamp(std::lround(value), 0L, 255L)); };
  const int stop_x = (part.x + part.width) / samples;
  const int stop_y = (part.y + part.height) / samples;
  for (int y = part.y / samples; y < stop_y; ++y)
  {
    auto* to = static_cast<unsigned char*>(image->GetScalarPointer(part.x / samples, y, 0));
    for (int x = part.x / samples; x < stop_x; ++x)
    {
      const std::array<double, 3> white = average(on_white, tile, x, y, samples);
      if (!on_black)
      {
        to = std::transform(white.begin(), white.end(), to, byte);
        continue;
      }
      const std::array<double, 3> black = average(on_black, tile, x, y, samples);
      double background_fraction = 0.0; // visible fraction of the background
      for (std::size_t k = 0; k < 3; ++k)
      {
        background_fraction += (white[k] - black[k]) / (3.0 * 255.0);
      }
      const double opacity = 1.0 - background_fraction;
      // Make almost transparent pixels fully transparent, because they show only planes that are
      // drawn for picking.
      const bool clear = opacity < 1.5 / 255.0;
      to = std::transform(black.begin(), black.end(), to,
        [&](double value) { return clear ? byte(0.0) : byte(value / opacity); });
      *to++ = clear ? byte(0.0) : byte(255.0 * opacity);
    }
  }
}

Status read_samples(vtkRenderWindow* window, const Rect& tile, Samples& pixels)
{
  pixels = Samples::New();
  window->Render();
  window->GetRGBACharPixelData(0, 0, tile.width - 1, tile.height - 1, 0, pixels);
  return pixels->GetNumberOfTuples() == static_cast<vtkIdType>(tile.width) * tile.height
    ? Status()
    : Status::failure(StatusCode::internal_error, "cannot read the picture back from OpenGL");
}

/// Return the length of a tile without margins; the length of the whole picture if it fits into one
/// tile.
int core_length(int length, int samples)
{
  return length <= tile_size ? length : (tile_size - 2 * tile_margin) / samples * samples;
}

Rect with_margins(const Rect& core, int width, int height)
{
  Rect tile;
  tile.x = std::max(0, core.x - tile_margin);
  tile.y = std::max(0, core.y - tile_margin);
  tile.width = std::min(width, core.x + core.width + tile_margin) - tile.x;
  tile.height = std::min(height, core.y + core.height + tile_margin) - tile.y;
  return tile;
}
} // namespace

Status check_picture_size(std::int64_t width, std::int64_t height)
{
  if (width > maximum_side || height > maximum_side || width * height > maximum_pixels)
  {
    return Status::invalid_input("a picture of " + std::to_string(width) + " x " +
      std::to_string(height) + " pixels is too large: expected at most " +
      std::to_string(maximum_side) + " pixels in width and height and " +
      std::to_string(maximum_pixels / 1000000) + " million pixels in total");
  }
  return {};
}

Status draw_in_tiles(
  vtkRenderWindow* window, const WindowPicture& picture, vtkSmartPointer<vtkImageData>& image)
{
  Status status = check_picture_size(picture.width, picture.height);
  if (!status.ok())
  {
    return status;
  }
  const int samples = picture.samples;
  const int width = picture.width * samples;
  const int height = picture.height * samples;
  image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(picture.width, picture.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, picture.transparent ? 4 : 3);

  const std::array<int, 2> size{ window->GetSize()[0], window->GetSize()[1] };
  std::vector<std::unique_ptr<TiledRenderer>> renderers;
  vtkRendererCollection* all = window->GetRenderers();
  all->InitTraversal();
  while (vtkRenderer* renderer = all->GetNextItem())
  {
    renderers.push_back(std::make_unique<TiledRenderer>(renderer, width, height));
  }
  const bool is_single_tile = width <= tile_size && height <= tile_size;
  Rect core;
  for (core.y = 0; core.y < height && status.ok(); core.y += core.height)
  {
    core.height = std::min(core_length(height, samples), height - core.y);
    for (core.x = 0; core.x < width && status.ok(); core.x += core.width)
    {
      core.width = std::min(core_length(width, samples), width - core.x);
      const Rect tile = is_single_tile ? core : with_margins(core, width, height);
      window->SetSize(tile.width, tile.height);
      for (const auto& renderer : renderers)
      {
        if (!is_single_tile)
        {
          renderer->show(tile);
        }
      }
      Samples on_black;
      if (picture.transparent)
      {
        for (const auto& renderer : renderers)
        {
          renderer->set_background(0.0);
        }
        status = read_samples(window, tile, on_black);
        for (const auto& renderer : renderers)
        {
          renderer->set_background(1.0);
        }
      }
      Samples on_white;
      status = status.ok() ? read_samples(window, tile, on_white) : status;
      if (status.ok())
      {
        fill_image(on_white, on_black, tile, core, samples, image);
      }
    }
  }
  renderers.clear();
  // Restore the size of the window. A window that was never shown has no size to restore.
  if (size[0] > 0 && size[1] > 0)
  {
    window->SetSize(size[0], size[1]);
  }
  return status;
}

ScaledLines::ScaledLines(vtkRenderWindow* window, double factor)
{
  std::set<vtkProperty*> scaled_properties;
  vtkRendererCollection* renderers = window->GetRenderers();
  renderers->InitTraversal();
  while (vtkRenderer* renderer = renderers->GetNextItem())
  {
    vtkActorCollection* actors = renderer->GetActors();
    actors->InitTraversal();
    while (vtkActor* actor = actors->GetNextActor())
    {
      vtkProperty* property = actor->GetProperty();
      if (scaled_properties.insert(property).second)
      {
        this->widths_.push_back({ property, property->GetLineWidth(), property->GetPointSize() });
        property->SetLineWidth(static_cast<float>(factor * property->GetLineWidth()));
        property->SetPointSize(static_cast<float>(factor * property->GetPointSize()));
      }
    }
    vtkPropCollection* props = renderer->GetViewProps();
    props->InitTraversal();
    while (vtkProp* prop = props->GetNextProp())
    {
      if (auto* widget = vtkWidgetRepresentation::SafeDownCast(prop))
      {
        this->handles_.emplace_back(widget, widget->GetHandleSize());
        widget->SetHandleSize(factor * widget->GetHandleSize());
      }
    }
  }
}

ScaledLines::~ScaledLines()
{
  for (const Widths& each : this->widths_)
  {
    each.property->SetLineWidth(each.line);
    each.property->SetPointSize(each.point);
  }
  for (const auto& [widget, size] : this->handles_)
  {
    widget->SetHandleSize(size);
  }
}

} // namespace bindpose
