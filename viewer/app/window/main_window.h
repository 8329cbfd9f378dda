#ifndef app_window_main_window_h
#define app_window_main_window_h

#include "app/parts/error_bar.h"
#include "document/work.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <QMainWindow>

#include <map>
#include <memory>
#include <optional>

class QLabel;
class Document;
struct OpenedFile;
class vtkDataSet;
class vtkImageData;

namespace app::handles
{
class HandleEditing;
class ShapeHandles;
class SidePanel;
} // namespace app::handles
namespace app::parts
{
class BarStack;
class ElidedLabel;
class NoticeBar;
} // namespace app::parts
namespace app::posing
{
class DistanceView;
class KeyStrip;
class PoseController;
class RotationView;
} // namespace app::posing
namespace app::tets
{
class TetInspection;
} // namespace app::tets
namespace app::view
{
class Viewport;
} // namespace app::view
namespace app::volume
{
class VolumeView;
class WindingVolume;
} // namespace app::volume
namespace app::weights
{
class Binding;
class WeightInspection;
} // namespace app::weights

namespace app::window
{

class EmptyState;
class Exports;
class OptionLinks;
class PanelColumn;
class Probe;
class WindowMenus;
class WindowSessions;

/// The window of `bindpose view`. In it users bind a surface to handles and pose the surface. They
/// can also inspect volumes of winding numbers, and the weights, tets and defects of a surface.
///
/// The Document contains the state that is saved. The window arranges views and panels and connects
/// them to the document.
class MainWindow : public QMainWindow
{
  Q_OBJECT

public:
  explicit MainWindow(QWidget* parent = nullptr);
  ~MainWindow() override;

  Document* document() const { return this->document_; }

  /// Open a mesh, handles, weights, an image, a volume, curves or a session. If the file cannot be
  /// used, show a sentence in the error bar, keep what is open, and return false.
  /// @param read  the contents of the file, if it was already read
  bool open(const QString& path, const OpenedFile* read = nullptr);
  /// @param look  materials, textures and vertex colors of the mesh; null: none
  bool set_mesh(vtkDataSet* mesh, const QString& name, const Source& source = {},
    const std::shared_ptr<const bindpose::FileLook>& look = nullptr);
  bool set_handles(vtkPolyData* handles, const QString& name, const Source& source = {});
  bool set_volume(vtkImageData* volume, const QString& name, const Source& source = {});
  bool set_curves(vtkPolyData* curves, const Source& source = {});
  void close_volume();
  /// Ask for files and open them.
  void choose_and_open();

  bool is_bound() const;
  void set_method(int method);
  void set_mode(int handle, int mode);
  void reset_to_rest();
  /// Report whether no file is open.
  bool is_empty() const;

  /// Return the current shape, see PoseController::shape(): posed, or at rest if it cannot be
  /// posed.
  vtkPolyData* shown() const;
  /// Show or hide outlines, as an undo step.
  void show_outlines(bool shown);
  /// Show or hide the materials and textures of the mesh, as an undo step.
  void show_look(bool shown);
  /// Show or hide the key frames below the 3D view.
  void show_timeline(bool shown);
  /// Return the text of the label about the point under the mouse, in one line.
  QString reading() const;
  /// Return the sentence in the error bar; empty if the bar is hidden.
  QString error() const;
  void show_error(const QString& message, parts::ErrorKind kind = parts::ErrorKind::other);

protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

private:
  void make_layout();
  void make_inspections();
  void connect_menus();
  void update_menus();
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
  /// Switch the 2D mode on or off. When a planar shape is opened, the mode is on. If the mode is
  /// off, the view can be rotated. The camera is unchanged.
  void set_flat_view(bool flat);
  void update_plane();
  void update_surface_appearance();
  void offer_defects(const QString& counts);
  void connect_posing();
  void update_pose();
  void draw_pose();
  void update_panel();
  void show_column(int column);
  void show_selected_column();
  QString bound_note() const;
  void show_state();
  void orient_planes();
  bool open_file(const QString& path, const OpenedFile* read);
  bool open_folder(const QString& path);
  bool show_file(const OpenedFile& file, const QString& path);
  bool open_picture(
    vtkImageData* picture, const QString& name, const Source& source, bool is_whole_image);
  bool report_error(const QString& name, const bindpose::Status& status);
  void update_hint();
  void show_notice(const QString& message);
  void update_title();

  Document* document_;
  // Parts of the window. Tours and tests find each part by its type, and each bar by its object
  // name.
  view::Viewport* viewport_ = nullptr;
  volume::VolumeView* volume_view_ = nullptr;
  tets::TetInspection* tet_inspection_ = nullptr;
  weights::WeightInspection* weights_ = nullptr;
  Probe* probe_ = nullptr;
  std::optional<bindpose::Vec3> plane_; // normal of a planar shape at rest; empty: not planar
  bool flat_requested_ = true;
  /// Last orientation that the program has chosen for each cutting plane. The key is the prefix of
  /// the plane's options: "volume", "tets" or "weights".
  std::map<QString, int> automatic_orientations_;
  posing::PoseController* posing_ = nullptr;
  handles::HandleEditing* editing_ = nullptr;
  weights::Binding* binding_ = nullptr;
  handles::ShapeHandles* shape_handles_ = nullptr;
  posing::KeyStrip* strip_ = nullptr; // shown below the 3D view
  PanelColumn* panels_ = nullptr;
  posing::RotationView* rotations_ = nullptr;
  posing::DistanceView* distances_ = nullptr;
  handles::SidePanel* panel_ = nullptr; // part of panels_
  OptionLinks* links_ = nullptr;
  WindowMenus* menus_ = nullptr;
  WindowSessions* sessions_ = nullptr;
  Exports* exports_ = nullptr;
  volume::WindingVolume* winding_volume_ = nullptr;
  parts::BarStack* bars_ = nullptr; // stack of bars over the 3D view; contains the next five bars
  parts::ErrorBar* error_bar_ = nullptr;
  parts::NoticeBar* recovery_bar_ = nullptr;
  /// Shows notes, for example that a file of a session is missing or that the surface has defects.
  parts::NoticeBar* note_bar_ = nullptr;
  parts::NoticeBar* rebind_bar_ = nullptr;
  parts::NoticeBar* export_bar_ = nullptr; // shows what was exported and to which path
  /// The status line. It describes the current interaction, or the last pose.
  parts::ElidedLabel* hint_ = nullptr;
  EmptyState* empty_ = nullptr; // shown in the middle of the 3D view while no file is open
  vtkSmartPointer<vtkPolyData> drawn_surface_; // the surface that the viewport shows
  bool timeline_ = false; // true: show the timeline; set by the user or the first key frame
  bool has_keys_ = false;
  QString read_notice_; // warnings of the reader about the last opened file
  QString hint_text_; // shown in the status line when there is no interaction
};

} // namespace app::window

#endif
