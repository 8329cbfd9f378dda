#ifndef bindpose_pictures_window_picture_h
#define bindpose_pictures_window_picture_h

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

/// Check the size of a picture. Return invalid_input with one sentence for more than 32,767 pixels
/// in width or height, or more than 268 million pixels (2^28, a gigabyte with alpha) in total.
Status check_picture_size(std::int64_t width, std::int64_t height);

/// Largest scale factor of a picture that is written to a file.
constexpr int largest_scale_factor = 8;

struct WindowPicture
{
  int width = 0, height = 0; ///< pixels
  /// A pixel is the average of this many samples in each direction.
  int samples = 2;
  /// Draw no background. The image is RGBA (not premultiplied) instead of RGB, and everything is
  /// drawn twice.
  bool transparent = false;
};

/// Draw the content of a window at any size, even larger than the largest framebuffer. The picture
/// is drawn in tiles, so that only one tile must fit into the graphics memory. A tile is a part of
/// every renderer's view. If there are several samples per pixel (see WindowPicture::samples), each
/// sample counts as a pixel for sizes that actors specify in pixels, such as line widths and text.
/// ScaledLines compensates for this.
///
/// On return, the window's size, cameras and viewports are restored, but the window is not redrawn.
/// Return internal_error if the driver returns no pixels. Perspective and parallel cameras are
/// supported. Positions of 2D actors must be in viewport coordinates.
Status draw_in_tiles(
  vtkRenderWindow* window, const WindowPicture& picture, vtkSmartPointer<vtkImageData>& image);

/// Scales the widths of lines, points and widget handles by a factor while the object exists. Use
/// it for pictures that are drawn larger than the window.
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
