// Composite inputs: every filter works on them block by block. The output block equals, bit by bit,
// the output for the input block alone. Composites that a filter does not support are refused with
// an error message of one sentence.
#include "filters/TestFilter.h"
#include "filters/data_of.h"
#include "filters/pipeline/same_data.h"

#include "support/bars.h"
#include "support/files.h"
#include "support/handles.h"
#include "support/meshes.h"
#include "support/needs_mesher.h"
#include "vtkAutomaticHandles.h"
#include "vtkBindAlgorithm.h"
#include "vtkBoneEndpointWeights.h"
#include "vtkBoundedBiharmonicWeights.h"
#include "vtkCrowdDeformation.h"
#include "vtkCutAlongBones.h"
#include "vtkDepthOrder.h"
#include "vtkFarthestPointHandles.h"
#include "vtkFullARAP.h"
#include "vtkGLTFSkinWriter.h"
#include "vtkMeshFileWriter.h"
#include "vtkMonotoneSmoothing.h"
#include "vtkMonotoneWeights.h"
#include "vtkMovingLeastSquaresWarp.h"
#include "vtkPlanarShape.h"
#include "vtkPoseHandles.h"
#include "vtkReducedARAP.h"
#include "vtkReducedDynamics.h"
#include "vtkSkinningDeformation.h"
#include "vtkSurfaceDefects.h"
#include "vtkTetrahedralizeSurface.h"
#include "vtkTransferWeights.h"
#include "vtkUnconstrainedWeights.h"
#include "vtkVariationalSurface.h"
#include "vtkWeightedColors.h"
#include "vtkWeightsAlgorithm.h"
#include "vtkWindingNumberField.h"
#include "weights_arrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace bindpose;
using bindpose::test::Listener;
using testing::HasSubstr;

namespace
{
constexpr const char* raise_right =
  R"({"version": 2, "handles": {"left": {"mode": "full"},
    "right": {"mode": "position", "translate": [0, 0.5, 0]}}})";
constexpr const char* raise_left =
  R"({"version": 2, "handles": {"right": {"mode": "full"},
    "left": {"mode": "position", "translate": [0, 0.25, 0.5]}}})";

vtkSmartPointer<vtkMultiBlockDataSet> blocks_with(const std::vector<vtkDataObject*>& datasets)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (vtkDataObject* data : datasets)
  {
    blocks->SetBlock(blocks->GetNumberOfBlocks(), data);
  }
  return blocks;
}

/// Return the datasets of a composite; none if it is not a composite.
std::vector<vtkDataObject*> leaves_of(vtkDataObject* data)
{
  std::vector<vtkDataObject*> leaves;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    vtkSmartPointer<vtkCompositeDataIterator> leaf;
    leaf.TakeReference(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      leaves.push_back(leaf->GetCurrentDataObject());
    }
  }
  return leaves;
}

vtkSmartPointer<vtkUnstructuredGrid> weighted_tets(int cells)
{
  const test::Rig rig = test::bar(cells);
  const auto tets = to_unstructured_grid(rig.mesh.points, rig.mesh.tets);
  tets->GetPointData()->AddArray(to_weights_array("Weights", rig.weights, rig.handles));
  return tets;
}

/// Return posed handles for a bar. Each handle has a layer.
vtkSmartPointer<vtkPolyData> posed_handles(const Vec3& middle, const char* pose_text)
{
  const auto handles = to_polydata({ test::point_handle("left", Vec3(0, 0.5, 0.5)),
    test::point_handle("middle", middle), test::point_handle("right", Vec3(4, 0.5, 0.5)) });
  vtkNew<vtkDoubleArray> layers;
  layers->SetName("Layer");
  for (const double layer : { 0.0, 2.0, middle.z() })
  {
    layers->InsertNextValue(layer);
  }
  handles->GetCellData()->AddArray(layers);
  vtkNew<vtkPoseHandles> pose;
  pose->SetInputData(handles);
  pose->SetPoseJSON(pose_text);
  pose->Update();
  EXPECT_EQ(pose->GetStatus(), vtkBindposeAlgorithm::OK) << pose->GetStatusMessage();
  return vtkPolyData::SafeDownCast(pose->GetOutput());
}

