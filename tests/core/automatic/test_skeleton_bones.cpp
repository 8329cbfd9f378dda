// Conversion of curve skeletons to bones. The curves have known shapes, so the expected bones are
// known.
#include "automatic/skeleton_bones.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
/// A curve skeleton that a test builds step by step. It contains the radius of the shape at each
/// point, and the centroid of each component.
struct Drawing
{
  std::vector<Vec3> points;
  std::vector<std::array<Index, 2>> segments;
  std::vector<double> radii;
  std::vector<Index> parts;
  std::vector<Vec3> centroids;

  Index point(const Vec3& p, double radius = 0.05)
  {
    this->points.push_back(p);
    this->radii.push_back(radius);
    this->parts.push_back(static_cast<Index>(this->centroids.size()) - 1);
    return static_cast<Index>(this->points.size()) - 1;
  }
  /// Draw a line of `pieces` segments from the point with index `from` to p. @return The index of
  /// the last point.
  Index line(Index from, const Vec3& p, int pieces = 10)
  {
    const Vec3 head = this->points[from];
    const double radius = this->radii[from];
    for (int i = 1; i <= pieces; ++i)
    {
      const Index to = this->point(head + (p - head) * i / pieces, radius);
      this->segments.push_back({ i == 1 ? from : to - 1, to });
    }
    return static_cast<Index>(this->points.size()) - 1;
  }
  CurveSkeleton skeleton() const
  {
    CurveSkeleton result;
    result.points.resize(static_cast<Index>(this->points.size()), 3);
    result.radii.resize(result.points.rows());
    for (Index v = 0; v < result.points.rows(); ++v)
    {
      result.points.row(v) = this->points[v].transpose();
      result.radii[v] = this->radii[v];
    }
    result.segments.resize(static_cast<Index>(this->segments.size()), 2);
    for (Index s = 0; s < result.segments.rows(); ++s)
    {
      result.segments.row(s) << this->segments[s][0], this->segments[s][1];
    }
    result.part_of_point = this->parts;
    result.centroids = this->centroids;
    return result;
  }
};

SkeletonBones run_skeleton_bones(const Drawing& drawing, const SkeletonBonesOptions& options = {})
{
  SkeletonBones bones;
  const Status status = skeleton_bones(drawing.skeleton(), 1.0, options, bones);
  EXPECT_TRUE(status.ok()) << status.message;
  EXPECT_TRUE(check_handles(bones.handles).ok()) << check_handles(bones.handles).message;
  return bones;
}

/// Expect that the bones form a tree: exactly one handle has no parent, a parent precedes its
/// children, and each bone begins at the tail of its parent or at a root joint.
void expect_tree(const SkeletonBones& bones)
{
  EXPECT_TRUE(check_handles(bones.handles).ok());
  EXPECT_EQ(std::count_if(bones.handles.begin(), bones.handles.end(),
              [](const Handle& handle) { return handle.parent < 0; }),
    1);
  for (std::size_t i = 0; i < bones.handles.size(); ++i)
  {
    const Handle& bone = bones.handles[i];
    if (bone.kind != HandleKind::bone)
    {
      continue;
    }
    EXPECT_LT(bone.parent, static_cast<Index>(i));
    if (bone.parent >= 0 && bones.handles[bone.parent].tail == bone.head)
    {
      continue;
    }
    bool at_root = false;
    for (const Index root : bones.roots)
    {
      at_root = at_root || bone.head == Vec3(bones.joints.row(root));
    }
    EXPECT_TRUE(at_root) << bone.name;
  }
}

double distance_to(const Vec3& p, const Handle& bone)
{
  const Vec3 d = bone.tail - bone.head;
  const double t = std::min(std::max((p - bone.head).dot(d) / d.squaredNorm(), 0.0), 1.0);
  return (p - bone.head - t * d).norm();
}

double distance_to(const Vec3& p, const Handles& bones)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Handle& bone : bones)
  {
    least = std::min(least, distance_to(p, bone));
  }
  return least;
}

