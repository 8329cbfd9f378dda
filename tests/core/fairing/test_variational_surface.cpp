// Smooth surfaces between handles and fixed vertices (variational modeling): known results,
// invariances, and errors.
#include "fairing/variational_surface.h"

#include "core/arap/full_arap_cases.h"
#include "support/affines.h"
#include "support/differences.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace bindpose;
using namespace bindpose::test;
using testing::HasSubstr;

namespace
{
constexpr int squares = 12;
constexpr PatchBoundary every_boundary[] = { PatchBoundary::region, PatchBoundary::curve,
  PatchBoundary::tangent };

/// Return the number of layers of cells between a vertex of the square and the border.
Index depth(const TriangleMesh& square, Index v)
{
  const double x = square.points(v, 0), y = square.points(v, 1);
  return std::lround(std::min({ x, y, 1.0 - x, 1.0 - y }) * squares);
}

std::vector<char> band(const TriangleMesh& square, int layers)
{
  std::vector<char> fixed(static_cast<std::size_t>(square.points.rows()), 0);
  for (Index v = 0; v < square.points.rows(); ++v)
  {
    fixed[v] = depth(square, v) < layers;
  }
  return fixed;
}

/// A square with a fixed band of three layers at its border. A region in its middle moves up.
struct Bump
{
  TriangleMesh mesh = grid(squares, squares);
  VariationalSurfaceOptions options;
  Handles handles{ region_handle("middle", 1, Vec3(0.5, 0.5, 0.0)) };
  Pose pose{ HandlePose() };
  VariationalSurface surface;
  ExecutionContext context;

  Bump()
  {
    this->options.fixed = band(this->mesh, 3);
    this->options.region_ids.assign(static_cast<std::size_t>(this->mesh.points.rows()), 0);
    for (Index v = 0; v < this->mesh.points.rows(); ++v)
    {
      this->options.region_ids[v] = depth(this->mesh, v) >= 5;
    }
    this->pose[0].transform(2, 3) = 0.4;
  }
  Status bind()
  {
    return this->surface.bind(
      this->context, this->mesh.points, this->mesh.triangles, this->handles, this->options);
  }
  Status solve()
  {
    const Status status = this->bind();
    return status.ok() ? this->surface.solve(this->context, this->pose) : status;
  }
};

Affine rigid_motion(const Vec3& axis, double angle, const Vec3& shift)
{
  return affine(Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(), shift);
}

/// Return a strip of the cylinder of radius 1 around the x axis.
TriangleMesh bent_square()
{
  TriangleMesh mesh = grid(squares, squares);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    const double angle = mesh.points(v, 1);
    mesh.points.row(v) << mesh.points(v, 0), std::sin(angle), std::cos(angle);
  }
  return mesh;
}
} // namespace

TEST(VariationalSurface, WhatIsHeldIsHeldAndTheRestIsBetween)
{
  for (const int order : { 1, 2, 3 })
  {
    Bump bump;
    bump.options.order = order;
    const Status status = bump.solve();
    ASSERT_TRUE(status.ok()) << status.message;
    EXPECT_TRUE(status.warnings.empty());
    EXPECT_LT(status.report.number("constraint_residual", 1.0), 1e-15);
    EXPECT_LT(status.report.number("refinement", 1.0), 1e-12);
    const Points& posed = bump.surface.posed();
    for (Index v = 0; v < posed.rows(); ++v)
    {
      EXPECT_EQ(posed(v, 0), bump.mesh.points(v, 0));
      if (depth(bump.mesh, v) < 3 || depth(bump.mesh, v) >= 5)
      {
        EXPECT_EQ(posed(v, 2), depth(bump.mesh, v) < 3 ? 0.0 : 0.4);
      }
      else
      {
        EXPECT_GT(posed(v, 2), 0.0);
        EXPECT_LT(posed(v, 2), 0.4);
      }
    }
  }
}

