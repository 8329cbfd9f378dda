// Links: short connections between the parts of a surface. They are compared with a minimum
// spanning forest over all pairs of triangles.
#include "surface/part_links.h"

#include "base/disjoint_sets.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

using namespace bindpose;
using test::box;

namespace
{
using Corners = std::array<Vec3, 3>;

Vec3 random_point(std::mt19937& random, double size)
{
  std::uniform_real_distribution<double> along(0.0, size);
  const double x = along(random), y = along(random);
  return { x, y, along(random) };
}

Corners corners_of_triangle(const TriangleMesh& mesh, Index f)
{
  return { mesh.points.row(mesh.triangles(f, 0)), mesh.points.row(mesh.triangles(f, 1)),
    mesh.points.row(mesh.triangles(f, 2)) };
}

/// A mesh that is made of several parts.
struct Shape
{
  TriangleMesh mesh;
  std::vector<Index> parts; ///< #F: id of the part that contains the triangle
  Index count = 0;

  void add(const TriangleMesh& part)
  {
    this->mesh = this->count == 0 ? part : test::join(this->mesh, part);
    this->parts.resize(static_cast<std::size_t>(this->mesh.triangles.rows()), this->count++);
  }
};

std::vector<PartLink> links_of(
  const Shape& shape, const std::vector<char>& constrained, const PartLinkOptions& options)
{
  ExecutionContext context;
  std::vector<PartLink> links;
  const Status status = link_parts(
    context, shape.mesh.points, shape.mesh.triangles, shape.parts, constrained, options, links);
  EXPECT_TRUE(status.ok()) << status.message;
  return links;
}

/// Return the total length of the shortest links that connect every part to a fixed part
/// (`constrained`). The links are found among all pairs of triangles.
double shortest_forest(const Shape& shape, const std::vector<char>& constrained)
{
  struct Edge
  {
    double length;
    Index a, b;
  };
  std::vector<Edge> edges;
  for (Index f = 0; f < shape.mesh.triangles.rows(); ++f)
  {
    for (Index g = 0; g < f; ++g)
    {
      if (shape.parts[f] != shape.parts[g])
      {
        std::array<Vec3, 2> positions;
        edges.push_back({ nearest_points(corners_of_triangle(shape.mesh, f),
                            corners_of_triangle(shape.mesh, g), positions),
          shape.parts[f], shape.parts[g] });
      }
    }
  }
  std::sort(
    edges.begin(), edges.end(), [](const Edge& x, const Edge& y) { return x.length < y.length; });
  DisjointSets<Index> sets(constrained.size() + 1); // the last set represents the fixed parts
  for (std::size_t p = 0; p < constrained.size(); ++p)
  {
    if (constrained[p])
    {
      sets.unite(static_cast<Index>(p), static_cast<Index>(constrained.size()));
    }
  }
  double total = 0.0;
  for (const Edge& edge : edges)
  {
    if (sets.find(edge.a) != sets.find(edge.b))
    {
      sets.unite(edge.a, edge.b);
      total += edge.length;
    }
  }
  return total;
}
} // namespace

TEST(PartLinks, NearestPlacesAreNearerThanAllSamples)
{
  std::mt19937 random(5);
  int crossing = 0;
  for (int round = 0; round < 200; ++round)
  {
    Corners a, b;
    for (int k = 0; k < 3; ++k)
    {
      a[k] = random_point(random, 1.0);
      b[k] = random_point(random, 1.0) + Vec3(round % 2, 0, 0);
    }
    if (round % 10 == 4)
    {
      b[2] = 0.5 * (b[0] + b[1]); // makes the triangle degenerate
    }
    std::array<Vec3, 2> positions;
    const double distance = nearest_points(a, b, positions);
    EXPECT_NEAR((positions[0] - positions[1]).norm(), distance, 1e-12);
    crossing += distance == 0.0;
    constexpr int steps = 24;
    double nearest = 1e300;
    std::vector<Vec3> on_b;
    const auto for_each_sample = [&](const Corners& t, const auto& call)
    {
      for (int i = 0; i <= steps; ++i)
      {
        for (int j = 0; i + j <= steps; ++j)
        {
          call(Vec3(t[0] + (i * (t[1] - t[0]) + j * (t[2] - t[0])) / steps));
        }
      }
    };
    for_each_sample(b, [&](const Vec3& q) { on_b.push_back(q); });
    for_each_sample(a,
      [&](const Vec3& p)
      {
        for (const Vec3& q : on_b)
        {
          nearest = std::min(nearest, (p - q).norm());
        }
      });
    EXPECT_LE(distance, nearest + 1e-12);
    EXPECT_GE(distance, nearest - 0.15) << "samples are at most this far from any place";
    std::array<Vec3, 2> back;
    EXPECT_NEAR(nearest_points(b, a, back), distance, 1e-12);
  }
  EXPECT_GT(crossing, 10);
}

