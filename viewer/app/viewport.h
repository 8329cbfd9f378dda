#ifndef viewport_h
#define viewport_h

#include <QElapsedTimer>
#include <QTimer>
#include <QVTKOpenGLNativeWidget.h>

#include "base/mesh.h"
#include "base/status.h"
#include "scene/colours.h"

#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkSmartPointer.h"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace bindpose
{
class Outline;
class MovedSurfaceMapper;
class ShadedSurface;
} // namespace bindpose
class vtkActor;
class vtkCamera;
class vtkDoubleArray;
class vtkGenericOpenGLRenderWindow;
class vtkHandleSetWidget;
class vtkImageData;
class vtkPolyData;
class vtkRegionBrushWidget;
class vtkRenderer;

/// The picture: one surface, shaded or coloured by a column of its weights, the handles on top,
/// which the mouse drags, and curves. VolumeView adds what it shows of a volume.
class Viewport : public QVTKOpenGLNativeWidget
{
  Q_OBJECT

public:
  enum SurfaceLook
  {
    solid = 0,
    see_through = 1,
    edges_only = 2,
    hidden = 3
  };

  explicit Viewport(QWidget* parent = nullptr);
  ~Viewport() override;

  /// What is drawn; null: nothing. The camera stays.
  void set_surface(vtkPolyData* surface);
  /// The same surface with its points elsewhere: a pose.
  void move_surface(vtkPolyData* posed);
  void move_surface(bindpose::PointsView points);
  /// The same of another shape of that surface.
  void move_shape(bindpose::ShadedSurface& shape, bindpose::PointsView points) const;
  /// Of each point, what it is drawn off its place along a unit vector to the eye: in a plane, what
  /// is in front. Until another surface comes; empty: nothing.
  void set_depths(const Eigen::VectorXd& depths, const bindpose::Vec3& towards)
  {
    this->depths_ = depths;
    this->towards_ = towards;
  }
  /// Something see-through is drawn over the surface: both are then sorted by depth.
  void set_ghosted(bool ghosted);
  /// The left half only: another renderer with the same camera has the right one, with a shape that
  /// is kept in view, too. Null, null: the whole. What was seen whole is so in the half.
  void set_split(vtkRenderer* beside, vtkPolyData* shape);
  bool is_split() const { return this->beside_ != nullptr; }
  /// What shape the picture shows, when it is not the posed one: at the top; empty: nothing.
  void name_state(const QString& state);
  QString state_name() const { return this->state_name_; }
  /// What is said below the halves.
  void name_halves(const QString& left, const QString& right);
  /// Of the last drawn change of points: what it took to bring them to the graphics card.
  double upload_microseconds() const;
  /// Pictures a second, while they follow each other within half a second; else 0.
  double frames_per_second() const;
  /// Handles that the mouse moves and edits; the widget is on while `used`.
  void set_handles(vtkPolyData* handles, bool used);
  /// Column of the array Weights, named on the scalar bar; -1: plain shading.
  void show_column(int column, const QString& name);
  /// Numbers of the points or cells of drawn() as colours instead of the column's, named on the
  /// scalar bar; null: none but the scalar bar, or without a name the column again. Another surface
  /// has none.
  void show_values(vtkDoubleArray* values, bool on_points, const QString& name = QString(),
    const bindpose::ColourMap& map = {});
  /// Whether these numbers are the colours.
  bool shows(vtkDoubleArray* values) const;
  /// -1: none.
  int shown_column() const { return this->column_; }
  /// The surface as drawn, with the arrays that it came with; null without one.
  vtkPolyData* drawn() const;
  const bindpose::ShadedSurface* shaded() const { return this->shaded_.get(); }
  /// For each point of drawn() that of the surface.
  const std::vector<bindpose::Index>& drawn_points() const;
  void set_surface_look(int look);
  int surface_look() const { return this->look_; }
  /// Lines where it turns away from the eye; of pictures none.
  void show_outlines(bool shown);
  bool has_outlines() const { return this->outlines_; }
  /// What the surface shows, by its texture coordinates; colours of weights lie over it. Null:
  /// none.
  void set_picture(vtkImageData* picture);
  bool has_picture() const { return this->picture_ != nullptr; }
  /// How much of the colours is seen over a picture, 0 (only the picture) to 1 (only they).
  void set_tint(double share);
  double tint() const { return this->tint_; }
  /// The 2D mode: the view is parallel and stays in front of a plane across this unit vector, which
  /// points to the eye; dragging moves it. Nothing: views can be turned. The camera stays until
  /// reset_view().
  void set_plane(const std::optional<bindpose::Vec3>& normal);
  bool is_flat() const { return this->plane_.has_value(); }
  /// Lines, drawn as tubes; null: none.
  void set_curves(vtkPolyData* curves);
  /// Curves belong to the shape at rest.
  void show_curves(bool shown);
  /// Legends beside the column's, each in its place; with an empty name none.
  enum LegendPlace
  {
    weight_legend,
    extremum_legend,
    volume_legend,
    tet_legend,
    defect_legend
  };
  void show_legend(LegendPlace place, const QString& name, const bindpose::ColourMap& map = {});
  /// The name that is shown there; empty: none.
  QString legend(LegendPlace place) const;
  /// A box that reset_view() shows besides surface and curves; empty: none.
  void set_also_shown(const bindpose::Box& box);
  /// Looks at everything from the side that shows most of it.
  void reset_view();
  /// Draws soon; many calls, one picture. Where the processor draws, what moves and the first
  /// picture of a surface are drawn without smooth edges, in a fifth of the time, and a quarter of
  /// a second later with them.
  void refresh();
  /// What is seen in `scale` times as many pixels each way, 1 to 8: lines, points, text and scalar
  /// bars grow along. With a transparent background there is nothing where nothing is drawn.
  bindpose::Status take_picture(
    int scale, bool transparent, vtkSmartPointer<vtkImageData>& picture);
  /// In pixels, of such a picture.
  QSize picture_size(int scale) const;

