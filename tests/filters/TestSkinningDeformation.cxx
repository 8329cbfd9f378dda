// vtkSkinningDeformation: the identity, rigid motions and joints give the results that the kernel
// documents. Many poses need only one bind. Error messages name the wrong input.
#include "vtkSkinningDeformation.h"

#include "conversion.h"
#include "pseudo_edge_cells.h"
#include "report_field_data.h"
#include "vtkPoseHandles.h"

#include "support/meshes.h"

#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

namespace
{
/// Return two bones along z that share the origin as a joint.
vtkSmartPointer<vtkPolyData> two_bones()
{
  Handles handles(2);
  handles[0].name = "lower";
  handles[1].name = "upper";
  for (int k = 0; k < 2; ++k)
  {
    handles[k].kind = HandleKind::bone;
    handles[k].head = Vec3(0, 0, k - 1.0);
    handles[k].tail = Vec3(0, 0, k);
  }
  return to_polydata(handles);
}

/// Return weights that change linearly from the lower to the upper bone within |z| < 1/2. Both
/// weights are 1/2 at z = 0.
vtkSmartPointer<vtkDoubleArray> weights_of(PointsView points)
{
  auto weights = vtkSmartPointer<vtkDoubleArray>::New();
  weights->SetName("Weights");
  weights->SetNumberOfComponents(2);
  for (Index v = 0; v < points.rows(); ++v)
  {
    const double w = std::min(1.0, std::max(0.0, 0.5 + points(v, 2)));
    const double row[2] = { 1.0 - w, w };
    weights->InsertNextTuple(row);
  }
  return weights;
}

/// Return a tube of radius 1 around the z axis, from z = -1 to z = 1, with weights and normals. A
/// ring of its points is at z = 0.
vtkSmartPointer<vtkPolyData> tube()
{
  TriangleMesh mesh = test::grid(24, 8, 2.0 * std::acos(-1.0), 2.0);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    const double angle = mesh.points(v, 0);
    const double z = mesh.points(v, 1) - 1.0;
    mesh.points.row(v) << std::cos(angle), std::sin(angle), z;
  }
  const auto data = to_polydata(mesh.points, mesh.triangles);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(data);
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->Update();
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->ShallowCopy(normals->GetOutput());
  result->GetPointData()->AddArray(weights_of(mesh.points));
  return result;
}

std::string turn_upper(double degrees, const char* axis)
{
  return R"({"handles": {"upper": {"rotate": {"axis": )" + std::string(axis) + R"(, "degrees": )" +
    std::to_string(degrees) + "}}}}";
}

class SkinningDeformation : public testing::Test
{
protected:
  SkinningDeformation()
  {
    this->mesh = tube();
    this->handles = two_bones();
    this->pose->SetInputData(this->handles);
    this->filter->SetInputData(0, this->mesh);
    this->filter->SetInputConnection(1, this->pose->GetOutputPort());
    vtkNew<vtkCallbackCommand> keep;
    keep->SetClientData(&this->error);
    keep->SetCallback([](vtkObject*, unsigned long, void* client, void* data)
      { *static_cast<std::string*>(client) = static_cast<const char*>(data); });
    this->filter->AddObserver(vtkCommand::ErrorEvent, keep);
    this->filter->AddObserver(vtkCommand::WarningEvent, keep);
  }

  /// Return the largest distance from the axis over the ring of points at z = 0, where both weights
  /// are 1/2.
  double ring_radius()
  {
    double radius = 0.0;
    for (vtkIdType v = 0; v < this->mesh->GetNumberOfPoints(); ++v)
    {
      double rest[3];
      double p[3];
      this->mesh->GetPoint(v, rest);
      this->filter->GetOutput()->GetPoint(v, p);
      if (std::abs(rest[2]) < 1e-9)
      {
        radius = std::max(radius, std::hypot(p[0], p[1]));
      }
    }
    return radius;
  }

