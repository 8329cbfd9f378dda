// vtkAutomaticHandles computes handles from a surface. The weights filters accept its output as
// handles.
#include "vtkAutomaticHandles.h"

#include "conversion.h"
#include "filters/TestFilter.h"
#include "handle_tgf.h"
#include "report_field_data.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/needs_mesher.h"
#include "vtkBoundedBiharmonicWeights.h"
#include "vtkHandleFileReader.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

using namespace bindpose;
using test::Listener;
using testing::HasSubstr;

namespace
{
class AutomaticBones : public test::MesherTest
{
};

/// Return tets of the box [0, 8] x [0, 1] x [0, 1].
TetMesh long_box()
{
  return test::tet_box(24, 3, 3, Vec3::Zero(), Vec3(8.0, 1.0, 1.0));
}

vtkSmartPointer<vtkPolyData> surface()
{
  const TetMesh box = long_box();
  return to_polydata(box.points, boundary_triangles(box.tets));
}

Handles handles_of(vtkAutomaticHandles* filter)
{
  Handles handles;
  const Status status = to_handles(vtkPolyData::SafeDownCast(filter->GetOutput()), handles);
  EXPECT_TRUE(status.ok()) << status.message;
  return handles;
}
} // namespace

TEST_F(AutomaticBones, BindWithoutAHand)
{
  vtkNew<vtkAutomaticHandles> filter;
  filter->SetInputData(surface());
  filter->SetLongestBone(0.3);
  const TetMesh box = long_box();
  const auto tets = to_unstructured_grid(box.points, box.tets);
  vtkNew<vtkBoundedBiharmonicWeights> weights;
  weights->SetInputData(tets);
  weights->SetInputConnection(1, filter->GetOutputPort());
  weights->Update();
  ASSERT_EQ(filter->GetStatus(), vtkAutomaticHandles::OK) << filter->GetStatusMessage();
  ASSERT_EQ(weights->GetStatus(), vtkAutomaticHandles::OK) << weights->GetStatusMessage();
  const Handles handles = handles_of(filter);
  // A bone has at most the length 2.4 (0.3 times the bounding-box diagonal 8.1). A bone of length 7
  // is therefore halved twice.
  ASSERT_EQ(handles.size(), 4u);
  vtkDataArray* array = weights->GetOutput()->GetPointData()->GetArray("Weights");
  ASSERT_NE(array, nullptr);
  ASSERT_EQ(array->GetNumberOfComponents(), 4);
  for (vtkIdType v = 0; v < array->GetNumberOfTuples(); ++v)
  {
    double sum = 0.0;
    for (int h = 0; h < 4; ++h)
    {
      EXPECT_GE(array->GetComponent(v, h), 0.0);
      sum += array->GetComponent(v, h);
    }
    EXPECT_NEAR(sum, 1.0, 1e-9);
  }
}

TEST_F(AutomaticBones, OfTetsAreThoseOfTheirBoundary)
{
  const TetMesh box = long_box();
  vtkNew<vtkAutomaticHandles> of_tets, of_surface;
  of_tets->SetInputData(to_unstructured_grid(box.points, box.tets));
  of_surface->SetInputData(surface());
  of_tets->Update();
  of_surface->Update();
  const Handles a = handles_of(of_tets);
  const Handles b = handles_of(of_surface);
  ASSERT_EQ(a.size(), 1u);
  ASSERT_EQ(b.size(), 1u);
  EXPECT_EQ(a[0].head, b[0].head);
  EXPECT_EQ(a[0].tail, b[0].tail);
  const Report report = read_report(of_tets->GetOutput());
  EXPECT_EQ(report.text("surface"), "clean");
  EXPECT_EQ(report.number("counts.joints_outside", -1.0), 0.0);
}