  vtkHandleSetWidget* handle_widget() const { return this->handles_; }
  vtkRegionBrushWidget* brush_widget() const { return this->brush_; }
  /// A place of Qt's in VTK's pixels, from the lower left.
  QPoint to_vtk(const QPoint& place) const;
  /// The places that a pixel of VTK's (from the lower left) shows: from the near clipping plane on,
  /// along a unit vector.
  void ray_at(int x, int y, bindpose::Vec3& from, bindpose::Vec3& along) const;
  vtkRenderer* renderer() const { return this->renderer_; }
  vtkActor* surface_actor() const { return this->actor_; }

protected:
  void resizeEvent(QResizeEvent* event) override;
  void initializeGL() override;
  void paintGL() override;
  void changeEvent(QEvent* event) override;

private:
  void use_appearance();
  void draw_legend();
  void add_name(double middle, double above, const QString& name);
  double aspect_of(const QSize& size) const;
  std::vector<bindpose::Vec3> places_to_see() const;
  void keep_in_view(double aspect_before);
  void frame_drawn();
  void render_wanted();
  void use_column();
  vtkPolyDataMapper* value_mapper() const;
  void show_tint();
  double pixel_scale() const;
  void set_pixel_scale();

  vtkNew<vtkGenericOpenGLRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<bindpose::MovedSurfaceMapper> mapper_;
  vtkNew<vtkActor> actor_;
  vtkNew<vtkRenderer> legend_; // in front, to the left: the colour scale
  vtkNew<vtkCamera> whole_camera_, split_camera_; // when the view was halved: before, and after
  vtkNew<vtkHandleSetWidget> handles_;
  vtkNew<vtkRegionBrushWidget> brush_;
  std::unique_ptr<bindpose::ShadedSurface> shaded_;
  std::unique_ptr<bindpose::Outline> outline_;
  bool outlines_ = true;
  Eigen::VectorXd depths_;
  bindpose::Vec3 towards_ = bindpose::Vec3::UnitZ();
  std::optional<bindpose::Vec3> plane_;
  // Over a picture: the same surface again, in the colours of its numbers.
  vtkNew<vtkPolyDataMapper> tint_mapper_;
  vtkNew<vtkActor> tint_actor_;
  double tint_ = 0.5;
  vtkSmartPointer<vtkImageData> picture_;
  std::vector<vtkSmartPointer<vtkActor>> curves_;
  vtkSmartPointer<vtkPolyData> curve_data_;
  bindpose::Box also_shown_;
  int column_ = -1;
  QString column_name_;
  bool has_values_ = false; // shown instead of the column
  std::map<LegendPlace, std::pair<QString, bindpose::ColourMap>> legends_;
  int look_ = solid;
  bool ghosted_ = false;
  vtkRenderer* beside_ = nullptr; // in the right half; null: the view is whole
  vtkSmartPointer<vtkPolyData> shape_beside_;
  QString left_name_, right_name_, state_name_;
  QElapsedTimer since_start_;
  double last_drawn_ = -1e9, frame_seconds_ = 0.0; // smoothed
  double picture_scale_ = 1.0; // pixels of a picture that is being taken, for each of the window
  bool refresh_pending_ = false;
  bool resizing_ = false;
  bool draws_on_processor_ = false;
  bool first_picture_ = false; // of another surface
  QTimer settle_; // after a drag
};

#endif