  vtkSmartPointer<vtkPolyData> mesh;
  vtkSmartPointer<vtkPolyData> handles;
  vtkNew<vtkPoseHandles> pose;
  vtkNew<vtkSkinningDeformation> filter;
  std::string error;
};
} // namespace

TEST_F(SkinningDeformation, RestStaysAtRestAndArraysAreShared)
{
  this->filter->Update();
  vtkDataSet* output = this->filter->GetOutput();
  ASSERT_EQ(output->GetNumberOfPoints(), this->mesh->GetNumberOfPoints());
  for (vtkIdType v = 0; v < output->GetNumberOfPoints(); ++v)
  {
    double p[3];
    double q[3];
    output->GetPoint(v, p);
    this->mesh->GetPoint(v, q);
    EXPECT_EQ(Vec3(p[0], p[1], p[2]), Vec3(q[0], q[1], q[2]));
  }
  EXPECT_EQ(
    output->GetPointData()->GetArray("Weights"), this->mesh->GetPointData()->GetArray("Weights"));
  EXPECT_EQ(vtkPolyData::SafeDownCast(output)->GetPolys(), this->mesh->GetPolys());
}

TEST_F(SkinningDeformation, ATwistedJointShrinksUnderLinearBlendAndKeepsItsRadiusUnderDual)
{
  const std::pair<double, double> shrunk[] = { { 90.0, std::sqrt(0.5) }, { 120.0, 0.5 } };
  for (const auto& [degrees, radius] : shrunk)
  {
    this->pose->SetPoseJSON(turn_upper(degrees, "[0, 0, 1]"));
    this->filter->SetMethodToLinearBlend();
    this->filter->Update();
    EXPECT_NEAR(this->ring_radius(), radius, 1e-6); // the points of the mesh are floats
    for (const int method :
      { vtkSkinningDeformation::DUAL_QUATERNION, vtkSkinningDeformation::CENTERS_OF_ROTATION })
    {
      this->filter->SetMethod(method);
      this->filter->Update();
      EXPECT_NEAR(this->ring_radius(), 1.0, 1e-6);
    }
  }
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
}

TEST_F(SkinningDeformation, NormalsTurnWithARigidMotion)
{
  for (const int method : { vtkSkinningDeformation::LINEAR_BLEND,
         vtkSkinningDeformation::DUAL_QUATERNION, vtkSkinningDeformation::CENTERS_OF_ROTATION })
  {
    this->filter->SetMethod(method);
    this->handles->GetCellData()->GetArray("Parent")->SetComponent(1, 0, 0);
    this->pose->SetPoseJSON(R"({"handles": {"lower": {"rotate": {"axis": [1, 0, 0], "degrees": 90}},
      "upper": {"space": "parent", "translate": [0, 0, 0]}}})");
    this->handles->GetCellData()->GetArray("Parent")->Modified();
    this->handles->Modified();
    this->filter->Update();
    vtkDataArray* before = this->mesh->GetPointData()->GetNormals();
    vtkDataArray* after = this->filter->GetOutput()->GetPointData()->GetNormals();
    ASSERT_NE(before, after);
    for (vtkIdType v = 0; v < before->GetNumberOfTuples(); v += 5)
    {
      double n[3];
      double m[3];
      before->GetTuple(v, n);
      after->GetTuple(v, m);
      EXPECT_NEAR(m[0], n[0], 1e-6);
      EXPECT_NEAR(m[1], -n[2], 1e-6);
      EXPECT_NEAR(m[2], n[1], 1e-6);
    }
  }
}

