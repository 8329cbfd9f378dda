#ifndef inspection_h
#define inspection_h

#include "defect_view.h"
#include "kernel_job.h"
#include "tet_view.h"

#include <QObject>

#include <memory>

class TetPanel;
class Viewport;

/// A surface's tets and defects: makes them beside the window, and shows what the panel asks for as
/// long as the panel is there.
class Inspection : public QObject
{
  Q_OBJECT

public:
  Inspection(Viewport* viewport, TetPanel* panel);

  /// Another surface, at rest, and the tets that it is the skin of (null: none yet).
  void set_surface(vtkPolyData* surface, vtkUnstructuredGrid* tets);
  /// Whether the panel is there; else the surface is shown as ever.
  void set_active(bool active);
  void make_tets(int method); ///< of TetPanel
  void cancel();
  /// Beside the window, once the surface has been drawn; defects_found() tells when there are some.
  void look_for_defects();
  void show_defects();
  bool is_busy() const
  {
    return this->tet_job_.is_running() || this->defect_job_.is_running() || this->waiting_;
  }
  /// How the surface is to be drawn (of Viewport): tets take its place, defects shine through it.
  int surface_look() const;

  TetView* tet_view() const { return this->tets_; }
  const DefectView& defect_view() const { return this->defects_; }

Q_SIGNALS:
  void surface_look_changed();
  /// The first tets of the surface are there, before they are shown.
  void tets_made();
  /// How many of which kind, for a sentence.
  void defects_found(const QString& counts);
  /// One sentence; what was shown stays.
  void failed(const QString& sentence);
  /// Tets are made, or shown as was asked for.
  void succeeded();
  /// Tets are made, and this is to be known about them.
  void noticed(const QString& sentence);

private:
  void tets_finished();
  void defects_finished();
  void update_defects();
  void start_looking();
  void picture_drawn();
  void choose_colours(int colours);
  void show_position();
  void update_panel();

  Viewport* viewport_;
  TetPanel* panel_;
  TetView* tets_;
  DefectView defects_;
  vtkSmartPointer<vtkPolyData> surface_;
  bool active_ = false;
  bool looking_ = false; // for defects, to tell about them
  bool waiting_ = false; // with that, for the first picture of the surface
  int colours_ = 0; // of TetPanel, those that are shown
  std::shared_ptr<vtkSmartPointer<vtkUnstructuredGrid>> made_tets_;
  std::shared_ptr<vtkSmartPointer<vtkPolyData>> made_defects_;
  KernelJob tet_job_;
  KernelJob defect_job_;
};

#endif
