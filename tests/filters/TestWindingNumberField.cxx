// vtkWindingNumberField: winding numbers on grids and at points, for all requests of a pipeline.
#include "TestFilter.h"
#include "data_of.h"

#include "conversion.h"
#include "winding/winding_number.h"
#include "report_field_data.h"
#include "support/meshes.h"
#include "vtkWindingNumberField.h"

#include "vtkCellArray.h"
#include "vtkCellCenters.h"
#include "vtkCellData.h"
#include "vtkContourFilter.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <sstream>

using namespace bindpose;
using bindpose::test::data_of;
using bindpose::test::Listener;
using bindpose::test::TestFilter;
using testing::HasSubstr;

namespace
{
vtkImageData* image_of(vtkWindingNumberField* field)
{
  return vtkImageData::SafeDownCast(field->GetOutput());
}

vtkDoubleArray* winding_array(vtkDataSet* data)
{
  return data ? vtkDoubleArray::SafeDownCast(data->GetPointData()->GetArray("WindingNumber"))
              : nullptr;
}
} // namespace

TEST(WindingNumberField, GridCoversThePaddedBounds)
{
  vtkNew<vtkWindingNumberField> field;
  TriangleMesh mesh = test::cube();
  mesh.points.col(0) *= 2.0; // the box is 4 x 2 x 2
  mesh.points.conservativeResize(9, 3);
  mesh.points.row(8) << 100, 100, 100; // no triangle uses this point
  field->SetInputData(data_of(mesh));
  field->SetResolution(41);
  field->Update();
  vtkImageData* image = image_of(field);
  ASSERT_NE(image, nullptr);
  const double padding = 0.1 * std::sqrt(24.0);
  const double spacing = (4.0 + 2.0 * padding) / 40.0;
  int dimensions[3];
  image->GetDimensions(dimensions);
  EXPECT_EQ(dimensions[0], 41);
  EXPECT_EQ(dimensions[1], static_cast<int>(std::ceil((2.0 + 2.0 * padding) / spacing)) + 1);
  EXPECT_EQ(dimensions[2], dimensions[1]);
  double bounds[6];
  image->GetBounds(bounds);
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_NEAR(image->GetSpacing()[k], spacing, 1e-14);
    EXPECT_LE(bounds[2 * k], (k == 0 ? -2.0 : -1.0) - padding + 1e-12);
    EXPECT_GE(bounds[2 * k + 1], (k == 0 ? 2.0 : 1.0) + padding - 1e-12);
    EXPECT_NEAR(bounds[2 * k] + bounds[2 * k + 1], 0.0, 1e-12) << "centered";
  }
  vtkDoubleArray* values = winding_array(image);
  ASSERT_NE(values, nullptr);
  EXPECT_EQ(image->GetPointData()->GetScalars(), values);
  ASSERT_EQ(values->GetNumberOfTuples(), image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double p[3];
    image->GetPoint(i, p);
    const Vec3 in(0.5 * p[0], p[1], p[2]);
    const double distance = in.cwiseAbs().maxCoeff() - 1.0;
    if (std::abs(distance) > 1e-9)
    {
      ASSERT_NEAR(values->GetValue(i), distance < 0.0 ? 1.0 : 0.0, 1e-12);
    }
  }
  const Report report = read_report(image);
  EXPECT_EQ(report.text("status"), "ok");
  EXPECT_EQ(report.number("counts.triangles", 0), 12);
  EXPECT_EQ(report.number("counts.vertices", 0), 9);
  EXPECT_EQ(report.number("counts.boundary_edges", -1), 0);
  EXPECT_EQ(report.number("counts.components", -1), 1);
  EXPECT_EQ(report.number("counts.queries", -1), image->GetNumberOfPoints());
  EXPECT_NEAR(report.number("volume", 0), 16.0, 1e-12);
  // The sum over the samples gives the volume, up to one layer of voxels.
  EXPECT_NEAR(report.number("winding_volume", 0), 16.0, 40.0 * spacing);
  EXPECT_GE(field->GetReport().number("seconds.build", -1), 0.0);
  EXPECT_GT(field->GetReport().number("seconds.evaluate", -1), 0.0);
  EXPECT_FALSE(report.text("method").empty());
  EXPECT_FALSE(report.text("method_reason").empty());
}

TEST(WindingNumberField, DimensionsAndBoundsAsAskedFor)
{
  vtkNew<vtkWindingNumberField> field;
  field->SetInputData(data_of(test::cube()));
  field->SetDimensions(5, 9, 3);
  field->SetBounds(0, 4, 0, 4, 0, 4);
  field->Update();
  vtkImageData* image = image_of(field);
  int dimensions[3];
  image->GetDimensions(dimensions);
  EXPECT_THAT(dimensions, testing::ElementsAre(5, 9, 3));
  EXPECT_THAT(std::vector<double>(image->GetSpacing(), image->GetSpacing() + 3),
    testing::ElementsAre(1.0, 0.5, 2.0));
  EXPECT_THAT(std::vector<double>(image->GetOrigin(), image->GetOrigin() + 3),
    testing::ElementsAre(0.0, 0.0, 0.0));
  EXPECT_NEAR(winding_array(image)->GetValue(0), 1.0, 1e-15);
  EXPECT_EQ(winding_array(image)->GetValue(1), 0.5) << "on a face";

  field->SetBounds(1, 0, 1, 0, 1, 0); // invalid bounds: use cubic voxels around the surface
  field->SetDimensions(11, 21, 11);
  field->Update();
  image = image_of(field);
  EXPECT_EQ(image->GetSpacing()[0], image->GetSpacing()[1]);
  EXPECT_LE(image->GetBounds()[0], -1.0);
  EXPECT_LE(image->GetBounds()[2], image->GetBounds()[0]);

  field->SetBounds(-1, 1, -1, 1, 0.25, 0.25); // bounds of zero thickness: a single slice
  field->SetDimensions(3, 3, 1);
  field->Update();
  image = image_of(field);
  EXPECT_EQ(image->GetNumberOfPoints(), 9);
  EXPECT_DOUBLE_EQ(image->GetOrigin()[2], 0.25);
  EXPECT_NEAR(winding_array(image)->GetValue(4), 1.0, 1e-15);
  EXPECT_EQ(read_report(image).find("winding_volume"), nullptr);
}

