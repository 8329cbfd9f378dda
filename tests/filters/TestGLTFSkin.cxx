// vtkGLTFSkinWriter and vtkGLTFSkinReader: a rig that is written and read back has equal handles,
// weights in single precision, and the same poses of linear blend skinning. The content of the file
// itself is tested in tests/core/gltf.
#include "TestFilter.h"

#include "conversion.h"
#include "gltf/gltf_skin.h"
#include "support/files.h"
#include "support/meshes.h"
#include "vtkGLTFSkinReader.h"
#include "vtkGLTFSkinWriter.h"
#include "vtkHandleFileReader.h"
#include "vtkMeshFileReader.h"
#include "vtkPoseHandles.h"
#include "vtkSkinningDeformation.h"
#include "weights_arrays.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
/// Return handles of all kinds: a point, three cage vertices, a region, and a chain of three bones.
/// The cage consists of one edge and one face.
Handles all_kinds()
{
  Handles handles(8);
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    handles[h].name = "h" + std::to_string(h);
    handles[h].head = Vec3(0.1 * static_cast<double>(h), 1.0 / 3.0, 0.7);
    handles[h].tail = handles[h].head;
  }
  for (std::size_t h = 1; h < 4; ++h)
  {
    handles[h].kind = HandleKind::cage_vertex;
  }
  handles[1].cage = { { 1, 2, -1 }, { 1, 2, 3 } };
  handles[4].kind = HandleKind::region;
  handles[4].region_id = 3;
  for (std::size_t h = 5; h < 8; ++h)
  {
    handles[h].kind = HandleKind::bone;
    handles[h].head = Vec3(-1, 0.3 * static_cast<double>(h), 0.1);
    handles[h].tail = Vec3(-1, 0.3 * static_cast<double>(h + 1), 0.1);
  }
  handles[5].parent = 6; // a parent may follow its child in the list
  handles[6].parent = 7;
  handles[0].parent = 5;
  return handles;
}

void expect_equal(const Handles& a, const Handles& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t h = 0; h < a.size(); ++h)
  {
    SCOPED_TRACE(a[h].name);
    EXPECT_EQ(a[h].name, b[h].name);
    EXPECT_EQ(a[h].kind, b[h].kind);
    EXPECT_EQ(a[h].head, b[h].head);
    EXPECT_EQ(a[h].tail, b[h].tail);
    EXPECT_EQ(a[h].parent, b[h].parent);
    EXPECT_EQ(a[h].region_id, b[h].region_id);
    EXPECT_EQ(a[h].cage, b[h].cage);
  }
}

class GLTFSkin : public testing::Test
{
protected:
  GLTFSkin()
  {
    const TriangleMesh ball = test::sphere(2);
    this->Mesh = to_polydata(PointsView(ball.points), TrianglesView(ball.triangles));
    this->List = all_kinds();
    this->Handles = to_polydata(this->List);
    this->Weights.resize(ball.points.rows(), 8);
    test::Random random(7);
    for (Index v = 0; v < this->Weights.rows(); ++v)
    {
      for (Index h = 0; h < 8; ++h)
      {
        this->Weights(v, h) = random.uniform();
      }
      this->Weights.row(v) /= this->Weights.row(v).sum();
    }
    this->Mesh->GetPointData()->AddArray(to_weights_array("Weights", this->Weights, this->List));
    for (test::Listener* listener : { this->ErrorListener.Get() })
    {
      listener->listen(this->Writer);
      listener->listen(this->Reader);
    }
    this->Writer->SetInputData(0, this->Mesh);
    this->Writer->SetHandlesData(this->Handles);
    this->Writer->SetFileName((this->Folder / "rig.glb").c_str());
    this->Writer->OverwriteOn();
    this->Reader->SetFileName((this->Folder / "rig.glb").c_str());
  }
  void WriteAndRead()
  {
    ASSERT_EQ(this->Writer->Write(), 1) << this->Writer->GetStatusMessage();
    this->Reader->Modified();
    this->Reader->Update();
    ASSERT_EQ(this->Reader->GetStatus(), vtkGLTFSkinReader::OK) << this->Reader->GetStatusMessage();
  }
  vtkPolyData* ReaderOutput(int port)
  {
    return vtkPolyData::SafeDownCast(this->Reader->GetOutput(port));
  }
  bindpose::Handles HandlesRead()
  {
    bindpose::Handles handles;
    EXPECT_TRUE(to_handles(this->ReaderOutput(1), handles).ok());
    return handles;
  }
  Pose PoseRead()
  {
    bindpose::Handles handles;
    std::vector<Index> cells;
    Pose pose;
    EXPECT_TRUE(to_handles(this->ReaderOutput(1), handles, &cells).ok());
    EXPECT_TRUE(to_pose(this->ReaderOutput(1), handles, cells, pose).ok());
    return pose;
  }
  void ExpectTheTimesOfTheFrames(const std::vector<Points>& expected);
  void ExpectError(const char* word)
  {
    EXPECT_EQ(this->Writer->Write(), 0);
    EXPECT_THAT(this->Writer->GetStatusMessage(), HasSubstr(word));
    EXPECT_EQ(this->Folder.number_of_files(), 0u);
  }

