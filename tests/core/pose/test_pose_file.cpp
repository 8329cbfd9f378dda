// Pose files in JSON: their meaning, hierarchies of handles, error messages, and round trips.
#include "pose/handle_hierarchy.h"
#include "pose/pose_file.h"
#include "pose/transform_parts.h"
#include "skinning/skinning.h"

#include "support/handles.h"
#include "support/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

using namespace bindpose;
using testing::AllOf;
using testing::HasSubstr;

namespace
{
/// Return a point, and a chain of two bones along x. The second bone in the list is the parent of
/// the first one.
Handles point_and_chain()
{
  Handles handles{ test::point_handle("p", Vec3(1, 2, 3)),
    test::bone_handle("fore", Vec3(1, 0, 0), Vec3(2, 0, 0)),
    test::bone_handle("upper", Vec3(0, 0, 0), Vec3(1, 0, 0)) };
  handles[1].parent = 2;
  return handles;
}

Pose read(const std::string& text, const Pose& base = Pose(3))
{
  PoseSequence sequence;
  const Status status = parse_pose_file(text, point_and_chain(), sequence);
  EXPECT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(sequence.frames.size(), 1u);
  return apply_edits(sequence.frames[0], point_and_chain(), base);
}

std::string message(const std::string& text)
{
  PoseSequence sequence;
  const Status status = parse_pose_file(text, point_and_chain(), sequence);
  EXPECT_EQ(status.code, StatusCode::invalid_input) << text;
  EXPECT_TRUE(sequence.frames.empty());
  return status.message;
}

Vec3 apply(const Affine& t, const Vec3& p)
{
  return t * p.homogeneous();
}
} // namespace

TEST(PoseFile, HandlesMoveAboutTheirPivots)
{
  const Pose pose = read(R"({"handles": {
    "p": {"mode": "position", "translate": [1, 0, 0],
          "rotate": {"axis": [0, 0, 5], "degrees": 90}, "scale": 2}}})");
  EXPECT_EQ(pose[0].mode, HandleMode::position);
  // The expected map is x -> c + t + R S (x - c) with the pivot c = (1, 2, 3), the translation t,
  // the rotation R and the scale S.
  EXPECT_LT((apply(pose[0].transform, Vec3(1, 2, 3)) - Vec3(2, 2, 3)).norm(), 1e-15);
  EXPECT_LT((apply(pose[0].transform, Vec3(2, 2, 4)) - Vec3(2, 4, 5)).norm(), 1e-15);
  EXPECT_EQ(pose[1].transform, identity_affine());
  EXPECT_EQ(pose[1].mode, HandleMode::automatic);
}

TEST(PoseFile, ModesOfHandlesWithoutModeAreFullWhereMoreThanATranslationIsGiven)
{
  const auto mode = [](const std::string& forearm, const Pose& base = Pose(3))
  { return read(R"({"version": 2, "handles": {"fore": {)" + forearm + "}}}", base)[1].mode; };
  EXPECT_EQ(mode(R"("translate": [1, 0, 0])"), HandleMode::automatic);
  EXPECT_EQ(mode(R"("rotate": {"axis": [0, 0, 1], "degrees": 0})"), HandleMode::full);
  EXPECT_EQ(mode(R"("scale": 1)"), HandleMode::full);
  EXPECT_EQ(mode(R"("tail": [2, 1, 0])"), HandleMode::full);
  EXPECT_EQ(mode(R"("stretch": 2)"), HandleMode::full);
  EXPECT_EQ(mode(R"("twist": [0, 9])"), HandleMode::full);
  EXPECT_EQ(mode(R"("scale": 2, "mode": "auto")"), HandleMode::automatic);
  Pose base(3);
  base[1].mode = HandleMode::free;
  EXPECT_EQ(mode(R"("scale": 2)", base), HandleMode::free);
}

TEST(PoseFile, WhatIsNotMentionedKeepsTheBase)
{
  Pose base(3);
  base[0].mode = HandleMode::free;
  base[0].transform(0, 3) = 7.0;
  base[1].twist << 3, 4;
  base[1].stretch = 1.5;
  const Pose pose = read(R"({"handles": {"fore": {"translate": [0, 1, 0]}, "p": {}}})", base);
  EXPECT_EQ(pose[0].mode, HandleMode::free);
  EXPECT_EQ(pose[0].transform, base[0].transform);
  EXPECT_EQ(pose[1].twist, base[1].twist);
  EXPECT_EQ(pose[1].stretch, 1.5);
  // Edits in a pose file are absolute, not relative to the base pose.
  base[1].transform(1, 3) = 100.0;
  EXPECT_EQ(
    read(R"({"handles": {"fore": {"translate": [0, 1, 0]}}})", base)[1].transform(1, 3), 1.0);
  // An edit that contains only a mode keeps the transform.
  EXPECT_EQ(read(R"({"handles": {"fore": {"mode": "free"}}})", base)[1].transform(1, 3), 100.0);
}