TEST(WindingNumberField, SubExtentsHaveTheSameBits)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(24);
  sphere->SetPhiResolution(16);
  sphere->SetEndTheta(300.0); // this makes an open surface
  vtkNew<vtkWindingNumberField> field;
  field->SetInputConnection(sphere->GetOutputPort());
  field->SetResolution(20);
  field->UpdateInformation();
  vtkInformation* info = field->GetOutputInformation(0);
  int whole[6];
  info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
  EXPECT_EQ(info->Get(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT()), 1);
  ASSERT_EQ(*std::max_element(whole, whole + 6), 19);
  field->Update();
  vtkNew<vtkImageData> all;
  all->DeepCopy(image_of(field));
  EXPECT_THAT(
    std::vector<int>(all->GetExtent(), all->GetExtent() + 6), testing::ElementsAreArray(whole));
  EXPECT_NE(read_report(all).find("winding_volume"), nullptr);

  vtkNew<vtkWindingNumberField> other;
  other->SetInputConnection(sphere->GetOutputPort());
  other->SetResolution(20);
  for (const std::array<int, 6>& part :
    { std::array<int, 6>{ 0, 5, 0, 19, 3, 4 }, std::array<int, 6>{ 7, 7, 2, 11, 0, whole[5] } })
  {
    int extent[6];
    std::copy(part.begin(), part.end(), extent);
    other->UpdateExtent(extent);
    vtkImageData* image = image_of(other);
    ASSERT_THAT(std::vector<int>(image->GetExtent(), image->GetExtent() + 6),
      testing::ElementsAreArray(part));
    vtkDoubleArray* values = winding_array(image);
    ASSERT_EQ(values->GetNumberOfTuples(), image->GetNumberOfPoints());
    for (int k = part[4]; k <= part[5]; ++k)
    {
      for (int j = part[2]; j <= part[3]; ++j)
      {
        for (int i = part[0]; i <= part[1]; ++i)
        {
          int at[3] = { i, j, k };
          ASSERT_EQ(values->GetValue(image->ComputePointId(at)),
            winding_array(all)->GetValue(all->ComputePointId(at)));
        }
      }
    }
    EXPECT_EQ(read_report(image).find("winding_volume"), nullptr) << "only of the whole";
  }
  // Filters with unstructured output, such as vtkContourFilter, request pieces, not extents.
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(other->GetOutputPort());
  contour->SetValue(0, 0.5);
  vtkIdType points = 0;
  for (int piece = 0; piece < 2; ++piece)
  {
    contour->UpdatePiece(piece, 2, 0);
    EXPECT_GT(contour->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_GT(image_of(other)->GetNumberOfPoints(), 0);
    EXPECT_LT(image_of(other)->GetNumberOfPoints(), all->GetNumberOfPoints());
    points += image_of(other)->GetNumberOfPoints();
  }
  EXPECT_GE(points, all->GetNumberOfPoints()); // neighboring pieces share a layer of points
}

TEST(WindingNumberField, TakesAllOfASurfaceThatOthersTakeInPieces)
{
  vtkNew<vtkSphereSource> sphere; // this source can produce pieces
  sphere->SetEndTheta(300.0); // this makes an open surface
  vtkNew<vtkWindingNumberField> field;
  field->SetInputConnection(sphere->GetOutputPort());
  field->SetResolution(12);
  field->Update();
  vtkNew<vtkImageData> whole;
  whole->DeepCopy(image_of(field));
  const vtkIdType edges = field->GetBoundaryOutput()->GetNumberOfCells();
  EXPECT_GT(edges, 0);

  // Another consumer, such as a renderer, has requested a piece of the sphere. The bounds of this
  // piece differ from those of the whole sphere.
  vtkNew<vtkWindingNumberField> again;
  again->SetInputConnection(sphere->GetOutputPort());
  again->SetResolution(12);
  for (int piece = 0; piece < 2; ++piece)
  {
    sphere->UpdatePiece(1, 2, 0);
    again->UpdatePiece(piece, 2, 0);
    vtkImageData* part = image_of(again);
    int extent[6];
    again->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
    EXPECT_THAT(extent, testing::ElementsAreArray(whole->GetExtent(), 6));
    EXPECT_THAT(std::vector<double>(part->GetOrigin(), part->GetOrigin() + 3),
      testing::ElementsAreArray(whole->GetOrigin(), 3));
    EXPECT_GT(part->GetNumberOfPoints(), 0);
    EXPECT_LT(part->GetNumberOfPoints(), whole->GetNumberOfPoints());
    EXPECT_EQ(read_report(part).number("counts.queries", 0), part->GetNumberOfPoints());
    for (vtkIdType i = 0; i < part->GetNumberOfPoints(); ++i)
    {
      double place[3];
      part->GetPoint(i, place);
      EXPECT_EQ(
        winding_array(part)->GetValue(i), winding_array(whole)->GetValue(whole->FindPoint(place)));
    }
  }

  // Output 1, the boundary edges, is not split into pieces: piece 0 contains all edges. A request
  // for output 1 with ghost levels, as ParaView makes it, executes the filter again. This execution
  // must reuse the array of winding numbers instead of computing a new one.
  for (int piece = 0; piece < 2; ++piece)
  {
    again->UpdatePiece(piece, 2, 0);
    vtkNew<vtkImageData> kept;
    kept->ShallowCopy(image_of(again));
    auto* executive = vtkStreamingDemandDrivenPipeline::SafeDownCast(again->GetExecutive());
    vtkInformation* request = again->GetOutputInformation(1);
    again->UpdateInformation();
    request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), piece);
    request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 2);
    request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 1);
    executive->Update(1);
    EXPECT_EQ(again->GetBoundaryOutput()->GetNumberOfCells(), piece == 0 ? edges : 0);
    EXPECT_EQ(winding_array(image_of(again)), winding_array(kept));
    EXPECT_EQ(read_report(image_of(again)).number("counts.queries", 0), kept->GetNumberOfPoints());
    vtkDataArray* const before = winding_array(kept);
    again->SetWindingThreshold(0.6 + piece); // any changed parameter clears the cache
    again->UpdatePiece(piece, 2, 0);
    EXPECT_NE(winding_array(image_of(again)), before);
  }
}

