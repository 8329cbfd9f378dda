// All skinning methods on a surface and on tets, compared with direct calls of their kernels. A
// bind computes only the data that the method needs and that the caller has not provided.
#include "poser/bone_endpoints.h"
#include "poser/skinning_bind.h"

#include "skinning/rotation_centers.h"

#include "support/handles.h"
#include "support/meshes.h"
#include "support/poses.h"

#include <gtest/gtest.h>

using namespace bindpose;

namespace
{
class SkinningBindTest : public testing::Test
{
protected:
  void SetUp() override
  {
    this->box_ = test::tet_box(8, 2, 2, Vec3(0, 0, 0), Vec3(4, 1, 1));
    this->triangles_ = boundary_triangles(this->box_.tets);
    this->handles_ = { test::point_handle("left", Vec3(0, 0, 0)),
      test::point_handle("right", Vec3(4, 1, 1)),
      test::bone_handle("upper", Vec3(0.1, 0.5, 0.5), Vec3(2, 0.5, 0.5)),
      test::bone_handle("lower", Vec3(2, 0.5, 0.5), Vec3(3.9, 0.5, 0.5)) };
    this->weights_ = test::distance_weights(this->box_.points, this->handles_);
    this->pose_ = test::some_pose(this->handles_);
  }

  SkinnedShape shape() const
  {
    return { this->box_.points, this->weights_, this->handles_, this->endpoints_ };
  }
  /// Bind the shape with `bind_`, pose it, and return the posed points.
  Points posed(const SkinningMethodOptions& options, bool tets)
  {
    EXPECT_TRUE(this->bind_
                  .bind(this->context_, this->shape(), tets ? this->box_.tets : Tets(),
                    this->triangles_, options)
                  .ok());
    EXPECT_TRUE(this->bind_.is_bound(this->shape(), options));
    Points posed;
    const Status status = this->bind_.pose(
      this->context_, this->shape(), this->pose_, this->given_edges_, options, posed);
    EXPECT_TRUE(status.ok()) << status.message;
    return posed;
  }
  /// Bind the kernel with the weights and the center that SkinningBind uses, and compute the
  /// transforms of the pose.
  std::vector<Affine> bind_kernel(Skinning& skinning, const Pose& pose)
  {
    SkinningOptions options;
    options.center = Vec3(handle_pivots(this->handles_).colwise().mean().transpose());
    EXPECT_TRUE(skinning.bind(this->context_, this->weights_, options).ok());
    std::vector<Affine> transforms;
    EXPECT_TRUE(skinning_transforms(this->handles_, pose, transforms).ok());
    return transforms;
  }

  ExecutionContext context_;
  TetMesh box_;
  Triangles triangles_;
  Handles handles_;
  Weights weights_, endpoints_;
  Pose pose_;
  PseudoEdges given_edges_{ { 0, 1 } };
  SkinningBind bind_;
};
} // namespace

TEST_F(SkinningBindTest, MethodsGiveTheBitsOfTheirKernels)
{
  Skinning skinning;
  const std::vector<Affine> transforms = this->bind_kernel(skinning, this->pose_);
  const Points& rest = this->box_.points;
  Points expected;
  SkinningMethodOptions options;
  ASSERT_TRUE(skinning.linear_blend(this->context_, rest, transforms, expected).ok());
  EXPECT_EQ(this->posed(options, false), expected);
  EXPECT_FALSE(this->bind_.needs_elements(this->shape(), options));

  options.method = SkinningMethod::dual_quaternion;
  ASSERT_TRUE(
    skinning
      .dual_quaternion(this->context_, rest, transforms, handle_pivots(this->handles_), expected)
      .ok());
  EXPECT_EQ(this->posed(options, false), expected);

  options.method = SkinningMethod::stretchable_bones;
  ASSERT_TRUE(skinning
                .stretchable_bones(this->context_, rest, transforms,
                  bone_changes(this->handles_, this->pose_), Weights(), expected)
                .ok());
  EXPECT_EQ(this->posed(options, false), expected);
}

TEST_F(SkinningBindTest, PartsOfAShapeHaveTheBitsOfTheWhole)
{
  // The parts are ranges of vertices that begin and end within tiles (blocks of vertices). The
  // shape is at the origin or far from it.
  const Index rows = this->box_.points.rows();
  const Index begins[] = { 0, 5, 37, rows };
  for (const Vec3& place : { Vec3(0, 0, 0), Vec3(4e3, -2e3, 1e3) })
  {
    this->box_.points.rowwise() += place.transpose();
    for (Handle& handle : this->handles_)
    {
      handle.head += place;
      handle.tail += place;
    }
    for (const bool single : { false, true })
    {
      for (const SkinningMethod method :
        { SkinningMethod::linear_blend, SkinningMethod::dual_quaternion })
      {
        SkinningMethodOptions options;
        options.method = method;
        options.weights.single_precision = single;
        this->bind_.reset();
        const Points whole = this->posed(options, false);
        for (int part = 0; part < 3; ++part)
        {
          const Index begin = begins[part], count = begins[part + 1] - begin;
          const Points points = this->box_.points.middleRows(begin, count);
          const Weights weights = this->weights_.middleRows(begin, count);
          const SkinnedShape shape{ points, weights, this->handles_, Weights() };
          SkinningBind bind;
          Points posed;
          ASSERT_TRUE(bind.bind(this->context_, shape, Tets(), Triangles(), options).ok());
          ASSERT_TRUE(
            bind.pose(this->context_, shape, this->pose_, this->given_edges_, options, posed).ok());
          EXPECT_EQ(posed, whole.middleRows(begin, count)) << part;
        }
      }
    }
  }
}

