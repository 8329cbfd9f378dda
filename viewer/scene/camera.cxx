// Computes cameras that fit a shape into the picture. A camera is at `c` with the axes `r` (right),
// `u` (up) and `f` (forward); `tx` is the tangent of half its horizontal view angle. It sees a
// point `p` if
// `|(p - c)·r| <= tx (p - c)·f`
// and likewise for `u`. For the right and left borders of the picture this means
// `c·r - tx c·f >= A` with `A = max(p·r - tx p·f)` over all points, and
// `-c·r - tx c·f >= B` with `B = max(-p·r - tx p·f)`.
// The sum of both inequalities gives an upper bound of `c·f`: `-(A + B) / (2 tx)`. Their difference
// gives the `c·r` that centers the shape.
#include "scene/camera.h"

#include "base/constants.h"

#include "vtkCamera.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace bindpose
{
namespace
{
constexpr double default_azimuth = 28.0;
constexpr double default_elevation = 16.0;
constexpr double view_angle = 30.0;
} // namespace

Frame choose_frame(const Box& box, const std::string& up)
{
  Frame frame;
  const Vec3 size = box.size();
  const double thin = 1e-3 * box.diagonal();
  const bool is_axis_name = up == "x" || up == "y" || up == "z";
  frame.up = is_axis_name ? up[0] - 'x' : 1;
  int thinnest = 0;
  size.minCoeff(&thinnest);
  frame.flat = size[thinnest] <= thin;
  if (frame.flat && thinnest == frame.up)
  {
    if (is_axis_name)
    {
      // A shape that is flat in the direction `up`, such as a floor, is viewed obliquely from
      // above.
      frame.flat = false;
    }
    else
    {
      frame.up = 2;
    }
  }
  // The two horizontal axes: x and z if y is up; x and y if z is up; y and z if x is up.
  const int horizontal_axes[2] = { frame.up == 0 ? 1 : 0, frame.up == 2 ? 1 : 2 };
  frame.depth =
    size[horizontal_axes[0]] >= size[horizontal_axes[1]] ? horizontal_axes[1] : horizontal_axes[0];
  return frame;
}

Vec3 view_direction(const Frame& frame, const View& view)
{
  const Vec3 up = Vec3::Unit(frame.up);
  // View from the positive end of the depth axis. Exception: if z is up and y is the depth axis,
  // view from -y, so that x points to the right.
  const double side = frame.up == 2 && frame.depth == 1 ? -1.0 : 1.0;
  const Vec3 front = side * Vec3::Unit(frame.depth);
  const double azimuth = view.azimuth + (frame.flat ? 0.0 : default_azimuth);
  const double elevation =
    std::clamp(view.elevation + (frame.flat ? 0.0 : default_elevation), -89.0, 89.0);
  const Vec3 right = up.cross(front);
  const double a = azimuth * pi / 180.0;
  const double e = elevation * pi / 180.0;
  return std::cos(e) * (std::cos(a) * front + std::sin(a) * right) + std::sin(e) * up;
}

namespace
{
/// Axes of the camera, as unit vectors.
struct Axes
{
  Vec3 forward, right, up;
};

/// Fit the camera for the given axes: move it to the position where all points are visible and as
/// large as possible.
void fit_along(vtkCamera* camera, PointsView points, const Axes& axes, double angle, double aspect,
  double margin)
{
  const auto& [forward, right, up] = axes;
  const Box box = bounding_box(points);
  const Vec3 center = box.center();
  const double inner_fraction = 1.0 - 2.0 * margin;
  const double ty = std::tan(0.5 * angle * pi / 180.0);
  const double tx = ty * aspect;
  // The terms A and B of the comment at the top of this file, for the right, left, upper and lower
  // borders.
  double high[4] = { -1e300, -1e300, -1e300, -1e300 };
  double near_point = 1e300;
  double far_point = -1e300;
  for (Index i = 0; i < points.rows(); ++i)
  {
    const Vec3 p = points.row(i).transpose() - center;
    const double x = p.dot(right);
    const double y = p.dot(up);
    const double z = p.dot(forward);
    high[0] = std::max(high[0], x - inner_fraction * tx * z);
    high[1] = std::max(high[1], -x - inner_fraction * tx * z);
    high[2] = std::max(high[2], y - inner_fraction * ty * z);
    high[3] = std::max(high[3], -y - inner_fraction * ty * z);
    near_point = std::min(near_point, z);
    far_point = std::max(far_point, z);
  }
  // Keep a minimum distance from the points, because a single point or a line along the view
  // direction has no width.
  const double smallest = std::max(0.5 * box.diagonal(), 1e-6);
  double depth = std::min(-(high[0] + high[1]) / (2.0 * inner_fraction * tx),
    -(high[2] + high[3]) / (2.0 * inner_fraction * ty));
  depth = std::min(depth, near_point - 0.1 * smallest);
  const double middle = 0.5 * (near_point + far_point);
  const Vec3 position =
    center + 0.5 * (high[0] - high[1]) * right + 0.5 * (high[2] - high[3]) * up + depth * forward;
  const Vec3 focus = position + (middle - depth) * forward;

  camera->SetPosition(position.data());
  camera->SetFocalPoint(focus.data());
  camera->SetViewUp(up.data());
  const double slack = 0.1 * std::max(far_point - near_point, smallest);
  const double far_plane = far_point - depth + slack;
  camera->SetClippingRange(std::max(near_point - depth - slack, 1e-3 * far_plane), far_plane);
}

/// Report whether all points are within the picture.
bool sees_all(vtkCamera* camera, PointsView points, const Axes& axes, double aspect)
{
  const Vec3 eye(camera->GetPosition());
  const bool parallel = camera->GetParallelProjection() != 0;
  const double ty = std::tan(0.5 * camera->GetViewAngle() * pi / 180.0);
  for (Index i = 0; i < points.rows(); ++i)
  {
    const Vec3 p = points.row(i).transpose() - eye;
    const double half = parallel ? camera->GetParallelScale() : ty * p.dot(axes.forward);
    if (std::abs(p.dot(axes.up)) > half || std::abs(p.dot(axes.right)) > half * aspect)
    {
      return false;
    }
  }
  return true;
}

/// A camera looks at the center of the points' bounding box. Return the smallest distance from this
/// center at which the camera sees all points. For a parallel view, return the smallest parallel
/// scale.
double minimum_size(vtkCamera* camera, PointsView points, const Axes& axes, double aspect)
{
  const Vec3 center = bounding_box(points).center();
  const bool parallel = camera->GetParallelProjection() != 0;
  const double ty = std::tan(0.5 * camera->GetViewAngle() * pi / 180.0);
  double size = 0.0;
  for (Index i = 0; i < points.rows(); ++i)
  {
    const Vec3 p = points.row(i).transpose() - center;
    const double half = std::max(std::abs(p.dot(axes.up)), std::abs(p.dot(axes.right)) / aspect);
    size = std::max(size, parallel ? half : half / ty - p.dot(axes.forward));
  }
  return size;
}
} // namespace

void fit_camera(vtkCamera* camera, PointsView points, const Frame& frame, const View& view,
  double aspect, double margin)
{
  Axes axes;
  axes.forward = -view_direction(frame, view);
  axes.right = axes.forward.cross(Vec3::Unit(frame.up)).normalized();
  axes.up = axes.right.cross(axes.forward);
  camera->ParallelProjectionOff();
  fit_along(camera, points, axes, view_angle, aspect, margin);
  // Zoom by changing the view angle. The perspective is preserved, and the camera never enters the
  // shape.
  const double ty = std::tan(0.5 * view_angle * pi / 180.0);
  camera->SetViewAngle(2.0 * std::atan(ty / view.zoom) * 180.0 / pi);
}

void keep_in_view(vtkCamera* camera, PointsView points, double aspect_before, double aspect)
{
  if (points.rows() == 0 || !(aspect_before > 0.0) || !(aspect > 0.0) || aspect == aspect_before)
  {
    return;
  }
  Axes axes;
  axes.forward = Vec3(camera->GetDirectionOfProjection());
  axes.right = axes.forward.cross(Vec3(camera->GetViewUp())).normalized();
  axes.up = axes.right.cross(axes.forward);
  const bool was_visible = sees_all(camera, points, axes, aspect_before);
  const double before = minimum_size(camera, points, axes, aspect_before);
  const double after = minimum_size(camera, points, axes, aspect);
  if (before > 0.0 && after > 0.0)
  {
    const Vec3 focus(camera->GetFocalPoint());
    const Vec3 position = focus + after / before * (Vec3(camera->GetPosition()) - focus);
    camera->SetPosition(position.data());
    camera->SetParallelScale(after / before * camera->GetParallelScale());
  }
  if (was_visible && !sees_all(camera, points, axes, aspect))
  {
    constexpr double margin = 0.04;
    fit_along(camera, points, axes, camera->GetViewAngle(), aspect, margin);
    camera->SetParallelScale(
      camera->GetDistance() * std::tan(0.5 * camera->GetViewAngle() * pi / 180.0));
  }
}

bool find_plane(PointsView points, Vec3& normal)
{
  const Box box = bounding_box(points);
  const double diagonal = box.diagonal();
  if (points.rows() < 3 || !(diagonal > 0.0) || !points.allFinite())
  {
    return false;
  }
  // Use the mean of the points, which is in their plane; the center of the bounding box may not be.
  const Eigen::RowVector3d middle = points.colwise().mean();
  const Points centered_points = points.rowwise() - middle;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(centered_points.transpose() *
    centered_points / (diagonal * diagonal * static_cast<double>(points.rows())));
  constexpr double flatness_tolerance = 1e-6;
  normal = axes.eigenvectors().col(0);
  // Orient the normal toward the default view.
  const Vec3 axis_order(normal.z(), normal.x(), -normal.y());
  for (const double component : { axis_order[0], axis_order[1], axis_order[2] })
  {
    if (std::abs(component) > flatness_tolerance)
    {
      normal *= component < 0.0 ? -1.0 : 1.0;
      break;
    }
  }
  for (int k = 0; k < 3; ++k) // make normals along an axis exact
  {
    normal[k] = std::abs(normal[k]) < 1e-12 ? 0.0 : normal[k];
  }
  normal.normalize();
  return (centered_points * normal).array().abs().maxCoeff() <= flatness_tolerance * diagonal &&
    std::sqrt(std::max(0.0, axes.eigenvalues()[1])) > flatness_tolerance;
}

void fit_parallel_camera(
  vtkCamera* camera, PointsView points, const Vec3& normal, double aspect, double margin)
{
  const Vec3 vertical = std::abs(normal.y()) > 0.999 ? Vec3::UnitZ() : Vec3::UnitY();
  const Vec3 up = (vertical - vertical.dot(normal) * normal).normalized();
  const Vec3 right = up.cross(normal);
  Box box; // bounding box along `right`, `up` and `normal`
  for (Index i = 0; i < points.rows(); ++i)
  {
    const Vec3 p = points.row(i);
    box.add(Vec3(p.dot(right), p.dot(up), p.dot(normal)));
  }
  const Vec3 size = box.size();
  const double inner_fraction = 1.0 - 2.0 * margin;
  const double smallest = std::max(0.5 * box.diagonal(), 1e-6);
  const Vec3 center = box.center();
  const Vec3 focus = center.x() * right + center.y() * up + center.z() * normal;
  // Use the camera distance of a perspective view, so that switching to perspective shows the same
  // part of the plane.
  const double scale = std::max({ 0.5 * size.y() / inner_fraction,
    0.5 * size.x() / (inner_fraction * aspect), 1e-3 * smallest });
  const double distance = scale / std::tan(0.5 * view_angle * pi / 180.0);
  const Vec3 position = focus + distance * normal;
  camera->ParallelProjectionOn();
  camera->SetParallelScale(scale);
  camera->SetViewAngle(view_angle);
  camera->SetPosition(position.data());
  camera->SetFocalPoint(focus.data());
  camera->SetViewUp(up.data());
  camera->SetClippingRange(1e-2 * distance, 2.0 * distance + size.z());
}

} // namespace bindpose
