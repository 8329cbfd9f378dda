// Stored poses and key frames: poses are restored exactly, and interpolation between keys follows
// the documented paths.
#include "poses/key_frames.h"
#include "poses/pose_blend.h"
#include "poses/pose_library.h"
#include "rigs.h"

#include "pose/pose_file.h"
#include "pose/transform_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using Json = nlohmann::ordered_json;

namespace
{
Handles handles()
{
  return { test::bone_handle("bone", Vec3(1, 0, 0), Vec3(2, 0, 0)),
    test::point_handle("point", Vec3(0, 1, 0)) };
}

Pose at(double amount)
{
  return test::some_pose(handles(), amount);
}

void expect_same(const Pose& a, const Pose& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    EXPECT_EQ(a[k].mode, b[k].mode);
    EXPECT_EQ(a[k].transform, b[k].transform);
    EXPECT_EQ(a[k].stretch, b[k].stretch);
    EXPECT_EQ(a[k].twist, b[k].twist);
  }
}

Pose moved(double x)
{
  Pose pose(2);
  pose[1].transform(0, 3) = x;
  return pose;
}

Pose turned(double degrees)
{
  Pose pose(2);
  pose[0].transform = affine_about(handles()[0].head,
    Eigen::AngleAxisd(degrees * 3.14159265358979323846 / 180.0, Vec3::UnitZ()).toRotationMatrix(),
    Vec3::Zero());
  return pose;
}
} // namespace

TEST(Blend, EndsAreExactAndTheMiddleIsHalfway)
{
  expect_same(blend(handles(), at(0.3), at(1), 0.0), at(0.3));
  expect_same(blend(handles(), at(0.3), at(1), 1.0), at(1));
  const Pose middle = blend(handles(), turned(20), turned(80), 0.5);
  EXPECT_LT((middle[0].transform - turned(50)[0].transform).cwiseAbs().maxCoeff(), 1e-14);
  // The interpolation takes the shorter rotation and stays rigid.
  const Pose across = blend(handles(), turned(170), turned(-170), 0.5);
  EXPECT_LT((across[0].transform - turned(180)[0].transform).cwiseAbs().maxCoeff(), 1e-13);
  // Between equal transforms, the interpolation keeps all bits.
  const Pose still = blend(handles(), at(0.7), at(0.7), 0.4);
  EXPECT_EQ(still[0].transform, at(0.7)[0].transform);
}

