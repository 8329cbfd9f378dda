// Motions of one skeleton on handles of another: the same skeleton moves as in the file, and a
// skeleton with another size, position, rest pose or other axes gets the directions of the bones.
#include "pose/handle_hierarchy.h"
#include "pose/retarget.h"
#include "pose/transform_parts.h"

#include "support/handles.h"
#include "support/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;

namespace
{
Vec3 moved(const Affine& t, const Vec3& p)
{
  return t.leftCols<3>() * p + t.col(3);
}

Eigen::Matrix3d turn(const Vec3& axis, double degrees)
{
  return Eigen::AngleAxisd(degrees * EIGEN_PI / 180.0, axis.normalized()).toRotationMatrix();
}

/// Return a chain of three bones from `start`, along the given directions.
Handles chain(const Vec3& start, const std::vector<Vec3>& bones)
{
  const char* names[] = { "hips", "spine", "head" };
  Handles handles;
  Vec3 at = start;
  for (std::size_t k = 0; k < bones.size(); ++k)
  {
    handles.push_back(test::bone_handle(names[k], at, at + bones[k], static_cast<Index>(k) - 1));
    at += bones[k];
  }
  return handles;
}

std::vector<MotionJoint> to_joints(const Handles& handles)
{
  std::vector<MotionJoint> joints;
  for (const Handle& handle : handles)
  {
    joints.push_back({ handle.name, handle.parent, handle.head });
  }
  return joints;
}

/// Return the transforms in which each bone is rotated in world space, and the first one is moved.
std::vector<Affine> posed_chain(
  const Handles& handles, const std::vector<Eigen::Matrix3d>& rotations, const Vec3& translation)
{
  std::vector<Affine> transforms;
  Vec3 head = handles[0].head + translation;
  for (std::size_t k = 0; k < handles.size(); ++k)
  {
    transforms.push_back(affine_about(handles[k].head, rotations[k], head - handles[k].head));
    head = moved(transforms.back(), handles[k].tail);
  }
  return transforms;
}

/// Expect that each handle has the transform, and mode full.
void expect_pose(const Pose& pose, const std::vector<Affine>& expected)
{
  for (std::size_t h = 0; h < pose.size(); ++h)
  {
    EXPECT_EQ(pose[h].mode, HandleMode::full);
    EXPECT_LT((pose[h].transform - expected[h]).cwiseAbs().maxCoeff(), 1e-12) << h;
  }
}

const std::vector<Eigen::Matrix3d> rotations = { turn(Vec3(0, 0, 1), 20.0),
  turn(Vec3(1, 0, 0), 40.0), turn(Vec3(1, 1, 0), -70.0) };
} // namespace

TEST(Retarget, TheSameSkeletonMovesAsInTheFile)
{
  const Handles handles = chain(Vec3(1, 2, 3), { Vec3(0, 1, 0), Vec3(0, 2, 0), Vec3(1, 0, 0) });
  const std::vector<Affine> rest(3, identity_affine());
  const std::vector<Affine> frame = posed_chain(handles, rotations, Vec3(5, 0, 0));
  expect_pose(Retarget(handles, to_joints(handles)).apply(Pose(3), frame, rest), frame);
}

TEST(Retarget, AnotherSizeAndPositionGetsTheSameRotations)
{
  const Handles joints = chain(Vec3::Zero(), { Vec3(0, 1, 0), Vec3(0, 2, 0), Vec3(1, 0, 0) });
  const Handles handles = chain(Vec3(7, 8, 9), { Vec3(0, 10, 0), Vec3(0, 20, 0), Vec3(10, 0, 0) });
  const Vec3 step(0.5, 0.0, 0.25);
  const std::vector<Affine> first = posed_chain(joints, rotations, Vec3(0, 9, 0));
  const std::vector<Affine> frame = posed_chain(joints, rotations, Vec3(0, 9, 0) + step);
  expect_pose(Retarget(handles, to_joints(joints)).apply(Pose(3), frame, first),
    posed_chain(handles, rotations, 10.0 * step));
}

TEST(Retarget, OtherAxesTurnTheMotion)
{
  // The skeleton of the motion is the same, with z up instead of y up.
  const Eigen::Matrix3d up = turn(Vec3(1, 0, 0), 90.0);
  const std::vector<Vec3> heads = { Vec3(0, 0, 0), Vec3(0, 2, 0), Vec3(1, 2, 0), Vec3(0, 2, 0.5) };
  Handles handles;
  std::vector<MotionJoint> joints;
  for (std::size_t k = 0; k < heads.size(); ++k)
  {
    const std::string name = "j" + std::to_string(k);
    const Index parent = k == 0 ? -1 : k == 1 ? 0 : 1;
    handles.push_back(test::bone_handle(name, heads[k], heads[k] + Vec3(0, 1, 0), parent));
    joints.push_back({ name, parent, up * heads[k] });
  }
  const std::vector<Affine> first(heads.size(), identity_affine());
  // The whole skeleton turns about its upward axis and moves upward.
  const Affine motion = affine_about(Vec3::Zero(), turn(Vec3(0, 0, 1), 30.0), Vec3(0, 0, 3));
  const Affine expected = affine_about(Vec3::Zero(), turn(Vec3(0, 1, 0), 30.0), Vec3(0, 3, 0));
  expect_pose(Retarget(handles, joints)
                .apply(Pose(heads.size()), std::vector<Affine>(heads.size(), motion), first),
    std::vector<Affine>(heads.size(), expected));
}

