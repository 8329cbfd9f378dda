// Tests of the weights filters: output arrays and their names; a pose edit never causes a bind;
// handles become vertices of the mesh; regions; surfaces and tets; a canceled solve can be
// repeated; error messages.
#include "TestFilter.h"
#include "data_of.h"

#include "vtkBoundedBiharmonicWeights.h"
#include "vtkMonotoneWeights.h"
#include "vtkUnconstrainedWeights.h"

#include "conversion.h"
#include "report_field_data.h"
#include "support/handles.h"
#include "support/meshes.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <sstream>

using namespace bindpose;
using bindpose::test::Listener;
using testing::HasSubstr;

namespace
{
vtkSmartPointer<vtkUnstructuredGrid> box_data(int n)
{
  return test::data_of(test::tet_box(n, n, n));
}

vtkSmartPointer<vtkPolyData> square_data(int n)
{
  return test::data_of(test::grid(n, n));
}

/// Return two points and a bone inside of the unit cube. None of them is on a vertex.
vtkSmartPointer<vtkPolyData> three_handles()
{
  return to_polydata({ test::point_handle("left", Vec3(0.13, 0.22, 0.31)),
    test::point_handle("right", Vec3(0.87, 0.71, 0.64)),
    test::bone_handle("middle", Vec3(0.45, 0.52, 0.2), Vec3(0.52, 0.47, 0.8)) });
}

template <typename Filter>
class Pipeline
{
public:
  Pipeline(vtkDataObject* mesh, vtkPolyData* handles)
  {
    this->listener->listen(this->filter);
    this->filter->SetInputData(0, mesh);
    this->filter->SetInputData(1, handles);
  }
  vtkPointSet* output() { return vtkPointSet::SafeDownCast(this->filter->GetOutput()); }
  vtkDoubleArray* weights()
  {
    return vtkDoubleArray::SafeDownCast(this->output()->GetPointData()->GetArray("Weights"));
  }
  Report report() { return this->filter->GetReport(); }

  vtkNew<Filter> filter;
  vtkNew<Listener> listener;
};

void expect_rows_sum_to_one(vtkDoubleArray* weights)
{
  for (vtkIdType v = 0; v < weights->GetNumberOfTuples(); ++v)
  {
    double sum = 0.0;
    for (int j = 0; j < weights->GetNumberOfComponents(); ++j)
    {
      sum += weights->GetComponent(v, j);
    }
    ASSERT_NEAR(sum, 1.0, 1e-12);
  }
}

/// Return the id of the mesh point at a position, or -1.
vtkIdType vertex_at(vtkPointSet* mesh, double x, double y, double z, double tolerance)
{
  const vtkIdType v = mesh->FindPoint(x, y, z);
  double p[3];
  mesh->GetPoint(v, p);
  return std::hypot(p[0] - x, p[1] - y, p[2] - z) <= tolerance ? v : -1;
}
} // namespace

TEST(WeightsFilters, TetsGetNamedWeightsAndCertificates)
{
  const auto mesh = box_data(5);
  Pipeline<vtkBoundedBiharmonicWeights> run(mesh, three_handles());
  run.filter->Update();
  ASSERT_EQ(run.filter->GetStatus(), vtkBindposeAlgorithm::OK) << run.filter->GetStatusMessage();
  ASSERT_TRUE(vtkUnstructuredGrid::SafeDownCast(run.output()));
  vtkDoubleArray* weights = run.weights();
  ASSERT_TRUE(weights);
  EXPECT_EQ(weights->GetNumberOfComponents(), 3);
  EXPECT_STREQ(weights->GetComponentName(0), "left");
  EXPECT_STREQ(weights->GetComponentName(2), "middle");
  expect_rows_sum_to_one(weights);

  // Original points precede new ones. There is no hole: the cells still fill the cube.
  const vtkIdType n = mesh->GetNumberOfPoints();
  ASSERT_GT(run.output()->GetNumberOfPoints(), n);
  for (vtkIdType v = 0; v < n; ++v)
  {
    double p[3];
    double q[3];
    mesh->GetPoint(v, p);
    run.output()->GetPoint(v, q);
    ASSERT_TRUE(std::equal(p, p + 3, q));
  }
  TetInput tets;
  ASSERT_TRUE(to_tets(run.output(), tets).ok());
  const Eigen::VectorXd volumes = tet_volumes(tets.points.view(), tets.tets.view());
  EXPECT_NEAR(volumes.sum(), 1.0, 1e-12);
  EXPECT_GT(volumes.minCoeff(), 0.0);
  const vtkIdType left = vertex_at(run.output(), 0.13, 0.22, 0.31, 0.07);
  ASSERT_GE(left, 0);
  EXPECT_DOUBLE_EQ(weights->GetComponent(left, 0), 1.0);
  EXPECT_DOUBLE_EQ(weights->GetComponent(left, 1), 0.0);

  vtkFieldData* field = run.output()->GetFieldData();
  for (const char* name : { "WeightsRelativeGap", "WeightsKKTResidual", "WeightsMinimum",
         "WeightsMaximum", "WeightsInteriorExtrema" })
  {
    vtkDataArray* array = field->GetArray(name);
    ASSERT_TRUE(array) << name;
    EXPECT_EQ(array->GetNumberOfTuples(), 3) << name;
  }
  for (int j = 0; j < 3; ++j)
  {
    EXPECT_LE(field->GetArray("WeightsRelativeGap")->GetTuple1(j), 1e-6);
    EXPECT_LE(field->GetArray("WeightsKKTResidual")->GetTuple1(j), 1e-6);
    EXPECT_EQ(field->GetArray("WeightsMinimum")->GetTuple1(j), 0.0);
    EXPECT_EQ(field->GetArray("WeightsMaximum")->GetTuple1(j), 1.0);
  }
  EXPECT_GT(field->GetArray("WeightsRowSumError")->GetTuple1(0), 0.0);
  const Report report = run.report();
  EXPECT_EQ(report.text("method"), "bounded-biharmonic");
  EXPECT_EQ(report.number("binds", 0), 1);
  EXPECT_EQ(report.number("counts.handles", 0), 3);
  EXPECT_LE(report.number("relative_gap", 1), 1e-6);
  EXPECT_GT(report.number("seconds.analyze", 0), 0.0);
  EXPECT_GT(report.number("seconds.factor", 0), 0.0);
  EXPECT_GT(report.number("seconds.solve", 0), 0.0);
  EXPECT_TRUE(run.listener->errors.empty());
  EXPECT_TRUE(std::is_sorted(run.listener->progress.begin(), run.listener->progress.end()));
}

