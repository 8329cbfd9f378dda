#ifndef plane_handle_h
#define plane_handle_h

#include "base/mesh.h"

#include "vtkNew.h"

#include <QObject>

#include <utility>

class Viewport;
class vtkImplicitPlaneRepresentation;
class vtkImplicitPlaneWidget2;

/// A plane in the picture that the mouse pushes along its normal and, when it is free, turns. What
/// the plane cuts is drawn by others; of itself it shows an outline only.
class PlaneHandle : public QObject
{
  Q_OBJECT

public:
  /// What the plane is perpendicular to: an axis, or whatever the user turns it to.
  enum Orientation
  {
    x_axis = 0,
    y_axis = 1,
    z_axis = 2,
    free_plane = 3
  };

  PlaneHandle(Viewport* viewport, QObject* parent);
  ~PlaneHandle() override;

  /// What it cuts; the plane goes through the middle.
  void set_box(const bindpose::Box& box);
  /// Whether the box is drawn around the plane (default).
  void draw_box(bool drawn);
  /// To be seen and caught.
  void show(bool shown);
  void set_orientation(int orientation);
  int orientation() const { return this->orientation_; }
  /// Moves the plane along its normal to this place: its coordinate for an axis.
  void set_position(double position);
  double position() const { return this->origin_.dot(this->normal_); }
  /// Smallest and largest position at which the plane meets the box.
  std::pair<double, double> positions() const;
  bindpose::Vec3 origin() const { return this->origin_; }
  bindpose::Vec3 normal() const { return this->normal_; }

Q_SIGNALS:
  /// By the mouse.
  void moved();

private:
  void place_widget();
  /// The line of sight through the mouse.
  void mouse_ray(bindpose::Vec3& from, bindpose::Vec3& along) const;
  void widget_caught();
  void widget_moved();

  Viewport* viewport_;
  bindpose::Box box_;
  bool shown_ = false;
  int orientation_ = z_axis;
  bindpose::Vec3 grip_ = bindpose::Vec3::Zero(); // of the plane, where the mouse has caught it
  bindpose::Vec3 origin_ = bindpose::Vec3::Zero();
  bindpose::Vec3 normal_ = bindpose::Vec3::UnitZ();
  vtkNew<vtkImplicitPlaneWidget2> widget_;
  vtkNew<vtkImplicitPlaneRepresentation> plane_;
};

#endif
