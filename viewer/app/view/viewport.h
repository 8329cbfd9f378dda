#ifndef app_view_viewport_h
#define app_view_viewport_h

#include <QElapsedTimer>
#include <QTimer>
#include <QVTKOpenGLNativeWidget.h>

#include "base/status.h"
#include "geometry/mesh.h"
#include "scene/colors.h"

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
class TexturedSurface;
struct FileLook;
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

namespace app::view
{

/// The 3D view of the window. It shows one surface, shaded or colored by a column of its weights.
/// Handles, which the mouse drags, are drawn on top. The view also shows curves. Other classes, for
/// example VolumeView, add their own actors.
class Viewport : public QVTKOpenGLNativeWidget
{
  Q_OBJECT

public:
  enum SurfaceAppearance
  {
    solid = 0,
    see_through = 1,
    edges_only = 2,
    hidden = 3
  };

  explicit Viewport(QWidget* parent = nullptr);
  ~Viewport() override;

  /// Set the surface to draw; null: no surface. The camera is unchanged.
  void set_surface(vtkPolyData* surface);
  /// Move the points of the surface to those of `posed`, a pose of the same surface.
  void move_surface(vtkPolyData* posed);
  void move_surface(bindpose::PointsView points);
  /// Move the points of another drawn shape, for example the ghost. The shape must have the points
  /// and cells of the surface, in another pose.
  /// @tparam Shape ShadedSurface or TexturedSurface
  template <typename Shape>
  void move_shape(Shape& shape, bindpose::PointsView points) const;
  /// Set the offset of each point (#V, world units) along the unit vector `eye_direction`, which
  /// points to the eye. In a planar shape the offsets determine which parts are in front. An empty
  /// vector or set_surface() removes the offsets.
  void set_depths(const Eigen::VectorXd& depths, const bindpose::Vec3& eye_direction)
  {
    this->depths_ = depths;
    this->eye_direction_ = eye_direction;
  }
  /// Set whether a translucent shape is drawn over the surface. Both shapes are then sorted by
  /// depth.
  void set_ghosted(bool ghosted);
  /// Split the view into two halves with the same camera. The left half shows the surface. In the
  /// right half, the renderer `right_renderer` draws `shape`. If `right_renderer` and `shape` are
  /// null, the surface uses the whole view again. The camera is moved so that all visible data
  /// stays visible in the narrower half.
  void set_split(vtkRenderer* right_renderer, vtkPolyData* shape);
  bool is_split() const { return this->right_renderer_ != nullptr; }
  /// Show a text at the top of the view. The window uses the text to state that the shape at rest
  /// is shown instead of the posed shape. Empty: no text.
  void set_state_name(const QString& state);
  QString state_name() const { return this->state_name_; }
  /// Set the names that are drawn at the lower edges of both halves of the split view.
  void set_half_names(const QString& left, const QString& right);
  /// Return the time in microseconds of the last upload of moved points to the graphics card.
  double upload_microseconds() const;
  /// Return the smoothed number of frames per second. Return 0 if more than half a second has
  /// passed between the last two frames.
  double frames_per_second() const;
  /// Set the handles. If `used` is true, they are drawn, and the mouse moves and edits them.
  void set_handles(vtkPolyData* handles, bool used);
  /// Color the surface by a column of the array Weights; column -1: plain shading. `name` is the
  /// title of the scalar bar.
  void show_column(int column, const QString& name);
  /// Color the surface by values of the points or cells of drawn() instead of a column. `name` is
  /// the title of the scalar bar. If `values` is null, only the scalar bar is shown. If `name` is
  /// empty, the column is shown again. set_surface() removes the colors.
  void show_values(vtkDoubleArray* values, bool on_points, const QString& name = QString(),
    const bindpose::ColorMap& map = {});
  /// Report whether the surface is colored by these values.
  bool shows_values(vtkDoubleArray* values) const;
  /// Return the displayed column; -1: none.
  int shown_column() const { return this->column_; }
  /// Return the surface as drawn, with the arrays of the input surface; null: no surface. Several
  /// drawn points can belong to the same point of the surface, see drawn_points().
  vtkPolyData* drawn() const;
  const bindpose::ShadedSurface* shaded() const { return this->shaded_.get(); }
  /// Return the index of the surface's point for each point of drawn().
  const std::vector<bindpose::Index>& drawn_points() const;
  void set_surface_appearance(int appearance);
  int surface_appearance() const { return this->surface_appearance_; }
  /// Show or hide silhouette lines. Surfaces with textures have none.
  void show_outlines(bool shown);
  bool has_outlines() const { return this->outlines_; }
  /// Set the image that is the texture of the surface. Colors of weights are drawn over it. Null:
  /// no texture.
  void set_picture(vtkImageData* picture);
  bool has_picture() const { return this->picture_ != nullptr; }
  /// Set the materials, textures and vertex colors of the surface; null: none. set_surface() with
  /// another mesh removes them. `rest` is the surface at rest. They are drawn on a solid surface in
  /// an undivided view.
  void set_look(std::shared_ptr<const bindpose::FileLook> look, vtkPolyData* rest);
  /// Show or hide the look. If it is shown, colors of weights are drawn over it.
  void show_look(bool shown);
  bool shows_look() const { return this->look_shown_; }
  /// Report whether the surface is drawn with textures, so that colors of weights are drawn over
  /// them.
  bool has_texture() const { return this->picture_ != nullptr || this->draws_look(); }
  /// Set the opacity of the colors over a texture, from 0 (only the texture) to 1 (only the
  /// colors).
  void set_tint(double opacity);
  double tint() const { return this->tint_; }
  /// Set the 2D mode: a parallel projection onto the plane perpendicular to this unit vector, which
  /// points to the eye. Dragging pans the view. An empty value ends the 2D mode, and the view can
  /// be rotated. The camera is unchanged until reset_view().
  void set_plane(const std::optional<bindpose::Vec3>& normal);
  bool is_flat() const { return this->plane_.has_value(); }
  /// Set curves, which are drawn as tubes; null: no curves.
  void set_curves(vtkPolyData* curves);
  /// Show or hide the curves, which belong to the shape at rest.
  void show_curves(bool shown);
  /// The legends that are shown in addition to the legend of the column, from left to right. An
  /// empty name removes a legend.
  enum LegendPosition
  {
    weight_legend,
    extremum_legend,
    volume_legend,
    tet_legend,
    defect_legend
  };
  void show_legend(
    LegendPosition position, const QString& name, const bindpose::ColorMap& map = {});
  /// Return the name of a legend; empty: the legend is not shown.
  QString legend(LegendPosition position) const;
  /// Set a box that reset_view() shows in addition to surface and curves; an empty box removes it.
  void set_extra_bounds(const bindpose::Box& box);
  /// Reset the camera so that all data fits into the view. In 2D mode the camera faces the plane.
  /// Otherwise it faces the widest side of the data's bounding box, obliquely from above.
  void reset_view();
  /// Request that the view is drawn again. Several requests during one event result in one
  /// rendering. With software rendering, a frame without antialiasing takes only a fifth of the
  /// time. The first frame of a surface and all frames during a drag are therefore drawn without
  /// antialiasing. A quarter of a second later the view is drawn again with antialiasing.
  void refresh();
  /// Render an image of the view. Each pixel of the view becomes `scale` by `scale` pixels, with
  /// `scale` from 1 to 8. Lines, points, text and scalar bars are scaled, too. If `transparent` is
  /// true, pixels of the background have the alpha value 0.
  bindpose::Status take_picture(
    int scale, bool transparent, vtkSmartPointer<vtkImageData>& picture);
  /// Return the size in pixels of the image that take_picture() returns.
  QSize picture_size(int scale) const;

