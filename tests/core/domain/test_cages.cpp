// Cages as handles. Weights are linear along the edges and faces of a cage, for any energy that
// determines the weights inside of the cage.
#include "geometry/simplex_locator.h"
#include "weights/bounded_biharmonic_weights.h"
#include "weights/monotone_weights.h"
#include "weights/preview_weights.h"
#include "weights/surface_weights.h"

#include "support/needs_mesher.h"
#include "weights_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using test::bounded;
using test::cage_vertex_handle;
using test::problem_of;
using testing::HasSubstr;

namespace
{
using CagesInTets = test::MesherTest;

/// Return a polyline of cage edges, closed or open.
Handles polyline(const std::vector<Vec3>& corners, bool closed)
{
  Handles handles;
  const auto count = static_cast<Index>(corners.size());
  for (Index i = 0; i < count; ++i)
  {
    handles.push_back(cage_vertex_handle("c" + std::to_string(i), corners[i]));
    if (closed || i + 1 < count)
    {
      handles.back().cage.push_back({ i, (i + 1) % count, -1 });
    }
  }
  return handles;
}

/// Return the faces of a cube around the origin.
Handles cube_cage(double half)
{
  const TriangleMesh cube = test::cube(-half, half);
  Handles handles;
  for (Index v = 0; v < cube.points.rows(); ++v)
  {
    handles.push_back(cage_vertex_handle("c" + std::to_string(v), cube.points.row(v)));
  }
  for (Index f = 0; f < cube.triangles.rows(); ++f)
  {
    const auto face = cube.triangles.row(f);
    handles[face[0]].cage.push_back({ face[0], face[1], face[2] });
  }
  return handles;
}

/// Expect that the weights on an edge or face of the cage equal the barycentric coordinates. Return
/// the number of mesh vertices on this edge or face.
Index expect_linear_along(
  const WeightsProblem& problem, const Weights& weights, const CageElement& element)
{
  const bool face = element[2] >= 0;
  const auto corner = [&](int k) { return problem.handles[element[k]].head; };
  Index vertex_count = 0;
  for (Index v = 0; v < weights.rows(); ++v)
  {
    const SimplexLocation at = nearest_in_triangle(
      problem.mesh.domain.points.row(v), corner(0), corner(1), corner(face ? 2 : 1));
    if (at.distance > 1e-9)
    {
      continue;
    }
    ++vertex_count;
    for (Index j = 0; j < weights.cols(); ++j)
    {
      double expected = 0.0;
      for (int k = 0; k < 3; ++k)
      {
        expected += element[face ? k : std::min(k, 1)] == j ? at.barycentric[k] : 0.0;
      }
      EXPECT_NEAR(weights(v, j), expected, 1e-9) << "vertex " << v << ", column " << j;
    }
  }
  return vertex_count;
}
} // namespace

TEST(Cages, AreLinearAlongEdgesInThePlane)
{
  // The cage is a closed triangle inside of a square mesh. Its corners and edges are at arbitrary
  // positions relative to the mesh.
  const Handles handles =
    polyline({ { 0.21, 0.18, 0 }, { 0.83, 0.31, 0 }, { 0.44, 0.87, 0 } }, true);
  const WeightsProblem problem = problem_of(test::to_domain(test::grid(20, 20)), handles);
  EXPECT_GT(problem.mesh.inserted.size(), 10u);
  for (const Weights& weights : { bounded(problem).weights,
         [&]
         {
           ExecutionContext context;
           WeightsResult result;
           EXPECT_TRUE(monotone_weights(context, problem, {}, result).ok());
           return result.weights;
         }(),
         [&]
         {
           ExecutionContext context;
           WeightsResult result;
           EXPECT_TRUE(preview_weights(context, problem, {}, result).ok());
           return result.weights;
         }() })
  {
    for (const Handle& handle : handles)
    {
      for (const CageElement& element : handle.cage)
      {
        EXPECT_GE(expect_linear_along(problem, weights, element), 5);
      }
    }
  }
}

