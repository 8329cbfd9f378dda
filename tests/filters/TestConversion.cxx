// Conversion between VTK datasets and kernel arrays. Memory is shared if the layouts allow it, and
// reports and handles survive the round trip.
#include "conversion.h"
#include "report_field_data.h"

#include "support/meshes.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

TEST(Conversion, DoublePointsAndTrianglesAreShared)
{
  const TriangleMesh mesh = test::cube();
  const auto data = to_polydata(mesh.points, mesh.triangles);
  SurfaceInput surface;
  ASSERT_TRUE(to_surface(data, surface).ok());
  EXPECT_TRUE(surface.points.shared());
  EXPECT_TRUE(surface.triangles.shared());
  EXPECT_TRUE(surface.cell_of_triangle.empty());
  EXPECT_EQ(surface.points.view(), mesh.points);
  EXPECT_EQ(surface.triangles.view(), mesh.triangles);

  const TetMesh box = test::tet_box(2, 2, 2);
  TetInput tets;
  const auto grid = to_unstructured_grid(box.points, box.tets);
  ASSERT_TRUE(to_tets(grid, tets).ok());
  EXPECT_TRUE(tets.tets.shared());
  EXPECT_EQ(tets.tets.view(), box.tets);
}

TEST(Conversion, PolygonsBecomeTriangles)
{
  vtkNew<vtkPlaneSource> plane; // the source makes quads and float points
  plane->SetResolution(3, 2);
  plane->Update();
  SurfaceInput surface;
  ASSERT_TRUE(to_surface(plane->GetOutput(), surface).ok());
  EXPECT_EQ(surface.triangles.view().rows(), 12);
  EXPECT_EQ(surface.triangulated_cells, 6);
  EXPECT_EQ(surface.cell_of_triangle[3], 1);
  EXPECT_NEAR(surface_area(surface.points.view(), surface.triangles.view()), 1.0, 1e-6);
}

TEST(Conversion, WhatIsNoSurfaceIsNamed)
{
  SurfaceInput surface;
  vtkNew<vtkPolyData> empty;
  EXPECT_NE(to_surface(empty, surface).message.find("empty"), std::string::npos);
  EXPECT_NE(to_surface(nullptr, surface).message.find("missing"), std::string::npos);
  TetInput tets;
  EXPECT_NE(to_tets(empty, tets).message.find("vtkPolyData"), std::string::npos);
  vtkNew<vtkPolyData> bad;
  const TriangleMesh mesh = test::cube();
  bad->ShallowCopy(to_polydata(Points(mesh.points.topRows(7)), mesh.triangles));
  EXPECT_NE(to_surface(bad, surface).message.find("vertex 7"), std::string::npos);
}

/// VTK does not check the offsets. With wrong offsets it would read beyond the end of the ids.
TEST(Conversion, OffsetsThatAreNotValidAreRefused)
{
  const TriangleMesh cube = test::cube();
  for (const int change : { 0, 1, 2, 3 })
  {
    const auto surface = to_polydata(cube.points, cube.triangles);
    vtkNew<vtkTypeInt64Array> offsets;
    for (vtkIdType k = 0; k <= 12; ++k)
    {
      offsets->InsertNextValue(3 * k);
    }
    const vtkIdType place[] = { 0, 12, 5, 5 };
    const vtkTypeInt64 wrong[] = { 3, 39, -3, 33 };
    offsets->SetValue(place[change], wrong[change]);
    vtkNew<vtkCellArray> cells;
    cells->SetData(
      offsets, vtkTypeInt64Array::SafeDownCast(surface->GetPolys()->GetConnectivityArray64()));
    surface->SetPolys(cells);
    SurfaceInput input;
    EXPECT_NE(to_surface(surface, input).message.find("offsets"), std::string::npos) << change;
  }
}

TEST(Conversion, CoordinatesOutOfRangeAreRefused)
{
  TriangleMesh cube = test::cube();
  cube.points(3, 1) = 1e110;
  SurfaceInput surface;
  EXPECT_NE(to_surface(to_polydata(cube.points, cube.triangles), surface)
              .message.find("coordinate y of point 3 is 1e+110"),
    std::string::npos);
  TetMesh box = test::tet_box(1, 1, 1);
  box.points.col(2).array() += 1e15;
  TetInput tets;
  EXPECT_NE(to_tets(to_unstructured_grid(box.points, box.tets), tets)
              .message.find("the tet mesh is too far from the origin"),
    std::string::npos);
}

