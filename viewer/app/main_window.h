#ifndef main_window_h
#define main_window_h

#include "document/work.h"
#include "error_bar.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <QMainWindow>

#include <map>
#include <optional>

class QLabel;
class QUndoStack;
class BarStack;
class Binding;
class DistanceView;
class Document;
class ElidedLabel;
class Exports;
struct OpenedFile;
class HandleEditing;
class EmptyState;
class ShapeHandles;
class Inspection;
class KeyStrip;
class NoticeBar;
class OptionLinks;
class PanelColumn;
class Posing;
class Probe;
class RotationView;
class SidePanel;
class Viewport;
class VolumeView;
class WeightInspection;
class WindowMenus;
class WindowSessions;
class WindingVolume;
class vtkDataSet;
class vtkImageData;

/// The window of `bindpose view`: open a surface and handles, bind, drag; or open a volume of
/// winding numbers, alone or along with a surface and its boundary curves, and inspect it. Of a
/// surface the weights, tets and defects can be looked at, of tets the inside.
///
/// What is kept is in its Document; the window lays views and panels out, and wires them to it.
class MainWindow : public QMainWindow
{
  Q_OBJECT

public:
  explicit MainWindow(QWidget* parent = nullptr);
  ~MainWindow() override;

  Document* document() const { return this->document_; }
  QUndoStack* history() const;

  WindowSessions* sessions() const { return this->sessions_; }
  Exports* exports() const { return this->exports_; }

  /// Opens a mesh, handles, weights, a picture, a volume, curves or a session, whichever it is.
  /// False, with a sentence in the error bar, when it cannot be used; what was open stays.
  /// `read`: what the file holds, if it is already read.
  bool open(const QString& path, const OpenedFile* read = nullptr);
  bool set_mesh(vtkDataSet* mesh, const QString& name, const Source& source = {});
  bool set_handles(vtkPolyData* handles, const QString& name, const Source& source = {});
  bool set_volume(vtkImageData* volume, const QString& name, const Source& source = {});
  bool set_curves(vtkPolyData* curves, const Source& source = {});
  void close_volume();
  /// Asks for files to open.
  void choose_and_open();

  bool is_bound() const;
  void set_method(int method);
  void set_mode(int handle, int mode);
  void back_to_rest();
  /// Nothing is open.
  bool is_empty() const;

  /// What is drawn: the posed surface, or the rest one before a bind.
  vtkPolyData* shown() const;
  Viewport* viewport() const { return this->viewport_; }
  SidePanel* panel() const { return this->panel_; }
  RotationView* rotations() const { return this->rotations_.get(); }
  PanelColumn* panels() const { return this->panels_; }
  VolumeView* volume_view() const { return this->volume_view_; }
  Inspection* inspection() const { return this->inspection_; }
  Probe* probe() const { return this->probe_; }
  /// The shape lies in a plane, so that it can be looked at in 2D.
  bool is_planar() const { return this->plane_.has_value(); }
  /// The 2D mode, which every planar shape begins in; or views that can be turned. The camera
  /// stays.
  void set_flat_view(bool flat);
  /// A step of the history.
  void show_outlines(bool shown);
  WeightInspection* weights() const { return this->weights_; }
  Posing* posing() const { return this->posing_; }
  Binding* binding() const { return this->binding_; }
  HandleEditing* editing() const { return this->editing_; }
  ShapeHandles* shape_handles() const { return this->shape_handles_; }
  KeyStrip* strip() const { return this->strip_; }
  WindingVolume* winding_volume() const { return this->winding_volume_; }
  /// The key frames below the picture: seen from the first one on, or on demand.
  bool shows_timeline() const { return this->timeline_; }
  void show_timeline(bool shown);
  /// The line at the bottom, which says what the hand does or what the last pose took.
  const ElidedLabel* hint() const { return this->hint_; }
  /// What is under the mouse, as the label in the picture says it, in one line.
  QString reading() const;
  /// The sentence in the error bar; empty when it is hidden.
  QString error() const;
  void show_error(const QString& sentence, ErrorKind kind = ErrorKind::other);
  ErrorBar* error_bar() const { return this->error_bar_; }
  void show_notice(const QString& sentence);
  void update_title();
  NoticeBar* rebind_bar() const { return this->rebind_bar_; }
  NoticeBar* recovery_bar() const { return this->recovery_bar_; }
  /// What is missing of a session, how a picture was cut out, where a surface is unclean.
  NoticeBar* note_bar() const { return this->note_bar_; }
  /// What was exported, and where to.
  NoticeBar* export_bar() const { return this->export_bar_; }

protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

private:
  void make_layout();
  void make_inspections();
  void connect_panel();
  void connect_volume();
  void connect_handles();
  void document_changed(int parts);
  void option_changed(const QString& key, const QVariant& value);
  void show_mesh();
  void show_handles();
  void show_volume();
  void connect_weights();
  void connect_errors();
  void keys_changed();
  void update_plane();
  void update_surface_look();
  void offer_defects(const QString& counts);
  void connect_posing();
  void update_pose();
  void draw_pose();
  void update_panel();
  void show_column(int column);
  void show_selected_column();
  QString bound_note() const;
  void show_state();
  void face_planes();
  bool open_file(const QString& path, const OpenedFile* read);
  bool show_file(const OpenedFile& file, const QString& path);
  bool open_picture(vtkImageData* picture, const QString& name, const Source& source, bool whole);
  bool say(const QString& name, const bindpose::Status& status);
  void update_hint();

  Document* document_;
  Viewport* viewport_ = nullptr;
  VolumeView* volume_view_ = nullptr;
  Inspection* inspection_ = nullptr;
  WeightInspection* weights_ = nullptr;
  Probe* probe_ = nullptr;
  std::optional<bindpose::Vec3> plane_; // its normal, of the shape at rest
  bool flat_wanted_ = true;
  /// Of each plane, by its options' name, the orientation that the program itself has chosen last.
  std::map<QString, int> faced_;
  Posing* posing_ = nullptr;
  HandleEditing* editing_ = nullptr;
  Binding* binding_ = nullptr;
  ShapeHandles* shape_handles_ = nullptr;
  KeyStrip* strip_ = nullptr; // below the picture
  PanelColumn* panels_ = nullptr;
  std::unique_ptr<RotationView> rotations_;
  std::unique_ptr<DistanceView> distances_;
  SidePanel* panel_ = nullptr; // one of them
  OptionLinks* links_ = nullptr;
  WindowMenus* menus_ = nullptr;
  WindowSessions* sessions_ = nullptr;
  Exports* exports_ = nullptr;
  WindingVolume* winding_volume_ = nullptr;
  BarStack* bars_ = nullptr; // over the picture:
  ErrorBar* error_bar_ = nullptr;
  NoticeBar* recovery_bar_ = nullptr;
  NoticeBar* note_bar_ = nullptr;
  NoticeBar* rebind_bar_ = nullptr;
  NoticeBar* export_bar_ = nullptr;
  ElidedLabel* hint_ = nullptr;
  EmptyState* empty_ = nullptr; // in the middle of the picture as long as nothing is open
  vtkSmartPointer<vtkPolyData> drawn_; // the surface that the viewport has
  bool timeline_ = false;
  bool has_keys_ = false;
  QString read_notice_; // what the opened file lost
  QString hint_text_; // in the status line, unless the hand does something
};

#endif
