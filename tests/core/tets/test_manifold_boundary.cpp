// Boundary of tets as a manifold surface: vertices and edges where solids touch are duplicated.
#include "tets/manifold_boundary.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

using namespace bindpose;

namespace
{
/// Return six tets for each cube of the list. Adjacent cubes share vertices, and the facets of the
/// tets match at a common face.
TetMesh tets_of_cubes(const std::vector<std::array<int, 3>>& list)
{
  std::map<std::array<int, 3>, Index> ids;
  std::vector<Vec3> points;
  std::vector<std::array<Index, 4>> tets;
  for (const auto& cube : list)
  {
    const auto corner = [&](int bits)
    {
      const std::array<int, 3> at{ cube[0] + (bits & 1), cube[1] + (bits >> 1 & 1),
        cube[2] + (bits >> 2 & 1) };
      const auto [found, is_new] = ids.insert({ at, static_cast<Index>(points.size()) });
      if (is_new)
      {
        points.emplace_back(at[0], at[1], at[2]);
      }
      return found->second;
    };
    // The six tets of Kuhn's subdivision share the cube diagonal from corner 0 to corner 7.
    for (const auto& [first, second] :
      { std::pair(1, 3), { 3, 2 }, { 2, 6 }, { 6, 4 }, { 4, 5 }, { 5, 1 } })
    {
      tets.push_back({ corner(0), corner(first), corner(second), corner(7) });
    }
  }
  TetMesh mesh;
  mesh.points.resize(static_cast<Index>(points.size()), 3);
  for (std::size_t v = 0; v < points.size(); ++v)
  {
    mesh.points.row(static_cast<Index>(v)) = points[v];
  }
  mesh.tets.resize(static_cast<Index>(tets.size()), 4);
  for (std::size_t t = 0; t < tets.size(); ++t)
  {
    mesh.tets.row(static_cast<Index>(t)) << tets[t][0], tets[t][1], tets[t][2], tets[t][3];
  }
  return mesh;
}

/// Expect that every edge has two triangles with opposite directions, and that the triangles around
/// each vertex form one ring.
void expect_closed_manifold(const TriangleMesh& mesh)
{
  std::map<std::pair<Index, Index>, int> directed;
  std::vector<std::map<Index, Index>> next(static_cast<std::size_t>(mesh.points.rows()));
  for (Index f = 0; f < mesh.triangles.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index v = mesh.triangles(f, k);
      const Index a = mesh.triangles(f, (k + 1) % 3);
      const Index b = mesh.triangles(f, (k + 2) % 3);
      EXPECT_EQ(++(directed[{ v, a }]), 1) << "edge from " << v << " to " << a;
      next[v][a] = b;
    }
  }
  for (const auto& [edge, uses] : directed)
  {
    EXPECT_TRUE(directed.count({ edge.second, edge.first }));
  }
  for (std::size_t v = 0; v < next.size(); ++v)
  {
    ASSERT_FALSE(next[v].empty()) << "vertex " << v << " is not used";
    const Index first = next[v].begin()->first;
    std::size_t length = 1;
    for (Index at = next[v][first]; at != first && length <= next[v].size(); at = next[v][at])
    {
      ++length;
    }
    EXPECT_EQ(length, next[v].size()) << "vertex " << v << " has more than one ring";
  }
}
} // namespace

TEST(ManifoldBoundary, SolidWithoutPinchesKeepsItsVertices)
{
  const TetMesh mesh = tets_of_cubes({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } });
  const TriangleMesh surface = manifold_boundary(mesh);
  expect_closed_manifold(surface);
  EXPECT_EQ(surface.points.rows(), mesh.points.rows());
  EXPECT_EQ(surface.triangles.rows(), boundary_triangles(mesh.tets).rows());
  EXPECT_DOUBLE_EQ(signed_volume(surface.points, surface.triangles), 3.0);
}

TEST(ManifoldBoundary, InteriorPointsAreLeftOut)
{
  std::vector<std::array<int, 3>> list;
  for (int i = 0; i < 27; ++i)
  {
    list.push_back({ i % 3, i / 3 % 3, i / 9 });
  }
  const TriangleMesh surface = manifold_boundary(tets_of_cubes(list));
  expect_closed_manifold(surface);
  EXPECT_EQ(surface.points.rows(), 64 - 8);
}

TEST(ManifoldBoundary, CubesThatShareAVertexArePartedThere)
{
  const TriangleMesh surface = manifold_boundary(tets_of_cubes({ { 0, 0, 0 }, { 1, 1, 1 } }));
  expect_closed_manifold(surface);
  EXPECT_EQ(surface.points.rows(), 16);
  EXPECT_DOUBLE_EQ(signed_volume(surface.points, surface.triangles), 2.0);
}

TEST(ManifoldBoundary, CubesThatShareAnEdgeArePartedThere)
{
  const TriangleMesh surface = manifold_boundary(tets_of_cubes({ { 0, 0, 0 }, { 1, 1, 0 } }));
  expect_closed_manifold(surface);
  EXPECT_EQ(surface.points.rows(), 16);
}

TEST(ManifoldBoundary, ARingOfCubesThatCloseAtAnEdgeIsOneSurface)
{
  // The cubes form a ring in which the first and the last cube touch only at an edge. The boundary
  // must be separated at this edge, and stay connected along the ring.
  const TetMesh mesh =
    tets_of_cubes({ { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 1, 1, 0 } });
  const TriangleMesh surface = manifold_boundary(mesh);
  expect_closed_manifold(surface);
  EXPECT_EQ(connected_components(surface.points.rows(), surface.triangles).count, 1);
  EXPECT_DOUBLE_EQ(signed_volume(surface.points, surface.triangles), 5.0);
}

TEST(ManifoldBoundary, RandomCubesGiveAClosedManifold)
{
  for (unsigned seed = 1; seed <= 20; ++seed)
  {
    std::set<std::array<int, 3>> chosen;
    unsigned state = seed;
    for (int i = 0; i < 40; ++i)
    {
      state = state * 1664525U + 1013904223U;
      chosen.insert({ static_cast<int>(state >> 8 & 3), static_cast<int>(state >> 12 & 3),
        static_cast<int>(state >> 16 & 3) });
    }
    const TriangleMesh surface = manifold_boundary(tets_of_cubes({ chosen.begin(), chosen.end() }));
    expect_closed_manifold(surface);
    EXPECT_NEAR(
      signed_volume(surface.points, surface.triangles), static_cast<double>(chosen.size()), 1e-12);
  }
}

TEST(ManifoldBoundary, NoTetsGiveNothing)
{
  EXPECT_EQ(manifold_boundary(TetMesh()).triangles.rows(), 0);
}
