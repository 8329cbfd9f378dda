// Normals are sums of triangle normals weighted by area. Each point sums over its own triangles in
// a fixed order, so that any number of cores gives the same bits.
#include "shapes/shaded_surface.h"

#include "base/parallel.h"
#include "conversion.h"
#include "scene/colors.h"
#include "shapes/sharp_edges.h"

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
#include "vtkProperty.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bindpose
{

namespace
{
/// The triangles of a polydata, and the cell that each triangle comes from.
struct DrawnTriangles
{
  Triangles triangles;
  std::vector<Index> cells;
};

/// Report whether all polygons are triangles, so that none must be split.
bool has_only_triangles(vtkPolyData* surface)
{
  vtkCellArray* polygons = surface->GetPolys();
  return surface->GetNumberOfStrips() == 0 && polygons->GetMaxCellSize() == 3 &&
    polygons->GetNumberOfConnectivityIds() == 3 * polygons->GetNumberOfCells();
}

DrawnTriangles triangles_of(vtkPolyData* surface)
{
  DrawnTriangles drawn;
  vtkPolyData* source = surface;
  vtkNew<vtkIdTypeArray> ids;
  vtkNew<vtkTriangleFilter> split;
  if (!has_only_triangles(surface))
  {
    ids->SetName("bindpose.Cell");
    ids->SetNumberOfValues(surface->GetNumberOfCells());
    std::iota(ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfValues(), vtkIdType(0));
    vtkNew<vtkPolyData> numbered;
    numbered->CopyStructure(surface);
    numbered->GetCellData()->AddArray(ids);
    split->SetInputData(numbered);
    split->PassVertsOff();
    split->PassLinesOff();
    split->Update();
    source = split->GetOutput();
  }
  vtkCellArray* polygons = source->GetPolys();
  const vtkIdType count = polygons->GetNumberOfCells();
  drawn.triangles.resize(count, 3);
  drawn.cells.reserve(static_cast<std::size_t>(count));
  // Cells of a polydata are numbered by type: vertices, lines, polygons.
  const vtkIdType first = surface->GetNumberOfVerts() + surface->GetNumberOfLines();
  auto* numbers = vtkIdTypeArray::SafeDownCast(source->GetCellData()->GetArray("bindpose.Cell"));
  for (vtkIdType t = 0; t < count; ++t)
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    polygons->GetCellAtId(t, size, corners);
    std::copy_n(corners, 3, drawn.triangles.data() + 3 * t);
    drawn.cells.push_back(source == surface ? first + t : numbers->GetValue(t));
  }
  return drawn;
}

/// Copy all arrays of `from`. The result has the tuples with these ids, in this order.
void gather(vtkDataSetAttributes* from, const std::vector<Index>& ids, vtkDataSetAttributes* to)
{
  bool is_identity = static_cast<vtkIdType>(ids.size()) == from->GetNumberOfTuples();
  for (std::size_t k = 0; is_identity && k < ids.size(); ++k)
  {
    is_identity = ids[k] == static_cast<Index>(k);
  }
  if (is_identity)
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
  DrawnTriangles drawn = triangles_of(surface);
  this->triangles_ = std::move(drawn.triangles);
  this->input_cells_ = std::move(drawn.cells);
  SplitVertices split =
    split_sharp_edges(to_points(surface).view(), feature_angle, this->triangles_);
  this->input_points_ = std::move(split.originals);
  this->normal_ids_ = std::move(split.normals);
  this->normal_count_ = split.normal_count;
  this->shared_normals_.resize(this->normal_ids_.empty() ? 0 : split.normal_count, 3);
  const auto count = static_cast<vtkIdType>(this->input_points_.size());
  this->find_triangles_of_normals();
  this->display_ = to_polydata(Points(count, 3), this->triangles_);
  this->normals_->SetName("Normals");
  this->normals_->SetNumberOfComponents(3);
  this->normals_->SetNumberOfTuples(count);
  this->set_arrays(surface);
}

bool ShadedSurface::has_same_mesh(vtkPolyData* surface) const
{
  return surface->GetPoints() == this->input_->GetPoints() &&
    surface->GetVerts() == this->input_->GetVerts() &&
    surface->GetLines() == this->input_->GetLines() &&
    surface->GetPolys() == this->input_->GetPolys() &&
    surface->GetStrips() == this->input_->GetStrips();
}

void ShadedSurface::set_arrays(vtkPolyData* surface)
{
  vtkPointData* data = this->display_->GetPointData();
  gather(surface->GetPointData(), this->input_points_, data);
  gather(surface->GetCellData(), this->input_cells_, this->display_->GetCellData());
  // Replace the input's own normals, because they would not follow the moved shape.
  data->SetNormals(nullptr);
  data->SetNormals(this->normals_);
  this->move(to_points(surface).view());
}

void ShadedSurface::move(PointsView points)
{
  auto* positions = vtkDoubleArray::SafeDownCast(this->display_->GetPoints()->GetData());
  double* to = positions->GetPointer(0);
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
  positions->Modified();
  this->display_->GetPoints()->Modified();
  this->display_->Modified();
}

void ShadedSurface::find_triangles_of_normals()
{
  const auto normal_of = [this](Index corner)
  {
    const Index v = this->triangles_.data()[corner];
    return this->normal_ids_.empty() ? v : this->normal_ids_[v];
  };
  this->first_triangle_.assign(static_cast<std::size_t>(this->normal_count_) + 1, 0);
  for (Index k = 0; k < this->triangles_.size(); ++k)
  {
    ++this->first_triangle_[normal_of(k) + 1];
  }
  for (Index n = 0; n < this->normal_count_; ++n)
  {
    this->first_triangle_[n + 1] += this->first_triangle_[n];
  }
  std::vector<Index> next(this->first_triangle_.begin(), this->first_triangle_.end() - 1);
  this->triangles_of_normals_.resize(static_cast<std::size_t>(this->triangles_.size()));
  for (Index k = 0; k < this->triangles_.size(); ++k)
  {
    this->triangles_of_normals_[next[normal_of(k)]++] = k / 3;
  }
  this->triangle_normals_.resize(this->triangles_.rows(), 3);
}

void ShadedSurface::update_normals()
{
  auto* positions = vtkDoubleArray::SafeDownCast(this->display_->GetPoints()->GetData());
  const double* coordinates = positions->GetPointer(0);
  double* normals = this->triangle_normals_.data();
  ExecutionContext context;
  parallel_for(context, this->triangles_.rows(), 4096,
    [&](Index begin, Index end)
    {
      const Index* corners = this->triangles_.data();
      for (Index t = begin; t < end; ++t)
      {
        const double* a = coordinates + 3 * corners[3 * t];
        const double* b = coordinates + 3 * corners[3 * t + 1];
        const double* c = coordinates + 3 * corners[3 * t + 2];
        const double u[3] = { b[0] - a[0], b[1] - a[1], b[2] - a[2] };
        const double w[3] = { c[0] - a[0], c[1] - a[1], c[2] - a[2] };
        normals[3 * t] = u[1] * w[2] - u[2] * w[1];
        normals[3 * t + 1] = u[2] * w[0] - u[0] * w[2];
        normals[3 * t + 2] = u[0] * w[1] - u[1] * w[0];
      }
    });
  float* to = this->normals_->GetPointer(0);
  float* smooth = this->normal_ids_.empty() ? to : this->shared_normals_.data();
  parallel_for(context, this->normal_count_, 4096,
    [&](Index begin, Index end)
    {
      for (Index n = begin; n < end; ++n)
      {
        double x = 0.0, y = 0.0, z = 0.0;
        for (Index k = this->first_triangle_[n]; k < this->first_triangle_[n + 1]; ++k)
        {
          const double* normal = normals + 3 * this->triangles_of_normals_[k];
          x += normal[0];
          y += normal[1];
          z += normal[2];
        }
        const double length = std::sqrt(x * x + y * y + z * z);
        const double scale = length > 0.0 ? 1.0 / length : 0.0;
        smooth[3 * n] = static_cast<float>(scale * x);
        smooth[3 * n + 1] = static_cast<float>(scale * y);
        smooth[3 * n + 2] = length > 0.0 ? static_cast<float>(scale * z) : 1.0F;
      }
    });
  for (std::size_t v = 0; v < this->normal_ids_.size(); ++v)
  {
    std::copy_n(smooth + 3 * this->normal_ids_[v], 3, to + 3 * v);
  }
  this->normals_->Modified();
}

void use_surface_material(vtkActor* actor)
{
  vtkProperty* property = actor->GetProperty();
  property->SetInterpolationToPhong();
  set_color(property, palette::surface);
  property->SetAmbient(0.17);
  property->SetDiffuse(0.88);
  property->SetSpecular(0.10);
  property->SetSpecularPower(18.0);
}

} // namespace bindpose