Drawing half_circle()
{
  Drawing drawing;
  drawing.centroids = { Vec3(0.0, 1.0, 0.0) };
  Index last = -1;
  for (int i = 0; i <= 200; ++i)
  {
    const double a = M_PI * i / 200;
    const Index next = drawing.point(Vec3(std::cos(a), std::sin(a), 0.0));
    if (last >= 0)
    {
      drawing.segments.push_back({ last, next });
    }
    last = next;
  }
  return drawing;
}

/// Return arms that begin at the origin and end at the given points.
Drawing arms(const std::vector<Vec3>& ends, double radius = 0.05)
{
  Drawing drawing;
  drawing.centroids = { Vec3::Zero() };
  const Index center = drawing.point(Vec3::Zero(), radius);
  for (const Vec3& end : ends)
  {
    drawing.line(center, end);
  }
  return drawing;
}
} // namespace

TEST(SkeletonBones, AStraightCurveIsOneBone)
{
  Drawing drawing;
  drawing.centroids = { Vec3(0.2, 0.0, 0.0) };
  drawing.line(drawing.point(Vec3::Zero()), Vec3(1.0, 0.0, 0.0), 40);
  const SkeletonBones bones = run_skeleton_bones(drawing);
  ASSERT_EQ(bones.handles.size(), 1u);
  EXPECT_EQ(bones.handles[0].name, "b1");
  // The head of the bone is the end that is nearer to the centroid of the shape.
  EXPECT_EQ(bones.handles[0].head, Vec3(0.0, 0.0, 0.0));
  EXPECT_EQ(bones.handles[0].tail, Vec3(1.0, 0.0, 0.0));
  EXPECT_EQ(bones.handles[0].parent, -1);
  EXPECT_EQ(bones.junctions, 0);
}

TEST(SkeletonBones, LongBonesAreHalved)
{
  Drawing drawing;
  drawing.centroids = { Vec3(0.0, 0.0, 0.0) };
  drawing.line(drawing.point(Vec3::Zero()), Vec3(1.0, 0.0, 0.0), 40);
  SkeletonBonesOptions options;
  options.longest_bone = 0.3;
  const SkeletonBones bones = run_skeleton_bones(drawing, options);
  ASSERT_EQ(bones.handles.size(), 4u);
  for (Index i = 0; i < 4; ++i)
  {
    EXPECT_NEAR((bones.handles[i].tail - bones.handles[i].head).norm(), 0.25, 1e-12);
    EXPECT_EQ(bones.handles[i].parent, i - 1);
  }
  expect_tree(bones);
}

TEST(SkeletonBones, AnElbowIsAJoint)
{
  Drawing drawing;
  drawing.centroids = { Vec3(0.5, 0.0, 0.0) };
  drawing.line(drawing.line(drawing.point(Vec3::Zero()), Vec3(0.5, 0.0, 0.0)), Vec3(0.5, 0.5, 0.0));
  const SkeletonBones bones = run_skeleton_bones(drawing);
  ASSERT_EQ(bones.handles.size(), 2u);
  // Both bones begin at the elbow, which is the root.
  EXPECT_EQ(bones.handles[0].head, Vec3(0.5, 0.0, 0.0));
  EXPECT_EQ(bones.handles[1].head, Vec3(0.5, 0.0, 0.0));
  EXPECT_EQ(bones.handles[0].parent, -1);
  EXPECT_EQ(bones.handles[1].parent, 0);
}

TEST(SkeletonBones, AreWithinTheToleranceOfTheCurve)
{
  const Drawing drawing = half_circle();
  std::size_t fewer = 0;
  for (const double tolerance : { 0.2, 0.05, 0.01 })
  {
    SkeletonBonesOptions options;
    options.tolerance = tolerance;
    const SkeletonBones bones = run_skeleton_bones(drawing, options);
    expect_tree(bones);
    EXPECT_GT(bones.handles.size(), fewer);
    fewer = bones.handles.size();
    for (const Vec3& p : drawing.points)
    {
      EXPECT_LE(distance_to(p, bones.handles), tolerance * (1.0 + 1e-12));
    }
  }
  // A chord of a unit circle with sagitta s subtends the angle 2 acos(1 - s).
  EXPECT_GE(static_cast<double>(fewer), M_PI / (2.0 * std::acos(1.0 - 0.01)));
}

