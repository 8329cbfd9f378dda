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
///
/// Where it is follows from three things that fit any box: what it is perpendicular to, the normal
/// that it has when it is free, and its place as a share of the way through the box.
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

  /// What it cuts, without moved(); the plane keeps its share of the way.
  void set_box(const bindpose::Box& box);
  /// Whether the box is drawn around the plane (default).
  void draw_box(bool drawn);
  /// To be seen and caught.
  void show(bool shown);

  /// The place stays; a free plane begins where the last axis was.
  void set_orientation(int orientation);
  int orientation() const { return this->state_.orientation; }
  /// Of length one: that of the plane whenever it is free.
  void set_free_normal(const bindpose::Vec3& normal);
  /// From 0 to 1, as far as from one of positions() to the other.
  void set_place(double place);
  /// Moves the plane along its normal to this place: its coordinate for an axis.
  void set_position(double position);

  double position() const { return this->state_.origin.dot(this->normal()); }
  /// Smallest and largest position at which the plane meets the box.
  std::pair<double, double> positions() const;
  bindpose::Vec3 origin() const { return this->state_.origin; }
  bindpose::Vec3 normal() const;
  /// As they are, or while the mouse drags the plane as they were before.
  bindpose::Vec3 kept_free_normal() const { return this->kept().free_normal; }
  double kept_place() const { return this->kept().place; }

  /// Takes back what the mouse has begun, as Esc does.
  void cancel();
  bool is_dragged() const { return this->dragged_; }

  bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
  /// It is elsewhere, whoever has moved it.
  void moved();
  /// The mouse has let go of it elsewhere, or with another normal.
  void dragged(bool turned);

private:
  struct State
  {
    int orientation = z_axis;
    bindpose::Vec3 free_normal = bindpose::Vec3::UnitZ();
    double place = 0.5;
    bindpose::Vec3 origin = bindpose::Vec3::Zero(); ///< of the plane, where its arrow stands
  };
  const State& kept() const { return this->dragged_ ? this->before_ : this->state_; }
  double place_of(double position) const;
  void go_to_place();
  void place_widget();
  /// The line of sight through the mouse.
  void mouse_ray(bindpose::Vec3& from, bindpose::Vec3& along) const;
  void widget_caught();
  void widget_moved();
  void widget_let_go();

  Viewport* viewport_;
  bindpose::Box box_;
  bool shown_ = false;
  State state_;
  State before_; ///< the drag
  bool dragged_ = false;
  bindpose::Vec3 grip_ = bindpose::Vec3::Zero(); // of the plane, where the mouse has caught it
  vtkNew<vtkImplicitPlaneWidget2> widget_;
  vtkNew<vtkImplicitPlaneRepresentation> plane_;
};

#endif