/// Return points in the bar, without cells.
vtkSmartPointer<vtkPolyData> points_in_bar(Index count)
{
  test::Random random(static_cast<std::uint64_t>(count));
  Points points(count, 3);
  for (Index v = 0; v < count; ++v)
  {
    points.row(v) = random.in_box(Vec3::Zero(), Vec3(4, 1, 1));
  }
  return to_polydata(points, Triangles(0, 3));
}

/// Return a square with the scalars `Height`, and with a fixed band around the region 1.
vtkSmartPointer<vtkPolyData> square_with_arrays(int squares)
{
  const TriangleMesh mesh = test::grid(squares, squares);
  auto data = test::data_of(mesh);
  vtkNew<vtkDoubleArray> height;
  height->SetName("Height");
  vtkNew<vtkIntArray> fixed, labels;
  fixed->SetName("Fixed");
  labels->SetName("RegionId");
  test::Random random(4);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    const double x = mesh.points(v, 0), y = mesh.points(v, 1);
    const auto depth = std::lround(std::min({ x, y, 1.0 - x, 1.0 - y }) * squares);
    height->InsertNextValue(std::sin(6.0 * x) * std::cos(4.0 * y) + 0.4 * random.uniform());
    fixed->InsertNextValue(depth < 3);
    labels->InsertNextValue(depth >= 5);
  }
  data->GetPointData()->SetScalars(height);
  data->GetPointData()->AddArray(fixed);
  data->GetPointData()->AddArray(labels);
  return data;
}

vtkSmartPointer<vtkPolyData> posed_region(double height)
{
  vtkNew<vtkPoseHandles> pose;
  pose->SetInputData(to_polydata(Handles{ test::region_handle("core", 1, Vec3(0.5, 0.5, 0)) }));
  pose->SetPoseJSON(
    R"({"handles": {"core": {"translate": [0, 0, )" + std::to_string(height) + "]}}}");
  pose->Update();
  EXPECT_EQ(pose->GetStatus(), vtkBindposeAlgorithm::OK) << pose->GetStatusMessage();
  return vtkPolyData::SafeDownCast(pose->GetOutput());
}

/// Return instances that lift the right end of a bar.
vtkSmartPointer<vtkTable> lifts()
{
  auto table = vtkSmartPointer<vtkTable>::New();
  vtkNew<vtkDoubleArray> right;
  right->SetName("right");
  right->SetNumberOfComponents(3);
  right->InsertNextTuple3(0.0, 0.3, 0.0);
  right->InsertNextTuple3(0.0, 0.0, 0.2);
  table->AddColumn(right);
  return table;
}

vtkSmartPointer<vtkPolyData> closed_curve(double size)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& [x, y] : { std::pair(0.0, 0.0), { size, 0.0 }, { size, 2.0 }, { 0.0, 1.0 } })
  {
    points->InsertNextPoint(x, y, 0.0);
  }
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1, 2, 3, 0 });
  data->SetPoints(points);
  data->SetLines(lines);
  return data;
}

using FilterPointer = vtkSmartPointer<vtkBindposeAlgorithm>;

/// A filter with two blocks for input 0 and one or two blocks for input 1.
struct BlockCase
{
  const char* name;
  std::function<FilterPointer()> make;
  std::array<vtkSmartPointer<vtkDataObject>, 2> blocks;
  std::vector<vtkSmartPointer<vtkDataObject>> others;
};

/// Return a function that makes a filter and sets its properties.
template <typename Class, typename Setup>
std::function<FilterPointer()> make_filter(Setup setup)
{
  return [setup]() -> FilterPointer
  {
    vtkNew<Class> filter;
    setup(filter.Get());
    return FilterPointer(filter.Get());
  };
}
template <typename Class>
std::function<FilterPointer()> make_filter()
{
  return make_filter<Class>([](Class*) {});
}

