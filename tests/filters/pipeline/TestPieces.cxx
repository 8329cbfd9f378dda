// Filters that work by pieces: the pieces together equal, bit by bit, the output for the whole
// input. Failures are not hidden, and no point is output twice.
#include "filters/TestFilter.h"
#include "filters/data_of.h"
#include "filters/pipeline/same_data.h"

#include "report_field_data.h"
#include "support/bars.h"
#include "support/meshes.h"
#include "vtkCrowdDeformation.h"
#include "vtkPoseHandles.h"
#include "vtkReducedARAP.h"
#include "vtkSkinningDeformation.h"
#include "vtkTransferWeights.h"
#include "vtkWindingNumberField.h"
#include "weights_arrays.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using bindpose::test::Listener;
using bindpose::test::TestFilter;

namespace
{
constexpr const char* bend =
  R"({"handles": {"right": {"rotate": {"axis": [0, 1, 1], "degrees": 70}, "translate": [0, 1, 0]},
    "middle": {"translate": [0, 0.25, 0]}}})";

/// Return points [begin, end) of a dataset with their arrays, without cells.
vtkSmartPointer<vtkPolyData> points_of(vtkPointSet* data, vtkIdType begin, vtkIdType end)
{
  auto part = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  part->GetPointData()->CopyAllOn();
  part->GetPointData()->CopyAllocate(data->GetPointData(), end - begin);
  for (vtkIdType v = begin; v < end; ++v)
  {
    part->GetPointData()->CopyData(
      data->GetPointData(), v, points->InsertNextPoint(data->GetPoint(v)));
  }
  part->SetPoints(points);
  return part;
}

class Pieces : public testing::Test
{
protected:
  Pieces()
  {
    const test::Rig rig = test::bar(6);
    this->tets = to_unstructured_grid(rig.mesh.points, rig.mesh.tets);
    this->tets->GetPointData()->AddArray(to_weights_array("Weights", rig.weights, rig.handles));
    // The surface keeps all points of the tets, even interior ones, so that it can use the same
    // array of weights as the tets.
    this->surface = to_polydata(rig.mesh.points, boundary_triangles(rig.mesh.tets));
    this->surface->GetPointData()->AddArray(this->tets->GetPointData()->GetArray("Weights"));
    vtkNew<vtkDoubleArray> normals;
    normals->SetName("Normals");
    normals->SetNumberOfComponents(3);
    for (Index v = 0; v < rig.mesh.points.rows(); ++v)
    {
      const Vec3 normal =
        Vec3(rig.mesh.points.row(v) - Eigen::RowVector3d(2.1, 0.4, 0.6)).normalized();
      normals->InsertNextTuple(normal.data());
    }
    this->surface->GetPointData()->SetNormals(normals);
    this->handles = to_polydata(rig.handles);
    this->pose->SetInputData(this->handles);
    this->pose->SetPoseJSON(bend);
    this->count = this->surface->GetNumberOfPoints();
  }

  vtkSmartPointer<vtkUnstructuredGrid> tets;
  vtkSmartPointer<vtkPolyData> surface;
  vtkSmartPointer<vtkPolyData> handles;
  vtkNew<vtkPoseHandles> pose;
  vtkIdType count = 0;
};
} // namespace

TEST_F(Pieces, OfASkinnedMeshHaveTheBitsOfTheWhole)
{
  for (const int method :
    { vtkSkinningDeformation::LINEAR_BLEND, vtkSkinningDeformation::DUAL_QUATERNION })
  {
    for (const bool single : { false, true })
    {
      const auto pose_mesh = [&](vtkSkinningDeformation* filter, vtkDataObject* mesh)
      {
        filter->SetInputData(0, mesh);
        filter->SetInputConnection(1, this->pose->GetOutputPort());
        filter->SetMethod(method);
        filter->SetSinglePrecision(single);
        EXPECT_EQ(filter->GetPiecePort(), 0);
      };
      vtkNew<vtkSkinningDeformation> all;
      pose_mesh(all, this->surface);
      all->Update();
      const vtkIdType ends[] = { 0, 11, 11, this->count };
      for (int piece = 0; piece < 3; ++piece)
      {
        vtkNew<vtkSkinningDeformation> one;
        pose_mesh(one, points_of(this->surface, ends[piece], ends[piece + 1]));
        one->UpdatePiece(piece, 3, 0);
        ASSERT_EQ(one->GetStatus(), vtkBindposeAlgorithm::OK) << one->GetStatusMessage();
        auto* whole = vtkPointSet::SafeDownCast(all->GetOutput());
        const auto expected = points_of(whole, ends[piece], ends[piece + 1]);
        ASSERT_EQ(one->GetOutput()->GetNumberOfPoints(), expected->GetNumberOfPoints());
        EXPECT_EQ(Points(to_points(one->GetOutput()).view()), Points(to_points(expected).view()))
          << piece;
        EXPECT_EQ(
          test::different_array(one->GetOutput()->GetPointData(), expected->GetPointData()), "");
      }
    }
  }
}