TEST(VariationalSurface, RestIsRestWhateverTheMesh)
{
  for (const PatchBoundary boundary : every_boundary)
  {
    Bump bump;
    bump.mesh = bent_square();
    bump.options.boundary = boundary;
    bump.pose[0].transform = identity_affine();
    ASSERT_TRUE(bump.solve().ok());
    EXPECT_EQ(largest_difference(bump.surface.posed(), bump.mesh.points), 0.0);
  }
}

TEST(VariationalSurface, AMotionOfAllThatIsHeldMovesAll)
{
  const Vec3 shift(0.3, -2.0, 5.0);
  struct Case
  {
    bool bent, fair;
    // Angle of the rotation in radians. If `fair` is false, displacements are smoothed. The
    // displacements of a rotation are linear in the positions. On a bent mesh, smoothing would
    // therefore change these displacements, so the angle must be 0.
    double angle;
  };
  for (const Case& c :
    { Case{ true, true, 1.1 }, Case{ true, false, 0.0 }, Case{ false, false, 1.1 } })
  {
    const Affine motion = rigid_motion(Vec3(1, 2, 3), c.angle, shift);
    Bump bump;
    bump.mesh = c.bent ? bent_square() : bump.mesh;
    bump.options.fixed.clear();
    bump.options.fair = c.fair;
    bump.options.region_ids.clear();
    const std::vector<char> fixed = band(grid(squares, squares), 2);
    for (const char f : fixed)
    {
      bump.options.region_ids.push_back(f);
    }
    bump.pose[0].transform = identity_affine();
    ASSERT_TRUE(bump.solve().ok());
    const Points rest = bump.surface.posed();
    bump.pose[0].transform = motion;
    ASSERT_TRUE(bump.surface.solve(bump.context, bump.pose).ok());
    EXPECT_LT(largest_difference(bump.surface.posed(), moved(rest, motion)), 1e-12);
    EXPECT_EQ(bump.surface.factorizations(), 1);
  }
}

TEST(VariationalSurface, AMeshElsewhereAndOfAnotherSizeIsThatMesh)
{
  for (const PatchBoundary boundary : every_boundary)
  {
    for (const int order : { 1, 2, 3 })
    {
      Bump bump;
      bump.mesh = bent_square();
      bump.options.boundary = boundary;
      bump.options.order = order;
      bump.options.fair = true;
      ASSERT_TRUE(bump.solve().ok());
      const Points here = bump.surface.posed();
      const Affine motion = rigid_motion(Vec3(-1, 2, 1), 2.0, Vec3(3.0, 1.0, -4.0));
      const double scale = 1000.0;
      Bump other;
      other.options = bump.options;
      other.mesh.points = scale * moved(bump.mesh.points, motion);
      const Vec3 up = scale * motion.leftCols<3>() * Vec3(0, 0, 0.4);
      other.pose[0].transform.col(3) = up;
      ASSERT_TRUE(other.solve().ok());
      EXPECT_LT(largest_difference(other.surface.posed() / scale, moved(here, motion)), 1e-10);
    }
  }
}

TEST(VariationalSurface, MovingAHandleDoesNotFactorAgain)
{
  Bump bump;
  ASSERT_TRUE(bump.solve().ok());
  const Points once = bump.surface.posed();
  bump.pose[0].transform(2, 3) = 0.8;
  ASSERT_TRUE(bump.surface.solve(bump.context, bump.pose).ok());
  const Points flat = bump.mesh.points;
  // The result is a linear function of the pose.
  EXPECT_LT(largest_difference(bump.surface.posed() - flat, 2.0 * (once - flat)), 1e-13);
  EXPECT_EQ(bump.surface.factorizations(), 1);
  bump.pose[0].mode = HandleMode::free;
  ASSERT_TRUE(bump.surface.solve(bump.context, bump.pose).ok());
  EXPECT_EQ(largest_difference(bump.surface.posed(), flat), 0.0);
  EXPECT_EQ(bump.surface.factorizations(), 2);
}

