// Evaluates winding numbers of surfaces, curves and oriented points with one class per type of
// input. Curves are in a plane: points are projected onto it along the axis perpendicular to the
// plane.
#include "winding_field.h"

#include "base/execution.h"
#include "cell_check.h"
#include "geometry/working_frame.h"
#include "winding/curve_winding_number.h"
#include "winding/point_cloud_winding_number.h"
#include "surface/surface_repair.h"
#include "winding/winding_number.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellCenters.h"
#include "vtkCellData.h"
#include "vtkCellTypes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMatrix3x3.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <map>
#include <sstream>

namespace bindpose
{

double winding_build_fraction(Index triangles, Index queries)
{
  constexpr double per_triangle = 1e-5;
  constexpr double per_query = 1e-7;
  const double build = per_triangle * static_cast<double>(triangles);
  return build / (build + per_query * static_cast<double>(queries) + 1e-9);
}

// ---- Samples -----------------------------------------------------------------------------------

Samples::Samples(vtkDataSet* data, bool cell_centers)
{
  if (cell_centers)
  {
    vtkNew<vtkDoubleArray> centers;
    centers->SetNumberOfComponents(3);
    centers->SetNumberOfTuples(data->GetNumberOfCells());
    vtkCellCenters::ComputeCellCenters(data, centers);
    this->points_.set_shared(centers.Get(), centers->GetPointer(0), data->GetNumberOfCells(), 3);
    return;
  }
  auto* image = vtkImageData::SafeDownCast(data);
  if (image && image->GetDirectionMatrix()->IsIdentity())
  {
    SampleGrid grid;
    grid.origin = Vec3(image->GetOrigin());
    grid.spacing = Vec3(image->GetSpacing());
    std::copy_n(image->GetExtent(), 6, grid.extent.begin());
    this->grid_ = grid;
    return;
  }
  this->points_ = to_points(data);
}

Index Samples::count() const
{
  return this->grid_ ? this->grid_->count() : this->points_.view().rows();
}

Index Samples::layer_size() const
{
  return this->grid_ ? std::max<Index>(1, this->grid_->size(0) * this->grid_->size(1)) : 1;
}

Samples Samples::layers(Index begin, Index end) const
{
  Samples part;
  if (this->grid_)
  {
    part.grid_ = this->grid_;
    part.grid_->extent[5] = this->grid_->extent[4] + end - 1;
    part.grid_->extent[4] += begin;
  }
  else
  {
    part.points_ = this->points_.rows(begin, end);
  }
  return part;
}

// ---- Types of input ----------------------------------------------------------------------------

namespace
{
bool has_cells_of_dimension(vtkPointSet* input, int dimension)
{
  if (auto* polydata = vtkPolyData::SafeDownCast(input))
  {
    return dimension == 2 ? polydata->GetNumberOfPolys() + polydata->GetNumberOfStrips() > 0
                          : polydata->GetNumberOfLines() > 0;
  }
  vtkNew<vtkCellTypes> types;
  input->GetCellTypes(types);
  for (vtkIdType i = 0; i < types->GetNumberOfTypes(); ++i)
  {
    const int type = types->GetCellType(i);
    const bool is_line = type == VTK_LINE || type == VTK_POLY_LINE;
    const bool is_surface = type == VTK_TRIANGLE || type == VTK_TRIANGLE_STRIP ||
      type == VTK_POLYGON || type == VTK_QUAD || type == VTK_PIXEL;
    if (dimension == 2 ? is_surface : is_line)
    {
      return true;
    }
  }
  return false;
}

vtkDataArray* normals_of(vtkPointSet* input)
{
  vtkPointData* data = input->GetPointData();
  vtkDataArray* normals = data->GetNormals() ? data->GetNormals() : data->GetArray("Normals");
  return normals && normals->GetNumberOfComponents() == 3 ? normals : nullptr;
}

enum class Kind
{
  surface,
  curve,
  cloud
};

/// Return the type of an input. An input that is neither a curve nor a set of oriented points is
/// treated as a surface. The surface code rejects the input if it has no 2D cells.
Kind kind_of(vtkPointSet* input)
{
  if (!input || has_cells_of_dimension(input, 2))
  {
    return Kind::surface;
  }
  return has_cells_of_dimension(input, 1)                 ? Kind::curve
    : input->GetNumberOfPoints() > 0 && normals_of(input) ? Kind::cloud
                                                          : Kind::surface;
}

struct CurveInput
{
  SharedMatrix<Points> points;
  Segments segments;
  Box box;
  int normal_axis = 2; ///< axis perpendicular to the plane
};

Status to_curve(vtkPointSet* input, CurveInput& curve)
{
  curve.points = to_points(input);
  std::vector<Index> ends;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    const int type = input->GetCellType(cell);
    if (type == VTK_LINE || type == VTK_POLY_LINE)
    {
      input->GetCellPoints(cell, ids);
      for (vtkIdType k = 1; k < ids->GetNumberOfIds(); ++k)
      {
        ends.push_back(ids->GetId(k - 1));
        ends.push_back(ids->GetId(k));
      }
    }
  }
  curve.segments = Eigen::Map<const Segments>(ends.data(), static_cast<Index>(ends.size() / 2), 2);
  const PointsView points = curve.points.view();
  for (const Index v : ends)
  {
    if (v < 0 || v >= points.rows())
    {
      return Status::invalid_input("a line references vertex " + std::to_string(v) +
        ", but there are " + std::to_string(points.rows()) + " vertices");
    }
    if (!points.row(v).allFinite())
    {
      return Status::invalid_input(
        "vertex " + std::to_string(v) + " has a coordinate that is not a finite number");
    }
    curve.box.add(points.row(v));
  }
  WorkingFrame frame;
  const Status status = WorkingFrame::choose(points, curve.box, "the curve", frame);
  if (!status.ok())
  {
    return status;
  }
  const Vec3 size = curve.box.size();
  curve.normal_axis = size.z() == 0.0 ? 2 : size.x() == 0.0 ? 0 : size.y() == 0.0 ? 1 : -1;
  if (curve.normal_axis < 0)
  {
    return Status::invalid_input("the input has no triangles or polygons, and its lines are not in "
                                 "a plane perpendicular to the x, y or z axis");
  }
  return {};
}

/// Return 2D coordinates in the plane perpendicular to an axis. Seen from the positive end of this
/// axis, the second coordinate axis is 90 degrees counter-clockwise from the first.
PlanePoints project_to_plane(PointsView points, int normal_axis)
{
  PlanePoints plane_points(points.rows(), 2);
  plane_points.col(0) = points.col((normal_axis + 1) % 3);
  plane_points.col(1) = points.col((normal_axis + 2) % 3);
  return plane_points;
}

/// Return all samples as a list of points.
Points points_of(const Samples& samples)
{
  const SampleGrid* grid = samples.grid();
  if (!grid)
  {
    return samples.points();
  }
  Points points(grid->count(), 3);
  for (Index i = 0; i < points.rows(); ++i)
  {
    points.row(i) = grid->point(i).transpose();
  }
  return points;
}

WindingMethod method_of(int method)
{
  constexpr WindingMethod methods[] = { WindingMethod::automatic, WindingMethod::exact,
    WindingMethod::fast };
  return methods[method];
}

/// Convert the boundary edges to lines, and the properties of the surface's components to field
/// data. original[i] is the id, in the input, of the point in row i of `points`. If `original` is
/// empty, the id is i.
void to_polydata(const SurfaceBoundary& boundary, PointsView points,
  const std::vector<Index>& original, vtkPolyData* polydata)
{
  std::map<Index, vtkIdType> id_of;
  vtkNew<vtkPoints> vertices;
  vertices->SetDataTypeToDouble();
  vtkNew<vtkIdTypeArray> original_ids;
  original_ids->SetName("OriginalPointIds");
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkIntArray> multiplicity;
  multiplicity->SetName("Multiplicity");
  vtkNew<vtkIdTypeArray> component;
  component->SetName("Component");
  for (const SurfaceBoundary::BoundaryEdge& edge : boundary.edges)
  {
    vtkIdType ends[2];
    int k = 0;
    for (const Index v : { edge.from, edge.to })
    {
      const auto [found, is_new] = id_of.try_emplace(v, vertices->GetNumberOfPoints());
      if (is_new)
      {
        vertices->InsertNextPoint(points(v, 0), points(v, 1), points(v, 2));
        original_ids->InsertNextValue(original.empty() ? v : original[v]);
      }
      ends[k++] = found->second;
    }
    lines->InsertNextCell(2, ends);
    multiplicity->InsertNextValue(static_cast<int>(edge.multiplicity));
    component->InsertNextValue(edge.component);
  }
  polydata->SetPoints(vertices);
  polydata->SetLines(lines);
  polydata->GetPointData()->AddArray(original_ids);
  polydata->GetCellData()->SetScalars(multiplicity);
  polydata->GetCellData()->AddArray(component);

  vtkNew<vtkIdTypeArray> triangles;
  triangles->SetName("ComponentTriangles");
  vtkNew<vtkIdTypeArray> open_edges;
  open_edges->SetName("ComponentOpenEdges");
  vtkNew<vtkDoubleArray> volume;
  volume->SetName("ComponentVolume");
  for (const SurfaceBoundary::Component& part : boundary.components)
  {
    triangles->InsertNextValue(part.triangles);
    open_edges->InsertNextValue(part.open_edges);
    volume->InsertNextValue(part.volume);
  }
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{ triangles, open_edges, volume })
  {
    polydata->GetFieldData()->AddArray(array);
  }
}
} // namespace

