// Tests of vtkTransferWeights, which transfers weights of tets to the surface of the tets or to any
// other dataset, by the nearest point or by inpainting. Changes of the pose cause no new transfer.
#include "TestFilter.h"

#include "vtkBoundedBiharmonicWeights.h"
#include "vtkSkinningDeformation.h"
#include "vtkTransferWeights.h"

#include "conversion.h"
#include "report_field_data.h"
#include "support/meshes.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

using namespace bindpose;
using bindpose::test::Listener;
using testing::HasSubstr;

namespace
{
class TransferWeights : public testing::Test
{
protected:
  TransferWeights()
  {
    const TetMesh box = test::tet_box(4, 4, 4);
    this->surface = to_polydata(box.points, boundary_triangles(box.tets));
    Handles list(2);
    list[0].name = "low";
    list[0].head = list[0].tail = Vec3(0.3, 0.4, 0.12);
    list[1].name = "high";
    list[1].head = list[1].tail = Vec3(0.6, 0.7, 0.83);
    this->handles = to_polydata(list);
    this->weights->SetInputData(0, to_unstructured_grid(box.points, box.tets));
    this->weights->SetInputData(1, this->handles);
    this->transfer->SetInputData(0, this->surface);
    this->transfer->SetInputConnection(1, this->weights->GetOutputPort());
    this->listener->listen(this->transfer);
  }

  vtkSmartPointer<vtkPolyData> surface;
  vtkSmartPointer<vtkPolyData> handles;
  vtkNew<vtkBoundedBiharmonicWeights> weights;
  vtkNew<vtkTransferWeights> transfer;
  vtkNew<Listener> listener;
};
} // namespace

TEST_F(TransferWeights, SharedVerticesAreExactAndCertificatesTravel)
{
  this->transfer->Update();
  ASSERT_EQ(this->transfer->GetStatus(), vtkBindposeAlgorithm::OK);
  vtkDataSet* output = this->transfer->GetOutput();
  ASSERT_TRUE(vtkPolyData::SafeDownCast(output));
  vtkDataArray* from = this->weights->GetOutput()->GetPointData()->GetArray("Weights");
  vtkDataArray* to = output->GetPointData()->GetArray("Weights");
  ASSERT_EQ(to->GetNumberOfTuples(), this->surface->GetNumberOfPoints());
  EXPECT_STREQ(to->GetComponentName(1), "high");
  for (vtkIdType v = 0; v < to->GetNumberOfTuples(); ++v)
  {
    double p[3];
    double q[3];
    this->surface->GetPoint(v, p);
    this->weights->GetOutput()->GetPoint(v, q);
    if (std::equal(p, p + 3, q))
    {
      ASSERT_EQ(to->GetComponent(v, 0), from->GetComponent(v, 0)) << "bit by bit";
    }
  }
  const Report report = read_report(output);
  EXPECT_EQ(report.number("counts.transfer_misses", -1), 0);
  EXPECT_EQ(report.number("counts.transferred_exact", -1), this->surface->GetNumberOfPoints());
  EXPECT_EQ(report.text("transfer"), "exact");
  for (const char* name : { "WeightsRelativeGap", "WeightsKKTResidual", "WeightsMinimum",
         "WeightsMaximum", "WeightsInteriorExtrema", "WeightsRowSumError" })
  {
    EXPECT_EQ(output->GetFieldData()->GetAbstractArray(name),
      this->weights->GetOutput()->GetFieldData()->GetAbstractArray(name))
      << name;
  }
}