TEST_F(SkinningDeformation, AHundredDragsBindOnce)
{
  for (int k = 0; k < 100; ++k)
  {
    this->pose->SetPoseJSON(turn_upper(k, "[1, 0, 0]"));
    this->filter->Update();
  }
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  // A widget edits the array of transforms in place. Such an edit does not cause a bind.
  this->filter->SetInputData(1, this->handles);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  vtkDataArray* transforms = this->handles->GetCellData()->GetArray("Transform");
  for (int k = 0; k < 100; ++k)
  {
    transforms->SetComponent(1, 3, 0.01 * k);
    transforms->Modified();
    this->handles->Modified();
    this->filter->Update();
  }
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  double bounds[6];
  this->filter->GetOutput()->GetBounds(bounds);
  EXPECT_NEAR(bounds[1], 1.99, 1e-6);
  // A change of the weights causes a bind.
  this->mesh->GetPointData()->GetArray("Weights")->Modified();
  this->mesh->Modified();
  this->filter->Update();
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 2);
}

TEST_F(SkinningDeformation, TetsArePosedToo)
{
  const TetMesh box = test::tet_box(2, 2, 2, Vec3(-1, -1, -1), Vec3(1, 1, 1));
  const auto grid = to_unstructured_grid(box.points, box.tets);
  grid->GetPointData()->AddArray(weights_of(box.points));
  this->filter->SetInputData(0, grid);
  this->pose->SetPoseJSON(R"({"handles": {"lower": {"translate": [1, 2, 3]},
    "upper": {"translate": [1, 2, 3]}}})");
  this->filter->Update();
  auto* output = vtkUnstructuredGrid::SafeDownCast(this->filter->GetOutput());
  ASSERT_NE(output, nullptr);
  EXPECT_EQ(output->GetNumberOfCells(), 48);
  double p[3];
  output->GetPoint(0, p);
  EXPECT_NEAR((Vec3(p[0], p[1], p[2]) - Vec3(0, 1, 2)).norm(), 0.0, 1e-14);
}

TEST_F(SkinningDeformation, WhatDoesNotFitIsNamed)
{
  const auto expect_error = [this](const std::string& words)
  {
    this->error.clear();
    this->filter->Update();
    EXPECT_NE(this->error.find(words), std::string::npos) << this->error;
    EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
    EXPECT_EQ(this->filter->GetOutput()->GetNumberOfPoints(), 0);
  };
  this->filter->SetArrayName("W");
  expect_error("no point array 'W'");
  this->filter->SetArrayName("Weights");

  Handles one(1);
  one[0].name = "only";
  const auto single = to_polydata(one);
  this->filter->SetInputData(1, single);
  expect_error("2 components, but there are 1 handles");
  this->filter->SetInputConnection(1, this->pose->GetOutputPort());

  vtkDataArray* weights = this->mesh->GetPointData()->GetArray("Weights");
  weights->SetComponent(3, 0, std::nan(""));
  weights->Modified();
  this->mesh->Modified();
  expect_error("vertex 3");
  weights->SetComponent(3, 0, 5.0);
  weights->Modified();
  this->mesh->Modified();
  this->error.clear();
  this->filter->Update();
  EXPECT_NE(this->error.find("do not sum to one"), std::string::npos) << this->error;
  EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::OK);
}

TEST_F(SkinningDeformation, AFreeHandleIsNamedInAWarning)
{
  this->pose->SetPoseJSON(R"({"handles": {"upper": {"mode": "free"}}})");
  this->filter->Update();
  EXPECT_NE(this->error.find("upper"), std::string::npos) << this->error;
  EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::OK);
}

