// Maps positions from world to display: multiply by the camera's matrix, divide by w, and map
// normalized view coordinates to the viewport's pixels with an affine map. The affine map is
// derived from the renderer's own mapping of two corners of the viewport, so that both mappings
// agree exactly.
#include "screen_view.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkRenderer.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector4d;

namespace bindpose
{

ScreenView::ScreenView(vtkRenderer* renderer)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const vtkMatrix4x4* matrix =
    camera->GetCompositeProjectionTransformMatrix(renderer->GetTiledAspectRatio(), 0, 1);
  this->to_clip_ =
    Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(matrix->GetData());
  this->from_clip_ = this->to_clip_.inverse();
  Vector2d* const corners[2] = { &this->lower_, &this->upper_ };
  for (int k = 0; k < 2; ++k)
  {
    renderer->SetViewPoint(2 * k - 1, 2 * k - 1, 0.0);
    renderer->ViewToDisplay();
    *corners[k] = Vector2d(renderer->GetDisplayPoint());
  }
  this->eye_ = Vector3d(camera->GetPosition());
  this->forward_ = Vector3d(camera->GetDirectionOfProjection());
  this->right_ = this->forward_.cross(Vector3d(camera->GetViewUp()));
  this->right_ = this->right_.norm() > 0.0 ? Vector3d(this->right_.normalized())
                                           : this->forward_.unitOrthogonal();
  this->up_ = this->right_.cross(this->forward_);
  this->parallel_ = camera->GetParallelProjection() != 0;
  const double height = std::max(renderer->GetSize()[1], 1);
  const double half = this->parallel_
    ? camera->GetParallelScale()
    : std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));
  this->pixel_slope_ = 2.0 * half / height;
}

Vector3d ScreenView::to_display(const Vector3d& world) const
{
  const Vector4d clip = this->to_clip_ * world.homogeneous();
  const Vector3d view = clip.head<3>() / (clip[3] != 0.0 ? clip[3] : 1e-300);
  Vector3d display;
  display.head<2>() = this->lower_ +
    (0.5 * (view.head<2>().array() + 1.0) * (this->upper_ - this->lower_).array()).matrix();
  display[2] = view[2];
  return display;
}

Ray ScreenView::ray(const Vector2d& display) const
{
  const Vector2d view =
    2.0 * ((display - this->lower_).array() / (this->upper_ - this->lower_).array()).matrix() -
    Vector2d::Ones();
  const Vector3d near_point =
    (this->from_clip_ * Vector4d(view[0], view[1], 0.0, 1.0)).hnormalized();
  Ray ray;
  ray.origin = near_point;
  ray.direction =
    this->parallel_ ? this->forward_ : Vector3d((near_point - this->eye_).normalized());
  return ray;
}

double ScreenView::pixel_length_at(const Vector3d& position) const
{
  return this->parallel_
    ? this->pixel_slope_
    : this->pixel_slope_ * std::max(this->forward_.dot(position - this->eye_), 0.0);
}

Vector3d ScreenView::direction_to(const Vector3d& position) const
{
  const Vector3d displacement = position - this->eye_;
  return this->parallel_ || displacement.norm() == 0.0 ? this->forward_
                                                       : Vector3d(displacement.normalized());
}

bool intersect_plane(
  const Ray& ray, const Vector3d& position, const Vector3d& normal, Vector3d& hit)
{
  const double slope = ray.direction.dot(normal);
  const double t = normal.dot(position - ray.origin) / slope;
  if (slope == 0.0 || !std::isfinite(t) || t < 0.0)
  {
    return false;
  }
  hit = ray.origin + t * ray.direction;
  return true;
}

} // namespace bindpose
