// Transfer of weights from a mesh to points. The transfer is exact at vertices and reproduces
// linear functions inside of the mesh. Points outside get the weights of the nearest point of the
// mesh. The search agrees with brute force over all elements.
#include "geometry/simplex_locator.h"
#include "transfer/transfer.h"

#include "weights_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

namespace
{
Weights linear_values(const Points& points)
{
  Weights values(points.rows(), 2);
  values.col(0) = points * Vec3(0.3, -0.2, 0.5) + Eigen::VectorXd::Constant(points.rows(), 0.1);
  values.col(1) = Eigen::VectorXd::Ones(points.rows()) - values.col(0);
  return values;
}
} // namespace

TEST(Transfer, VerticesAreExactAndLinearFunctionsSurvive)
{
  const Domain box = test::to_domain(test::tet_box(4, 3, 5));
  Weights values(box.points.rows(), 3);
  test::Random random(9);
  for (Index i = 0; i < values.size(); ++i)
  {
    values.data()[i] = random.uniform();
  }
  ExecutionContext context;
  Weights result;
  TransferCounts counts;
  ASSERT_TRUE(transfer(context, box, values, box.points, {}, result, counts).ok());
  EXPECT_EQ(result, values) << "bit by bit";
  EXPECT_EQ(counts.exact, box.points.rows());
  EXPECT_STREQ(transfer_word(counts), "exact");

  Points inside(500, 3);
  for (Index i = 0; i < inside.rows(); ++i)
  {
    inside.row(i) = random.in_box(Vec3::Zero(), Vec3::Ones());
  }
  ASSERT_TRUE(transfer(context, box, linear_values(box.points), inside, {}, result, counts).ok());
  EXPECT_LT((result - linear_values(inside)).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_EQ(counts.barycentric, 500);
  EXPECT_STREQ(transfer_word(counts), "barycentric");
}

TEST(Transfer, OutsideTakesTheNearestPlaceAndMissesAreCounted)
{
  const Domain box = test::to_domain(test::tet_box(3, 3, 3));
  Points points(5, 3);
  points << 0.5, 0.4, 1.01, // a little outside
    0.5, 0.5, 7.0, // far
    0.25, 0.5, 0.5, // inside
    0.0, 0.0, 1.0, // a vertex
    0.0, std::nan(""), 0.0;
  ExecutionContext context;
  Weights result;
  TransferCounts counts;
  const Status status =
    transfer(context, box, linear_values(box.points), points, {}, result, counts);
  ASSERT_TRUE(status.ok());
  EXPECT_EQ(counts.nearest, 1);
  EXPECT_EQ(counts.misses, 2);
  EXPECT_EQ(counts.barycentric, 1);
  EXPECT_EQ(counts.exact, 1);
  EXPECT_STREQ(transfer_word(counts), "mixed");
  EXPECT_EQ(status.warnings.size(), 1u);
  EXPECT_NEAR(counts.largest_distance, 6.0, 1e-12);
  Points moved = points.topRows(2);
  moved(0, 2) = moved(1, 2) = 1.0;
  EXPECT_LT((result.topRows(2) - linear_values(moved)).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_EQ(result.row(4), Eigen::RowVector2d::Zero());
}

TEST(Transfer, TheSearchAgreesWithLookingAtEveryElement)
{
  const Domain surface = test::to_domain(test::torus(20, 10, 1.0, 0.4));
  TetMesh box = test::tet_box(3, 4, 3);
  test::Random random(4);
  for (Index v = 0; v < box.points.rows(); ++v)
  {
    box.points.row(v) += 0.05 * random.in_box(-Vec3::Ones(), Vec3::Ones()).transpose();
  }
  const Domain volume = test::to_domain(box);
  for (const Domain* domain : { &surface, &volume })
  {
    const SimplexLocator locator = domain->is_volume()
      ? SimplexLocator(domain->points, domain->tets)
      : SimplexLocator(domain->points, domain->triangles);
    for (int i = 0; i < 300; ++i)
    {
      const Vec3 p = random.in_box(Vec3::Constant(-1.5), Vec3::Constant(1.5));
      double nearest = 1e300;
      for (Index e = 0; e < domain->element_count(); ++e)
      {
        const Index* ids = domain->element(e);
        const auto at = [&](int k) { return Vec3(domain->points.row(ids[k])); };
        nearest = std::min(nearest,
          domain->is_volume() ? nearest_in_tet(p, at(0), at(1), at(2), at(3)).distance
                              : nearest_in_triangle(p, at(0), at(1), at(2)).distance);
      }
      const SimplexLocation found = locator.locate(p);
      EXPECT_EQ(found.distance, nearest);
      Vec3 q = Vec3::Zero();
      for (int k = 0; k < domain->corners(); ++k)
      {
        q +=
          found.barycentric[k] * domain->points.row(domain->element(found.element)[k]).transpose();
        EXPECT_GE(found.barycentric[k], 0.0);
      }
      EXPECT_NEAR((q - p).norm(), nearest, 1e-12);
    }
  }
}

TEST(Transfer, BadInputsAndCancel)
{
  const Domain box = test::to_domain(test::tet_box(2, 2, 2));
  ExecutionContext context;
  Weights result;
  TransferCounts counts;
  const Weights values = linear_values(box.points);
  EXPECT_EQ(transfer(context, Domain(), values, box.points, {}, result, counts).code,
    StatusCode::invalid_input);
  EXPECT_EQ(transfer(context, box, Weights(values.topRows(3)), box.points, {}, result, counts).code,
    StatusCode::invalid_input);
  context.request_cancel();
  EXPECT_EQ(
    transfer(context, box, values, box.points, {}, result, counts).code, StatusCode::canceled);
}
