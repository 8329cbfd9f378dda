#include "shapes/outline.h"

#include "conversion.h"
#include "shapes/shaded_surface.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPoints.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <numeric>

namespace bindpose
{

Outline::Outline(vtkRenderer* renderer) : renderer_(renderer)
{
  this->lines_->SetPoints(vtkNew<vtkPoints>());
  this->mapper_->SetInputData(this->lines_);
  this->mapper_->ScalarVisibilityOff();
  // The lines lie exactly on the surface. The depth offset draws them in front of the surface.
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  this->mapper_->SetRelativeCoincidentTopologyLineOffsetParameters(-1.0, -1.0);
  this->actor_->SetMapper(this->mapper_);
  this->actor_->PickableOff();
  this->actor_->UseBoundsOff(); // the bounds of the surface contain the lines
  this->actor_->VisibilityOff();
  vtkProperty* property = this->actor_->GetProperty();
  property->LightingOff();
  set_color(property, palette::outline);
  renderer->AddActor(this->actor_);
  this->observer_ = renderer->AddObserver(vtkCommand::StartEvent, this, &Outline::before_drawing);
}

Outline::~Outline()
{
  this->renderer_->RemoveObserver(this->observer_);
  this->renderer_->RemoveActor(this->actor_);
}

void Outline::set_shape(const ShadedSurface* shape)
{
  this->shape_ = shape;
  this->silhouette_.reset();
  this->shape_time_ = 0;
}

void Outline::show(bool shown, double width)
{
  this->actor_->SetVisibility(shown);
  this->actor_->GetProperty()->SetLineWidth(static_cast<float>(width));
}

void Outline::before_drawing()
{
  if (!this->shape_ || !this->actor_->GetVisibility())
  {
    return;
  }
  vtkCamera* camera = this->renderer_->GetActiveCamera();
  vtkPolyData* drawn = this->shape_->polydata();
  if (this->silhouette_ && this->shape_time_ == drawn->GetMTime() &&
    this->view_time_ == camera->GetMTime())
  {
    return;
  }
  const SharedMatrix<Points> points = to_points(drawn);
  if (!this->silhouette_)
  {
    this->silhouette_ = std::make_unique<Silhouette>(points.view(), this->shape_->triangles());
  }
  Eye eye;
  eye.position = Vec3(camera->GetPosition());
  eye.direction = Vec3(camera->GetDirectionOfProjection());
  eye.parallel = camera->GetParallelProjection() != 0;
  this->silhouette_->find(points.view(), eye, this->edges_);

  const auto count = static_cast<vtkIdType>(this->edges_.size());
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(2 * count);
  float* to = coordinates->GetPointer(0);
  for (const Silhouette::Edge& edge : this->edges_)
  {
    for (const Index end : edge)
    {
      Eigen::Map<Eigen::RowVector3f>(to, 3) = points.view().row(end).cast<float>();
      to += 3;
    }
  }
  vtkNew<vtkIdTypeArray> ends;
  ends->SetNumberOfValues(2 * count);
  std::iota(ends->GetPointer(0), ends->GetPointer(0) + 2 * count, vtkIdType(0));
  vtkNew<vtkCellArray> cells;
  cells->SetData(2, ends);
  vtkNew<vtkPoints> ends_of_lines;
  ends_of_lines->SetData(coordinates);
  this->lines_->SetPoints(ends_of_lines);
  this->lines_->SetLines(cells);
  this->shape_time_ = drawn->GetMTime();
  this->view_time_ = camera->GetMTime();
}

} // namespace bindpose
