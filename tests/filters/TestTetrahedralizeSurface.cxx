// vtkTetrahedralizeSurface: ports, arrays, report, errors, no repeated execution, abort.
#include "TestFilter.h"

#include "conversion.h"
#include "report_field_data.h"
#include "support/meshes.h"
#include "support/needs_mesher.h"
#include "support/stand_in.h"
#include "vtkBoundedBiharmonicWeights.h"
#include "vtkTetrahedralizeSurface.h"

#include "vtkAppendFilter.h"
#include "vtkCellData.h"
#include "vtkCubeSource.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <sstream>

using namespace bindpose;
using bindpose::test::Listener;
using testing::HasSubstr;

namespace
{
/// Tests that require the helper program.
class TetrahedralizeSurfaceByHelper : public test::MesherTest
{
};

vtkUnstructuredGrid* grid_of(vtkTetrahedralizeSurface* filter)
{
  return vtkUnstructuredGrid::SafeDownCast(filter->GetOutput());
}

double volume_of(vtkUnstructuredGrid* grid)
{
  TetInput tets;
  const Status status = to_tets(grid, tets);
  EXPECT_TRUE(status.ok()) << status.message;
  return status.ok() ? tet_volumes(tets.points.view(), tets.tets.view()).sum() : 0.0;
}
} // namespace

TEST(TetrahedralizeSurface, ArraysAndReport)
{
  const TriangleMesh sphere = test::sphere(2);
  vtkNew<vtkTetrahedralizeSurface> filter;
  filter->SetInputData(to_polydata(sphere.points, sphere.triangles));
  filter->Update();
  ASSERT_EQ(filter->GetStatus(), vtkTetrahedralizeSurface::OK) << filter->GetStatusMessage();
  vtkUnstructuredGrid* grid = grid_of(filter);
  ASSERT_NE(grid, nullptr);
  EXPECT_NEAR(volume_of(grid), signed_volume(sphere.points, sphere.triangles), 0.1);
  auto* ids = vtkIdTypeArray::SafeDownCast(grid->GetPointData()->GetArray("OriginalPointIds"));
  auto* winding = vtkDoubleArray::SafeDownCast(grid->GetCellData()->GetArray("WindingNumber"));
  ASSERT_NE(ids, nullptr);
  ASSERT_NE(winding, nullptr);
  EXPECT_EQ(ids->GetNumberOfTuples(), grid->GetNumberOfPoints());
  EXPECT_EQ(winding->GetNumberOfTuples(), grid->GetNumberOfCells());
  for (vtkIdType v = 0; v < grid->GetNumberOfPoints(); ++v)
  {
    const vtkIdType id = ids->GetValue(v);
    ASSERT_LT(id, sphere.points.rows());
    if (id >= 0)
    {
      const Vec3 p(grid->GetPoint(v));
      EXPECT_EQ(p, Vec3(sphere.points.row(id)));
    }
  }
  const Report report = read_report(grid);
  EXPECT_EQ(report.text("status"), "ok");
  EXPECT_FALSE(report.text("method").empty());
  EXPECT_EQ(report.number("counts.tets", -1), grid->GetNumberOfCells());
  EXPECT_EQ(report.number("counts.triangles", -1), sphere.triangles.rows());
  EXPECT_NEAR(report.number("volume", -1), volume_of(grid), 1e-12);
  EXPECT_GT(report.number("winding_volume", -1), 0.0);
  EXPECT_GT(report.number("min_dihedral_angle", -1), 0.0);
  EXPECT_GE(filter->GetReport().number("seconds.tetrahedralize", -1), 0.0);
  EXPECT_NE(report.find("rungs[].name"), nullptr);
}