TEST_F(Pieces, OfOtherSkinningMethodsAreTheWholeAndEmptyOnes)
{
  vtkNew<vtkSkinningDeformation> filter;
  filter->SetInputData(0, this->tets);
  filter->SetInputConnection(1, this->pose->GetOutputPort());
  for (int change = 0; change < 3; ++change)
  {
    filter->SetMethod(change == 0 ? vtkSkinningDeformation::STRETCHABLE_BONES
        : change == 1             ? vtkSkinningDeformation::CENTERS_OF_ROTATION
                                  : vtkSkinningDeformation::LINEAR_BLEND);
    filter->SetPseudoEdges(change == 2 ? vtkSkinningDeformation::AUTOMATIC_PSEUDO_EDGES
                                       : vtkSkinningDeformation::NO_PSEUDO_EDGES);
    EXPECT_EQ(filter->GetPiecePort(), -1);
    filter->UpdatePiece(1, 2, 0);
    EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::OK);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
    filter->UpdatePiece(0, 2, 0);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), this->count);
  }
}

TEST_F(Pieces, OfTransferredWeightsHaveTheBitsOfTheWhole)
{
  Points points(7, 3);
  points << 0.33, 0.51, 0.27, 1.5, 0.5, 0.01, 4, 1, 1, 0, 0, 0, 3.9, 0.2, 0.7, 2, 3, 0.5, 0.7, 0.7,
    0.7;
  const auto target = to_polydata(points, Triangles(0, 3));
  vtkNew<vtkTransferWeights> all;
  all->SetInputData(0, target);
  all->SetInputData(1, this->tets);
  vtkNew<Listener> silent; // a point far from the mesh causes a warning
  silent->listen(all);
  all->Update();
  vtkDataArray* weights = all->GetOutput()->GetPointData()->GetArray("Weights");
  const vtkIdType ends[] = { 0, 4, 7, 7 };
  for (int piece = 0; piece < 3; ++piece)
  {
    vtkNew<vtkTransferWeights> one;
    silent->listen(one);
    one->SetInputData(0, points_of(target, ends[piece], ends[piece + 1]));
    one->SetInputData(1, this->tets);
    one->UpdatePiece(piece, 3, 0);
    ASSERT_EQ(one->GetStatus(), vtkBindposeAlgorithm::OK) << one->GetStatusMessage();
    // The last piece has no points, which is not an error. Like all pieces, it has the array of
    // weights.
    vtkDataArray* part = one->GetOutput()->GetPointData()->GetArray("Weights");
    ASSERT_NE(part, nullptr);
    ASSERT_EQ(part->GetNumberOfTuples(), ends[piece + 1] - ends[piece]);
    ASSERT_EQ(part->GetNumberOfComponents(), 3);
    EXPECT_STREQ(part->GetComponentName(2), "right");
    for (vtkIdType v = 0; v < part->GetNumberOfTuples(); ++v)
    {
      for (int j = 0; j < 3; ++j)
      {
        EXPECT_EQ(part->GetComponent(v, j), weights->GetComponent(ends[piece] + v, j));
      }
    }
    EXPECT_EQ(
      read_report(one->GetOutput()).number("counts.vertices", -1.0), ends[piece + 1] - ends[piece]);
  }
}