TEST(SkeletonBones, StayWithinTheShape)
{
  // The curve has a corner at the height 0.1, which is less than the tolerance 0.2. Without a
  // shape, one straight bone is therefore enough. The shape is a narrow band around the curve. One
  // straight bone would leave this band, so two bones are needed.
  Drawing drawing;
  drawing.centroids = { Vec3::Zero() };
  drawing.line(drawing.line(drawing.point(Vec3::Zero()), Vec3(1.0, 0.1, 0.0)), Vec3(2.0, 0.0, 0.0));
  SkeletonBonesOptions options;
  options.tolerance = 0.2;
  EXPECT_EQ(run_skeleton_bones(drawing, options).handles.size(), 1u);
  options.inside = [](const Vec3& p)
  { return std::abs(p.y() - 0.1 * (1.0 - std::abs(p.x() - 1.0))) < 0.05; };
  const SkeletonBones bones = run_skeleton_bones(drawing, options);
  ASSERT_EQ(bones.handles.size(), 2u);
  EXPECT_EQ(bones.handles[0].tail, Vec3(1.0, 0.1, 0.0));
  options.maximum_bones = 1;
  EXPECT_EQ(run_skeleton_bones(drawing, options).handles.size(), 1u);
}

TEST(SkeletonBones, PutJointsWhereTheCurveIsInside)
{
  // The curve is a hook whose corner and tip are outside of the shape.
  Drawing drawing;
  drawing.centroids = { Vec3::Zero() };
  drawing.line(
    drawing.line(drawing.point(Vec3::Zero()), Vec3(1.0, 0.0, 0.0), 20), Vec3(1.0, 1.0, 0.0), 20);
  SkeletonBonesOptions options;
  options.inside = [](const Vec3& p)
  { return (p - Vec3(1.0, 0.0, 0.0)).norm() > 0.08 && p.y() < 0.92; };
  const SkeletonBones bones = run_skeleton_bones(drawing, options);
  expect_tree(bones);
  for (Index j = 0; j < bones.joints.rows(); ++j)
  {
    EXPECT_TRUE(options.inside(bones.joints.row(j))) << bones.joints.row(j);
  }
  EXPECT_NEAR(bones.joints.col(1).maxCoeff(), 0.9, 1e-12);
}

TEST(SkeletonBones, AreAtMostAsManyAsAskedFor)
{
  SkeletonBonesOptions options;
  options.tolerance = 0.001;
  for (const Index most : { 1, 2, 3, 7 })
  {
    options.maximum_bones = most;
    EXPECT_EQ(
      run_skeleton_bones(half_circle(), options).handles.size(), static_cast<std::size_t>(most));
  }
  // If there are too many bones, the shortest limbs are removed first.
  const Drawing drawing =
    arms({ { 1, 0, 0 }, { 0, 0.9, 0 }, { -0.8, 0, 0 }, { 0, -0.3, 0 }, { 0, 0, 0.2 } });
  options.maximum_bones = 3;
  const SkeletonBones bones = run_skeleton_bones(drawing, options);
  ASSERT_EQ(bones.handles.size(), 3u);
  EXPECT_EQ(bones.pruned_branches, 2);
  for (const Handle& bone : bones.handles)
  {
    EXPECT_GE(bone.tail.norm(), 0.8);
    EXPECT_EQ(bone.head, Vec3::Zero());
  }
}

TEST(SkeletonBones, ACrossHasOneJunction)
{
  const SkeletonBones bones =
    run_skeleton_bones(arms({ { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 } }));
  EXPECT_EQ(bones.handles.size(), 4u);
  EXPECT_EQ(bones.junctions, 1);
  EXPECT_EQ(bones.joints.rows(), 5);
  ASSERT_EQ(bones.roots.size(), 1u);
  EXPECT_EQ(Vec3(bones.joints.row(bones.roots[0])), Vec3::Zero());
  expect_tree(bones);
}

