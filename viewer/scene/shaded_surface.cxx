// vtkPolyDataNormals decides where to split vertices. Id arrays that it passes through give the
// input point of each drawn point and the input cell of each triangle. Normals are then sums of
// triangle normals weighted by area. Each point sums over its own triangles in a fixed order, so
// that any number of cores gives the same bits.
#include "scene/shaded_surface.h"

#include "base/parallel.h"
#include "conversion.h"
#include "scene/colors.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bindpose
{

namespace
{
constexpr const char* id_name = "bindpose.Input";

vtkSmartPointer<vtkIdTypeArray> make_ids(vtkIdType count)
{
  auto ids = vtkSmartPointer<vtkIdTypeArray>::New();
  ids->SetName(id_name);
  ids->SetNumberOfValues(count);
  std::iota(ids->GetPointer(0), ids->GetPointer(0) + count, vtkIdType(0));
  return ids;
}

/// Return the id array that a filter passed through.
std::vector<Index> carried_ids(vtkDataSetAttributes* data, vtkIdType count)
{
  std::vector<Index> result(static_cast<std::size_t>(count));
  if (auto* ids = vtkIdTypeArray::SafeDownCast(data->GetArray(id_name)))
  {
    std::copy_n(ids->GetPointer(0), count, result.begin());
  }
  return result;
}

/// Copy all arrays of `from`: the tuples with these ids, in this order.
void gather(vtkDataSetAttributes* from, const std::vector<Index>& ids, vtkDataSetAttributes* to)
{
  bool all = static_cast<vtkIdType>(ids.size()) == from->GetNumberOfTuples();
  for (std::size_t k = 0; all && k < ids.size(); ++k)
  {
    all = ids[k] == static_cast<Index>(k);
  }
  if (all)
  {
    to->ShallowCopy(from);
    return;
  }
  const auto count = static_cast<vtkIdType>(ids.size());
  vtkNew<vtkIdList> source, target;
  source->SetNumberOfIds(count);
  target->SetNumberOfIds(count);
  std::copy(ids.begin(), ids.end(), source->GetPointer(0));
  std::iota(target->GetPointer(0), target->GetPointer(0) + count, vtkIdType(0));
  to->Initialize();
  to->CopyAllOn();
  to->CopyAllocate(from, count);
  to->CopyData(from, source, target);
}
} // namespace

ShadedSurface::ShadedSurface(vtkPolyData* surface, double feature_angle)
  : input_(vtkSmartPointer<vtkPolyData>::New())
{
  this->input_->CopyStructure(surface);
  vtkNew<vtkPolyData> input;
  input->CopyStructure(surface);
  input->GetPointData()->AddArray(make_ids(input->GetNumberOfPoints()));
  input->GetCellData()->AddArray(make_ids(input->GetNumberOfCells()));
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

  vtkPolyData* parted = normals->GetOutput();
  this->input_cells_ = carried_ids(parted->GetCellData(), parted->GetNumberOfCells());
  this->triangles_.resize(parted->GetNumberOfPolys(), 3);
  vtkNew<vtkIdList> corners;
  for (Index t = 0; t < this->triangles_.rows(); ++t)
  {
    parted->GetPolys()->GetCellAtId(t, corners);
    for (int k = 0; k < 3; ++k)
    {
      this->triangles_(t, k) = corners->GetId(k);
    }
  }
  this->input_points_ = carried_ids(parted->GetPointData(), parted->GetNumberOfPoints());
  this->drop_unused_points();
  const auto count = static_cast<vtkIdType>(this->input_points_.size());
  this->find_triangles_of_points();
  this->display_ = to_polydata(Points(count, 3), this->triangles_);
  this->normals_->SetName("Normals");
  this->normals_->SetNumberOfComponents(3);
  this->normals_->SetNumberOfTuples(count);
  this->take(surface);
}

bool ShadedSurface::is_of(vtkPolyData* surface) const
{
  return surface->GetPoints() == this->input_->GetPoints() &&
    surface->GetVerts() == this->input_->GetVerts() &&
    surface->GetLines() == this->input_->GetLines() &&
    surface->GetPolys() == this->input_->GetPolys() &&
    surface->GetStrips() == this->input_->GetStrips();
}

void ShadedSurface::take(vtkPolyData* surface)
{
  vtkPointData* data = this->display_->GetPointData();
  gather(surface->GetPointData(), this->input_points_, data);
  gather(surface->GetCellData(), this->input_cells_, this->display_->GetCellData());
  data->SetNormals(nullptr); // our normals follow the shape, those of a file do not
  data->SetNormals(this->normals_);
  this->move(to_points(surface).view());
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

/// Remove unused points, so that the bounds are those of the drawn points.
void ShadedSurface::drop_unused_points()
{
  std::vector<Index> kept(this->input_points_.size(), -1);
  for (const Index v : this->triangles_.reshaped())
  {
    kept[static_cast<std::size_t>(v)] = 0;
  }
  std::vector<Index> input_points;
  for (std::size_t v = 0; v < kept.size(); ++v)
  {
    if (kept[v] == 0)
    {
      kept[v] = static_cast<Index>(input_points.size());
      input_points.push_back(this->input_points_[v]);
    }
  }
  for (Index& v : this->triangles_.reshaped())
  {
    v = kept[static_cast<std::size_t>(v)];
  }
  this->input_points_ = std::move(input_points);
}

void ShadedSurface::find_triangles_of_points()
{
  const auto count = static_cast<Index>(this->input_points_.size());
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
  float* to = this->normals_->GetPointer(0);
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
  this->normals_->Modified();
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
