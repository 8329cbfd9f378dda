// vtkPoseHandles converts a pose file to pose arrays. The output shares all bind-time arrays with
// the input.
#include "vtkPoseHandles.h"

#include "conversion.h"

#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>

using namespace bindpose;

namespace
{
/// Return a point p and two consecutive bones along y: b1 from y = 0 to 1, b2 from y = 1 to 2.
vtkSmartPointer<vtkPolyData> arm()
{
  Handles handles(3);
  handles[0].name = "p";
  handles[0].head = handles[0].tail = Vec3(1, 0, 0);
  handles[1].name = "b1";
  handles[1].kind = HandleKind::bone;
  handles[1].tail = Vec3(0, 1, 0);
  handles[2].name = "b2";
  handles[2].kind = HandleKind::bone;
  handles[2].head = Vec3(0, 1, 0);
  handles[2].tail = Vec3(0, 2, 0);
  handles[2].parent = 1;
  return to_polydata(handles);
}

Pose pose_of(vtkPolyData* data)
{
  Handles handles;
  std::vector<Index> cells;
  Pose pose;
  EXPECT_TRUE(to_handles(data, handles, &cells).ok());
  EXPECT_TRUE(to_pose(data, handles, cells, pose).ok());
  return pose;
}

Vec3 moved(const Affine& t, const Vec3& p)
{
  return t.leftCols<3>() * p + t.col(3);
}

/// Update the filter and return its last error or warning, or an empty string. Nothing is printed.
std::string update(vtkPoseHandles* filter)
{
  vtkNew<vtkCallbackCommand> keep;
  std::string text;
  keep->SetClientData(&text);
  keep->SetCallback([](vtkObject*, unsigned long, void* client, void* data)
    { *static_cast<std::string*>(client) = static_cast<const char*>(data); });
  filter->AddObserver(vtkCommand::ErrorEvent, keep);
  filter->AddObserver(vtkCommand::WarningEvent, keep);
  filter->Update();
  filter->RemoveObserver(keep);
  return text;
}
} // namespace

TEST(PoseHandles, WithoutAPoseTheInputPasses)
{
  vtkNew<vtkPoseHandles> filter;
  filter->SetInputData(arm());
  EXPECT_EQ(update(filter), "");
  EXPECT_EQ(
    pose_of(vtkPolyData::SafeDownCast(filter->GetOutput()))[2].transform, identity_affine());
  EXPECT_EQ(filter->GetNumberOfFrames(), 1);
}

TEST(PoseHandles, AParentTakesItsChildAlong)
{
  const auto posed = [](const std::string& text)
  {
    vtkNew<vtkPoseHandles> filter;
    filter->SetInputData(arm());
    filter->SetPoseJSON("{\"version\": 2, \"handles\": " + text + "}");
    EXPECT_EQ(update(filter), "");
    return pose_of(vtkPolyData::SafeDownCast(filter->GetOutput()));
  };
  const std::string turned = R"({"b1": {"rotate": {"axis": [0, 0, 1], "degrees": 90}})";
  const auto tip = [](const Pose& pose) { return moved(pose[2].transform, Vec3(0, 2, 0)); };
  const std::string b2 = R"(, "b2": {"rotate": {"axis": [0, 0, 1], "degrees": 90})";
  EXPECT_LT((tip(posed(turned + "}")) - Vec3(-2, 0, 0)).norm(), 1e-15);
  EXPECT_LT((tip(posed(turned + b2 + "}}")) - Vec3(-1, -1, 0)).norm(), 1e-15);
  // In world space, b2 does not follow b1. It rotates about the rest position of its own head.
  EXPECT_LT((tip(posed(turned + b2 + R"(, "space": "world"}})")) - Vec3(-1, 1, 0)).norm(), 1e-15);
}

TEST(PoseHandles, APoseWithoutAVersionWarnsOnce)
{
  vtkNew<vtkPoseHandles> filter;
  filter->SetInputData(arm());
  filter->SetPoseJSON(R"({"frames": [
    {"handles": {"b1": {"translate": [1, 0, 0]}}}, {"handles": {"b1": {"translate": [2, 0, 0]}}}]})");
  EXPECT_THAT(update(filter), testing::HasSubstr("\"version\": 2"));
  const Pose pose = pose_of(vtkPolyData::SafeDownCast(filter->GetOutput()));
  EXPECT_EQ(pose[2].transform, identity_affine());
  filter->SetFrame(1);
  EXPECT_EQ(update(filter), "");
}

TEST(PoseHandles, FramesOfAFile)
{
  const std::string path = testing::TempDir() + "bindpose_frames.json";
  std::ofstream(path) << R"({"fps": 12, "frames": [
    {"handles": {"p": {"translate": [1, 0, 0]}}},
    {"handles": {"p": {"mode": "position", "translate": [2, 0, 0]}}}]})";
  vtkNew<vtkPoseHandles> filter;
  filter->SetInputData(arm());
  filter->SetFileName(path.c_str());
  filter->SetFrame(1);
  ASSERT_EQ(update(filter), "");
  EXPECT_EQ(filter->GetNumberOfFrames(), 2);
  EXPECT_EQ(filter->GetFramesPerSecond(), 12.0);
  const Pose pose = pose_of(vtkPolyData::SafeDownCast(filter->GetOutput()));
  EXPECT_EQ(pose[0].mode, HandleMode::position);
  EXPECT_EQ(pose[0].transform(0, 3), 2.0);
  filter->SetFrame(2);
  const std::string error = update(filter);
  EXPECT_NE(error.find("frame 2 does not exist"), std::string::npos) << error;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  std::remove(path.c_str());
  filter->SetFrame(0);
  EXPECT_NE(update(filter).find("cannot be read"), std::string::npos);
}