TEST(WindingNumberField, PointsOfAnyDataset)
{
  const TriangleMesh mesh = test::open_cube();
  const TetMesh box = test::tet_box(4, 4, 4, Vec3::Constant(-0.8), Vec3::Constant(0.8));
  const auto tets = to_unstructured_grid(box.points, box.tets);
  vtkNew<vtkDoubleArray> ids;
  ids->SetName("Height");
  for (vtkIdType v = 0; v < tets->GetNumberOfPoints(); ++v)
  {
    ids->InsertNextValue(tets->GetPoint(v)[2]);
  }
  tets->GetPointData()->SetScalars(ids);

  vtkNew<vtkWindingNumberField> field;
  field->SetInputData(data_of(mesh));
  field->SetPointsData(tets);
  field->Update();
  auto* result = vtkUnstructuredGrid::SafeDownCast(field->GetOutput());
  ASSERT_NE(result, nullptr);
  EXPECT_EQ(result->GetNumberOfCells(), tets->GetNumberOfCells());
  EXPECT_EQ(result->GetPointData()->GetArray("Height"), ids.Get());
  EXPECT_EQ(result->GetPointData()->GetScalars(), winding_array(result));
  ASSERT_NE(winding_array(result), nullptr);
  for (Index v = 0; v < box.points.rows(); ++v)
  {
    EXPECT_NEAR(winding_array(result)->GetValue(v),
      winding_number_direct(mesh.points, mesh.triangles, box.points.row(v)), 1e-12);
  }
  EXPECT_EQ(read_report(result).find("winding_volume"), nullptr);
  EXPECT_EQ(tets->GetPointData()->GetArray("WindingNumber"), nullptr) << "input untouched";

  // The points of an image are query points. Requests for parts of its extent are respected.
  vtkNew<vtkImageData> image;
  image->SetExtent(2, 6, 0, 4, -3, 3);
  image->SetOrigin(-1.0, -0.7, 0.1);
  image->SetSpacing(0.3, 0.3, 0.3);
  field->SetPointsData(image);
  field->Update();
  auto* as_image = vtkImageData::SafeDownCast(field->GetOutput());
  ASSERT_NE(as_image, nullptr);
  EXPECT_THAT(std::vector<int>(as_image->GetExtent(), as_image->GetExtent() + 6),
    testing::ElementsAre(2, 6, 0, 4, -3, 3));
  ASSERT_EQ(winding_array(as_image)->GetNumberOfTuples(), 5 * 5 * 7);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    EXPECT_NEAR(winding_array(as_image)->GetValue(i),
      winding_number_direct(mesh.points, mesh.triangles, Vec3(image->GetPoint(i))), 1e-12);
  }

  // Without query points, the filter samples a grid again.
  field->SetInputConnection(1, nullptr);
  field->SetResolution(8);
  field->Update();
  ASSERT_NE(image_of(field), nullptr);
  EXPECT_EQ(image_of(field)->GetDimensions()[0], 8);
}

TEST(WindingNumberField, PointsThatAreNotFiniteAreCounted)
{
  vtkNew<vtkPolyData> points;
  vtkNew<vtkPoints> coordinates;
  coordinates->InsertNextPoint(0, 0, 0);
  coordinates->InsertNextPoint(std::numeric_limits<float>::quiet_NaN(), 0, 0);
  points->SetPoints(coordinates);
  vtkNew<vtkWindingNumberField> field;
  vtkNew<Listener> listener;
  listener->listen(field);
  field->SetInputData(data_of(test::cube()));
  field->SetPointsData(points);
  field->Update();
  EXPECT_EQ(field->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_NEAR(winding_array(field->GetOutput())->GetValue(0), 1.0, 1e-15);
  EXPECT_TRUE(std::isnan(winding_array(field->GetOutput())->GetValue(1)));
  EXPECT_EQ(read_report(field->GetOutput()).number("counts.not_finite", 0), 1);
  ASSERT_EQ(listener->warnings.size(), 1u);
}

TEST(WindingNumberField, QuadsStripsAndOtherCells)
{
  // The surface is a cube of six quads, one of them flipped. A line in the input is ignored.
  const TriangleMesh mesh = test::cube();
  vtkNew<vtkPolyData> data;
  data->SetPoints(to_vtk_points(mesh.points));
  vtkNew<vtkCellArray> polys;
  const vtkIdType quads[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 },
    { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
  for (const auto& quad : quads)
  {
    polys->InsertNextCell(4, quad);
  }
  vtkNew<vtkCellArray> lines;
  const vtkIdType ends[2] = { 0, 7 };
  lines->InsertNextCell(2, ends);
  data->SetPolys(polys);
  data->SetLines(lines);
  vtkNew<vtkWindingNumberField> field;
  field->SetInputData(data);
  field->SetDimensions(1, 1, 1);
  field->Update();
  ASSERT_EQ(field->GetStatus(), vtkBindposeAlgorithm::OK) << field->GetStatusMessage();
  ASSERT_EQ(image_of(field)->GetNumberOfPoints(), 1);
  EXPECT_NEAR(winding_array(image_of(field))->GetValue(0), 1.0, 1e-15);
  const Report report = read_report(field->GetOutput());
  EXPECT_EQ(report.number("counts.triangulated_cells", 0), 6);
  EXPECT_EQ(report.number("counts.ignored_cells", 0), 1);
  EXPECT_EQ(report.number("counts.triangles", 0), 12);
}

TEST(WindingNumberField, ExecutesOnlyWhenSomethingChanged)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkWindingNumberField> field;
  vtkNew<Listener> upstream;
  vtkNew<Listener> listener;
  upstream->listen(sphere);
  listener->listen(field);
  field->SetInputConnection(sphere->GetOutputPort());
  field->SetResolution(8);
  field->Update();
  EXPECT_EQ(listener->starts, 1);
  EXPECT_EQ(upstream->starts, 1) << "asking for its bounds must not execute it twice";
  field->Update();
  field->UpdateInformation();
  field->Update();
  EXPECT_EQ(listener->starts, 1);
  field->SetResolution(8); // the resolution already has this value
  field->SetNumberOfThreads(1);
  field->Update();
  EXPECT_EQ(listener->starts, 1);
  field->SetPadding(0.2);
  field->Update();
  EXPECT_EQ(listener->starts, 2);
  EXPECT_EQ(upstream->starts, 1);
  // The surface becomes larger, and so does the grid.
  const double before = image_of(field)->GetLength();
  sphere->SetRadius(2.0 * sphere->GetRadius());
  field->Update();
  EXPECT_EQ(listener->starts, 3);
  EXPECT_EQ(upstream->starts, 2);
  EXPECT_NEAR(image_of(field)->GetLength(), 2.0 * before, 1e-6);
}

TEST(WindingNumberField, FastKeepsItsToleranceAndSaysSo)
{
  TriangleMesh mesh = test::sphere(4); // every third of the 5120 triangles is removed
  Index kept = 0;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    if (t % 3 != 0)
    {
      mesh.triangles.row(kept++) = mesh.triangles.row(t);
    }
  }
  mesh.triangles.conservativeResize(kept, 3);
  vtkNew<vtkWindingNumberField> field;
  field->SetInputData(data_of(mesh));
  field->SetResolution(14);
  EXPECT_EQ(field->GetMethod(), vtkWindingNumberField::AUTO);
  EXPECT_EQ(field->GetTolerance(), 1e-3);
  for (const double tolerance : { 1e-2, 1e-5 })
  {
    field->SetTolerance(tolerance);
    field->SetMethodToAuto();
    field->Update();
    const Report report = read_report(field->GetOutput());
    EXPECT_EQ(report.text("method"), "fast");
    EXPECT_EQ(report.number("error_bound", 0), tolerance);
    EXPECT_LE(report.number("measured_error", 1), tolerance);
    vtkImageData* image = image_of(field);
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      ASSERT_NEAR(winding_array(image)->GetValue(i),
        winding_number_direct(mesh.points, mesh.triangles, Vec3(image->GetPoint(i))), tolerance);
    }
  }
  field->SetMethodToExact();
  field->Update();
  EXPECT_EQ(read_report(field->GetOutput()).find("error_bound"), nullptr);
  vtkImageData* image = image_of(field);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); i += 7)
  {
    ASSERT_NEAR(winding_array(image)->GetValue(i),
      winding_number_direct(mesh.points, mesh.triangles, Vec3(image->GetPoint(i))), 1e-12);
  }
}

