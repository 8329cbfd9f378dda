// Openings that are covered by another part of the surface: boxes without a bottom stand on a
// plate.
#include "surface/covered_openings.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <set>

using namespace bindpose;
using test::box;

namespace
{
/// Return a box without the faces at the given values of z.
TriangleMesh open_box(const Vec3& lower, const Vec3& upper, const std::set<double>& open)
{
  TriangleMesh result = box(lower, upper);
  Index kept = 0;
  for (Index f = 0; f < result.triangles.rows(); ++f)
  {
    std::set<double> z;
    for (int k = 0; k < 3; ++k)
    {
      z.insert(result.points(result.triangles(f, k), 2));
    }
    if (z.size() > 1 || open.count(*z.begin()) == 0)
    {
      const Eigen::RowVector3<Index> triangle = result.triangles.row(f);
      result.triangles.row(kept++) = triangle;
    }
  }
  result.triangles.conservativeResize(kept, 3);
  return result;
}

/// Find the covered openings of two parts.
CoveredOpenings openings_of(
  const TriangleMesh& a, const TriangleMesh& b, const PartLinkOptions& options, int threads = 1)
{
  const TriangleMesh shape = test::join(a, b);
  std::vector<Index> parts(static_cast<std::size_t>(shape.triangles.rows()), 1);
  std::fill(parts.begin(), parts.begin() + a.triangles.rows(), Index(0));
  ExecutionContext context;
  context.set_threads(threads);
  CoveredOpenings result;
  const Status status =
    find_covered_openings(context, shape.points, shape.triangles, parts, options, result);
  EXPECT_TRUE(status.ok()) << status.message;
  for (const PartLink& link : result.links)
  {
    EXPECT_LE((link.positions[0] - link.positions[1]).norm(), options.touch_distance);
    EXPECT_NE(parts[link.triangles[0]], parts[link.triangles[1]]);
    for (int k = 0; k < 2; ++k)
    {
      const auto corner = [&](int c) -> Vec3
      { return shape.points.row(shape.triangles(link.triangles[k], c)); };
      std::array<Vec3, 2> nearest;
      const Vec3& p = link.positions[k];
      EXPECT_LT(nearest_points({ p, p, p }, { corner(0), corner(1), corner(2) }, nearest), 1e-12);
    }
  }
  return result;
}

const TriangleMesh plate = box(Vec3(-4, -4, -1), Vec3(4, 4, 0));
constexpr double touch_distance = 0.02;
} // namespace

TEST(CoveredOpenings, ThePlateBelowABoxCoversItsBottom)
{
  const TriangleMesh knob = open_box(Vec3(-1, -1, 0.01), Vec3(1, 1, 1), { 0.01 });
  const CoveredOpenings found = openings_of(plate, knob, { touch_distance, 0.5 });
  EXPECT_EQ(found.count, 1);
  // The opening has four edges of length 2. Each edge has five samples, including its ends, so
  // corners are sampled twice.
  EXPECT_EQ(found.links.size(), 20U);
  std::set<std::array<double, 3>> positions;
  for (const PartLink& link : found.links)
  {
    EXPECT_DOUBLE_EQ(link.positions[0][2], 0.01);
    EXPECT_DOUBLE_EQ(link.positions[1][2], 0.0);
    positions.insert({ link.positions[0][0], link.positions[0][1], link.positions[0][2] });
  }
  EXPECT_EQ(positions.size(), 16U);
}

TEST(CoveredOpenings, AnOpeningMustBeCoveredCompletely)
{
  const auto count = [](const TriangleMesh& part) {
    return openings_of(plate, part, { touch_distance, 0.5 }).count;
  };
  EXPECT_EQ(count(open_box(Vec3(-1, -1, 0.03), Vec3(1, 1, 1), { 0.03 })), 0) << "too high";
  EXPECT_EQ(count(open_box(Vec3(0, 0, 0.01), Vec3(0.1, 0.1, 0.1), { 0.01 })), 0)
    << "smaller than the gap times 50";
  EXPECT_EQ(count(open_box(Vec3(3, -1, 0), Vec3(5, 1, 1), { 0 })), 0)
    << "beyond the edge of the plate";
  EXPECT_EQ(count(open_box(Vec3(-1, -1, 0), Vec3(1, 1, 1), { 1 })), 0) << "open at the top";
  EXPECT_EQ(count(box(Vec3(-1, -1, 0), Vec3(1, 1, 1))), 0) << "closed";
  const TriangleMesh tube = open_box(Vec3(-1, -1, 0), Vec3(1, 1, 1), { 0, 1 });
  EXPECT_EQ(count(tube), 1) << "two openings, of which one is covered";
}

TEST(CoveredOpenings, DoNotDependOnTheNumberOfThreads)
{
  const TriangleMesh knob = open_box(Vec3(-1, -1, 0.01), Vec3(1, 1, 1), { 0.01 });
  const CoveredOpenings one = openings_of(plate, knob, { touch_distance, 0.01 }, 1);
  const CoveredOpenings four = openings_of(plate, knob, { touch_distance, 0.01 }, 4);
  ASSERT_EQ(one.links.size(), four.links.size());
  for (std::size_t i = 0; i < one.links.size(); ++i)
  {
    EXPECT_EQ(one.links[i].positions, four.links[i].positions);
    EXPECT_EQ(one.links[i].triangles, four.links[i].triangles);
  }
}

TEST(CoveredOpenings, RefuseInvalidOptions)
{
  ExecutionContext context;
  CoveredOpenings result;
  const std::vector<Index> parts(static_cast<std::size_t>(plate.triangles.rows()), 0);
  const auto code = [&](const PartLinkOptions& options)
  {
    return find_covered_openings(context, plate.points, plate.triangles, parts, options, result)
      .code;
  };
  EXPECT_EQ(code({ -1.0, 1.0 }), StatusCode::invalid_input);
  EXPECT_EQ(code({ 1.0, 0.0 }), StatusCode::invalid_input);
  EXPECT_EQ(code({ 1.0, 1.0 }), StatusCode::ok);
}
