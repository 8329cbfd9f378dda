#ifndef app_tets_tet_inspection_h
#define app_tets_tet_inspection_h

#include "app/parts/kernel_job.h"
#include "app/tets/defect_view.h"
#include "app/tets/tet_view.h"

#include <QObject>

#include <memory>

namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::tets
{

class TetPanel;

/// Computes a surface's tets and defects in the background. While the panel is visible, this class
/// shows the tets and defects as the panel requests.
class TetInspection : public QObject
{
  Q_OBJECT

public:
  TetInspection(view::Viewport* viewport, TetPanel* panel);

  /// Set the surface at rest, and the tets inside it that were opened from a file (null: no tets).
  void set_surface(vtkPolyData* surface, vtkUnstructuredGrid* tets);
  /// Set whether the tet panel is visible. While it is hidden, the surface is drawn normally,
  /// without tets and defects.
  void set_active(bool active);
  void make_tets(int method); ///< compute tets with a meshing method, one of TetPanel::Method
  void cancel();
  /// Search for defects in the background after the surface was drawn. Emit defects_found() if the
  /// surface has defects.
  void search_defects();
  void show_defects();
  bool is_busy() const
  {
    return this->tet_job_.is_running() || this->defect_job_.is_running() ||
      this->waits_for_drawing_;
  }
  /// Return how the surface is drawn (Viewport::SurfaceAppearance): hidden while tets are shown,
  /// see-through while defects are shown, otherwise solid.
  int surface_appearance() const;

  TetView* tet_view() const { return this->tets_; }
  const DefectView& defect_view() const { return this->defects_; }

Q_SIGNALS:
  void surface_look_changed();
  /// Emitted when tets were computed and the surface had no tets before. The signal is emitted
  /// before the tets are shown.
  void first_tets_computed();
  /// Emitted when the search of search_defects() has found defects. `counts` is a text with the
  /// counts per type.
  void defects_found(const QString& counts);
  /// Emitted with one sentence if tets or their colors cannot be computed; the display is
  /// unchanged.
  void failed(const QString& message);
  /// Emitted when the tets are shown with the requested colors.
  void succeeded();
  /// Emitted with a message for the user after tets were computed.
  void notice_requested(const QString& message);

private:
  void tets_finished();
  void defects_finished();
  void update_defects();
  void start_defect_search();
  void view_drawn();
  void choose_colors(int colors);
  void show_position();
  void update_panel();

  view::Viewport* viewport_;
  TetPanel* panel_;
  TetView* tets_;
  DefectView defects_;
  vtkSmartPointer<vtkPolyData> surface_;
  bool active_ = false;
  bool reports_defects_ = false; // true: emit defects_found() if the search finds defects
  bool waits_for_drawing_ =
    false; // true: the search begins after the surface was drawn for the first time
  int colors_ = 0; // the displayed values, one of TetPanel::Colors
  std::shared_ptr<vtkSmartPointer<vtkUnstructuredGrid>> new_tets_;
  std::shared_ptr<vtkSmartPointer<vtkPolyData>> new_defects_;
  parts::KernelJob tet_job_;
  parts::KernelJob defect_job_;
};

} // namespace app::tets

#endif