TEST(TetrahedralizeSurface, EveryTetKnowsItsLabelAndAngle)
{
  const TriangleMesh sphere = test::sphere(2);
  vtkNew<vtkTetrahedralizeSurface> filter;
  filter->SetInputData(to_polydata(sphere.points, sphere.triangles));
  for (const int method : { vtkTetrahedralizeSurface::REMESH, vtkTetrahedralizeSurface::EMBED })
  {
    filter->SetMethod(method);
    filter->Update();
    ASSERT_EQ(filter->GetStatus(), vtkTetrahedralizeSurface::OK) << filter->GetStatusMessage();
    vtkUnstructuredGrid* grid = grid_of(filter);
    const bool embed = method == vtkTetrahedralizeSurface::EMBED;
    vtkDataArray* labels = grid->GetCellData()->GetArray("Label");
    vtkDataArray* winding = grid->GetCellData()->GetArray("WindingNumber");
    vtkDataArray* angles = grid->GetCellData()->GetArray("MinDihedralAngle");
    ASSERT_TRUE(labels && winding && angles);
    double smallest = 180.0;
    for (vtkIdType t = 0; t < grid->GetNumberOfCells(); ++t)
    {
      const bool above = winding->GetComponent(t, 0) >= 0.5;
      EXPECT_EQ(labels->GetComponent(t, 0), above ? 1 : embed ? 0 : 2);
      smallest = std::min(smallest, angles->GetComponent(t, 0));
    }
    EXPECT_NEAR(smallest, read_report(filter->GetOutput()).number("min_dihedral_angle", -1), 1e-9);
    auto* name = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray("Method"));
    ASSERT_NE(name, nullptr);
    EXPECT_EQ(name->GetValue(0), embed ? "embed" : "remesh");
  }
  filter->KeepOutsideOn();
  vtkNew<Listener> listener;
  listener->listen(filter);
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkTetrahedralizeSurface::INVALID_INPUT);
  EXPECT_THAT(filter->GetStatusMessage(), HasSubstr("cdt"));
}

TEST(TetrahedralizeSurface, PolygonsAndUnstructuredGridsAreSurfaces)
{
  vtkNew<vtkCubeSource> cube; // the source makes quads that do not share points
  vtkNew<vtkAppendFilter> grid;
  grid->SetInputConnection(cube->GetOutputPort());
  vtkNew<vtkTetrahedralizeSurface> filter;
  for (vtkAlgorithm* source :
    { static_cast<vtkAlgorithm*>(cube), static_cast<vtkAlgorithm*>(grid) })
  {
    filter->SetInputConnection(source->GetOutputPort());
    filter->Update();
    ASSERT_EQ(filter->GetStatus(), vtkTetrahedralizeSurface::OK) << filter->GetStatusMessage();
    EXPECT_NEAR(volume_of(grid_of(filter)), 1.0, 0.05);
    EXPECT_EQ(read_report(filter->GetOutput()).number("counts.triangulated_cells", -1), 6);
  }
}

TEST(TetrahedralizeSurface, LatticeMethods)
{
  const TriangleMesh cube = test::open_cube();
  vtkNew<vtkTetrahedralizeSurface> filter;
  filter->SetInputData(to_polydata(cube.points, cube.triangles));
  filter->SetResolution(10);
  filter->SetMethodToRemesh();
  filter->Update();
  EXPECT_NEAR(volume_of(grid_of(filter)), 8.0, 0.5);
  EXPECT_EQ(read_report(filter->GetOutput()).text("method"), "remesh");
  filter->SetMethodToEmbed();
  filter->Update();
  EXPECT_GT(volume_of(grid_of(filter)), 8.0);
  EXPECT_EQ(read_report(filter->GetOutput()).text("method"), "embed");
  auto* ids =
    vtkIdTypeArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetArray("OriginalPointIds"));
  ASSERT_NE(ids, nullptr);
  EXPECT_EQ(ids->GetRange()[1], -1.0);
}

