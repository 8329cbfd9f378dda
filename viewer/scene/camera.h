#ifndef bindpose_scene_camera_h
#define bindpose_scene_camera_h

#include "base/mesh.h"

#include <string>

class vtkCamera;

namespace bindpose
{

/// The direction from which a shape is viewed.
///
/// In the default view, y is up (x and z with `up`). The camera looks along the shorter of the two
/// level axes, so that the broad side of the shape is visible: from +z if x is at least as long as
/// z, else from +x. It then moves 28 degrees to the right and 16 degrees up. A flat shape is viewed
/// straight from the front. The projection is perspective with a view angle of 30 degrees.
struct View
{
  std::string up = "auto"; ///< "x", "y", "z"; "auto": y, or z for a shape that is flat in y
  double azimuth = 0.0; ///< degrees to the right, beyond the default view
  double elevation = 0.0; ///< degrees up, beyond the default view
  double zoom = 1.0; ///< factor on the size in the picture; must be above 0
};

/// Axes of the default view. Views are built on them, and cuts and slices are perpendicular to the
/// depth axis.
struct Frame
{
  int up = 1; ///< 0 x, 1 y, 2 z
  int depth = 2; ///< the axis along which the default view looks
  bool flat = false;
};

/// Choose the axes for a shape.
/// @param box  bounding box of everything that is shown
Frame choose_frame(const Box& box, const std::string& up);

/// Return the unit vector from the shape to the camera.
Vec3 view_direction(const Frame& frame, const View& view);

/// Position the camera such that all points are visible and as large as possible, with a margin on
/// each side, then apply the zoom. The fit is exact: it uses the points, not a bounding sphere.
/// @param points  #P x 3, at least one
/// @param aspect  width / height of the viewport
/// @param margin  fraction of the viewport's width and height left free on each side
void fit_camera(vtkCamera* camera, PointsView points, const Frame& frame, const View& view,
  double aspect, double margin = 0.04);

/// Adapt the camera to a new aspect ratio (width / height) of the viewport. The camera moves nearer
/// or farther along its viewing direction, so that the points fill the same fraction of the view as
/// before. If all points were visible before, they are visible afterward; the camera is centered if
/// necessary.
void keep_in_view(vtkCamera* camera, PointsView points, double aspect_before, double aspect);

/// Report whether all points are in one plane, within a millionth of the diagonal of their bounding
/// box. If they are, set the unit normal that points to the viewer: toward +z, else +x, else -y, as
/// in the default view. Points on a line do not define a plane.
bool find_plane(PointsView points, Vec3& normal);

/// Set a parallel view of a plane, straight from the side that its normal points to, with y up (z
/// if the plane is level). All points are visible and as large as possible, with a margin on each
/// side.
void fit_parallel_camera(
  vtkCamera* camera, PointsView points, const Vec3& normal, double aspect, double margin = 0.04);

} // namespace bindpose

#endif