TEST(PoseFile, InVersionOneParentsComposeOnlyWhenAsked)
{
  const std::string upper = R"("upper": {"rotate": {"axis": [0, 0, 1], "degrees": 90}})";
  const std::string forearm = R"("fore": {"rotate": {"axis": [0, 0, 1], "degrees": 90})";
  // In world space, the bone rotates around the rest position of its own head.
  Pose pose = read("{\"handles\": {" + forearm + "}, " + upper + "}}");
  EXPECT_LT((apply(pose[1].transform, Vec3(2, 0, 0)) - Vec3(1, 1, 0)).norm(), 1e-15);
  // In parent space, the bone's own rotation is applied first. Then the rotation of the parent
  // around the origin is applied.
  pose = read("{\"handles\": {" + forearm + ", \"space\": \"parent\"}, " + upper + "}}");
  EXPECT_LT((apply(pose[1].transform, Vec3(1, 0, 0)) - Vec3(0, 1, 0)).norm(), 1e-15);
  EXPECT_LT((apply(pose[1].transform, Vec3(2, 0, 0)) - Vec3(-1, 1, 0)).norm(), 1e-15);
  // For a handle without a parent, parent space is the same as world space.
  pose = read(R"({"handles": {"upper": {"space": "parent", "translate": [1, 1, 1]}}})");
  EXPECT_EQ(pose[2].transform.col(3), Vec3(1, 1, 1));
  // A handle that the file does not mention keeps its transform.
  EXPECT_EQ(read("{\"handles\": {" + upper + "}}")[1].transform, identity_affine());
}

TEST(PoseFile, AMissingVersionWarnsIfChildrenWouldFollow)
{
  const auto warnings = [](const std::string& text)
  {
    PoseSequence sequence;
    const Status status = parse_pose_file(text, point_and_chain(), sequence);
    EXPECT_TRUE(status.ok()) << status.message;
    return status.warnings;
  };
  const std::string upper = R"("upper": {"scale": 2})";
  // There is exactly one warning for a single pose, and also for a sequence of poses.
  ASSERT_EQ(warnings("{\"handles\": {" + upper + "}}").size(), 1u);
  EXPECT_THAT(warnings("{\"handles\": {" + upper + "}}")[0], HasSubstr("\"version\": 2"));
  EXPECT_EQ(
    warnings("{\"frames\": [{\"handles\": {" + upper + "}}, {\"handles\": {" + upper + "}}]}")
      .size(),
    1u);
  // There is no warning if the file contains a version number, or if both versions of the format
  // give the same pose.
  EXPECT_EQ(warnings("{\"version\": 1, \"handles\": {" + upper + "}}").size(), 0u);
  EXPECT_EQ(warnings("{\"version\": 2, \"handles\": {" + upper + "}}").size(), 0u);
  EXPECT_EQ(warnings(R"({"handles": {"fore": {"scale": 2}, "p": {"scale": 2}}})").size(), 0u);
  EXPECT_EQ(warnings("{\"handles\": {" + upper + R"(, "fore": {"space": "world"}}})").size(), 0u);
}

