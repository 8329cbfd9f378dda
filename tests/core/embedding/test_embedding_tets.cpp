// Embeddings: regular tets that contain a surface. Nodes of the lattice are duplicated, so that
// parts of the surface that are close but not connected share no vertex.
#include "embedding/embedding_tets.h"

#include "surface/surface_repair.h"
#include "tets/tet_quality.h"

#include "core/fuzz/hostile_surfaces.h"
#include "support/demo_meshes.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <queue>
#include <set>
#include <thread>

using namespace bindpose;
using test::box;

namespace
{
EmbeddingTets embed_mesh(const TriangleMesh& mesh, Index resolution = 0, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  const WindingNumber winding(mesh.points, mesh.triangles);
  EmbeddingOptions options;
  options.resolution = resolution;
  EmbeddingTets result;
  const Status status =
    embed_surface(context, mesh.points, mesh.triangles, winding, options, result);
  EXPECT_TRUE(status.ok()) << status.message;
  return result;
}

/// Return the vertices of the tets to which the chosen points are bound. A point is chosen if
/// chosen(point) is true.
template <typename Chosen>
std::set<Index> vertices_of(const EmbeddingTets& result, const Points& points, const Chosen& chosen)
{
  std::set<Index> vertices;
  for (Index i = 0; i < points.rows(); ++i)
  {
    if (chosen(Vec3(points.row(i))))
    {
      const Index t = result.binding.tets[i];
      vertices.insert(result.mesh.tets.row(t).begin(), result.mesh.tets.row(t).end());
    }
  }
  return vertices;
}

/// Return the length of the shortest path along edges from a set of vertices to each vertex.
std::vector<double> distances(const TetMesh& mesh, const std::set<Index>& from)
{
  std::vector<std::vector<Index>> neighbors(static_cast<std::size_t>(mesh.points.rows()));
  for (Index t = 0; t < mesh.tets.rows(); ++t)
  {
    for (int k = 1; k < 16; ++k)
    {
      if (k / 4 != k % 4)
      {
        neighbors[mesh.tets(t, k / 4)].push_back(mesh.tets(t, k % 4));
      }
    }
  }
  std::vector<double> distance(neighbors.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const Index v : from)
  {
    distance[v] = 0.0;
    queue.emplace(0.0, v);
  }
  while (!queue.empty())
  {
    const auto [d, v] = queue.top();
    queue.pop();
    for (const Index w : neighbors[v])
    {
      const double to = d + (mesh.points.row(v) - mesh.points.row(w)).norm();
      if (d <= distance[v] && to < distance[w])
      {
        distance[w] = to;
        queue.emplace(to, w);
      }
    }
  }
  return distance;
}

/// Expect the invariants that every embedding has.
void expect_valid_embedding(const TriangleMesh& surface, const EmbeddingTets& result)
{
  const TetMesh& mesh = result.mesh;
  ASSERT_GT(mesh.tets.rows(), 0);
  ASSERT_TRUE(check_mesh(mesh.points, mesh.tets).ok());
  // Where parts of the surface touch, the boundary may be non-manifold.
  constexpr bool may_branch = true;
  const Status status = check_tets(mesh.points, mesh.tets, may_branch);
  EXPECT_TRUE(status.ok()) << status.message;
  EXPECT_NEAR(measure_tets(mesh.points, mesh.tets).min_dihedral_angle, 60.0, 1e-6);
  const Components components = connected_components(mesh.points.rows(), mesh.tets);
  EXPECT_EQ(
    std::count(components.component_of_vertex.begin(), components.component_of_vertex.end(), -1),
    0);
  EXPECT_EQ(components.count, result.components);
  ASSERT_EQ(result.inside_fractions.size(), mesh.tets.rows());
  EXPECT_GE(result.inside_fractions.minCoeff(), 0.0);
  EXPECT_LE(result.inside_fractions.maxCoeff(), 1.0);
  // All points that triangles use are bound, and their barycentric coordinates reproduce their
  // positions.
  const PointBinding& binding = result.binding;
  ASSERT_EQ(static_cast<Index>(binding.tets.size()), surface.points.rows());
  ASSERT_EQ(binding.coordinates.rows(), surface.points.rows());
  const double diagonal = bounding_box(surface.points, surface.triangles).diagonal();
  for (Index i = 0; i < surface.triangles.size(); ++i)
  {
    const Index v = surface.triangles.data()[i];
    const Vec3 p = surface.points.row(v);
    const Index t = binding.tets[v];
    ASSERT_TRUE(t >= 0 && t < mesh.tets.rows());
    Vec3 rest = Vec3::Zero();
    for (int k = 0; k < 4; ++k)
    {
      ASSERT_GE(binding.coordinates(v, k), -1e-12);
      rest += binding.coordinates(v, k) * (mesh.points.row(mesh.tets(t, k)).transpose() - p);
    }
    ASSERT_LE(rest.norm(), 1e-12 * std::max(diagonal, result.spacing)) << v;
    ASSERT_NEAR(binding.coordinates.row(v).sum(), 1.0, 1e-14);
  }
  // All three corners of a triangle are bound to tets of the same component.
  for (Index f = 0; f < surface.triangles.rows(); ++f)
  {
    const auto component = [&](int k)
    { return components.component_of_vertex[mesh.tets(binding.tets[surface.triangles(f, k)], 0)]; };
    ASSERT_TRUE(component(0) == component(1) && component(1) == component(2)) << f;
  }
}

/// Report whether any tet of the component contains the point, by brute force.
bool is_covered(const EmbeddingTets& result, const Components& components, Index component,
  const Vec3& p, double tolerance)
{
  const TetMesh& mesh = result.mesh;
  for (Index t = 0; t < mesh.tets.rows(); ++t)
  {
    const Vec3 a = mesh.points.row(mesh.tets(t, 0));
    if (components.component_of_vertex[mesh.tets(t, 0)] != component ||
      (a - p).norm() > 1.01 * result.spacing)
    {
      continue;
    }
    Eigen::Matrix3d m;
    for (int k = 0; k < 3; ++k)
    {
      m.col(k) = (mesh.points.row(mesh.tets(t, k + 1)).transpose() - a) / result.spacing;
    }
    const Vec3 x = m.inverse() * ((p - a) / result.spacing);
    if (x.minCoeff() >= -tolerance && x.sum() <= 1.0 + tolerance)
    {
      return true;
    }
  }
  return false;
}

void expect_covered(const TriangleMesh& surface, const EmbeddingTets& result, int samples)
{
  const Components components = connected_components(result.mesh.points.rows(), result.mesh.tets);
  test::Random random(5);
  for (int i = 0; i < samples; ++i)
  {
    const Index f = random.below(surface.triangles.rows());
    double s = random.uniform(), r = random.uniform();
    s = s + r > 1.0 ? 1.0 - s : s;
    r = s + r > 1.0 ? 1.0 - s : r;
    const Vec3 a = surface.points.row(surface.triangles(f, 0));
    const Vec3 b = surface.points.row(surface.triangles(f, 1));
    const Vec3 c = surface.points.row(surface.triangles(f, 2));
    const Index t = result.binding.tets[surface.triangles(f, 0)];
    EXPECT_TRUE(is_covered(result, components,
      components.component_of_vertex[result.mesh.tets(t, 0)], a + s * (b - a) + r * (c - a), 1e-6));
  }
}

/// Return a palm with four fingers as a closed surface, made of the cells of a grid. The fingers
/// are 0.2 wide, `gap` apart, and extend from y = 0 to y = 2. The palm is below y = 0.
TriangleMesh fork(double gap)
{
  std::vector<double> xs;
  for (int finger = 0; finger < 4; ++finger)
  {
    xs.push_back(finger * (0.2 + gap));
    xs.push_back(xs.back() + 0.2);
  }
  const std::vector<double> ys{ -0.6, 0.0, 2.0 };
  const std::vector<double> zs{ 0.0, 0.3 };
  const auto solid = [&](int i, int j)
  { return i >= 0 && i < 7 && ((j == 0) || (j == 1 && i % 2 == 0)); };
  TriangleMesh mesh;
  const auto id = [](int i, int j, int k) { return static_cast<Index>((k * 3 + j) * 8 + i); };
  mesh.points.resize(48, 3);
  for (int k = 0; k < 2; ++k)
  {
    for (int j = 0; j < 3; ++j)
    {
      for (int i = 0; i < 8; ++i)
      {
        mesh.points.row(id(i, j, k)) << xs[i], ys[j], zs[k];
      }
    }
  }
  std::vector<std::array<Index, 3>> triangles;
  const auto quad = [&](Index a, Index b, Index c, Index d)
  {
    triangles.push_back({ a, b, c });
    triangles.push_back({ a, c, d });
  };
  for (int j = 0; j < 2; ++j)
  {
    for (int i = 0; i < 7; ++i)
    {
      if (!solid(i, j))
      {
        continue;
      }
      quad(id(i, j, 0), id(i, j + 1, 0), id(i + 1, j + 1, 0), id(i + 1, j, 0));
      quad(id(i, j, 1), id(i + 1, j, 1), id(i + 1, j + 1, 1), id(i, j + 1, 1));
      if (!solid(i - 1, j))
      {
        quad(id(i, j, 0), id(i, j, 1), id(i, j + 1, 1), id(i, j + 1, 0));
      }
      if (!solid(i + 1, j))
      {
        quad(id(i + 1, j, 0), id(i + 1, j + 1, 0), id(i + 1, j + 1, 1), id(i + 1, j, 1));
      }
      if (j == 0)
      {
        quad(id(i, 0, 0), id(i + 1, 0, 0), id(i + 1, 0, 1), id(i, 0, 1));
      }
      if (j == 1 || !solid(i, 1))
      {
        quad(id(i, j + 1, 0), id(i, j + 1, 1), id(i + 1, j + 1, 1), id(i + 1, j + 1, 0));
      }
    }
  }
  mesh.triangles.resize(static_cast<Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    mesh.triangles.row(static_cast<Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  }
  return mesh;
}
} // namespace

TEST(EmbeddingTets, ABallIsOnePieceWithoutCopies)
{
  for (const Index resolution : { 0, 5, 9, 20 })
  {
    const TriangleMesh ball = test::sphere(4);
    const EmbeddingTets result = embed_mesh(ball, resolution);
    expect_valid_embedding(ball, result);
    EXPECT_EQ(result.components, 1);
    EXPECT_EQ(result.duplicated_nodes, 0);
    EXPECT_EQ(result.branching_facets, 0);
    EXPECT_EQ(result.lattice_tets, result.mesh.tets.rows());
    EXPECT_EQ(test::euler_characteristic(result.mesh), 1);
    EXPECT_TRUE(count_edges(boundary_triangles(result.mesh.tets)).closed);
  }
}

TEST(EmbeddingTets, AnyConvexBodyHasNoCopies)
{
  test::Random random(7);
  for (int round = 0; round < 6; ++round)
  {
    TriangleMesh body = round % 2 == 0 ? test::cube() : test::sphere(2);
    // Flatten or stretch the body. It may be much thinner than a lattice cube.
    const Vec3 scale = random.in_box(Vec3::Constant(0.02), Vec3::Ones());
    const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(random.uniform(0.0, 3.0), Vec3(1.0, 2.0, 3.0).normalized())
        .toRotationMatrix();
    body.points = (body.points * scale.asDiagonal() * turn).eval();
    const EmbeddingTets result = embed_mesh(body, 12);
    expect_valid_embedding(body, result);
    EXPECT_EQ(result.components, 1);
    EXPECT_EQ(result.duplicated_nodes, 0) << scale.transpose();
  }
}

TEST(EmbeddingTets, TopologyIsTheSurfaces)
{
  const TriangleMesh torus = test::torus(48, 24, 1.0, 0.4);
  EXPECT_EQ(test::euler_characteristic(embed_mesh(torus).mesh), 0);
  const TriangleMesh shell = test::join(test::sphere(3), test::flipped(test::sphere(3, 0.5)));
  EXPECT_EQ(test::euler_characteristic(embed_mesh(shell).mesh), 2) << "a ball with a cavity";
  // The tube of this torus has the diameter 0.4. At resolution 20 this is about three lattice
  // cubes, at resolution 5 less than one cube. The tets must always have the topology of a ring.
  const TriangleMesh ring = test::torus(48, 24, 1.0, 0.2);
  for (const Index resolution : { 20, 5 })
  {
    EXPECT_EQ(test::euler_characteristic(embed_mesh(ring, resolution).mesh), 0) << resolution;
  }
}

TEST(EmbeddingTets, OpenBoxAboveAPlateIsSeparate)
{
  // The box has no bottom. The winding number is above 0.5 inside the box. It decreases to less
  // than 0.5 between the opening of the box and the plate.
  const TriangleMesh plate = box({ -3.3, -7.6, 0.0 }, { 3.3, 7.6, 0.2 });
  const TriangleMesh closed = box({ 3.0, -0.2, 0.3 }, { 3.25, 1.3, 0.6 });
  TriangleMesh open = closed;
  Index count = 0;
  for (Index f = 0; f < closed.triangles.rows(); ++f)
  {
    const auto is_low = [&](int k) { return closed.points(closed.triangles(f, k), 2) < 0.4; };
    if (!(is_low(0) && is_low(1) && is_low(2)))
    {
      open.triangles.row(count++) = closed.triangles.row(f);
    }
  }
  ASSERT_EQ(count, 10);
  open.triangles.conservativeResize(count, 3);
  const TriangleMesh both = test::join(plate, open);
  for (const Index resolution : { 26, 46, 50, 62 })
  {
    EXPECT_EQ(embed_mesh(both, resolution).components, 2) << resolution;
  }
}

TEST(EmbeddingTets, BarsThatAreNearShareNoVertex)
{
  for (const double gap : { 0.3, 0.01, 1e-6 }) // as a fraction of a lattice cube's size
  {
    constexpr Index resolution = 16;
    const double cube = 4.0 / 16.0;
    const TriangleMesh lower = box({ 0.0, 0.0, 0.0 }, { 4.0, 0.4, 0.5 });
    const TriangleMesh upper = box({ 0.0, 0.4 + gap * cube, 0.0 }, { 4.0, 0.8 + gap * cube, 0.5 });
    const TriangleMesh bars = test::join(lower, upper);
    const EmbeddingTets result = embed_mesh(bars, resolution);
    expect_valid_embedding(bars, result);
    expect_covered(bars, result, 100);
    EXPECT_EQ(result.components, 2) << gap;
    EXPECT_GT(result.duplicated_nodes, 0);
    const auto of_lower =
      vertices_of(result, bars.points, [](const Vec3& p) { return p[1] <= 0.4; });
    for (const Index v : vertices_of(result, bars.points, [](const Vec3& p) { return p[1] > 0.4; }))
    {
      EXPECT_EQ(of_lower.count(v), 0u);
    }
    // The volume of the inside equals the volume of the two bars, with a tolerance of 3 %.
    const Eigen::VectorXd volumes = tet_volumes(result.mesh.points, result.mesh.tets);
    EXPECT_NEAR(volumes.dot(result.inside_fractions), 2.0 * 4.0 * 0.4 * 0.5, 0.03 * 1.6);
  }
}

TEST(EmbeddingTets, SolidsThatOverlapAreOne)
{
  const TriangleMesh bars = test::join(
    box({ 0.0, 0.0, 0.0 }, { 4.0, 0.4, 0.5 }), box({ 0.0, 0.3, 0.0 }, { 4.0, 0.8, 0.5 }));
  const EmbeddingTets result = embed_mesh(bars, 16);
  expect_valid_embedding(bars, result);
  EXPECT_EQ(result.components, 1);
  EXPECT_EQ(result.duplicated_nodes, 0) << "their union is convex, and inner walls do not part";
}

TEST(EmbeddingTets, FingersAreConnectedThroughThePalmOnly)
{
  for (const double gap : { 0.05, 0.01 })
  {
    const TriangleMesh hand = fork(gap);
    ASSERT_TRUE(count_edges(hand.triangles).closed);
    const double volume = 0.3 * (4 * 0.2 * 2.0 + (0.8 + 3 * gap) * 0.6);
    ASSERT_NEAR(signed_volume(hand.points, hand.triangles), volume, 1e-12);
    const EmbeddingTets result = embed_mesh(hand, 20); // a lattice cube has the size 0.13
    expect_valid_embedding(hand, result);
    expect_covered(hand, result, 100);
    EXPECT_EQ(result.components, 1);
    EXPECT_EQ(test::euler_characteristic(result.mesh), 1);
    const auto tips = [&](int finger)
    {
      const double from = finger * (0.2 + gap);
      return vertices_of(result, hand.points,
        [=](const Vec3& p)
        { return p[1] > 1.9 && p[0] >= from - 1e-9 && p[0] <= from + 0.2 + 1e-9; });
    };
    const std::vector<double> path_length = distances(result.mesh, tips(0));
    for (int finger = 1; finger < 4; ++finger)
    {
      for (const Index v : tips(finger))
      {
        EXPECT_GT(path_length[v], 2.0 * 2.0 - 4.0 * result.spacing)
          << "down one finger, up the other";
      }
    }
    const Eigen::VectorXd volumes = tet_volumes(result.mesh.points, result.mesh.tets);
    EXPECT_NEAR(volumes.dot(result.inside_fractions), volume, 0.04 * volume);
  }
}

TEST(EmbeddingTets, InsideFractionsGiveTheVolume)
{
  const TriangleMesh shapes[] = { test::sphere(4), test::cube(), test::torus(64, 32, 1.0, 0.3),
    test::join(test::sphere(4), test::flipped(test::sphere(4, 0.8))),
    box({ 0.0, 0.0, 0.0 }, { 4.0, 3.0, 0.02 }) };
  for (const TriangleMesh& shape : shapes)
  {
    const double volume = signed_volume(shape.points, shape.triangles);
    const auto error = [&](Index resolution)
    {
      const EmbeddingTets result = embed_mesh(shape, resolution);
      const double sum =
        tet_volumes(result.mesh.points, result.mesh.tets).dot(result.inside_fractions);
      return std::abs(sum / volume - 1.0);
    };
    EXPECT_LT(error(8), 0.06);
    EXPECT_LT(error(16), 0.04);
    EXPECT_LT(error(24), 0.01);
  }
  // The cube is open: the inside ends at the opening, where the winding number is 0.5.
  const TriangleMesh open = test::open_cube();
  const EmbeddingTets result = embed_mesh(open, 16);
  expect_valid_embedding(open, result);
  EXPECT_NEAR(
    tet_volumes(result.mesh.points, result.mesh.tets).dot(result.inside_fractions), 8.0, 0.4);
}

TEST(EmbeddingTets, WhatEnclosesNothingIsHeldToo)
{
  TriangleMesh triangle = test::grid(1, 1);
  triangle.triangles.conservativeResize(1, 3);
  TriangleMesh needle = triangle;
  needle.points.row(1) << 1.0, 1e-14, 0.0;
  needle.points.row(3) << 0.5, 0.0, 0.0;
  TriangleMesh point = triangle;
  point.points.setConstant(3.0);
  for (const TriangleMesh& mesh : { triangle, needle, point, test::grid(3, 2),
         test::join(test::grid(2, 2), test::flipped(test::grid(2, 2))) })
  {
    for (const Index resolution : { 0, 7 })
    {
      const EmbeddingTets result = embed_mesh(mesh, resolution);
      expect_valid_embedding(mesh, result);
      expect_covered(mesh, result, 20);
      EXPECT_EQ(result.inside_fractions.maxCoeff(), 0.0);
    }
  }
  const EmbeddingTets result = embed_mesh(test::grid(1, 1));
  EXPECT_GT(result.mesh.tets.rows(), 15000);
  EXPECT_LT(result.mesh.tets.rows(), 60000);
}

TEST(EmbeddingTets, SheetsThatAreNearAreApart)
{
  // The sheets face each other: the winding number is -1 between them and 0 elsewhere.
  const TriangleMesh sheets = test::join(
    test::grid(4, 4), test::flipped(test::translated(test::grid(4, 4), Vec3(0.0, 0.0, 1e-4))));
  const EmbeddingTets result = embed_mesh(sheets, 10);
  expect_valid_embedding(sheets, result);
  EXPECT_EQ(result.components, 2);
  EXPECT_EQ(result.mesh.tets.rows(), 2 * result.lattice_tets);
}

TEST(EmbeddingTets, TheNumberOfTetsIsChosen)
{
  const TriangleMesh shapes[] = { test::sphere(3), test::cube(), test::torus(64, 16, 1.0, 0.02),
    test::grid(2, 2), box({ 0.0, 0.0, 0.0 }, { 100.0, 1.0, 1.0 }),
    test::join(test::sphere(3), test::sphere(3, 1.0, Vec3(50.0, 0.0, 0.0))),
    test::sphere(8) }; // 1.3 million triangles, more than maximum_added_pieces in lattice_cover.cpp
  for (const TriangleMesh& shape : shapes)
  {
    SCOPED_TRACE(shape.triangles.rows());
    const EmbeddingTets result = embed_mesh(shape);
    EXPECT_GE(result.lattice_tets, 15000);
    EXPECT_LE(result.mesh.tets.rows(), 60000);
  }
}

TEST(EmbeddingTets, UncleanSurfaces)
{
  TriangleMesh soup = test::sphere(3); // each triangle has its own corners
  {
    Points points(3 * soup.triangles.rows(), 3);
    for (Index i = 0; i < points.rows(); ++i)
    {
      points.row(i) = soup.points.row(soup.triangles.data()[i]);
      soup.triangles.data()[i] = i;
    }
    soup.points = points;
  }
  TriangleMesh doubled = test::cube();
  doubled.triangles.resize(24, 3);
  doubled.triangles << test::cube().triangles, test::cube().triangles;
  TriangleMesh wall = test::cube(); // three triangles share an edge
  wall.triangles.conservativeResize(14, 3);
  wall.triangles.row(12) << 0, 3, 7;
  wall.triangles.row(13) << 0, 7, 4;
  TriangleMesh holes = test::sphere(3);
  TriangleMesh flipped = test::sphere(3);
  for (Index f = 0; f < flipped.triangles.rows(); f += 5)
  {
    std::swap(flipped.triangles(f, 1), flipped.triangles(f, 2));
    holes.triangles.row(f) << 0, 0, 0; // degenerate
  }
  TriangleMesh stray = test::sphere(2); // a sphere with three unused points
  stray.points.conservativeResize(stray.points.rows() + 3, 3);
  stray.points.bottomRows(3) << 0.1, 0.0, 0.0, 1e9, 0.0, 0.0,
    std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0;
  const std::pair<TriangleMesh, Index> cases[] = { { soup, 1 }, { doubled, 1 }, { wall, 1 },
    { holes, 1 }, { flipped, 1 }, { stray, 1 },
    { test::join(test::sphere(3), test::translated(test::sphere(3), Vec3(1.0, 0.0, 0.0))), 1 },
    { test::join(test::torus(32, 16, 1.0, 0.4), test::sphere(3, 0.7)), 1 },
    { test::join(test::sphere(3), test::sphere(3, 0.5)), 1 },
    { test::join(test::cube(), test::translated(test::cube(), Vec3(2.000001, 0.0, 0.0))), 2 },
    { test::join(test::sphere(3), test::translated(test::grid(2, 2), Vec3(1.01, 0.0, 0.0))), 2 } };
  int number = 0;
  for (const auto& [mesh, components] : cases)
  {
    SCOPED_TRACE(number++);
    for (const Index resolution : { 6, 15 })
    {
      const EmbeddingTets result = embed_mesh(mesh, resolution);
      expect_valid_embedding(mesh, result);
      expect_covered(mesh, result, 50);
      EXPECT_EQ(result.components, components);
    }
  }
  const EmbeddingTets result = embed_mesh(stray, 10);
  const Index last = stray.points.rows() - 1;
  EXPECT_GE(result.binding.tets[last - 2], 0) << "inside";
  EXPECT_EQ(result.binding.tets[last - 1], -1);
  EXPECT_EQ(result.binding.tets[last], -1);
}

TEST(EmbeddingTets, HostileSurfaces)
{
  test::Random random(11);
  for (int round = 0; round < 60; ++round)
  {
    SCOPED_TRACE(round);
    const TriangleMesh mesh = round % 2 == 0 ? test::hostile_surface(random, 200)
                                             : test::hostile_closed_surface(random, 200);
    if (mesh.triangles.rows() == 0)
    {
      continue;
    }
    const EmbeddingTets result = embed_mesh(mesh, 3 + random.below(10));
    expect_valid_embedding(mesh, result);
    expect_covered(mesh, result, 10);
  }
}

TEST(EmbeddingTets, HostilePlaces)
{
  test::Random random(12);
  for (int round = 0; round < 30; ++round)
  {
    SCOPED_TRACE(round);
    const TriangleMesh mesh = test::randomly_transformed(random, test::hostile_surface(random, 60));
    if (mesh.triangles.rows() == 0)
    {
      continue;
    }
    const double size = bounding_box(mesh.points, mesh.triangles).size().maxCoeff();
    if (size > 1e-90 && size < 1e90) // the volumes are in the range of double
    {
      expect_valid_embedding(mesh, embed_mesh(mesh, 6));
      continue;
    }
    ExecutionContext context;
    EmbeddingTets result;
    const WindingNumber winding(mesh.points, mesh.triangles);
    const Status status =
      embed_surface(context, mesh.points, mesh.triangles, winding, EmbeddingOptions(), result);
    EXPECT_TRUE(status.ok() || status.code == StatusCode::invalid_input);
    EXPECT_EQ(status.ok(), result.mesh.tets.rows() > 0);
  }
  for (const double scale : { 1e-9, 1e9 })
  {
    TriangleMesh mesh = test::torus(24, 12, 1.0, 0.4);
    mesh.points *= scale;
    const EmbeddingTets result = embed_mesh(mesh);
    expect_valid_embedding(mesh, result);
    EXPECT_EQ(result.components, 1);
  }
  TriangleMesh far = test::sphere(3);
  far.points.array() += 1e9;
  expect_valid_embedding(far, embed_mesh(far, 10));
}

TEST(EmbeddingTets, RealSurfaces)
{
  for (const char* name : { "hand.off", "elephant-with-holes.off", "cow.off" })
  {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = test::demo_mesh(name);
    if (mesh.triangles.rows() == 0)
    {
      continue;
    }
    const EmbeddingTets result = embed_mesh(mesh);
    expect_valid_embedding(mesh, result);
    EXPECT_GE(result.lattice_tets, 15000);
    EXPECT_LE(result.mesh.tets.rows(), 60000);
    EXPECT_LT(result.branching_facets, result.mesh.tets.rows() / 50);
  }
}

TEST(EmbeddingTets, ScalesWithTheSurface)
{
  const TriangleMesh surface =
    test::join(test::torus(24, 12, 1.0, 0.4), test::sphere(3, 0.55, Vec3(0.02, 0.0, 0.0)));
  TriangleMesh large = surface;
  large.points *= 1024.0;
  const EmbeddingTets a = embed_mesh(surface), b = embed_mesh(large);
  EXPECT_EQ(a.mesh.tets, b.mesh.tets);
  EXPECT_EQ(Points(1024.0 * a.mesh.points), b.mesh.points);
  EXPECT_EQ(a.inside_fractions, b.inside_fractions);
  EXPECT_EQ(a.binding.tets, b.binding.tets);
  EXPECT_EQ(a.binding.coordinates, b.binding.coordinates);
}

TEST(EmbeddingTets, SameBitsForAnyNumberOfThreads)
{
  for (const TriangleMesh& surface : { fork(0.02), test::open_cube() })
  {
    const EmbeddingTets one = embed_mesh(surface, 0, 1), two = embed_mesh(surface, 0, 2);
    EXPECT_EQ(one.mesh.points, two.mesh.points);
    EXPECT_EQ(one.mesh.tets, two.mesh.tets);
    EXPECT_EQ(one.inside_fractions, two.inside_fractions);
    EXPECT_EQ(one.binding.tets, two.binding.tets);
    EXPECT_EQ(one.binding.coordinates, two.binding.coordinates);
  }
}

TEST(EmbeddingTets, BadInputIsNamed)
{
  const TriangleMesh mesh = test::cube();
  const WindingNumber winding(mesh.points, mesh.triangles);
  const auto message = [&](const TriangleMesh& surface, Index resolution, double threshold)
  {
    ExecutionContext context;
    EmbeddingOptions options;
    options.resolution = resolution;
    options.winding_threshold = threshold;
    EmbeddingTets result;
    const Status status =
      embed_surface(context, surface.points, surface.triangles, winding, options, result);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    EXPECT_EQ(result.mesh.tets.rows(), 0);
    return status.message;
  };
  EXPECT_EQ(message({}, 0, 0.5), "the surface has no triangles");
  EXPECT_EQ(message(mesh, -1, 0.5), "resolution must be from 0 to 1000 cubes, not -1");
  EXPECT_EQ(message(mesh, 1001, 0.5), "resolution must be from 0 to 1000 cubes, not 1001");
  EXPECT_EQ(message(mesh, 0, 0.0), "winding_threshold must be positive, not 0");
  EXPECT_EQ(message(mesh, 1000, 0.5),
    "the lattice would have more than 4000000 cubes; use a smaller resolution");
  TriangleMesh bad = mesh;
  bad.points(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message(bad, 0, 0.5), "");
  bad = mesh;
  bad.triangles(3, 1) = 99;
  EXPECT_NE(message(bad, 0, 0.5), "");
}

TEST(EmbeddingTets, CancelEndsSoon)
{
  const TriangleMesh mesh = test::sphere(5);
  const WindingNumber winding(mesh.points, mesh.triangles);
  for (const int after : { 0, 1, 5, 20, 60 })
  {
    // Cancel at the progress report number `after`. The number of reports depends on the speed of
    // the machine. A request at one of the last reports may therefore come too late.
    std::atomic<bool> stop{ after == 0 };
    std::atomic<bool> in_time{ after == 0 };
    std::atomic<int> signs{ 0 };
    ExecutionContext context(
      [&](double fraction, const std::string&)
      {
        if (!stop && ++signs >= after)
        {
          in_time = fraction < 0.9;
          stop = true;
        }
      },
      [&] { return stop.load(); });
    EmbeddingOptions options;
    options.resolution = 40;
    EmbeddingTets result;
    const Status status =
      embed_surface(context, mesh.points, mesh.triangles, winding, options, result);
    EXPECT_TRUE(status.ok() || status.code == StatusCode::canceled);
    EXPECT_TRUE(status.ok() || stop) << after;
    EXPECT_FALSE(status.ok() && in_time) << after;
    EXPECT_EQ(status.ok(), result.mesh.tets.rows() > 0);
  }
}

TEST(EmbeddingTets, ALinkConnectsWhatIsAtItsEnds)
{
  // A link is a segment that connects two parts of a surface. The mesh `apart` has two boxes at a
  // distance of 3, linked from a point on a face of one box to a corner of the other box. In the
  // mesh `near`, the gap between the boxes is 0.01, much smaller than a tet. The link bridges this
  // gap at one point.
  const TriangleMesh apart =
    test::join(box(Vec3(0, 0, 0), Vec3(1, 1, 1)), box(Vec3(4, 0, 0), Vec3(5, 1, 1)));
  const TriangleMesh near =
    test::join(box(Vec3(0, 0, 0), Vec3(4, 1, 1)), box(Vec3(0, 1.01, 0), Vec3(4, 2, 1)));
  const auto triangle_at = [](const TriangleMesh& mesh, const Vec3& place, Index begin)
  {
    for (Index f = begin; f < mesh.triangles.rows(); ++f)
    {
      std::array<Vec3, 2> positions;
      const Vec3 a = mesh.points.row(mesh.triangles(f, 0));
      const Vec3 b = mesh.points.row(mesh.triangles(f, 1));
      const Vec3 c = mesh.points.row(mesh.triangles(f, 2));
      if (nearest_points({ place, place, place }, { a, b, c }, positions) < 1e-12)
      {
        return f;
      }
    }
    return Index(-1);
  };
  ExecutionContext context;
  for (const bool is_near : { false, true })
  {
    const TriangleMesh& mesh = is_near ? near : apart;
    const Vec3 from = is_near ? Vec3(2, 1, 0.4) : Vec3(1, 0.5, 0.4);
    const Vec3 to = is_near ? Vec3(2, 1.01, 0.4) : Vec3(4, 1, 1);
    PartLink link;
    link.triangles = { triangle_at(mesh, from, 0), triangle_at(mesh, to, 12) };
    link.positions = { from, to };
    const WindingNumber winding(mesh.points, mesh.triangles);
    for (const Index resolution : { 5, 9, 20 })
    {
      EXPECT_EQ(embed_mesh(mesh, resolution).components, 2);
      EmbeddingOptions options;
      options.resolution = resolution;
      options.links = { link };
      EmbeddingTets result;
      const Status status =
        embed_surface(context, mesh.points, mesh.triangles, winding, options, result);
      ASSERT_TRUE(status.ok()) << status.message;
      EXPECT_EQ(result.components, 1);
      expect_valid_embedding(mesh, result);
      // The shortest path between the boxes follows the link.
      const std::vector<double> distance = distances(result.mesh,
        vertices_of(
          result, mesh.points, [](const Vec3& p) { return (p - Vec3(0, 0, 0)).norm() < 1e-9; }));
      const Vec3 end = is_near ? Vec3(0, 2, 0) : Vec3(5, 0, 0);
      const double path_length =
        (from - Vec3(0, 0, 0)).norm() + (to - from).norm() + (end - to).norm();
      for (const Index v :
        vertices_of(result, mesh.points, [&](const Vec3& p) { return (p - end).norm() < 1e-9; }))
      {
        EXPECT_LT(distance[v], 1.5 * path_length);
        EXPECT_GT(distance[v], path_length - 3.0 * result.spacing);
      }
    }
    EmbeddingOptions options;
    options.links = { link };
    options.links[0].triangles[1] = mesh.triangles.rows();
    EmbeddingTets result;
    const Status status =
      embed_surface(context, mesh.points, mesh.triangles, winding, options, result);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
  }
}