TEST(Conversion, HandlesSurviveTheRoundTrip)
{
  Handles handles(3);
  handles[0].name = "hip";
  handles[0].head = handles[0].tail = Vec3(1, 2, 3);
  handles[1].name = "thigh";
  handles[1].kind = HandleKind::bone;
  handles[1].head = Vec3(1, 2, 3);
  handles[1].tail = Vec3(1, 0, 3);
  handles[2] = handles[1];
  handles[2].name = "shin";
  handles[2].head = Vec3(1, 0, 3);
  handles[2].tail = Vec3(1, -2, 3);
  handles[2].parent = 1;
  const auto data = to_polydata(handles);
  Handles back;
  std::vector<Index> cells;
  ASSERT_TRUE(to_handles(data, back, &cells).ok());
  ASSERT_EQ(back.size(), 3u);
  EXPECT_EQ(back[1].name, "thigh");
  EXPECT_EQ(back[2].parent, 1);
  EXPECT_EQ(back[2].kind, HandleKind::bone);
  EXPECT_EQ(back[2].tail, Vec3(1, -2, 3));
  Pose pose;
  ASSERT_TRUE(to_pose(data, back, cells, pose).ok());
  EXPECT_EQ(pose[0].transform, identity_affine());
  pose[1].mode = HandleMode::position;
  pose[1].transform(0, 3) = 5.0;
  set_pose(data, cells, pose);
  Pose again;
  ASSERT_TRUE(to_pose(data, back, cells, again).ok());
  EXPECT_EQ(again[1].mode, HandleMode::position);
  EXPECT_EQ(again[1].transform(0, 3), 5.0);
}

TEST(Conversion, PlainPointsAndLinesAreHandles)
{
  const TriangleMesh mesh = test::cube();
  vtkNew<vtkPolyData> data;
  data->SetPoints(to_vtk_points(mesh.points));
  vtkNew<vtkCellArray> verts;
  const vtkIdType v = 3;
  verts->InsertNextCell(1, &v);
  vtkNew<vtkCellArray> lines;
  const vtkIdType ends[2] = { 0, 7 };
  lines->InsertNextCell(2, ends);
  data->SetVerts(verts);
  data->SetLines(lines);
  Handles handles;
  ASSERT_TRUE(to_handles(data, handles).ok());
  ASSERT_EQ(handles.size(), 2u);
  EXPECT_EQ(handles[0].name, "p1");
  EXPECT_EQ(handles[1].name, "b1");
  EXPECT_EQ(handles[1].kind, HandleKind::bone);
}

TEST(Conversion, ValuesOfHandlesMustBeIntegers)
{
  Handles handles(2);
  handles[0].name = "left";
  handles[1].name = "right";
  handles[1].head = handles[1].tail = Vec3(1, 0, 0);
  for (const std::string name : { "HandleKind", "RegionId", "Ownership", "Parent", "Mode" })
  {
    for (const double value : { 0.5, std::nan(""), HUGE_VAL, -1e300 })
    {
      const auto data = to_polydata(handles);
      vtkNew<vtkDoubleArray> values;
      values->SetName(name.c_str());
      values->InsertNextValue(name == "Parent" ? -1.0 : 0.0);
      values->InsertNextValue(value);
      data->GetCellData()->AddArray(values);
      Handles back;
      std::vector<Index> cells;
      Status status = to_handles(data, back, &cells);
      if (name == "Mode")
      {
        ASSERT_TRUE(status.ok()) << status.message;
        Pose pose;
        status = to_pose(data, back, cells, pose);
      }
      EXPECT_EQ(status.code, StatusCode::invalid_input);
      EXPECT_EQ(status.message.find(name + " of handle cell 1 must be an integer, not "), 0u)
        << status.message;
    }
  }
}

TEST(Conversion, ReportsSurviveFieldData)
{
  Report report;
  report.set("status", "invalid_input");
  report.set("message", "the surface is empty");
  report.set("counts.vertices", 8);
  report.set("handles[].name", Report::Value(std::vector<std::string>{ "only" }));
  report.set("largest_stretch", Report::Value(0.25));
  Report of_run = report;
  for (const char* key : { "seconds.solve", "rungs[].seconds", "microseconds_per_iteration",
         "peak_memory_bytes", "memory_estimate_bytes" })
  {
    of_run.set(key, Report::Value(0.125));
  }
  vtkNew<vtkPolyData> data;
  attach_report(data, of_run);
  const Report back = read_report(data);
  EXPECT_EQ(back.entries(), report.entries());
  const Status status = upstream_failure(data);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_EQ(status.message, "the surface is empty");
  attach_report(data, Report());
  EXPECT_TRUE(read_report(data).empty());
}