TEST(PoseFile, ChildrenFollowTheirParents)
{
  const auto read_version_2 = [](const std::string& handles, const Pose& base = Pose(3))
  { return read("{\"version\": 2, \"handles\": {" + handles + "}}", base); };
  const std::string upper = R"("upper": {"rotate": {"axis": [0, 0, 1], "degrees": 90}})";
  // A rotation by 90 degrees about the origin rotates the bone and its child.
  Pose pose = read_version_2(upper);
  EXPECT_LT((apply(pose[1].transform, Vec3(2, 0, 0)) - Vec3(0, 2, 0)).norm(), 1e-15);
  EXPECT_EQ(pose[0].transform, identity_affine());
  // The child's own rotation by 90 degrees is applied first.
  pose = read_version_2(upper + R"(, "fore": {"rotate": {"axis": [0, 0, 1], "degrees": 90}})");
  EXPECT_LT((apply(pose[1].transform, Vec3(1, 0, 0)) - Vec3(0, 1, 0)).norm(), 1e-15);
  EXPECT_LT((apply(pose[1].transform, Vec3(2, 0, 0)) - Vec3(-1, 1, 0)).norm(), 1e-15);
  // In world space the child does not follow its parent. This is true if the file contains a
  // transform of the child, and also if it contains only the child's mode.
  pose = read_version_2(
    upper + R"(, "fore": {"space": "world", "rotate": {"axis": [0, 0, 1], "degrees": 90}})");
  EXPECT_LT((apply(pose[1].transform, Vec3(2, 0, 0)) - Vec3(1, 1, 0)).norm(), 1e-15);
  pose = read_version_2(upper + R"(, "fore": {"space": "world", "mode": "free"})");
  EXPECT_EQ(pose[1].transform, identity_affine());
  EXPECT_EQ(pose[1].mode, HandleMode::free);
  // A child at the tail of a bone moves with the stretched tail and rotates with the twist there.
  pose = read_version_2(R"("upper": {"rotate": {"axis": [0, 0, 1], "degrees": 90}, "stretch": 3})");
  EXPECT_LT((apply(pose[1].transform, Vec3(2, 0, 0)) - Vec3(0, 4, 0)).norm(), 1e-15);
  pose = read_version_2(R"("upper": {"twist": [0, 90]})");
  EXPECT_LT((apply(pose[1].transform, Vec3(2, 1, 0)) - Vec3(2, 0, 1)).norm(), 1e-15);
  // If the file specifies one end of the bone, this end is a world position. The other end follows
  // the parent.
  pose = read_version_2(upper + R"(, "fore": {"tail": [2, 1, 0]})");
  EXPECT_LT((apply(pose[1].transform, Vec3(1, 0, 0)) - Vec3(0, 1, 0)).norm(), 1e-15);
  EXPECT_LT((apply(pose[1].transform, Vec3(2, 0, 0)) - Vec3(1, 1, 0)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(pose[1].stretch, 2.0);
  // The specified tail coincides with the posed head of the same bone.
  pose = read_version_2(upper + R"(, "fore": {"tail": [0, 1, 0]})");
  EXPECT_EQ(pose[1].stretch, 1.0);
  EXPECT_TRUE(pose[1].transform.allFinite());
}

TEST(PoseFile, FollowersKeepTheirPlaceRelativeToTheParent)
{
  test::Random random(5);
  const auto motion = [&](double scale)
  {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(
      random.uniform(-3, 3), random.in_box(-Vec3::Ones(), Vec3::Ones()).normalized())
                                   .toRotationMatrix();
    return affine_about(Vec3::Zero(), scale * turn, random.in_box(-Vec3::Ones(), Vec3::Ones()));
  };
  for (int i = 0; i < 100; ++i)
  {
    Pose base(3);
    base[1].transform = motion(0.7);
    base[2].transform = motion(1.3);
    base[2].stretch = 1.5;
    base[2].twist << 20, 50;
    const Pose pose = read(
      R"({"version": 2, "handles": {"upper": {"translate": [0, 2, 0], "stretch": 0.5}}})", base);
    // The child's transform relative to the tail of its parent has not changed.
    Affine back, back_then;
    ASSERT_TRUE(invert(transform_for_child(point_and_chain()[2], pose[2], Vec3(1, 0, 0)), back));
    ASSERT_TRUE(
      invert(transform_for_child(point_and_chain()[2], base[2], Vec3(1, 0, 0)), back_then));
    EXPECT_LT((compose(back, pose[1].transform) - compose(back_then, base[1].transform))
                .cwiseAbs()
                .maxCoeff(),
      1e-13);
    // If the parent does not move, the bits of the child's transform do not change.
    EXPECT_EQ(
      read(R"({"version": 2, "handles": {"p": {"translate": [0, 2, 0]}}})", base)[1].transform,
      base[1].transform);
  }
  Pose flat(3);
  flat[2].transform.setZero();
  flat[1].transform(0, 3) = 4.0;
  EXPECT_EQ(read(R"({"version": 2, "handles": {"upper": {"scale": 1}}})", flat)[1].transform,
    flat[1].transform);
}

// A child moves with the posed skin at the point where the child is attached to its parent.
TEST(HandleHierarchy, ChildrenGoWithTheSkinWhereTheyAreAttached)
{
  test::Random random(6);
  const Handle bone = test::bone_handle("b", Vec3(1, 2, 3), Vec3(3, 2, 4));
  HandlePose posed;
  posed.transform = affine_about(bone.head,
    1.4 * Eigen::AngleAxisd(0.8, Vec3(1, 2, -1).normalized()).toRotationMatrix(), Vec3(4, 5, 6));
  posed.stretch = 1.7;
  posed.twist << -30, 75;
  Points rest(50, 3);
  for (Index i = 0; i < 50; ++i)
  {
    rest.row(i) = random.in_box(Vec3(0, 1, 2), Vec3(4, 3, 5)).transpose();
  }
  ExecutionContext context;
  Skinning skinning;
  const Weights weights = Weights::Ones(50, 1);
  ASSERT_TRUE(skinning.bind(context, weights).ok());
  Points skin;
  ASSERT_TRUE(skinning
                .stretchable_bones(context, rest, { posed.transform },
                  bone_changes({ bone }, { posed }), Weights(), skin)
                .ok());
  for (Index i = 0; i < 50; ++i)
  {
    const Vec3 position = rest.row(i).transpose();
    EXPECT_LT(
      (apply(transform_for_child(bone, posed, position), position) - skin.row(i).transpose())
        .norm(),
      1e-12);
  }
}

TEST(HandleHierarchy, ParentsComeFirst)
{
  Handles handles(5);
  handles[0].parent = 3;
  handles[3].parent = 4;
  handles[1].parent = 0;
  EXPECT_EQ(parents_first(handles), (std::vector<Index>{ 4, 3, 0, 1, 2 }));
  handles[4].parent = 1; // the parents form a cycle
  std::vector<Index> order = parents_first(handles);
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, (std::vector<Index>{ 0, 1, 2, 3, 4 }));
}

TEST(PoseFile, BonesGoWhereTheirEndsAreSent)
{
  const Pose pose =
    read(R"({"handles": {"fore": {"head": [5, 5, 5], "tail": [5, 5, 8], "twist": [10, 20]}}})");
  EXPECT_LT((apply(pose[1].transform, Vec3(1, 0, 0)) - Vec3(5, 5, 5)).norm(), 1e-14);
  // The bone keeps its length.
  EXPECT_LT((apply(pose[1].transform, Vec3(2, 0, 0)) - Vec3(5, 5, 6)).norm(), 1e-14);
  EXPECT_DOUBLE_EQ(pose[1].stretch, 3.0);
  EXPECT_EQ(pose[1].twist, Eigen::Vector2d(10, 20));
  // The bone gets the smallest rotation from its rest direction x to its posed direction z. The
  // axis of this rotation is y, so a vector along y does not change.
  EXPECT_LT((apply(pose[1].transform, Vec3(1, 1, 0)) - Vec3(5, 6, 5)).norm(), 1e-14);
  EXPECT_EQ(read(R"({"handles": {"fore": {"tail": [1, 2, 0], "stretch": 1}}})")[1].stretch, 1.0);
  // If the file specifies one end, the other end stays at its rest position.
  const Pose aimed = read(R"({"handles": {"fore": {"tail": [1, 4, 0]}}})");
  EXPECT_LT((apply(aimed[1].transform, Vec3(2, 0, 0)) - Vec3(1, 1, 0)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(aimed[1].stretch, 4.0);
}

TEST(PoseFile, SequencesHaveFramesAndARate)
{
  PoseSequence sequence;
  ASSERT_TRUE(parse_pose_file(R"({"frames": [{"handles": {}},
    {"handles": {"p": {"translate": [1, 0, 0]}}}], "fps": 12.5})",
    point_and_chain(), sequence)
                .ok());
  ASSERT_EQ(sequence.frames.size(), 2u);
  EXPECT_EQ(sequence.frames_per_second, 12.5);
  EXPECT_TRUE(sequence.frames[0].handles.empty());
  EXPECT_EQ(apply_edits(sequence.frames[1], point_and_chain(), Pose(3))[0].transform(0, 3), 1.0);
}