struct WindingField::Kernel
{
  virtual ~Kernel() = default;
  virtual Status build(ExecutionContext& context, vtkPointSet* input, const Options& options,
    vtkPolyData* boundary) = 0;
  virtual Status evaluate(ExecutionContext& context, const Samples& samples, double* out,
    unsigned char* on_surface) const = 0;
  virtual Status evaluate_gradient(
    ExecutionContext& context, const Samples& samples, double* out) const = 0;
  virtual bool depends_on_expected_queries() const { return false; }
};

/// A kernel that evaluates on a grid or at points.
template <typename Winding>
struct WindingField::GridKernel : Kernel
{
  Winding winding;

  Status evaluate(ExecutionContext& context, const Samples& samples, double* out,
    unsigned char* on_surface) const override
  {
    return samples.grid() ? this->winding.evaluate(context, *samples.grid(), out, on_surface)
                          : this->winding.evaluate(context, samples.points(), out, on_surface);
  }

  Status evaluate_gradient(
    ExecutionContext& context, const Samples& samples, double* out) const override
  {
    return samples.grid() ? this->winding.evaluate_gradient(context, *samples.grid(), out)
                          : this->winding.evaluate_gradient(context, samples.points(), out);
  }
};

struct WindingField::Surface : GridKernel<WindingNumber>
{
  Status build(ExecutionContext& context, vtkPointSet* input, const Options& options,
    vtkPolyData* boundary) override
  {
    SurfaceInput surface;
    Status status = to_surface(input, surface);
    if (!status.ok())
    {
      return status;
    }
    RepairedSurface repaired;
    const double repair_fraction = options.orient ? 0.5 : 0.0;
    if (options.orient)
    {
      const ProgressRange range(context, 0.0, repair_fraction);
      RepairOptions repair;
      repair.count_self_intersections = false;
      status =
        repair_surface(context, surface.points.view(), surface.triangles.view(), repair, repaired);
      if (!status.ok())
      {
        return status;
      }
    }
    const PointsView points = options.orient ? PointsView(repaired.points) : surface.points.view();
    const TrianglesView triangles =
      options.orient ? TrianglesView(repaired.triangles) : surface.triangles.view();
    WindingNumber::Options winding_options;
    winding_options.method = method_of(options.method);
    winding_options.tolerance = options.tolerance;
    winding_options.expected_queries = options.expected_queries;
    winding_options.query_region = options.query_region;
    {
      const ProgressRange range(context, repair_fraction, 1.0);
      status = this->winding.build(context, points, triangles, winding_options);
    }
    if (!status.ok())
    {
      return status;
    }
    to_polydata(this->winding.boundary(), points, repaired.original_vertices, boundary);
    if (options.orient)
    {
      status.report.set("counts.turned_triangles", repaired.flipped_triangles);
      status.report.set("counts.turned_components", repaired.flipped_components);
    }
    if (surface.triangulated_cells > 0)
    {
      status.report.set("counts.triangulated_cells", surface.triangulated_cells);
    }
    if (surface.ignored_cells > 0)
    {
      status.report.set("counts.ignored_cells", surface.ignored_cells);
    }
    return status;
  }

