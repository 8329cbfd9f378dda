// vtkSurfaceDefects: every defect of a surface becomes a cell with its type and its source.
#include "vtkSurfaceDefects.h"
#include "vtkTetrahedralizeSurface.h"

#include "TestFilter.h"
#include "conversion.h"

#include "support/meshes.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>

using namespace bindpose;
using namespace bindpose::test;
using testing::HasSubstr;

namespace
{
/// Count the cells for each value of the array `Defect`.
std::map<int, int> counts(vtkDataSet* data)
{
  std::map<int, int> result;
  auto* defects = vtkIntArray::SafeDownCast(data->GetCellData()->GetArray("Defect"));
  EXPECT_TRUE(defects);
  for (vtkIdType c = 0; defects && c < data->GetNumberOfCells(); ++c)
  {
    result[defects->GetValue(c)] += 1;
  }
  return result;
}

template <typename Array>
Array* cell_array(vtkDataSet* data, const char* name)
{
  auto* array = Array::SafeDownCast(data->GetCellData()->GetAbstractArray(name));
  EXPECT_TRUE(array) << name;
  return array;
}
} // namespace

TEST(SurfaceDefectsFilter, CellsAndArrays)
{
  // The surface consists of an open cube and a distant second cube, which is inside out. It also
  // has a duplicate triangle and an unused point.
  TriangleMesh mesh = join(open_cube(), translated(flipped(cube()), Vec3(5.0, 0.0, 0.0)));
  const Index t = mesh.triangles.rows();
  mesh.triangles.conservativeResize(t + 1, 3);
  mesh.triangles.row(t) = mesh.triangles.row(8); // the duplicated triangle is not at the rim
  const Index v = mesh.points.rows();
  mesh.points.conservativeResize(v + 1, 3);
  mesh.points.row(v) << 1.0, 2.0, 9.0;

  vtkNew<vtkSurfaceDefects> filter;
  filter->SetInputData(to_polydata(mesh.points, mesh.triangles));
  filter->Update();
  ASSERT_EQ(filter->GetStatus(), vtkSurfaceDefects::OK) << filter->GetStatusMessage();
  auto* out = vtkPolyData::SafeDownCast(filter->GetOutput());
  const std::map<int, int> expected{ { vtkSurfaceDefects::UNREFERENCED_VERTEX, 1 },
    { vtkSurfaceDefects::BOUNDARY_EDGE, 4 }, { vtkSurfaceDefects::NONMANIFOLD_EDGE, 3 },
    { vtkSurfaceDefects::DUPLICATE_TRIANGLE, 1 }, { vtkSurfaceDefects::INWARD_COMPONENT, 12 } };
  EXPECT_EQ(counts(out), expected);
  EXPECT_EQ(out->GetNumberOfVerts(), 1);
  EXPECT_EQ(out->GetNumberOfLines(), 7);
  EXPECT_EQ(out->GetNumberOfPolys(), 13);
  EXPECT_THAT(filter->GetReportJSON(), HasSubstr("\"boundary_edges\": 4"));

  auto* names = cell_array<vtkStringArray>(out, "DefectName");
  auto* cells = cell_array<vtkIdTypeArray>(out, "OriginalCellIds");
  auto* crossed = cell_array<vtkIdTypeArray>(out, "CrossedCellIds");
  auto* components = cell_array<vtkIdTypeArray>(out, "Component");
  auto* points = vtkIdTypeArray::SafeDownCast(out->GetPointData()->GetArray("OriginalPointIds"));
  ASSERT_TRUE(names && cells && crossed && components && points);
  EXPECT_EQ(names->GetValue(0), "unreferenced vertex");
  EXPECT_EQ(names->GetValue(1), "boundary edge");
  EXPECT_EQ(components->GetValue(0), -1);
  for (vtkIdType c = 0; c < out->GetNumberOfCells(); ++c)
  {
    const std::string name = names->GetValue(c);
    EXPECT_EQ(cells->GetValue(c) >= 0, out->GetCellType(c) == VTK_TRIANGLE);
    EXPECT_EQ(crossed->GetValue(c) >= 0, name == "crossing triangle");
    if (name == "duplicate triangle")
    {
      EXPECT_EQ(cells->GetValue(c), t);
    }
    if (name == "inward component")
    {
      EXPECT_EQ(components->GetValue(c), 1);
    }
    vtkIdList* ids = filter->GetOutput()->GetCell(c)->GetPointIds();
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      double p[3];
      out->GetPoint(ids->GetId(k), p);
      EXPECT_EQ(Vec3(mesh.points.row(points->GetValue(ids->GetId(k)))), Vec3(p[0], p[1], p[2]));
    }
  }
}