TEST_F(TetrahedralizeSurfaceByHelper, WrapHoldsASheet)
{
  const TriangleMesh sheet = test::grid(3, 2);
  vtkNew<vtkTetrahedralizeSurface> filter;
  filter->SetInputData(to_polydata(sheet.points, sheet.triangles));
  filter->SetMethodToWrap();
  filter->SetWrapAlpha(0.1);
  filter->SetWrapOffset(0.01);
  filter->Update();
  ASSERT_EQ(filter->GetStatus(), vtkTetrahedralizeSurface::OK) << filter->GetStatusMessage();
  // The tets fill a shell: the space within the distance `offset` of the sheet. The thickness of
  // the shell is 2 * offset, and its rim is round.
  const double diagonal = bounding_box(sheet.points).diagonal();
  const double offset = 0.01 * diagonal;
  const double area = surface_area(sheet.points, sheet.triangles);
  EXPECT_GT(volume_of(grid_of(filter)), 1.8 * offset * area);
  EXPECT_LT(
    volume_of(grid_of(filter)), 2.0 * offset * area + 4.0 * diagonal * 4.0 * offset * offset);
  const Report report = read_report(filter->GetOutput());
  EXPECT_EQ(report.text("method"), "wrap");
  EXPECT_GT(report.number("counts.wrap_triangles", 0), 0);
  EXPECT_GE(report.number("distance_max", 0), 0.99);
  auto* ids =
    vtkIdTypeArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetArray("OriginalPointIds"));
  ASSERT_NE(ids, nullptr);
  EXPECT_EQ(ids->GetRange()[1], -1.0);
  filter->SetWrapOffset(-1.0);
  vtkNew<Listener> listener;
  listener->listen(filter);
  filter->Update();
  ASSERT_EQ(listener->errors.size(), 1u);
  EXPECT_THAT(listener->errors[0], HasSubstr("wrap_offset"));
}

TEST(TetrahedralizeSurface, FtetwildIsSaidToBeMissing)
{
  const test::Environment nowhere("BINDPOSE_FTETWILD", "/nowhere/ftetwild");
  const TriangleMesh cube = test::cube();
  vtkNew<vtkTetrahedralizeSurface> filter;
  vtkNew<Listener> listener;
  listener->listen(filter);
  filter->SetInputData(to_polydata(cube.points, cube.triangles));
  filter->SetMethodToFtetwild();
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkTetrahedralizeSurface::UNAVAILABLE);
  ASSERT_EQ(listener->errors.size(), 1u);
  EXPECT_THAT(listener->errors[0], HasSubstr("/nowhere/ftetwild"));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
}

TEST(TetrahedralizeSurface, EmbedBindsTheSurface)
{
  const TriangleMesh sphere = test::sphere(3);
  vtkNew<vtkTetrahedralizeSurface> filter;
  filter->SetInputData(to_polydata(sphere.points, sphere.triangles));
  filter->SetMethodToEmbed();
  filter->Update();
  ASSERT_EQ(filter->GetStatus(), vtkTetrahedralizeSurface::OK) << filter->GetStatusMessage();
  auto* grid = grid_of(filter);
  EXPECT_GE(grid->GetNumberOfCells(), 15000);
  EXPECT_LE(grid->GetNumberOfCells(), 60000);
  EXPECT_GE(read_report(grid).number("min_dihedral_angle", -1), 30.0);
  auto* fractions = vtkDoubleArray::SafeDownCast(grid->GetCellData()->GetArray("InsideFraction"));
  ASSERT_NE(fractions, nullptr);
  TetInput tets;
  ASSERT_TRUE(to_tets(grid, tets).ok());
  const Eigen::VectorXd volumes = tet_volumes(tets.points.view(), tets.tets.view());
  double inside = 0.0;
  for (Index t = 0; t < volumes.size(); ++t)
  {
    inside += fractions->GetValue(t) * volumes[t];
  }
  const double volume = signed_volume(sphere.points, sphere.triangles);
  EXPECT_NEAR(inside, volume, 0.01 * volume);

  auto* bound = vtkPolyData::SafeDownCast(filter->GetOutput(2));
  ASSERT_EQ(bound->GetNumberOfPoints(), sphere.points.rows());
  EXPECT_EQ(bound->GetNumberOfCells(), sphere.triangles.rows());
  auto* cells = vtkIdTypeArray::SafeDownCast(bound->GetPointData()->GetArray("TetIds"));
  auto* coordinates =
    vtkDoubleArray::SafeDownCast(bound->GetPointData()->GetArray("BarycentricCoordinates"));
  ASSERT_TRUE(cells && coordinates);
  for (Index v = 0; v < sphere.points.rows(); ++v)
  {
    Vec3 p = Vec3::Zero();
    for (int k = 0; k < 4; ++k)
    {
      EXPECT_GE(coordinates->GetComponent(v, k), -1e-12);
      p += coordinates->GetComponent(v, k) *
        tets.points.view().row(tets.tets.view()(cells->GetValue(v), k)).transpose();
    }
    EXPECT_LT((p - sphere.points.row(v).transpose()).norm(), 1e-12);
  }
  // Methods other than EMBED leave output 2 empty and add no array InsideFraction.
  filter->SetMethodToCDT();
  filter->Update();
  EXPECT_EQ(filter->GetOutput(2)->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetOutput(0)->GetCellData()->GetArray("InsideFraction"), nullptr);
}