// The caller of parse_pose_file() provides a callback that evaluates expressions. The callback of
// this test evaluates 't' and 'twice t', fails for 'nonsense', and returns NaN for other texts.
TEST(PoseFile, TextsAreExpressionsInTime)
{
  const PoseExpression expression = [](const std::string& text, double t, double& value)
  {
    value = text == "t" ? t : text == "twice t" ? 2.0 * t : std::nan("");
    return text == "nonsense" ? Status::invalid_input("nobody knows this") : Status();
  };
  const std::string text = R"({"handles": {
    "p": {"mode": "position", "translate": ["t", 1, "twice t"]},
    "upper": {"rotate": {"axis": [0, 0, 1], "degrees": "t"}, "stretch": "t"}}})";
  PoseSequence sequence;
  ASSERT_TRUE(parse_pose_file(text, point_and_chain(), sequence, expression, 90.0).ok());
  EXPECT_TRUE(sequence.has_expressions);
  const Pose pose = apply_edits(sequence.frames[0], point_and_chain(), Pose(3));
  EXPECT_EQ(pose[0].transform.col(3), Vec3(90, 1, 180));
  EXPECT_LT((apply(pose[2].transform, Vec3(1, 0, 0)) - Vec3(0, 1, 0)).norm(), 1e-14);
  EXPECT_EQ(pose[2].stretch, 90.0);
  // In a sequence, the variable t is the time of the frame.
  const std::string frame = R"({"handles": {"p": {"translate": ["t", 0, 0]}}})";
  ASSERT_TRUE(parse_pose_file(R"({"fps": 4, "frames": [)" + frame + "," + frame + "]}",
    point_and_chain(), sequence, expression, 90.0)
                .ok());
  EXPECT_EQ(*sequence.frames[1].handles[0].translate, Vec3(0.25, 0, 0));

  const auto wrong = [&](const std::string& entry)
  {
    const Status status = parse_pose_file(
      R"({"handles": {"p": {)" + entry + "}}}", point_and_chain(), sequence, expression, 0.5);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    return status.message;
  };
  EXPECT_THAT(wrong(R"("translate": [0, "nonsense", 0])"),
    HasSubstr("handle 'p'.translate is 'nonsense': nobody knows this"));
  EXPECT_THAT(wrong(R"("scale": "never")"),
    HasSubstr("handle 'p'.scale is 'never', which is not a finite number at t = 0.5"));
  EXPECT_THAT(wrong(R"("mode": "t")"), HasSubstr("must be one of full, position, free"));
  EXPECT_THAT(wrong(R"("rotate": "t")"), HasSubstr("it must be an object"));
  // If the caller provides no callback for expressions, a text instead of a number is an error.
  EXPECT_THAT(message(text), HasSubstr("it must be a number"));
}