  test::Folder Folder;
  vtkNew<test::Listener> ErrorListener;
  vtkNew<vtkGLTFSkinWriter> Writer;
  vtkNew<vtkGLTFSkinReader> Reader;
  vtkSmartPointer<vtkPolyData> Mesh, Handles;
  bindpose::Handles List;
  bindpose::Weights Weights;
};
} // namespace

TEST_F(GLTFSkin, AllKindsOfHandlesAreReadBack)
{
  for (const char* name : { "rig.glb", "rig.gltf" })
  {
    this->Writer->SetFileName((this->Folder / name).c_str());
    this->Reader->SetFileName((this->Folder / name).c_str());
    this->WriteAndRead();
    expect_equal(this->HandlesRead(), this->List);
    auto* weights = this->ReaderOutput(0)->GetPointData()->GetArray("Weights");
    ASSERT_NE(weights, nullptr);
    EXPECT_STREQ(weights->GetComponentName(3), "h3");
    EXPECT_LT((to_matrix(weights).view() - this->Weights).cwiseAbs().maxCoeff(), 1.2e-7);
    for (const HandlePose& pose : this->PoseRead())
    {
      EXPECT_EQ(pose.transform, identity_affine());
    }
    // The readers that choose the format by the file's extension return the same mesh and handles.
    vtkNew<vtkMeshFileReader> mesh;
    mesh->SetFileName((this->Folder / name).c_str());
    mesh->Update();
    EXPECT_NE(mesh->GetOutput()->GetPointData()->GetArray("Weights"), nullptr);
    vtkNew<vtkHandleFileReader> handles;
    handles->SetFileName((this->Folder / name).c_str());
    handles->Update();
    bindpose::Handles list;
    ASSERT_TRUE(to_handles(vtkPolyData::SafeDownCast(handles->GetOutput()), list).ok());
    expect_equal(list, this->List);
  }
}

TEST_F(GLTFSkin, AttributesGoAlong)
{
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkFloatArray> texture;
  vtkNew<vtkUnsignedCharArray> colors;
  normals->SetNumberOfComponents(3);
  texture->SetNumberOfComponents(2);
  colors->SetNumberOfComponents(3);
  colors->SetName("Paint");
  for (vtkIdType v = 0; v < this->Mesh->GetNumberOfPoints(); ++v)
  {
    normals->InsertNextTuple(this->Mesh->GetPoint(v));
    texture->InsertNextTuple2(0.25, static_cast<double>(v % 5) / 4.0);
    colors->InsertNextTuple3(static_cast<double>(v % 256), 10, 20);
  }
  this->Mesh->GetPointData()->SetNormals(normals);
  this->Mesh->GetPointData()->SetTCoords(texture);
  this->Mesh->GetPointData()->AddArray(colors);
  this->Writer->SetColorArrayName("Paint");
  this->WriteAndRead();
  vtkPointData* back = this->ReaderOutput(0)->GetPointData();
  ASSERT_TRUE(back->GetNormals() && back->GetTCoords() && back->GetArray("Colors"));
  for (vtkIdType v = 0; v < this->Mesh->GetNumberOfPoints(); ++v)
  {
    EXPECT_NEAR(back->GetNormals()->GetComponent(v, 1), normals->GetComponent(v, 1), 1e-6);
    EXPECT_NEAR(back->GetTCoords()->GetComponent(v, 1), texture->GetComponent(v, 1), 1e-6);
    EXPECT_EQ(back->GetArray("Colors")->GetComponent(v, 0), v % 256);
    EXPECT_EQ(back->GetArray("Colors")->GetComponent(v, 3), 255);
  }
  this->Writer->SetColorArrayName("none");
  EXPECT_EQ(this->Writer->Write(), 0);
}