TEST(PoseHandles, WhatABindDependsOnIsTheInputsOwn)
{
  const auto handles = arm();
  vtkNew<vtkPoseHandles> filter;
  filter->SetInputData(handles);
  const auto before = bind_objects(handles);
  for (int degrees = 0; degrees < 100; degrees += 7)
  {
    filter->SetPoseJSON(
      R"({"version": 2, "handles": {"b1": {"rotate": {"axis": [0, 0, 1], "degrees": )" +
      std::to_string(degrees) + "}}}}");
    ASSERT_EQ(update(filter), "");
    EXPECT_EQ(bind_objects(vtkPolyData::SafeDownCast(filter->GetOutput())), before);
  }
}

TEST(PoseHandles, WhatIsWrongIsNamed)
{
  const std::pair<const char*, const char*> cases[] = {
    { R"({"handles": {"knee": {}}})", "knee" },
    { R"({"handles": {"p": {"rotation": 3}}})", "rotation" },
    { R"({"handles": {"p": {"translate": [1, 2]}}})", "translate" },
    { R"({"handles": {"p": {"scale": 0}}})", "scale" },
    { R"({"handles": {"p": {"mode": "loose"}}})", "mode must be" },
    { R"({"handles": {"p": {"rotate": {"axis": [0, 0, 0], "degrees": 5}}}})", "axis" },
    { R"({"handles": )", "" },
  };
  for (const auto& [text, word] : cases)
  {
    vtkNew<vtkPoseHandles> filter;
    filter->SetInputData(arm());
    filter->SetPoseJSON(text);
    const std::string error = update(filter);
    EXPECT_FALSE(error.empty()) << text;
    EXPECT_NE(error.find(word), std::string::npos) << error;
    EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  }
}

TEST(PoseHandles, ExpressionsFollowTime)
{
  vtkNew<vtkPoseHandles> filter;
  filter->SetInputData(arm());
  filter->SetPoseJSON(R"json({"handles": {"p": {
    "translate": ["sin(3.14159265358979 * t)", "t < 1 ? t : min(5, 7)", 0]}}})json");
  EXPECT_EQ(update(filter), "");
  EXPECT_TRUE(filter->GetHasExpressions());
  const auto place = [&]
  {
    return moved(
      pose_of(vtkPolyData::SafeDownCast(filter->GetOutput()))[0].transform, Vec3::Zero());
  };
  EXPECT_LT(place().norm(), 1e-14);
  filter->SetTime(0.5);
  EXPECT_EQ(update(filter), "");
  EXPECT_LT((place() - Vec3(1, 0.5, 0)).norm(), 1e-12);
  // The time that a pipeline requests has priority over the time that was set.
  filter->UpdateTimeStep(1.5);
  EXPECT_LT((place() - Vec3(-1, 5, 0)).norm(), 1e-12);
  filter->UpdateTimeStep(0.25);
  EXPECT_LT((place() - Vec3(std::sqrt(0.5), 0.25, 0)).norm(), 1e-12);
}

TEST(PoseHandles, BadExpressionsAreNamed)
{
  vtkNew<vtkPoseHandles> filter;
  filter->SetInputData(arm());
  const auto error = [&](const std::string& expression, double time = 0.0)
  {
    filter->SetPoseJSON("{\"handles\": {\"p\": {\"scale\": \"" + expression + "\"}}}");
    filter->SetTime(time);
    return update(filter);
  };
  for (const char* bad : { "", "sin(", "2 *", "unknown + t", "t t", "iHat", "'" })
  {
    const std::string text = error(bad);
    EXPECT_NE(text.find("handle 'p'.scale"), std::string::npos) << bad << ": " << text;
    EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT) << bad;
  }
  EXPECT_EQ(error("sqrt(1 - t)"), "");
  EXPECT_NE(error("sqrt(1 - t)", 2.0).find("not a finite number at t = 2"), std::string::npos);
  EXPECT_NE(error("1 / t").find("not a finite number at t = 0"), std::string::npos);
  EXPECT_NE(error("0 - t", 1.0).find("must be greater than 0"), std::string::npos);
}

TEST(PoseHandles, SequencesAreSourcesOfTime)
{
  vtkNew<vtkPoseHandles> filter;
  filter->SetInputData(arm());
  filter->SetPoseJSON(R"({"fps": 10, "frames": [{"handles": {"p": {"translate": [0, 0, 0]}}},
    {"handles": {"p": {"translate": [1, 0, 0]}}}, {"handles": {"p": {"translate": [2, 0, 0]}}}]})");
  filter->UpdateInformation();
  vtkInformation* info = filter->GetOutputInformation(0);
  ASSERT_EQ(info->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 3);
  EXPECT_DOUBLE_EQ(info->Get(vtkStreamingDemandDrivenPipeline::TIME_STEPS())[2], 0.2);
  const std::vector<std::pair<double, double>> frames{ { 0.0, 0 }, { 0.1, 1 }, { 0.19, 1 },
    { 0.2, 2 }, { 9.0, 2 }, { -1.0, 0 } };
  for (const auto& [time, x] : frames)
  {
    filter->UpdateTimeStep(time);
    EXPECT_EQ(pose_of(vtkPolyData::SafeDownCast(filter->GetOutput()))[0].transform(0, 3), x)
      << time;
  }
}