TEST_F(SkinningDeformation, BonesStretchAlongTheirEndpointWeights)
{
  // This makes the bone three times as long.
  this->pose->SetPoseJSON(R"({"handles": {"upper": {"tail": [0, 0, 3]}}})");
  this->filter->SetMethodToStretchableBones();
  this->filter->Update();
  ASSERT_EQ(this->error, "");
  const auto top = [&]
  {
    double bounds[6];
    this->filter->GetOutput()->GetBounds(bounds);
    return bounds[5];
  };
  EXPECT_NEAR(top(), 3.0, 1e-12);
  EXPECT_NEAR(this->ring_radius(), 1.0, 1e-12);
  this->filter->SetMethodToLinearBlend();
  this->filter->Update();
  EXPECT_NEAR(top(), 1.0, 1e-12) << "without endpoints bones are rigid";
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);

  vtkNew<vtkDoubleArray> endpoints;
  endpoints->SetName("EndpointWeights");
  endpoints->SetNumberOfComponents(2);
  endpoints->SetNumberOfTuples(this->mesh->GetNumberOfPoints());
  endpoints->Fill(0.5);
  this->mesh->GetPointData()->AddArray(endpoints);
  this->filter->SetMethodToStretchableBones();
  this->filter->Update();
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 2);
  EXPECT_NEAR(top(), 2.0, 1e-12) << "half of what the tail moves";
  this->filter->SetEndpointArrayName("");
  this->filter->Update();
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 3);
  EXPECT_NEAR(top(), 3.0, 1e-12);

  this->filter->SetEndpointArrayName("EndpointWeights");
  endpoints->SetComponent(5, 1, 1.5);
  endpoints->Modified();
  this->filter->Update();
  EXPECT_NE(this->error.find("for handle 'upper' at point 5"), std::string::npos) << this->error;
  endpoints->SetNumberOfComponents(1);
  endpoints->SetNumberOfTuples(3);
  endpoints->Modified();
  this->error.clear();
  this->filter->Modified();
  this->filter->Update();
  EXPECT_NE(this->error.find("'EndpointWeights' has 3 tuples"), std::string::npos) << this->error;
}

TEST_F(SkinningDeformation, InSinglePrecisionWithFewInfluencesSaysWhatItDropped)
{
  this->pose->SetPoseJSON(turn_upper(70, "[1, 0, 0]").c_str());
  this->filter->Update();
  vtkNew<vtkPolyData> exact;
  exact->DeepCopy(this->filter->GetOutput());
  this->filter->SinglePrecisionOn();
  this->filter->Update();
  ASSERT_EQ(this->error, "");
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 2);
  double farthest = 0.0;
  for (vtkIdType v = 0; v < exact->GetNumberOfPoints(); ++v)
  {
    double p[3];
    double q[3];
    exact->GetPoint(v, p);
    this->filter->GetOutput()->GetPoint(v, q);
    farthest = std::max(farthest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
  }
  EXPECT_GT(farthest, 0.0);
  EXPECT_LT(farthest, 1e-6);
  this->filter->SetMaximumInfluences(1);
  this->filter->Update();
  const Report report = read_report(this->filter->GetOutput());
  EXPECT_GT(report.number("counts.dropped_weights", 0), 0);
  EXPECT_NEAR(report.number("dropped_share", 0), 0.5, 1e-12) << "of the ring in the middle";
  this->filter->SetSmallestWeight(2.0);
  this->filter->Update();
  EXPECT_NE(this->error.find("smallest weight"), std::string::npos) << this->error;
}

TEST_F(SkinningDeformation, CentersAreMadeOnceAndCanBeCanceled)
{
  this->pose->SetPoseJSON(turn_upper(90.0, "[0, 0, 1]"));
  this->filter->Update();
  EXPECT_EQ(this->filter->GetReport().find("seconds.centers"), nullptr);
  this->filter->SetMethodToCentersOfRotation();
  this->filter->Update();
  Report report = this->filter->GetReport();
  EXPECT_NE(report.find("seconds.centers"), nullptr);
  EXPECT_GT(report.number("counts.centers", 0), 0);
  this->pose->SetPoseJSON(turn_upper(120.0, "[0, 0, 1]"));
  this->filter->Update();
  report = this->filter->GetReport();
  EXPECT_EQ(report.find("seconds.centers"), nullptr) << "kept";
  EXPECT_GT(report.number("counts.centers", 0), 0);
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);

  this->mesh->GetPointData()->GetArray("Weights")->Modified();
  this->mesh->Modified();
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1); });
  const unsigned long tag = this->filter->AddObserver(vtkCommand::ProgressEvent, stop);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::CANCELED);
  this->filter->RemoveObserver(tag);
  this->filter->SetAbortExecute(0);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_NEAR(this->ring_radius(), 1.0, 1e-6);
}