  bool depends_on_expected_queries() const override
  {
    return this->winding.method() == WindingMethod::fast;
  }
};

struct WindingField::Curve : Kernel
{
  CurveWindingNumber winding;
  int normal_axis = 2;

  Status build(ExecutionContext& context, vtkPointSet* input, const Options&, vtkPolyData*) override
  {
    CurveInput curve;
    const Status status = to_curve(input, curve);
    if (!status.ok())
    {
      return status;
    }
    this->normal_axis = curve.normal_axis;
    return this->winding.build(
      context, project_to_plane(curve.points.view(), this->normal_axis), curve.segments);
  }

  Status evaluate(ExecutionContext& context, const Samples& samples, double* out,
    unsigned char* on_surface) const override
  {
    return this->winding.evaluate(
      context, project_to_plane(points_of(samples), this->normal_axis), out, on_surface);
  }

  Status evaluate_gradient(
    ExecutionContext& context, const Samples& samples, double* out) const override
  {
    const Index count = samples.count();
    PlanePoints gradients(count, 2);
    const Status status = this->winding.evaluate_gradient(
      context, project_to_plane(points_of(samples), this->normal_axis), gradients.data());
    for (Index i = 0; i < count; ++i)
    {
      out[3 * i + (this->normal_axis + 1) % 3] = gradients(i, 0);
      out[3 * i + (this->normal_axis + 2) % 3] = gradients(i, 1);
      out[3 * i + this->normal_axis] = 0.0;
    }
    return status;
  }
};

