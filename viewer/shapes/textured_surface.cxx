#include "shapes/textured_surface.h"

#include "weight_uses/weighted_colors.h"
#include "base/parallel.h"
#include "conversion.h"
#include "scene/camera.h"
#include "shapes/look_material.h"
#include "shapes/moved_surface_mapper.h"
#include "shapes/shaded_surface.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace bindpose
{

namespace
{
constexpr const char* color_name = "bindpose.LookColor";

unsigned char to_byte(double value)
{
  return static_cast<unsigned char>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}
} // namespace

TexturedSurface::TexturedSurface(const FileLook& look, PointsView rest)
  : points_(look.surface.points), positions_(static_cast<Index>(look.surface.points.size()), 3)
{
  const SurfaceLook& surface = look.surface;
  this->take_positions(rest);
  this->shaded_ = std::make_unique<ShadedSurface>(to_polydata(this->positions_, surface.triangles));
  this->add_coordinates(surface);
  std::map<Index, std::vector<Index>> triangles; // by material
  for (std::size_t t = 0; t < surface.triangle_materials.size(); ++t)
  {
    const Index material = surface.triangle_materials[t];
    triangles[material].push_back(static_cast<Index>(t));
    if (material >= 0 && surface.materials[material].normal_texture.image >= 0)
    {
      this->bumpy_triangles_.push_back(static_cast<Index>(t));
    }
  }
  if (surface.colors.rows() > 0)
  {
    this->add_colors(surface);
  }
  this->update_tangents();
  LookTextures textures(look);
  for (const auto& [material, ids] : triangles)
  {
    this->add_material(surface, material, ids, textures);
  }
  Vec3 normal;
  if (find_plane(rest, normal))
  {
    for (const auto& actor : this->actors_)
    {
      actor->GetProperty()->BackfaceCullingOff(); // the default view may show the back
    }
  }
}

TexturedSurface::~TexturedSurface() = default;

vtkPolyData* TexturedSurface::polydata() const
{
  return this->shaded_->polydata();
}

void TexturedSurface::move(PointsView points)
{
  this->take_positions(points);
  this->shaded_->move(this->positions_);
  this->update_tangents();
}

/// Set the positions of the vertices of the look.
void TexturedSurface::take_positions(PointsView points)
{
  ExecutionContext context;
  parallel_for(context, this->positions_.rows(), 8192,
    [&](Index begin, Index end)
    {
      for (Index v = begin; v < end; ++v)
      {
        this->positions_.row(v) = points.row(this->points_[static_cast<std::size_t>(v)]);
      }
    });
}

/// Add the texture coordinates to the drawn points.
void TexturedSurface::add_coordinates(const SurfaceLook& surface)
{
  const std::vector<Index>& vertices = this->shaded_->input_points();
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetName("TCoords");
  coordinates->SetNumberOfComponents(2);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(vertices.size()));
  for (std::size_t v = 0; v < vertices.size(); ++v)
  {
    coordinates->SetTuple(static_cast<vtkIdType>(v), surface.coordinates.row(vertices[v]).data());
  }
  this->polydata()->GetPointData()->SetTCoords(coordinates);
}

/// Add the vertex colors, multiplied with the base colors, to the drawn points. A vertex of the
/// look belongs to one primitive, and thus to one material.
void TexturedSurface::add_colors(const SurfaceLook& surface)
{
  const std::vector<Index>& vertices = this->shaded_->input_points();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName(color_name);
  colors->SetNumberOfComponents(4);
  colors->SetNumberOfTuples(static_cast<vtkIdType>(vertices.size()));
  const TrianglesView triangles = this->shaded_->triangles();
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    const Index id = surface.triangle_materials[static_cast<std::size_t>(t)];
    const LookMaterial* material = id < 0 ? nullptr : &surface.materials[id];
    const bool needs_srgb = !material || material->is_unlit;
    for (int corner = 0; corner < 3; ++corner)
    {
      const Index v = triangles(t, corner);
      for (Index k = 0; k < 4; ++k)
      {
        const double value = surface.colors(vertices[static_cast<std::size_t>(v)], k) *
          (material ? material->base_color[k] : 1.0);
        colors->SetTypedComponent(
          v, static_cast<int>(k), to_byte(needs_srgb && k < 3 ? from_linear_light(value) : value));
      }
    }
  }
  this->polydata()->GetPointData()->AddArray(colors);
}