TEST_F(SkinningDeformation, PseudoEdgesTurnPointsThatAreDragged)
{
  // The handles are three points on a square. The square is rotated by 90 degrees about the first
  // point.
  const TriangleMesh square = test::grid(4, 4);
  const auto flat = to_polydata(square.points, square.triangles);
  vtkNew<vtkDoubleArray> weights;
  weights->SetName("Weights");
  weights->SetNumberOfComponents(3);
  for (Index v = 0; v < square.points.rows(); ++v)
  {
    const double row[3] = { 0.2 * square.points(v, 0), 0.7 * square.points(v, 1),
      1.0 - 0.2 * square.points(v, 0) - 0.7 * square.points(v, 1) };
    weights->InsertNextTuple(row);
  }
  flat->GetPointData()->AddArray(weights);
  Handles points(3);
  const Vec3 places[3] = { Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0) };
  for (int k = 0; k < 3; ++k)
  {
    points[k].name = "p" + std::to_string(k);
    points[k].head = points[k].tail = places[k];
  }
  this->filter->SetInputData(0, flat);
  this->pose->SetPoseJSON(R"({"handles": {"p1": {"mode": "position", "translate": [-1, 1, 0]},
    "p2": {"mode": "position", "translate": [-2, 0, 0]}}})");
  const auto farthest = [&]
  {
    double most = 0.0;
    for (Index v = 0; v < square.points.rows(); ++v)
    {
      double p[3];
      this->filter->GetOutput()->GetPoint(v, p);
      most = std::max(most, std::hypot(p[0] + square.points(v, 1), p[1] - square.points(v, 0)));
    }
    return most;
  };
  const auto without = to_polydata(points);
  this->pose->SetInputData(without);
  this->filter->Update();
  EXPECT_GT(farthest(), 0.5) << "translations do not turn";
  EXPECT_EQ(read_report(this->filter->GetOutput()).find("counts.pseudo_edges"), nullptr);
  this->filter->SetPseudoEdges(vtkSkinningDeformation::AUTOMATIC_PSEUDO_EDGES);
  this->filter->Update();
  EXPECT_LT(farthest(), 1e-14);
  EXPECT_EQ(read_report(this->filter->GetOutput()).number("counts.pseudo_edges", 0), 2);

  const auto with = to_polydata(points);
  add_pseudo_edges(with, { 0, 1, 2 }, { { 1, 0 }, { 1, 2 } });
  EXPECT_EQ(with->GetNumberOfCells(), 5);
  this->pose->SetInputData(with);
  this->filter->SetPseudoEdges(vtkSkinningDeformation::GIVEN_PSEUDO_EDGES);
  this->filter->Update();
  EXPECT_LT(farthest(), 1e-14);
  this->filter->SetPseudoEdges(vtkSkinningDeformation::NO_PSEUDO_EDGES);
  this->filter->Update();
  EXPECT_GT(farthest(), 0.5);
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 2) << "other handles, nothing else";
  ASSERT_EQ(this->error, "");
}