/// Check that a run on two blocks gives the same bits as two runs on one block each. Return the
/// filter that ran on the two blocks.
FilterPointer check_blocks(const BlockCase& test_case)
{
  vtkNew<Listener> silent; // warnings are not of interest
  std::vector<FilterPointer> alone;
  for (std::size_t b = 0; b < 2; ++b)
  {
    const FilterPointer filter = test_case.make();
    silent->listen(filter);
    filter->SetInputData(0, test_case.blocks[b]);
    if (!test_case.others.empty())
    {
      filter->SetInputData(1, test_case.others[std::min(b, test_case.others.size() - 1)]);
    }
    filter->Update();
    EXPECT_LE(filter->GetStatus(), vtkBindposeAlgorithm::NOT_CONVERGED)
      << filter->GetStatusMessage();
    vtkDataSet* output = filter->GetOutput();
    EXPECT_TRUE(output && output->GetNumberOfPoints() > 0);
    alone.push_back(filter);
  }

  FilterPointer filter = test_case.make();
  silent->listen(filter);
  filter->SetInputData(0, blocks_with({ test_case.blocks[0], test_case.blocks[1] }));
  if (test_case.others.size() == 2)
  {
    filter->SetInputData(1, blocks_with({ test_case.others[0], test_case.others[1] }));
  }
  else if (test_case.others.size() == 1)
  {
    filter->SetInputData(1, test_case.others[0]);
  }
  filter->Update();
  EXPECT_LE(filter->GetStatus(), vtkBindposeAlgorithm::NOT_CONVERGED) << filter->GetStatusMessage();
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    const std::vector<vtkDataObject*> results = leaves_of(filter->GetOutputDataObject(port));
    EXPECT_EQ(results.size(), 2u) << "port " << port;
    for (std::size_t b = 0; b < results.size() && b < 2; ++b)
    {
      EXPECT_EQ(test::difference(results[b], alone[b]->GetOutputDataObject(port)), "")
        << "port " << port << ", block " << b;
    }
  }
  return filter;
}

/// Return the number of binds of a filter, or -1 if the filter does not count binds.
int binds_of(vtkAlgorithm* filter)
{
  if (auto* poses = vtkBindAlgorithm::SafeDownCast(filter))
  {
    return poses->GetNumberOfBinds();
  }
  if (auto* weights = vtkWeightsAlgorithm::SafeDownCast(filter))
  {
    return weights->GetNumberOfBinds();
  }
  if (auto* endpoints = vtkBoneEndpointWeights::SafeDownCast(filter))
  {
    return endpoints->GetNumberOfBinds();
  }
  auto* transfer = vtkTransferWeights::SafeDownCast(filter);
  return transfer ? transfer->GetNumberOfBinds() : -1;
}

class BlocksOfShapes : public test::MesherTest
{
};
} // namespace

