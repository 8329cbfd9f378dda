// Isosurfaces and slices of image volumes. They use VTK's flying edges filters, which process the
// sample grid row by row. The computation takes about as long as reading the samples from memory,
// so a user can drag a level interactively.
#include "scene/volume.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkFlyingEdgesPlaneCutter.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{
namespace
{
// Return a copy of the image with only this array, because filters pass all arrays through.
vtkSmartPointer<vtkImageData> with_array_only(vtkImageData* image, const std::string& array)
{
  auto copy = vtkSmartPointer<vtkImageData>::New();
  copy->CopyStructure(image);
  copy->GetPointData()->SetScalars(image->GetPointData()->GetArray(array.c_str()));
  return copy;
}

std::string point_array_names(vtkDataSet* data)
{
  std::string names;
  for (int i = 0; i < data->GetPointData()->GetNumberOfArrays(); ++i)
  {
    const char* name = data->GetPointData()->GetArrayName(i);
    names += (names.empty() ? "" : ", ") + std::string(name ? name : "(unnamed)");
  }
  return names;
}
} // namespace

Status check_volume(vtkDataSet* data, const std::string& array)
{
  auto* image = vtkImageData::SafeDownCast(data);
  if (!image || image->GetNumberOfPoints() == 0)
  {
    return Status::invalid_input(
      image ? "the image has no samples" : "a volume (a .vti file) is required");
  }
  vtkDataArray* values = image->GetPointData()->GetArray(array.c_str());
  if (!values)
  {
    const std::string available = point_array_names(image);
    return Status::invalid_input("the volume has no point array '" + array + "'" +
      (available.empty() ? std::string("; it has no point arrays") : "; available: " + available));
  }
  if (values->GetNumberOfComponents() != 1)
  {
    return Status::invalid_input("the array '" + array + "' has " +
      std::to_string(values->GetNumberOfComponents()) + " components; expected 1");
  }
  int size[3];
  image->GetDimensions(size);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (size[axis] < 2)
    {
      return Status::invalid_input(std::string("the image is one sample thick along ") +
        "xyz"[axis] + "; a volume needs at least two samples in each direction");
    }
  }
  double lower = 1e300;
  double upper = -1e300;
  vtkIdType bad_count = 0;
  const vtkIdType count = values->GetNumberOfTuples();
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double value = values->GetComponent(i, 0);
    bad_count += !std::isfinite(value);
    lower = std::min(lower, value);
    upper = std::max(upper, value);
  }
  if (bad_count > 0)
  {
    return Status::invalid_input(std::to_string(bad_count) + " of the " + std::to_string(count) +
      " values of '" + array + "' " + (bad_count == 1 ? "is" : "are") + " not finite");
  }
  Status status;
  status.report.set("volume.samples", count);
  status.report.set("volume.minimum", lower);
  status.report.set("volume.maximum", upper);
  return status;
}

vtkSmartPointer<vtkPolyData> isosurface(vtkImageData* image, const std::string& array, double level)
{
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputData(with_array_only(image, array));
  edges->SetValue(0, level);
  edges->ComputeNormalsOn();
  edges->ComputeScalarsOff();
  edges->Update();
  return edges->GetOutput();
}

vtkSmartPointer<vtkPolyData> slice(
  vtkImageData* image, const std::string& array, const Vec3& origin, const Vec3& normal)
{
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(origin.x(), origin.y(), origin.z());
  plane->SetNormal(normal.x(), normal.y(), normal.z());
  vtkNew<vtkFlyingEdgesPlaneCutter> cutter;
  cutter->SetInputData(with_array_only(image, array));
  cutter->SetPlane(plane);
  cutter->ComputeNormalsOff();
  cutter->InterpolateAttributesOn();
  cutter->Update();
  return cutter->GetOutput();
}

bool value_at(vtkImageData* image, const std::string& array, const Vec3& position, double& value)
{
  // Clamp the position to the image, so that rounding does not exclude positions on the border.
  double bounds[6];
  image->GetBounds(bounds);
  const double slack = 1e-6 * image->GetLength();
  double p[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    p[axis] = std::clamp(position[axis], bounds[2 * axis], bounds[2 * axis + 1]);
    if (std::abs(p[axis] - position[axis]) > slack)
    {
      return false;
    }
  }
  double parameters[3];
  double weights[8];
  int sub = 0;
  const vtkIdType cell = image->FindCell(p, nullptr, -1, 0.0, sub, parameters, weights);
  vtkDataArray* values = image->GetPointData()->GetArray(array.c_str());
  if (cell < 0 || !values)
  {
    return false;
  }
  vtkNew<vtkIdList> corners;
  image->GetCellPoints(cell, corners);
  value = 0.0;
  for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
  {
    value += weights[k] * values->GetComponent(corners->GetId(k), 0);
  }
  return true;
}

double surface_area(vtkPolyData* surface)
{
  double area = 0.0;
  vtkNew<vtkIdList> ids;
  vtkCellArray* polygons = surface->GetPolys();
  for (vtkIdType f = 0; f < surface->GetNumberOfPolys(); ++f)
  {
    polygons->GetCellAtId(f, ids);
    const Vec3 first(surface->GetPoint(ids->GetId(0)));
    for (vtkIdType k = 2; k < ids->GetNumberOfIds(); ++k)
    {
      const Vec3 a(surface->GetPoint(ids->GetId(k - 1)));
      const Vec3 b(surface->GetPoint(ids->GetId(k)));
      area += 0.5 * (a - first).cross(b - first).norm();
    }
  }
  return area;
}

Box occupied_box(vtkImageData* image, const std::string& array, const std::vector<double>& levels,
  bool include_nonzero)
{
  Box box;
  const auto add = [&](vtkIdType sample) { box.add(Vec3(image->GetPoint(sample))); };
  vtkDataArray* values = image->GetPointData()->GetArray(array.c_str());
  int size[3];
  image->GetDimensions(size);
  const vtkIdType steps[3] = { 1, size[0], static_cast<vtkIdType>(size[0]) * size[1] };
  vtkIdType sample = 0;
  for (int z = 0; z < size[2]; ++z)
  {
    for (int y = 0; y < size[1]; ++y)
    {
      for (int x = 0; x < size[0]; ++x, ++sample)
      {
        const double value = values->GetComponent(sample, 0);
        if (include_nonzero && std::abs(value) > 0.1)
        {
          add(sample);
        }
        const bool last[3] = { x + 1 == size[0], y + 1 == size[1], z + 1 == size[2] };
        for (int axis = 0; axis < 3; ++axis)
        {
          const double next = last[axis] ? value : values->GetComponent(sample + steps[axis], 0);
          for (const double level : levels)
          {
            if ((value < level) != (next < level))
            {
              add(sample);
              add(sample + steps[axis]);
            }
          }
        }
      }
    }
  }
  if (box.empty())
  {
    double bounds[6];
    image->GetBounds(bounds);
    box.add(Vec3(bounds[0], bounds[2], bounds[4]));
    box.add(Vec3(bounds[1], bounds[3], bounds[5]));
  }
  return box;
}

} // namespace bindpose