TEST_F(TransferWeights, OfVerticesAtOnePlaceEachKeepsItsOwn)
{
  // The mesh consists of two adjacent squares that share no vertices, as after a cut. Each point of
  // the seam has two vertices.
  const TriangleMesh left = test::grid(2, 2);
  const TriangleMesh both = test::join(left, test::translated(left, Vec3(1, 0, 0)));
  const auto mesh = to_polydata(both.points, both.triangles);
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName("Weights");
  for (Index v = 0; v < both.points.rows(); ++v)
  {
    numbers->InsertNextValue(static_cast<double>(v));
  }
  mesh->GetPointData()->AddArray(numbers);
  this->transfer->SetInputData(0, to_polydata(both.points, both.triangles));
  this->transfer->SetInputData(1, mesh);
  this->transfer->Update();
  vtkDataArray* to = this->transfer->GetOutput()->GetPointData()->GetArray("Weights");
  for (vtkIdType v = 0; v < to->GetNumberOfTuples(); ++v)
  {
    EXPECT_EQ(to->GetComponent(v, 0), static_cast<double>(v));
  }
}

TEST_F(TransferWeights, PointsInsideAndOutside)
{
  Points points(3, 3);
  points << 0.33, 0.51, 0.27, 0.5, 0.5, 1.01, 0.0, 0.0, 9.0;
  this->transfer->SetInputData(0, to_polydata(points, Triangles(0, 3)));
  this->transfer->Update();
  ASSERT_EQ(this->transfer->GetStatus(), vtkBindposeAlgorithm::OK);
  const Report report = read_report(this->transfer->GetOutput());
  EXPECT_EQ(report.text("transfer"), "barycentric");
  EXPECT_EQ(report.number("counts.transferred_barycentric", -1), 1);
  EXPECT_EQ(report.number("counts.transferred_nearest", -1), 1);
  EXPECT_EQ(report.number("counts.transfer_misses", -1), 1);
  ASSERT_EQ(this->listener->warnings.size(), 1u);
  EXPECT_THAT(this->listener->warnings[0], HasSubstr("1 of 3 points"));
  vtkDataArray* to = this->transfer->GetOutput()->GetPointData()->GetArray("Weights");
  for (vtkIdType v = 0; v < 3; ++v)
  {
    EXPECT_NEAR(to->GetComponent(v, 0) + to->GetComponent(v, 1), 1.0, 1e-12);
  }
}