TEST(PoseFile, TimesAreReadWithoutHandles)
{
  PoseTimes times;
  ASSERT_TRUE(read_pose_times(R"({"handles": {"?": {"scale": 1, "mode": "full"}}})", times));
  EXPECT_EQ(times.frames, 1);
  EXPECT_FALSE(times.has_expressions);
  ASSERT_TRUE(read_pose_times(R"({"handles": {"?": {"translate": [0, "t", 0]}}})", times));
  EXPECT_TRUE(times.has_expressions);
  ASSERT_TRUE(read_pose_times(R"({"fps": 5, "frames": [{"handles": {}}, {}, 3]})", times));
  EXPECT_EQ(times.frames, 3);
  EXPECT_EQ(times.frames_per_second, 5.0);
  for (const char* text : { "", "{", "[]", "3", "{}", R"({"frames": []})" })
  {
    EXPECT_FALSE(read_pose_times(text, times)) << text;
  }
}

TEST(PoseFile, WhatIsWrongIsNamed)
{
  EXPECT_THAT(message(""), HasSubstr("empty"));
  EXPECT_THAT(message(" \n"), HasSubstr("empty"));
  EXPECT_THAT(message("{}"), HasSubstr("must have the key 'handles'"));
  EXPECT_THAT(message("[]"), HasSubstr("must be an object"));
  EXPECT_THAT(message(R"({"handles": {"p": )"), HasSubstr("not valid JSON"));
  EXPECT_THAT(message(R"({"handles": []})"), HasSubstr("handles"));
  EXPECT_THAT(message(R"({"handles": {"q": {}}})"), HasSubstr("'q', which does not exist"));
  EXPECT_THAT(message(R"({"handles": {}, "frame": 1})"), HasSubstr("'frame'"));
  EXPECT_THAT(message(R"({"handles": {"p": {"color": 1}}})"), HasSubstr("'color'"));
  EXPECT_THAT(message(R"({"handles": {"p": 3}})"), HasSubstr("is a number"));
  EXPECT_THAT(message(R"({"handles": {"p": {}, "p": {}}})"), HasSubstr("'p' is defined twice"));
  EXPECT_THAT(
    message(R"({"handles": {"p": {"mode": "half"}}})"), HasSubstr("full, position, free"));
  EXPECT_THAT(message(R"({"handles": {"p": {"mode": 1}}})"), HasSubstr("full, position, free"));
  EXPECT_THAT(message(R"({"handles": {"p": {"mode": "ends"}}})"),
    HasSubstr("mode is 'ends', which is only for bones, but the handle is a point"));
  EXPECT_THAT(message(R"({"handles": {"p": {"translate": [1, 2]}}})"), HasSubstr("3 numbers"));
  EXPECT_THAT(message(R"({"handles": {"p": {"translate": [1, 2, "x"]}}})"), HasSubstr("a string"));
  EXPECT_THAT(message(R"({"handles": {"p": {"translate": [1, 2, null]}}})"), HasSubstr("null"));
  EXPECT_THAT(message(R"({"handles": {"p": {"translate": [1, 2, NaN]}}})"), HasSubstr("JSON"));
  EXPECT_THAT(message(R"({"handles": {"p": {"translate": [1, 2, 1e999]}}})"), HasSubstr("JSON"));
  EXPECT_THAT(message(R"({"handles": {"p": {"rotate": {"axis": [0, 0, 0], "degrees": 1}}}})"),
    HasSubstr("axis has length zero"));
  EXPECT_THAT(
    message(R"({"handles": {"p": {"rotate": {"axis": [0, 0, 1]}}}})"), HasSubstr("degrees"));
  EXPECT_THAT(message(R"({"handles": {"p": {"rotate": {"axis": [0, 0, 1], "radians": 1}}}})"),
    HasSubstr("'radians'"));
  EXPECT_THAT(message(R"({"handles": {"p": {"scale": 0}}})"), HasSubstr("greater than 0"));
  EXPECT_THAT(message(R"({"handles": {"p": {"scale": -1}}})"), HasSubstr("greater than 0"));
  EXPECT_THAT(message(R"({"handles": {"p": {"space": "local"}}})"), HasSubstr("parent, world"));
  EXPECT_THAT(message(R"({"handles": {"p": {"head": [0, 0, 0]}}})"), HasSubstr("for bones"));
  EXPECT_THAT(message(R"({"handles": {"fore": {"head": [2, 0, 0]}}})"), HasSubstr("length zero"));
  EXPECT_THAT(message(R"({"handles": {"fore": {"head": [1, 1, 1], "scale": 2}}})"),
    HasSubstr("must not combine head or tail"));
  EXPECT_THAT(message(R"({"handles": {"fore": {"twist": [1]}}})"), HasSubstr("2 numbers"));
  EXPECT_THAT(message(R"({"version": 3, "handles": {}})"), HasSubstr("expected 1 or 2"));
  EXPECT_THAT(message(R"({"version": "2", "handles": {}})"), HasSubstr("version is \"2\""));
  EXPECT_THAT(message(R"({"frames": [{"version": 2, "handles": {}}]})"), HasSubstr("'version'"));
  EXPECT_THAT(message(R"({"frames": []})"), HasSubstr("at least one"));
  EXPECT_THAT(message(R"({"frames": [{"handles": {}}], "fps": 0})"), HasSubstr("fps"));
  EXPECT_THAT(
    message(R"({"frames": [{"handles": {}}, {"handles": {"x": {}}}]})"), HasSubstr("frame 1"));
}