TEST(WindingNumberField, FastAdaptsToTheRegionOfThePoints)
{
  const TriangleMesh mesh = test::open_cube();
  vtkNew<vtkWindingNumberField> field;
  field->SetInputData(data_of(mesh));
  field->SetMethodToFast();
  // The query points fill a slab inside the cube. If the slab moves a little, the filter keeps its
  // acceleration structure. If the slab moves far, the filter builds another one.
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(5000);
  vtkNew<vtkPolyData> slab;
  slab->SetPoints(points);
  field->SetPointsData(slab);
  const auto expect_builds = [&](double x, int builds)
  {
    for (vtkIdType i = 0; i < 5000; ++i)
    {
      points->SetPoint(
        i, x + 0.1 * (i % 10) / 10.0, -0.9 + 1.8 * (i % 71) / 71.0, 0.9 - 1.8 * i / 5000.0);
    }
    points->Modified();
    slab->Modified();
    field->Update();
    EXPECT_EQ(field->GetNumberOfBuilds(), builds);
    auto* values = field->GetOutput()->GetPointData()->GetArray("WindingNumber");
    ASSERT_NE(values, nullptr);
    for (vtkIdType i = 0; i < 5000; i += 97)
    {
      EXPECT_NEAR(values->GetTuple1(i),
        winding_number_direct(mesh.points, mesh.triangles, Vec3(points->GetPoint(i))),
        field->GetTolerance());
    }
  };
  expect_builds(0.500, 1);
  expect_builds(0.501, 1);
  expect_builds(-0.7, 2);
}

TEST(WindingNumberField, ASurfaceIsBuiltOnce)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkWindingNumberField> field;
  field->SetInputConnection(sphere->GetOutputPort());
  field->SetResolution(8);
  field->Update();
  EXPECT_EQ(field->GetNumberOfBuilds(), 1);
  field->SetResolution(12);
  field->Update();
  field->ComputeGradientOn();
  field->SetPointsData(data_of(test::cube()));
  field->Update();
  field->SetInputConnection(1, nullptr);
  field->SetBounds(0, 1, 0, 1, 0, 1);
  field->Update();
  EXPECT_EQ(field->GetNumberOfBuilds(), 1);
  EXPECT_EQ(read_report(field->GetOutput()).number("builds", 0), 1);
  field->SetMethodToExact();
  field->Update();
  EXPECT_EQ(field->GetNumberOfBuilds(), 2);
  field->SetTolerance(1e-4);
  field->Update();
  field->OrientPatchesOn();
  field->Update();
  EXPECT_EQ(field->GetNumberOfBuilds(), 4);
  sphere->SetRadius(3.0);
  field->Update();
  EXPECT_EQ(field->GetNumberOfBuilds(), 5);
  EXPECT_EQ(winding_array(image_of(field))->GetValue(0), 1.0) << "of the new radius";
  // After a failure the filter must not use its old acceleration structure.
  field->SetInputData(vtkNew<vtkPolyData>());
  vtkNew<Listener> listener;
  listener->listen(field);
  field->Update();
  EXPECT_EQ(listener->errors.size(), 1u);
  EXPECT_EQ(field->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(field->GetBoundaryOutput()->GetNumberOfCells(), 0);
}

TEST(WindingNumberField, FloatsAreTheRoundedDoubles)
{
  vtkNew<vtkWindingNumberField> field;
  field->SetInputData(data_of(test::open_cube()));
  field->SetResolution(17);
  field->ComputeGradientOn();
  field->ComputeInsideOn();
  field->Update();
  vtkNew<vtkImageData> doubles;
  doubles->ShallowCopy(image_of(field));
  field->SetOutputPrecision(vtkAlgorithm::SINGLE_PRECISION);
  field->Update();
  vtkPointData* wide = doubles->GetPointData();
  vtkPointData* narrow = field->GetOutput()->GetPointData();
  EXPECT_EQ(narrow->GetArray("WindingNumber")->GetDataType(), VTK_FLOAT);
  EXPECT_EQ(narrow->GetArray("WindingNumberGradient")->GetDataType(), VTK_FLOAT);
  for (vtkIdType i = 0; i < doubles->GetNumberOfPoints(); ++i)
  {
    for (const char* name : { "WindingNumber", "WindingNumberGradient" })
    {
      for (int c = 0; c < wide->GetArray(name)->GetNumberOfComponents(); ++c)
      {
        ASSERT_EQ(narrow->GetArray(name)->GetComponent(i, c),
          static_cast<float>(wide->GetArray(name)->GetComponent(i, c)));
      }
    }
    ASSERT_EQ(narrow->GetArray("Inside")->GetTuple1(i),
      wide->GetArray("WindingNumber")->GetTuple1(i) >= 0.5);
    ASSERT_EQ(
      narrow->GetArray("OnSurface")->GetTuple1(i), wide->GetArray("OnSurface")->GetTuple1(i));
  }
}

TEST(WindingNumberField, GradientInsideAndOnSurfaceAsKnown)
{
  const TriangleMesh mesh = test::open_cube();
  vtkNew<vtkPolyData> where;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.3, 0.2, 0.4); // inside
  points->InsertNextPoint(0.0, 0.0, -1.0); // in the middle of the floor
  points->InsertNextPoint(0.0, 0.0, 3.0); // above the hole
  where->SetPoints(points);
  vtkNew<vtkWindingNumberField> field;
  field->SetInputData(data_of(mesh));
  field->SetPointsData(where);
  field->ComputeGradientOn();
  field->ComputeInsideOn();
  field->SetWindingThreshold(0.6);
  field->Update();
  vtkPointData* data = field->GetOutput()->GetPointData();
  EXPECT_EQ(data->GetArray("OnSurface")->GetTuple1(0), 0);
  EXPECT_EQ(data->GetArray("OnSurface")->GetTuple1(1), 1);
  EXPECT_EQ(data->GetArray("OnSurface")->GetTuple1(2), 0);
  EXPECT_EQ(data->GetArray("Inside")->GetTuple1(0), 1);
  EXPECT_EQ(data->GetArray("Inside")->GetTuple1(1), 0) << "about 0.45 on the floor";
  EXPECT_EQ(data->GetArray("Inside")->GetTuple1(2), 0);
  // Compare with finite differences of the field.
  const Vec3 inside(0.3, 0.2, 0.4);
  for (int k = 0; k < 3; ++k)
  {
    const double h = 1e-5;
    const Vec3 step = h * Vec3::Unit(k);
    const double difference = (winding_number_direct(mesh.points, mesh.triangles, inside + step) -
                                winding_number_direct(mesh.points, mesh.triangles, inside - step)) /
      (2.0 * h);
    EXPECT_NEAR(data->GetArray("WindingNumberGradient")->GetComponent(0, k), difference, 1e-8);
  }
  // On the axis above the hole, the gradient has the direction of the field of a current loop:
  // along z only.
  EXPECT_NEAR(data->GetArray("WindingNumberGradient")->GetComponent(2, 0), 0.0, 1e-14);
  EXPECT_LT(std::abs(data->GetArray("WindingNumberGradient")->GetComponent(2, 2)), 1.0);
  EXPECT_NE(data->GetArray("WindingNumberGradient")->GetComponent(2, 2), 0.0);
}