TEST(SurfaceDefectsFilter, CellIdsAreThoseOfPolygons)
{
  // A square occurs twice. The two triangles of the second copy are duplicates of cell 1.
  vtkNew<vtkPolyData> squares;
  const TriangleMesh flat = grid(1, 1);
  squares->SetPoints(to_vtk_points(flat.points));
  vtkNew<vtkCellArray> polys;
  for (int twice = 0; twice < 2; ++twice)
  {
    polys->InsertNextCell({ 0, 1, 3, 2 });
  }
  squares->SetPolys(polys);
  vtkNew<vtkSurfaceDefects> filter;
  filter->SetInputData(squares);
  filter->Update();
  ASSERT_EQ(filter->GetStatus(), vtkSurfaceDefects::OK) << filter->GetStatusMessage();
  auto* out = vtkPolyData::SafeDownCast(filter->GetOutput());
  EXPECT_EQ(counts(out)[vtkSurfaceDefects::DUPLICATE_TRIANGLE], 2);
  auto* cells = cell_array<vtkIdTypeArray>(out, "OriginalCellIds");
  auto* names = cell_array<vtkStringArray>(out, "DefectName");
  for (vtkIdType c = 0; c < out->GetNumberOfCells(); ++c)
  {
    if (names->GetValue(c) == "duplicate triangle")
    {
      EXPECT_EQ(cells->GetValue(c), 1);
    }
  }
}

TEST(SurfaceDefectsFilter, IsTheSecondOutputOfTheTets)
{
  const TriangleMesh mesh = open_cube();
  vtkNew<vtkSurfaceDefects> alone;
  vtkNew<vtkTetrahedralizeSurface> tets;
  for (vtkBindposeAlgorithm* filter :
    { static_cast<vtkBindposeAlgorithm*>(alone), static_cast<vtkBindposeAlgorithm*>(tets) })
  {
    filter->SetInputData(to_polydata(mesh.points, mesh.triangles));
    filter->Update();
    ASSERT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::OK) << filter->GetStatusMessage();
  }
  EXPECT_EQ(counts(tets->GetOutput(1)), counts(alone->GetOutput()));
  EXPECT_EQ(tets->GetOutput(1)->GetNumberOfCells(), 4);
  EXPECT_GT(tets->GetOutput(0)->GetNumberOfCells(), 0);
}

TEST(SurfaceDefectsFilter, BadInputIsOneSentenceAndAnEmptyOutput)
{
  TriangleMesh mesh = cube();
  mesh.points(3, 1) = std::numeric_limits<double>::quiet_NaN();
  vtkNew<vtkSurfaceDefects> filter;
  vtkNew<Listener> listener;
  listener->listen(filter);
  filter->SetInputData(to_polydata(mesh.points, mesh.triangles));
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkSurfaceDefects::INVALID_INPUT);
  EXPECT_EQ(listener->errors.size(), 1u);
  EXPECT_THAT(filter->GetStatusMessage(), HasSubstr("3"));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  filter->SetInputData(vtkSmartPointer<vtkPolyData>::New());
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkSurfaceDefects::INVALID_INPUT);
}