TEST_F(GLTFSkin, TetsAreTheirBoundary)
{
  const TetMesh box = test::tet_box(3, 3, 3);
  const auto grid = to_unstructured_grid(PointsView(box.points), TetsView(box.tets));
  bindpose::Weights weights = bindpose::Weights::Zero(box.points.rows(), 8);
  weights.col(2) = box.points.col(0);
  weights.col(5) = 1.0 - box.points.col(0).array();
  grid->GetPointData()->AddArray(to_weights_array("Weights", weights, this->List));
  this->Writer->SetInputData(0, grid);
  this->WriteAndRead();
  vtkPolyData* back = this->ReaderOutput(0);
  EXPECT_EQ(back->GetNumberOfPoints(), 64 - 8); // the inner points of the tets are missing
  EXPECT_EQ(back->GetNumberOfCells(), 6 * 9 * 2);
  for (vtkIdType v = 0; v < back->GetNumberOfPoints(); ++v)
  {
    EXPECT_NEAR(
      back->GetPointData()->GetArray("Weights")->GetComponent(v, 2), back->GetPoint(v)[0], 1e-6);
  }
}

/// Request times in arbitrary order and compare the posed meshes with `expected`. One pipeline uses
/// the poses of the reader's output. The other pipeline uses vtkPoseHandles, which reads the same
/// file. The file has 12 frames per second.
void GLTFSkin::ExpectTheTimesOfTheFrames(const std::vector<Points>& expected)
{
  vtkNew<vtkPoseHandles> posed;
  posed->SetInputData(0, this->Handles);
  posed->SetFileName((this->Folder / "rig.glb").c_str());
  vtkNew<vtkSkinningDeformation> by_reader, by_pose;
  by_reader->SetInputConnection(0, this->Reader->GetOutputPort(0));
  by_reader->SetInputConnection(1, this->Reader->GetOutputPort(1));
  by_pose->SetInputData(0, this->Mesh);
  by_pose->SetInputConnection(1, posed->GetOutputPort());
  for (vtkSkinningDeformation* skinning : { by_reader.Get(), by_pose.Get() })
  {
    skinning->UpdateInformation();
    vtkInformation* info = skinning->GetOutputInformation(0);
    ASSERT_EQ(info->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 3);
    EXPECT_DOUBLE_EQ(info->Get(vtkStreamingDemandDrivenPipeline::TIME_STEPS())[2], 2.0 / 12.0);
    const std::vector<std::pair<double, std::size_t>> frames{ { 0.0, 0 }, { 2.0 / 12.0, 2 },
      { 1.0 / 12.0, 1 }, { 1.9 / 12.0, 1 }, { 9.0, 2 }, { -1.0, 0 } };
    for (const auto& [time, frame] : frames)
    {
      skinning->UpdateTimeStep(time);
      EXPECT_LT(
        (to_points(skinning->GetOutput()).view() - expected[frame]).cwiseAbs().maxCoeff(), 3e-6)
        << time;
    }
  }
  // A reader that is set to one frame has no time steps.
  this->Reader->SetFrame(1);
  this->Reader->UpdateInformation();
  for (const int port : { 0, 1 })
  {
    EXPECT_FALSE(this->Reader->GetOutputInformation(port)->Has(
      vtkStreamingDemandDrivenPipeline::TIME_STEPS()));
  }
  this->Reader->SetFrame(-1);
}