TEST(Cages, MayBeOpen)
{
  const Handles handles = polyline({ { 0.1, 0.5, 0 }, { 0.5, 0.6, 0 }, { 0.9, 0.5, 0 } }, false);
  const WeightsProblem problem = problem_of(test::to_domain(test::grid(16, 16)), handles);
  const WeightsResult result = bounded(problem);
  EXPECT_GE(expect_linear_along(problem, result.raw, { 0, 1, -1 }), 4);
  EXPECT_GE(expect_linear_along(problem, result.raw, { 1, 2, -1 }), 4);
  for (const WeightsColumn& column : result.columns)
  {
    EXPECT_LE(column.certificate.relative_gap, 1e-6);
    EXPECT_LE(column.certificate.kkt_residual, 1e-6);
  }
}

TEST(Cages, AreLinearOnFacesInSpace)
{
  const TetMesh box = test::tet_box(7, 7, 7, Vec3::Constant(-1.0), Vec3::Constant(1.0));
  const Handles handles = cube_cage(0.6);
  const WeightsProblem problem = problem_of(test::to_domain(box), handles);
  const WeightsResult result = bounded(problem);
  for (const Handle& handle : handles)
  {
    for (const CageElement& element : handle.cage)
    {
      EXPECT_GE(expect_linear_along(problem, result.raw, element), 8);
    }
  }
}

TEST(Cages, ThatAreTheWholeBoundaryAddNothing)
{
  // The cage is the boundary of the box, and every boundary vertex of the mesh is already on the
  // cage. Therefore no vertex is inserted.
  const TetMesh box = test::tet_box(4, 4, 4, Vec3::Constant(-1.0), Vec3::Constant(1.0));
  const WeightsProblem problem = problem_of(test::to_domain(box), cube_cage(1.0));
  EXPECT_TRUE(problem.mesh.inserted.empty());
  EXPECT_EQ(problem.fixed.size(), 98u) << "125 vertices, 27 inside";
  const WeightsResult result = bounded(problem);
  EXPECT_LT((result.raw.rowwise().sum().array() - 1.0).abs().maxCoeff(), 0.2);
}

