// vtkPolyDataNormals decides where to part vertices; an id array that it carries along tells which
// input point each display point is. Normals are then sums of triangle normals weighted by area:
// each point gathers those of its triangles, in their order, so that all cores may work at once and
// the bits are those of one.
#include "scene/shaded_surface.h"

#include "base/parallel.h"
#include "scene/colours.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkTriangleFilter.h"

#include <cmath>

namespace bindpose
{

ShadedSurface::ShadedSurface(vtkPolyData* surface, double feature_angle)
{
  constexpr const char* id_name = "bindpose.InputPoint";
  vtkNew<vtkPolyData> input;
  input->ShallowCopy(surface);
  input->GetPointData()->SetNormals(nullptr); // ours follow the shape; a file's do not
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName(id_name);
  ids->SetNumberOfValues(input->GetNumberOfPoints());
  for (vtkIdType v = 0; v < input->GetNumberOfPoints(); ++v)
  {
    ids->SetValue(v, v);
  }
  input->GetPointData()->AddArray(ids);

  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(input);
  triangles->PassVertsOff();
  triangles->PassLinesOff();
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(triangles->GetOutputPort());
  normals->SplittingOn();
  normals->SetFeatureAngle(feature_angle);
  normals->ConsistencyOff();
  normals->AutoOrientNormalsOff();
  normals->NonManifoldTraversalOff();
  normals->ComputePointNormalsOn();
  normals->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  normals->Update();

  this->display_ = vtkSmartPointer<vtkPolyData>::New();
  this->display_->ShallowCopy(normals->GetOutput());
  const vtkIdType count = this->display_->GetNumberOfPoints();
  this->input_points_.resize(static_cast<std::size_t>(count));
  if (auto* carried =
        vtkIdTypeArray::SafeDownCast(this->display_->GetPointData()->GetArray(id_name)))
  {
    for (vtkIdType v = 0; v < count; ++v)
    {
      this->input_points_[v] = carried->GetValue(v);
    }
  }
  this->display_->GetPointData()->RemoveArray(id_name);
  this->triangles_.resize(this->display_->GetNumberOfPolys(), 3);
  vtkNew<vtkIdList> corners;
  for (Index t = 0; t < this->triangles_.rows(); ++t)
  {
    this->display_->GetPolys()->GetCellAtId(t, corners);
    for (int k = 0; k < 3; ++k)
    {
      this->triangles_(t, k) = corners->GetId(k);
    }
  }
  this->find_triangles_of_points();
  // Own points and normals: they are about to be written to.
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  for (vtkIdType v = 0; v < count; ++v)
  {
    points->SetPoint(v, this->display_->GetPoint(v));
  }
  this->display_->SetPoints(points);
  vtkNew<vtkFloatArray> own_normals;
  own_normals->SetName("Normals");
  own_normals->SetNumberOfComponents(3);
  own_normals->SetNumberOfTuples(count);
  this->display_->GetPointData()->SetNormals(own_normals);
  this->update_normals();
}

void ShadedSurface::move(PointsView points)
{
  auto* places = vtkDoubleArray::SafeDownCast(this->display_->GetPoints()->GetData());
  double* to = places->GetPointer(0);
  ExecutionContext context;
  parallel_for(context, static_cast<Index>(this->input_points_.size()), 4096,
    [&](Index begin, Index end)
    {
      for (Index v = begin; v < end; ++v)
      {
        const double* from = points.data() + 3 * this->input_points_[v];
        to[3 * v] = from[0];
        to[3 * v + 1] = from[1];
        to[3 * v + 2] = from[2];
      }
    });
  this->update_normals();
  places->Modified();
  this->display_->GetPoints()->Modified();
  this->display_->Modified();
}

void ShadedSurface::find_triangles_of_points()
{
  const Index count = this->display_->GetNumberOfPoints();
  this->first_triangle_.assign(static_cast<std::size_t>(count) + 1, 0);
  for (Index k = 0; k < this->triangles_.size(); ++k)
  {
    ++this->first_triangle_[this->triangles_.data()[k] + 1];
  }
  for (Index v = 0; v < count; ++v)
  {
    this->first_triangle_[v + 1] += this->first_triangle_[v];
  }
  std::vector<Index> next(this->first_triangle_.begin(), this->first_triangle_.end() - 1);
  this->triangles_of_points_.resize(static_cast<std::size_t>(this->triangles_.size()));
  for (Index k = 0; k < this->triangles_.size(); ++k)
  {
    this->triangles_of_points_[next[this->triangles_.data()[k]]++] = k / 3;
  }
  this->triangle_normals_.resize(this->triangles_.rows(), 3);
}

void ShadedSurface::update_normals()
{
  auto* places = vtkDoubleArray::SafeDownCast(this->display_->GetPoints()->GetData());
  auto* array = vtkFloatArray::SafeDownCast(this->display_->GetPointData()->GetNormals());
  const double* at = places->GetPointer(0);
  double* normals = this->triangle_normals_.data();
  ExecutionContext context;
  parallel_for(context, this->triangles_.rows(), 4096,
    [&](Index begin, Index end)
    {
      const Index* corners = this->triangles_.data();
      for (Index t = begin; t < end; ++t)
      {
        const double* a = at + 3 * corners[3 * t];
        const double* b = at + 3 * corners[3 * t + 1];
        const double* c = at + 3 * corners[3 * t + 2];
        const double u[3] = { b[0] - a[0], b[1] - a[1], b[2] - a[2] };
        const double w[3] = { c[0] - a[0], c[1] - a[1], c[2] - a[2] };
        normals[3 * t] = u[1] * w[2] - u[2] * w[1];
        normals[3 * t + 1] = u[2] * w[0] - u[0] * w[2];
        normals[3 * t + 2] = u[0] * w[1] - u[1] * w[0];
      }
    });
  float* to = array->GetPointer(0);
  parallel_for(context, places->GetNumberOfTuples(), 4096,
    [&](Index begin, Index end)
    {
      for (Index v = begin; v < end; ++v)
      {
        double x = 0.0, y = 0.0, z = 0.0;
        for (Index k = this->first_triangle_[v]; k < this->first_triangle_[v + 1]; ++k)
        {
          const double* normal = normals + 3 * this->triangles_of_points_[k];
          x += normal[0];
          y += normal[1];
          z += normal[2];
        }
        const double length = std::sqrt(x * x + y * y + z * z);
        const double scale = length > 0.0 ? 1.0 / length : 0.0;
        to[3 * v] = static_cast<float>(scale * x);
        to[3 * v + 1] = static_cast<float>(scale * y);
        to[3 * v + 2] = length > 0.0 ? static_cast<float>(scale * z) : 1.0F;
      }
    });
  array->Modified();
}

void use_surface_material(vtkActor* actor)
{
  vtkProperty* property = actor->GetProperty();
  property->SetInterpolationToPhong();
  property->SetColor(palette::surface[0], palette::surface[1], palette::surface[2]);
  property->SetAmbient(0.17);
  property->SetDiffuse(0.88);
  property->SetSpecular(0.10);
  property->SetSpecularPower(18.0);
}

} // namespace bindpose
