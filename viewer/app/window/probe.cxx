// Shows text about the object under the mouse. The ray through the mouse's pixel is intersected
// with each type of object. The nearest intersection determines the text. Only the text is kept
// between moves of the mouse.
#include "app/window/probe.h"

#include "app/posing/pose_ghost.h"
#include "app/posing/pose_panel.h"
#include "app/posing/posing.h"
#include "app/posing/rotation_view.h"
#include "app/tets/defect_view.h"
#include "app/tets/tet_view.h"
#include "app/view/viewport.h"
#include "app/volume/volume_view.h"
#include "app/weights/weight_view.h"

#include "conversion.h"
#include "scene/coloring.h"
#include "scene/volume.h"
#include "shapes/shaded_surface.h"
#include "tets/tet_quality.h"

#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkHandleSetWidget.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkStringArray.h"

#include <QEvent>
#include <QLabel>
#include <QMouseEvent>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace app::window
{

using namespace bindpose;

namespace
{
constexpr const char* winding_name = "WindingNumber";
// maximum distance in pixels between the mouse and the edge or dot of a defect
constexpr double pick_tolerance = 6.0;
constexpr int label_margin = 10; // distance in pixels between the label and the border

QString number(double value)
{
  return QString::number(value, 'g', 4);
}

QString format_position(const Vec3& position)
{
  return Probe::tr("x %1   y %2   z %3")
    .arg(number(position.x()), number(position.y()), number(position.z()));
}

/// Return the name of a category, or the value if the coloring has no categories.
QString format_value(const Coloring& coloring, double value)
{
  const std::vector<double> category_scalars = category_values(coloring.categories);
  for (std::size_t k = 0; k < category_scalars.size(); ++k)
  {
    if (category_scalars[k] == value)
    {
      return QString::fromStdString(coloring.categories[k].name);
    }
  }
  return std::isnan(value) ? Probe::tr("none") : QString::number(value, 'f', 3);
}

QString named_value(const Coloring& coloring, double value)
{
  const QString name = QString::fromStdString(coloring.legend_name());
  // omit the smallest angle, because the text of every tet already contains it
  return name == "Min. angle (°)" ? QString()
                                  : Probe::tr("%1: %2").arg(name, format_value(coloring, value));
}

/// Return the value that is displayed as a color: interpolated linearly between a triangle's
/// corners, or the value of the cell.
std::optional<double> shown_value(vtkPolyData* data, const Index* corners, const RayHit& hit)
{
  if (vtkDataArray* array = data->GetPointData()->GetArray(color_array_name))
  {
    double value = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      value += hit.barycentric[k] * array->GetComponent(corners[k], 0);
    }
    return value;
  }
  vtkDataArray* array = data->GetCellData()->GetArray(color_array_name);
  return array && hit.element < array->GetNumberOfTuples()
    ? std::optional(array->GetComponent(hit.element, 0))
    : std::nullopt;
}

/// Compute the part of a ray that is inside a box. The part begins at distance `from` and ends at
/// distance `to` from the origin of the ray. Return false if the ray misses the box.
bool clip_to_box(const ViewRay& ray, const double* bounds, double& from, double& to)
{
  from = 0.0;
  to = 1e300;
  for (int axis = 0; axis < 3; ++axis)
  {
    double a = (bounds[2 * axis] - ray.origin[axis]) / ray.direction[axis];
    double b = (bounds[2 * axis + 1] - ray.origin[axis]) / ray.direction[axis];
    if (std::isnan(a) || std::isnan(b))
    {
      continue; // the ray is in the plane of a face of the box
    }
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from < to;
}

Vec3 point_on_ray(const ViewRay& ray, double distance)
{
  return ray.origin + distance * ray.direction;
}

/// Call `visit` with the distance and the value at points along a ray through a volume, until
/// `visit` returns false. The number of points is twice the number of samples along the longest
/// side.
template <typename Visitor>
void sample_ray(const ViewRay& ray, vtkImageData* image, const Visitor& visit)
{
  double from = 0.0;
  double to = 0.0;
  if (!clip_to_box(ray, image->GetBounds(), from, to))
  {
    return;
  }
  const int* size = image->GetDimensions();
  const int steps = 2 * std::max({ size[0], size[1], size[2] });
  for (int k = 0; k <= steps; ++k)
  {
    const double distance = from + (to - from) * (k + 1e-6) / (steps + 2e-6);
    double value = 0.0;
    if (value_at(image, winding_name, point_on_ray(ray, distance), value) &&
      !visit(distance, value))
    {
      return;
    }
  }
}
} // namespace

Probe::Probe(const Views& views)
  : QObject(views.viewport), views_(views), label_(new QLabel(views.viewport))
{
  this->label_->setObjectName("reading");
  this->label_->setAttribute(Qt::WA_TransparentForMouseEvents);
  this->label_->hide();
  // Filter Qt's events, because VTK's events are not passed on while a widget is dragged.
  views.viewport->installEventFilter(this);
}

// ---- The mouse ---------------------------------------------------------------------------------

bool Probe::eventFilter(QObject* watched, QEvent* event)
{
  switch (event->type())
  {
    case QEvent::MouseMove:
      this->mouse_moved(*static_cast<QMouseEvent*>(event));
      break;
    case QEvent::MouseButtonPress:
    case QEvent::Leave:
    case QEvent::Resize:
      this->clear();
      break;
    default:
      break;
  }
  return QObject::eventFilter(watched, event);
}

void Probe::mouse_moved(const QMouseEvent& event)
{
  if (event.buttons() != Qt::NoButton || this->views_.viewport->handle_widget()->IsDragging())
  {
    this->clear();
    return;
  }
  const auto start = std::chrono::steady_clock::now();
  const QPoint pixel = this->views_.viewport->to_vtk(event.pos());
  this->show_lines(this->read_at(pixel.x(), pixel.y()));
  this->move_label_away(event.pos());
  this->milliseconds_ =
    std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void Probe::clear()
{
  this->show_lines({});
}

QString Probe::reading() const
{
  return this->lines_.join(QStringLiteral("  ·  "));
}

void Probe::show_lines(const QStringList& lines)
{
  if (lines != this->lines_)
  {
    this->lines_ = lines;
    this->label_->setText(lines.join('\n'));
    this->label_->adjustSize();
  }
  this->label_->setVisible(!lines.isEmpty());
}

/// Move the label to the upper right corner, or to the lower right corner if the mouse or another
/// widget is there.
void Probe::move_label_away(const QPoint& mouse)
{
  const view::Viewport* viewport = this->views_.viewport;
  const QRect allowed_area =
    viewport->rect().adjusted(label_margin, label_margin, -label_margin, -label_margin);
  QRect label_rectangle(QPoint(), this->label_->size());
  const auto is_free = [&]
  {
    const QRect label_area =
      label_rectangle.adjusted(-2 * label_margin, -label_margin, label_margin, 2 * label_margin);
    const auto others = viewport->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly);
    return !label_area.contains(mouse) &&
      std::none_of(others.begin(), others.end(),
        [&](const QWidget* other)
        {
          return other != this->label_ && other->isVisible() &&
            other->geometry().intersects(label_rectangle);
        });
  };
  label_rectangle.moveTopRight(allowed_area.topRight());
  if (!is_free())
  {
    label_rectangle.moveBottomRight(allowed_area.bottomRight());
  }
  this->label_->move(label_rectangle.topLeft());
}

// ---- Text about the hit ------------------------------------------------------------------------

QStringList Probe::read_at(int x, int y)
{
  view::Viewport* viewport = this->views_.viewport;
  const int width = viewport->picture_size(1).width();
  // If the view is split, the right half shows the shape of the compared method, with the same
  // camera.
  const bool other = viewport->is_split() && 2 * x >= width;
  ViewRay ray;
  viewport->ray_at(other ? x - width / 2 : x, y, ray.origin, ray.direction);
  if (!ray.origin.allFinite() || !ray.direction.allFinite())
  {
    return {};
  }
  const int appearance = viewport->surface_appearance();
  const OptionalHit surface = this->surface(ray, other);
  const QString defect = other ? QString() : this->defect(ray);
  OptionalHit first = appearance == view::Viewport::solid ? surface : OptionalHit();
  for (const OptionalHit& each : other
      ? std::vector<OptionalHit>()
      : std::vector<OptionalHit>{ this->tets(ray), this->weight_slice(ray),
          this->winding_slice(ray), this->isosurface(ray) })
  {
    if (each && (!first || each->distance < first->distance))
    {
      first = each;
    }
  }
  first = first || other ? first : this->cloud(ray);
  first = first ? first : appearance == view::Viewport::hidden ? OptionalHit() : surface;
  QStringList lines = first ? first->lines : QStringList();
  if (!defect.isEmpty())
  {
    lines.prepend(defect);
  }
  lines.removeAll(QString());
  return lines;
}

Probe::OptionalHit Probe::surface(const ViewRay& ray, bool other) const
{
  const ShadedSurface* shaded =
    other ? this->views_.posing->ghost()->shaded() : this->views_.viewport->shaded();
  vtkPolyData* shape = this->views_.surface();
  RayHit hit;
  if (!shaded || !shape ||
    !first_triangle(ray, to_points(shaded->polydata()).view(), shaded->triangles(), hit))
  {
    return {};
  }
  Hit found;
  found.distance = hit.distance;
  // Show coordinates of the shape itself. The drawn points can differ from the points of the shape,
  // because the view adds offsets to the layers of a planar shape.
  const Vec3 drawn_position = point_on_ray(ray, hit.distance);
  Vec3 position = Vec3::Zero();
  Index nearest = -1;
  double minimum_distance = 1e300;
  for (int k = 0; k < 3; ++k)
  {
    const Index drawn = shaded->triangles()(hit.element, k);
    const Index vertex = shaded->input_points()[static_cast<std::size_t>(drawn)];
    position += hit.barycentric[k] * Vec3(shape->GetPoint(vertex));
    const double distance = (Vec3(shaded->polydata()->GetPoint(drawn)) - drawn_position).norm();
    nearest = distance < minimum_distance ? vertex : nearest;
    minimum_distance = std::min(minimum_distance, distance);
  }
  if (other)
  {
    position = drawn_position;
    found.lines << posing::method_name(
      this->views_.posing->compared_deformation()->options().method);
  }
  found.lines << tr("Triangle %1, vertex %2").arg(hit.element).arg(nearest)
              << format_position(position);
  found.lines << this->weights(shape, hit) << this->difference(hit);
  found.lines << (other ? QString() : this->views_.rotations->reading(nearest));
  return found;
}

/// Return the displayed weight, and the handle with the largest weight.
QStringList Probe::weights(vtkPolyData* shape, const RayHit& hit) const
{
  const ShadedSurface* shaded = this->views_.viewport->shaded();
  vtkDataArray* array = shape->GetPointData()->GetArray("Weights");
  if (!array || array->GetNumberOfComponents() == 0 || !shaded ||
    hit.element >= shaded->triangles().rows())
  {
    return {};
  }
  QStringList lines;
  const Index* corners = shaded->triangles().data() + 3 * hit.element;
  Index vertices[3];
  for (int k = 0; k < 3; ++k)
  {
    vertices[k] = shaded->input_points()[static_cast<std::size_t>(corners[k])];
  }
  const auto weight = [&](int column)
  {
    double value = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      value += hit.barycentric[k] * array->GetComponent(vertices[k], column);
    }
    return value;
  };
  const auto name = [array](int column)
  {
    const char* component_name = array->GetComponentName(column);
    return component_name && *component_name ? QString::fromUtf8(component_name)
                                             : QString::number(column);
  };
  const weights::WeightView* view = this->views_.weights;
  const int column = this->views_.viewport->shown_column();
  if (view->is_shown() && !view->is_sliced())
  {
    if (const auto value = shown_value(shaded->polydata(), corners, hit))
    {
      lines << named_value(view->coloring(), *value);
    }
  }
  else if (column >= 0 && column < array->GetNumberOfComponents())
  {
    lines << tr("Weight of %1: %2").arg(name(column)).arg(weight(column), 0, 'f', 3);
  }
  int largest = 0;
  for (int k = 1; k < array->GetNumberOfComponents(); ++k)
  {
    largest = weight(k) > weight(largest) ? k : largest;
  }
  return lines << tr("Strongest handle: %1, %2").arg(name(largest)).arg(weight(largest), 0, 'f', 3);
}