struct WindingField::Cloud : GridKernel<PointCloudWindingNumber>
{
  Status build(
    ExecutionContext& context, vtkPointSet* input, const Options& options, vtkPolyData*) override
  {
    const SharedMatrix<Points> points = to_points(input);
    const SharedMatrix<Weights> normals = to_matrix(normals_of(input));
    vtkDataArray* areas = input->GetPointData()->GetArray(options.area_array.c_str());
    if (areas && areas->GetNumberOfComponents() != 1)
    {
      return Status::invalid_input("the point array '" + options.area_array +
        "' must have one component, the area of each point");
    }
    Eigen::VectorXd numbers(areas ? areas->GetNumberOfTuples() : 0);
    for (Index i = 0; i < numbers.size(); ++i)
    {
      numbers[i] = areas->GetTuple1(i);
    }
    PointCloudWindingNumber::Options winding_options;
    winding_options.method = method_of(options.method);
    winding_options.tolerance = options.tolerance;
    const Points directions = normals.view();
    Status status =
      this->winding.build(context, points.view(), directions, numbers, winding_options);
    if (status.ok())
    {
      status.report.set("areas", areas ? "given" : "estimated");
    }
    return status;
  }
};

// ---- The field ---------------------------------------------------------------------------------

WindingField::WindingField() : boundary_(vtkSmartPointer<vtkPolyData>::New()) {}
WindingField::~WindingField() = default;
WindingField::WindingField(WindingField&&) noexcept = default;
WindingField& WindingField::operator=(WindingField&&) noexcept = default;

Status WindingField::extent(vtkPointSet* input, Box& box, int& flat_axis)
{
  flat_axis = -1;
  box = Box();
  const Status sizes = check_cells(input);
  if (!sizes.ok())
  {
    return sizes;
  }
  switch (kind_of(input))
  {
    case Kind::curve:
    {
      CurveInput curve;
      const Status status = to_curve(input, curve);
      box = curve.box;
      flat_axis = curve.normal_axis;
      return status;
    }
    case Kind::cloud:
      box = bounding_box(to_points(input).view());
      return box.lower.allFinite() && box.upper.allFinite()
        ? Status()
        : Status::invalid_input("a point has a coordinate that is not a finite number");
    case Kind::surface:
      break;
  }
  SurfaceInput surface;
  const Status status = to_surface(input, surface);
  if (status.ok())
  {
    box = bounding_box(surface.points.view(), surface.triangles.view());
  }
  return status;
}

Status WindingField::build(ExecutionContext& context, vtkPointSet* input, const Options& options)
{
  const Kind kind = kind_of(input);
  if (kind == Kind::curve)
  {
    this->kernel_.reset(new Curve);
  }
  else if (kind == Kind::cloud)
  {
    this->kernel_.reset(new Cloud);
  }
  else
  {
    this->kernel_.reset(new Surface);
  }
  return this->kernel_->build(context, input, options, this->boundary_);
}

Status WindingField::evaluate(
  ExecutionContext& context, const Samples& samples, double* out, unsigned char* on_surface) const
{
  return this->kernel_->evaluate(context, samples, out, on_surface);
}

Status WindingField::evaluate_gradient(
  ExecutionContext& context, const Samples& samples, double* out) const
{
  return this->kernel_->evaluate_gradient(context, samples, out);
}

bool WindingField::depends_on_expected_queries() const
{
  return this->kernel_ && this->kernel_->depends_on_expected_queries();
}

} // namespace bindpose