TEST(Pose, ValuesThatAreNotFiniteAreNamed)
{
  const Handles handles = { test::bone_handle("b1", Vec3::Zero(), Vec3::UnitX()),
    test::bone_handle("b2", Vec3::UnitX(), Vec3(2.0, 0.0, 0.0)) };
  const Pose rest(handles.size());
  EXPECT_TRUE(check_pose(handles, rest).ok());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int part = 0; part < 3; ++part)
  {
    Pose pose = rest;
    HandlePose& changed = pose[1];
    (part == 0 ? changed.transform(1, 3) : part == 1 ? changed.stretch : changed.twist[1]) = nan;
    const Status status = check_pose(handles, pose);
    EXPECT_EQ(status.code, StatusCode::invalid_input) << part;
    EXPECT_THAT(status.message, HasSubstr("'" + handles[1].name + "'"));
  }
}

TEST(Pose, ValuesThatAreTooLargeAreNamed)
{
  const Handles handles = { test::bone_handle("b1", Vec3::Zero(), Vec3::UnitX()) };
  for (int part = 0; part < 3; ++part)
  {
    Pose pose(1);
    double& value = part == 0 ? pose[0].transform(2, 3)
      : part == 1             ? pose[0].stretch
                              : pose[0].twist[0];
    value = -1e102;
    EXPECT_TRUE(check_pose(handles, pose).ok()) << part;
    value = -1e308;
    EXPECT_THAT(check_pose(handles, pose).message,
      AllOf(HasSubstr("'b1'"), HasSubstr("1e+308; expected at most 1e102")))
      << part;
  }
}

