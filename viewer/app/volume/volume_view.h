#ifndef app_volume_volume_view_h
#define app_volume_volume_view_h

#include "app/view/plane_handle.h"
#include "geometry/mesh.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <QObject>

class vtkActor;
class vtkPolyDataMapper;
class vtkVolume;

namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::volume
{

/// Shows a volume of winding numbers in the 3D view while its panel is visible: a slice that the
/// mouse drags, an isosurface, and a cloud (volume rendering). Each of them can be shown or hidden;
/// all have the colors of the legend.
class VolumeView : public QObject
{
  Q_OBJECT

public:
  explicit VolumeView(view::Viewport* viewport);

  /// Set the volume, which bindpose::check_volume() must accept; null: no volume. `lowest` and
  /// `highest` are its smallest and largest value. The slice keeps its relative position.
  void set_volume(vtkImageData* image, double lowest, double highest);
  vtkImageData* volume() const { return this->image_; }
  /// Set whether the volume panel is visible. While it is hidden, no part of the volume is drawn.
  void set_active(bool active);
  bool is_active() const { return this->image_ && this->active_; }
  /// Report whether any part of the volume is drawn.
  bool is_shown() const
  {
    return this->is_active() &&
      (this->slice_shown_ || this->isosurface_shown_ || this->cloud_shown_);
  }

  void show_slice(bool shown);
  view::PlaneHandle* plane() const { return this->plane_; }
  bool is_slice_shown() const { return this->is_active() && this->slice_shown_; }
  double position() const { return this->plane_->position(); }
  /// Return the smallest and the largest position at which the slice intersects the volume.
  std::pair<double, double> positions() const { return this->plane_->positions(); }
  bindpose::Vec3 slice_origin() const { return this->plane_->origin(); }
  bindpose::Vec3 slice_normal() const { return this->plane_->normal(); }

  void show_isosurface(bool shown);
  void set_level(double level);
  double level() const { return this->level_; }
  /// Return the isosurface as drawn; empty if it is not shown.
  vtkPolyData* isosurface() const { return this->isosurface_; }

  void show_cloud(bool shown);
  bool is_cloud_shown() const { return this->is_active() && this->cloud_shown_; }

Q_SIGNALS:
  void volume_changed();
  /// Emitted when the slice has moved, for any reason.
  void slice_moved();
  /// Emitted with the area of the displayed isosurface; 0 if the volume does not reach the level.
  void area_changed(double area);
  /// Emitted when the displayed parts of the volume may have changed.
  void shown_changed();

private:
  void update();
  void update_slice();
  void update_isosurface();
  void update_cloud();

  view::Viewport* viewport_;
  vtkSmartPointer<vtkImageData> image_;
  double lowest_ = 0.0;
  double highest_ = 1.0;
  bool active_ = false;

  view::PlaneHandle* plane_;
  vtkNew<vtkPolyDataMapper> slice_mapper_;
  vtkNew<vtkActor> slice_actor_;
  vtkNew<vtkPolyDataMapper> contour_mapper_;
  vtkNew<vtkActor> contour_actor_; // contour of the slice at the winding number 0.5
  bool slice_shown_ = true;

  vtkNew<vtkPolyDataMapper> isosurface_mapper_;
  vtkNew<vtkActor> isosurface_actor_;
  vtkNew<vtkPolyData> isosurface_;
  bool isosurface_shown_ = false;
  double level_ = 0.5;

  vtkSmartPointer<vtkVolume> cloud_; // null until the cloud is shown for the first time
  bool cloud_shown_ = false;
};

} // namespace app::volume

#endif