TEST(Blocks, HaveTheBitsOfSingleRuns)
{
  const auto sphere = test::data_of(test::sphere(1));
  const auto torus = test::data_of(test::torus(16, 8, 2.0, 0.5));
  const auto tets = weighted_tets(4), fine_tets = weighted_tets(6);
  const auto handles = posed_handles(Vec3(2, 0.5, 0.5), raise_right);
  const auto other_handles = posed_handles(Vec3(2, 0.5, 1), raise_left);
  const auto bone =
    to_polydata(Handles{ test::bone_handle("b", Vec3(0, 0.5, 0.5), Vec3(4, 0.5, 0.5)) });
  const auto cut =
    to_polydata(Handles{ test::bone_handle("c", Vec3(0.25, 0.5, 0), Vec3(0.75, 0.5, 0)) });
  const auto square = square_with_arrays(12), fine_square = square_with_arrays(16);

  const BlockCase cases[] = {
    { "vtkAutomaticHandles",
      make_filter<vtkAutomaticHandles>(
        [](vtkAutomaticHandles* filter)
        {
          filter->SetMethodToPoints();
          filter->SetNumberOfPoints(4);
        }),
      { sphere, torus }, {} },
    { "vtkFarthestPointHandles",
      make_filter<vtkFarthestPointHandles>(
        [](vtkFarthestPointHandles* filter) { filter->SetNumberOfHandles(3); }),
      { sphere, torus }, {} },
    { "vtkSurfaceDefects", make_filter<vtkSurfaceDefects>(),
      { test::data_of(test::open_cube()), test::data_of(test::flipped(test::cube())) }, {} },
    { "vtkTetrahedralizeSurface",
      make_filter<vtkTetrahedralizeSurface>(
        [](vtkTetrahedralizeSurface* filter) { filter->SetMethodToEmbed(); }),
      { sphere, test::data_of(test::cube()) }, {} },
    { "vtkWindingNumberField",
      make_filter<vtkWindingNumberField>(
        [](vtkWindingNumberField* filter) { filter->SetResolution(6); }),
      { sphere, torus }, {} },
    { "vtkBoundedBiharmonicWeights", make_filter<vtkBoundedBiharmonicWeights>(),
      { tets, fine_tets }, { handles, other_handles } },
    { "vtkMonotoneWeights", make_filter<vtkMonotoneWeights>(), { tets, fine_tets },
      { handles, other_handles } },
    { "vtkUnconstrainedWeights", make_filter<vtkUnconstrainedWeights>(), { tets, fine_tets },
      { handles } },
    { "vtkBoneEndpointWeights",
      make_filter<vtkBoneEndpointWeights>(
        [](vtkBoneEndpointWeights* filter) { filter->SetMethodToBounded(); }),
      { tets, fine_tets }, { bone } },
    { "vtkMonotoneSmoothing",
      make_filter<vtkMonotoneSmoothing>(
        [](vtkMonotoneSmoothing* filter) { filter->SetPersistence(0.5); }),
      { square, fine_square }, {} },
    { "vtkTransferWeights", make_filter<vtkTransferWeights>(),
      { points_in_bar(7), points_in_bar(20) }, { tets, fine_tets } },
    { "vtkWeightedColors", make_filter<vtkWeightedColors>(), { tets, fine_tets }, { handles } },
    { "vtkDepthOrder", make_filter<vtkDepthOrder>(), { tets, fine_tets },
      { handles, other_handles } },
    { "vtkCutAlongBones", make_filter<vtkCutAlongBones>(),
      { test::data_of(test::grid(4, 4)), test::data_of(test::grid(8, 8)) }, { cut } },
    { "vtkPoseHandles",
      make_filter<vtkPoseHandles>([](vtkPoseHandles* filter) { filter->SetPoseJSON(raise_right); }),
      { handles, other_handles }, {} },
    { "vtkSkinningDeformation", make_filter<vtkSkinningDeformation>(), { tets, fine_tets },
      { handles, other_handles } },
    { "vtkReducedARAP", make_filter<vtkReducedARAP>(), { tets, fine_tets },
      { handles, other_handles } },
    { "vtkFullARAP", make_filter<vtkFullARAP>(), { tets, fine_tets }, { handles, other_handles } },
    { "vtkMovingLeastSquaresWarp", make_filter<vtkMovingLeastSquaresWarp>(), { tets, fine_tets },
      { handles } },
    { "vtkVariationalSurface", make_filter<vtkVariationalSurface>(), { square, fine_square },
      { posed_region(0.5), posed_region(-0.25) } },
    { "vtkCrowdDeformation",
      make_filter<vtkCrowdDeformation>(
        [](vtkCrowdDeformation* filter)
        {
          filter->SetInstancesData(lifts());
          filter->SetOutputType(vtkCrowdDeformation::APPENDED);
        }),
      { tets, fine_tets }, { handles, other_handles } },
  };
  for (const BlockCase& test_case : cases)
  {
    SCOPED_TRACE(test_case.name);
    const FilterPointer filter = check_blocks(test_case);
    const int binds = binds_of(filter);
    EXPECT_TRUE(binds == 2 || binds < 0) << binds;
    filter->Modified();
    filter->Update();
    EXPECT_EQ(binds_of(filter), binds) << "each block has its own bind";
  }
}

TEST_F(BlocksOfShapes, HaveTheBitsOfSingleRuns)
{
  check_blocks(
    { "vtkPlanarShape", make_filter<vtkPlanarShape>(), { closed_curve(2.0), closed_curve(3.0) },
      { to_polydata(Handles{ test::point_handle("p", Vec3(0.5, 0.5, 0)) }),
        to_polydata(Handles{ test::point_handle("p", Vec3(1.5, 0.75, 0)) }) } });
}

