// Handle modes for deformation methods that compute rotations themselves. A handle that is only
// translated gets the mode `position`.
#include "pose/found_rotations.h"

#include "pose/handle_hierarchy.h"

#include <gtest/gtest.h>

using namespace bindpose;

namespace
{
/// Return an upper arm and a forearm (bones), a region, and a point whose parent is the forearm.
Handles two_bone_arm()
{
  Handles handles(4);
  handles[3].name = "p";
  handles[3].head = handles[3].tail = Vec3(1.5, 0.2, 0.0);
  handles[3].parent = 1;
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

Affine turned_about_z(double angle)
{
  Affine transform = identity_affine();
  transform.leftCols<3>() = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  return transform;
}

std::vector<HandleMode> modes(const Pose& pose)
{
  return modes_of(resolve_automatic_modes(two_bone_arm(), pose));
}
} // namespace

TEST(FoundRotations, PointsAndTranslatedBonesHoldTheirPositions)
{
  Pose pose(4);
  EXPECT_EQ(modes(pose),
    (std::vector<HandleMode>{
      HandleMode::full, HandleMode::full, HandleMode::full, HandleMode::position }))
    << "bones at rest and a region hold everything";
  pose[1].transform.col(3) = Vec3(0.0, 1.0, 0.0);
  pose[3].transform.col(3) = Vec3(0.0, 0.0, 1.0);
  EXPECT_EQ(modes(pose)[1], HandleMode::position);
  EXPECT_EQ(modes(pose)[3], HandleMode::position);
}

TEST(FoundRotations, RotatedScaledStretchedAndTwistedHandlesHoldEverything)
{
  for (const std::size_t h : { 0, 3 })
  {
    Pose pose(4);
    pose[h].transform = turned_about_z(0.1);
    EXPECT_EQ(modes(pose)[h], HandleMode::full);
    pose[h].transform = identity_affine();
    pose[h].transform.leftCols<3>() *= 1.1;
    EXPECT_EQ(modes(pose)[h], HandleMode::full);
  }
  Pose pose(4);
  pose[0].transform.col(3) = Vec3(0.0, 1.0, 0.0);
  pose[0].stretch = 1.1;
  EXPECT_EQ(modes(pose)[0], HandleMode::full);
  pose[0].stretch = 1.0;
  pose[0].twist[1] = 5.0;
  EXPECT_EQ(modes(pose)[0], HandleMode::full);
}

TEST(FoundRotations, ChildrenAreTakenRelativeToTheirParents)
{
  Pose pose(4);
  pose[0].transform = turned_about_z(0.7);
  follow_parent(two_bone_arm(), Pose(4), 1, pose);
  follow_parent(two_bone_arm(), Pose(4), 3, pose);
  EXPECT_EQ(modes(pose)[0], HandleMode::full);
  EXPECT_EQ(modes(pose)[1], HandleMode::full) << "the parent carries the bone";
  EXPECT_EQ(modes(pose)[3], HandleMode::position);
  Affine further = identity_affine();
  further.col(3) = Vec3(0.3, 0.0, 0.0);
  pose[1].transform = compose(pose[0].transform, further);
  EXPECT_EQ(modes(pose)[1], HandleMode::position) << "translated relative to its parent";
  pose[1].transform = identity_affine();
  EXPECT_EQ(modes(pose)[1], HandleMode::full) << "the bone stays in the world";
  pose[1].transform = further;
  EXPECT_EQ(modes(pose)[1], HandleMode::position) << "translated in the world";
  pose[1].transform = turned_about_z(0.3);
  EXPECT_EQ(modes(pose)[1], HandleMode::full);
}

TEST(FoundRotations, ChosenModesStay)
{
  Pose pose(4);
  pose[0].mode = HandleMode::full;
  pose[1].mode = HandleMode::ends;
  pose[2].mode = HandleMode::free;
  pose[3].mode = HandleMode::position;
  EXPECT_EQ(modes(pose), modes_of(pose));
}