TEST(WindingNumberField, CellCentersOfAnyDataset)
{
  const TriangleMesh mesh = test::open_cube();
  const TetMesh box = test::tet_box(3, 3, 3, Vec3::Constant(-1.2), Vec3::Constant(1.2));
  const auto tets = to_unstructured_grid(box.points, box.tets);
  vtkNew<vtkWindingNumberField> field;
  field->SetInputData(data_of(mesh));
  field->SetPointsData(tets);
  field->SampleCellCentersOn();
  field->Update();
  vtkDataSet* result = field->GetOutput();
  EXPECT_EQ(result->GetPointData()->GetArray("WindingNumber"), nullptr);
  vtkDataArray* values = result->GetCellData()->GetArray("WindingNumber");
  ASSERT_NE(values, nullptr);
  ASSERT_EQ(values->GetNumberOfTuples(), box.tets.rows());
  for (Index t = 0; t < box.tets.rows(); ++t)
  {
    Vec3 center = Vec3::Zero();
    for (int k = 0; k < 4; ++k)
    {
      center += 0.25 * Vec3(box.points.row(box.tets(t, k)));
    }
    EXPECT_NEAR(
      values->GetTuple1(t), winding_number_direct(mesh.points, mesh.triangles, center), 1e-12);
  }

  // The queries are the points of grids with uneven spacing.
  vtkNew<vtkRectilinearGrid> rectilinear;
  vtkNew<vtkDoubleArray> places;
  for (const double x : { -1.5, -0.7, 0.1, 0.2, 1.3 })
  {
    places->InsertNextValue(x);
  }
  rectilinear->SetDimensions(5, 5, 5);
  rectilinear->SetXCoordinates(places);
  rectilinear->SetYCoordinates(places);
  rectilinear->SetZCoordinates(places);
  vtkNew<vtkStructuredGrid> structured;
  structured->SetDimensions(5, 5, 5);
  vtkNew<vtkPoints> points;
  for (vtkIdType i = 0; i < 125; ++i)
  {
    double p[3];
    rectilinear->GetPoint(i, p);
    points->InsertNextPoint(p[0] + 0.1 * p[1], p[1], p[2]);
  }
  structured->SetPoints(points);
  for (const bool centers : { false, true })
  {
    for (vtkDataSet* grid : std::initializer_list<vtkDataSet*>{ rectilinear, structured })
    {
      field->SetPointsData(grid);
      field->SetSampleCellCenters(centers);
      field->Update();
      result = field->GetOutput();
      ASSERT_STREQ(result->GetClassName(), grid->GetClassName());
      values =
        (centers ? static_cast<vtkFieldData*>(result->GetCellData()) : result->GetPointData())
          ->GetArray("WindingNumber");
      ASSERT_NE(values, nullptr);
      ASSERT_EQ(values->GetNumberOfTuples(), centers ? 64 : 125);
      vtkNew<vtkDoubleArray> middles;
      middles->SetNumberOfComponents(3);
      middles->SetNumberOfTuples(grid->GetNumberOfCells());
      vtkCellCenters::ComputeCellCenters(grid, middles);
      for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
      {
        const Vec3 p(centers ? middles->GetTuple(i) : grid->GetPoint(i));
        ASSERT_NEAR(
          values->GetTuple1(i), winding_number_direct(mesh.points, mesh.triangles, p), 1e-12);
      }
    }
  }
}