TEST_F(AutomaticBones, SurviveATgfFile)
{
  vtkNew<vtkAutomaticHandles> filter;
  filter->SetInputData(surface());
  filter->SetLongestBone(0.3);
  filter->Update();
  const Handles made = handles_of(filter);
  Tgf graph;
  const Status status = to_tgf(made, graph);
  ASSERT_TRUE(status.ok());
  EXPECT_EQ(graph.nodes.size(), 5u);
  const test::Folder folder;
  const std::string path = folder / "bones.tgf";
  ASSERT_TRUE(write_tgf(path, graph).ok());
  vtkNew<vtkHandleFileReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  Handles read;
  ASSERT_TRUE(to_handles(vtkPolyData::SafeDownCast(reader->GetOutput()), read).ok());
  ASSERT_EQ(read.size(), made.size());
  for (std::size_t i = 0; i < made.size(); ++i)
  {
    EXPECT_EQ(read[i].name, made[i].name);
    EXPECT_EQ(read[i].head, made[i].head);
    EXPECT_EQ(read[i].tail, made[i].tail);
    // The file stores the parent of a bone only if the bone begins at the tail of the parent.
    const bool beside = made[i].parent >= 0 && made[made[i].parent].tail != made[i].head;
    EXPECT_EQ(read[i].parent, beside ? -1 : made[i].parent);
    ASSERT_EQ(status.warnings.size(), 1u);
    EXPECT_EQ(status.warnings[0].find("'" + made[i].name + "'") != std::string::npos, beside);
  }
}

TEST_F(AutomaticBones, CanBeAbortedAndTriedAgain)
{
  vtkNew<vtkAutomaticHandles> filter;
  filter->SetInputData(surface());
  vtkNew<Listener> listener;
  listener->listen(filter);
  listener->on_progress = [](vtkAlgorithm* algorithm) { algorithm->SetAbortExecute(1); };
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkAutomaticHandles::CANCELED);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_TRUE(listener->errors.empty());
  listener->on_progress = nullptr;
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkAutomaticHandles::OK);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 1);
}

TEST(AutomaticHandlesFilter, SpreadsPoints)
{
  vtkNew<vtkAutomaticHandles> filter;
  filter->SetInputData(surface());
  filter->SetMethodToPoints();
  filter->SetNumberOfPoints(5);
  filter->Update();
  ASSERT_EQ(filter->GetStatus(), vtkAutomaticHandles::OK) << filter->GetStatusMessage();
  const Handles inside = handles_of(filter);
  ASSERT_EQ(inside.size(), 5u);
  for (const Handle& handle : inside)
  {
    EXPECT_EQ(handle.kind, HandleKind::point);
    EXPECT_GT(handle.head.y(), 0.0);
    EXPECT_LT(handle.head.y(), 1.0);
  }
  EXPECT_EQ(read_report(filter->GetOutput()).number("counts.points_inside", 0.0), 5.0);
  filter->PlaceInsideOff();
  filter->SetDistanceToStraight();
  filter->Update();
  const Report report = read_report(filter->GetOutput());
  EXPECT_EQ(report.number("counts.points_inside", -1.0), 0.0);
  EXPECT_EQ(report.text("distance"), "straight");
}

TEST(AutomaticHandlesFilter, BadInputIsOneSentence)
{
  vtkNew<vtkAutomaticHandles> filter;
  vtkNew<Listener> listener;
  listener->listen(filter);
  vtkNew<vtkPolyData> empty;
  filter->SetInputData(empty);
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkAutomaticHandles::INVALID_INPUT);
  TriangleMesh needle = test::grid(1, 1);
  needle.points.col(1).setZero();
  filter->SetInputData(to_polydata(needle.points, needle.triangles));
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkAutomaticHandles::INVALID_INPUT);
  EXPECT_THAT(filter->GetStatusMessage(), HasSubstr("all triangles of the surface have area 0"));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  filter->SetInputData(surface());
  filter->SetMethodToPoints();
  filter->SetNumberOfPoints(100000);
  filter->Update();
  EXPECT_THAT(filter->GetStatusMessage(), HasSubstr("fewer than the 100000"));
  EXPECT_EQ(listener->errors.size(), 3u);
}

TEST(AutomaticHandlesFilter, PrintsItself)
{
  vtkNew<vtkAutomaticHandles> filter;
  std::ostringstream text;
  filter->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("Method: skeleton"));
  EXPECT_THAT(text.str(), HasSubstr("Distance: along-edges"));
  EXPECT_THAT(text.str(), HasSubstr("MaximumBones: 0"));
}

TEST(HandlesAsTgf, RefusesWhatItCannotHold)
{
  Handles handles(1);
  handles[0].name = "r";
  handles[0].kind = HandleKind::region;
  handles[0].region_id = 1;
  Tgf graph;
  EXPECT_THAT(to_tgf(handles, graph).message, HasSubstr("'r'"));
}