TEST_F(GLTFSkin, PosesAndAnimationsAreThoseOfLinearBlendSkinning)
{
  const std::string path = this->Folder.write("pose.json", R"({"fps": 12, "frames": [
    {"handles": {}},
    {"handles": {"h7": {"rotate": {"axis": [0, 0, 1], "degrees": 30}},
                 "h6": {"rotate": {"axis": [0, 1, 1], "degrees": 50}, "translate": [0.1, 0, 0]}}},
    {"handles": {"h5": {"rotate": {"axis": [1, 0, 1], "degrees": 90}, "scale": 2},
                 "h1": {"translate": [0, 0, 1]}}}]})");
  vtkNew<vtkPoseHandles> pose;
  pose->SetInputData(0, this->Handles);
  pose->SetFileName(path.c_str());
  vtkNew<vtkSkinningDeformation> skinning;
  skinning->SetInputData(0, this->Mesh);
  skinning->SetInputConnection(1, pose->GetOutputPort());
  std::vector<Points> expected;
  for (int k = 0; k < 3; ++k)
  {
    pose->SetFrame(k);
    skinning->Update();
    EXPECT_TRUE(pose->GetSequence());
    expected.push_back(to_points(skinning->GetOutput()).view());
    auto frame = vtkSmartPointer<vtkPolyData>::New();
    frame->ShallowCopy(skinning->GetOutput());
    this->Writer->AddFrameData(frame);
  }
  this->Writer->SetFramesPerSecond(12.0);
  for (const bool by_file : { false, true })
  {
    if (by_file)
    {
      this->Writer->RemoveFrames();
      this->Writer->SetPoseFileName(path.c_str());
    }
    this->WriteAndRead();
    EXPECT_THAT(this->Writer->GetReportJSON(), HasSubstr("\"animation\": \"joints\""));
    EXPECT_EQ(this->Reader->GetNumberOfFrames(), 3);
    EXPECT_EQ(this->Reader->GetFramesPerSecond(), 12.0);
    for (int k = 0; k < 3; ++k)
    {
      // Three ways to pose the mesh give the same result: the frames of the reader, the pose file
      // that the reader returns, and the glTF file as the pose file of the handles.
      vtkNew<vtkSkinningDeformation> again;
      again->SetInputData(0, this->Mesh);
      vtkNew<vtkPoseHandles> posed;
      posed->SetInputData(0, this->Handles);
      posed->SetPoseJSON(this->Reader->GetPoseJSON());
      posed->SetFrame(k);
      again->SetInputConnection(1, posed->GetOutputPort());
      again->Update();
      EXPECT_LT((to_points(again->GetOutput()).view() - expected[k]).cwiseAbs().maxCoeff(), 2e-6);
      posed->SetFileName((this->Folder / "rig.glb").c_str());
      again->Update();
      EXPECT_LT((to_points(again->GetOutput()).view() - expected[k]).cwiseAbs().maxCoeff(), 2e-6);
      this->Reader->SetFrame(k);
      this->Reader->Update();
      vtkNew<vtkSkinningDeformation> own;
      own->SetInputConnection(0, this->Reader->GetOutputPort(0));
      own->SetInputConnection(1, this->Reader->GetOutputPort(1));
      own->Update();
      EXPECT_LT((to_points(own->GetOutput()).view() - expected[k]).cwiseAbs().maxCoeff(), 3e-6);
    }
    this->Reader->SetFrame(-1);
    this->ExpectTheTimesOfTheFrames(expected);
  }
  // If no sequence is written, the joints have the pose of the handles.
  this->Writer->SetPoseFileName(nullptr);
  pose->SetFrame(2);
  pose->Update();
  this->Writer->SetHandlesData(pose->GetOutput());
  this->WriteAndRead();
  EXPECT_EQ(this->Reader->GetNumberOfFrames(), 0);
  vtkNew<vtkSkinningDeformation> own;
  own->SetInputConnection(0, this->Reader->GetOutputPort(0));
  own->SetInputConnection(1, this->Reader->GetOutputPort(1));
  own->Update();
  EXPECT_LT((to_points(own->GetOutput()).view() - expected[2]).cwiseAbs().maxCoeff(), 3e-6);
  EXPECT_EQ(this->HandlesRead()[5].head, this->List[5].head); // the handles are at rest
  this->Reader->SetFrame(0);
  this->Reader->Update();
  EXPECT_THAT(this->Reader->GetStatusMessage(), HasSubstr("frame 0"));
}

TEST_F(GLTFSkin, FramesOfOtherMethodsAreMorphTargets)
{
  for (int k = 0; k < 2; ++k)
  {
    auto frame = vtkSmartPointer<vtkPolyData>::New();
    frame->DeepCopy(this->Mesh);
    frame->GetPoints()->SetPoint(3, 5.0 + k, 0, 0);
    this->Writer->AddFrameData(frame);
  }
  this->ExpectError("HandleTransforms");
  this->Writer->SetAnimation(vtkGLTFSkinWriter::MORPH);
  vtkNew<vtkPoseHandles> posed;
  posed->SetInputData(0, this->Handles);
  posed->SetPoseJSON(R"({"handles": {"h7": {"translate": [1, 0, 0]}}})");
  posed->Update();
  this->Writer->SetHandlesData(posed->GetOutput());
  this->WriteAndRead();
  // The morph targets contain the pose, so the joints are at rest.
  EXPECT_EQ(this->PoseRead()[7].transform, identity_affine());
  EXPECT_THAT(this->Writer->GetReportJSON(), HasSubstr("\"animation\": \"morph\""));
  // Joints cannot represent the displacement of a single vertex. The report states the error.
  vtkNew<vtkDoubleArray> transforms;
  transforms->SetName("HandleTransforms");
  transforms->SetNumberOfComponents(12);
  for (int h = 0; h < 8; ++h)
  {
    transforms->InsertNextTuple(identity_affine().data());
  }
  auto frame = vtkSmartPointer<vtkPolyData>::New();
  frame->DeepCopy(this->Mesh);
  double place[3];
  this->Mesh->GetPoint(3, place);
  frame->GetPoints()->SetPoint(3, place[0] + 2.0, place[1], place[2]);
  frame->GetFieldData()->AddArray(transforms);
  this->Writer->RemoveFrames();
  this->Writer->AddFrameData(frame);
  this->Writer->SetAnimation(vtkGLTFSkinWriter::JOINTS);
  ASSERT_EQ(this->Writer->Write(), 1) << this->Writer->GetStatusMessage();
  vtkFieldData* report = this->Writer->GetOutput()->GetFieldData();
  EXPECT_NEAR(report->GetArray("Report.animation_error")->GetComponent(0, 0),
    2.0 / bounding_box(to_points(this->Mesh).view()).diagonal(), 1e-5);
}

