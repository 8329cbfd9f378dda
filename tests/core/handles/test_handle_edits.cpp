// Edits of handle lists: new handles, unchanged handles, and errors.
#include "handles/handle_edits.h"
#include "support/handles.h"
#include "support/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using test::bone_handle;
using test::cage_vertex_handle;
using test::point_handle;
using testing::ElementsAre;
using testing::HasSubstr;

namespace
{
// Return the chain of bones upper - lower - hand, a point that is a child of the hand, and another
// point.
Handles three_bone_arm()
{
  Handles handles = { bone_handle("upper.L", Vec3(1, 0, 0), Vec3(2, 0, 0)),
    bone_handle("lower.L", Vec3(2, 0, 0), Vec3(3, 0, 0), 0),
    bone_handle("hand.L", Vec3(3, 0, 0), Vec3(3.5, 0.5, 0), 1), point_handle("nail", Vec3(4, 1, 0)),
    point_handle("nose", Vec3(0, 1, 0)) };
  handles[3].parent = 2;
  return handles;
}

// Return an open cage with the edges a - b - c and a face a b c.
Handles cage()
{
  Handles handles = { cage_vertex_handle("a.L", Vec3(1, 0, 0)),
    cage_vertex_handle("b.L", Vec3(2, 0, 0)), cage_vertex_handle("c", Vec3(0, 1, 0)) };
  handles[0].cage = { { 0, 1, -1 }, { 0, 1, 2 } };
  handles[1].cage = { { 1, 2, -1 } };
  return handles;
}

std::vector<std::string> names(const EditedHandles& edited)
{
  std::vector<std::string> list;
  for (const Handle& handle : edited.handles)
  {
    list.push_back(handle.name);
  }
  return list;
}
} // namespace

TEST(HandleEdits, AddedHandlesHaveFreeNames)
{
  EditedHandles after;
  ASSERT_TRUE(add_handle({}, point_handle("", Vec3(0, 0, 0)), after).ok());
  EXPECT_THAT(names(after), ElementsAre("p1"));
  EXPECT_THAT(after.source, ElementsAre(-1));
  EditedHandles two;
  ASSERT_TRUE(add_handle(after.handles, point_handle("", Vec3(1, 0, 0)), two).ok());
  ASSERT_TRUE(add_handle(two.handles, bone_handle("", Vec3(0, 0, 0), Vec3(1, 0, 0)), after).ok());
  ASSERT_TRUE(add_handle(after.handles, point_handle("p1", Vec3(2, 0, 0)), two).ok());
  EXPECT_THAT(names(two), ElementsAre("p1", "p2", "b1", "p1.001"));
  EXPECT_THAT(two.source, ElementsAre(0, 1, 2, -1));
  const Status status = add_handle(two.handles, point_handle("q", Vec3(2, 0, 0)), after);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_THAT(status.message, HasSubstr("'q'"));
  EXPECT_EQ(after.handles.size(), 4u) << "as before";
  EXPECT_FALSE(add_handle({}, bone_handle("", Vec3(1, 1, 1), Vec3(1, 1, 1)), after).ok());
  EXPECT_TRUE(after.handles.empty());
}

TEST(HandleEdits, RemovingHangsChildrenOnWhatIsLeftAbove)
{
  EditedHandles after;
  ASSERT_TRUE(remove_handles(three_bone_arm(), { 1, 2 }, after).ok());
  EXPECT_THAT(names(after), ElementsAre("upper.L", "nail", "nose"));
  EXPECT_THAT(after.source, ElementsAre(0, 3, 4));
  EXPECT_EQ(after.handles[1].parent, 0) << "hand and lower arm went";
  EXPECT_EQ(after.handles[2].parent, -1);
  ASSERT_TRUE(remove_handles(three_bone_arm(), { 0, 1, 2, 3, 4 }, after).ok());
  EXPECT_TRUE(after.handles.empty());
  EXPECT_FALSE(remove_handles(three_bone_arm(), { 5 }, after).ok());
  EXPECT_EQ(after.handles.size(), 5u);
}

TEST(HandleEdits, RemovedCageVerticesTakeTheirEdgesAlong)
{
  EditedHandles after;
  ASSERT_TRUE(remove_handles(cage(), { 0 }, after).ok());
  EXPECT_THAT(names(after), ElementsAre("b.L", "c"));
  EXPECT_THAT(after.handles[0].cage, ElementsAre(CageElement{ 0, 1, -1 }));
  EXPECT_TRUE(after.handles[1].cage.empty());
  ASSERT_TRUE(remove_handles(cage(), { 1 }, after).ok());
  EXPECT_TRUE(after.handles[0].cage.empty());
}