TEST(Blocks, OfPointsShareASurface)
{
  const auto surface = test::data_of(test::cube());
  const auto few = points_in_bar(5), many = points_in_bar(30);
  vtkNew<vtkWindingNumberField> blocks;
  blocks->SetInputData(0, surface);
  blocks->SetInputData(1, blocks_with({ few, many }));
  blocks->Update();
  ASSERT_EQ(blocks->GetStatus(), vtkBindposeAlgorithm::OK) << blocks->GetStatusMessage();
  const std::vector<vtkDataObject*> results = leaves_of(blocks->GetOutputDataObject(0));
  ASSERT_EQ(results.size(), 2u);
  for (std::size_t b = 0; b < 2; ++b)
  {
    vtkNew<vtkWindingNumberField> alone;
    alone->SetInputData(0, surface);
    alone->SetPointsData(b == 0 ? few : many);
    alone->Update();
    EXPECT_EQ(test::difference(results[b], alone->GetOutput()), "");
  }
}

TEST(Blocks, ArePosedThroughAPipelineWithOneBindEach)
{
  const auto tets = weighted_tets(4), fine_tets = weighted_tets(6);
  const auto handles = posed_handles(Vec3(2, 0.5, 0.5), raise_right);
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetNumberOfPartitionedDataSets(2);
  collection->SetPartition(0, 0, tets);
  collection->SetPartition(1, 0, fine_tets);
  vtkNew<vtkPoseHandles> pose;
  pose->SetInputData(blocks_with({ handles, handles }));
  vtkNew<vtkBoundedBiharmonicWeights> weights;
  weights->SetInputData(0, collection);
  weights->SetInputConnection(1, pose->GetOutputPort());
  vtkNew<vtkReducedARAP> arap;
  arap->WarmStartOff();
  arap->SetInputConnection(0, weights->GetOutputPort());
  arap->SetInputConnection(1, pose->GetOutputPort());
  for (const char* text : { raise_right, raise_left, raise_right })
  {
    pose->SetPoseJSON(text);
    arap->Update();
    ASSERT_LE(arap->GetStatus(), vtkBindposeAlgorithm::NOT_CONVERGED) << arap->GetStatusMessage();
    EXPECT_EQ(weights->GetNumberOfBinds(), 2);
    EXPECT_EQ(arap->GetNumberOfBinds(), 2);
  }
  vtkNew<vtkReducedARAP> alone;
  const std::vector<vtkDataObject*> weighted = leaves_of(weights->GetOutputDataObject(0));
  const std::vector<vtkDataObject*> results = leaves_of(arap->GetOutputDataObject(0));
  const std::vector<vtkDataObject*> poses = leaves_of(pose->GetOutputDataObject(0));
  ASSERT_EQ(weighted.size(), 2u);
  ASSERT_EQ(results.size(), 2u);
  ASSERT_EQ(poses.size(), 2u);
  for (std::size_t b = 0; b < 2; ++b)
  {
    alone->SetInputData(0, weighted[b]);
    alone->SetInputData(1, poses[b]);
    alone->WarmStartOff();
    alone->Update();
    EXPECT_EQ(test::difference(results[b], alone->GetOutput()), "");
  }
}