TEST(TetrahedralizeSurface, SecondUpdateDoesNothing)
{
  const TriangleMesh cube = test::cube();
  vtkNew<vtkTetrahedralizeSurface> filter;
  vtkNew<Listener> listener;
  listener->listen(filter);
  filter->SetInputData(to_polydata(cube.points, cube.triangles));
  filter->Update();
  const vtkMTimeType time = filter->GetOutput()->GetMTime();
  EXPECT_EQ(listener->starts, 1);
  filter->Update();
  filter->SetMethod(filter->GetMethod());
  filter->SetNumberOfThreads(1);
  filter->Update();
  EXPECT_EQ(listener->starts, 1);
  EXPECT_EQ(filter->GetOutput()->GetMTime(), time);
  filter->SetWindingThreshold(0.6);
  filter->Update();
  EXPECT_EQ(listener->starts, 2);
  ASSERT_FALSE(listener->progress.empty());
  EXPECT_TRUE(std::is_sorted(listener->progress.begin(),
    std::max_element(listener->progress.begin(), listener->progress.end())));
}

TEST(TetrahedralizeSurface, ErrorsAreOneSentenceAndAnEmptyOutput)
{
  vtkNew<vtkTetrahedralizeSurface> filter;
  vtkNew<Listener> listener;
  listener->listen(filter);
  const TriangleMesh flat = test::grid(2, 2);
  filter->SetInputData(to_polydata(flat.points, flat.triangles));
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkTetrahedralizeSurface::INVALID_INPUT);
  EXPECT_EQ(filter->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::UserError));
  ASSERT_EQ(listener->errors.size(), 1u);
  EXPECT_THAT(listener->errors[0], HasSubstr("flat"));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(read_report(filter->GetOutput()).text("status"), "invalid_input");
  vtkNew<vtkPolyData> empty;
  filter->SetInputData(empty);
  filter->Update();
  EXPECT_THAT(filter->GetStatusMessage(), HasSubstr("empty"));
  // The filter works again with a valid surface.
  const TriangleMesh cube = test::cube();
  filter->SetInputData(to_polydata(cube.points, cube.triangles));
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkTetrahedralizeSurface::OK);
  EXPECT_EQ(filter->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
}

