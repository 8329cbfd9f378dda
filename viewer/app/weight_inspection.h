#ifndef weight_inspection_h
#define weight_inspection_h

#include "bind_job.h"
#include "weight_view.h"

#include <QObject>
#include <QString>

#include <functional>

class Viewport;
class WeightPanel;

/// A surface's weights looked at: shows what the panel asks for as long as the panel is there, and
/// solves by another method beside the window.
class WeightInspection : public QObject
{
  Q_OBJECT

public:
  /// Fills what another bind of the same surface needs; false when handles are missing.
  using MakeInput = std::function<bool(BindInput&)>;

  WeightInspection(Viewport* viewport, WeightPanel* panel, MakeInput make_input);

  /// Another surface or other weights: the surface at rest, with Weights or not, the tets with the
  /// same weights (null: none), and whether the handles of the columns are there.
  void set_data(vtkPolyData* surface, vtkUnstructuredGrid* volume, bool has_handles);
  void move_surface(vtkPolyData* shape) { this->view_->move_surface(shape); }
  void set_active(bool active);
  /// The handle that was chosen in the picture.
  void choose_column(int column);

  void compare(int method); ///< of the panel's list
  void cancel() { this->job_.cancel(); }
  bool is_busy() const { return this->job_.is_running(); }

  /// Of Viewport: see-through around a slice.
  int surface_look() const;
  /// A slice lies in the shape at rest.
  bool wants_rest() const { return this->view_->is_sliced(); }
  WeightView* view() const { return this->view_; }

Q_SIGNALS:
  void surface_look_changed();
  /// One sentence; what was shown stays.
  void failed(const QString& sentence);
  /// What was asked for is shown.
  void succeeded();

private:
  void update();
  void update_facts();
  void comparison_finished();
  void show_position();
  QString certificate(int column) const;

  Viewport* viewport_;
  WeightPanel* panel_;
  WeightView* view_;
  MakeInput make_input_;
  vtkSmartPointer<vtkPolyData> surface_;
  vtkSmartPointer<vtkUnstructuredGrid> volume_;
  bool has_handles_ = false;
  bool active_ = false;
  bool sliced_ = false;
  BindJob job_;
  QString method_; // that is being compared with
  QString compared_method_;
  vtkSmartPointer<vtkPolyData> compared_; // the surface with the other weights
  double compared_seconds_ = 0.0;
};

/// What a bind has made, as the file that `bindpose weights --raw` writes holds it: the point
/// arrays Weights and RawWeights, the columns' certificates, and the seconds in the report.
void add_weights(const BindResult& result, const bindpose::Handles& handles, vtkPolyData* surface);
/// The tets that were solved on, with the same; null when it was the surface itself.
vtkSmartPointer<vtkUnstructuredGrid> make_weighted_tets(
  const BindResult& result, const bindpose::Handles& handles);

#endif
