// Linear blend, dual quaternion and stretchable-bone skinning: identity, common motions, joints,
// and signs of quaternions.
#include "skinning/skinning.h"

#include "handles/bone_projection.h"
#include "pose/pose_file.h"
#include "pose/transform_parts.h"
#include "support/affines.h"
#include "support/bars.h"
#include "support/differences.h"
#include "support/handles.h"
#include "support/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace bindpose;
using test::largest_distance;
using test::moved;
using testing::HasSubstr;

namespace
{
Affine turn_about(double degrees, const Vec3& axis, const Vec3& pivot = Vec3::Zero(),
  const Vec3& move = Vec3::Zero())
{
  return affine_about(pivot, test::rotation(degrees, axis), move);
}

struct Posed
{
  Points linear, dual, linear_normals, dual_normals;
};

Posed pose_with(const Points& points, const Weights& weights, const std::vector<Affine>& transforms,
  const Points& pivots, const Points& normals = Points(), int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  Skinning skinning;
  EXPECT_TRUE(skinning.bind(context, weights).ok());
  Posed posed;
  EXPECT_TRUE(skinning.linear_blend(context, points, transforms, posed.linear).ok());
  EXPECT_TRUE(skinning.dual_quaternion(context, points, transforms, pivots, posed.dual).ok());
  if (normals.rows() > 0)
  {
    EXPECT_TRUE(
      skinning.linear_blend_normals(context, normals, transforms, posed.linear_normals).ok());
    EXPECT_TRUE(
      skinning.dual_quaternion_normals(context, normals, transforms, pivots, posed.dual_normals)
        .ok());
  }
  return posed;
}

/// Return points of radius 1 around the x axis at x = 0.
Points ring_of_points()
{
  Points points(16, 3);
  for (Index i = 0; i < 16; ++i)
  {
    const double a = 2.0 * EIGEN_PI * static_cast<double>(i) / 16.0;
    points.row(i) << 0.0, std::cos(a), std::sin(a);
  }
  return points;
}
} // namespace

// If all transforms are the identity, the points keep their bits.
TEST(Skinning, IdentityMovesNoBit)
{
  const test::Rig rig = test::box();
  Weights off = rig.weights;
  off.row(3).setZero();
  off.row(4) *= 0.5;
  for (const Weights& weights : { rig.weights, off })
  {
    const Posed posed = pose_with(rig.mesh.points, weights,
      std::vector<Affine>(5, identity_affine()), handle_pivots(rig.handles));
    EXPECT_EQ(posed.linear, rig.mesh.points);
    EXPECT_EQ(posed.dual, rig.mesh.points);
  }
}

