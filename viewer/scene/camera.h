#ifndef bindpose_scene_camera_h
#define bindpose_scene_camera_h

#include "geometry/mesh.h"

#include <string>

class vtkCamera;

namespace bindpose
{

/// The direction from which a shape is viewed, relative to a default view.
///
/// In the default view, y is up (or the axis `up`). The camera looks along the shorter of the two
/// horizontal axes, so that the broad side of the shape is visible: from +z if x is at least as
/// long as z, otherwise from +x. The camera is then rotated about the shape by 28 degrees to the
/// right and 16 degrees up. A flat shape is viewed straight from the front. The projection is
/// perspective with a view angle of 30 degrees.
struct View
{
  /// Axis that is up: "x", "y", "z"; "auto": y, or z for a shape that is flat in y.
  std::string up = "auto";
  double azimuth = 0.0; ///< camera rotation to the right in degrees, added to the default view
  double elevation = 0.0; ///< camera rotation upward in degrees, added to the default view
  double zoom = 1.0; ///< factor on the size of the shape in the picture; must be above 0
};

/// Axes of the default view. The `View` angles are relative to them, and cuts and slices are
/// perpendicular to the depth axis.
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
/// each side, then apply the zoom. The fit uses the points themselves instead of a bounding sphere,
/// so it is exact.
/// @param points  #P x 3, at least one
/// @param aspect  width / height of the viewport
/// @param margin  empty fraction of the viewport's width and height on each side
void fit_camera(vtkCamera* camera, PointsView points, const Frame& frame, const View& view,
  double aspect, double margin = 0.04);

/// Adapt the camera to a new aspect ratio (width / height) of the viewport. The camera moves nearer
/// or farther along its viewing direction, so that the points fill the same fraction of the view as
/// before. If all points were visible before, they are visible afterward; the camera is centered if
/// necessary.
void keep_in_view(vtkCamera* camera, PointsView points, double aspect_before, double aspect);

/// Report whether all points are in one plane, within a millionth of the diagonal of their bounding
/// box. If they are, set the unit normal, oriented toward the viewer of the default view: toward
/// +z; toward +x if its z component is 0; toward -y if its z and x components are 0. Points on a
/// line do not define a plane.
bool find_plane(PointsView points, Vec3& normal);

/// Set a parallel view of a plane. The camera looks against the normal, with y up (z if the plane
/// is horizontal). All points are visible and as large as possible, with a margin on each side.
void fit_parallel_camera(
  vtkCamera* camera, PointsView points, const Vec3& normal, double aspect, double margin = 0.04);

} // namespace bindpose

#endif
