#ifndef bindpose_scene_window_picture_h
#define bindpose_scene_window_picture_h

#include "base/status.h"

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <utility>
#include <vector>

class vtkProperty;
class vtkRenderWindow;
class vtkWidgetRepresentation;

namespace bindpose
{

/// invalid_input, one sentence, for a picture of more than 32,767 pixels wide or high or 268
/// million (2^28, a gigabyte with alpha) in all.
Status check_picture_size(std::int64_t width, std::int64_t height);

/// Of a picture that is written.
constexpr int largest_scale_factor = 8;

struct WindowPicture
{
  int width = 0, height = 0; ///< pixels
  /// Pixels are averages of this many samples in each direction.
  int samples = 2;
  /// No background: RGBA, not premultiplied, instead of RGB. Everything is drawn twice.
  bool transparent = false;
};

/// What a window shows, as large as wanted, whatever the largest framebuffer: in tiles, each of
/// which is a part of every renderer's view, so that the memory of the graphics is that of a tile.
/// Sizes in pixels (of lines, text) are those of the samples. The window's size, cameras and
/// viewports are as before when it returns; it is not drawn with them again. internal_error when
/// the driver gives no pixels. Perspective and parallel cameras; 2D actors stand in coordinates of
/// the viewport.
Status draw_in_tiles(
  vtkRenderWindow* window, const WindowPicture& picture, vtkSmartPointer<vtkImageData>& image);

/// As long as it lives, lines, points and handles of the widgets are so many times as wide: for
/// pictures that are drawn larger than the window.
class ScaledLines
{
public:
  ScaledLines(vtkRenderWindow* window, double factor);
  ~ScaledLines();
  ScaledLines(const ScaledLines&) = delete;
  ScaledLines& operator=(const ScaledLines&) = delete;

private:
  struct Widths
  {
    vtkSmartPointer<vtkProperty> property;
    float line = 1.0F, point = 1.0F;
  };
  std::vector<Widths> widths_;
  std::vector<std::pair<vtkSmartPointer<vtkWidgetRepresentation>, double>> handles_;
};

} // namespace bindpose

#endif