/// Return the distance between the shape and the shape of the compared method.
QString Probe::difference(const RayHit& hit) const
{
  const posing::PoseController* posing = this->views_.posing;
  const ShadedSurface* shaded = this->views_.viewport->shaded();
  const Points& a = posing->points();
  const Points& b = posing->compared_deformation()->points();
  if (posing->ghost()->display_mode() == posing::PoseGhost::hidden || !shaded ||
    a.rows() != b.rows() || a.rows() == 0 || posing->shows_rest() ||
    posing->compared_deformation()->is_binding())
  {
    return {};
  }
  Vec3 displacement = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
  {
    const Index vertex =
      shaded->input_points()[static_cast<std::size_t>(shaded->triangles()(hit.element, k))];
    displacement += hit.barycentric[k] * (a.row(vertex) - b.row(vertex)).transpose();
  }
  const double diagonal = posing->rest_diagonal();
  return tr("Distance %1 units, %2 % of the diagonal")
    .arg(displacement.norm(), 0, 'g', 3)
    .arg(100.0 * displacement.norm() / diagonal, 0, 'g', 3);
}

Probe::OptionalHit Probe::tets(const ViewRay& ray) const
{
  const tets::TetView* view = this->views_.tets;
  RayHit hit;
  if (!view->is_shown())
  {
    return {};
  }
  const PointsView points = view->input().points.view();
  const TetsView tets = view->input().tets.view();
  if (!first_tet(ray, points, tets, view->kept(), view->shrink(), hit))
  {
    return {};
  }
  const auto corner = [&](int k) { return Vec3(points.row(tets(hit.element, k))); };
  Hit found;
  found.distance = hit.distance;
  found.lines << tr("Tet %1: smallest angle %2°")
                   .arg(hit.element)
                   .arg(min_dihedral_angle(corner(0), corner(1), corner(2), corner(3)), 0, 'f', 1);
  if (view->values())
  {
    found.lines << named_value(view->coloring(), view->values()->GetValue(hit.element));
  }
  found.lines << format_position(point_on_ray(ray, hit.distance));
  return found;
}

