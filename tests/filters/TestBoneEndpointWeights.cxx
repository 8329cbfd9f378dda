// vtkBoneEndpointWeights: endpoint weights are 0 at a bone's head, 1 at its tail, and interpolated
// over the shape.
#include "vtkBoneEndpointWeights.h"
#include "vtkPoseHandles.h"
#include "vtkSkinningDeformation.h"

#include "TestFilter.h"
#include "conversion.h"
#include "report_field_data.h"
#include "support/handles.h"
#include "support/meshes.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
class BoneEndpointWeights : public testing::Test
{
protected:
  BoneEndpointWeights() { this->listener->listen(this->filter); }

  void update(vtkPointSet* mesh, const Handles& handles, int method)
  {
    this->filter->SetInputData(0, mesh);
    this->filter->SetInputData(1, to_polydata(handles));
    this->filter->SetMethod(method);
    this->filter->Update();
  }
  vtkDoubleArray* endpoints()
  {
    return vtkDoubleArray::SafeDownCast(vtkPointSet::SafeDownCast(this->filter->GetOutput())
                                          ->GetPointData()
                                          ->GetArray("EndpointWeights"));
  }
  Report report() { return read_report(this->filter->GetOutput()); }

  vtkNew<vtkBoneEndpointWeights> filter;
  vtkNew<test::Listener> listener;
};

/// Return a U-shaped surface. Its two legs have width 1/3, extend along y and are joined below y =
/// 1/4.
vtkSmartPointer<vtkPolyData> u_shape()
{
  TriangleMesh mesh = test::grid(12, 12);
  Triangles kept(mesh.triangles.rows(), 3);
  Index count = 0;
  for (Index f = 0; f < mesh.triangles.rows(); ++f)
  {
    Vec3 center = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      center += Vec3(mesh.points.row(mesh.triangles(f, k))) / 3.0;
    }
    if (center.y() < 0.25 || center.x() < 1.0 / 3.0 || center.x() > 2.0 / 3.0)
    {
      kept.row(count++) = mesh.triangles.row(f);
    }
  }
  return to_polydata(mesh.points, Triangles(kept.topRows(count)));
}
} // namespace

TEST_F(BoneEndpointWeights, AreLinearAlongTheBoneOrAwareOfTheShape)
{
  const auto mesh = u_shape();
  const Vec3 head(1.0 / 6.0, 1.0 / 6.0, 0.0);
  const Vec3 tail(1.0 / 6.0, 5.0 / 6.0, 0.0);
  Handle point;
  point.name = "far";
  point.head = point.tail = Vec3(5.0 / 6.0, 5.0 / 6.0, 0.0);
  const Handles handles = { point, test::bone_handle("leg", head, tail) };
  const vtkIdType other_tip = mesh->FindPoint(5.0 / 6.0, 5.0 / 6.0, 0.0);
  for (const int method : { 0, 1, 2 })
  {
    this->update(mesh, handles, method);
    ASSERT_TRUE(this->listener->errors.empty()) << this->listener->errors.front();
    vtkDoubleArray* e = this->endpoints();
    ASSERT_TRUE(e);
    ASSERT_EQ(e->GetNumberOfComponents(), 2);
    EXPECT_STREQ(e->GetComponentName(1), "leg");
    EXPECT_NEAR(e->GetComponent(mesh->FindPoint(head.x(), head.y(), head.z()), 1), 0.0, 1e-12);
    EXPECT_NEAR(e->GetComponent(mesh->FindPoint(tail.x(), tail.y(), tail.z()), 1), 1.0, 1e-12);
    for (vtkIdType v = 0; v < mesh->GetNumberOfPoints(); ++v)
    {
      double p[3];
      mesh->GetPoint(v, p);
      EXPECT_TRUE(std::isnan(e->GetComponent(v, 0))) << "a point has no ends";
      EXPECT_GE(e->GetComponent(v, 1), 0.0);
      EXPECT_LE(e->GetComponent(v, 1), 1.0);
      const bool on_bone = std::abs(p[0] - head.x()) < 1e-9 && p[1] > head.y() && p[1] < tail.y();
      if (on_bone && method != 1)
      {
        EXPECT_NEAR(e->GetComponent(v, 1), (p[1] - head.y()) / (tail.y() - head.y()), 1e-9);
      }
    }
    if (method == 0)
    {
      EXPECT_NEAR(e->GetComponent(other_tip, 1), 1.0, 1e-12) << "beside the bone's tail";
    }
    else
    {
      EXPECT_LT(e->GetComponent(other_tip, 1), 0.3) << "but far from it inside of the shape";
    }
    EXPECT_EQ(this->report().number("counts.problems", -1), method == 0 ? 0 : 1);
    EXPECT_EQ(this->report().number("counts.bones", -1), 1);
  }
}