TEST(TetrahedralizeSurface, AbortKillsTheHelper)
{
  std::optional<test::FakeProgram> helper(
    std::in_place, "BINDPOSE_MESHER", "while true; do echo progress 0.5 >&2; sleep 0.02; done\n");
  const TriangleMesh cube = test::cube();
  vtkNew<vtkTetrahedralizeSurface> filter;
  vtkNew<Listener> listener;
  std::chrono::steady_clock::time_point cancel_time;
  listener->on_progress = [&](vtkAlgorithm* algorithm)
  {
    if (!algorithm->GetAbortExecute() && listener->phases.back() == "tetgen")
    {
      algorithm->SetAbortExecute(1);
      cancel_time = std::chrono::steady_clock::now();
    }
  };
  listener->listen(filter);
  filter->SetInputData(to_polydata(cube.points, cube.triangles));
  filter->Update();
  const double seconds_since_cancel =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - cancel_time).count();
  helper.reset();
  EXPECT_EQ(filter->GetStatus(), vtkTetrahedralizeSurface::CANCELED);
  EXPECT_TRUE(listener->errors.empty());
  EXPECT_LT(seconds_since_cancel, 10.0); // 20 ms on an idle machine
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  // The next update executes the filter again. Without the fake helper, the filter uses the real
  // helper program or, if that is not installed, a lattice.
  filter->SetAbortExecute(0);
  listener->on_progress = nullptr;
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkTetrahedralizeSurface::OK);
}

TEST_F(TetrahedralizeSurfaceByHelper, HandlesArePartOfTheMesh)
{
  Handles handles(3);
  handles[0].name = "spine";
  handles[0].kind = HandleKind::bone;
  handles[0].head = Vec3(-0.5, 0.1, 0.05);
  handles[0].tail = Vec3(0.5, 0.1, 0.05);
  handles[1].name = "eye";
  handles[1].head = handles[1].tail = Vec3(0.2, -0.3, 0.4);
  handles[2].name = "away";
  handles[2].head = handles[2].tail = Vec3(9, 9, 0);
  const TriangleMesh ball = test::sphere(3);
  vtkNew<vtkTetrahedralizeSurface> filter;
  filter->SetInputData(0, to_polydata(ball.points, ball.triangles));
  filter->SetInputData(1, to_polydata(handles));
  filter->Update();
  ASSERT_EQ(filter->GetStatus(), vtkTetrahedralizeSurface::OK);
  const Report report = read_report(filter->GetOutput());
  const auto vertices = std::get<std::vector<std::int64_t>>(*report.find("handles[].vertex"));
  const auto names = std::get<std::vector<std::string>>(*report.find("handles[].name"));
  ASSERT_EQ(vertices.size(), 3u);
  for (std::size_t h = 0; h < 3; ++h)
  {
    const auto handle = std::find_if(
      handles.begin(), handles.end(), [&](const Handle& one) { return one.name == names[h]; });
    ASSERT_NE(handle, handles.end());
    if (names[h] == "away")
    {
      EXPECT_EQ(vertices[h], -1);
      continue;
    }
    ASSERT_GE(vertices[h], 0);
    EXPECT_EQ(Vec3(filter->GetOutput()->GetPoint(vertices[h])), handle->head);
  }
  // The tets already have vertices at the handles inside of the ball. The weights filter therefore
  // inserts no vertices.
  handles.pop_back();
  vtkNew<vtkBoundedBiharmonicWeights> weights;
  weights->SetInputData(0, filter->GetOutput());
  weights->SetInputData(1, to_polydata(handles));
  weights->Update();
  EXPECT_EQ(read_report(weights->GetOutput()).number("counts.inserted_vertices", -1), 0);
}

TEST(TetrahedralizeSurface, PrintsItsParameters)
{
  vtkNew<vtkTetrahedralizeSurface> filter;
  std::ostringstream text;
  filter->Print(text);
  for (const char* word : { "Method: auto", "WindingThreshold: 0.5", "Resolution: 0",
         "Segmentation: graph-cut", "CutSmoothness: 1", "CutSigma: 0.1", "TimeLimit: 0",
         "MemoryLimit: 0", "Quality: 0", "Bare: 0", "InteriorEdge: 0", "WrapAlpha: 0.02",
         "WrapOffset: 0.001", "FtetwildEpsilon: 0.001" })
  {
    EXPECT_THAT(text.str(), HasSubstr(word));
  }
}
