// Conversion of images, curves and handle datasets to points and segments in the plane.
#include "planar_input.h"

#include "conversion.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <cmath>
#include <limits>
#include <type_traits>

namespace bindpose
{

namespace
{
/// The array and the component of that array that contain an image's alpha.
struct Alpha
{
  vtkDataArray* array = nullptr;
  int component = 0;
};

Alpha alpha_of(vtkImageData* image)
{
  vtkPointData* data = image->GetPointData();
  vtkDataArray* alpha_array = data->GetArray("Alpha");
  if (alpha_array && alpha_array->GetNumberOfComponents() == 1)
  {
    return { alpha_array, 0 };
  }
  vtkDataArray* scalars = data->GetScalars();
  const int components = scalars ? scalars->GetNumberOfComponents() : 0;
  return components == 2 || components == 4 ? Alpha{ scalars, components - 1 } : Alpha{};
}

template <typename Number>
void read_row(const Number* first, Index columns, Index stride, float* values)
{
  constexpr double scale = std::is_integral_v<Number> && std::is_unsigned_v<Number>
    ? 1.0 / static_cast<double>(std::numeric_limits<Number>::max())
    : 1.0;
  for (Index x = 0; x < columns; ++x)
  {
    values[x] = static_cast<float>(static_cast<double>(first[x * stride]) * scale);
  }
}

AlphaRow rows_of(const Alpha& alpha, Index columns)
{
  return [alpha, columns](Index row, float* values)
  {
    const Index stride = alpha.array->GetNumberOfComponents();
    void* first = alpha.array->GetVoidPointer(row * columns * stride + alpha.component);
    switch (alpha.array->GetDataType())
    {
      vtkTemplateMacro(read_row(static_cast<const VTK_TT*>(first), columns, stride, values));
      default:
        std::fill(values, values + columns, 0.0f);
    }
  };
}

Status check_image(vtkImageData* image)
{
  const int* dimensions = image->GetDimensions();
  if (dimensions[0] < 1 || dimensions[1] < 1 || dimensions[2] < 1)
  {
    return Status::invalid_input("the image has no pixels");
  }
  if (dimensions[2] > 1)
  {
    return Status::invalid_input("the image has " + std::to_string(dimensions[2]) +
      " layers along z; expected a single layer");
  }
  if (!image->GetDirectionMatrix()->IsIdentity())
  {
    return Status::invalid_input("the image's direction matrix must be the identity");
  }
  for (int k = 0; k < 3; ++k)
  {
    const double spacing = image->GetSpacing()[k];
    if (!std::isfinite(image->GetOrigin()[k]) || !std::isfinite(spacing) ||
      (k < 2 && spacing <= 0.0))
    {
      return Status::invalid_input(
        "the image's origin and spacing must be finite and the spacing positive");
    }
  }
  return {};
}

void rectangle_outline(Index columns, Index rows, ImageOutline& outline)
{
  const double right = static_cast<double>(columns) - 0.5;
  const double top = static_cast<double>(rows) - 0.5;
  outline.points.resize(4, 2);
  outline.points << -0.5, -0.5, right, -0.5, right, top, -0.5, top;
  outline.segments.resize(4, 2);
  outline.segments << 0, 1, 1, 2, 2, 3, 3, 0;
}

bool is_polygon(int type)
{
  return type == VTK_TRIANGLE || type == VTK_QUAD || type == VTK_POLYGON;
}
} // namespace

Status to_planar_input(ExecutionContext& context, vtkImageData* image, bool rectangle,
  const ImageOutlineOptions& options, PlanarInput& input)
{
  Status status = check_image(image);
  if (!status.ok())
  {
    return status;
  }
  const int* dimensions = image->GetDimensions();
  const Alpha alpha = alpha_of(image);
  const bool use_rectangle = rectangle || !alpha.array;
  ImageOutline outline;
  if (use_rectangle)
  {
    rectangle_outline(dimensions[0], dimensions[1], outline);
  }
  else
  {
    status = image_outline(
      context, dimensions[0], dimensions[1], rows_of(alpha, dimensions[0]), options, outline);
    if (!status.ok())
    {
      return status;
    }
  }
  input.report = status.report;
  input.report.set("domain", use_rectangle ? "rectangle" : "alpha");
  const int* extent = image->GetExtent();
  const Vec2 spacing(image->GetSpacing()[0], image->GetSpacing()[1]);
  const Vec2 first(image->GetOrigin()[0] + extent[0] * spacing.x(),
    image->GetOrigin()[1] + extent[2] * spacing.y());
  input.z = image->GetOrigin()[2] + extent[4] * image->GetSpacing()[2];
  input.points =
    (outline.points * spacing.asDiagonal()).rowwise() + Eigen::RowVector2d(first.transpose());
  input.segments = outline.segments;
  input.lower = first - 0.5 * spacing;
  input.upper =
    first + (Vec2(dimensions[0], dimensions[1]) - Vec2::Constant(0.5)).cwiseProduct(spacing);
  return {};
}

Status to_planar_input(vtkPolyData* curves, PlanarInput& input)
{
  std::vector<Index> ends;
  Index ignored = 0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < curves->GetNumberOfCells(); ++cell)
  {
    const int type = curves->GetCellType(cell);
    const bool line = type == VTK_LINE || type == VTK_POLY_LINE;
    if (!line && !is_polygon(type))
    {
      ignored += 1;
      continue;
    }
    curves->GetCellPoints(cell, ids);
    const vtkIdType count = ids->GetNumberOfIds();
    for (vtkIdType k = line ? 1 : 0; k < count; ++k)
    {
      ends.push_back(ids->GetId(k > 0 ? k - 1 : count - 1));
      ends.push_back(ids->GetId(k));
    }
  }
  if (ends.empty())
  {
    return Status::invalid_input("the input has no lines or polygons, only " +
      std::to_string(curves->GetNumberOfPoints()) + " points and " +
      std::to_string(curves->GetNumberOfCells()) + " cells of other types");
  }
  const SharedMatrix<Points> shared = to_points(curves);
  const PointsView points = shared.view();
  Box box;
  for (const Index v : ends)
  {
    if (v < 0 || v >= points.rows())
    {
      return Status::invalid_input("a line or polygon references point " + std::to_string(v) +
        ", but there are " + std::to_string(points.rows()) + " points");
    }
    if (!points.row(v).allFinite())
    {
      return Status::invalid_input(
        "point " + std::to_string(v) + " has a coordinate that is not a finite number");
    }
    box.add(points.row(v).transpose());
  }
  // Largest extent of a flat shape along z, as a fraction of its diagonal. It is above 0, because
  // coordinates in files are rounded.
  constexpr double flatness_tolerance = 1e-6;
  if (box.upper.z() - box.lower.z() > flatness_tolerance * (box.upper - box.lower).head<2>().norm())
  {
    std::string range = std::to_string(box.lower.z()) + " to " + std::to_string(box.upper.z());
    return Status::invalid_input(
      "the curves must be in a plane z = const, but z ranges from " + range);
  }
  input.points = points.leftCols<2>();
  input.segments = Eigen::Map<const Segments>(ends.data(), static_cast<Index>(ends.size() / 2), 2);
  input.z = box.lower.z();
  input.lower = box.lower.head<2>();
  input.upper = box.upper.head<2>();
  input.report.set("domain", "curves");
  if (ignored > 0)
  {
    input.report.set("counts.ignored_cells", ignored);
  }
  return {};
}

} // namespace bindpose