TEST_F(Pieces, OfACrowdHaveTheBitsOfTheWhole)
{
  // Each row of the table lifts the right end of an instance.
  const auto table_of = [](int begin, int end)
  {
    auto table = vtkSmartPointer<vtkTable>::New();
    vtkNew<vtkDoubleArray> right;
    right->SetName("right");
    right->SetNumberOfComponents(3);
    for (int i = begin; i < end; ++i)
    {
      right->InsertNextTuple3(0.0, 0.1 * i, 0.05 * i);
    }
    table->AddColumn(right);
    return table;
  };
  const auto pose_crowd = [&](vtkCrowdDeformation* crowd, int begin, int end)
  {
    crowd->SetInputData(0, this->tets);
    crowd->SetInputData(1, this->handles);
    crowd->SetInstancesData(table_of(begin, end));
    crowd->SetTolerance(1e-4);
    crowd->SetMaximumIterations(1000);
  };
  vtkNew<vtkCrowdDeformation> all;
  pose_crowd(all, 0, 4);
  all->Update();
  auto* expected = vtkPartitionedDataSetCollection::SafeDownCast(all->GetOutput());
  ASSERT_EQ(expected->GetNumberOfPartitionedDataSets(), 4u);
  const int ends[] = { 0, 1, 4, 4 };
  for (int piece = 0; piece < 3; ++piece)
  {
    vtkNew<vtkCrowdDeformation> one;
    pose_crowd(one, ends[piece], ends[piece + 1]);
    one->UpdatePiece(piece, 3, 0);
    ASSERT_EQ(one->GetStatus(), vtkBindposeAlgorithm::OK) << one->GetStatusMessage();
    auto* part = vtkPartitionedDataSetCollection::SafeDownCast(one->GetOutput());
    const auto size = static_cast<unsigned int>(ends[piece + 1] - ends[piece]);
    ASSERT_EQ(part->GetNumberOfPartitionedDataSets(), size);
    for (unsigned int i = 0; i < size; ++i)
    {
      const auto number = static_cast<unsigned int>(ends[piece]) + i;
      EXPECT_EQ(test::difference(part->GetPartition(i, 0), expected->GetPartition(number, 0)), "");
    }
    one->SetOutputType(vtkCrowdDeformation::APPENDED);
    one->UpdatePiece(piece, 3, 0);
    auto* appended = vtkUnstructuredGrid::SafeDownCast(one->GetOutput());
    ASSERT_NE(appended, nullptr);
    EXPECT_EQ(appended->GetNumberOfPoints(), size * this->count);
  }
}

TEST_F(Pieces, OfWindingNumbersAtPointsHaveTheBitsOfTheWhole)
{
  const auto queries = to_polydata(test::random_points(50, 2.0, 3), Triangles(0, 3));
  const auto sphere = test::data_of(test::sphere(2));
  vtkNew<vtkWindingNumberField> all;
  all->SetInputData(0, sphere);
  all->SetPointsData(queries);
  all->Update();
  vtkDataArray* values = all->GetOutput()->GetPointData()->GetArray("WindingNumber");
  const vtkIdType ends[] = { 0, 13, 50 };
  for (int piece = 0; piece < 2; ++piece)
  {
    vtkNew<vtkWindingNumberField> one;
    one->SetInputData(0, sphere);
    one->SetPointsData(points_of(queries, ends[piece], ends[piece + 1]));
    EXPECT_EQ(one->GetPiecePort(), 1);
    one->UpdatePiece(piece, 2, 0);
    vtkDataArray* part = one->GetOutput()->GetPointData()->GetArray("WindingNumber");
    ASSERT_EQ(part->GetNumberOfTuples(), ends[piece + 1] - ends[piece]);
    for (vtkIdType v = 0; v < part->GetNumberOfTuples(); ++v)
    {
      EXPECT_EQ(part->GetComponent(v, 0), values->GetComponent(ends[piece] + v, 0));
    }
  }
  // One source is connected to both ports. Piece 0 of the output contains all points of the source,
  // so piece 1 must be empty.
  vtkNew<vtkSphereSource> source;
  vtkNew<vtkWindingNumberField> both;
  both->SetInputConnection(0, source->GetOutputPort());
  both->SetInputConnection(1, source->GetOutputPort());
  both->UpdatePiece(1, 2, 0);
  EXPECT_EQ(both->GetOutput()->GetNumberOfPoints(), 0);
  both->UpdatePiece(0, 2, 0);
  EXPECT_EQ(both->GetOutput()->GetNumberOfPoints(), source->GetOutput()->GetNumberOfPoints());
}