  vtkHandleSetWidget* handle_widget() const { return this->handles_; }
  vtkRegionBrushWidget* brush_widget() const { return this->brush_; }
  /// Convert a Qt position to VTK's pixels, counted from the lower left corner.
  QPoint to_vtk(const QPoint& position) const;
  /// Return the line of sight through a pixel in VTK's coordinates (from the lower left corner):
  /// its start on the near clipping plane, and its unit direction.
  void ray_at(int x, int y, bindpose::Vec3& ray_origin, bindpose::Vec3& ray_direction) const;
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
  void add_name(double center_fraction, double bottom_margin, const QString& name);
  double aspect_of(const QSize& size) const;
  std::vector<bindpose::Vec3> points_to_show() const;
  void keep_in_view(double aspect_before);
  void frame_drawn();
  void render_requested();
  void use_column();
  vtkPolyDataMapper* value_mapper() const;
  void move_colors();
  bool draws_look() const;
  void show_tint();
  double pixel_scale() const;
  void set_pixel_scale();

  vtkNew<vtkGenericOpenGLRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<bindpose::MovedSurfaceMapper> mapper_;
  vtkNew<vtkActor> actor_;
  vtkNew<vtkRenderer> legend_; // renderer of the color scale, in front and on the left
  // copies of the camera from before and after the view was split into halves
  vtkNew<vtkCamera> camera_before_split_, camera_after_split_;
  vtkNew<vtkHandleSetWidget> handles_;
  vtkNew<vtkRegionBrushWidget> brush_;
  std::unique_ptr<bindpose::ShadedSurface> shaded_;
  std::unique_ptr<bindpose::TexturedSurface> textured_; // the surface with its look; may be null
  std::shared_ptr<const bindpose::FileLook> look_;
  bool look_shown_ = true;
  std::unique_ptr<bindpose::Outline> outline_;
  bool outlines_ = true;
  Eigen::VectorXd depths_;
  bindpose::Vec3 eye_direction_ = bindpose::Vec3::UnitZ();
  std::optional<bindpose::Vec3> plane_;
  // For a textured surface: draws the same surface again, in the colors of its values.
  vtkNew<vtkPolyDataMapper> tint_mapper_;
  vtkNew<vtkActor> tint_actor_;
  double tint_ = 0.5;
  vtkSmartPointer<vtkImageData> picture_;
  std::vector<vtkSmartPointer<vtkActor>> curves_;
  vtkSmartPointer<vtkPolyData> curve_data_;
  bindpose::Box extra_bounds_;
  int column_ = -1;
  QString column_name_;
  bool has_values_ = false; // true: values are displayed instead of the column
  std::map<LegendPosition, std::pair<QString, bindpose::ColorMap>> legends_;
  int surface_appearance_ = solid;
  bool ghosted_ = false;
  vtkRenderer* right_renderer_ = nullptr; // renderer of the right half; null: the view is not split
  vtkSmartPointer<vtkPolyData> right_shape_;
  QString left_name_, right_name_, state_name_;
  QElapsedTimer since_start_;
  // time at which the last frame was drawn, and smoothed duration of a frame; both in seconds
  double last_drawn_ = -1e9, frame_seconds_ = 0.0;
  // Rendered pixels per pixel of the window while take_picture() renders an image; otherwise 1.
  double picture_scale_ = 1.0;
  bool refresh_pending_ = false;
  bool resizing_ = false;
  bool uses_software_rendering_ = false;
  bool first_picture_ = false; // true: the next frame is the first frame of its surface
  QTimer settle_timer_; // single-shot timer that starts after a drag
};

} // namespace app::view

#endif