Probe::OptionalHit Probe::weight_slice(const ViewRay& ray) const
{
  const weights::WeightView* view = this->views_.weights;
  SurfaceInput slice;
  RayHit hit;
  if (!view->is_sliced() || view->slice()->GetNumberOfCells() == 0 ||
    !to_surface(view->slice(), slice).ok() ||
    !first_triangle(ray, slice.points.view(), slice.triangles.view(), hit))
  {
    return {};
  }
  const auto value =
    shown_value(view->slice(), slice.triangles.view().data() + 3 * hit.element, hit);
  Hit found;
  found.distance = hit.distance;
  found.lines << tr("Slice") << (value ? named_value(view->coloring(), *value) : QString())
              << format_position(point_on_ray(ray, hit.distance));
  return found;
}

Probe::OptionalHit Probe::winding_slice(const ViewRay& ray) const
{
  const volume::VolumeView* view = this->views_.volume;
  const double slope = ray.direction.dot(view->slice_normal());
  if (!view->volume() || !view->is_slice_shown() || std::abs(slope) < 1e-9)
  {
    return {}; // the plane is hidden or seen edge-on
  }
  Hit found;
  found.distance = (view->position() - ray.origin.dot(view->slice_normal())) / slope;
  const Vec3 position = point_on_ray(ray, found.distance);
  double value = 0.0;
  if (found.distance < 0.0 || !value_at(view->volume(), winding_name, position, value))
  {
    return {};
  }
  found.lines << tr("Slice: winding number w = %1").arg(value, 0, 'f', 3)
              << format_position(position);
  return found;
}