TEST_F(TransferWeights, InpaintsUnmatchedPoints)
{
  // The middle of the target is far from the surface of the tets.
  const TriangleMesh box = test::box(Vec3::Zero(), Vec3::Ones());
  vtkNew<vtkPolyData> target;
  target->DeepCopy(this->surface);
  for (vtkIdType v = 0; v < target->GetNumberOfPoints(); ++v)
  {
    double p[3];
    target->GetPoint(v, p);
    const bool in_middle = p[2] > 0.3 && p[2] < 0.7;
    target->GetPoints()->SetPoint(v, in_middle ? 3.0 * p[0] - 1.0 : p[0], p[1], p[2]);
  }
  this->transfer->SetInputData(0, target);
  EXPECT_EQ(this->transfer->GetPiecePort(), 0);
  this->transfer->SetMethodToInpaint();
  EXPECT_EQ(this->transfer->GetPiecePort(), -1);
  this->transfer->Update();
  ASSERT_EQ(this->transfer->GetStatus(), vtkBindposeAlgorithm::OK)
    << this->transfer->GetStatusMessage();
  vtkPointSet* output = vtkPointSet::SafeDownCast(this->transfer->GetOutput());
  vtkDataArray* rows = output->GetPointData()->GetArray("Weights");
  vtkDataArray* matched = output->GetPointData()->GetArray("Matched");
  ASSERT_TRUE(rows && matched);
  EXPECT_STREQ(rows->GetComponentName(1), "high");
  const Report report = read_report(output);
  double sum = 0.0;
  for (vtkIdType v = 0; v < rows->GetNumberOfTuples(); ++v)
  {
    EXPECT_NEAR(rows->GetComponent(v, 0) + rows->GetComponent(v, 1), 1.0, 1e-12);
    EXPECT_GE(rows->GetComponent(v, 0), 0.0);
    sum += matched->GetComponent(v, 0);
  }
  EXPECT_EQ(report.number("counts.matched", -1), sum);
  EXPECT_GT(report.number("counts.inpainted", -1), 0);
  EXPECT_LE(report.number("relative_gap", 1), 1e-6);
  // The certificates are those of the inpainted columns, not those of the source.
  vtkFieldData* fields = output->GetFieldData();
  ASSERT_TRUE(fields->GetAbstractArray("WeightsRelativeGap"));
  EXPECT_NE(fields->GetAbstractArray("WeightsRelativeGap"),
    this->weights->GetOutput()->GetFieldData()->GetAbstractArray("WeightsRelativeGap"));
  EXPECT_FALSE(fields->GetAbstractArray("WeightsInteriorExtrema"));

  // Nothing is transferred again until an option or the cells of the target change.
  this->transfer->Modified();
  this->transfer->Update();
  EXPECT_EQ(this->transfer->GetNumberOfBinds(), 1);
  this->transfer->SetMaximumAngle(60.0);
  this->transfer->Update();
  EXPECT_EQ(this->transfer->GetNumberOfBinds(), 2);
  vtkNew<vtkPolyData> cut;
  cut->ShallowCopy(target);
  cut->SetPolys(to_polydata(box.points, box.triangles)->GetPolys());
  this->transfer->SetInputData(0, cut);
  this->transfer->Update();
  EXPECT_EQ(this->transfer->GetNumberOfBinds(), 3);

  // Errors are those of the kernel.
  this->transfer->SetMaximumDistance(-1.0);
  this->transfer->Update();
  EXPECT_EQ(this->transfer->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
  EXPECT_THAT(this->transfer->GetStatusMessage(), HasSubstr("maximum distance"));
}

TEST_F(TransferWeights, AHundredPosesBindNothingAgain)
{
  vtkNew<vtkSkinningDeformation> skinning;
  skinning->SetInputConnection(0, this->transfer->GetOutputPort());
  skinning->SetInputData(1, this->handles);
  skinning->Update();
  vtkDataArray* transform = this->handles->GetCellData()->GetArray("Transform");
  for (int edit = 1; edit <= 100; ++edit)
  {
    transform->SetComponent(1, 3, 0.01 * edit);
    transform->Modified();
    this->handles->Modified();
    skinning->Update();
  }
  EXPECT_EQ(this->weights->GetNumberOfBinds(), 1);
  EXPECT_EQ(this->transfer->GetNumberOfBinds(), 1);
  EXPECT_EQ(skinning->GetNumberOfBinds(), 1);
  // A vertex moves in proportion to its weight for the handle that moves.
  vtkDataArray* to = this->transfer->GetOutput()->GetPointData()->GetArray("Weights");
  double p[3];
  double q[3];
  this->surface->GetPoint(60, p);
  skinning->GetOutput()->GetPoint(60, q);
  EXPECT_NEAR(q[0] - p[0], to->GetComponent(60, 1), 1e-9);
}

TEST_F(TransferWeights, ErrorsTellWhatIsMissing)
{
  this->transfer->SetArrayName("Wights");
  this->transfer->Update();
  EXPECT_EQ(this->transfer->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
  ASSERT_EQ(this->listener->errors.size(), 1u);
  EXPECT_THAT(this->listener->errors[0], HasSubstr("'Wights'"));
  this->transfer->SetArrayName("Weights");
  this->transfer->Update();
  EXPECT_EQ(this->transfer->GetStatus(), vtkBindposeAlgorithm::OK);
  vtkNew<vtkPolyData> empty;
  this->transfer->SetInputData(0, empty);
  this->transfer->Update();
  EXPECT_EQ(this->transfer->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
  // A failure of an upstream filter makes this filter fail.
  this->transfer->SetInputData(0, this->surface);
  vtkNew<vtkPolyData> none;
  this->weights->SetInputData(1, none);
  vtkNew<Listener> upstream;
  upstream->listen(this->weights);
  this->transfer->Update();
  EXPECT_THAT(this->transfer->GetStatusMessage(), HasSubstr("no handle"));
  std::ostringstream text;
  this->transfer->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("ArrayName: Weights"));
}