TEST(WeightsFilters, PoseEditsNeverBindAgain)
{
  const auto mesh = box_data(4);
  const auto handles = three_handles();
  Pipeline<vtkBoundedBiharmonicWeights> run(mesh, handles);
  run.filter->Update();
  ASSERT_EQ(run.filter->GetNumberOfBinds(), 1);
  vtkDoubleArray* weights = run.weights();
  vtkDataArray* points = run.output()->GetPoints()->GetData();
  vtkAbstractArray* gap = run.output()->GetFieldData()->GetAbstractArray("WeightsRelativeGap");
  vtkDataArray* transform = handles->GetCellData()->GetArray("Transform");
  for (int edit = 0; edit < 100; ++edit)
  {
    transform->SetComponent(0, 3, 0.01 * edit);
    transform->Modified();
    handles->GetCellData()->GetArray("Mode")->SetComponent(1, 0, edit % 3);
    handles->GetCellData()->GetArray("Mode")->Modified();
    handles->Modified();
    run.filter->Update();
  }
  EXPECT_EQ(run.filter->GetNumberOfBinds(), 1);
  EXPECT_EQ(run.listener->starts, 101);
  EXPECT_EQ(run.weights(), weights) << "the same array object";
  EXPECT_EQ(run.output()->GetPoints()->GetData(), points);
  EXPECT_EQ(run.output()->GetFieldData()->GetAbstractArray("WeightsRelativeGap"), gap);
  EXPECT_EQ(run.report().number("counts.handles", 0), 3) << "the bind's report stays whole";
  EXPECT_GT(run.report().number("seconds.factor", 0), 0.0);
  // If nothing has changed, Update() does not execute the filter again.
  run.filter->Update();
  EXPECT_EQ(run.listener->starts, 101);

  // Changes of bind-time data cause a bind: the rest position of a handle, the mesh, a parameter.
  double p[3];
  handles->GetPoint(0, p);
  handles->GetPoints()->SetPoint(0, p[0] + 0.05, p[1], p[2]);
  handles->GetPoints()->Modified();
  run.filter->Update();
  EXPECT_EQ(run.filter->GetNumberOfBinds(), 2);
  EXPECT_NE(run.weights(), weights);
  mesh->GetPoints()->SetPoint(0, -0.01, 0.0, 0.0);
  mesh->GetPoints()->Modified();
  run.filter->Update();
  EXPECT_EQ(run.filter->GetNumberOfBinds(), 3);
  run.filter->SetTolerance(1e-7);
  run.filter->Update();
  EXPECT_EQ(run.filter->GetNumberOfBinds(), 4);
  run.filter->SetTolerance(1e-7);
  run.filter->Update();
  EXPECT_EQ(run.filter->GetNumberOfBinds(), 4);
}

