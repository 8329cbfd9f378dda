#ifndef app_weights_weight_inspection_h
#define app_weights_weight_inspection_h

#include "app/weights/bind_job.h"
#include "app/weights/weight_view.h"

#include <QObject>
#include <QString>

#include <functional>

namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::weights
{

class WeightPanel;

/// Inspection of a surface's weights. While the panel is visible, this class shows the data that
/// the panel requests. It also computes weights with another method in the background, for
/// comparison.
class WeightInspection : public QObject
{
  Q_OBJECT

public:
  /// Sets the input for a bind of the inspected surface. Returns false if a bind is impossible, for
  /// example without handles.
  using MakeInput = std::function<bool(BindInput&)>;

  WeightInspection(view::Viewport* viewport, WeightPanel* panel, MakeInput make_input);

  /// Set the data to inspect. `surface` is the surface at rest; its array Weights is optional.
  /// `volume` are tets with weights of the same bind (null: no tets). `has_handles`: the handles to
  /// which the columns belong are open.
  void set_data(vtkPolyData* surface, vtkUnstructuredGrid* volume, bool has_handles);
  void move_surface(vtkPolyData* shape) { this->view_->move_surface(shape); }
  void set_active(bool active);
  /// Show the column of the handle that was chosen in the 3D view.
  void choose_column(int column);

  void compare(int method); ///< compute weights with another method, an index of weight_methods()
  void cancel() { this->job_.cancel(); }
  /// Enable and show the widgets of the panel that the data and the viewport need.
  void update_panel_state();
  bool is_busy() const { return this->job_.is_running(); }

  /// Return how the surface is drawn (Viewport::SurfaceAppearance): see-through if a slice is
  /// shown, otherwise solid.
  int surface_appearance() const;
  /// Report whether the shape must be shown at rest, because a slice through the rest shape is
  /// shown.
  bool requires_rest_shape() const { return this->view_->is_sliced(); }
  WeightView* view() const { return this->view_; }

Q_SIGNALS:
  void surface_look_changed();
  /// Emitted with one sentence if the requested data cannot be shown. The plain surface is then
  /// drawn.
  void failed(const QString& message);
  /// Emitted when the requested data is shown.
  void succeeded();

private:
  void update();
  void comparison_finished();
  void show_position();
  QString certificate(int column) const;

  view::Viewport* viewport_;
  WeightPanel* panel_;
  WeightView* view_;
  MakeInput make_input_;
  vtkSmartPointer<vtkPolyData> surface_;
  vtkSmartPointer<vtkUnstructuredGrid> volume_;
  bool has_handles_ = false;
  bool active_ = false;
  bool sliced_ = false;
  BindJob job_;
  QString method_; // the method of the running comparison
  QString compared_method_;
  vtkSmartPointer<vtkPolyData> compared_; // the surface with weights of compared_method_
  double compared_seconds_ = 0.0;
};

/// Add the result of a bind to `surface`: the point arrays Weights and RawWeights, the certificates
/// of the columns, and the report. `bindpose weights --keep-raw` writes files with the same arrays.
void add_weights(const BindResult& result, const bindpose::Handles& handles, vtkPolyData* surface);
/// Return the tets on which the weights were solved, with the point arrays Weights and RawWeights.
/// Return null if the weights were solved on the surface itself.
vtkSmartPointer<vtkUnstructuredGrid> make_weighted_tets(
  const BindResult& result, const bindpose::Handles& handles);

} // namespace app::weights

#endif
