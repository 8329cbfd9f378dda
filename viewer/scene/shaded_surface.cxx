// vtkPolyDataNormals decides where to part vertices; an id array that it carries along tells which
// input point each display point is. Normals are then sums of triangle normals weighted by area.
#include "scene/shaded_surface.h"

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
  for (std::size_t v = 0; v < this->input_points_.size(); ++v)
  {
    const double* from = points.data() + 3 * this->input_points_[v];
    to[3 * v] = from[0];
    to[3 * v + 1] = from[1];
    to[3 * v + 2] = from[2];
  }
  this->update_normals();
  places->Modified();
  this->display_->GetPoints()->Modified();
  this->display_->Modified();
}

void ShadedSurface::update_normals()
{
  auto* places = vtkDoubleArray::SafeDownCast(this->display_->GetPoints()->GetData());
  auto* array = vtkFloatArray::SafeDownCast(this->display_->GetPointData()->GetNormals());
  const Eigen::Map<const Points> points(places->GetPointer(0), places->GetNumberOfTuples(), 3);
  Points sums = Points::Zero(points.rows(), 3);
  for (Index t = 0; t < this->triangles_.rows(); ++t)
  {
    const auto corner = this->triangles_.row(t);
    const Eigen::RowVector3d a = points.row(corner[0]);
    const Eigen::RowVector3d b = points.row(corner[1]);
    const Eigen::RowVector3d c = points.row(corner[2]);
    const Eigen::RowVector3d normal = (b - a).cross(c - a);
    for (int k = 0; k < 3; ++k)
    {
      sums.row(corner[k]) += normal;
    }
  }
  float* to = array->GetPointer(0);
  for (Index v = 0; v < sums.rows(); ++v)
  {
    const double length = sums.row(v).norm();
    for (int k = 0; k < 3; ++k)
    {
      to[3 * v + k] =
        length > 0.0 ? static_cast<float>(sums(v, k) / length) : (k == 2 ? 1.0F : 0.0F);
    }
  }
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