TEST(Blend, ChildrenStayOnTheirParents)
{
  // The upper arm rotates by 180 degrees. Halfway, the distance between elbow and shoulder must be
  // the length of the upper arm, which is 1. The forearm has no rotation of its own and must be
  // straight.
  Handles arm{ test::bone_handle("upper", Vec3(0, 0, 0), Vec3(1, 0, 0)),
    test::bone_handle("fore", Vec3(1, 0, 0), Vec3(2, 0, 0)) };
  arm[1].parent = 0;
  const Pose rest(2);
  HandleValues half_turn;
  half_turn.degrees.z() = 180.0 - 1e-9;
  const Pose swung = with_values(arm, rest, 0, half_turn);
  const Pose middle = blend(arm, rest, swung, 0.5);
  EXPECT_LT((middle[1].transform * Vec3(1, 0, 0).homogeneous() - Vec3(0, 1, 0)).norm(), 1e-9);
  EXPECT_LT((middle[1].transform * Vec3(2, 0, 0).homogeneous() - Vec3(0, 2, 0)).norm(), 1e-9);
  // Spline interpolation between keys preserves the length of the upper arm.
  KeyFrames keys;
  keys.interpolation = KeyInterpolation::spline;
  for (const double t : { 0.0, 1.0, 2.0 })
  {
    HandleValues values;
    values.degrees.z() = 90.0 * t;
    keys.set(t, NamedPose(arm, with_values(arm, rest, 0, values)));
  }
  for (const double t : { 0.2, 0.5, 1.7 })
  {
    const Pose pose = keys.pose_at(t, arm, rest);
    EXPECT_NEAR((pose[1].transform * Vec3(1, 0, 0).homogeneous()).norm(), 1.0, 1e-12) << t;
    EXPECT_EQ(pose[0].transform, pose[1].transform) << t;
  }
  // If a stored pose does not contain a handle, the handle follows its parent.
  const Pose known = NamedPose({ arm[0] }, { swung[0] }).for_handles(arm, rest);
  EXPECT_LT((known[1].transform - swung[0].transform).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(HandleValues, AreReadBackAsTyped)
{
  Handles handles = ::handles();
  Pose pose(2);
  HandleValues typed;
  typed.translate = Vec3(0.1, -2, 3);
  typed.degrees = Vec3(30, -50, 120);
  typed.scale = 1.5;
  typed.stretch = 1.25;
  typed.twist = Eigen::Vector2d(-30, 400);
  pose[0].mode = HandleMode::position;
  pose = with_values(handles, pose, 0, typed);
  EXPECT_EQ(pose[0].mode, HandleMode::position);
  EXPECT_EQ(pose[1].transform, identity_affine());
  const auto expect_typed = [&](const HandleValues& read)
  {
    EXPECT_LT((read.translate - typed.translate).norm(), 1e-13);
    EXPECT_LT((read.degrees - typed.degrees).norm(), 1e-11);
    EXPECT_NEAR(read.scale, 1.5, 1e-14);
    EXPECT_EQ(read.stretch, 1.25);
    EXPECT_EQ(read.twist, typed.twist);
    EXPECT_FALSE(read.is_approximate);
  };
  expect_typed(values_of(handles, pose, 0));
  // The values of a child are relative to its parent, so they do not change if the parent moves.
  handles[1].parent = 0;
  const Pose before = pose;
  pose = with_values(handles, pose, 1, typed);
  expect_typed(values_of(handles, pose, 1));
  HandleValues other;
  other.degrees = Vec3(10, 20, 30);
  pose = with_values(handles, pose, 0, other);
  expect_typed(values_of(handles, pose, 1));
  EXPECT_GT((pose[1].transform - before[1].transform).norm(), 0.1);
  handles[1].parent = -1;
  // If the rotation about y is 90 degrees, rotations about x and about z are equivalent.
  typed.degrees = Vec3(20, 90, 0);
  pose = with_values(handles, pose, 0, typed);
  EXPECT_LT(
    (with_values(handles, pose, 0, values_of(handles, pose, 0))[0].transform - pose[0].transform)
      .cwiseAbs()
      .maxCoeff(),
    1e-7);
  pose[0].transform(0, 1) += 0.5;
  EXPECT_TRUE(values_of(handles, pose, 0).is_approximate);
}

TEST(KeyFrames, HitTheirKeysExactly)
{
  KeyFrames keys;
  keys.set(1.0, NamedPose(handles(), at(1)));
  keys.set(0.25, NamedPose(handles(), at(0.2)));
  keys.set(2.0, NamedPose(handles(), at(-0.5)));
  for (const KeyInterpolation kind : { KeyInterpolation::linear, KeyInterpolation::spline })
  {
    keys.interpolation = kind;
    expect_same(keys.pose_at(0.25, handles(), Pose(2)), at(0.2));
    expect_same(keys.pose_at(1.0, handles(), Pose(2)), at(1));
    expect_same(keys.pose_at(2.0, handles(), Pose(2)), at(-0.5));
    expect_same(keys.pose_at(0.0, handles(), Pose(2)), at(0.2)); // the time is before the first key
    expect_same(keys.pose_at(9.0, handles(), Pose(2)), at(-0.5)); // the time is after the last key
    const auto frames = keys.frames(handles(), Pose(2));
    ASSERT_EQ(frames.size(), 49U); // the frames are from 0 to 2 s at 24 frames per second
    expect_same(frames[24], at(1));
    expect_same(frames[6], at(0.2));
    // The motion is continuous at a key.
    const Affine near = keys.pose_at(1.0 - 1e-9, handles(), Pose(2))[0].transform;
    EXPECT_LT((near - at(1)[0].transform).cwiseAbs().maxCoeff(), 1e-7);
  }
}

TEST(KeyFrames, PivotsGoStraightOrOnAParabola)
{
  KeyFrames keys;
  for (const double t : { 0.0, 1.0, 2.0, 3.0 })
  {
    keys.set(t, NamedPose(handles(), moved(t * t)));
  }
  EXPECT_NEAR(keys.pose_at(1.5, handles(), Pose(2))[1].transform(0, 3), 2.5, 1e-14);
  keys.interpolation = KeyInterpolation::spline;
  // The slope at an inner key is the slope of the parabola through the key and its two neighbors.
  // If all keys are on one parabola, the spline equals this parabola between inner keys.
  for (const double t : { 1.1, 1.5, 1.9 })
  {
    EXPECT_NEAR(keys.pose_at(t, handles(), Pose(2))[1].transform(0, 3), t * t, 1e-13);
  }
}

TEST(KeyFrames, AreSetMovedAndRemoved)
{
  KeyFrames keys;
  EXPECT_EQ(keys.set(1.0, NamedPose(handles(), at(1))), 0U);
  EXPECT_EQ(keys.set(0.5, NamedPose(handles(), at(2))), 0U);
  EXPECT_EQ(keys.set(1.0 + 1e-4, NamedPose(handles(), at(3))), 1U); // this replaces the key at 1.0
  ASSERT_EQ(keys.keys().size(), 2U);
  EXPECT_EQ(keys.move(0, 4.0), 1U);
  EXPECT_EQ(keys.duration(), 4.0);
  EXPECT_EQ(keys.index_at(4.0), 1);
  EXPECT_EQ(keys.index_at(3.0), -1);
  keys.remove(1);
  EXPECT_EQ(keys.duration(), 1.0);
  keys.set(-3.0, NamedPose(handles(), at(1)));
  EXPECT_EQ(keys.keys().front().time, 0.0);
  KeyFrames none;
  expect_same(none.pose_at(1.0, handles(), at(0.4)), at(0.4));
  EXPECT_TRUE(none.frames(handles(), at(1)).empty());
}

TEST(KeyFrames, AreTheSameAfterASession)
{
  KeyFrames keys;
  keys.set(0.0, NamedPose(handles(), at(0)));
  keys.set(0.7, NamedPose(handles(), at(0.123456789)));
  keys.frames_per_second = 30.0;
  keys.interpolation = KeyInterpolation::spline;
  keys.loop = false;
  KeyFrames read;
  ASSERT_TRUE(from_json(Json::parse(to_json(keys).dump()), read).ok());
  EXPECT_EQ(read.frames_per_second, 30.0);
  EXPECT_EQ(read.interpolation, KeyInterpolation::spline);
  EXPECT_FALSE(read.loop);
  for (const double t : { 0.0, 0.2, 0.7 })
  {
    expect_same(read.pose_at(t, handles(), Pose(2)), keys.pose_at(t, handles(), Pose(2)));
  }
  for (const char* broken :
    { "3", R"({"keys": 3})", R"({"keys": [{}]})", R"({"fps": 0})", R"({"keys": [{"time": -1}]})",
      R"({"keys": [{"time": 1, "handles": {"point": {"mode": "stiff"}}}]})",
      R"({"keys": [{"time": 1, "handles": {"point": {"transform": [1, 2]}}}]})" })
  {
    const Status status = from_json(Json::parse(broken), read);
    EXPECT_EQ(status.code, StatusCode::invalid_input) << broken;
    EXPECT_FALSE(status.message.empty());
    EXPECT_EQ(read.keys().size(), 2U); // the keys are not changed by the failure
  }
}

TEST(KeyFrames, FramesAreAPoseFile)
{
  KeyFrames keys;
  keys.set(0.0, NamedPose(handles(), turned(0)));
  keys.set(0.5, NamedPose(handles(), turned(90)));
  std::string text;
  ASSERT_TRUE(format_pose_file(keys.frames(handles(), Pose(2)), 24.0, handles(), text).ok());
  PoseSequence read;
  ASSERT_TRUE(parse_pose_file(text, handles(), read).ok());
  ASSERT_EQ(read.frames.size(), 13U);
  const Pose last = apply_edits(read.frames.back(), handles(), Pose(2));
  EXPECT_LT((last[0].transform - turned(90)[0].transform).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(NamedPose, FitsOtherHandlesByTheirNames)
{
  const NamedPose kept(handles(), at(1));
  Handles others = { test::point_handle("new", Vec3::Zero()), handles()[1], handles()[0] };
  Pose base(3);
  base[0].stretch = 7.0;
  const Pose pose = kept.for_handles(others, base);
  EXPECT_EQ(pose[0].stretch, 7.0);
  EXPECT_EQ(pose[1].transform, at(1)[1].transform);
  EXPECT_EQ(pose[2].twist, at(1)[0].twist);
}

TEST(PoseLibrary, KeepsPosesByName)
{
  PoseLibrary library;
  EXPECT_EQ(library.store("bow", NamedPose(handles(), at(1))), "bow");
  EXPECT_EQ(library.store("bow", NamedPose(handles(), at(2))), "bow 2");
  EXPECT_EQ(library.store("", NamedPose(handles(), at(3))), "pose");
  EXPECT_FALSE(library.rename(1, "bow"));
  EXPECT_FALSE(library.rename(1, ""));
  EXPECT_FALSE(library.rename(9, "x"));
  EXPECT_TRUE(library.rename(1, "wave"));
  library.remove(0);
  PoseLibrary read;
  ASSERT_TRUE(from_json(Json::parse(to_json(library).dump()), read).ok());
  ASSERT_EQ(read.entries().size(), 2U);
  EXPECT_EQ(read.entries()[0].name, "wave");
  expect_same(read.entries()[0].pose.for_handles(handles(), Pose(2)), at(2));
  EXPECT_EQ(from_json(Json::parse("{}"), read).code, StatusCode::invalid_input);
  EXPECT_EQ(from_json(Json::parse("[3]"), read).code, StatusCode::invalid_input);
  EXPECT_EQ(read.entries().size(), 2U);
}