/// Find the point of the isosurface under the mouse: the first point of the ray at which the
/// winding number crosses the level.
Probe::OptionalHit Probe::isosurface(const ViewRay& ray) const
{
  const volume::VolumeView* view = this->views_.volume;
  if (!view->volume() || view->isosurface()->GetNumberOfCells() == 0)
  {
    return {};
  }
  OptionalHit found;
  const double level = view->level();
  std::optional<std::pair<double, double>> previous;
  sample_ray(ray, view->volume(),
    [&](double distance, double value)
    {
      if (previous && (previous->second < level) != (value < level))
      {
        const double fraction = (level - previous->second) / (value - previous->second);
        found = Hit();
        found->distance = previous->first + fraction * (distance - previous->first);
        found->lines << tr("Isosurface: winding number w = %1").arg(level, 0, 'f', 3)
                     << format_position(point_on_ray(ray, found->distance));
        return false;
      }
      previous = { distance, value };
      return true;
    });
  return found;
}

Probe::OptionalHit Probe::cloud(const ViewRay& ray) const
{
  const volume::VolumeView* view = this->views_.volume;
  if (!view->volume() || !view->is_cloud_shown())
  {
    return {};
  }
  double lowest = 1e300;
  double highest = -1e300;
  sample_ray(ray, view->volume(),
    [&](double, double value)
    {
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
      return true;
    });
  if (lowest > highest)
  {
    return {};
  }
  Hit found;
  found.lines << tr("Cloud: winding number from %1 to %2 along the line of sight")
                   .arg(lowest, 0, 'f', 3)
                   .arg(highest, 0, 'f', 3);
  return found;
}