TEST(WindingNumberField, SpacingAndTargetCount)
{
  vtkNew<vtkWindingNumberField> field;
  field->SetInputData(data_of(test::cube()));
  field->SetPadding(0.0);
  field->SetSpacing(0.5, 0.25, 0.7);
  field->Update();
  EXPECT_EQ(image_of(field)->GetDimensions()[0], 5);
  EXPECT_EQ(image_of(field)->GetDimensions()[1], 9);
  EXPECT_EQ(image_of(field)->GetDimensions()[2], 4);
  EXPECT_DOUBLE_EQ(image_of(field)->GetOrigin()[0], -1.0);
  EXPECT_NEAR(image_of(field)->GetOrigin()[2], -1.05, 1e-12) << "stands out on both sides";
  field->SetSpacing(0, 0, 0);
  field->SetBounds(-1, 1, -1, 1, -4, 4);
  for (const vtkIdType target : { 8, 100, 5000, 1000000 })
  {
    field->SetTargetNumberOfSamples(target);
    field->UpdateInformation();
    int whole[6];
    field->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
    const double count = (whole[1] + 1.0) * (whole[3] + 1.0) * (whole[5] + 1.0);
    EXPECT_LE(count, static_cast<double>(target));
    if (target >= 5000)
    {
      EXPECT_GT(count, 0.85 * static_cast<double>(target)) << "the finest such grid";
    }
  }
  field->SetDimensions(3, 4, 5); // the dimensions have priority over all other sizes
  field->SetSpacing(1, 1, 1);
  field->Update();
  EXPECT_EQ(image_of(field)->GetNumberOfPoints(), 60);

  vtkNew<Listener> listener;
  listener->listen(field);
  field->SetDimensions(0, 0, 0);
  field->SetSpacing(1, 0, 1);
  field->Update();
  EXPECT_THAT(field->GetStatusMessage(), HasSubstr("spacing"));
  field->SetSpacing(1e-300, 1, 1);
  field->Update();
  EXPECT_THAT(field->GetStatusMessage(), HasSubstr("samples"));
  // The filter can describe this grid, but the samples would need 8 TB of memory.
  field->SetSpacing(0, 0, 0);
  field->SetTargetNumberOfSamples(1000000000000);
  field->Update();
  EXPECT_THAT(field->GetStatusMessage(), HasSubstr("GiB"));
  EXPECT_EQ(field->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
  EXPECT_EQ(field->GetOutput()->GetNumberOfPoints(), 0);
  // A small part of the same grid fits into memory.
  field->UpdateInformation();
  int part[6] = { 100, 103, 2000, 2003, 300, 301 };
  field->UpdateExtent(part);
  EXPECT_EQ(field->GetStatus(), vtkBindposeAlgorithm::OK) << field->GetStatusMessage();
  EXPECT_EQ(image_of(field)->GetNumberOfPoints(), 4 * 4 * 2);
}

TEST(WindingNumberField, BoundaryAndTableOfComponents)
{
  const TriangleMesh mesh =
    test::join(test::open_cube(), test::translated(test::flipped(test::cube()), Vec3(10, 0, 0)));
  vtkNew<vtkWindingNumberField> field;
  field->SetInputData(data_of(mesh));
  field->SetDimensions(2, 2, 2);
  field->Update();
  vtkPolyData* boundary = field->GetBoundaryOutput();
  ASSERT_NE(boundary, nullptr);
  EXPECT_EQ(boundary->GetNumberOfLines(), 4);
  EXPECT_EQ(boundary->GetNumberOfPoints(), 4);
  double bounds[6];
  boundary->GetBounds(bounds);
  EXPECT_THAT(bounds, testing::ElementsAre(-1, 1, -1, 1, 1, 1));
  vtkDataArray* ids = boundary->GetPointData()->GetArray("OriginalPointIds");
  ASSERT_NE(ids, nullptr);
  for (vtkIdType v = 0; v < 4; ++v)
  {
    EXPECT_EQ(
      Vec3(boundary->GetPoint(v)), Vec3(mesh.points.row(static_cast<Index>(ids->GetTuple1(v)))));
  }
  EXPECT_EQ(boundary->GetCellData()->GetArray("Multiplicity")->GetTuple1(0), 1);
  const auto component =
    static_cast<vtkIdType>(boundary->GetCellData()->GetArray("Component")->GetTuple1(0));
  vtkFieldData* table = boundary->GetFieldData();
  ASSERT_EQ(table->GetArray("ComponentTriangles")->GetNumberOfTuples(), 2);
  EXPECT_EQ(table->GetArray("ComponentTriangles")->GetTuple1(component), 10);
  EXPECT_EQ(table->GetArray("ComponentOpenEdges")->GetTuple1(component), 4);
  EXPECT_EQ(table->GetArray("ComponentOpenEdges")->GetTuple1(1 - component), 0);
  EXPECT_NEAR(table->GetArray("ComponentVolume")->GetTuple1(component), 8.0, 1e-12);
  EXPECT_NEAR(table->GetArray("ComponentVolume")->GetTuple1(1 - component), -8.0, 1e-12);
  EXPECT_EQ(read_report(boundary).text("status"), "ok");
}

TEST(WindingNumberField, PatchesAreTurnedOnDemand)
{
  // One face of one cube is flipped, and all faces of another cube.
  TriangleMesh mesh =
    test::join(test::cube(), test::translated(test::flipped(test::cube()), Vec3(10, 0, 0)));
  mesh.triangles.row(4).reverseInPlace();
  mesh.triangles.row(5).reverseInPlace();
  vtkNew<vtkPolyData> centers;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(10, 0, 0);
  centers->SetPoints(points);
  vtkNew<vtkWindingNumberField> field;
  field->SetInputData(data_of(mesh));
  field->SetPointsData(centers);
  field->Update();
  EXPECT_NEAR(winding_array(field->GetOutput())->GetValue(0), 4.0 / 6.0, 1e-12);
  EXPECT_NEAR(winding_array(field->GetOutput())->GetValue(1), -1.0, 1e-3);
  EXPECT_EQ(field->GetBoundaryOutput()->GetNumberOfLines(), 4);
  EXPECT_EQ(field->GetBoundaryOutput()->GetCellData()->GetArray("Multiplicity")->GetTuple1(0), 2);
  EXPECT_EQ(read_report(field->GetOutput()).find("counts.turned_triangles"), nullptr);
  field->OrientPatchesOn();
  field->Update();
  EXPECT_NEAR(winding_array(field->GetOutput())->GetValue(0), 1.0, 1e-12);
  EXPECT_NEAR(winding_array(field->GetOutput())->GetValue(1), 1.0, 1e-12);
  EXPECT_EQ(field->GetBoundaryOutput()->GetNumberOfLines(), 0);
  EXPECT_EQ(read_report(field->GetOutput()).number("counts.turned_triangles", 0), 2);
  EXPECT_EQ(read_report(field->GetOutput()).number("counts.turned_components", 0), 1);
}

TEST(WindingNumberField, LinesAreACurveInTheirPlane)
{
  // The input is a square parallel to one of the three coordinate planes, as one closed polyline.
  // Viewed from the positive end of the perpendicular axis, the polyline is counter-clockwise.
  for (int across = 0; across < 3; ++across)
  {
    SCOPED_TRACE(across);
    const int u = (across + 1) % 3, v = (across + 2) % 3;
    vtkNew<vtkPolyData> square;
    vtkNew<vtkPoints> points;
    for (const auto& [x, y] :
      { std::pair{ -1.0, -1.0 }, { 1.0, -1.0 }, { 1.0, 1.0 }, { -1.0, 1.0 } })
    {
      Vec3 p = Vec3::Constant(5.0);
      p[u] = x;
      p[v] = y;
      points->InsertNextPoint(p.data());
    }
    square->SetPoints(points);
    vtkNew<vtkCellArray> lines;
    const vtkIdType corners[5] = { 0, 1, 2, 3, 0 };
    lines->InsertNextCell(5, corners);
    square->SetLines(lines);
    vtkNew<vtkWindingNumberField> field;
    field->SetInputData(square);
    field->SetResolution(12);
    field->Update();
    ASSERT_EQ(field->GetStatus(), vtkBindposeAlgorithm::OK) << field->GetStatusMessage();
    vtkImageData* image = image_of(field);
    EXPECT_EQ(image->GetDimensions()[across], 1);
    EXPECT_EQ(image->GetDimensions()[u], 12);
    EXPECT_EQ(image->GetDimensions()[v], 12);
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      const Vec3 p(image->GetPoint(i));
      EXPECT_DOUBLE_EQ(p[across], 5.0);
      EXPECT_EQ(winding_array(image)->GetValue(i), std::max(std::abs(p[u]), std::abs(p[v])) < 1.0);
    }
    EXPECT_EQ(field->GetBoundaryOutput()->GetNumberOfCells(), 0);
    EXPECT_NEAR(read_report(image).number("area", 0), 4.0, 1e-12);

    // If the last side of the square is missing, the winding number decreases by the angle that
    // this side subtends, divided by 2 pi.
    const vtkIdType open[4] = { 0, 1, 2, 3 };
    vtkNew<vtkCellArray> three_sides;
    three_sides->InsertNextCell(4, open);
    square->SetLines(three_sides);
    vtkNew<vtkPolyData> where;
    vtkNew<vtkPoints> at;
    // The query points are offset along the perpendicular axis, which must have no effect.
    for (const double away : { 0.0, 7.0 })
    {
      Vec3 p = Vec3::Constant(away);
      p[u] = p[v] = 0.0;
      at->InsertNextPoint(p.data());
      p[u] = 1.0;
      at->InsertNextPoint(p.data());
    }
    where->SetPoints(at);
    field->SetPointsData(where);
    field->ComputeGradientOn();
    field->Update();
    vtkDataArray* flags = field->GetOutput()->GetPointData()->GetArray("OnSurface");
    vtkDataArray* gradient = field->GetOutput()->GetPointData()->GetArray("WindingNumberGradient");
    for (const vtkIdType i : { 0, 2 })
    {
      EXPECT_NEAR(winding_array(field->GetOutput())->GetValue(i), 0.75, 1e-14);
      EXPECT_EQ(flags->GetTuple1(i), 0);
      EXPECT_EQ(flags->GetTuple1(i + 1), 1);
      // The missing side is at u = -1. It subtends the angle 2 atan(1 / (1 + u)), whose derivative
      // at u = 0 is -1.
      EXPECT_NEAR(gradient->GetComponent(i, u), 1.0 / 6.283185307179586, 1e-12);
      EXPECT_NEAR(gradient->GetComponent(i, v), 0.0, 1e-12);
      EXPECT_EQ(gradient->GetComponent(i, across), 0.0);
    }
  }
  // A polyline that is not planar is refused.
  vtkNew<vtkPolyData> bent;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(1, 2, 3);
  bent->SetPoints(points);
  vtkNew<vtkCellArray> lines;
  const vtkIdType ends[2] = { 0, 1 };
  lines->InsertNextCell(2, ends);
  bent->SetLines(lines);
  vtkNew<vtkWindingNumberField> field;
  vtkNew<Listener> listener;
  listener->listen(field);
  field->SetInputData(bent);
  field->Update();
  ASSERT_EQ(listener->errors.size(), 1u);
  EXPECT_THAT(field->GetStatusMessage(), HasSubstr("plane"));
}