TEST(HandleEdits, RenamingKeepsNamesUniqueAndThere)
{
  EditedHandles after;
  ASSERT_TRUE(rename_handle(three_bone_arm(), 4, "tip", after).ok());
  EXPECT_EQ(after.handles[4].name, "tip");
  ASSERT_TRUE(rename_handle(three_bone_arm(), 4, "nose", after).ok()) << "its own";
  EXPECT_THAT(rename_handle(three_bone_arm(), 4, "nail", after).message, HasSubstr("'nail'"));
  EXPECT_THAT(rename_handle(three_bone_arm(), 4, "", after).message, HasSubstr("'nose'"));
  EXPECT_FALSE(rename_handle(three_bone_arm(), -1, "x", after).ok());
  EXPECT_EQ(after.handles[4].name, "nose");
}

TEST(HandleEdits, ParentsMakeNoCircles)
{
  EditedHandles after;
  ASSERT_TRUE(set_parent(three_bone_arm(), 4, 0, after).ok());
  EXPECT_EQ(after.handles[4].parent, 0);
  EXPECT_FALSE(set_parent(three_bone_arm(), 0, 3, after).ok());
  EXPECT_FALSE(set_parent(three_bone_arm(), 0, 0, after).ok());
  EXPECT_FALSE(set_parent(three_bone_arm(), 0, 17, after).ok());
  EXPECT_EQ(after.handles[0].parent, -1);
}

TEST(HandleEdits, CageEdgesComeAndGo)
{
  EditedHandles after;
  ASSERT_TRUE(toggle_cage_edge(cage(), 2, 0, after).ok());
  EXPECT_THAT(after.handles[2].cage, ElementsAre(CageElement{ 2, 0, -1 }));
  ASSERT_TRUE(toggle_cage_edge(cage(), 1, 0, after).ok()) << "either way round";
  EXPECT_THAT(after.handles[0].cage, ElementsAre(CageElement{ 0, 1, 2 })) << "the face stays";
  EXPECT_FALSE(toggle_cage_edge(cage(), 1, 1, after).ok());
  EXPECT_FALSE(toggle_cage_edge(three_bone_arm(), 0, 1, after).ok());
}

TEST(HandleEdits, JointsMoveTogether)
{
  EXPECT_EQ(ends_at_joint(three_bone_arm(), { 1, false }).size(), 2u);
  EXPECT_EQ(ends_at_joint(three_bone_arm(), { 2, true }).size(), 1u);
  EXPECT_EQ(ends_at_joint(three_bone_arm(), { 3, false }).size(), 1u);
  EditedHandles after;
  ASSERT_TRUE(move_ends(three_bone_arm(), { { 0, true } }, { Vec3(2, 0.5, 0) }, after).ok());
  EXPECT_EQ(after.handles[0].tail, Vec3(2, 0.5, 0));
  EXPECT_EQ(after.handles[1].head, Vec3(2, 0.5, 0));
  EXPECT_EQ(after.handles[1].tail, Vec3(3, 0, 0));
  ASSERT_TRUE(move_ends(three_bone_arm(), { { 3, false } }, { Vec3(9, 9, 9) }, after).ok());
  EXPECT_EQ(after.handles[3].tail, Vec3(9, 9, 9));
  EXPECT_FALSE(move_ends(three_bone_arm(), { { 0, true } }, { Vec3(1, 0, 0) }, after).ok())
    << "a bone without length";
  EXPECT_EQ(after.handles[0].tail, Vec3(2, 0, 0));
}

TEST(HandleEdits, MirroredNamesAreThoseOfTheOtherSide)
{
  const std::pair<const char*, const char*> pairs[] = { { "arm.L", "arm.R" }, { "arm_l", "arm_r" },
    { "arm-R", "arm-L" }, { "arm r", "arm l" }, { "L.arm", "R.arm" }, { "l_arm", "r_arm" },
    { "arm.L.001", "arm.R.001" }, { "HandLeft", "HandRight" }, { "left_hand", "right_hand" },
    { "LEFTHAND", "RIGHTHAND" }, { "hand.right", "hand.left" }, { "nose", "nose" }, { "L", "L" },
    { "tail", "tail" }, { "b1", "b1" }, { "p.001", "p.001" }, { "", "" } };
  for (const auto& [name, other] : pairs)
  {
    EXPECT_EQ(mirrored_name(name), other);
    EXPECT_EQ(mirrored_name(other), name) << "twice is once";
  }
}

