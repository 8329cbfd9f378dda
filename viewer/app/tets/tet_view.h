#ifndef app_tets_tet_view_h
#define app_tets_tet_view_h

#include "app/view/plane_handle.h"
#include "base/status.h"
#include "conversion.h"
#include "scene/coloring.h"
#include "shapes/tet_cut.h"

#include "vtkActor.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <QObject>
#include <QTimer>

#include <array>
#include <optional>

namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::tets
{

/// Shows tets in the 3D view. Users can cut the tets open, shrink them, and color them by values.
/// The mouse drags the plane of the cut. The cut removes whole tets and keeps those whose center is
/// behind the plane.
class TetView : public QObject
{
  Q_OBJECT

public:
  explicit TetView(view::Viewport* viewport);

  /// Set the tets; null: no tets. If bindpose::to_tets() cannot convert them, return its error. The
  /// plane keeps its relative position in the bounding box.
  bindpose::Status set_tets(vtkUnstructuredGrid* tets);
  vtkUnstructuredGrid* tets() const { return this->grid_; }

  void show(bool shown);
  bool is_shown() const { return this->shown_ && this->grid_; }
  void set_cut(bool cut);
  /// Set whether the cut keeps the tets in front of the plane instead of the tets behind it.
  void set_other_side(bool other);
  view::PlaneHandle* plane() const { return this->plane_; }
  /// Set the drawn size of each tet relative to its own size, in (0, 1].
  void set_shrink(double factor);
  /// Set the values that are displayed as colors; empty: all tets have the same color. If the tets
  /// do not have these values, return an error and keep the colors.
  bindpose::Status set_colors(std::optional<bindpose::ColorBy> by);

  /// Return the tets. The next two functions return which tets the cut keeps, and the drawn size of
  /// a tet relative to its own size.
  const bindpose::TetInput& input() const { return this->input_; }
  const std::vector<char>& kept() const { return this->cut_.kept(); }
  double shrink() const { return this->shrink_; }
  /// Return the displayed values, one per tet; null if no values are displayed.
  vtkDoubleArray* values() const { return this->values_; }
  const bindpose::Coloring& coloring() const { return this->coloring_; }

  bindpose::Index shown_count() const { return this->is_shown() ? this->cut_.kept_count() : 0; }
  /// Return the milliseconds that the last update of the visible tets took, for example after the
  /// plane was moved. The time for drawing is not included.
  double milliseconds() const { return this->milliseconds_; }

Q_SIGNALS:
  /// Emitted when the plane has moved, for any reason.
  void plane_moved();
  void count_changed(qlonglong shown, qlonglong all);

private:
  void update();
  void draw_shrunk();
  void draw(int part, const bindpose::Triangles& triangles,
    const std::vector<bindpose::Index>& tets, vtkPoints* points);

  view::Viewport* viewport_;
  view::PlaneHandle* plane_;
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
  bindpose::TetInput input_;
  bindpose::TetCut cut_;
  bindpose::Coloring coloring_;
  vtkSmartPointer<vtkDoubleArray> values_; // the displayed values, #T; null: no values
  bool shown_ = false;
  bool cut_open_ = true;
  bool other_side_ = false;
  double shrink_ = 1.0;
  double milliseconds_ = 0.0;
  QTimer settle_timer_; // single-shot timer that starts after a drag
  // Mapper 0 draws faces on the boundary. Mapper 1 draws faces that the cut exposes or, if tets are
  // shrunk, all faces of the shrunk tets.
  std::array<vtkNew<vtkPolyDataMapper>, 2> mappers_;
  std::array<vtkNew<vtkActor>, 2> actors_;
};

} // namespace app::tets

#endif
