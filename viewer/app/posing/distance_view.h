#ifndef app_posing_distance_view_h
#define app_posing_distance_view_h

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <QObject>

namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::posing
{

class PoseController;

/// Shows the distance between the displayed shape and the shape of the compared method. The
/// distance is shown as colors on the displayed shape, with a scale in percent of the rest shape's
/// bounding-box diagonal.
class DistanceView : public QObject
{
  Q_OBJECT

public:
  DistanceView(view::Viewport* viewport, PoseController* posing);

  /// Set whether the pose panel is visible. While it is hidden, other views determine the colors of
  /// the surface.
  void set_active(bool active);
  /// Update the colors. Must be called after a change of the surface, of one of the two compared
  /// shapes, or of the display mode.
  void update();

private:
  view::Viewport* viewport_;
  PoseController* posing_;
  bool active_ = true;
  vtkSmartPointer<vtkDoubleArray> values_; ///< the displayed distances in percent; null: none
  double scale_ = 0.0; ///< upper end of the color scale, in percent
};

/// Return the upper end of a color scale that contains this value: 1, 2 or 5 times a power of ten,
/// at least 0.01. Because of these steps, the scale changes rarely while a shape is bent. Because
/// of the minimum, shapes that differ only by round-off have a single color.
double distance_scale(double largest);

} // namespace app::posing

#endif
