#ifndef bindpose_scene_camera_h
#define bindpose_scene_camera_h

#include "base/mesh.h"

#include <string>

class vtkCamera;

namespace bindpose
{

/// From where a shape is looked at.
///
/// The default view: y is up (x and z with `up`). The camera looks along the shorter of the two
/// level axes, so that the shape's broad side is seen (from +z when x is at least as long as z,
/// else from +x), then moves 28 degrees to the right and 16 degrees up. A flat shape is looked at
/// straight from the front. Perspective, 30 degrees.
struct View
{
  std::string up = "auto"; ///< "x", "y", "z"; "auto": y, or z for a shape that is flat in y
  double azimuth = 0.0; ///< degrees to the right, beyond the default view
  double elevation = 0.0; ///< degrees up, beyond the default view
  double zoom = 1.0; ///< factor on the size in the picture; above 0
};

/// Two level axes, the broad side: what a view is built on, and what cuts and slices are
/// perpendicular to.
struct Frame
{
  int up = 1; ///< 0 x, 1 y, 2 z
  int depth = 2; ///< the axis along which the default view looks
  bool flat = false;
};

/// @param box  of everything that will be shown
Frame choose_frame(const Box& box, const std::string& up);

/// Unit vector from the shape to the camera.
Vec3 view_direction(const Frame& frame, const View& view);

/// Places the camera so that all points lie within the picture, as large as they can be with a
/// margin on each side, exactly (no bounding sphere), then applies the zoom.
/// @param points  #P x 3, at least one
/// @param aspect  width / height of the viewport
/// @param margin  fraction of the viewport's width and height left free on each side
void fit_camera(vtkCamera* camera, PointsView points, const Frame& frame, const View& view,
  double aspect, double margin = 0.04);

/// The view has another width / height now: the camera goes nearer or farther along its sight, so
/// that the points take as much of the view as they did. What was seen whole is seen whole, if need
/// be in the middle.
void keep_in_view(vtkCamera* camera, PointsView points, double aspect_before, double aspect);

/// Whether all points lie in a plane, within a millionth of their box's diagonal; then its unit
/// normal, on the side from which it is looked at: that of +z, or of +x, or of -y, as the default
/// view is. Points on a line lie in no one plane.
bool find_plane(PointsView points, Vec3& normal);

/// A parallel view of a plane, straight from the side that its normal points to, with y up (z where
/// the plane is level): all points lie within the picture, as large as they can be with a margin on
/// each side.
void fit_parallel_camera(
  vtkCamera* camera, PointsView points, const Vec3& normal, double aspect, double margin = 0.04);

} // namespace bindpose

#endif