TEST(SkeletonBones, TheBoneWithTheLargestVolumeIsTheRoot)
{
  // The shape has a thick vertical trunk and two thin limbs. One limb bends, so it has two bones.
  Drawing drawing;
  drawing.centroids = { Vec3::Zero() };
  const Index center = drawing.point(Vec3::Zero(), 0.1);
  drawing.line(center, Vec3(2.0, 0.0, 0.0));
  const Index trunk = drawing.point(Vec3(0.0, 0.0, 0.2), 0.4);
  drawing.segments.push_back({ center, trunk });
  drawing.line(trunk, Vec3(0.0, 0.0, 1.5));
  drawing.line(drawing.line(center, Vec3(-2.0, 0.0, 0.0)), Vec3(-2.0, 1.5, 0.0));
  const SkeletonBones bones = run_skeleton_bones(drawing);
  ASSERT_EQ(bones.handles.size(), 4u);
  EXPECT_EQ(bones.handles[0].tail, Vec3(0.0, 0.0, 1.5));
  EXPECT_EQ(bones.handles[0].parent, -1);
  expect_tree(bones);
  for (const Handle& bone : bones.handles)
  {
    EXPECT_EQ(bone.parent,
      bone.tail == Vec3(0.0, 0.0, 1.5) ? -1
        : bone.head.isZero()           ? 0
                                       : 2)
      << bone.name;
  }
}

TEST(SkeletonBones, JunctionsWithinTheThicknessAreOne)
{
  Drawing drawing;
  drawing.centroids = { Vec3::Zero() };
  const Index left = drawing.point(Vec3(-0.02, 0.0, 0.0), 0.1);
  const Index right = drawing.line(left, Vec3(0.02, 0.0, 0.0), 4);
  drawing.line(left, Vec3(-1.0, 0.0, 0.0));
  drawing.line(left, Vec3(0.0, 1.0, 0.0));
  drawing.line(right, Vec3(1.0, 0.0, 0.0));
  drawing.line(right, Vec3(0.0, -1.0, 0.0));
  const SkeletonBones bones = run_skeleton_bones(drawing);
  EXPECT_EQ(bones.merged_branches, 1);
  EXPECT_EQ(bones.junctions, 1);
  ASSERT_EQ(bones.handles.size(), 4u);
  for (const Handle& bone : bones.handles)
  {
    EXPECT_LT(bone.head.norm(), 1e-15);
  }
  SkeletonBonesOptions options;
  // The branch points are not merged, because their distance 0.04 exceeds 0.3 times the radius 0.1.
  options.prune = 0.3;
  EXPECT_EQ(run_skeleton_bones(drawing, options).junctions, 2);
}

TEST(SkeletonBones, BranchesWithinTheThicknessArePruned)
{
  const Drawing drawing = arms({ { 1, 0, 0 }, { -1, 0, 0 }, { 0, 0.19, 0 }, { 0, 0, 0.21 } }, 0.2);
  const SkeletonBones bones = run_skeleton_bones(drawing);
  EXPECT_EQ(bones.pruned_branches, 1);
  ASSERT_EQ(bones.handles.size(), 3u);
  for (const Handle& bone : bones.handles)
  {
    EXPECT_EQ(bone.tail.y(), 0.0);
  }
  SkeletonBonesOptions options;
  options.prune = 0.0;
  EXPECT_EQ(run_skeleton_bones(drawing, options).handles.size(), 4u);
}

TEST(SkeletonBones, ARingIsCutOnceOppositeItsRoot)
{
  Drawing drawing;
  drawing.centroids = { Vec3(0.01, 0.0, 0.0) };
  constexpr int count = 100;
  for (int i = 0; i < count; ++i)
  {
    const double a = 2.0 * M_PI * i / count;
    drawing.point(Vec3(std::cos(a), std::sin(a), 0.0));
    drawing.segments.push_back({ i, (i + 1) % count });
  }
  const SkeletonBones bones = run_skeleton_bones(drawing);
  EXPECT_EQ(bones.cut_cycles, 1);
  ASSERT_EQ(bones.roots.size(), 1u);
  EXPECT_EQ(Vec3(bones.joints.row(bones.roots[0])), Vec3(1.0, 0.0, 0.0));
  expect_tree(bones);
  // The bones form one tree, so there is one more joint than there are bones.
  EXPECT_EQ(bones.joints.rows(), static_cast<Index>(bones.handles.size()) + 1);
  EXPECT_EQ(bones.junctions, 0);
  // The loop is cut near the point (-1, 0, 0). Two bones end near this point, at a distance of at
  // most one segment length.
  int ends = 0;
  for (const Handle& bone : bones.handles)
  {
    ends += (bone.tail - Vec3(-1.0, 0.0, 0.0)).norm() <= 2.0 * M_PI / count ? 1 : 0;
  }
  EXPECT_EQ(ends, 2);
  SkeletonBones whole;
  const Status status = skeleton_bones(drawing.skeleton(), 1.0, SkeletonBonesOptions(), whole);
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("1 loop"));
}