TEST_F(GLTFSkin, JointsOfOtherProgramsBecomeHandles)
{
  GltfSkin skin;
  const TriangleMesh ball = test::sphere(1);
  skin.points = ball.points;
  skin.triangles = ball.triangles;
  // Three joints have the root j1 as parent. j0 precedes its parent in the file, and j0 and j2 have
  // the same position.
  for (const Vec3& place : { Vec3(0, 1, 0), Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0.5, 0) })
  {
    GltfJoint joint;
    joint.name = "j" + std::to_string(skin.joints.size());
    joint.rest.translation() = joint.posed.translation() = place;
    joint.parent = skin.joints.size() == 1 ? -1 : 1;
    skin.joints.push_back(joint);
  }
  skin.weights.setConstant(ball.points.rows(), 4, 0.1);
  skin.weights.col(1).setConstant(0.7);
  ASSERT_TRUE(write_gltf_skin(this->Folder / "rig.glb", skin).ok());
  this->Reader->Update();
  const bindpose::Handles handles = this->HandlesRead();
  ASSERT_EQ(handles.size(), 4u);
  EXPECT_EQ(handles[0].name, "j0"); // point handles are first in the list
  EXPECT_EQ(handles[0].kind, HandleKind::point);
  EXPECT_EQ(handles[1].name, "j3");
  EXPECT_EQ(handles[2].name, "j1");
  EXPECT_EQ(handles[2].kind, HandleKind::bone);
  EXPECT_LT((handles[2].tail - Vec3(1.0 / 3.0, 2.5 / 3.0, 0)).norm(), 1e-6);
  // The point handle j0 already has the position of the joint j2, so j2 becomes a short bone.
  EXPECT_EQ(handles[3].name, "j2");
  EXPECT_EQ(handles[3].kind, HandleKind::bone);
  EXPECT_EQ(handles[0].parent, 2);
  EXPECT_NEAR(
    this->ReaderOutput(0)->GetPointData()->GetArray("Weights")->GetComponent(0, 2), 0.7, 1e-6);
}

TEST_F(GLTFSkin, AMeshWithoutHandles)
{
  this->Writer->RemoveAllInputConnections(1);
  this->WriteAndRead();
  EXPECT_EQ(this->ReaderOutput(1)->GetNumberOfCells(), 0);
  EXPECT_EQ(this->ReaderOutput(0)->GetPointData()->GetArray("Weights"), nullptr);
  vtkNew<vtkHandleFileReader> handles;
  vtkNew<test::Listener> listener;
  listener->listen(handles);
  handles->SetFileName((this->Folder / "rig.glb").c_str());
  handles->Update();
  EXPECT_THAT(handles->GetStatusMessage(), HasSubstr("no skin"));
}

TEST_F(GLTFSkin, Errors)
{
  this->Writer->SetFileName(nullptr);
  this->ExpectError("file name is empty");
  this->Writer->SetFileName((this->Folder / "rig.obj").c_str());
  this->ExpectError("file name extension");
  this->Writer->SetFileName((this->Folder / "rig.glb").c_str());
  this->Writer->SetArrayName("Other");
  this->ExpectError("Other");
  this->Writer->SetArrayName("Weights");
  this->Writer->AddFrameData(this->Handles);
  this->ExpectError("frame 0");
  this->Writer->RemoveFrames();
  this->Writer->SetPoseFileName("/none.json");
  this->ExpectError("none.json");
  this->Writer->SetPoseFileName(nullptr);
  this->List.pop_back();
  this->List[6].parent = -1;
  this->Writer->SetHandlesData(to_polydata(this->List));
  this->ExpectError("7 handles");
  EXPECT_FALSE(this->ErrorListener->errors.empty());
  this->Folder.write("rig.glb", "glTF");
  this->Reader->Update();
  EXPECT_THAT(this->Reader->GetStatusMessage(), HasSubstr("rig.glb"));
  std::ostringstream text;
  this->Writer->Print(text);
  this->Reader->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("MaximumInfluences: 0"));
}