TEST(Retarget, BonesPointWhereTheJointsPoint)
{
  // The joints rest in a straight line, the handles in a bent one, and all bones have other
  // lengths.
  const Handles joints = chain(Vec3::Zero(), { Vec3(0, 1, 0), Vec3(0, 1, 0), Vec3(0, 1, 0) });
  const Handles handles = chain(Vec3(3, 0, 0), { Vec3(0, 2, 0), Vec3(3, 0, 0), Vec3(3, 0, 0) });
  const std::vector<Affine> frame = posed_chain(joints, rotations, Vec3::Zero());
  const Pose pose = Retarget(handles, to_joints(joints)).apply(Pose(3), frame, frame);
  Vec3 end = handles[0].head;
  for (std::size_t h = 0; h < 3; ++h)
  {
    const Vec3 head = moved(pose[h].transform, handles[h].head);
    EXPECT_LT((head - end).norm(), 1e-12) << "attached to the parent";
    end = moved(pose[h].transform, handles[h].tail);
    // The last bone has no child; its rest direction counts as turned like that of its parent.
    const Vec3 wanted = rotations[h] * Vec3(0, 1, 0);
    EXPECT_LT(((end - head).normalized() - wanted).norm(), 1e-12) << h;
    EXPECT_NEAR((end - head).norm(), (handles[h].tail - handles[h].head).norm(), 1e-12);
  }
}

TEST(Retarget, BranchesKeepTheirSides)
{
  // Hips with a spine and two legs. The mean of the children is above the hips of the handles and
  // below the hips of the joints.
  const auto skeleton = [](double spine)
  {
    return Handles{ test::bone_handle("hips", Vec3(0, 1, 0), Vec3(0, 1.1, 0)),
      test::bone_handle("spine", Vec3(0, 1 + spine, 0), Vec3(0, 3, 0), 0),
      test::bone_handle("left", Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0), 0),
      test::bone_handle("right", Vec3(-0.5, 0.5, 0), Vec3(-0.5, 0, 0), 0) };
  };
  const Handles handles = skeleton(1.2), joints = skeleton(0.9);
  const std::vector<Affine> rest(4, identity_affine());
  const Pose pose = Retarget(handles, to_joints(joints)).apply(Pose(4), rest, rest);
  const Vec3 hips = moved(pose[0].transform, handles[0].head);
  EXPECT_GT(moved(pose[1].transform, handles[1].head)[1], hips[1] + 1.0);
  EXPECT_GT(moved(pose[2].transform, handles[2].head)[0], 0.4);
  EXPECT_LT(moved(pose[3].transform, handles[3].head)[0], -0.4);
}

TEST(Retarget, AJointThatMovesBelowItsParentMovesItsHandle)
{
  // A static root with moving hips, in a skeleton of twice the size.
  const Handles handles = { test::bone_handle("root", Vec3::Zero(), Vec3(0, 1, 0)),
    test::bone_handle("hips", Vec3(0, 1, 0), Vec3(0, 2, 0), 0) };
  const std::vector<MotionJoint> joints = { { "root", -1, Vec3::Zero() },
    { "hips", 0, Vec3(0, 2, 0) } };
  const std::vector<Affine> first(2, identity_affine());
  std::vector<Affine> frame = first;
  frame[1].col(3) = Vec3(1, 0, 0);
  const Pose pose = Retarget(handles, joints).apply(Pose(2), frame, first);
  EXPECT_LT((pose[0].transform - identity_affine()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((moved(pose[1].transform, handles[1].head) - Vec3(0.5, 1, 0)).norm(), 1e-12);
}

TEST(Retarget, MatchesNames)
{
  Handles handles = chain(Vec3::Zero(), { Vec3(0, 1, 0), Vec3(0, 1, 0), Vec3(0, 1, 0) });
  handles[0].name = "Hips";
  handles[1].name = "left_arm";
  handles[2].name = "tail";
  std::vector<MotionJoint> joints = to_joints(handles);
  joints[0].name = "hips"; // exact names come first
  joints[1].name = "mixamorig:LeftArm";
  joints[2].name = "Hips";
  const Retarget retarget(handles, joints);
  EXPECT_THAT(retarget.joint_of_handle(), testing::ElementsAre(2, 1, -1));
  EXPECT_THAT(retarget.handles_without_joint(), testing::ElementsAre(2));
  // Two joints with the same plain name match nothing.
  joints[2].name = "Left Arm";
  EXPECT_THAT(joints_of_handles(handles, joints), testing::ElementsAre(0, -1, -1));
}

TEST(Retarget, HandlesWithoutAJointFollowTheirParents)
{
  const Handles joints = chain(Vec3::Zero(), { Vec3(0, 1, 0), Vec3(0, 1, 0) });
  Handles handles = joints;
  handles[1].name = "unknown";
  const std::vector<Affine> frame = posed_chain(joints, rotations, Vec3(1, 0, 0));
  const Pose pose = Retarget(handles, to_joints(joints)).apply(Pose(2), frame, frame);
  EXPECT_LT((pose[1].transform - pose[0].transform).cwiseAbs().maxCoeff(), 1e-12);
}