// If all handles move by the same motion, all points move by it.
TEST(Skinning, ACommonMotionMovesTheWhole)
{
  const test::Rig rig = test::box();
  const Points pivots = handle_pivots(rig.handles);
  Affine affine = turn_about(40, Vec3(1, 2, 3), Vec3(1, 0, 0), Vec3(3, -4, 5));
  affine.leftCols<3>() *= Vec3(1.5, 0.7, 1.0).asDiagonal();
  const Posed sheared =
    pose_with(rig.mesh.points, rig.weights, std::vector<Affine>(5, affine), pivots);
  EXPECT_LT((sheared.linear - moved(rig.mesh.points, affine)).cwiseAbs().maxCoeff(), 1e-13);
  const Affine rigid = turn_about(140, Vec3(-1, 2, 0.5), Vec3(0, 1, 0), Vec3(10, 0, 3));
  const Posed posed =
    pose_with(rig.mesh.points, rig.weights, std::vector<Affine>(5, rigid), pivots);
  EXPECT_LT((posed.linear - moved(rig.mesh.points, rigid)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((posed.dual - moved(rig.mesh.points, rigid)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Skinning, OneHandleTakesAnyAffineMapExactlyUnderBoth)
{
  const test::Rig rig = test::box();
  const Points points = rig.mesh.points.topRows(20);
  Affine affine = turn_about(70, Vec3(1, 0, 3), Vec3(1, 2, 0), Vec3(0, -4, 5));
  affine.leftCols<3>() *= Vec3(2.0, 0.5, -1.0).asDiagonal(); // includes a reflection
  Points pivot(1, 3);
  pivot << 0.3, 0.4, 0.5;
  const Posed posed = pose_with(points, Weights::Ones(20, 1), { affine }, pivot);
  EXPECT_LT((posed.linear - moved(points, affine)).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((posed.dual - moved(points, affine)).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Skinning, LinearBlendIsLinearInTheTransforms)
{
  const test::Rig rig = test::box(3);
  test::Random random(3);
  std::vector<Affine> a(5), b(5), sum(5);
  for (std::size_t h = 0; h < 5; ++h)
  {
    for (int e = 0; e < 12; ++e)
    {
      a[h].data()[e] = random.uniform(-1, 1);
      b[h].data()[e] = random.uniform(-1, 1);
    }
    sum[h] = 0.25 * a[h] + 0.75 * b[h];
  }
  const Points pivots = handle_pivots(rig.handles);
  const Points pa = pose_with(rig.mesh.points, rig.weights, a, pivots).linear;
  const Points pb = pose_with(rig.mesh.points, rig.weights, b, pivots).linear;
  const Points ps = pose_with(rig.mesh.points, rig.weights, sum, pivots).linear;
  EXPECT_LT((ps - (0.25 * pa + 0.75 * pb)).cwiseAbs().maxCoeff(), 1e-13);
}

// A twisted ring with equal weights shrinks by a cosine under linear blend skinning, and keeps its
// radius under dual quaternion skinning.
TEST(Skinning, ATwistedRingShrinksByTheCosineUnderLinearBlendAndNotUnderDual)
{
  const Weights half = Weights::Constant(16, 2, 0.5);
  for (const auto& [degrees, radius] :
    { std::pair<double, double>{ 90, std::sqrt(0.5) }, { 120, 0.5 }, { 180, 0.0 } })
  {
    const Posed posed = pose_with(ring_of_points(), half,
      { identity_affine(), turn_about(degrees, Vec3(1, 0, 0)) }, Points::Zero(2, 3));
    for (Index i = 0; i < 16; ++i)
    {
      EXPECT_NEAR(posed.linear.row(i).norm(), radius, 1e-14);
      EXPECT_NEAR(posed.dual.row(i).norm(), 1.0, 1e-14);
    }
    // Each point has the weight 1/2 for the handle at rest and for the handle that rotates by
    // `degrees`. Dual quaternion skinning therefore rotates the point by degrees / 2.
    const Points exact = moved(ring_of_points(), turn_about(0.5 * degrees, Vec3(1, 0, 0)));
    EXPECT_LT((posed.dual - exact).cwiseAbs().maxCoeff(), 1e-14);
  }
}

// Rotations that differ by full turns give the same points.
TEST(Skinning, ARotationAndItsFullTurnsAreOne)
{
  const Weights half = Weights::Constant(16, 2, 0.5);
  const Vec3 axis(1, 0.2, -0.4);
  const Affine base = turn_about(-100, Vec3(0, 1, 0));
  const Points pivots = Points::Zero(2, 3);
  for (const double degrees : { 10.0, 170.0, -170.0, 190.0 })
  {
    // The two quaternions are q and -q, because the angles differ by a full turn. The matrices are
    // equal up to round-off.
    const Posed a = pose_with(ring_of_points(), half, { base, turn_about(degrees, axis) }, pivots);
    const Posed b =
      pose_with(ring_of_points(), half, { base, turn_about(degrees + 360.0, axis) }, pivots);
    EXPECT_LT((a.dual - b.dual).cwiseAbs().maxCoeff(), 1e-12);
    for (Index i = 0; i < 16; ++i)
    {
      // Blending along the shorter path gives a rotation, so each point keeps its radius.
      EXPECT_NEAR(a.dual.row(i).norm(), 1.0, 1e-13);
    }
  }
}

TEST(Skinning, DualQuaternionsCommuteWithMovesOfTheWorld)
{
  const test::Rig rig = test::box(3);
  test::Random random(17);
  std::vector<Affine> transforms;
  for (int h = 0; h < 5; ++h)
  {
    transforms.push_back(
      turn_about(random.uniform(-80, 80), random.in_box(-Vec3::Ones(), Vec3::Ones()), Vec3::Zero(),
        random.in_box(-Vec3::Ones(), Vec3::Ones())));
    transforms.back().leftCols<3>() *= 1.2; // scales are blended about the pivots
  }
  const Affine world = turn_about(50, Vec3(2, 1, 1), Vec3::Zero(), Vec3(7, 8, 9));
  const Affine back = affine_about(
    Vec3::Zero(), world.leftCols<3>().transpose(), -world.leftCols<3>().transpose() * world.col(3));
  const auto compose = [](const Affine& a, const Affine& b)
  {
    Affine c;
    c.leftCols<3>() = a.leftCols<3>() * b.leftCols<3>();
    c.col(3) = a.leftCols<3>() * b.col(3) + a.col(3);
    return c;
  };
  std::vector<Affine> there;
  for (const Affine& t : transforms)
  {
    there.push_back(compose(world, compose(t, back)));
  }
  const Points pivots = handle_pivots(rig.handles);
  const Posed here = pose_with(rig.mesh.points, rig.weights, transforms, pivots);
  const Posed other =
    pose_with(moved(rig.mesh.points, world), rig.weights, there, moved(pivots, world));
  EXPECT_LT((other.dual - moved(here.dual, world)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((other.linear - moved(here.linear, world)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Skinning, NormalsStayNormalToPosedPlanes)
{
  // A common affine map moves a plane and its normals. The transformed normals must be
  // perpendicular to the moved plane.
  const Weights ones = Weights::Ones(3, 1);
  Affine affine = turn_about(35, Vec3(3, 1, 2), Vec3::Zero(), Vec3(1, 2, 3));
  affine.leftCols<3>() *= Vec3(3.0, 0.5, 1.0).asDiagonal();
  Points triangle(3, 3);
  triangle << 0, 0, 0, 1, 0.2, 0.1, 0.3, 1, -0.5;
  const auto normal_of = [](const Points& p)
  {
    const Vec3 e = (p.row(1) - p.row(0)).transpose(), f = (p.row(2) - p.row(0)).transpose();
    return Vec3(e.cross(f).normalized());
  };
  const Points normals = normal_of(triangle).transpose().replicate(3, 1);
  const Posed posed = pose_with(triangle, ones, { affine }, Points::Zero(1, 3), normals);
  for (Index v = 0; v < 3; ++v)
  {
    EXPECT_LT((posed.linear_normals.row(v).transpose() - normal_of(posed.linear)).norm(), 1e-13);
    EXPECT_LT((posed.dual_normals.row(v).transpose() - normal_of(posed.dual)).norm(), 1e-13);
  }
}

TEST(Skinning, NormalsAreUnitVectorsAtAnyScale)
{
  const Points normals = (Points(1, 3) << 0.6, 0.0, 0.8).finished();
  const Weights weights = Weights::Ones(1, 1);
  const Points pivots = Points::Zero(1, 3);
  ExecutionContext context;
  Skinning skinning;
  ASSERT_TRUE(skinning.bind(context, weights).ok());
  for (const double scale : { 1e-3, 1.0, 1e90, 1e200 })
  {
    std::vector<Affine> transforms{ identity_affine() };
    transforms[0].leftCols<3>() *= scale;
    transforms[0](2, 2) *= 2.0; // the shape becomes twice as long along z, so the normal tilts
    const Vec3 expected = Vec3(0.6, 0.0, 0.4).normalized();
    Points posed;
    ASSERT_TRUE(skinning.linear_blend_normals(context, normals, transforms, posed).ok());
    EXPECT_LT((posed.row(0).transpose() - expected).norm(), 1e-12) << scale;
    ASSERT_TRUE(skinning.dual_quaternion_normals(context, normals, transforms, pivots, posed).ok());
    EXPECT_LT((posed.row(0).transpose() - expected).norm(), 1e-12) << scale;
  }
}

TEST(Skinning, AnyNumberOfThreadsGivesTheSameBits)
{
  const test::Rig rig = test::box(13);
  std::vector<Affine> transforms;
  for (int h = 0; h < 5; ++h)
  {
    transforms.push_back(turn_about(20.0 * h, Vec3(h, 1, 2), Vec3::Zero(), Vec3(0, h, 0)));
  }
  const Points pivots = handle_pivots(rig.handles);
  const Posed one = pose_with(rig.mesh.points, rig.weights, transforms, pivots, rig.mesh.points, 1);
  const Posed four =
    pose_with(rig.mesh.points, rig.weights, transforms, pivots, rig.mesh.points, 4);
  EXPECT_EQ(one.linear, four.linear);
  EXPECT_EQ(one.dual, four.dual);
  EXPECT_EQ(one.linear_normals, four.linear_normals);
  EXPECT_EQ(one.dual_normals, four.dual_normals);
}

TEST(Skinning, WhatDoesNotFitIsNamed)
{
  ExecutionContext context;
  Skinning skinning;
  Weights weights = Weights::Constant(4, 2, 0.5);
  weights(2, 1) = 0.75;
  const Status status = skinning.bind(context, weights);
  EXPECT_NEAR(status.report.number("row_sum_error", 0.0), 0.25, 1e-15);
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("vertex 2, off by 0.25"));
  Points out;
  EXPECT_THAT(
    skinning.linear_blend(context, Points(Points::Zero(5, 3)), std::vector<Affine>(2), out).message,
    HasSubstr("5 vertices"));
  EXPECT_THAT(
    skinning.linear_blend(context, Points(Points::Zero(4, 3)), std::vector<Affine>(3), out).message,
    HasSubstr("3 transforms"));
  EXPECT_THAT(skinning
                .dual_quaternion(context, Points(Points::Zero(4, 3)), std::vector<Affine>(2),
                  Points(Points::Zero(1, 3)), out)
                .message,
    HasSubstr("1 pivots"));
  weights(1, 0) = std::nan("");
  EXPECT_THAT(skinning.bind(context, weights).message, HasSubstr("vertex 1 in column 0"));
  context.request_cancel();
  EXPECT_EQ(skinning.bind(context, Weights(Weights::Ones(3, 1))).code, StatusCode::canceled);
}

TEST(Skinning, ModesReadAsTranslationsAndIdentity)
{
  Handles handles(3);
  Pose pose(3);
  for (std::size_t h = 0; h < 3; ++h)
  {
    handles[h].name = std::string(1, static_cast<char>('a' + h));
    handles[h].head = handles[h].tail = Vec3(static_cast<double>(h), 0, 0);
    pose[h].transform = turn_about(90, Vec3(0, 0, 1), Vec3::Zero(), Vec3(0, 0, 2));
    pose[h].mode = static_cast<HandleMode>(h);
  }
  std::vector<Affine> transforms;
  const Status status = skinning_transforms(handles, pose, transforms);
  EXPECT_EQ(transforms[0], pose[0].transform);
  EXPECT_EQ(transforms[1].leftCols<3>(), Eigen::Matrix3d::Identity());
  EXPECT_LT((transforms[1].col(3) - Vec3(-1, 1, 2)).norm(), 1e-15);
  EXPECT_EQ(transforms[2], identity_affine());
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("'c'"));

  // The next two handles are bones with constrained ends. In mode tail, a bone is translated with
  // its tail. In mode ends, a bone has the transform of its pose.
  handles[1].kind = handles[2].kind = HandleKind::bone;
  handles[1].tail = Vec3(3, 0, 0);
  pose[1].mode = HandleMode::tail;
  pose[1].stretch = 1.5;
  pose[2].mode = HandleMode::ends;
  EXPECT_TRUE(skinning_transforms(handles, pose, transforms).warnings.empty());
  EXPECT_EQ(transforms[1].leftCols<3>(), Eigen::Matrix3d::Identity());
  EXPECT_LT((transforms[1].col(3) - (Vec3(0, 4, 2) - Vec3(3, 0, 0))).norm(), 1e-14);
  EXPECT_EQ(transforms[2], pose[2].transform);
}

namespace
{
Points stretched(const Points& points, const Weights& weights,
  const std::vector<Affine>& transforms, const std::vector<BoneChange>& bones,
  const Weights& endpoints = Weights(), int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  Skinning skinning;
  EXPECT_TRUE(skinning.bind(context, weights).ok());
  Points posed;
  const Status status =
    skinning.stretchable_bones(context, points, transforms, bones, endpoints, posed);
  EXPECT_TRUE(status.ok()) << status.message;
  return posed;
}

const BoneChange unit_bone{ Vec3::Zero(), Vec3::UnitX() };
} // namespace

// Points beyond the tail of a stretched bone are translated, not scaled.
TEST(StretchableBones, WhatIsBeyondTheTailIsMovedNotScaled)
{
  Points points(4, 3);
  points << 1.3, 0, 0, 0.5, 0.2, 0, -0.4, 0, 0.1, 1.0, 0, 0;
  BoneChange bone = unit_bone;
  bone.stretch = 2.0;
  const Points posed = stretched(points, Weights::Ones(4, 1), { identity_affine() }, { bone });
  Points expected(4, 3);
  expected << 2.3, 0, 0, 1.0, 0.2, 0, -0.4, 0, 0.1, 2.0, 0, 0;
  EXPECT_LT((posed - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(StretchableBones, ATwistTurnsByTheEndpointWeightAndKeepsTheRadius)
{
  Points points = ring_of_points();
  points.col(0).setConstant(0.5);
  BoneChange bone = unit_bone;
  bone.twist = { 0.0, 180.0 };
  const Weights ones = Weights::Ones(16, 1);
  Points quarter = moved(points, turn_about(90.0, Vec3::UnitX()));
  Points posed = stretched(points, ones, { identity_affine() }, { bone });
  EXPECT_LT((posed - quarter).cwiseAbs().maxCoeff(), 1e-15);
  // If an endpoint weight is painted, it replaces the computed weight. NaN means that the weight is
  // not painted.
  Weights endpoint_weights = Weights::Constant(16, 1, 0.25);
  endpoint_weights(3, 0) = std::numeric_limits<double>::quiet_NaN();
  posed = stretched(points, ones, { identity_affine() }, { bone }, endpoint_weights);
  EXPECT_LT((posed.row(3) - quarter.row(3)).norm(), 1e-15);
  quarter = moved(points, turn_about(45.0, Vec3::UnitX()));
  EXPECT_LT((posed.row(4) - quarter.row(4)).norm(), 1e-15);
}

// Bones without stretch and twist give linear blend skinning bit for bit.
TEST(StretchableBones, WithoutAChangeAreLinearBlendBitForBit)
{
  const test::Rig rig = test::box();
  std::vector<Affine> transforms;
  for (int h = 0; h < 5; ++h)
  {
    transforms.push_back(turn_about(20.0 * h, Vec3(1, 2, h), Vec3(1, 0, 0), Vec3(0, h, -1)));
  }
  const Points linear =
    pose_with(rig.mesh.points, rig.weights, transforms, handle_pivots(rig.handles)).linear;
  std::vector<BoneChange> bones(5, unit_bone);
  EXPECT_EQ(stretched(rig.mesh.points, rig.weights, transforms, bones), linear);
  bones[1].stretch = 1.5;
  bones[3].twist = { 10.0, -70.0 };
  const Points posed = stretched(rig.mesh.points, rig.weights, transforms, bones, Weights(), 1);
  EXPECT_NE(posed, linear);
  EXPECT_EQ(stretched(rig.mesh.points, rig.weights, transforms, bones, Weights(), 3), posed);
  // A rigid motion of all handles is applied after stretch and twist.
  const Affine rigid = turn_about(75.0, Vec3(-1, 1, 3), Vec3(2, 0, 1), Vec3(5, 6, 7));
  const Points here =
    stretched(rig.mesh.points, rig.weights, std::vector<Affine>(5, identity_affine()), bones);
  const Points there =
    stretched(rig.mesh.points, rig.weights, std::vector<Affine>(5, rigid), bones);
  EXPECT_LT((there - moved(here, rigid)).cwiseAbs().maxCoeff(), 1e-12);
}

namespace
{
/// Evaluate the definition of stretchable bones, point by point and weight by weight.
Points reference_stretched(const Points& points, const Weights& weights,
  const std::vector<Affine>& transforms, const std::vector<BoneChange>& bones,
  const Weights& endpoints)
{
  Points posed = points;
  for (Index v = 0; v < points.rows(); ++v)
  {
    const Vec3 p = points.row(v);
    Vec3 sum = Vec3::Zero();
    for (Index j = 0; j < weights.cols(); ++j)
    {
      const BoneChange& bone = bones[static_cast<std::size_t>(j)];
      double e = endpoints.size() > 0 ? endpoints(v, j) : std::nan("");
      e = std::isnan(e) ? fraction_along_bone(p, bone.head, bone.vector) : e;
      const double angle = (1.0 - e) * bone.twist[0] + e * bone.twist[1];
      Vec3 at = p;
      if (bone.vector.norm() > 0.0)
      {
        at = bone.head +
          Eigen::AngleAxisd(angle * EIGEN_PI / 180.0, bone.vector.normalized()) * (p - bone.head) +
          e * (bone.stretch - 1.0) * bone.vector;
      }
      const Affine& t = transforms[static_cast<std::size_t>(j)];
      sum += weights(v, j) * (t.leftCols<3>() * at + t.col(3) - p);
    }
    posed.row(v) += sum.transpose();
  }
  return posed;
}
} // namespace

TEST(StretchableBones, AreTheirDefinitionInBothPrecisions)
{
  test::Random random(11);
  const Vec3 ones = Vec3::Ones();
  const auto between = [&](double lower, double upper) { return random.uniform(lower, upper); };
  for (int trial = 0; trial < 60; ++trial)
  {
    // Most of these vertex counts do not fill the last tile of vertices.
    const Index vertices = 1 + random.below(70), handles = 1 + random.below(6);
    Points points(vertices, 3);
    Weights weights(vertices, handles), endpoint_weights(vertices, handles);
    for (Index v = 0; v < vertices; ++v)
    {
      points.row(v) = (Vec3(3, -2, 1) + random.in_box(-2.0 * ones, 2.0 * ones)).transpose();
      for (Index j = 0; j < handles; ++j)
      {
        weights(v, j) = random.below(2) == 0 ? 0.0 : between(0.0, 1.0);
        endpoint_weights(v, j) = random.below(2) == 0 ? std::nan("") : between(0.0, 1.0);
      }
    }
    if (trial % 2 == 0)
    {
      endpoint_weights.resize(0, 0);
    }
    std::vector<Affine> transforms;
    std::vector<BoneChange> bones;
    for (Index j = 0; j < handles; ++j)
    {
      transforms.push_back(turn_about(between(-180, 180), random.in_box(-ones, ones), ones));
      transforms.back().leftCols<3>() *= between(0.5, 2.0);
      BoneChange bone{ Vec3(3, -2, 1) + random.in_box(-ones, ones), random.in_box(-ones, ones) };
      bone.stretch = random.below(3) == 0 ? 1.0 : between(-1.0, 3.0);
      // The twist is zero, up to one turn, a multiple of half turns, or many turns.
      const double sizes[] = { 0.0, 360.0, 180.0, 3600.0 };
      const auto size = static_cast<std::size_t>(random.below(4));
      for (double& angle : bone.twist.reshaped())
      {
        angle = size == 2 ? sizes[size] * static_cast<double>(random.below(9) - 4)
                          : between(-1, 1) * sizes[size];
      }
      if (random.below(8) == 0)
      {
        bone.vector.setZero(); // this bone has no direction for stretch and twist
      }
      bones.push_back(bone);
    }
    const Points expected =
      reference_stretched(points, weights, transforms, bones, endpoint_weights);
    EXPECT_LT((stretched(points, weights, transforms, bones, endpoint_weights) - expected)
                .cwiseAbs()
                .maxCoeff(),
      1e-12);
    ExecutionContext context;
    Skinning floats;
    SkinningOptions options;
    options.single_precision = true;
    ASSERT_TRUE(floats.bind(context, weights, options).ok());
    Points posed;
    ASSERT_TRUE(
      floats.stretchable_bones(context, points, transforms, bones, endpoint_weights, posed).ok());
    // In single precision, a twist of ten turns has an error of about 2^-24 times ten turns.
    EXPECT_LT((posed - expected).cwiseAbs().maxCoeff(), 2e-4);
  }
}

TEST(StretchableBones, WholeTurnsAndLanesWithoutWeightChangeNothing)
{
  test::Random random(12);
  const Vec3 ones = Vec3::Ones();
  Points points(40, 3);
  Weights weights = Weights::Ones(40, 2), ends = Weights::Ones(40, 2);
  for (Index v = 0; v < 40; ++v)
  {
    points.row(v) = random.in_box(-ones, ones).transpose();
    weights(v, v % 2) = 0.0;
  }
  std::vector<BoneChange> bones(2, unit_bone);
  bones[0].twist = { 720.0, -1080.0 }; // three full turns, because all endpoint weights are 1
  bones[1].twist = { 0.0, 90.0 };
  for (const bool single : { false, true })
  {
    ExecutionContext context;
    Skinning skinning;
    SkinningOptions options;
    options.single_precision = single;
    ASSERT_TRUE(skinning.bind(context, weights, options).ok());
    Points posed;
    const std::vector<Affine> still(2, identity_affine());
    ASSERT_TRUE(skinning.stretchable_bones(context, points, still, bones, ends, posed).ok());
    for (Index v = 0; v < 40; ++v)
    {
      EXPECT_EQ(posed.row(v) == points.row(v), weights(v, 0) == 1.0) << v;
    }
    // Huge twists rotate by an arbitrary angle, but the results are finite.
    bones[1].twist = { -1e300, 1e200 };
    ASSERT_TRUE(skinning.stretchable_bones(context, points, still, bones, Weights(), posed).ok());
    ASSERT_TRUE(posed.allFinite());
    EXPECT_LT((posed.rightCols(2).rowwise().norm() - points.rightCols(2).rowwise().norm())
                .cwiseAbs()
                .maxCoeff(),
      1e-5);
    bones[1].twist = { 0.0, 90.0 };
  }
}

TEST(StretchableBones, TakeTheirTailsWhereThePoseFilePutsThem)
{
  const Handles handles{ test::bone_handle("arm", Vec3(1, 2, 3), Vec3(2, 2, 3.5)) };
  PoseSequence sequence;
  ASSERT_TRUE(parse_pose_file(
    R"({"handles": {"arm": {"head": [0, 1, 0], "tail": [3, 4, 5], "twist": [20, 50]}}})", handles,
    sequence)
                .ok());
  const Pose pose = apply_edits(sequence.frames[0], handles, Pose(1));
  Points points(3, 3);
  points.row(0) = handles[0].head;
  points.row(1) = handles[0].tail;
  points.row(2) = 0.5 * (handles[0].head + handles[0].tail);
  std::vector<Affine> transforms;
  ASSERT_TRUE(skinning_transforms(handles, pose, transforms).ok());
  const Points posed =
    stretched(points, Weights::Ones(3, 1), transforms, bone_changes(handles, pose));
  Points expected(3, 3);
  expected << 0, 1, 0, 3, 4, 5, 1.5, 2.5, 2.5;
  EXPECT_LT((posed - expected).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(StretchableBones, SizesThatDoNotFitAreNamed)
{
  ExecutionContext context;
  Skinning skinning;
  ASSERT_TRUE(skinning.bind(context, Weights(Weights::Ones(2, 1))).ok());
  const Points points = Points::Zero(2, 3);
  Points posed;
  Status status =
    skinning.stretchable_bones(context, points, { identity_affine() }, {}, Weights(), posed);
  EXPECT_THAT(status.message, HasSubstr("0 bones"));
  status = skinning.stretchable_bones(
    context, points, { identity_affine() }, { unit_bone }, Weights(Weights::Zero(3, 1)), posed);
  EXPECT_THAT(
    status.message, HasSubstr("endpoint weights have size 3 x 1, but there are 2 vertices"));
}

namespace
{
/// Return random transforms of the five handles of the box. The angles are arbitrary, so some
/// quaternions have opposite signs.
std::vector<Affine> wild_transforms(test::Random& random, bool shears)
{
  std::vector<Affine> transforms;
  for (int h = 0; h < 5; ++h)
  {
    Affine t = turn_about(random.uniform(-180, 180), random.in_box(Vec3(-1, -1, -1), Vec3(1, 1, 1)),
      Vec3(h, 0, 1), random.in_box(Vec3(-1, -1, -1), Vec3(1, 1, 1)));
    if (shears)
    {
      t.leftCols<3>() *= Vec3(random.uniform(0.5, 2), 1.0, random.uniform(0.5, 2)).asDiagonal();
    }
    transforms.push_back(t);
  }
  return transforms;
}

struct Blends
{
  Points linear, dual, linear_normals, dual_normals;
};

Blends blends_of(const Points& points, const Weights& weights,
  const std::vector<Affine>& transforms, const Points& pivots, const SkinningOptions& options,
  Status* bound = nullptr, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  Skinning skinning;
  const Status status = skinning.bind(context, weights, options);
  EXPECT_TRUE(status.ok()) << status.message;
  if (bound)
  {
    *bound = status;
  }
  Blends blends;
  const Vec3 center = points.colwise().mean().transpose();
  Points normals = points.rowwise() - (center + Vec3(0.01, 0.02, 0.03)).transpose();
  normals.rowwise().normalize();
  EXPECT_TRUE(skinning.linear_blend(context, points, transforms, blends.linear).ok());
  EXPECT_TRUE(skinning.dual_quaternion(context, points, transforms, pivots, blends.dual).ok());
  EXPECT_TRUE(
    skinning.linear_blend_normals(context, normals, transforms, blends.linear_normals).ok());
  EXPECT_TRUE(
    skinning.dual_quaternion_normals(context, normals, transforms, pivots, blends.dual_normals)
      .ok());
  return blends;
}
} // namespace

TEST(Skinning, SinglePrecisionIsRightToAMillionthOfTheDiagonal)
{
  const test::Rig rig = test::box();
  const Points pivots = handle_pivots(rig.handles);
  const double diagonal = bounding_box(rig.mesh.points).diagonal();
  SkinningOptions single;
  single.single_precision = true;
  test::Random random(11);
  for (const Vec3& place : { Vec3(0, 0, 0), Vec3(4e3, -2e3, 1e3) })
  {
    const Points points = rig.mesh.points.rowwise() + place.transpose();
    const Points centers = pivots.rowwise() + place.transpose();
    for (const bool shears : { false, true })
    {
      std::vector<Affine> transforms = wild_transforms(random, shears);
      for (Affine& t : transforms)
      {
        // All points are translated by `place`. Adapt the transform, so that its effect on the
        // translated points is the same.
        t.col(3) += place - t.leftCols<3>() * place;
      }
      const Blends exact = blends_of(points, rig.weights, transforms, centers, {});
      const Blends fast = blends_of(points, rig.weights, transforms, centers, single);
      EXPECT_LT(largest_distance(fast.linear, exact.linear), 1e-6 * diagonal);
      EXPECT_LT(largest_distance(fast.dual, exact.dual), 1e-6 * diagonal);
      EXPECT_LT(largest_distance(fast.linear_normals, exact.linear_normals), 1e-4);
      EXPECT_LT(largest_distance(fast.dual_normals, exact.dual_normals), 1e-4);
      const Blends again = blends_of(points, rig.weights, transforms, centers, single, nullptr, 1);
      EXPECT_EQ(again.linear, fast.linear);
      EXPECT_EQ(again.dual, fast.dual);
    }
  }
  const Blends rest = blends_of(
    rig.mesh.points, rig.weights, std::vector<Affine>(5, identity_affine()), pivots, single);
  EXPECT_EQ(rest.linear, rig.mesh.points);
  EXPECT_EQ(rest.dual, rig.mesh.points);
}

TEST(Skinning, ManyInstancesAreEachLikeOne)
{
  const test::Rig rig = test::box(5); // the number of vertices is not a multiple of the tile size
  const Points& rest = rig.mesh.points;
  const double diagonal = bounding_box(rest).diagonal();
  SkinningOptions single;
  single.single_precision = true;
  Skinning skinning;
  ExecutionContext one, many;
  one.set_threads(1);
  many.set_threads(4);
  ASSERT_TRUE(skinning.bind(one, rig.weights, single).ok());
  test::Random random(12);
  std::vector<std::vector<Affine>> transforms(7);
  for (std::vector<Affine>& of_instance : transforms)
  {
    of_instance = wild_transforms(random, true);
  }
  transforms.emplace_back(5, identity_affine());
  std::vector<FloatPoints> posed, again;
  ASSERT_TRUE(skinning.linear_blend_many(one, rest, transforms, posed).ok());
  ASSERT_TRUE(skinning.linear_blend_many(many, rest, transforms, again).ok());
  EXPECT_EQ(posed, again);
  ASSERT_EQ(posed.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i)
  {
    Points alone;
    ASSERT_TRUE(skinning.linear_blend(one, rest, transforms[i], alone).ok());
    EXPECT_LT(largest_distance(posed[i].cast<double>(), alone), 1e-6 * diagonal) << i;
  }
  EXPECT_EQ(posed[7], rest.cast<float>());

  transforms[3].pop_back();
  EXPECT_EQ(
    skinning.linear_blend_many(one, rest, transforms, posed).code, StatusCode::invalid_input);
  transforms.clear();
  EXPECT_TRUE(skinning.linear_blend_many(one, rest, transforms, posed).ok());
  EXPECT_TRUE(posed.empty());
  ASSERT_TRUE(skinning.bind(one, rig.weights).ok());
  EXPECT_EQ(
    skinning.linear_blend_many(one, rest, transforms, posed).code, StatusCode::invalid_input);
}

TEST(Skinning, DroppedWeightsAreCountedAndTheirErrorIsBounded)
{
  const test::Rig rig = test::box();
  const Points pivots = handle_pivots(rig.handles);
  Weights weights = rig.weights.cwiseAbs();
  weights.array().colwise() /= weights.rowwise().sum().array();
  test::Random random(12);
  const std::vector<Affine> transforms = wild_transforms(random, false);
  const Blends exact = blends_of(rig.mesh.points, weights, transforms, pivots, {});
  for (const auto& [smallest, influences] : { std::pair{ 0.05, 0 }, std::pair{ 0.0, 2 } })
  {
    SkinningOptions options;
    options.smallest_weight = smallest;
    options.influences = influences;
    Index dropped = 0;
    double dropped_weight = 0.0;
    Points expected(rig.mesh.points.rows(), 3);
    double reach = 0.0; // largest distance between a point's positions under two different handles
    for (Index v = 0; v < expected.rows(); ++v)
    {
      std::vector<std::pair<double, Index>> row;
      for (Index j = 0; j < 5; ++j)
      {
        row.emplace_back(-weights(v, j), j);
      }
      std::sort(row.begin(), row.end());
      double kept = 0.0, lost = 0.0;
      Vec3 sum = Vec3::Zero();
      std::vector<Vec3> places;
      for (std::size_t i = 0; i < row.size(); ++i)
      {
        const double w = -row[i].first;
        const Vec3 place = transforms[static_cast<std::size_t>(row[i].second)] *
          Vec3(rig.mesh.points.row(v)).homogeneous();
        places.push_back(place);
        const bool keep = w > smallest && (influences == 0 || i < 2);
        dropped += !keep && w != 0.0 ? 1 : 0;
        (keep ? kept : lost) += w;
        sum += keep ? Vec3(w * place) : Vec3::Zero();
      }
      dropped_weight = std::max(dropped_weight, lost);
      expected.row(v) = (sum / kept).transpose();
      for (const Vec3& a : places)
      {
        for (const Vec3& b : places)
        {
          reach = std::max(reach, (a - b).norm());
        }
      }
    }
    ASSERT_GT(dropped, 100);
    Status bound;
    const Blends fewer = blends_of(rig.mesh.points, weights, transforms, pivots, options, &bound);
    EXPECT_EQ(bound.report.number("counts.dropped_weights", -1), static_cast<double>(dropped));
    EXPECT_NEAR(bound.report.number("dropped_share", -1), dropped_weight, 1e-12);
    EXPECT_LT(largest_distance(fewer.linear, expected), 1e-12);
    EXPECT_LE(largest_distance(fewer.linear, exact.linear), dropped_weight * reach + 1e-12);
  }
  ExecutionContext context;
  Skinning skinning;
  SkinningOptions wrong;
  wrong.smallest_weight = -1.0;
  EXPECT_EQ(skinning.bind(context, weights, wrong).code, StatusCode::invalid_input);
}

TEST(Skinning, SignsOfQuaternionsAreEachVertexsOwn)
{
  // The vertices of a tile have different reference quaternions. Posing a vertex alone must give
  // the same result as posing the whole tile.
  const test::Rig rig = test::box();
  const Points pivots = handle_pivots(rig.handles);
  test::Random random(13);
  for (int round = 0; round < 5; ++round)
  {
    const std::vector<Affine> transforms = wild_transforms(random, false);
    for (const bool single : { false, true })
    {
      SkinningOptions options;
      options.single_precision = single;
      const Points together =
        blends_of(rig.mesh.points, rig.weights, transforms, pivots, options).dual;
      for (Index v = 0; v < together.rows(); v += 7)
      {
        const Points alone = blends_of(
          Points(rig.mesh.points.row(v)), Weights(rig.weights.row(v)), transforms, pivots, options)
                               .dual;
        EXPECT_LT((alone.row(0) - together.row(v)).norm(), single ? 1e-5 : 1e-12) << v;
      }
    }
  }
}
