// Draws tets that are cut open. TetCut computes the visible faces. These become the triangles of
// two actors, which use the points of the tets without a copy. Faces are drawn with flat shading,
// so that no normals are computed when the plane moves.
#include "app/tets/tet_view.h"

#include "app/view/viewport.h"

#include "scene/colors.h"
#include "shapes/shaded_surface.h"

#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <QApplication>

#include <chrono>

namespace app::tets
{

using namespace bindpose;

TetView::TetView(view::Viewport* viewport)
  : QObject(viewport), viewport_(viewport), plane_(new view::PlaneHandle(viewport, this))
{
  for (int part : { 0, 1 })
  {
    vtkActor* actor = this->actors_[part];
    vtkPolyDataMapper* mapper = this->mappers_[part];
    mapper->SetScalarModeToUseCellData();
    mapper->SetColorModeToMapScalars();
    mapper->UseLookupTableScalarRangeOn();
    mapper->ScalarVisibilityOff();
    actor->SetMapper(mapper);
    use_surface_material(actor);
    vtkProperty* property = actor->GetProperty();
    property->SetInterpolationToFlat();
    property->SetAmbient(0.3);
    property->SetDiffuse(0.74);
    property->SetSpecular(0.04);
    const Rgb& color = part == 0 ? palette::surface : palette::cut;
    set_color(property, color);
    const Rgb& edges = part == 0 ? palette::edges : palette::cut_edges;
    property->SetEdgeColor(edges[0], edges[1], edges[2]);
    property->EdgeVisibilityOn();
    actor->VisibilityOff();
    actor->PickableOff();
    viewport->renderer()->AddActor(actor);
  }
  this->plane_->draw_box(false); // no box is needed: the tets themselves show their extent
  this->settle_timer_.setSingleShot(true);
  this->settle_timer_.setInterval(250);
  QObject::connect(&this->settle_timer_, &QTimer::timeout, this, &TetView::update);
  QObject::connect(this->plane_, &view::PlaneHandle::moved, this,
    [this]
    {
      this->update();
      Q_EMIT this->plane_moved();
    });
}

Status TetView::set_tets(vtkUnstructuredGrid* tets)
{
  TetInput input;
  if (tets)
  {
    Status status = to_tets(tets, input);
    if (!status.ok())
    {
      return status;
    }
  }
  this->grid_ = tets;
  this->input_ = std::move(input);
  this->cut_ = tets ? TetCut(this->input_.points.view(), this->input_.tets.view()) : TetCut();
  this->plane_->set_box(tets ? bounding_box(this->input_.points.view()) : Box());
  const ColorBy by = this->coloring_.by;
  const bool colored = this->values_ != nullptr;
  this->values_ = nullptr;
  this->coloring_ = Coloring();
  Status status = tets && colored ? this->set_colors(by) : this->set_colors(std::nullopt);
  if (!status.ok())
  {
    // the new tets lack the values that colored the previous tets
    this->set_colors(std::nullopt);
  }
  return {};
}

void TetView::show(bool shown)
{
  this->shown_ = shown;
  this->update();
}

void TetView::set_cut(bool cut)
{
  this->cut_open_ = cut;
  this->update();
}

void TetView::set_other_side(bool other)
{
  this->other_side_ = other;
  this->update();
}

void TetView::set_shrink(double factor)
{
  this->shrink_ = factor;
  this->update();
}

Status TetView::set_colors(std::optional<ColorBy> by)
{
  if (by && this->grid_)
  {
    PictureOptions options;
    options.color_by = *by;
    Coloring coloring;
    Status status = choose_coloring({ { this->grid_, nullptr, "" } }, options, coloring);
    if (!status.ok())
    {
      return status;
    }
    bool on_points = false;
    const auto values = color_values(this->grid_, coloring, on_points);
    if (!values || on_points)
    {
      return Status::invalid_input(
        "the array '" + coloring.legend_name() + "' must have one value per tet");
    }
    this->values_ = values;
    this->coloring_ = coloring;
  }
  else
  {
    this->values_ = nullptr;
  }
  this->update();
  return {};
}

void TetView::draw(
  int part, const Triangles& triangles, const std::vector<Index>& tets, vtkPoints* points)
{
  const auto data = to_polydata(Points(0, 3), triangles);
  data->SetPoints(points);
  if (this->values_)
  {
    vtkNew<vtkDoubleArray> values;
    values->SetNumberOfValues(static_cast<vtkIdType>(tets.size()));
    const double* from = this->values_->GetPointer(0);
    double* to = values->GetPointer(0);
    for (std::size_t i = 0; i < tets.size(); ++i)
    {
      to[i] = from[tets[i]];
    }
    data->GetCellData()->SetScalars(values);
    this->mappers_[part]->SetLookupTable(this->coloring_.map.table);
  }
  this->mappers_[part]->SetScalarVisibility(this->values_ != nullptr);
  this->mappers_[part]->SetInputData(data);
  this->actors_[part]->SetVisibility(!tets.empty());
  this->actors_[part]->GetProperty()->SetLineWidth(
    static_cast<float>(this->viewport_->devicePixelRatioF()));
}

/// Draw the tets with gaps between them. All kept tets are drawn, which is slow. During a drag,
/// tets are drawn only if they have a face on the boundary of the kept tets.
void TetView::draw_shrunk()
{
  const bool dragging = QApplication::mouseButtons() != Qt::NoButton;
  std::vector<char> drawn_tets = this->cut_.kept();
  if (dragging)
  {
    drawn_tets.assign(drawn_tets.size(), 0);
    for (const auto* face_sets : { &this->cut_.boundary_faces(), &this->cut_.exposed_faces() })
    {
      for (const Index t : face_sets->tets)
      {
        drawn_tets[t] = 1;
      }
    }
    this->settle_timer_.start();
  }
  const ShrunkTets shrunk =
    shrink_tets(this->input_.points.view(), this->input_.tets.view(), drawn_tets, this->shrink_);
  this->draw(1, shrunk.triangles, shrunk.tets, to_vtk_points(shrunk.points));
  this->actors_[0]->VisibilityOff();
}

void TetView::update()
{
  const bool shown = this->is_shown();
  this->plane_->show(shown && this->cut_open_);
  this->viewport_->show_legend(view::Viewport::tet_legend,
    shown && this->values_ ? QString::fromStdString(this->coloring_.legend_name()) : QString(),
    this->coloring_.map);
  if (!shown)
  {
    for (const auto& actor : this->actors_)
    {
      actor->VisibilityOff();
    }
    this->viewport_->refresh();
    return;
  }
  const auto start = std::chrono::steady_clock::now();
  if (this->cut_open_)
  {
    const double normal_sign = this->other_side_ ? -1.0 : 1.0;
    this->cut_.keep_behind(this->plane_->origin(), normal_sign * this->plane_->normal());
  }
  else
  {
    this->cut_.keep_all();
  }
  // The back faces of a separate tet are never visible.
  this->actors_[1]->GetProperty()->SetBackfaceCulling(this->shrink_ < 1.0);
  if (this->shrink_ < 1.0)
  {
    this->draw_shrunk();
  }
  else
  {
    this->draw(0, this->cut_.boundary_faces().triangles, this->cut_.boundary_faces().tets,
      this->grid_->GetPoints());
    this->draw(1, this->cut_.exposed_faces().triangles, this->cut_.exposed_faces().tets,
      this->grid_->GetPoints());
  }
  const std::chrono::duration<double, std::milli> elapsed =
    std::chrono::steady_clock::now() - start;
  this->milliseconds_ = elapsed.count();
  this->viewport_->refresh();
  Q_EMIT this->count_changed(this->cut_.kept_count(), this->grid_->GetNumberOfCells());
}

} // namespace app::tets