TEST_F(BoneEndpointWeights, OfTetsStayWhilePosesChangeAndSkinningTakesThem)
{
  const TetMesh box = test::tet_box(8, 2, 2, Vec3(0, 0, 0), Vec3(4, 1, 1));
  const auto mesh = to_unstructured_grid(box.points, box.tets);
  const Handles handles = { test::bone_handle("a", Vec3(0, 0.5, 0.5), Vec3(2, 0.5, 0.5)),
    test::bone_handle("b", Vec3(2, 0.5, 0.5), Vec3(4, 0.5, 0.5)) };
  vtkNew<vtkDoubleArray> weights;
  weights->SetName("Weights");
  weights->SetNumberOfComponents(2);
  for (Index v = 0; v < box.points.rows(); ++v)
  {
    const double w = std::clamp(0.5 * (box.points(v, 0) - 1.0), 0.0, 1.0);
    weights->InsertNextTuple2(1.0 - w, w);
  }
  mesh->GetPointData()->AddArray(weights);
  vtkNew<vtkPoseHandles> pose;
  pose->SetInputData(to_polydata(handles));
  pose->SetPoseJSON("{\"handles\": {}}");
  this->filter->SetInputData(0, mesh);
  this->filter->SetInputConnection(1, pose->GetOutputPort());
  vtkNew<vtkSkinningDeformation> skinning;
  skinning->SetInputConnection(0, this->filter->GetOutputPort());
  skinning->SetInputConnection(1, pose->GetOutputPort());
  skinning->SetMethodToStretchableBones();
  skinning->Update();
  ASSERT_TRUE(this->listener->errors.empty()) << this->listener->errors.front();
  EXPECT_EQ(this->report().number("counts.problems", -1), 1);
  // Both bones become twice as long: every joint moves to twice its position.
  pose->SetPoseJSON(R"({"handles": {"a": {"tail": [4, 0.5, 0.5]},
                                    "b": {"head": [4, 0.5, 0.5], "tail": [8, 0.5, 0.5]}}})");
  skinning->Update();
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  EXPECT_EQ(skinning->GetNumberOfBinds(), 1);
  auto* posed = vtkPointSet::SafeDownCast(skinning->GetOutput());
  for (const double x : { 0.0, 2.0, 4.0 })
  {
    double p[3];
    posed->GetPoint(mesh->FindPoint(x, 0.5, 0.5), p);
    EXPECT_NEAR(p[0], 2.0 * x, 1e-3);
  }
}

TEST_F(BoneEndpointWeights, BadInputIsOneSentence)
{
  Handle point;
  point.name = "p";
  this->update(u_shape(), { point }, 1);
  EXPECT_THAT(this->report().text("message"), HasSubstr("no bone"));
  this->update(
    vtkSmartPointer<vtkPolyData>::New(), { test::bone_handle("b", { 0, 0, 0 }, { 0, 1, 0 }) }, 1);
  EXPECT_THAT(this->report().text("message"), HasSubstr("mesh is missing"));
}