TEST(PoseFile, WhatIsWrittenIsReadBack)
{
  test::Random random(9);
  std::vector<Pose> poses;
  for (int frame = 0; frame < 20; ++frame)
  {
    Pose pose(3);
    for (std::size_t h = 0; h < 3; ++h)
    {
      const Eigen::Matrix3d r = Eigen::AngleAxisd(
        random.uniform(-3, 3), random.in_box(-Vec3::Ones(), Vec3::Ones()).normalized())
                                  .toRotationMatrix();
      const HandleMode modes[] = { HandleMode::full, HandleMode::position, HandleMode::free,
        HandleMode::automatic };
      pose[h].mode = modes[random.below(4)];
      const bool moves = random.below(4) == 0;
      pose[h].transform = affine_about(point_and_chain()[h].head,
        moves ? Eigen::Matrix3d::Identity().eval() : Eigen::Matrix3d(random.uniform(0.1, 3) * r),
        random.in_box(-Vec3::Ones(), Vec3::Ones()));
      if (!moves && point_and_chain()[h].kind == HandleKind::bone)
      {
        pose[h].stretch = random.uniform(0.5, 2);
        pose[h].twist << random.uniform(-90, 90), random.uniform(-90, 90);
      }
    }
    poses.push_back(pose);
  }
  std::string text;
  const Status status = format_pose_file(poses, 30.0, point_and_chain(), text);
  ASSERT_TRUE(status.ok() && status.warnings.empty());
  PoseSequence sequence;
  ASSERT_TRUE(parse_pose_file(text, point_and_chain(), sequence).ok());
  ASSERT_EQ(sequence.frames.size(), 20u);
  EXPECT_EQ(sequence.frames_per_second, 30.0);
  Pose other(3); // a base pose, which must have no effect
  other[1].transform(0, 0) = 9.0;
  other[1].mode = HandleMode::free;
  for (std::size_t frame = 0; frame < 20; ++frame)
  {
    const Pose back = apply_edits(sequence.frames[frame], point_and_chain(), other);
    for (std::size_t h = 0; h < 3; ++h)
    {
      EXPECT_EQ(back[h].mode, poses[frame][h].mode);
      EXPECT_LT((back[h].transform - poses[frame][h].transform).cwiseAbs().maxCoeff(), 1e-13);
      EXPECT_EQ(back[h].stretch, poses[frame][h].stretch);
      EXPECT_EQ(back[h].twist, poses[frame][h].twist);
    }
  }
}

