#include "rest_surface.h"

#include "vtkCellArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <initializer_list>

namespace bindpose
{

RestSurface::RestSurface() = default;
RestSurface::~RestSurface() = default;

void RestSurface::set(vtkPolyData* data)
{
  this->data_ = data;
  this->probe_inputs_.clear();
  this->probe_.reset();
}

vtkPolyData* RestSurface::get() const
{
  return this->data_;
}

const SurfaceProbe* RestSurface::probe()
{
  if (!this->data_)
  {
    return nullptr;
  }
  std::vector<std::pair<const void*, vtkMTimeType>> inputs;
  for (vtkObject* object : std::initializer_list<vtkObject*>{
         this->data_->GetPoints() ? this->data_->GetPoints()->GetData() : nullptr,
         this->data_->GetPolys(), this->data_->GetStrips() })
  {
    inputs.emplace_back(object, object ? object->GetMTime() : 0);
  }
  if (inputs != this->probe_inputs_)
  {
    this->probe_inputs_ = inputs;
    ++this->build_count_;
    this->probe_.reset();
    if (this->data_->GetNumberOfCells() > 0 && to_surface(this->data_, this->input_).ok())
    {
      this->probe_ =
        std::make_unique<SurfaceProbe>(this->input_.points.view(), this->input_.triangles.view());
    }
  }
  return this->probe_.get();
}

Vec3 RestSurface::nearest_vertex(Index triangle, const Vec3& position) const
{
  const auto points = this->input_.points.view();
  const auto triangles = this->input_.triangles.view();
  Vec3 best = position;
  double nearest = -1.0;
  for (int k = 0; k < 3; ++k)
  {
    const Vec3 vertex = points.row(triangles(triangle, k));
    const double distance = (vertex - position).norm();
    if (nearest < 0.0 || distance < nearest)
    {
      best = vertex;
      nearest = distance;
    }
  }
  return best;
}

Vec3 RestSurface::center()
{
  return this->probe() ? bounding_box(this->input_.points.view()).center() : Vec3(Vec3::Zero());
}

} // namespace bindpose