TEST(WindingNumberField, PointsWithNormalsAreSamplesOfASurface)
{
  // The point cloud consists of the centers of the sphere's triangles, with and without their
  // areas.
  const TriangleMesh sphere = test::sphere(4);
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> areas;
  areas->SetName("Area");
  for (Index t = 0; t < sphere.triangles.rows(); ++t)
  {
    const Vec3 a = sphere.points.row(sphere.triangles(t, 0));
    const Vec3 b = sphere.points.row(sphere.triangles(t, 1));
    const Vec3 c = sphere.points.row(sphere.triangles(t, 2));
    const Vec3 middle = (a + b + c) / 3.0;
    const Vec3 normal = (b - a).cross(c - a);
    points->InsertNextPoint(middle.data());
    normals->InsertNextTuple(normal.data()); // normals may have any length
    areas->InsertNextValue(0.5 * normal.norm());
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  cloud->GetPointData()->AddArray(normals);
  cloud->GetPointData()->AddArray(areas);
  vtkNew<vtkWindingNumberField> field;
  field->SetInputData(cloud);
  field->SetResolution(15);
  for (const bool given : { true, false })
  {
    field->SetAreaArrayName(given ? "Area" : "nothing of that name");
    field->Update();
    ASSERT_EQ(field->GetStatus(), vtkBindposeAlgorithm::OK) << field->GetStatusMessage();
    const Report report = read_report(field->GetOutput());
    EXPECT_EQ(report.text("areas"), given ? "given" : "estimated");
    EXPECT_NEAR(report.number("area", 0), 12.566, given ? 0.05 : 0.2);
    vtkImageData* image = image_of(field);
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      const double radius = Vec3(image->GetPoint(i)).norm();
      if (std::abs(radius - 1.0) > 0.12)
      {
        ASSERT_NEAR(winding_array(image)->GetValue(i), radius < 1.0, 0.02);
      }
    }
  }
  EXPECT_EQ(field->GetNumberOfBuilds(), 2);
  vtkNew<Listener> listener;
  listener->listen(field);
  field->ComputeGradientOn();
  field->Update();
  EXPECT_EQ(listener->errors.size(), 0u);
  EXPECT_EQ(field->GetNumberOfBuilds(), 2);
  vtkImageData* image = image_of(field);
  auto* gradients =
    vtkDoubleArray::SafeDownCast(image->GetPointData()->GetArray("WindingNumberGradient"));
  ASSERT_NE(gradients, nullptr);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const Vec3 at(image->GetPoint(i));
    const Vec3 gradient(gradients->GetPointer(3 * i));
    ASSERT_TRUE(gradient.allFinite());
    if (std::abs(at.norm() - 1.0) > 0.2)
    {
      // The field is nearly constant inside and outside.
      EXPECT_LE(gradient.norm(), 0.1) << at.transpose();
    }
  }
}

