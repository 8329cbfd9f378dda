#ifndef distance_view_h
#define distance_view_h

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

class Posing;
class Viewport;

/// How far the shape of the compared method is from the shape in the picture, in colors on the
/// latter, with a scale in percent of the bounding-box diagonal of the shape at rest.
class DistanceView
{
public:
  DistanceView(Viewport* viewport, Posing* posing);

  /// Whether the panel is there; else others say what the surface is colored by.
  void set_active(bool active);
  /// The pose, a method, the surface or what is asked for is another one.
  void update();

private:
  Viewport* viewport_;
  Posing* posing_;
  bool active_ = true;
  vtkSmartPointer<vtkDoubleArray> values_; ///< shown, in percent; null: nothing
  double scale_ = 0.0; ///< where the colors end, in percent
};

/// The end of a scale that holds this value: 1, 2 or 5 times a power of ten, at least 0.01, so that
/// it stays while a shape is bent and shapes that coincide are all one color.
double distance_scale(double largest);

#endif