/// Return a surface with some of the triangles. It shares all points with the whole surface.
vtkSmartPointer<vtkPolyData> TexturedSurface::part_of(const std::vector<Index>& triangles) const
{
  vtkNew<vtkIdTypeArray> corners;
  corners->SetNumberOfValues(3 * static_cast<vtkIdType>(triangles.size()));
  vtkIdType* to = corners->GetPointer(0);
  for (const Index t : triangles)
  {
    to = std::copy_n(this->shaded_->triangles().data() + 3 * t, 3, to);
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(3, corners);
  auto part = vtkSmartPointer<vtkPolyData>::New();
  part->SetPoints(this->polydata()->GetPoints());
  part->GetPointData()->ShallowCopy(this->polydata()->GetPointData());
  part->SetPolys(cells);
  return part;
}

void TexturedSurface::add_material(const SurfaceLook& surface, Index material,
  const std::vector<Index>& triangles, LookTextures& textures)
{
  vtkNew<MovedSurfaceMapper> mapper;
  const vtkSmartPointer<vtkPolyData> part = this->part_of(triangles);
  if (material >= 0 && surface.materials[material].normal_texture.image >= 0)
  {
    part->GetPointData()->SetTangents(this->tangents_);
  }
  mapper->SetInputData(part);
  mapper->ScalarVisibilityOff();
  // Lines and colors on the surface are drawn in front of it.
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 2.0);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  const bool has_colors = surface.colors.rows() > 0;
  if (has_colors)
  {
    mapper->ScalarVisibilityOn();
    mapper->SetScalarModeToUsePointFieldData();
    mapper->SelectColorArray(color_name);
    mapper->SetColorModeToDirectScalars();
  }
  if (material < 0)
  {
    use_surface_material(actor);
  }
  else
  {
    apply_material(textures, surface.materials[material], has_colors, actor);
  }
  this->actors_.push_back(actor);
}

/// Compute the tangents that normal textures need: at each point, the mean direction in which the
/// first texture coordinate increases, perpendicular to the normal. (vtkPolyDataTangents returns
/// NaN around triangles that have no area in the texture.)
void TexturedSurface::update_tangents()
{
  if (this->bumpy_triangles_.empty())
  {
    return;
  }
  vtkPolyData* drawn = this->polydata();
  const SharedMatrix<Points> points = to_points(drawn);
  const auto count = static_cast<std::size_t>(drawn->GetNumberOfPoints());
  const float* coordinates =
    vtkFloatArray::SafeDownCast(drawn->GetPointData()->GetTCoords())->GetPointer(0);
  std::vector<Vec3> sums(count, Vec3::Zero());
  for (const Index t : this->bumpy_triangles_)
  {
    const Index* corners = this->shaded_->triangles().data() + 3 * t;
    const Vec3 a = points.view().row(corners[0]);
    const Vec3 first = points.view().row(corners[1]).transpose() - a;
    const Vec3 second = points.view().row(corners[2]).transpose() - a;
    const float* origin = coordinates + 2 * corners[0];
    const Eigen::Vector2d u(
      coordinates[2 * corners[1]] - origin[0], coordinates[2 * corners[2]] - origin[0]);
    const Eigen::Vector2d v(
      coordinates[2 * corners[1] + 1] - origin[1], coordinates[2 * corners[2] + 1] - origin[1]);
    const double determinant = u[0] * v[1] - u[1] * v[0];
    const Vec3 tangent = (v[1] * first - v[0] * second) * (determinant < 0.0 ? -1.0 : 1.0);
    for (int k = 0; k < 3; ++k)
    {
      sums[static_cast<std::size_t>(corners[k])] += tangent;
    }
  }
  if (this->tangents_->GetNumberOfTuples() == 0)
  {
    this->tangents_->SetName("Tangents");
    this->tangents_->SetNumberOfComponents(3);
    this->tangents_->SetNumberOfTuples(static_cast<vtkIdType>(count));
  }
  const float* normals =
    vtkFloatArray::SafeDownCast(drawn->GetPointData()->GetNormals())->GetPointer(0);
  float* to = this->tangents_->GetPointer(0);
  for (std::size_t v = 0; v < count; ++v)
  {
    const Vec3 normal = Eigen::Map<const Eigen::Vector3f>(normals + 3 * v).cast<double>();
    Vec3 tangent = sums[v] - sums[v].dot(normal) * normal;
    if (!(tangent.norm() > 1e-9 * sums[v].norm()))
    {
      tangent = normal.unitOrthogonal();
    }
    Eigen::Map<Eigen::Vector3f>(to + 3 * v) = tangent.normalized().cast<float>();
  }
  this->tangents_->Modified();
}

} // namespace bindpose