TEST(SkeletonBones, ARingWithATailIsRootedAtItsJunction)
{
  Drawing drawing;
  drawing.centroids = { Vec3(0.0, 0.0, 0.0) };
  constexpr int count = 60;
  for (int i = 0; i < count; ++i)
  {
    const double a = 2.0 * M_PI * i / count;
    drawing.point(Vec3(std::cos(a), std::sin(a), 0.0));
    drawing.segments.push_back({ i, (i + 1) % count });
  }
  drawing.line(0, Vec3(3.0, 0.0, 0.0));
  const SkeletonBones bones = run_skeleton_bones(drawing);
  EXPECT_EQ(bones.cut_cycles, 1);
  EXPECT_EQ(bones.junctions, 1);
  EXPECT_EQ(Vec3(bones.joints.row(bones.roots[0])), Vec3(1.0, 0.0, 0.0));
  expect_tree(bones);
}

TEST(SkeletonBones, BallsArePointsAndComponentsHaveRootsOfTheirOwn)
{
  Drawing drawing;
  drawing.centroids = { Vec3(0.0, 0.0, 5.0) };
  drawing.point(Vec3(0.0, 0.0, 5.0), 1.0);
  drawing.centroids.emplace_back(0.0, 0.0, -5.0);
  // This line is short, so it becomes a point handle.
  drawing.line(drawing.point(Vec3(0.0, 0.0, -5.0), 1.0), Vec3(0.4, 0.0, -5.0));
  drawing.centroids.emplace_back(Vec3::Zero());
  drawing.line(drawing.point(Vec3::Zero()), Vec3(1.0, 0.0, 0.0));
  drawing.centroids.emplace_back(0.0, 3.0, 0.0);
  drawing.line(drawing.point(Vec3(0.0, 3.0, 0.0)), Vec3(1.0, 3.0, 0.0));
  SkeletonBonesOptions options;
  options.maximum_bones = 1;
  SkeletonBones bones;
  const Status status = skeleton_bones(drawing.skeleton(), 1.0, options, bones);
  ASSERT_TRUE(status.ok());
  ASSERT_EQ(bones.handles.size(), 4u);
  EXPECT_EQ(bones.handles[0].name, "p1");
  EXPECT_EQ(bones.handles[0].kind, HandleKind::point);
  EXPECT_EQ(bones.handles[1].name, "p2");
  EXPECT_EQ(bones.handles[2].name, "b1");
  EXPECT_EQ(bones.handles[3].name, "b2");
  EXPECT_EQ(bones.roots.size(), 2u);
  expect_tree(bones);
  // For both point handles, above and below the bones, the nearest bone is the middle one.
  EXPECT_EQ(bones.handles[0].parent, 2);
  EXPECT_EQ(bones.handles[1].parent, 2);
  EXPECT_EQ(bones.handles[2].parent, -1);
  EXPECT_EQ(bones.handles[3].parent, 2);
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("2 bones, more than maximum_bones (1)"));
}

TEST(SkeletonBones, OptionsOutOfRangeAreNamed)
{
  const Drawing drawing = half_circle();
  const auto message = [&](const SkeletonBonesOptions& options)
  {
    SkeletonBones bones;
    const Status status = skeleton_bones(drawing.skeleton(), 1.0, options, bones);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    return status.message;
  };
  SkeletonBonesOptions options;
  options.tolerance = 0.0;
  EXPECT_THAT(message(options), HasSubstr("bone_tolerance"));
  options = {};
  options.longest_bone = std::nan("");
  EXPECT_THAT(message(options), HasSubstr("longest_bone"));
  options = {};
  options.maximum_bones = -1;
  EXPECT_THAT(message(options), HasSubstr("maximum_bones"));
  options = {};
  options.prune = 11.0;
  EXPECT_THAT(message(options), HasSubstr("prune"));
}