TEST(PoseFile, ChangesOfABasePoseAreWritten)
{
  const Handles handles = point_and_chain();
  Pose base(3);
  base[0].transform.col(3) = Vec3(0.5, 0, 0);
  base[1].mode = HandleMode::full;
  std::string text = "not empty";
  ASSERT_TRUE(format_pose_changes(base, base, handles, text).ok());
  EXPECT_EQ(text, "");
  // The upper bone rotates, and its child follows it. The text must not contain the child.
  Pose pose = base;
  pose[2].transform = affine_about(Vec3::Zero(),
    Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix(), Vec3(0.1, 0.2, 0.3));
  follow_parent(handles, base, 1, pose);
  ASSERT_TRUE(format_pose_changes(base, pose, handles, text).ok());
  EXPECT_THAT(text, HasSubstr("\"upper\""));
  EXPECT_THAT(text, testing::Not(HasSubstr("\"fore\"")));
  EXPECT_THAT(text, testing::Not(HasSubstr("\"p\"")));
  const Pose back = read(text, base);
  for (std::size_t h = 0; h < 3; ++h)
  {
    EXPECT_EQ(back[h].mode, pose[h].mode);
    EXPECT_LT((back[h].transform - pose[h].transform).cwiseAbs().maxCoeff(), 1e-13);
  }
  // The text must contain every handle whose mode or stretch has changed, and every child that does
  // not follow its parent.
  pose[0].mode = HandleMode::position;
  pose[1].transform = identity_affine();
  base[2].stretch = 1.5;
  ASSERT_TRUE(format_pose_changes(base, pose, handles, text).ok());
  const Pose again = read(text, base);
  EXPECT_EQ(again[2].stretch, 1.0);
  EXPECT_EQ(again[0].mode, HandleMode::position);
  EXPECT_LT((again[1].transform - identity_affine()).cwiseAbs().maxCoeff(), 1e-13);
  pose[1].transform(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(format_pose_changes(base, pose, handles, text).message, HasSubstr("'fore'"));
  EXPECT_THAT(format_pose_changes(Pose(2), base, handles, text).message, HasSubstr("expected 3"));
}

TEST(PoseFile, WhatIsWrittenCanBeRead)
{
  std::string text;
  Handles handles = point_and_chain();
  handles[1].name = "caf\xe9"; // Latin-1 encoding
  EXPECT_THAT(format_pose_file({ Pose(3) }, 24.0, handles, text).message, HasSubstr("UTF-8"));
  handles[1].name = "two\nlines \"quoted\"";
  ASSERT_TRUE(format_pose_file({ Pose(3) }, 24.0, handles, text).ok());
  PoseSequence sequence;
  EXPECT_TRUE(parse_pose_file(text, handles, sequence).ok());
  EXPECT_EQ(message(text),
    "the pose file: the pose refers to the handle 'two?lines \"quoted\"', which does not exist");
  // JSON cannot represent infinity.
  Pose pose(3);
  pose[1].stretch = std::numeric_limits<double>::infinity();
  EXPECT_THAT(
    format_pose_file({ pose }, 24.0, point_and_chain(), text).message, HasSubstr("'fore'"));
  pose = Pose(3);
  pose[0].transform(0, 0) = 1e102;
  EXPECT_TRUE(format_pose_file({ pose }, 24.0, point_and_chain(), text).ok());
  pose[0].transform(1, 1) = 1e103;
  EXPECT_THAT(format_pose_file({ pose }, 24.0, point_and_chain(), text).message,
    AllOf(HasSubstr("'p'"), HasSubstr("1e+103"), HasSubstr("at most 1e102")));
  // The squares of these lengths overflow or underflow, but the ratio of the lengths is
  // representable.
  EXPECT_EQ(
    read(R"({"handles": {"fore": {"head": [0, 0, 0], "tail": [0, 1e200, 0]}}})")[1].stretch, 1e200);
  EXPECT_EQ(
    read(R"({"handles": {"fore": {"head": [0, 0, 0], "tail": [0, 1e-200, 0]}}})")[1].stretch,
    1e-200);
}

TEST(PoseFile, ScalesUnevenByRoundoffAreEven)
{
  // A rotation with uniform scale is recognized even if the matrix was rounded to single precision.
  // This is true for any scale.
  for (const double scale : { 0.01, 1.0, 100.0 })
  {
    Pose pose(3);
    const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Vec3 uneven(scale, scale * (1.0 + 2e-6), scale * (1.0 - 1.8e-6));
    pose[0].transform.leftCols<3>() = turn * uneven.asDiagonal();
    std::string text;
    Status status = format_pose_file({ pose }, 24.0, point_and_chain(), text);
    ASSERT_TRUE(status.ok());
    EXPECT_TRUE(status.warnings.empty()) << status.warnings[0];
    EXPECT_LT((read(text)[0].transform - pose[0].transform).cwiseAbs().maxCoeff(), 1e-5 * scale);
    // A scale of 1.001 along one axis is intended, so it must not be treated as uniform.
    pose[0].transform.leftCols<3>() = turn * Vec3(scale, scale, 1.001 * scale).asDiagonal();
    status = format_pose_file({ pose }, 24.0, point_and_chain(), text);
    EXPECT_EQ(status.warnings.size(), 1u);
  }
}

TEST(PoseFile, WhatAFileCannotHoldIsSaid)
{
  Pose pose(3);
  pose[0].transform(0, 1) = 0.5;
  std::string text;
  const Status status = format_pose_file({ pose }, 24.0, point_and_chain(), text);
  ASSERT_TRUE(status.ok());
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("'p'"));
  EXPECT_FALSE(read(text).empty());

  // There is only one warning, which is about all handles and poses.
  Pose sheared = pose;
  sheared[1].transform(1, 1) = 1.5;
  Status grouped =
    format_pose_file({ pose, Pose(3), sheared, sheared }, 24.0, point_and_chain(), text);
  ASSERT_EQ(grouped.warnings.size(), 1u);
  EXPECT_THAT(grouped.warnings[0], HasSubstr("2 handles ('p', '"));
  EXPECT_THAT(grouped.warnings[0], HasSubstr("in 3 of 4 poses"));
  EXPECT_EQ(format_pose_file({}, 24.0, point_and_chain(), text).code, StatusCode::invalid_input);
  EXPECT_EQ(
    format_pose_file({ Pose(2) }, 24.0, point_and_chain(), text).code, StatusCode::invalid_input);
}