TEST_F(Pieces, FailuresAreNotHidden)
{
  vtkNew<TestFilter> broken;
  broken->SetInputData(this->surface);
  broken->Work = [](ExecutionContext&, vtkPolyData*)
  { return Status::failure(StatusCode::invalid_input, "the dog ate it"); };
  vtkNew<vtkTransferWeights> transfer;
  transfer->SetInputConnection(0, broken->GetOutputPort());
  transfer->SetInputData(1, this->tets);
  vtkNew<Listener> listener;
  listener->listen(broken);
  listener->listen(transfer);
  transfer->UpdatePiece(0, 2, 0);
  EXPECT_EQ(transfer->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
  EXPECT_EQ(transfer->GetStatusMessage(), "the dog ate it");
  // Piece 1, the piece of another process, is empty, which is not an error.
  transfer->UpdatePiece(1, 2, 0);
  EXPECT_EQ(transfer->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_EQ(transfer->GetOutput()->GetNumberOfPoints(), 0);
  // On one process an empty mesh is an error.
  vtkNew<vtkPolyData> empty;
  transfer->SetInputData(0, empty);
  transfer->UpdatePiece(0, 1, 0);
  EXPECT_EQ(transfer->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
  transfer->UpdatePiece(0, 2, 0);
  EXPECT_EQ(transfer->GetStatus(), vtkBindposeAlgorithm::OK);
  // Missing weights are an error on every process, also on a process with an empty piece.
  transfer->SetArrayName("Wights");
  transfer->UpdatePiece(1, 2, 0);
  EXPECT_EQ(transfer->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);

  vtkNew<vtkSkinningDeformation> skinning;
  listener->listen(skinning);
  skinning->SetInputData(0, this->surface);
  skinning->SetInputConnection(1, broken->GetOutputPort());
  for (int piece = 0; piece < 2; ++piece)
  {
    skinning->UpdatePiece(piece, 2, 0);
    EXPECT_EQ(skinning->GetStatusMessage(), "the dog ate it") << "the handles are whole";
  }
}

TEST_F(Pieces, OfASourceThatReachesBothPortsAreOutputOnce)
{
  // One source is upstream of both ports. The port of the weights needs the whole output of the
  // source, so the source must not be split into pieces.
  vtkNew<vtkSphereSource> source;
  source->SetPhiResolution(12);
  source->Update();
  const vtkIdType points = source->GetOutput()->GetNumberOfPoints();
  vtkNew<TestFilter> weights;
  weights->SetInputConnection(source->GetOutputPort());
  weights->Work = [](ExecutionContext&, vtkPolyData* output)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName("Weights");
    array->SetNumberOfTuples(output->GetNumberOfPoints());
    array->FillValue(1.0);
    output->GetPointData()->AddArray(array);
    return Status();
  };
  vtkNew<vtkPolyDataNormals> between;
  between->SetInputConnection(source->GetOutputPort());
  between->SplittingOff();
  for (vtkAlgorithm* target :
    { static_cast<vtkAlgorithm*>(source), static_cast<vtkAlgorithm*>(between) })
  {
    vtkNew<vtkTransferWeights> transfer;
    transfer->SetInputConnection(0, target->GetOutputPort());
    transfer->SetInputConnection(1, weights->GetOutputPort());
    transfer->UpdatePiece(1, 2, 0);
    EXPECT_EQ(transfer->GetStatus(), vtkBindposeAlgorithm::OK) << transfer->GetStatusMessage();
    EXPECT_EQ(transfer->GetOutput()->GetNumberOfPoints(), 0);
    transfer->UpdatePiece(0, 2, 0);
    EXPECT_EQ(transfer->GetOutput()->GetNumberOfPoints(), points);
    transfer->UpdatePiece(0, 1, 0);
    EXPECT_EQ(transfer->GetOutput()->GetNumberOfPoints(), points);
  }
}

TEST_F(Pieces, PassThroughFiltersThatShareTheirHandles)
{
  vtkNew<vtkTransferWeights> transfer;
  transfer->SetInputData(0, points_of(this->surface, 5, 17));
  transfer->SetInputData(1, this->tets);
  vtkNew<vtkSkinningDeformation> first;
  first->SetInputConnection(0, transfer->GetOutputPort());
  first->SetInputConnection(1, this->pose->GetOutputPort());
  vtkNew<vtkSkinningDeformation> second;
  second->SetInputConnection(0, first->GetOutputPort());
  second->SetInputConnection(1, this->pose->GetOutputPort());
  second->UpdatePiece(1, 2, 0);
  EXPECT_EQ(second->GetStatus(), vtkBindposeAlgorithm::OK) << second->GetStatusMessage();
  EXPECT_EQ(second->GetOutput()->GetNumberOfPoints(), 12);
  // A filter that depends on the whole mesh has one piece.
  vtkNew<vtkReducedARAP> arap;
  arap->SetInputData(0, this->tets);
  arap->SetInputConnection(1, this->pose->GetOutputPort());
  EXPECT_EQ(arap->GetPiecePort(), -1);
  first->SetInputConnection(0, arap->GetOutputPort());
  for (int piece = 0; piece < 2; ++piece)
  {
    second->UpdatePiece(piece, 2, 0);
    EXPECT_EQ(second->GetStatus(), vtkBindposeAlgorithm::OK) << second->GetStatusMessage();
    EXPECT_EQ(second->GetOutput()->GetNumberOfPoints(), piece == 0 ? this->count : 0);
  }
}