TEST(VariationalSurface, APointInsideATriangleIsHeld)
{
  Bump bump;
  bump.handles = { point_handle("p", Vec3(0.51, 0.47, 0.0)) };
  for (const HandleMode mode : { HandleMode::full, HandleMode::position })
  {
    bump.pose[0].mode = mode;
    const Status status = bump.solve();
    ASSERT_TRUE(status.ok());
    EXPECT_LT(status.report.number("constraint_residual", 1.0), 1e-12);
    EXPECT_GT(bump.surface.posed().col(2).maxCoeff(), 0.35);
  }
}

TEST(VariationalSurface, AFlatPatchFairedOnItsOwnPlaneIsItself)
{
  for (const PatchBoundary boundary : every_boundary)
  {
    Bump bump;
    Random random(5);
    bump.handles.clear();
    bump.pose.clear();
    bump.options.fair = true;
    bump.options.boundary = boundary;
    bump.options.parameters = bump.mesh.points;
    Points noisy = bump.mesh.points;
    for (Index v = 0; v < noisy.rows(); ++v)
    {
      if (!bump.options.fixed[v])
      {
        noisy.row(v) += random.in_box(Vec3::Constant(-0.3), Vec3::Constant(0.3)).transpose();
      }
    }
    const Points flat = bump.mesh.points;
    bump.mesh.points = noisy;
    ASSERT_TRUE(bump.solve().ok());
    EXPECT_LT(largest_difference(bump.surface.posed(), flat), 1e-12) << to_string(boundary);
  }
}

TEST(VariationalSurface, TangentsGivenAreThoseThatTheSurroundingsHave)
{
  // Fair the flat square. The normal derivatives dx/dn of the positions x define the tangents at
  // the border. These derivatives are computed from the surroundings, which are flat too.
  Bump bump;
  bump.handles.clear();
  bump.pose.clear();
  bump.options.fair = true;
  bump.options.boundary = PatchBoundary::tangent;
  ASSERT_TRUE(bump.solve().ok());
  const Points around = bump.surface.posed();
  bump.options.tangent_source = PatchTangents::clamped;
  ASSERT_TRUE(bump.solve().ok());
  // Zero derivatives of the positions cause a cusp.
  EXPECT_GT(largest_difference(bump.surface.posed(), around), 1e-3);
  // Without `fair`, displacements are smoothed instead of positions. Zero derivatives of the
  // displacements then keep the tangents of the rest shape.
  bump.options.fair = false;
  bump.handles = { point_handle("p", Vec3(0.5, 0.5, 0.0)) };
  bump.pose = { HandlePose() };
  bump.pose[0].transform(2, 3) = 0.3;
  ASSERT_TRUE(bump.solve().ok());
  const Points clamped = bump.surface.posed();
  bump.options.tangent_source = PatchTangents::surroundings;
  ASSERT_TRUE(bump.solve().ok());
  EXPECT_EQ(largest_difference(bump.surface.posed(), clamped), 0.0);
}

TEST(VariationalSurface, ACurveAloneIsAMembrane)
{
  Points membrane;
  for (const int order : { 1, 2, 3 })
  {
    Bump bump;
    bump.options.boundary = PatchBoundary::curve;
    bump.options.order = order;
    const Status status = bump.solve();
    ASSERT_TRUE(status.ok());
    membrane = order == 1 ? bump.surface.posed() : membrane;
    EXPECT_LT(largest_difference(bump.surface.posed(), membrane), 1e-12);
    EXPECT_EQ(status.warnings.size(), order == 1 ? 0u : 1u);
  }
}

