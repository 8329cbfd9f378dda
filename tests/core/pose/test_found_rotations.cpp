#include "pose/found_rotations.h"

#include "pose/handle_hierarchy.h"

#include <gtest/gtest.h>

using namespace bindpose;

namespace
{
/// A chain of two bones and a region.
Handles arm()
{
  Handles handles(3);
  handles[0].kind = handles[1].kind = HandleKind::bone;
  handles[0].name = "upper";
  handles[0].tail = Vec3(1.0, 0.0, 0.0);
  handles[1].name = "fore";
  handles[1].head = Vec3(1.0, 0.0, 0.0);
  handles[1].tail = Vec3(2.0, 0.0, 0.0);
  handles[1].parent = 0;
  handles[2].name = "r";
  handles[2].kind = HandleKind::region;
  handles[2].region_id = 1;
  return handles;
}

Affine turned(double angle)
{
  Affine transform = identity_affine();
  transform.leftCols<3>() = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  return transform;
}

std::vector<HandleMode> modes(const Pose& pose)
{
  return modes_of(with_found_rotations(arm(), pose));
}
} // namespace

TEST(FoundRotations, HandlesAtRestAndTranslatedOnesHoldTheirPositions)
{
  Pose pose(3);
  pose[1].transform.col(3) = Vec3(0.0, 1.0, 0.0);
  EXPECT_EQ(modes(pose),
    (std::vector<HandleMode>{ HandleMode::position, HandleMode::position, HandleMode::full }))
    << "a region holds its vertices";
}

TEST(FoundRotations, RotatedScaledStretchedAndTwistedHandlesHoldEverything)
{
  Pose pose(3);
  pose[0].transform = turned(0.1);
  EXPECT_EQ(modes(pose)[0], HandleMode::full);
  pose[0] = HandlePose();
  pose[0].transform.leftCols<3>() *= 1.1;
  EXPECT_EQ(modes(pose)[0], HandleMode::full);
  pose[0] = HandlePose();
  pose[0].stretch = 1.1;
  EXPECT_EQ(modes(pose)[0], HandleMode::full);
  pose[0] = HandlePose();
  pose[0].twist[1] = 5.0;
  EXPECT_EQ(modes(pose)[0], HandleMode::full);
}

TEST(FoundRotations, AChildThatOnlyFollowsItsParentFindsItsRotation)
{
  Pose pose(3);
  pose[0].transform = turned(0.7);
  follow_parent(arm(), Pose(3), 1, pose);
  EXPECT_EQ(modes(pose)[0], HandleMode::full);
  EXPECT_EQ(modes(pose)[1], HandleMode::position);
  pose[1].transform = identity_affine(); // stays in the world
  EXPECT_EQ(modes(pose)[1], HandleMode::position);
  pose[1].transform = turned(0.3);
  EXPECT_EQ(modes(pose)[1], HandleMode::full);
}

TEST(FoundRotations, ChosenModesStay)
{
  Pose pose(3);
  pose[0].mode = HandleMode::full;
  pose[1].mode = HandleMode::ends;
  pose[2].mode = HandleMode::free;
  EXPECT_EQ(modes(pose), modes_of(pose));
}