TEST(WeightsFilters, SurfacesOfAnyPolygonsWork)
{
  // The source makes quads and float points, from (-.5, -.5) to (.5, .5).
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(12, 12);
  plane->Update();
  const auto on_vertices = to_polydata(Handles{
    test::point_handle("a", Vec3(-0.5, -0.5, 0)), test::point_handle("b", Vec3(0.5, 0.5, 0)) });
  Pipeline<vtkBoundedBiharmonicWeights> quads(plane->GetOutput(), on_vertices);
  quads.filter->Update();
  ASSERT_EQ(quads.filter->GetStatus(), vtkBindposeAlgorithm::OK)
    << quads.filter->GetStatusMessage();
  EXPECT_EQ(quads.output()->GetNumberOfCells(), 144) << "no handle inserted: quads stay";
  expect_rows_sum_to_one(quads.weights());

  const auto off_vertices = to_polydata(Handles{
    test::point_handle("a", Vec3(-0.39, -0.37, 0)), test::point_handle("b", Vec3(0.41, 0.3, 0)) });
  vtkNew<vtkIntArray> row;
  row->SetName("Row");
  for (int cell = 0; cell < 144; ++cell)
  {
    row->InsertNextValue(cell / 12);
  }
  plane->GetOutput()->GetCellData()->AddArray(row);
  Pipeline<vtkMonotoneWeights> split(plane->GetOutput(), off_vertices);
  split.filter->Update();
  ASSERT_EQ(split.filter->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_EQ(split.output()->GetNumberOfPoints(), 169 + 2);
  EXPECT_EQ(split.report().number("counts.inserted_vertices", 0), 2);
  // Cell arrays stay with their cells: the value of `Row` of each triangle is the row of squares
  // that contains the triangle.
  vtkDataArray* rows = split.output()->GetCellData()->GetArray("Row");
  for (vtkIdType cell = 0; cell < split.output()->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    split.output()->GetCellBounds(cell, bounds);
    const double y = 0.5 * (bounds[2] + bounds[3]);
    ASSERT_EQ(std::floor((y + 0.5) * 12.0), rows->GetTuple1(cell));
  }
  // Normals and texture coordinates keep their attribute role and are interpolated.
  ASSERT_TRUE(split.output()->GetPointData()->GetNormals());
  EXPECT_NEAR(split.output()->GetPointData()->GetNormals()->GetComponent(170, 2), 1.0, 1e-6);
  double p[3];
  split.output()->GetPoint(170, p);
  EXPECT_NEAR(split.output()->GetPointData()->GetTCoords()->GetComponent(170, 0), p[0] + 0.5, 1e-6);
  for (int j = 0; j < 2; ++j)
  {
    EXPECT_EQ(
      split.output()->GetFieldData()->GetArray("WeightsInteriorExtrema")->GetTuple1(j), 0.0);
  }
}

TEST(WeightsFilters, RegionsByLabels)
{
  const auto mesh = square_data(10);
  vtkNew<vtkIntArray> labels;
  labels->SetName("Part");
  labels->SetNumberOfTuples(mesh->GetNumberOfPoints());
  for (vtkIdType v = 0; v < mesh->GetNumberOfPoints(); ++v)
  {
    double p[3];
    mesh->GetPoint(v, p);
    labels->SetValue(v, p[0] < 0.25 ? 5 : 0);
  }
  mesh->GetPointData()->AddArray(labels);
  Handles handles{ test::point_handle("tip", Vec3(0.93, 0.52, 0.0)),
    test::point_handle("left", Vec3(0.0, 0.5, 0.0)) };
  handles[1].kind = HandleKind::region;
  handles[1].region_id = 5;
  Pipeline<vtkBoundedBiharmonicWeights> run(mesh, to_polydata(handles));
  run.filter->Update();
  EXPECT_EQ(run.filter->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
  ASSERT_EQ(run.listener->errors.size(), 1u);
  EXPECT_THAT(run.listener->errors[0], HasSubstr("'left'"));

  run.filter->SetRegionArrayName("Part");
  run.filter->Update();
  ASSERT_EQ(run.filter->GetStatus(), vtkBindposeAlgorithm::OK) << run.filter->GetStatusMessage();
  for (vtkIdType v = 0; v < mesh->GetNumberOfPoints(); ++v)
  {
    if (labels->GetValue(v) == 5)
    {
      ASSERT_EQ(run.weights()->GetComponent(v, 1), 1.0);
    }
  }
  vtkDataArray* carried = run.output()->GetPointData()->GetArray("Part");
  ASSERT_EQ(carried->GetNumberOfTuples(), run.output()->GetNumberOfPoints());
  EXPECT_EQ(carried->GetTuple1(mesh->GetNumberOfPoints()), 0.0) << "the inserted point is free";
  labels->SetValue(0, 6);
  labels->Modified();
  run.filter->Update();
  EXPECT_EQ(run.filter->GetNumberOfBinds(), 2) << "labels belong to the bind";
}

TEST(WeightsFilters, OriginalPointIdsAndStrayPoints)
{
  const TetMesh box = test::tet_box(4, 4, 4);
  Points points(box.points.rows() + 1, 3);
  points << box.points, Eigen::RowVector3d(9, 9, 9);
  const auto mesh = to_unstructured_grid(points, box.tets);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("OriginalPointIds");
  for (vtkIdType v = 0; v < mesh->GetNumberOfPoints(); ++v)
  {
    ids->InsertNextValue(7);
  }
  mesh->GetPointData()->AddArray(ids);
  Pipeline<vtkBoundedBiharmonicWeights> run(mesh, three_handles());
  run.filter->Update();
  ASSERT_EQ(run.filter->GetStatus(), vtkBindposeAlgorithm::OK) << run.filter->GetStatusMessage();
  vtkDataArray* carried = run.output()->GetPointData()->GetArray("OriginalPointIds");
  EXPECT_EQ(carried->GetTuple1(3), 7);
  EXPECT_EQ(carried->GetTuple1(mesh->GetNumberOfPoints()), -1);
  auto* mask =
    vtkUnsignedCharArray::SafeDownCast(run.output()->GetPointData()->GetArray("WeightsMask"));
  ASSERT_TRUE(mask);
  const vtkIdType stray = box.points.rows();
  EXPECT_EQ(mask->GetValue(stray), 0);
  EXPECT_EQ(mask->GetValue(0), 1);
  for (int j = 0; j < 3; ++j)
  {
    EXPECT_EQ(run.weights()->GetComponent(stray, j), 0.0);
  }
  ASSERT_EQ(run.listener->warnings.size(), 1u);
  EXPECT_THAT(run.listener->warnings[0], HasSubstr("not part of any element"));
}

TEST(WeightsFilters, KeepMeshKeepsEveryObject)
{
  const auto mesh = box_data(6);
  Pipeline<vtkBoundedBiharmonicWeights> run(mesh, three_handles());
  run.filter->KeepMeshOn();
  run.filter->Update();
  ASSERT_EQ(run.filter->GetStatus(), vtkBindposeAlgorithm::OK) << run.filter->GetStatusMessage();
  EXPECT_EQ(run.output()->GetPoints(), mesh->GetPoints());
  EXPECT_EQ(vtkUnstructuredGrid::SafeDownCast(run.output())->GetCells(), mesh->GetCells());
}

TEST(WeightsFilters, WithoutBoundsByMethod)
{
  const auto mesh = square_data(20);
  const auto handles = to_polydata(Handles{ test::point_handle("a", Vec3(0.2, 0.2, 0)),
    test::point_handle("b", Vec3(0.5, 0.5, 0)), test::point_handle("c", Vec3(0.8, 0.75, 0)) });
  Pipeline<vtkUnconstrainedWeights> run(mesh, handles);
  run.filter->Update();
  EXPECT_EQ(run.report().text("method"), "biharmonic");
  EXPECT_LT(run.output()->GetFieldData()->GetArray("WeightsMinimum")->GetTuple1(1), -0.05);
  run.filter->SetMethod("harmonic");
  run.filter->Update();
  EXPECT_EQ(run.report().text("method"), "harmonic");
  EXPECT_GE(run.output()->GetFieldData()->GetArray("WeightsMinimum")->GetTuple1(1), -1e-12);
  run.filter->SetMethod("triharmonic");
  run.filter->Update();
  EXPECT_EQ(run.report().text("method"), "triharmonic");
  EXPECT_EQ(run.filter->GetNumberOfBinds(), 3);
  expect_rows_sum_to_one(run.weights());
}

TEST(WeightsFilters, MetersAndMillimetersGiveTheSameWeights)
{
  const auto mesh = box_data(4);
  const auto handles = three_handles();
  const auto large_mesh = box_data(4);
  const auto large_handles = three_handles();
  for (vtkPointSet* data :
    { static_cast<vtkPointSet*>(large_mesh), static_cast<vtkPointSet*>(large_handles) })
  {
    for (vtkIdType v = 0; v < data->GetNumberOfPoints(); ++v)
    {
      double p[3];
      data->GetPoint(v, p);
      data->GetPoints()->SetPoint(v, 1000.0 * p[0], 1000.0 * p[1], 1000.0 * p[2]);
    }
  }
  Pipeline<vtkBoundedBiharmonicWeights> meters(mesh, handles);
  Pipeline<vtkBoundedBiharmonicWeights> millimeters(large_mesh, large_handles);
  meters.filter->Update();
  millimeters.filter->Update();
  ASSERT_EQ(meters.weights()->GetNumberOfTuples(), millimeters.weights()->GetNumberOfTuples());
  for (vtkIdType i = 0; i < meters.weights()->GetNumberOfValues(); ++i)
  {
    ASSERT_NEAR(meters.weights()->GetValue(i), millimeters.weights()->GetValue(i), 1e-6);
  }
}

TEST(WeightsFilters, CanceledOnceTheNextUpdateSolves)
{
  Pipeline<vtkBoundedBiharmonicWeights> run(box_data(14), three_handles());
  std::chrono::steady_clock::time_point cancel_time;
  run.listener->on_progress = [&](vtkAlgorithm* algorithm)
  {
    const char* phase = algorithm->GetProgressText();
    if (phase && std::string(phase) == "weights" && !algorithm->GetAbortExecute())
    {
      cancel_time = std::chrono::steady_clock::now();
      algorithm->SetAbortExecute(1);
    }
  };
  run.filter->Update();
  const double late =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - cancel_time).count();
  EXPECT_EQ(run.filter->GetStatus(), vtkBindposeAlgorithm::CANCELED);
  EXPECT_LT(late, 10.0); // 0.2 s on an idle machine
  EXPECT_TRUE(run.listener->errors.empty());
  EXPECT_EQ(run.output()->GetNumberOfPoints(), 0);
  EXPECT_EQ(run.filter->GetNumberOfBinds(), 0);
  run.listener->on_progress = nullptr;
  run.filter->SetAbortExecute(0);
  run.filter->Update();
  EXPECT_EQ(run.filter->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_EQ(run.filter->GetNumberOfBinds(), 1);
}

TEST(WeightsFilters, NotConvergedIsAResultThatSaysSo)
{
  Pipeline<vtkBoundedBiharmonicWeights> run(box_data(5), three_handles());
  run.filter->SetMaximumIterations(1);
  run.filter->SetTolerance(1e-9);
  run.filter->Update();
  EXPECT_EQ(run.filter->GetStatus(), vtkBindposeAlgorithm::NOT_CONVERGED);
  ASSERT_TRUE(run.weights());
  expect_rows_sum_to_one(run.weights());
  EXPECT_EQ(run.report().text("status"), "not_converged");
  EXPECT_GT(run.report().number("relative_gap", 0), 1e-9);
  EXPECT_THAT(run.filter->GetStatusMessage(), HasSubstr("not certified"));
}

TEST(WeightsFilters, EveryBadInputIsOneSentence)
{
  const auto message = [](vtkDataObject* mesh, vtkPolyData* handles)
  {
    Pipeline<vtkMonotoneWeights> run(mesh, handles);
    run.filter->Update();
    EXPECT_EQ(run.filter->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
    EXPECT_EQ(run.listener->errors.size(), 1u);
    EXPECT_EQ(run.output()->GetNumberOfPoints(), 0);
    return run.filter->GetStatusMessage();
  };
  vtkNew<vtkPolyData> no_surface;
  vtkNew<vtkUnstructuredGrid> no_grid;
  vtkNew<vtkPolyData> no_handles;
  EXPECT_THAT(message(no_surface, three_handles()), HasSubstr("empty"));
  EXPECT_FALSE(message(no_grid, three_handles()).empty());
  EXPECT_THAT(message(box_data(2), no_handles), HasSubstr("no handle"));
  EXPECT_THAT(message(box_data(2),
                to_polydata(Handles{ test::point_handle("a", Vec3(0.1, 0.1, 0.1)),
                  test::point_handle("b", Vec3(0.1, 0.1, 0.1)) })),
    HasSubstr("'a' and 'b' have the same position"));
  const auto not_a_number = box_data(2);
  not_a_number->GetPoints()->SetPoint(5, 0.0, std::nan(""), 0.0);
  EXPECT_THAT(message(not_a_number, three_handles()), HasSubstr("vertex 5"));
  TetMesh inverted = test::tet_box(2, 2, 2);
  std::swap(inverted.tets(7, 1), inverted.tets(7, 2));
  EXPECT_THAT(message(to_unstructured_grid(inverted.points, inverted.tets), three_handles()),
    HasSubstr("tet 7"));
  vtkNew<vtkUnstructuredGrid> hexahedron;
  hexahedron->SetPoints(box_data(1)->GetPoints());
  const vtkIdType corners[8] = { 0, 1, 3, 2, 4, 5, 7, 6 };
  hexahedron->InsertNextCell(VTK_HEXAHEDRON, 8, corners);
  EXPECT_THAT(message(hexahedron, three_handles()), HasSubstr("expected only tets"));
}

TEST(WeightsFilters, PrintSelfTellsEveryParameter)
{
  const auto text = [](vtkObject* object)
  {
    std::ostringstream stream;
    object->Print(stream);
    return stream.str();
  };
  vtkNew<vtkBoundedBiharmonicWeights> bounded;
  vtkNew<vtkMonotoneWeights> monotone;
  vtkNew<vtkUnconstrainedWeights> unconstrained;
  for (const char* word : { "Tolerance: 1e-06", "MaximumIterations: 100",
         "RegionArrayName: RegionId", "KeepMesh: off", "NumberOfBinds: 0", "Order: 2" })
  {
    EXPECT_THAT(text(bounded), HasSubstr(word));
    EXPECT_THAT(text(monotone), HasSubstr(word));
  }
  EXPECT_THAT(text(unconstrained), HasSubstr("Method: biharmonic"));
  bounded->SetOrder(7);
  EXPECT_EQ(bounded->GetOrder(), 3);
}

TEST(WeightsFilters, OfASurfaceInALatticeComeWithTheLattice)
{
  const TriangleMesh ball = test::sphere(3);
  const auto surface = to_polydata(ball.points, ball.triangles);
  Pipeline<vtkBoundedBiharmonicWeights> weights(surface,
    to_polydata(
      { test::point_handle("a", Vec3(0, 0, 0.9)), test::point_handle("b", Vec3(0.5, 0, -0.7)) }));
  weights.filter->SetDomainToEmbedding();
  weights.filter->SetEmbeddingResolution(8);
  weights.filter->SetKeepRaw(true);
  weights.filter->Update();
  ASSERT_EQ(weights.filter->GetStatus(), static_cast<int>(StatusCode::ok))
    << weights.filter->GetStatusMessage();
  EXPECT_EQ(weights.output()->GetNumberOfPoints(), surface->GetNumberOfPoints());
  expect_rows_sum_to_one(weights.weights());
  EXPECT_TRUE(weights.output()->GetPointData()->HasArray("RawWeights"));
  EXPECT_EQ(weights.report().text("domain"), "embedding");
  auto* lattice = vtkUnstructuredGrid::SafeDownCast(weights.filter->GetOutputDataObject(2));
  ASSERT_TRUE(lattice);
  EXPECT_GT(lattice->GetNumberOfCells(), 100);
  EXPECT_EQ(lattice->GetCellType(0), VTK_TETRA);
  auto* of_lattice = vtkDoubleArray::SafeDownCast(lattice->GetPointData()->GetArray("Weights"));
  ASSERT_TRUE(of_lattice);
  expect_rows_sum_to_one(of_lattice);
  EXPECT_EQ(lattice->GetCellData()->GetArray("InsideFraction")->GetNumberOfTuples(),
    lattice->GetNumberOfCells());

  // A change of the pose never causes a bind; a change of the domain does.
  weights.filter->Modified();
  weights.filter->Update();
  EXPECT_EQ(weights.filter->GetNumberOfBinds(), 1);
  weights.filter->SetDomainToSurface();
  weights.filter->Update();
  EXPECT_EQ(weights.filter->GetNumberOfBinds(), 2);
  EXPECT_EQ(weights.report().text("domain"), "surface");
  EXPECT_EQ(
    vtkDataSet::SafeDownCast(weights.filter->GetOutputDataObject(2))->GetNumberOfCells(), 0);
}

TEST(WeightsFilters, ExtremaComeAsPoints)
{
  // The biharmonic weights of the five points on a square have 5, 5, 4, 5 and 4 extrema,
  // respectively.
  Pipeline<vtkUnconstrainedWeights> weights(square_data(40),
    to_polydata({ test::point_handle("c", Vec3(0.5, 0.5, 0)),
      test::point_handle("a", Vec3(0.2, 0.2, 0)), test::point_handle("b", Vec3(0.8, 0.2, 0)),
      test::point_handle("d", Vec3(0.8, 0.8, 0)), test::point_handle("e", Vec3(0.2, 0.8, 0)) }));
  weights.filter->SetMethod("biharmonic");
  weights.filter->SetKeepRaw(true);
  weights.filter->Update();
  vtkDataArray* raw = weights.output()->GetPointData()->GetArray("RawWeights");
  auto* extrema = vtkPolyData::SafeDownCast(weights.filter->GetOutputDataObject(1));
  ASSERT_TRUE(extrema);
  vtkDataArray* counted = weights.output()->GetFieldData()->GetArray("WeightsInteriorExtrema");
  double sum = 0.0;
  for (vtkIdType j = 0; j < counted->GetNumberOfTuples(); ++j)
  {
    sum += counted->GetComponent(j, 0);
  }
  EXPECT_GT(sum, 0.0);
  ASSERT_EQ(static_cast<double>(extrema->GetNumberOfPoints()), sum);
  EXPECT_EQ(extrema->GetNumberOfVerts(), extrema->GetNumberOfPoints());
  vtkPointData* data = extrema->GetPointData();
  for (vtkIdType i = 0; i < extrema->GetNumberOfPoints(); ++i)
  {
    const double kind = data->GetArray("Kind")->GetComponent(i, 0);
    const auto handle = static_cast<int>(data->GetArray("Handle")->GetComponent(i, 0));
    EXPECT_TRUE(kind == 1.0 || kind == -1.0);
    EXPECT_GT(data->GetArray("Persistence")->GetComponent(i, 0), 1e-3);
    const vtkIdType at = weights.output()->FindPoint(extrema->GetPoint(i));
    EXPECT_EQ(data->GetArray("Value")->GetComponent(i, 0), raw->GetComponent(at, handle));
  }
}

TEST(WeightsFilters, APreviewIsThereBeforeTheWeights)
{
  Pipeline<vtkBoundedBiharmonicWeights> weights(box_data(8), three_handles());
  struct ReceivedPreview
  {
    int calls = 0;
    vtkSmartPointer<vtkDoubleArray> array;
  } received;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&received);
  observer->SetCallback(
    [](vtkObject*, unsigned long, void* client, void* call)
    {
      auto* to = static_cast<ReceivedPreview*>(client);
      to->calls += 1;
      to->array = vtkDoubleArray::SafeDownCast(static_cast<vtkObject*>(call));
    });
  weights.filter->AddObserver(vtkWeightsAlgorithm::PreviewEvent, observer);
  weights.filter->Update();
  EXPECT_EQ(received.calls, 1);
  ASSERT_TRUE(received.array);
  EXPECT_EQ(received.array->GetNumberOfTuples(), 9 * 9 * 9);
  EXPECT_EQ(received.array->GetNumberOfComponents(), 3);
  EXPECT_STREQ(received.array->GetComponentName(2), "middle");
  expect_rows_sum_to_one(received.array);
  EXPECT_LE(weights.report().number("relative_gap", 1.0), 1e-6);

  Pipeline<vtkBoundedBiharmonicWeights> only(box_data(8), three_handles());
  only.filter->SetStageToPreview();
  only.filter->Update();
  EXPECT_EQ(only.report().text("stage"), "preview");
  for (vtkIdType v = 0; v < received.array->GetNumberOfTuples(); ++v)
  {
    ASSERT_EQ(received.array->GetComponent(v, 0), only.weights()->GetComponent(v, 0));
  }
}

TEST(WeightsFilters, TermsComeFromArraysAndBelongToTheBind)
{
  const auto mesh = square_data(12);
  const auto handles = to_polydata({ test::point_handle("left", Vec3(0.25, 0.25, 0)),
    test::point_handle("right", Vec3(0.75, 0.75, 0)) });
  const vtkIdType count = mesh->GetNumberOfPoints();
  vtkNew<vtkDoubleArray> pins;
  pins->SetName("PinnedWeights");
  pins->SetNumberOfComponents(2);
  pins->SetNumberOfTuples(count);
  pins->Fill(std::nan(""));
  const vtkIdType pinned = vertex_at(mesh, 0.5, 0.25, 0, 1e-9);
  pins->SetComponent(pinned, 0, 0.9);
  vtkNew<vtkIntArray> sets;
  sets->SetName("Blocks");
  sets->SetNumberOfTuples(count);
  sets->Fill(0);
  const vtkIdType block[] = { vertex_at(mesh, 0.75, 0.25, 0, 1e-9),
    vertex_at(mesh, 1.0, 0.25, 0, 1e-9) };
  sets->SetValue(block[0], 4);
  sets->SetValue(block[1], 4);
  mesh->GetPointData()->AddArray(pins);
  mesh->GetPointData()->AddArray(sets);

  Pipeline<vtkBoundedBiharmonicWeights> pipeline(mesh, handles);
  pipeline.filter->Update();
  ASSERT_TRUE(pipeline.listener->errors.empty());
  EXPECT_EQ(pipeline.weights()->GetComponent(pinned, 0), 0.9);
  EXPECT_NEAR(pipeline.weights()->GetComponent(pinned, 1), 0.1, 1e-12);
  EXPECT_NE(
    pipeline.weights()->GetComponent(block[0], 0), pipeline.weights()->GetComponent(block[1], 0));
  pipeline.filter->SetRigidSetArrayName("Blocks");
  pipeline.filter->SetPartitionOfUnity(vtkWeightsAlgorithm::COUPLED);
  pipeline.filter->Update();
  EXPECT_EQ(pipeline.filter->GetNumberOfBinds(), 2);
  EXPECT_EQ(
    pipeline.weights()->GetComponent(block[0], 0), pipeline.weights()->GetComponent(block[1], 0));
  EXPECT_EQ(pipeline.report().text("partition.of_unity"), "coupled");
  pipeline.filter->Update();
  EXPECT_EQ(pipeline.filter->GetNumberOfBinds(), 2);
  pins->SetComponent(pinned, 0, 0.8);
  pins->Modified();
  mesh->Modified();
  pipeline.filter->Update();
  EXPECT_EQ(pipeline.filter->GetNumberOfBinds(), 3) << "a brush stroke binds again";
  EXPECT_EQ(pipeline.weights()->GetComponent(pinned, 0), 0.8);

  // If the array name is empty, the pinned values have no effect. Methods without bounds ignore
  // pinned values.
  pipeline.filter->SetPinnedArrayName("");
  pipeline.filter->SetMaximumInfluences(1);
  pipeline.filter->Update();
  EXPECT_NE(pipeline.weights()->GetComponent(pinned, 0), 0.8);
  EXPECT_GT(pipeline.report().number("counts.capped_vertices", 0), 0);
  Pipeline<vtkUnconstrainedWeights> plain(mesh, handles);
  plain.filter->Update();
  EXPECT_TRUE(plain.listener->errors.empty());
  EXPECT_NE(plain.weights()->GetComponent(pinned, 0), 0.8);
}

TEST(WeightsFilters, HandlesHaveBoundsOfTheirOwn)
{
  const auto mesh = square_data(12);
  const auto handles = to_polydata({ test::point_handle("left", Vec3(0.25, 0.25, 0)),
    test::point_handle("right", Vec3(0.75, 0.75, 0)),
    test::point_handle("low", Vec3(0.75, 0.25, 0)),
    test::point_handle("middle", Vec3(0.5, 0.5, 0)) });
  Pipeline<vtkUnconstrainedWeights> free(mesh, handles);
  free.filter->SetMethod("biharmonic");
  free.filter->SetKeepRaw(true);
  free.filter->Update();
  vtkNew<vtkDoubleArray> bounds;
  bounds->SetName("WeightBounds");
  bounds->SetNumberOfComponents(2);
  bounds->SetNumberOfTuples(4);
  bounds->Fill(std::nan(""));
  bounds->SetTuple2(1, -10, 10); // these bounds are too wide to have an effect
  handles->GetCellData()->AddArray(bounds);
  Pipeline<vtkBoundedBiharmonicWeights> pipeline(mesh, handles);
  pipeline.filter->SetTolerance(1e-9);
  pipeline.filter->SetKeepRaw(true);
  pipeline.filter->Update();
  ASSERT_TRUE(pipeline.listener->errors.empty());
  const auto raw = [](auto& of)
  { return vtkDoubleArray::SafeDownCast(of.output()->GetPointData()->GetArray("RawWeights")); };
  double range[2];
  raw(pipeline)->GetRange(range, 0);
  EXPECT_GE(range[0], 0.0);
  raw(pipeline)->GetRange(range, 1);
  EXPECT_LT(range[0], -1e-3);
  ASSERT_EQ(raw(free)->GetNumberOfTuples(), raw(pipeline)->GetNumberOfTuples());
  for (vtkIdType v = 0; v < mesh->GetNumberOfPoints(); ++v)
  {
    EXPECT_NEAR(raw(pipeline)->GetComponent(v, 1), raw(free)->GetComponent(v, 1), 1e-6);
  }
  // A change of bounds causes a bind.
  bounds->SetTuple2(1, 0, 1);
  bounds->Modified();
  handles->Modified();
  pipeline.filter->Update();
  EXPECT_EQ(pipeline.filter->GetNumberOfBinds(), 2);
  raw(pipeline)->GetRange(range, 1);
  EXPECT_GE(range[0], 0.0);
  bounds->SetNumberOfComponents(1);
  bounds->SetNumberOfTuples(4);
  bounds->Fill(0.5);
  bounds->Modified();
  handles->Modified();
  pipeline.filter->Update();
  EXPECT_THAT(pipeline.report().text("message"), HasSubstr("the smallest and the largest weight"));
}

TEST(WeightsFilters, MirroredHandlesByAPlane)
{
  const auto mesh = square_data(12);
  const auto handles = to_polydata({ test::point_handle("left", Vec3(0.25, 0.25, 0)),
    test::point_handle("right", Vec3(0.75, 0.25, 0)),
    test::point_handle("top", Vec3(0.25, 1, 0)) });
  Pipeline<vtkMonotoneWeights> pipeline(mesh, handles);
  pipeline.filter->SetKeepRaw(true);
  pipeline.filter->SetMirrorNormal(1, 0, 0);
  pipeline.filter->SetMirrorOrigin(0.5, 0, 0);
  pipeline.filter->Update();
  ASSERT_TRUE(pipeline.listener->errors.empty());
  vtkDataArray* raw = pipeline.output()->GetPointData()->GetArray("RawWeights");
  const vtkIdType a = vertex_at(mesh, 0.25, 0.5, 0, 1e-9);
  const vtkIdType b = vertex_at(mesh, 0.75, 0.5, 0, 1e-9);
  EXPECT_EQ(raw->GetComponent(a, 0), raw->GetComponent(b, 1));
  EXPECT_GT(raw->GetComponent(a, 0), 0.01);
}

TEST(WeightsFilters, TermsThatContradictAreErrors)
{
  const auto mesh = square_data(12);
  const auto handles = to_polydata({ test::point_handle("left", Vec3(0.25, 0.25, 0)),
    test::point_handle("right", Vec3(0.75, 0.75, 0)) });
  vtkNew<vtkDoubleArray> upper;
  upper->SetName("WeightsUpper");
  upper->SetNumberOfComponents(3);
  upper->SetNumberOfTuples(mesh->GetNumberOfPoints());
  upper->Fill(0.5);
  mesh->GetPointData()->AddArray(upper);
  Pipeline<vtkBoundedBiharmonicWeights> pipeline(mesh, handles);
  pipeline.filter->Update();
  EXPECT_THAT(pipeline.report().text("message"), HasSubstr("2 components"));
  vtkNew<vtkDoubleArray> two;
  two->SetName("WeightsUpper");
  two->SetNumberOfComponents(2);
  two->SetNumberOfTuples(mesh->GetNumberOfPoints());
  two->Fill(0.5);
  mesh->GetPointData()->AddArray(two);
  pipeline.filter->Update();
  EXPECT_THAT(pipeline.report().text("message"), HasSubstr("'left'"));
}
