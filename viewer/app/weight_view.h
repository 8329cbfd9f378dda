#ifndef weight_view_h
#define weight_view_h

#include "base/status.h"
#include "plane_handle.h"
#include "scene/coloring.h"
#include "scene/extrema.h"
#include "scene/picture.h"

#include "vtkActor.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <QObject>

#include <array>

class Viewport;

/// Weights in the picture: on the surface, posed or at rest, in bands with isolines and with balls
/// at their extrema; and inside, on a plane that the mouse drags. PictureOptions determine what is
/// shown, as in `bindpose render`.
class WeightView : public QObject
{
  Q_OBJECT

public:
  explicit WeightView(Viewport* viewport);

  /// Set the surface at rest, as the viewport has it, and the tets that were solved on, both with
  /// weights; null: none.
  void set_data(vtkPolyData* surface, vtkUnstructuredGrid* volume);
  /// Move the points of the same surface: a pose.
  void move_surface(vtkPolyData* shape);

  /// Show the weights. The options that count are array, component, color_by, minus, bands,
  /// isolines, extrema and slice. Return an error, and show the plain surface, if the data has no
  /// such numbers.
  bindpose::Status show(const bindpose::PictureOptions& options);
  void hide();
  bool is_shown() const { return this->shown_; }
  bool is_sliced() const { return this->shown_ && this->options_.slice; }

  PlaneHandle* plane() const { return this->plane_; }

  const bindpose::Coloring& coloring() const { return this->coloring_; }
  /// Return numbers about the shown data; see render_to_png().
  const bindpose::Report& numbers() const { return this->coloring_.numbers; }
  /// Return the extrema of the surface. While tets are sliced, return those of all tets; the
  /// surface is then plain.
  const std::vector<bindpose::Extremum>& extrema() const { return this->extrema_; }
  vtkPolyData* slice() const { return this->slice_; }
  /// Return the isolines on the surface.
  vtkPolyData* isolines() const { return this->isolines_[0]; }

Q_SIGNALS:
  /// The plane has moved, for any reason.
  void plane_moved();

private:
  void show_surface();
  void draw_isolines(int part, vtkPolyData* data);
  void update_slice();
  void place_extrema();
  void before_drawing();

  Viewport* viewport_;
  PlaneHandle* plane_;
  vtkSmartPointer<vtkPolyData> surface_; // at rest
  vtkSmartPointer<vtkPolyData> shape_; // posed
  vtkSmartPointer<vtkUnstructuredGrid> volume_;
  vtkSmartPointer<vtkUnstructuredGrid> volume_values_; // with the shown number only
  bindpose::PictureOptions options_;
  bindpose::Coloring coloring_;
  bool shown_ = false;

  std::vector<bindpose::Extremum> extrema_;
  bindpose::ExtremumBalls balls_;
  vtkSmartPointer<vtkPolyData> slice_;
  vtkNew<vtkPolyDataMapper> slice_mapper_;
  vtkNew<vtkActor> slice_actor_;
  // 0: of the surface. 1: of the slice.
  std::array<vtkNew<vtkPolyData>, 2> isolines_;
  std::array<vtkNew<vtkPolyDataMapper>, 2> isoline_mappers_;
  std::array<vtkNew<vtkActor>, 2> isoline_actors_;
};

#endif