TEST(VariationalSurface, WhatCannotBeIsRefused)
{
  const auto refusal = [](Bump& bump)
  {
    const Status status = bump.solve();
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    return status.message;
  };
  Bump nothing;
  nothing.handles.clear();
  nothing.pose.clear();
  nothing.options.fixed.clear();
  nothing.options.fair = true;
  EXPECT_THAT(refusal(nothing), HasSubstr("must have at least one fixed point"));
  nothing.options.fair = false;
  EXPECT_TRUE(nothing.solve().ok()); // the surface stays at rest

  Bump apart;
  apart.mesh = join(apart.mesh, translated(apart.mesh, Vec3(2, 0, 0)));
  apart.options.fair = true;
  apart.options.fixed.resize(static_cast<std::size_t>(apart.mesh.points.rows()), 0);
  apart.options.region_ids.resize(static_cast<std::size_t>(apart.mesh.points.rows()), 0);
  EXPECT_THAT(refusal(apart), HasSubstr("must have at least one fixed point"));

  Bump nan;
  nan.mesh.points(40, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(nan), HasSubstr("40"));
  Bump nan_parameter;
  nan_parameter.options.parameters = nan_parameter.mesh.points;
  nan_parameter.options.parameters(3, 0) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(nan_parameter), HasSubstr("parameter"));
  Bump nan_pose;
  nan_pose.pose[0].transform(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(nan_pose), HasSubstr("middle"));

  Bump flat;
  const Index middle = 6 * (squares + 1) + 3;
  flat.mesh.points.row(middle) = flat.mesh.points.row(middle + 1);
  EXPECT_THAT(refusal(flat), HasSubstr("must have an area"));
  Bump folded;
  folded.options.parameters = folded.mesh.points;
  folded.options.parameters.col(1).setZero();
  EXPECT_THAT(refusal(folded), HasSubstr("must have an area"));

  Bump page;
  const Index count = page.mesh.triangles.rows();
  page.mesh.triangles.conservativeResize(count + 1, Eigen::NoChange);
  page.mesh.triangles.row(count) << middle, middle + 1, 0;
  EXPECT_THAT(refusal(page), HasSubstr("3 triangles"));

  Bump order;
  order.options.order = 4;
  EXPECT_THAT(refusal(order), HasSubstr("4"));
  Bump length;
  length.options.fixed.pop_back();
  EXPECT_THAT(refusal(length), HasSubstr("flags"));
  Bump tangents;
  tangents.options.boundary = PatchBoundary::tangent;
  tangents.options.tangent_source = PatchTangents::prescribed;
  EXPECT_THAT(refusal(tangents), HasSubstr("tangents"));
  Bump empty;
  empty.mesh.triangles.resize(0, 3);
  EXPECT_THAT(refusal(empty), HasSubstr("no triangles"));
}

TEST(VariationalSurface, DefectsAwayFromThePatchDoNotMatter)
{
  Bump bump;
  // Move the corner vertex onto its neighbor, so that triangles at the corner are degenerate. The
  // free vertices are three layers away from the corner.
  bump.mesh.points.row(0) = bump.mesh.points.row(1);
  bump.options.order = 2;
  EXPECT_TRUE(bump.solve().ok());
}

TEST(VariationalSurface, WhatIsLessThanItSeemsIsSaid)
{
  Bump narrow;
  narrow.handles.clear();
  narrow.pose.clear();
  narrow.options.fair = true;
  narrow.options.fixed = band(narrow.mesh, 1);
  Status status = narrow.solve();
  ASSERT_TRUE(status.ok());
  EXPECT_THAT(status.warnings, testing::ElementsAre(HasSubstr("the mesh has only 1")));
  Bump third;
  third.options.order = 3;
  third.options.boundary = PatchBoundary::tangent;
  EXPECT_THAT(third.solve().warnings, testing::ElementsAre(HasSubstr("curvature")));
  Bump first;
  first.options.order = 1;
  first.options.boundary = PatchBoundary::tangent;
  EXPECT_THAT(first.solve().warnings, testing::ElementsAre(HasSubstr("order 1")));
}

TEST(VariationalSurface, CanceledItSaysSo)
{
  Bump bump;
  bump.context.request_cancel();
  EXPECT_EQ(bump.bind().code, StatusCode::canceled);
  Bump later;
  ASSERT_TRUE(later.bind().ok());
  later.context.request_cancel();
  EXPECT_EQ(later.surface.solve(later.context, later.pose).code, StatusCode::canceled);
}