TEST(PartLinks, AreTheShortestForestOfAllPairs)
{
  for (const unsigned seed : { 1U, 2U, 3U, 4U })
  {
    std::mt19937 random(seed);
    Shape shape;
    for (int p = 0; p < 40; ++p)
    {
      const Vec3 lower = random_point(random, 10.0);
      shape.add(box(lower, lower + Vec3::Constant(0.2) + random_point(random, 0.5)));
    }
    std::vector<char> constrained(40, 0);
    constrained[seed] = constrained[7 * seed] = 1;
    const std::vector<PartLink> links = links_of(shape, constrained, { 0.0, 1.0 });
    double total = 0.0;
    DisjointSets<Index> sets(constrained.size());
    for (const PartLink& link : links)
    {
      total += (link.positions[0] - link.positions[1]).norm();
      sets.unite(shape.parts[link.triangles[0]], shape.parts[link.triangles[1]]);
      for (int k = 0; k < 2; ++k)
      {
        std::array<Vec3, 2> on;
        const Vec3& position = link.positions[k];
        EXPECT_LT(nearest_points({ position, position, position },
                    corners_of_triangle(shape.mesh, link.triangles[k]), on),
          1e-12);
      }
    }
    EXPECT_NEAR(total, shortest_forest(shape, constrained), 1e-9);
    for (Index p = 0; p < 40; ++p)
    {
      EXPECT_TRUE(sets.find(p) == sets.find(static_cast<Index>(seed)) ||
        sets.find(p) == sets.find(static_cast<Index>(7 * seed)))
        << p;
    }
  }
}

TEST(PartLinks, LeadToEverythingThatALoosePartTouches)
{
  // A plate is 0.01 above four legs. A fifth, shorter leg is 0.11 below the plate.
  Shape shape;
  shape.add(box(Vec3(0, 0, 1.01), Vec3(4, 4, 1.1)));
  for (const Vec3& at : { Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 3, 0), Vec3(3, 3, 0) })
  {
    shape.add(box(at, at + Vec3(1, 1, 1)));
  }
  shape.add(box(Vec3(1.5, 1.5, 0), Vec3(2.5, 2.5, 0.9)));
  const std::vector<PartLink> links = links_of(shape, { 0, 1, 1, 1, 1, 1 }, { 0.02, 0.5 });
  std::set<Index> linked;
  for (const PartLink& link : links)
  {
    EXPECT_LE((link.positions[0] - link.positions[1]).norm(), 0.02);
    linked.insert(shape.parts[link.triangles[0]]);
    linked.insert(shape.parts[link.triangles[1]]);
  }
  EXPECT_EQ(linked, (std::set<Index>{ 0, 1, 2, 3, 4 }));
  EXPECT_GE(links.size(), 8U) << "several below every corner of the plate";
  EXPECT_LE(links.size(), 100U) << "about one in each cube of the spacing";
  // Fixed parts are not linked to each other, even if all parts are fixed.
  EXPECT_TRUE(links_of(shape, { 1, 1, 1, 1, 1, 1 }, { 0.02, 0.5 }).empty());
}

TEST(PartLinks, LeaveOutTrianglesOfNoPart)
{
  Shape shape;
  shape.add(box(Vec3(0, 0, 0), Vec3(1, 1, 1)));
  shape.add(box(Vec3(1.4, 0, 0), Vec3(1.6, 1, 1)));
  shape.add(box(Vec3(3, 0, 0), Vec3(4, 1, 1)));
  std::replace(shape.parts.begin(), shape.parts.end(), Index(1), Index(-1));
  const std::vector<PartLink> links = links_of(shape, { 1, 1, 0 }, { 0.0, 1.0 });
  ASSERT_EQ(links.size(), 1U);
  EXPECT_NEAR((links[0].positions[0] - links[0].positions[1]).norm(), 2.0, 1e-12);
}

TEST(PartLinks, RefusesWhatItCannotUse)
{
  Shape shape;
  shape.add(box(Vec3(0, 0, 0), Vec3(1, 1, 1)));
  ExecutionContext context;
  std::vector<PartLink> links;
  const auto code = [&](const std::vector<char>& constrained, const PartLinkOptions& options)
  {
    return link_parts(
      context, shape.mesh.points, shape.mesh.triangles, shape.parts, constrained, options, links)
      .code;
  };
  EXPECT_EQ(code({ 0 }, { 0.0, 1.0 }), StatusCode::invalid_input);
  EXPECT_EQ(code({ 1 }, { 0.0, 0.0 }), StatusCode::invalid_input);
  EXPECT_EQ(code({ 1 }, { -1.0, 1.0 }), StatusCode::invalid_input);
  EXPECT_EQ(code({ 1 }, { 0.0, 1.0 }), StatusCode::ok);
}
