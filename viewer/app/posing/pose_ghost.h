#ifndef app_posing_pose_ghost_h
#define app_posing_pose_ghost_h

#include "geometry/mesh.h"

#include "vtkDoubleArray.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <memory>

namespace bindpose
{
class Outline;
class MovedSurfaceMapper;
class ShadedSurface;
} // namespace bindpose
class vtkActor;
class vtkRenderer;

namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::posing
{

/// The ghost is the viewport's surface as posed by the compared method. It is drawn over the
/// current shape (the shape of the current method), and is transparent where it coincides with that
/// shape. Alternatively it is drawn in the right half of a split view, with the same camera.
class PoseGhost
{
public:
  enum DisplayMode
  {
    hidden,
    over,
    beside,
    /// The ghost is not drawn; the colors of the surface show the distance (DistanceView).
    in_colors
  };

  explicit PoseGhost(view::Viewport* viewport);
  ~PoseGhost();

  /// Set the rest surface. The ghost shows this surface in another pose. Null hides the ghost.
  void set_surface(vtkPolyData* surface);
  /// Set where the ghost is drawn. `points` are the points of the ghost, and `first` the points of
  /// the current shape. If `points` is empty, the ghost keeps its points.
  void set_display_mode(DisplayMode mode, bindpose::PointsView points, bindpose::PointsView first);
  DisplayMode display_mode() const { return this->display_mode_; }
  void move(bindpose::PointsView points, bindpose::PointsView first);
  vtkRenderer* renderer() const { return this->renderer_; }
  /// Return the ghost as drawn; null before the ghost was shown for the first time.
  const bindpose::ShadedSurface* shaded() const { return this->shaded_.get(); }

private:
  bool is_drawn() const { return this->display_mode_ == over || this->display_mode_ == beside; }
  void make_shape();
  void update_opacities(bindpose::PointsView points, bindpose::PointsView first);
  void update();
  void match_first_shape();
  void clipping_range_changed();

  view::Viewport* viewport_;
  DisplayMode display_mode_ = hidden;
  vtkNew<bindpose::MovedSurfaceMapper> mapper_;
  vtkNew<vtkActor> actor_;
  // color and opacity of the ghost, depending on its distance from the current shape
  vtkNew<vtkLookupTable> opacity_table_;
  // distance of each point of the ghost from the current shape, in bounding-box diagonals
  vtkNew<vtkDoubleArray> distances_;
  vtkNew<vtkRenderer> renderer_; // renderer of the right half of the split view
  vtkSmartPointer<vtkPolyData> surface_;
  std::unique_ptr<bindpose::ShadedSurface> shaded_;
  /// Outline of the ghost in the right half of the split view.
  std::unique_ptr<bindpose::Outline> outline_;
  bool is_renderer_added_ = false;
  bool is_updating_clipping_ = false; // prevents recursive calls of clipping_range_changed()
};

} // namespace app::posing

#endif
