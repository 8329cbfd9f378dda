#ifndef main_window_h
#define main_window_h

#include "bind_job.h"
#include "pose/pose.h"
#include "weights/handles.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <QMainWindow>

class QAction;
class QActionGroup;
class QLabel;
class QUndoStack;
class ErrorBar;
class Inspection;
class KeyStrip;
class PanelColumn;
class Posing;
class SidePanel;
class Viewport;
class VolumeView;
class WeightInspection;
class vtkDataSet;
class vtkImageData;

/// The window of `bindpose view`: open a surface and handles, bind, drag; or open a volume of
/// winding numbers, alone or along with a surface and its boundary curves, and inspect it. Of a
/// surface the weights, tets and defects can be looked at, of tets the inside.
///
/// Three things are kept: the surface at rest (with or without weights), the handles (edited in
/// place by the drag widget: pose arrays only), and the history of the pose. All else is derived.
class MainWindow : public QMainWindow
{
  Q_OBJECT

public:
  explicit MainWindow(QWidget* parent = nullptr);
  ~MainWindow() override;

  /// Opens a mesh, handles, a volume or curves, whichever it is. False, with a sentence in the
  /// error bar, when it cannot be used; what was open stays.
  bool open(const QString& path);
  bool set_mesh(vtkDataSet* mesh, const QString& name);
  bool set_handles(vtkPolyData* handles, const QString& name);
  bool set_volume(vtkImageData* volume, const QString& name);
  bool set_curves(vtkPolyData* curves);
  void close_volume();

  void bind();
  void cancel_bind();
  bool is_binding() const { return this->job_->is_running(); }
  bool is_bound() const;
  void set_method(int method);
  void set_mode(int handle, int mode);
  void back_to_rest();

  /// What is drawn: the posed surface, or the rest one before a bind.
  vtkPolyData* shown() const;
  Viewport* viewport() const { return this->viewport_; }
  QUndoStack* history() const { return this->history_; }
  SidePanel* panel() const { return this->panel_; }
  PanelColumn* panels() const { return this->panels_; }
  VolumeView* volume_view() const { return this->volume_view_; }
  Inspection* inspection() const { return this->inspection_; }
  WeightInspection* weights() const { return this->weights_; }
  Posing* posing() const { return this->posing_; }
  /// What is under the mouse on the slice, as the status bar shows it.
  QString reading() const;
  /// The sentence in the error bar; empty when it is hidden.
  QString error() const;

protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

private:
  void make_menus();
  void make_layout();
  void show_error(const QString& sentence);
  void connect_volume();
  void update_surface_look();
  void connect_weights();
  bool make_bind_input(BindInput& input);
  void preview_arrived(const bindpose::Weights& weights);
  void bind_finished();
  /// False when they are not of this mesh and these handles.
  bool take_weights(const BindResult& result);
  void set_rest(vtkPolyData* rest, vtkUnstructuredGrid* weighted_tets);
  void connect_posing();
  void update_pose();
  void draw_pose();
  void update_panel();
  void show_column(int column);
  int handle_of_cell(vtkIdType cell) const;
  bindpose::Pose pose() const;
  void apply_pose(const bindpose::Pose& pose);
  void remember(const QString& name, const bindpose::Pose& before);
  void stop_drag();
  void selection_changed();
  void drag_began();
  void drag_ended();
  void save(const QString& what);

  Viewport* viewport_ = nullptr;
  VolumeView* volume_view_ = nullptr;
  Inspection* inspection_ = nullptr;
  WeightInspection* weights_ = nullptr;
  Posing* posing_ = nullptr;
  KeyStrip* strip_ = nullptr; // below the picture
  PanelColumn* panels_ = nullptr;
  SidePanel* panel_ = nullptr; // one of them
  ErrorBar* error_bar_ = nullptr;
  QLabel* hint_ = nullptr;
  QLabel* reading_ = nullptr;
  QLabel* empty_ = nullptr; // in the middle of the picture as long as nothing is open
  QAction* save_shape_ = nullptr;
  QAction* save_pose_ = nullptr;
  QAction* save_picture_ = nullptr;
  QAction* bind_ = nullptr;
  QAction* rest_pose_ = nullptr;
  QActionGroup* methods_ = nullptr;
  QUndoStack* history_ = nullptr;
  BindJob* job_ = nullptr;

  vtkSmartPointer<vtkPolyData> rest_;
  vtkSmartPointer<vtkUnstructuredGrid> weighted_tets_; ///< what was solved on; null: not known
  /// While a preview's weights are used.
  vtkSmartPointer<vtkPolyData> before_preview_, preview_;
  vtkSmartPointer<vtkUnstructuredGrid> tets_before_preview_;
  vtkSmartPointer<vtkPolyData> handle_data_;
  bool has_curves_ = false; // opened as such, not the lines of a mesh
  bindpose::Handles handles_;
  std::vector<bindpose::Index> handle_cells_;
  bindpose::Pose before_drag_;
  bindpose::Pose before_change_; // by posing_; empty: none is going on
  int dragged_ = -1;
};

#endif