/// Return the text about the defect under the mouse. Dots and edges within a few pixels have
/// priority over faces. Among several candidates, the candidate nearest to the eye is used.
QString Probe::defect(const ViewRay& ray) const
{
  vtkPolyData* defects = this->views_.defects->defects();
  if (!this->views_.defects->is_shown() || defects->GetNumberOfCells() == 0)
  {
    return {};
  }
  vtkRenderer* renderer = this->views_.viewport->renderer();
  vtkCamera* camera = renderer->GetActiveCamera();
  const double height = std::max(renderer->GetSize()[1], 1);
  const bool parallel = camera->GetParallelProjection() != 0;
  const double slope = 2.0 * pick_tolerance * this->views_.viewport->devicePixelRatioF() *
    (parallel ? camera->GetParallelScale()
              : std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()))) /
    height;
  const double eye = (ray.origin - Vec3(camera->GetPosition())).norm();
  const Points defect_points = to_ray_coordinates(ray, to_points(defects).view());
  const auto pick_radius = [&](double depth) { return parallel ? slope : slope * (eye + depth); };
  Index best = -1;
  // Kind of the best candidate so far: 1 dot or edge, 3 face, 4 no candidate yet. A smaller kind
  // has priority.
  int best_kind = 4;
  double best_depth = 1e300;
  Index cell = 0;
  vtkNew<vtkIdList> ids;
  for (vtkCellArray* cells : { defects->GetVerts(), defects->GetLines(), defects->GetPolys() })
  {
    for (vtkIdType k = 0; k < cells->GetNumberOfCells(); ++k, ++cell)
    {
      cells->GetCellAtId(k, ids);
      const auto corners = static_cast<int>(ids->GetNumberOfIds());
      const Vec3 a = defect_points.row(ids->GetId(0));
      const Vec3 b = defect_points.row(ids->GetId(corners > 1 ? 1 : 0));
      const Vec3 c = defect_points.row(ids->GetId(corners > 2 ? 2 : 0));
      bool is_hit = false;
      double depth = a.z();
      if (corners < 3)
      {
        const Vec3 edge = b - a;
        const double length = edge.head<2>().squaredNorm();
        const double fraction =
          length > 0.0 ? std::clamp(-a.head<2>().dot(edge.head<2>()) / length, 0.0, 1.0) : 0.0;
        const Vec3 nearest_point = a + fraction * edge;
        depth = nearest_point.z();
        is_hit = depth > 0.0 && nearest_point.head<2>().norm() < pick_radius(depth);
      }
      else
      {
        Vec3 areas;
        is_hit = surrounds_ray(a.data(), b.data(), c.data(), areas);
        depth = std::min({ a.z(), b.z(), c.z() });
      }
      const int kind = corners < 3 ? 1 : 3;
      if (is_hit && std::make_pair(kind, depth) < std::make_pair(best_kind, best_depth))
      {
        best = cell;
        best_kind = kind;
        best_depth = depth;
      }
    }
  }
  auto* names =
    vtkStringArray::SafeDownCast(defects->GetCellData()->GetAbstractArray("DefectName"));
  vtkDataArray* original = defects->GetPointData()->GetArray("OriginalPointIds");
  if (best < 0 || !names || !original)
  {
    return {};
  }
  defects->GetCellPoints(best, ids);
  QStringList vertices;
  for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
  {
    vertices << QString::number(static_cast<qlonglong>(original->GetComponent(ids->GetId(k), 0)));
  }
  const QString name = QString::fromStdString(names->GetValue(best)).replace('_', ' ');
  return ids->GetNumberOfIds() == 1 ? tr("Defect: %1, vertex %2").arg(name, vertices.first())
                                    : tr("Defect: %1, vertices %2").arg(name, vertices.join(", "));
}

} // namespace app::window