TEST(Blocks, ThatDoNotFitAreRefusedWithOneSentence)
{
  const auto tets = weighted_tets(4);
  const auto handles = posed_handles(Vec3(2, 0.5, 0.5), raise_right);
  const auto two_meshes = blocks_with({ tets, tets });
  const auto two_handles = blocks_with({ handles, handles });
  const auto three_handles = blocks_with({ handles, handles, handles });
  vtkNew<vtkSkinningDeformation> skinning;
  vtkNew<vtkReducedDynamics> dynamics;
  vtkNew<vtkCrowdDeformation> crowd;
  crowd->SetInstancesData(lifts());
  const struct
  {
    vtkBindposeAlgorithm* filter;
    vtkDataObject* mesh;
    vtkDataObject* handles;
    const char* sentence;
  } cases[] = {
    { skinning, two_meshes, three_handles,
      "input port 1 has 3 blocks, but input port 0 has 2 blocks; expected as many blocks, or a "
      "single dataset" },
    { skinning, tets, two_handles,
      "input port 1 has 2 blocks, but input port 0 has a single dataset; expected as many blocks, "
      "or a single dataset" },
    { dynamics, two_meshes, handles,
      "a composite mesh cannot be simulated; merge its blocks or extract one" },
    { crowd, two_meshes, handles, "a crowd of a composite mesh needs the output type appended" },
  };
  for (const auto& [filter, mesh, poses, sentence] : cases)
  {
    vtkNew<Listener> listener;
    listener->listen(filter);
    filter->SetInputData(0, mesh);
    filter->SetInputData(1, poses);
    filter->Update();
    EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
    EXPECT_THAT(filter->GetStatusMessage(), HasSubstr(sentence));
    EXPECT_EQ(listener->errors.size(), 1u) << sentence;
  }
  // Handles in a composite of one block are used like a single dataset.
  skinning->SetInputData(0, tets);
  skinning->SetInputData(1, blocks_with({ handles }));
  skinning->Update();
  EXPECT_EQ(skinning->GetStatus(), vtkBindposeAlgorithm::OK) << skinning->GetStatusMessage();
  vtkNew<vtkDoubleArray> points;
  skinning->SetInputData(0, two_meshes);
  skinning->SetInputData(1, handles);
  EXPECT_FALSE(skinning->PosePoints(raise_left, points));
  EXPECT_EQ(
    skinning->GetStatusMessage(), "PosePoints() needs one mesh and its handles, not blocks");
}

TEST(Blocks, WithFailedInputsFailAlone)
{
  const auto tets = weighted_tets(4);
  const auto handles = posed_handles(Vec3(2, 0.5, 0.5), raise_right);
  vtkNew<test::TestFilter> second_fails;
  second_fails->SetInputData(blocks_with({ handles, handles }));
  second_fails->Work = [&](ExecutionContext&, vtkPolyData*)
  {
    return second_fails->Executions == 2
      ? Status::failure(StatusCode::invalid_input, "the dog ate it")
      : Status();
  };
  vtkNew<vtkSkinningDeformation> skinning;
  skinning->SetInputData(0, blocks_with({ tets, tets }));
  skinning->SetInputConnection(1, second_fails->GetOutputPort());
  vtkNew<Listener> silent, listener;
  silent->listen(second_fails);
  listener->listen(skinning);
  skinning->Update();
  EXPECT_EQ(skinning->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
  EXPECT_EQ(skinning->GetStatusMessage(), "the dog ate it");
  EXPECT_EQ(listener->errors.size(), 1u);
  const std::vector<vtkDataObject*> results = leaves_of(skinning->GetOutputDataObject(0));
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0]->GetNumberOfElements(vtkDataObject::POINT), tets->GetNumberOfPoints());
  EXPECT_EQ(results[1]->GetNumberOfElements(vtkDataObject::POINT), 0);
}

TEST(Blocks, AreNotWrittenToOneFile)
{
  const test::Folder folder;
  const auto cube = test::data_of(test::cube());
  vtkNew<vtkMeshFileWriter> writer;
  writer->SetFileName((folder / "cubes.ply").c_str());
  vtkNew<vtkGLTFSkinWriter> skin_writer;
  skin_writer->SetFileName((folder / "cubes.glb").c_str());
  for (vtkBindposeAlgorithm* filter :
    { static_cast<vtkBindposeAlgorithm*>(writer), static_cast<vtkBindposeAlgorithm*>(skin_writer) })
  {
    vtkNew<Listener> listener;
    listener->listen(filter);
    filter->SetInputData(0, blocks_with({ cube, cube }));
    filter->UpdateWholeExtent();
    EXPECT_EQ(filter->GetStatusMessage(),
      "the input has 2 blocks; expected a single dataset (merge or extract blocks)");
    ASSERT_EQ(listener->errors.size(), 1u);
  }
  EXPECT_EQ(folder.number_of_files(), 0u);
  EXPECT_EQ(writer->Write(), 0);
  writer->SetInputData(0, blocks_with({ cube }));
  EXPECT_EQ(writer->Write(), 1) << writer->GetStatusMessage();
  EXPECT_EQ(folder.number_of_files(), 1u);
}