TEST(WindingNumberField, AbortFromAnObserverThenAgain)
{
  vtkNew<vtkWindingNumberField> field;
  vtkNew<Listener> listener;
  listener->listen(field);
  field->SetInputData(data_of(test::open_cube()));
  field->SetResolution(200);
  field->SetNumberOfThreads(1);
  using Clock = std::chrono::steady_clock;
  Clock::time_point cancel_time{};
  listener->on_progress = [&](vtkAlgorithm* algorithm)
  {
    if (algorithm->GetProgress() > 0.25 && cancel_time == Clock::time_point())
    {
      cancel_time = Clock::now();
      algorithm->SetAbortExecute(1);
    }
  };
  field->Update();
  ASSERT_NE(cancel_time, Clock::time_point()) << "it was faster than its progress";
  EXPECT_LT(std::chrono::duration<double>(Clock::now() - cancel_time).count(), 0.2);
  EXPECT_EQ(field->GetStatus(), vtkBindposeAlgorithm::CANCELED);
  EXPECT_EQ(field->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(winding_array(field->GetOutput()), nullptr);
  EXPECT_EQ(read_report(field->GetOutput()).text("status"), "canceled");
  EXPECT_TRUE(listener->errors.empty());
  EXPECT_TRUE(std::is_sorted(listener->progress.begin(), listener->progress.end() - 1));
  EXPECT_THAT(listener->phases, testing::Contains("build"));
  EXPECT_THAT(listener->phases, testing::Contains("evaluate"));

  listener->on_progress = nullptr;
  const int starts = listener->starts;
  field->SetResolution(20);
  field->Update();
  EXPECT_EQ(listener->starts, starts + 1);
  EXPECT_EQ(field->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_EQ(image_of(field)->GetDimensions()[0], 20);
  EXPECT_EQ(winding_array(image_of(field))->GetNumberOfTuples(), 20 * 20 * 20);
}

TEST(WindingNumberField, BadSurfacesFailCleanlyForTheWholeChain)
{
  const TriangleMesh cube = test::cube();
  vtkNew<vtkPolyData> empty;
  vtkNew<vtkPolyData> no_triangles; // the dataset has points and a line only
  no_triangles->SetPoints(to_vtk_points(cube.points));
  vtkNew<vtkCellArray> lines;
  const vtkIdType ends[2] = { 0, 7 };
  lines->InsertNextCell(2, ends);
  no_triangles->SetLines(lines);
  TriangleMesh nan = cube;
  nan.points(3, 1) = std::numeric_limits<double>::quiet_NaN();
  TriangleMesh far_id = cube;
  far_id.triangles(0, 0) = 99;
  const std::vector<std::pair<vtkSmartPointer<vtkPolyData>, std::string>> cases{
    { empty.Get(), "empty" }, { no_triangles.Get(), "no triangles" }, { data_of(nan), "vertex 3" },
    { data_of(far_id), "vertex 99" }
  };
  for (const bool first_good : { false, true })
  {
    for (const auto& [bad, word] : cases)
    {
      vtkNew<vtkWindingNumberField> field;
      vtkNew<TestFilter> next;
      vtkNew<vtkContourFilter> contour;
      vtkNew<Listener> listener;
      vtkNew<Listener> downstream;
      listener->listen(field);
      downstream->listen(next);
      field->SetResolution(12);
      next->SetInputConnection(field->GetOutputPort());
      contour->SetInputConnection(field->GetOutputPort());
      contour->SetValue(0, 0.5);
      if (first_good)
      {
        field->SetInputData(data_of(cube));
        next->Update();
        contour->Update();
        EXPECT_GT(contour->GetOutput()->GetNumberOfCells(), 0);
        EXPECT_EQ(next->GetStatus(), vtkBindposeAlgorithm::OK);
      }
      field->SetInputData(bad);
      next->Update();
      EXPECT_EQ(field->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
      EXPECT_THAT(field->GetStatusMessage(), HasSubstr(word));
      EXPECT_EQ(field->GetErrorCode(), vtkErrorCode::UserError);
      ASSERT_EQ(listener->errors.size(), 1u);
      EXPECT_THAT(listener->errors[0], HasSubstr(word));
      EXPECT_EQ(field->GetOutput()->GetNumberOfPoints(), 0);
      EXPECT_EQ(read_report(field->GetOutput()).text("status"), "invalid_input");
      EXPECT_EQ(next->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
      EXPECT_EQ(next->GetStatusMessage(), field->GetStatusMessage());
      EXPECT_EQ(downstream->errors.size(), 1u);
      // VTK's own filters downstream must not crash and must not keep their old output.
      contour->Update();
      EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), 0);

      field->SetInputData(data_of(cube));
      next->Update();
      contour->Update();
      EXPECT_EQ(field->GetStatus(), vtkBindposeAlgorithm::OK);
      EXPECT_EQ(next->GetStatus(), vtkBindposeAlgorithm::OK);
      EXPECT_GT(contour->GetOutput()->GetNumberOfCells(), 0);
    }
  }
}

TEST(WindingNumberField, BadGridsAreNamed)
{
  vtkNew<vtkWindingNumberField> field;
  vtkNew<Listener> listener;
  listener->listen(field);
  field->SetInputData(data_of(test::cube()));
  field->SetDimensions(4, 0, 4);
  field->Update();
  EXPECT_THAT(field->GetStatusMessage(), HasSubstr("dimensions"));
  field->SetDimensions(2000000, 2000000, 2000000);
  field->Update();
  EXPECT_THAT(field->GetStatusMessage(), HasSubstr("samples"));
  field->SetDimensions(4, 4, 4);
  field->SetBounds(0, std::numeric_limits<double>::infinity(), 0, 1, 0, 1);
  field->Update();
  EXPECT_THAT(field->GetStatusMessage(), HasSubstr("bounds"));
  EXPECT_EQ(listener->errors.size(), 3u);
  EXPECT_EQ(field->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(WindingNumberField, FlatAndTinySurfacesHaveAGrid)
{
  vtkNew<vtkPlaneSource> plane;
  vtkNew<vtkWindingNumberField> field;
  field->SetInputConnection(plane->GetOutputPort());
  field->SetResolution(9);
  field->Update();
  EXPECT_EQ(field->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_GT(image_of(field)->GetDimensions()[2], 1);

  TriangleMesh point = test::cube();
  point.points.setConstant(3.0); // all points at one position
  vtkNew<Listener> listener;
  listener->listen(field);
  field->SetInputData(data_of(point));
  field->Update();
  EXPECT_EQ(field->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_EQ(image_of(field)->GetNumberOfPoints(), 1);
  EXPECT_EQ(listener->warnings.size(), 1u);
}

TEST(WindingNumberField, BlocksOfACompositeInput)
{
  for (const unsigned int count : { 1u, 3u })
  {
    vtkNew<vtkMultiBlockDataSet> blocks;
    for (unsigned int b = 0; b < count; ++b)
    {
      blocks->SetBlock(b, data_of(test::cube(-1.0 - b, 1.0 + b)));
    }
    vtkNew<vtkWindingNumberField> field;
    field->SetInputDataObject(0, blocks);
    field->SetResolution(10 + static_cast<int>(count));
    for (int round = 0; round < 2; ++round)
    {
      field->Modified();
      field->Update();
      EXPECT_EQ(field->GetStatus(), vtkBindposeAlgorithm::OK) << field->GetStatusMessage();
      auto* output = vtkMultiBlockDataSet::SafeDownCast(field->GetOutputDataObject(0));
      ASSERT_NE(output, nullptr);
      ASSERT_EQ(output->GetNumberOfBlocks(), count);
      for (unsigned int b = 0; b < count; ++b)
      {
        auto* image = vtkImageData::SafeDownCast(output->GetBlock(b));
        ASSERT_NE(image, nullptr);
        EXPECT_EQ(image->GetDimensions()[0], 10 + static_cast<int>(count));
        EXPECT_LT(image->GetBounds()[0], -1.0 - b);
        EXPECT_NEAR(read_report(image).number("volume", 0), std::pow(2.0 + 2.0 * b, 3), 1e-9);
      }
    }
    // The same filter works again with a surface that has no defects.
    vtkNew<vtkSphereSource> sphere;
    sphere->SetRadius(5.0);
    field->SetInputConnection(sphere->GetOutputPort());
    field->Update();
    ASSERT_NE(image_of(field), nullptr);
    EXPECT_LT(image_of(field)->GetBounds()[0], -4.9);
    EXPECT_EQ(field->GetStatus(), vtkBindposeAlgorithm::OK);
  }
}

TEST(WindingNumberField, PrintsAllItsParameters)
{
  vtkNew<vtkWindingNumberField> field;
  field->SetMethodToExact();
  field->SetDimensions(1, 2, 3);
  std::ostringstream text;
  field->Print(text);
  for (const char* word : { "Method: EXACT", "Dimensions: 1 2 3", "Resolution: 64",
         "Bounds: 0 -1 0 -1 0 -1", "Padding: 0.1", "Tolerance: 0.001", "OrientPatches: 0",
         "AreaArrayName: Area", "Spacing: 0 0 0", "TargetNumberOfSamples: 0",
         "SampleCellCenters: 0", "ComputeGradient: 0", "ComputeInside: 0", "WindingThreshold: 0.5",
         "OutputPrecision: DOUBLE", "NumberOfBuilds: 0", "Status: ok" })
  {
    EXPECT_THAT(text.str(), HasSubstr(word));
  }
}
