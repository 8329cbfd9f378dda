// Orientation of nested shells. The reversed shells are compared with a reference computed from the
// known solids. Another test measures how the time grows with the number of triangles, on surfaces
// with many non-manifold edges and duplicate triangles.
#include "surface/surface_repair.h"

#include "support/meshes.h"
#include "support/sanitized.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <vector>

using namespace bindpose;

namespace
{
struct Cube
{
  double lower[3];
  double size;
  bool inwards;
};

bool contains(const Cube& outer, const Cube& inner)
{
  bool in = true;
  for (int k = 0; k < 3; ++k)
  {
    in = in && outer.lower[k] <= inner.lower[k] &&
      inner.lower[k] + inner.size <= outer.lower[k] + outer.size;
  }
  return in;
}

/// Return cubes of twelve triangles each. The cubes share no vertices.
TriangleMesh mesh_of(const std::vector<Cube>& cubes)
{
  TriangleMesh mesh;
  for (const Cube& cube : cubes)
  {
    TriangleMesh one = test::cube(0.0, cube.size);
    one = cube.inwards ? test::flipped(one) : one;
    const Vec3 by(cube.lower[0], cube.lower[1], cube.lower[2]);
    one = test::translated(one, by);
    const Index vertices = mesh.points.rows(), triangles = mesh.triangles.rows();
    mesh.points.conservativeResize(vertices + one.points.rows(), 3);
    mesh.points.bottomRows(one.points.rows()) = one.points;
    mesh.triangles.conservativeResize(triangles + one.triangles.rows(), 3);
    mesh.triangles.bottomRows(one.triangles.rows()) = (one.triangles.array() + vertices).matrix();
  }
  return mesh;
}

/// Return the triangles of random unit voxels. Adjacent voxels share vertices, and a face between
/// two voxels occurs twice. In addition, a fraction `doubled` of the triangles is repeated.
TriangleMesh voxels(int along, double fill, double doubled)
{
  test::Random random(17);
  std::map<std::array<int, 3>, Index> ids;
  std::vector<std::array<Index, 3>> triangles;
  const TriangleMesh cube = test::cube(0.0, 1.0);
  for (int i = 0; i < along * along * along; ++i)
  {
    if (random.uniform() < fill)
    {
      const int at[3] = { i % along, i / along % along, i / along / along };
      for (Index t = 0; t < cube.triangles.rows(); ++t)
      {
        std::array<Index, 3> triangle{};
        for (int k = 0; k < 3; ++k)
        {
          std::array<int, 3> place{};
          for (int axis = 0; axis < 3; ++axis)
          {
            place[axis] =
              at[axis] + static_cast<int>(std::lround(cube.points(cube.triangles(t, k), axis)));
          }
          triangle[k] = ids.try_emplace(place, static_cast<Index>(ids.size())).first->second;
        }
        triangles.push_back(triangle);
        if (random.uniform() < doubled)
        {
          triangles.push_back(triangle);
        }
      }
    }
  }
  TriangleMesh mesh{ Points(static_cast<Index>(ids.size()), 3),
    Triangles(static_cast<Index>(triangles.size()), 3) };
  for (const auto& [place, id] : ids)
  {
    mesh.points.row(id) << place[0], place[1], place[2];
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    mesh.triangles.row(static_cast<Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  }
  return mesh;
}

/// Return the CPU time of a repair in seconds: the minimum of three runs.
double seconds_of(const TriangleMesh& mesh)
{
  double best = 1e300;
  for (int round = 0; round < 3; ++round)
  {
    ExecutionContext context;
    context.set_threads(1);
    RepairedSurface repaired;
    const std::clock_t start = std::clock();
    EXPECT_TRUE(repair_surface(context, mesh.points, mesh.triangles, {}, repaired).ok());
    best = std::min(
      best, static_cast<double>(std::clock() - start) / static_cast<double>(CLOCKS_PER_SEC));
  }
  return best;
}
} // namespace

TEST(SurfaceShells, TurnedShellsAreThoseOfATwinThatKnowsTheSolids)
{
  test::Random random(5);
  for (int round = 0; round < 6; ++round)
  {
    // Each cell of a lattice contains a cube. With probability 1/2, the cube contains a smaller
    // cube. With probability 1/2, the smaller cube contains a third cube.
    std::vector<Cube> cubes;
    const int along = 2 + 2 * round;
    for (int i = 0; i < along * along * along; ++i)
    {
      Cube cube{};
      const int at[3] = { i % along, i / along % along, i / along / along };
      cube.size = random.uniform(0.5, 0.9);
      for (int k = 0; k < 3; ++k)
      {
        cube.lower[k] = at[k] + 0.05;
      }
      for (int depth = 0; depth < 3; ++depth)
      {
        cube.inwards = random.uniform() < 0.4;
        cubes.push_back(cube);
        if (random.uniform() < 0.5)
        {
          break;
        }
        for (double& x : cube.lower)
        {
          x += 0.2 * cube.size;
        }
        cube.size *= 0.6;
      }
    }
    // A large cube contains some of the cubes. Other cubes only overlap its bounding box.
    cubes.push_back({ { -0.3, -0.2, -0.1 }, 0.5 * along, round % 2 == 0 });
    // Shuffle the order of the cubes.
    for (std::size_t i = cubes.size(); i > 1; --i)
    {
      std::swap(cubes[i - 1], cubes[static_cast<std::size_t>(random.below(static_cast<Index>(i)))]);
    }
    // Compute the reference. If an outermost cube has inward orientation, this cube and all cubes
    // inside of it are reversed. Cubes that cross the large cube are not inside of it.
    std::vector<bool> turned(cubes.size(), false);
    for (std::size_t i = 0; i < cubes.size(); ++i)
    {
      std::size_t outermost = i;
      for (std::size_t j = 0; j < cubes.size(); ++j)
      {
        if (cubes[j].size > cubes[outermost].size && contains(cubes[j], cubes[i]))
        {
          outermost = j;
        }
      }
      turned[i] = cubes[outermost].inwards;
    }
    const TriangleMesh mesh = mesh_of(cubes);
    ExecutionContext context;
    RepairedSurface repaired;
    RepairOptions options;
    options.count_self_intersections = false;
    ASSERT_TRUE(repair_surface(context, mesh.points, mesh.triangles, options, repaired).ok());
    ASSERT_EQ(repaired.triangles.rows(), mesh.triangles.rows());
    for (std::size_t i = 0; i < cubes.size(); ++i)
    {
      const Points& points = repaired.points;
      const Index first = 12 * static_cast<Index>(i);
      double volume = 0.0;
      for (Index t = first; t < first + 12; ++t)
      {
        volume += tet_volume(Vec3(cubes[i].lower[0], cubes[i].lower[1], cubes[i].lower[2]),
          points.row(repaired.triangles(t, 0)), points.row(repaired.triangles(t, 1)),
          points.row(repaired.triangles(t, 2)));
      }
      EXPECT_EQ(volume < 0.0, cubes[i].inwards != turned[i]) << "cube " << i;
    }
  }
}

TEST(SurfaceShells, AFineShellAroundManySolids)
{
  // A sphere contains many cubes. The numbers of triangles and cubes are so large that ray
  // crossings are used to compute the winding numbers of the sphere.
  TriangleMesh mesh = test::flipped(test::sphere(6, 10.0));
  const Index outer = mesh.triangles.rows();
  std::vector<Cube> cubes;
  for (int i = 0; i < 125; ++i)
  {
    const double lower[3] = { i % 5 - 2.5, i / 5 % 5 - 2.5, i / 25 - 2.5 };
    cubes.push_back({ { lower[0], lower[1], lower[2] }, 0.5, i % 3 == 0 });
  }
  // This cube is inside of the sphere's bounding box but outside of the sphere.
  cubes.push_back({ { 9.0, 9.0, 9.0 }, 0.5, false });
  mesh = test::join(mesh, mesh_of(cubes));
  ExecutionContext context;
  RepairedSurface repaired;
  ASSERT_TRUE(repair_surface(context, mesh.points, mesh.triangles, {}, repaired).ok());
  EXPECT_EQ(repaired.found.inward_components, 1);
  EXPECT_EQ(static_cast<Index>(repaired.inward_triangles.size()), outer);
  // All triangles are reversed, except the 12 triangles of the last cube.
  Index kept = 0;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    kept += repaired.triangles(t, 1) == mesh.triangles(t, 1);
  }
  EXPECT_EQ(kept, 12);
}

TEST(SurfaceShells, TimeGrowsWithTheTriangles)
{
  if (test::sanitized)
  {
    GTEST_SKIP() << "times mean nothing under a sanitizer";
  }
  const TriangleMesh small = voxels(20, 0.17, 0.05);
  const TriangleMesh large = voxels(32, 0.17, 0.05);
  const double growth =
    static_cast<double>(large.triangles.rows()) / static_cast<double>(small.triangles.rows());
  ASSERT_GT(growth, 3.5);
  ASSERT_LT(growth, 4.5);
  EXPECT_LT(seconds_of(large), 8.0 * seconds_of(small));
}