TEST_F(SkinningBindTest, SinglePrecisionIsAccurateFarFromTheOrigin)
{
  const Vec3 place(4e3, -2e3, 1e3);
  this->box_.points.rowwise() += place.transpose();
  for (Handle& handle : this->handles_)
  {
    handle.head += place;
    handle.tail += place;
  }
  for (HandlePose& handle : this->pose_)
  {
    handle.transform.col(3) += place - handle.transform.leftCols<3>() * place;
  }
  const double diagonal = bounding_box(this->box_.points).diagonal();
  for (const SkinningMethod method :
    { SkinningMethod::linear_blend, SkinningMethod::dual_quaternion })
  {
    SkinningMethodOptions options;
    options.method = method;
    this->bind_.reset();
    const Points exact = this->posed(options, false);
    options.weights.single_precision = true;
    const Points fast = this->posed(options, false);
    EXPECT_LT((fast - exact).rowwise().norm().maxCoeff(), 2e-6 * diagonal);
  }
}

TEST_F(SkinningBindTest, CentersAreThoseOfTheElements)
{
  Skinning skinning;
  const std::vector<Affine> transforms = this->bind_kernel(skinning, this->pose_);
  const Points& rest = this->box_.points;
  SkinningMethodOptions options;
  options.method = SkinningMethod::rotation_centers;
  for (const bool tets : { false, true })
  {
    Points centers, expected;
    ASSERT_TRUE(
      (tets ? rotation_centers(this->context_, {}, rest, this->box_.tets, this->weights_, centers)
            : rotation_centers(this->context_, {}, rest, this->triangles_, this->weights_, centers))
        .ok());
    ASSERT_TRUE(
      skinning.centers_of_rotation(this->context_, rest, transforms, centers, expected).ok());
    this->bind_.reset();
    EXPECT_TRUE(this->bind_.needs_elements(this->shape(), options));
    EXPECT_EQ(this->posed(options, tets), expected);
    EXPECT_FALSE(this->bind_.needs_elements(this->shape(), options));
  }
}

TEST_F(SkinningBindTest, PseudoEdgesTurnPoints)
{
  const Points& rest = this->box_.points;
  SkinningMethodOptions options;
  for (const PseudoEdgeChoice choice : { PseudoEdgeChoice::given, PseudoEdgeChoice::automatic })
  {
    PseudoEdges edges = this->given_edges_;
    if (choice == PseudoEdgeChoice::automatic)
    {
      ASSERT_TRUE(
        automatic_pseudo_edges(this->context_, rest, this->triangles_, this->handles_, edges).ok());
    }
    Pose turned = this->pose_;
    rotate_by_pseudo_edges(this->handles_, edges, false, turned);
    Skinning skinning;
    const std::vector<Affine> transforms = this->bind_kernel(skinning, turned);
    Points expected;
    ASSERT_TRUE(skinning.linear_blend(this->context_, rest, transforms, expected).ok());
    options.pseudo_edges = choice;
    EXPECT_EQ(this->posed(options, false), expected);
  }
}

TEST_F(SkinningBindTest, EndpointWeightsAreSolvedOnceAndThoseOfTheShapeComeFirst)
{
  Skinning skinning;
  const std::vector<Affine> transforms = this->bind_kernel(skinning, this->pose_);
  const Points& rest = this->box_.points;
  SkinningMethodOptions options;
  options.method = SkinningMethod::stretchable_bones;
  options.endpoints = EndpointMethod::joints;
  Domain domain;
  domain.points = rest;
  domain.triangles = this->triangles_;
  Weights endpoints;
  ASSERT_TRUE(solve_endpoint_weights(this->context_, domain, this->handles_, EndpointMethod::joints,
    WeightsDomain::automatic, endpoints)
                .usable());
  const auto expected = [&](const Weights& from)
  {
    Points points;
    EXPECT_TRUE(skinning
                  .stretchable_bones(this->context_, rest, transforms,
                    bone_changes(this->handles_, this->pose_), from, points)
                  .ok());
    return points;
  };
  EXPECT_EQ(this->posed(options, false), expected(endpoints));
  EXPECT_FALSE(this->bind_.needs_elements(this->shape(), options));
  // Endpoint weights by projection need no solve. If the shape already has endpoint weights, these
  // are used.
  options.endpoints = EndpointMethod::projection;
  EXPECT_EQ(this->posed(options, false), expected(Weights()));
  this->endpoints_ = Weights::Constant(rest.rows(), 4, 0.25);
  EXPECT_EQ(this->posed(options, false), expected(this->endpoints_));
}

TEST_F(SkinningBindTest, ACanceledBindIsNotBound)
{
  ExecutionContext stopped;
  stopped.request_cancel();
  SkinningMethodOptions options;
  options.method = SkinningMethod::rotation_centers;
  EXPECT_EQ(
    this->bind_.bind(stopped, this->shape(), this->box_.tets, this->triangles_, options).code,
    StatusCode::canceled);
  EXPECT_FALSE(this->bind_.is_bound(this->shape(), options));
  EXPECT_TRUE(
    this->bind_.bind(this->context_, this->shape(), this->box_.tets, this->triangles_, options)
      .ok());
}