TEST_F(SkinningDeformation, ReportsWhatIsInsideOutAndStretched)
{
  // The upper half moves down through the lower half.
  const TetMesh box = test::tet_box(2, 2, 8, Vec3(-1, -1, -1), Vec3(1, 1, 1));
  const auto grid = to_unstructured_grid(box.points, box.tets);
  grid->GetPointData()->AddArray(weights_of(box.points));
  this->filter->SetInputData(0, grid);
  this->filter->Update();
  Report report = read_report(this->filter->GetOutput());
  EXPECT_EQ(report.number("counts.elements", 0), 192);
  EXPECT_EQ(report.number("counts.inverted_elements", -1), 0);
  EXPECT_EQ(report.number("counts.stretched_elements", -1), 0);
  EXPECT_NEAR(report.number("largest_stretch", 0), 1.0, 1e-12);
  EXPECT_EQ(this->filter->GetOutput()->GetCellData()->GetArray("Stretch"), nullptr);

  this->pose->SetPoseJSON(R"({"handles": {"upper": {"translate": [0, 0, -3]}}})");
  this->filter->StretchArrayOn();
  this->filter->Update();
  // Between z = -1/2 and 1/2, the pose maps z to z - 3 (z + 1/2), which is a scale of -2 along z.
  // Half of the tets are in this range.
  report = read_report(this->filter->GetOutput());
  EXPECT_EQ(report.number("counts.inverted_elements", 0), 96);
  EXPECT_EQ(report.number("counts.stretched_elements", -1), 0) << "not beyond twice";
  EXPECT_NEAR(report.number("largest_stretch", 0), 2.0, 1e-12);
  EXPECT_NEAR(report.number("smallest_stretch", 0), 1.0, 1e-12);
  EXPECT_NE(this->error.find("inverts 96 of 192 tets"), std::string::npos) << this->error;
  vtkDataArray* stretch = this->filter->GetOutput()->GetCellData()->GetArray("Stretch");
  ASSERT_NE(stretch, nullptr);
  int inverted = 0;
  for (vtkIdType c = 0; c < stretch->GetNumberOfTuples(); ++c)
  {
    inverted += stretch->GetComponent(c, 1) < 0.0 ? 1 : 0;
    EXPECT_NEAR(std::abs(stretch->GetComponent(c, 1)), 1.0, 1e-12);
  }
  EXPECT_EQ(inverted, 96);
  this->filter->SetStretchLimit(1.5);
  this->filter->Update();
  report = read_report(this->filter->GetOutput());
  EXPECT_EQ(report.number("counts.stretched_elements", 0), 96);

  this->filter->SetStretchLimit(0.0);
  this->error.clear();
  this->filter->Update();
  EXPECT_EQ(this->error, "");
  EXPECT_EQ(read_report(this->filter->GetOutput()).find("counts.elements"), nullptr);
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  this->filter->SetStretchLimit(0.5);
  this->filter->Update();
  EXPECT_NE(this->error.find("must be at least 1"), std::string::npos) << this->error;
}

TEST_F(SkinningDeformation, StretchOfHexesAndPolygonsIsThatOfTheirParts)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (int v = 0; v < 8; ++v)
  {
    points->InsertNextPoint(v & 1, v >> 1 & 1, v >> 2);
  }
  grid->SetPoints(points);
  const vtkIdType line[2] = { 0, 1 };
  const vtkIdType hex[8] = { 0, 1, 3, 2, 4, 5, 7, 6 };
  grid->InsertNextCell(VTK_LINE, 2, line);
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, hex);
  vtkNew<vtkDoubleArray> weights;
  weights->SetName("Weights");
  weights->SetNumberOfComponents(2);
  weights->SetNumberOfTuples(8);
  for (int v = 0; v < 8; ++v)
  {
    weights->SetTuple2(v, v < 4, v >= 4);
  }
  grid->GetPointData()->AddArray(weights);
  this->filter->SetInputData(0, grid);
  this->filter->StretchArrayOn();
  this->pose->SetPoseJSON(R"({"handles": {"upper": {"translate": [0, 0, 2]}}})");
  this->filter->Update();
  const Report report = read_report(this->filter->GetOutput());
  EXPECT_EQ(report.number("counts.elements", 0), 5) << "tets of a hex";
  EXPECT_EQ(report.number("counts.stretched_elements", 0), 5);
  EXPECT_NEAR(report.number("largest_stretch", 0), 3.0, 1e-12);
  EXPECT_NEAR(report.number("smallest_stretch", 0), 1.0, 1e-12);
  vtkDataArray* stretch = this->filter->GetOutput()->GetCellData()->GetArray("Stretch");
  EXPECT_TRUE(std::isnan(stretch->GetComponent(0, 0)));
  EXPECT_NEAR(stretch->GetComponent(1, 0), 3.0, 1e-12);
  EXPECT_NEAR(stretch->GetComponent(1, 1), 1.0, 1e-12);
}
