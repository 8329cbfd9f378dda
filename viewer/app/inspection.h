#ifndef inspection_h
#define inspection_h

#include "defect_view.h"
#include "kernel_job.h"
#include "tet_view.h"

#include <QObject>

#include <memory>

class TetPanel;
class Viewport;

/// Inspection of a surface's tets and defects. They are computed in the background, and shown as
/// the panel requests while the panel is visible.
class Inspection : public QObject
{
  Q_OBJECT

public:
  Inspection(Viewport* viewport, TetPanel* panel);

  /// Set the surface at rest, and the tets of which it is the boundary (null: none yet).
  void set_surface(vtkPolyData* surface, vtkUnstructuredGrid* tets);
  /// Set whether the panel is shown. Otherwise the surface has its normal look.
  void set_active(bool active);
  void make_tets(int method); ///< a TetPanel::Method
  void cancel();
  /// Look for defects in the background after the surface was drawn, and emit defects_found() if
  /// there are any.
  void look_for_defects();
  void show_defects();
  bool is_busy() const
  {
    return this->tet_job_.is_running() || this->defect_job_.is_running() || this->waiting_;
  }
  /// Return how the surface is drawn (Viewport::SurfaceLook): hidden by tets, see-through with
  /// defects, otherwise solid.
  int surface_look() const;

  TetView* tet_view() const { return this->tets_; }
  const DefectView& defect_view() const { return this->defects_; }

Q_SIGNALS:
  void surface_look_changed();
  /// The first tets of the surface were made. Emitted before they are shown.
  void tets_made();
  /// Counts per type of defect, for a sentence.
  void defects_found(const QString& counts);
  /// One sentence. The picture is unchanged.
  void failed(const QString& sentence);
  /// Tets were made, or are shown as requested.
  void succeeded();
  /// Tets were made, with a remark for the user.
  void noticed(const QString& sentence);

private:
  void tets_finished();
  void defects_finished();
  void update_defects();
  void start_looking();
  void picture_drawn();
  void choose_colors(int colors);
  void show_position();
  void update_panel();

  Viewport* viewport_;
  TetPanel* panel_;
  TetView* tets_;
  DefectView defects_;
  vtkSmartPointer<vtkPolyData> surface_;
  bool active_ = false;
  bool looking_ = false; // defects_found() must be emitted if the search finds any
  bool waiting_ = false; // the search waits for the first picture of the surface
  int colors_ = 0; // the shown TetPanel::Colors
  std::shared_ptr<vtkSmartPointer<vtkUnstructuredGrid>> made_tets_;
  std::shared_ptr<vtkSmartPointer<vtkPolyData>> made_defects_;
  KernelJob tet_job_;
  KernelJob defect_job_;
};

#endif
