#ifndef app_view_plane_handle_h
#define app_view_plane_handle_h

#include "geometry/mesh.h"

#include "vtkNew.h"

#include <QObject>

#include <utility>

class vtkImplicitPlaneRepresentation;
class vtkImplicitPlaneWidget2;

namespace app::view
{

class Viewport;

/// A plane in the 3D view that the user moves along its normal with the mouse. If the plane is free
/// (not perpendicular to an axis), the user can also rotate it. This class draws only the outline
/// of the plane; the owner of the PlaneHandle draws the cut.
///
/// Three values determine the plane: its orientation, its normal (used only if the plane is free),
/// and its relative position in the box, a fraction from 0 to 1. These values do not change when
/// the box changes.
class PlaneHandle : public QObject
{
  Q_OBJECT

public:
  /// The axis to which the plane is perpendicular, or `free` for a normal that the user chooses.
  enum Orientation
  {
    x_axis = 0,
    y_axis = 1,
    z_axis = 2,
    free_plane = 3
  };

  PlaneHandle(Viewport* viewport, QObject* parent);
  ~PlaneHandle() override;

  /// Set the box that the plane cuts, without emitting moved(). The plane keeps its relative
  /// position.
  void set_box(const bindpose::Box& box);
  /// Set whether the box is drawn around the plane (default: true).
  void draw_box(bool drawn);
  /// Show or hide the plane. The mouse can drag a visible plane.
  void show(bool shown);

  /// Set the orientation, one of Orientation. The plane keeps its relative position in the box. If
  /// the orientation becomes free, the normal does not change.
  void set_orientation(int orientation);
  int orientation() const { return this->state_.orientation; }
  /// Set the unit normal that is used when the plane is free.
  void set_free_normal(const bindpose::Vec3& normal);
  /// Set the relative position: 0 is the smallest value of positions(), 1 the largest.
  void set_relative_position(double relative_position);
  /// Move the plane along its normal to this position, in world units. If the normal is an axis,
  /// the position is the coordinate along the axis.
  void set_position(double position);

  double position() const { return this->state_.origin.dot(this->normal()); }
  /// Return the smallest and the largest position at which the plane touches the box.
  std::pair<double, double> positions() const;
  bindpose::Vec3 origin() const { return this->state_.origin; }
  bindpose::Vec3 normal() const;
  /// Return the free normal (free_normal_before_drag) or the relative position
  /// (relative_position_before_drag). During a drag both functions return the values before the
  /// drag.
  bindpose::Vec3 free_normal_before_drag() const { return this->state_before_drag().free_normal; }
  double relative_position_before_drag() const
  {
    return this->state_before_drag().relative_position;
  }

  /// Cancel a drag with the mouse, as Esc does.
  void cancel();
  bool is_dragged() const { return this->dragged_; }

  bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
  /// Emitted when the plane has moved, for any reason.
  void moved();
  /// Emitted when a drag has ended and has changed the position or the normal. `turned`: the normal
  /// has changed.
  void dragged(bool turned);

private:
  struct State
  {
    int orientation = z_axis;
    bindpose::Vec3 free_normal = bindpose::Vec3::UnitZ();
    double relative_position = 0.5;
    bindpose::Vec3 origin = bindpose::Vec3::Zero(); ///< point of the plane where its arrow is drawn
  };
  const State& state_before_drag() const
  {
    return this->dragged_ ? this->state_before_drag_ : this->state_;
  }
  double to_relative_position(double position) const;
  void apply_relative_position();
  void place_widget();
  /// Return the line of sight through the mouse.
  void mouse_ray(bindpose::Vec3& ray_origin, bindpose::Vec3& ray_direction) const;
  void drag_began();
  void drag_continued();
  void drag_ended();

  Viewport* viewport_;
  bindpose::Box box_;
  bool shown_ = false;
  State state_;
  State state_before_drag_;
  bool dragged_ = false;
  bindpose::Vec3 grabbed_point_ =
    bindpose::Vec3::Zero(); // point of the plane that the mouse has grabbed
  vtkNew<vtkImplicitPlaneWidget2> widget_;
  vtkNew<vtkImplicitPlaneRepresentation> plane_;
};

} // namespace app::view

#endif