TEST_F(CagesInTets, AroundASurfaceAreItsDomain)
{
  const TriangleMesh ball = test::sphere(2, 0.5);
  ExecutionContext context;
  SurfaceWeightsOptions options;
  options.domain = WeightsDomain::cage;
  SurfaceWeights result;
  const auto method =
    [](ExecutionContext& method_context, const WeightsProblem& problem, WeightsResult& weights)
  { return bounded_biharmonic_weights(method_context, problem, {}, weights); };
  Status status = surface_weights(
    context, ball.points, ball.triangles, {}, cube_cage(1.0), options, {}, method, result);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(status.report.text("domain"), "cage");
  EXPECT_EQ(status.report.text("transfer"), "exact") << "the points are vertices of the tets";
  EXPECT_TRUE(status.warnings.empty()) << status.warnings.front();
  EXPECT_LT((result.weights.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-12);
  // The weights are linear on the faces of the cage. Inside of the cage they are approximately
  // generalized barycentric coordinates: the weighted sum of the cage corners is close to each
  // point.
  const Handles cage = cube_cage(1.0);
  double farthest = 0.0;
  for (Index v = 0; v < ball.points.rows(); ++v)
  {
    Vec3 carried = Vec3::Zero();
    for (Index j = 0; j < 8; ++j)
    {
      carried += result.weights(v, j) * cage[j].head;
    }
    farthest = std::max(farthest, (carried - Vec3(ball.points.row(v))).norm());
  }
  EXPECT_LT(farthest, 0.16) << "nothing is said of slopes at the cage";

  status = surface_weights(
    context, ball.points, ball.triangles, {}, cube_cage(0.4), options, {}, method, result);
  ASSERT_TRUE(status.usable()) << status.message;
  ASSERT_FALSE(status.warnings.empty());
  EXPECT_THAT(status.warnings.back(), HasSubstr("outside the cage"));

  status = surface_weights(context, ball.points, ball.triangles, {},
    { test::point_handle("p", { 0, 0, 0 }) }, options, {}, method, result);
  EXPECT_THAT(status.message, HasSubstr("domain cage needs a closed cage"));
}

TEST_F(CagesInTets, OfEdgesAroundAFlatShapeAreItsDomain)
{
  ExecutionContext context;
  SurfaceWeightsOptions options;
  options.domain = WeightsDomain::cage;
  const auto method =
    [](ExecutionContext& method_context, const WeightsProblem& problem, WeightsResult& weights)
  { return bounded_biharmonic_weights(method_context, problem, {}, weights); };
  TriangleMesh shape = test::grid(10, 10, 0.8, 0.8);
  shape.points.leftCols(2).array() += 0.1; // the shape is inside of a cage of size one
  Handles cage = polyline({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, true);
  // The edges of a cage may have either direction.
  cage[1].cage.clear();
  cage[2].cage = { { 2, 1, -1 }, { 2, 3, -1 } };
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(1.1, Vec3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  for (const Eigen::Matrix3d& placed : { Eigen::Matrix3d(Eigen::Matrix3d::Identity()), turn })
  {
    const Points points = shape.points * placed.transpose();
    Handles handles = cage;
    for (Handle& handle : handles)
    {
      handle.head = handle.tail = placed * handle.head;
    }
    SurfaceWeights result;
    const Status status =
      surface_weights(context, points, shape.triangles, {}, handles, options, {}, method, result);
    ASSERT_TRUE(status.ok()) << status.message;
    EXPECT_TRUE(status.warnings.empty()) << status.warnings.front();
    EXPECT_EQ(status.report.text("domain"), "cage");
    EXPECT_EQ(status.report.text("transfer"), "exact");
    EXPECT_NEAR(status.report.number("cage.area", 0.0), 1.0, 1e-12);
    EXPECT_LT((result.weights.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-12);
    EXPECT_GE(result.weights.minCoeff(), 0.0);
    // At the center of the cage, the weights of all four corners are equal.
    const Index middle = 60;
    ASSERT_LT((Vec3(shape.points.row(middle)) - Vec3(0.5, 0.5, 0.0)).norm(), 1e-12);
    EXPECT_LT((result.weights.row(middle).array() - 0.25).abs().maxCoeff(), 5e-3);
    for (const Handle& handle : result.problem.handles)
    {
      for (const CageElement& edge : handle.cage)
      {
        EXPECT_GE(expect_linear_along(result.problem, result.solved.weights, edge), 30);
      }
    }
    EXPECT_EQ(result.plane_cage.points.rows(), result.problem.mesh.domain.points.rows())
      << "the cage's mesh has all handles as vertices";
  }

  SurfaceWeights result;
  Points shifted = shape.points;
  shifted.col(0).array() += 0.5;
  Status status =
    surface_weights(context, shifted, shape.triangles, {}, cage, options, {}, method, result);
  ASSERT_TRUE(status.usable()) << status.message;
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings.front(), HasSubstr("55 points of the surface are outside the cage"));

  shifted(0, 2) = 0.1;
  status =
    surface_weights(context, shifted, shape.triangles, {}, cage, options, {}, method, result);
  EXPECT_THAT(status.message, HasSubstr("are not flat"));
}

TEST(Cages, ThatAreWrongAreRefused)
{
  Handles handles = polyline({ { 0, 0, 0 }, { 1, 0, 0 } }, false);
  EXPECT_TRUE(check_handles(handles).ok());
  for (const CageElement& wrong :
    { CageElement{ 0, 0, -1 }, CageElement{ 0, 2, -1 }, CageElement{ 1, 0, -1 },
      CageElement{ 0, -1, -1 }, CageElement{ 0, 1, 1 }, CageElement{ 0, 1, 7 } })
  {
    handles[0].cage = { wrong };
    EXPECT_THAT(check_handles(handles).message, HasSubstr("cage edge or face at 'c0'"));
  }
  handles[0].cage = { { 0, 1, -1 } };
  handles[1].kind = HandleKind::point;
  EXPECT_THAT(check_handles(handles).message, HasSubstr("cage edge or face at 'c0'"));
}