TEST(HandleEdits, MirroringCopiesBonesWithNamesAndParents)
{
  EditedHandles after;
  ASSERT_TRUE(mirror_handles(three_bone_arm(), {}, Vec3::Zero(), Vec3(-2, 0, 0), after).ok());
  EXPECT_THAT(names(after),
    ElementsAre(
      "upper.L", "lower.L", "hand.L", "nail", "nose", "upper.R", "lower.R", "hand.R", "nail.001"))
    << "the nose lies in the plane";
  EXPECT_THAT(after.source, ElementsAre(0, 1, 2, 3, 4, -1, -1, -1, -1));
  EXPECT_THAT(after.copied_from, ElementsAre(0, 1, 2, 3, 4, 0, 1, 2, 3));
  EXPECT_EQ(after.handles[7].head, Vec3(-3, 0, 0));
  EXPECT_EQ(after.handles[7].tail, Vec3(-3.5, 0.5, 0));
  EXPECT_EQ(after.handles[5].parent, -1);
  EXPECT_EQ(after.handles[6].parent, 5);
  EXPECT_EQ(after.handles[7].parent, 6);
  EXPECT_EQ(after.handles[8].parent, 7);
  // A second call adds nothing, because all handles have a mirror image.
  EditedHandles again;
  ASSERT_TRUE(mirror_handles(after.handles, {}, Vec3::Zero(), Vec3(1, 0, 0), again).ok());
  EXPECT_EQ(again.handles.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i)
  {
    EXPECT_EQ(again.handles[i].head, after.handles[i].head);
  }
  // If a handle was moved, its existing mirror image is moved to the mirrored position.
  Handles moved = after.handles;
  moved[0].head = Vec3(1, 0, 0.25);
  ASSERT_TRUE(mirror_handles(moved, { 0 }, Vec3::Zero(), Vec3(1, 0, 0), again).ok());
  EXPECT_EQ(again.handles.size(), 9u);
  EXPECT_EQ(again.handles[5].head, Vec3(-1, 0, 0.25));
  EXPECT_FALSE(mirror_handles(three_bone_arm(), {}, Vec3::Zero(), Vec3::Zero(), after).ok());
}

TEST(HandleEdits, MirroringACageCopiesItsElements)
{
  EditedHandles after;
  ASSERT_TRUE(mirror_handles(cage(), {}, Vec3::Zero(), Vec3(1, 0, 0), after).ok());
  EXPECT_THAT(names(after), ElementsAre("a.L", "b.L", "c", "a.R", "b.R"));
  EXPECT_THAT(after.handles[3].cage, ElementsAre(CageElement{ 3, 4, -1 }, CageElement{ 3, 2, 4 }))
    << "the face turned";
  EXPECT_THAT(after.handles[4].cage, ElementsAre(CageElement{ 4, 2, -1 }));
  EXPECT_EQ(after.handles[0].cage.size(), 2u);
}

TEST(HandleEdits, SnappingPutsEndsOnTheSurface)
{
  const TriangleMesh ball = test::sphere(4, 2.5);
  const SurfaceProbe probe(ball.points, ball.triangles);
  EditedHandles after;
  ASSERT_TRUE(snap_to_surface(three_bone_arm(), { 0, 1, 4 }, probe, after).ok());
  for (const Index h : { 0, 1, 4 })
  {
    EXPECT_NEAR(after.handles[static_cast<std::size_t>(h)].head.norm(), 2.5, 0.01);
  }
  EXPECT_EQ(after.handles[1].head, after.handles[0].tail) << "the joint holds";
  EXPECT_EQ(after.handles[2].head, after.handles[1].tail) << "also to who was not asked";
  EXPECT_EQ(after.handles[3].head, three_bone_arm()[3].head);
  const TriangleMesh none{ Points(0, 3), Triangles(0, 3) };
  EXPECT_FALSE(
    snap_to_surface(three_bone_arm(), {}, SurfaceProbe(none.points, none.triangles), after).ok());
}
