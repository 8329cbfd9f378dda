#include "render/shapes.h"

#include "conversion.h"
#include "support/meshes.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>

namespace bindpose::test
{
namespace
{
vtkSmartPointer<vtkDoubleArray> linear_weights(PointsView points)
{
  const Box box = bounding_box(points);
  auto weights = vtkSmartPointer<vtkDoubleArray>::New();
  weights->SetName("Weights");
  weights->SetNumberOfComponents(2);
  weights->SetComponentName(0, "left");
  weights->SetComponentName(1, "right");
  weights->SetNumberOfTuples(points.rows());
  for (Index v = 0; v < points.rows(); ++v)
  {
    const double s = (points(v, 0) - box.lower[0]) / box.size()[0];
    weights->SetTuple2(v, 1.0 - s, s);
  }
  return weights;
}
} // namespace

const Vec3 sphere_centers[3] = { Vec3(-0.8, 0.0, 0.0), Vec3(0.1, 0.0, 0.0), Vec3(1.9, 0.0, 0.0) };
const double sphere_radius = 0.75;

vtkSmartPointer<vtkPolyData> sphere_and_cube()
{
  const TriangleMesh mesh =
    join(translated(sphere(4), Vec3(-1.2, 0, 0)), translated(cube(-0.8, 0.8), Vec3(1.2, 0, 0)));
  return to_polydata(mesh.points, mesh.triangles);
}

vtkSmartPointer<vtkPolyData> finger()
{
  TriangleMesh mesh = sphere(4);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    auto p = mesh.points.row(v);
    p[0] *= 2.0;
    p[1] *= 0.8;
    p[2] *= 0.7;
    p[1] += 0.5 * std::cos(0.8 * p[0]);
  }
  auto data = to_polydata(mesh.points, mesh.triangles);
  data->GetPointData()->AddArray(linear_weights(mesh.points));
  return data;
}

double right_weight(const Vec3& p)
{
  return (p[0] + 2.0) / 4.0;
}

vtkSmartPointer<vtkImageData> three_spheres()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(100, 56, 40);
  image->SetSpacing(0.05, 0.05, 0.05);
  image->SetOrigin(-2.0, -1.375, -0.975);
  vtkNew<vtkDoubleArray> values;
  values->SetName("WindingNumber");
  values->SetNumberOfValues(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    Vec3 p;
    image->GetPoint(i, p.data());
    double w = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const bool inside = (p - sphere_centers[k]).norm() < sphere_radius;
      w += (k == 2 ? -1.0 : 1.0) * inside;
    }
    values->SetValue(i, w);
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

vtkSmartPointer<vtkImageData> cone_field()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(49, 49, 49);
  image->SetSpacing(3.2 / 48, 3.2 / 48, 3.2 / 48);
  image->SetOrigin(-1.6, -1.6, -1.6);
  vtkNew<vtkDoubleArray> values;
  values->SetName("WindingNumber");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    values->InsertNextValue(1.5 - Vec3(image->GetPoint(i)).norm());
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

vtkSmartPointer<vtkPolyData> two_circles()
{
  constexpr int count = 120;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkIntArray> multiplicity;
  multiplicity->SetName("Multiplicity");
  for (const double y : { -0.5, 0.5 })
  {
    const vtkIdType first = points->GetNumberOfPoints();
    lines->InsertNextCell(count + 1);
    for (int i = 0; i <= count; ++i)
    {
      const double angle = 2.0 * 3.14159265358979323846 * i / count;
      if (i < count)
      {
        points->InsertNextPoint(std::cos(angle), y, std::sin(angle));
      }
      lines->InsertCellPoint(first + i % count);
    }
    multiplicity->InsertNextValue(y < 0.0 ? -1 : 2);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(lines);
  data->GetCellData()->AddArray(multiplicity);
  return data;
}

vtkSmartPointer<vtkUnstructuredGrid> tet_brick()
{
  TetMesh mesh = tet_box(8, 5, 6, Vec3(0, 0, 0), Vec3(1.6, 1.0, 1.2));
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    mesh.points(v, 2) += 0.15 * std::sin(4.0 * mesh.points(v, 0));
  }
  auto grid = to_unstructured_grid(mesh.points, mesh.tets);
  grid->GetPointData()->AddArray(linear_weights(mesh.points));
  return grid;
}

vtkSmartPointer<vtkPolyData> handle_row()
{
  Handles handles(4);
  const char* names[4] = { "a", "b", "c", "bone" };
  for (int i = 0; i < 4; ++i)
  {
    handles[i].name = names[i];
    handles[i].head = handles[i].tail = Vec3(i - 1.0, -0.4, 0.0);
  }
  handles[3].kind = HandleKind::bone;
  handles[3].head = Vec3(-1.2, 0.4, 0.0);
  handles[3].tail = Vec3(1.2, 0.6, 0.0);
  auto data = to_polydata(handles);
  auto* modes = data->GetCellData()->GetArray("Mode");
  modes->SetComponent(1, 0, 1);
  modes->SetComponent(2, 0, 2);
  return data;
}

PictureOptions small_picture()
{
  PictureOptions options;
  options.width = 400;
  options.height = 300;
  options.legend = false;
  return options;
}

} // namespace bindpose::test
