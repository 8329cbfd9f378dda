// Paints regions. The brush paints a separate surface, which shares points and triangles with the
// document's surface. The document's data is never modified. When a stroke ends, its labels become
// an undo step.
#include "app/handles/region_painting.h"

#include "app/view/viewport.h"
#include "document/document.h"

#include "scene/categories.h"
#include "scene/colors.h"

#include "handle_edit_cells.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRegionBrushRepresentation.h"
#include "vtkRegionBrushWidget.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace app::handles
{

using namespace bindpose;

namespace
{
int label_at(vtkDataArray* labels, vtkIdType vertex)
{
  return labels && vertex < labels->GetNumberOfTuples()
    ? static_cast<int>(labels->GetComponent(vertex, 0))
    : 0;
}

std::set<int> labels_in(vtkDataArray* labels)
{
  std::set<int> found;
  for (vtkIdType v = 0; labels && v < labels->GetNumberOfTuples(); ++v)
  {
    found.insert(label_at(labels, v));
  }
  found.erase(0);
  return found;
}

/// Return the mean of a region's vertices. `nearest` becomes the vertex nearest to the mean.
Vec3 region_center(vtkPolyData* surface, vtkDataArray* labels, int label, Vec3& nearest)
{
  Vec3 sum = Vec3::Zero();
  Index count = 0;
  std::vector<Vec3> positions;
  for (vtkIdType v = 0; v < surface->GetNumberOfPoints(); ++v)
  {
    if (label_at(labels, v) == label)
    {
      positions.emplace_back(surface->GetPoint(v));
      sum += positions.back();
      ++count;
    }
  }
  const Vec3 middle = sum / static_cast<double>(std::max<Index>(1, count));
  const auto closest = std::min_element(positions.begin(), positions.end(),
    [&](const Vec3& a, const Vec3& b)
    { return (a - middle).squaredNorm() < (b - middle).squaredNorm(); });
  nearest = closest == positions.end() ? middle : *closest;
  return middle;
}
} // namespace

RegionPainting::RegionPainting(Document* document, view::Viewport* viewport)
  : QObject(viewport), document_(document), viewport_(viewport)
{
  vtkRegionBrushWidget* widget = viewport->brush_widget();
  widget->AddObserver(vtkCommand::StartInteractionEvent, this, &RegionPainting::stroke_began);
  widget->AddObserver(vtkCommand::InteractionEvent, this, &RegionPainting::stroke_continued);
  widget->AddObserver(vtkCommand::EndInteractionEvent, this, &RegionPainting::stroke_ended);
  widget->AddObserver(vtkCommand::StateChangedEvent, this, &RegionPainting::radius_changed);
}

vtkRegionBrushRepresentation* RegionPainting::brush() const
{
  return this->viewport_->brush_widget()->GetRegionBrushRepresentation();
}

vtkDataArray* RegionPainting::labels() const
{
  return this->painted_surface_ ? this->painted_surface_->GetPointData()->GetArray("RegionId")
                                : nullptr;
}

bool RegionPainting::is_painting() const
{
  return this->viewport_->brush_widget()->IsPainting();
}

void RegionPainting::cancel()
{
  this->viewport_->brush_widget()->CancelStroke();
}

void RegionPainting::set_active(bool active)
{
  if (this->active_ == active)
  {
    return;
  }
  this->cancel();
  this->active_ = active;
  this->document_changed();
  this->viewport_->brush_widget()->SetEnabled(active);
  if (!active)
  {
    this->brush()->Leave();
    this->viewport_->show_values(nullptr, true);
  }
  this->viewport_->refresh();
}

void RegionPainting::document_changed()
{
  const Handles& handles = this->document_->handles();
  if (std::none_of(handles.begin(), handles.end(),
        [this](const Handle& handle)
        { return handle.kind == HandleKind::region && handle.name == this->region_; }))
  {
    this->region_.clear();
  }
  vtkPolyData* surface = this->document_->work().surface;
  if (!surface || !this->active_)
  {
    if (!surface)
    {
      this->painted_surface_ = nullptr;
      this->brush()->SetSurface(nullptr);
    }
    return;
  }
  if (!this->painted_surface_ || !same_mesh(this->painted_surface_, surface))
  {
    this->painted_surface_ = vtkSmartPointer<vtkPolyData>::New();
    this->painted_surface_->ShallowCopy(surface);
  }
  // Copy the labels to a separate int array. In the file they may have another type.
  vtkDataArray* labels = surface->GetPointData()->GetArray("RegionId");
  vtkNew<vtkIntArray> int_labels;
  int_labels->SetName("RegionId");
  int_labels->SetNumberOfTuples(surface->GetNumberOfPoints());
  for (vtkIdType v = 0; v < surface->GetNumberOfPoints(); ++v)
  {
    int_labels->SetValue(v, label_at(labels, v));
  }
  this->painted_surface_->GetPointData()->AddArray(int_labels);
  this->brush()->SetSurface(this->painted_surface_);
  this->show_labels();
}

void RegionPainting::set_region(int handle)
{
  const Handles& handles = this->document_->handles();
  const bool region = handle >= 0 && handle < static_cast<int>(handles.size()) &&
    handles[handle].kind == HandleKind::region;
  this->region_ = region ? handles[handle].name : std::string();
  Q_EMIT this->changed();
}

double RegionPainting::radius() const
{
  const double diagonal = this->painted_surface_ ? this->painted_surface_->GetLength() : 0.0;
  return diagonal > 0.0 ? this->brush()->GetDiscRadius() / diagonal : 0.05;
}

void RegionPainting::set_radius(double fraction)
{
  if (this->painted_surface_)
  {
    this->brush()->SetRadius(fraction * this->painted_surface_->GetLength());
    this->viewport_->refresh();
  }
}

void RegionPainting::radius_changed()
{
  Q_EMIT this->changed();
}

// ---- Strokes -----------------------------------------------------------------------------------

/// Called before the brush paints the first vertices of a stroke. Set the label to paint: the label
/// of the selected region or, if no region is selected, a new label above all used labels.
void RegionPainting::stroke_began()
{
  const std::set<int> used = labels_in(this->labels());
  int label = used.empty() ? 1 : *used.rbegin() + 1;
  for (const Handle& handle : this->document_->handles())
  {
    if (handle.kind == HandleKind::region)
    {
      label = std::max(label, static_cast<int>(handle.region_id) + 1);
    }
  }
  for (const Handle& handle : this->document_->handles())
  {
    if (handle.kind == HandleKind::region && handle.name == this->region_)
    {
      label = static_cast<int>(handle.region_id);
    }
  }
  this->brush()->SetRegionId(label);
  Q_EMIT this->changed();
}

void RegionPainting::stroke_continued()
{
  this->show_labels();
}

void RegionPainting::stroke_ended()
{
  if (!this->viewport_->brush_widget()->GetCanceled())
  {
    std::string region = this->region_;
    if (this->commit_stroke(region))
    {
      Q_EMIT this->region_painted(QString::fromStdString(region));
    }
  }
  this->show_labels();
  Q_EMIT this->changed();
}

/// Update the handles from the labels: a new label gets a handle, and a handle whose label has
/// disappeared is removed. If the stroke has painted, `region` becomes the name of the painted
/// region. Return false if the changes were refused.
bool RegionPainting::commit_stroke(std::string& region)
{
  QString step = QString::fromStdString(this->viewport_->brush_widget()->GetInteractionName());
  const int label = this->brush()->GetRegionId();
  const std::set<int> previous_labels =
    labels_in(this->document_->work().surface->GetPointData()->GetArray("RegionId"));
  const std::set<int> current_labels = labels_in(this->labels());
  const Handles& handles = this->document_->handles();
  const auto has_label = [](const Handle& handle, int region_label)
  { return handle.kind == HandleKind::region && handle.region_id == region_label; };
  std::vector<Index> removed_handles;
  std::string name;
  for (std::size_t k = 0; k < handles.size(); ++k)
  {
    for (const int region_label : previous_labels)
    {
      if (has_label(handles[k], region_label) && current_labels.count(region_label) == 0)
      {
        removed_handles.push_back(static_cast<Index>(k));
      }
    }
    name = has_label(handles[k], label) ? handles[k].name : name;
  }
  vtkPolyData* live = this->document_->editable_handles();
  Status status;
  if (!removed_handles.empty())
  {
    status = edit_handles(live,
      [&](const Handles& list, EditedHandles& after)
      { return remove_handles(list, removed_handles, after); });
  }
  if (status.ok() && name.empty() && current_labels.count(label) > 0)
  {
    Handle handle;
    handle.kind = HandleKind::region;
    handle.region_id = label;
    Vec3 nearest;
    handle.head = region_center(this->painted_surface_, this->labels(), label, nearest);
    for (int attempt = 0; attempt < 2; ++attempt)
    {
      handle.tail = handle.head;
      status = edit_handles(live,
        [&](const Handles& list, EditedHandles& after)
        {
          Status added = add_handle(list, handle, after);
          name = added.ok() ? after.handles.back().name : name;
          return added;
        });
      if (status.ok())
      {
        break;
      }
      handle.head = nearest; // the mean position is already used by another handle
    }
  }
  const bool paints = current_labels.count(label) > 0 && !this->brush()->GetErase();
  if (paints)
  {
    step += " " + QString::fromStdString(name);
  }
  if (status.ok())
  {
    region = paints ? name : region;
    status = this->document_->commit_regions(this->labels(), step);
  }
  else
  {
    this->document_->revert_handles();
  }
  if (!status.ok())
  {
    this->document_changed(); // restore the labels, because the edit was refused
    Q_EMIT this->edit_refused(QString::fromStdString(status.message));
  }
  return status.ok();
}

// ---- Colors ------------------------------------------------------------------------------------

/// Give each triangle the color of the label that most of its corners have.
void RegionPainting::show_labels()
{
  vtkPolyData* drawn = this->viewport_->drawn();
  if (!this->active_ || !drawn || !this->painted_surface_)
  {
    return;
  }
  vtkDataArray* labels = this->labels();
  std::map<int, std::string> names;
  for (const int label : labels_in(labels))
  {
    names[label] = tr("a new region").toStdString();
  }
  for (const Handle& handle : this->document_->handles())
  {
    if (handle.kind == HandleKind::region)
    {
      names[static_cast<int>(handle.region_id)] = handle.name;
    }
  }
  std::vector<std::string> category_names;
  std::map<int, int> category_of_label;
  for (const auto& [label, name] : names)
  {
    category_of_label[label] = static_cast<int>(category_names.size());
    category_names.push_back(name);
  }
  std::vector<Category> categories = handle_categories(category_names);
  const std::vector<Index>& vertices = this->viewport_->drawn_points();
  std::vector<int> category_of_cell;
  const auto cells = vtk::TakeSmartPointer(drawn->GetPolys()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    cells->GetCurrentCell(size, corners);
    const auto label_of = [&](vtkIdType k)
    { return label_at(labels, vertices[static_cast<std::size_t>(corners[k])]); };
    int label = 0;
    for (vtkIdType k = 0; k < size && label == 0; ++k)
    {
      vtkIdType votes = 0;
      for (vtkIdType other = 0; other < size; ++other)
      {
        votes += label_of(other) == label_of(k);
      }
      label = 2 * votes > size ? label_of(k) : 0;
    }
    category_of_cell.push_back(label == 0 ? -1 : category_of_label[label]);
    if (category_of_cell.back() >= 0)
    {
      ++categories[static_cast<std::size_t>(category_of_cell.back())].count;
    }
  }
  const std::vector<double> category_scalars = category_values(categories);
  vtkNew<vtkDoubleArray> values;
  for (const int category : category_of_cell)
  {
    values->InsertNextValue(category < 0 ? std::numeric_limits<double>::quiet_NaN()
                                         : category_scalars[static_cast<std::size_t>(category)]);
  }
  ColorMap map = category_map(categories);
  const Rgb& surface_color = palette::surface;
  map.table->SetNanColor(surface_color[0], surface_color[1], surface_color[2], 1.0);
  const bool any = std::any_of(categories.begin(), categories.end(),
    [](const Category& category) { return category.count > 0; });
  // If there are no regions, show no legend, because it would contain only a title.
  this->viewport_->show_values(
    any ? values.Get() : nullptr, false, any ? tr("Regions") : QString(), map);
  this->viewport_->refresh();
}

} // namespace app::handles
