#ifndef app_weights_weight_view_h
#define app_weights_weight_view_h

#include "app/view/plane_handle.h"
#include "base/status.h"
#include "pictures/picture.h"
#include "scene/coloring.h"
#include "scene/extrema.h"

#include "vtkActor.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <QObject>

#include <array>

namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::weights
{

/// Shows weights in the 3D view as colors and isolines. Balls mark local extrema of the weights.
/// The weights are shown on the surface, posed or at rest, or on a slice through the tets. The
/// mouse drags the slice. PictureOptions determine the display, as in `bindpose render`.
class WeightView : public QObject
{
  Q_OBJECT

public:
  explicit WeightView(view::Viewport* viewport);

  /// Set the data to draw (null: no data). `surface` is the surface at rest with weights, and must
  /// be the surface of the viewport. `volume` are the tets on which the weights were solved.
  void set_data(vtkPolyData* surface, vtkUnstructuredGrid* volume);
  /// Move the points to those of `shape`, a pose of the surface.
  void move_surface(vtkPolyData* shape);

  /// Show the weights. The options that are used are `array`, `component`, `color_by`, `minus`,
  /// `bands`, `isolines`, `extrema` and `slice`. If the data lacks the values that the options
  /// request, return an error and show the plain surface.
  bindpose::Status show(const bindpose::PictureOptions& options);
  void hide();
  bool is_shown() const { return this->shown_; }
  bool is_sliced() const { return this->shown_ && this->options_.slice; }

  view::PlaneHandle* plane() const { return this->plane_; }

  const bindpose::Coloring& coloring() const { return this->coloring_; }
  /// Return statistics of the displayed data; see render_to_png().
  const bindpose::Report& numbers() const { return this->coloring_.numbers; }
  /// Return the displayed extrema: the extrema on the surface or, while a slice is shown, the
  /// extrema in the tets.
  const std::vector<bindpose::Extremum>& extrema() const { return this->extrema_; }
  vtkPolyData* slice() const { return this->slice_; }
  /// Return the isolines on the surface.
  vtkPolyData* isolines() const { return this->isolines_[0]; }

Q_SIGNALS:
  /// Emitted when the plane has moved, for any reason.
  void plane_moved();

private:
  void show_surface();
  void draw_isolines(int part, vtkPolyData* data);
  void update_slice();
  void place_extrema();
  void orient_balls();

  view::Viewport* viewport_;
  view::PlaneHandle* plane_;
  vtkSmartPointer<vtkPolyData> surface_; // the surface at rest
  vtkSmartPointer<vtkPolyData> shape_; // the posed surface
  vtkSmartPointer<vtkUnstructuredGrid> volume_;
  // copy of the tets whose only array contains the displayed values
  vtkSmartPointer<vtkUnstructuredGrid> volume_values_;
  bindpose::PictureOptions options_;
  bindpose::Coloring coloring_;
  bool shown_ = false;

  std::vector<bindpose::Extremum> extrema_;
  bindpose::ExtremumBalls balls_;
  vtkSmartPointer<vtkPolyData> slice_;
  vtkNew<vtkPolyDataMapper> slice_mapper_;
  vtkNew<vtkActor> slice_actor_;
  // Element 0 contains the isolines on the surface, element 1 those on the slice.
  std::array<vtkNew<vtkPolyData>, 2> isolines_;
  std::array<vtkNew<vtkPolyDataMapper>, 2> isoline_mappers_;
  std::array<vtkNew<vtkActor>, 2> isoline_actors_;
};

} // namespace app::weights

#endif
