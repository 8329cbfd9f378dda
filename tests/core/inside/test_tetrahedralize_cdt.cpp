// Method cdt: a constrained Delaunay tetrahedralization. For closed surfaces, the tets fill the
// enclosed volume exactly. For other surfaces, the tets fill the region with a high winding number.
#include "inside/tetrahedralize.h"

#include "surface/triangle_tree.h"
#include "tets/tet_quality.h"

#include "core/inside/tet_outcome.h"
#include "support/demo_meshes.h"
#include "support/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

using namespace bindpose;
using test::Cdt;
using test::expect_valid;
using test::handle_elements_of;
using test::run;
using Outcome = test::TetOutcome;
using testing::HasSubstr;

namespace
{
/// Return the largest distance between the tets' boundary and the surface. It is measured at the
/// vertices and facet centers of the boundary.
double boundary_distance(const TetMesh& mesh, const TriangleMesh& surface)
{
  const TriangleTree tree(surface.points, surface.triangles);
  const Triangles skin = boundary_triangles(mesh.tets);
  double largest = 0.0;
  for (Index t = 0; t < skin.rows(); ++t)
  {
    Vec3 middle = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 p = mesh.points.row(skin(t, k));
      largest = std::max(largest, tree.distance(p, 1e9));
      middle += p / 3.0;
    }
    largest = std::max(largest, tree.distance(middle, 1e9));
  }
  return largest;
}

TriangleMesh with_inner_wall()
{
  TriangleMesh mesh = test::cube();
  mesh.triangles.conservativeResize(14, 3);
  mesh.triangles.row(12) << 0, 3, 7;
  mesh.triangles.row(13) << 0, 7, 4;
  return mesh;
}

TriangleMesh doubled(const TriangleMesh& mesh)
{
  TriangleMesh twice = mesh;
  twice.triangles.resize(2 * mesh.triangles.rows(), 3);
  twice.triangles << mesh.triangles, mesh.triangles;
  return twice;
}
} // namespace

// ---- Closed and clean --------------------------------------------------------------------------

TEST_F(Cdt, ClosedSurfacesAreFilledExactly)
{
  struct Case
  {
    const char* name;
    TriangleMesh mesh;
    Index euler;
  };
  const TriangleMesh shell = test::join(test::sphere(3), test::flipped(test::sphere(2, 0.5)));
  const TriangleMesh elephant = test::demo_mesh("elephant.off");
  const TriangleMesh two =
    test::join(test::sphere(2), test::translated(test::torus(20, 10, 1.0, 0.3), Vec3(4, 0, 0)));
  for (const Case& c : { Case{ "cube", test::cube(), 1 }, Case{ "sphere", test::sphere(3), 1 },
         Case{ "torus", test::torus(40, 20, 1.0, 0.4), 0 }, Case{ "shell", shell, 2 },
         Case{ "two", two, 1 },
         Case{ "far away", test::translated(test::sphere(2), Vec3(500, -300, 90)), 1 },
         Case{ "elephant", elephant, test::euler_characteristic(elephant) / 2 } })
  {
    SCOPED_TRACE(c.name);
    const Outcome outcome = run(c.mesh);
    expect_valid(outcome, c.mesh);
    const double volume = signed_volume(c.mesh.points, c.mesh.triangles);
    EXPECT_EQ(outcome.method(), "cdt");
    EXPECT_NEAR(outcome.volume(), volume, 1e-10 * volume);
    EXPECT_NEAR(outcome.number("winding_volume"), volume, 0.1 * volume);
    EXPECT_EQ(test::euler_characteristic(outcome.result.mesh), c.euler);
    EXPECT_EQ(outcome.number("counts.kept_vertices"), c.mesh.points.rows()) << "all vertices stay";
    EXPECT_NEAR(outcome.result.winding_numbers.minCoeff(), 1.0, 1e-9);
    EXPECT_NEAR(outcome.result.winding_numbers.maxCoeff(), 1.0, 1e-9);
    for (Index v = 0; v < c.mesh.points.rows(); ++v)
    {
      ASSERT_EQ(outcome.result.original_vertices[v], v);
      ASSERT_EQ(outcome.result.mesh.points.row(v), c.mesh.points.row(v));
    }
    EXPECT_LT(boundary_distance(outcome.result.mesh, c.mesh), 1e-9);
  }
}

TEST_F(Cdt, VerticesInsideAreAdded)
{
  const TriangleMesh sphere = test::sphere(3);
  TetrahedralizeOptions none;
  none.bare = true;
  const Outcome bare = run(sphere, none);
  const Outcome full = run(sphere);
  expect_valid(bare, sphere);
  EXPECT_EQ(bare.result.mesh.points.rows(), sphere.points.rows());
  EXPECT_GT(full.result.mesh.points.rows(), 1.5 * sphere.points.rows());
  TetrahedralizeOptions of_weights;
  of_weights.interior_edge = interior_edge_of_weights(
    signed_volume(sphere.points, sphere.triangles), bounding_box(sphere.points).diagonal());
  EXPECT_GT(run(sphere, of_weights).result.mesh.points.rows(), 2 * sphere.points.rows());
  EXPECT_GT(full.number("min_dihedral_angle"), 4.0);
  // `interior_edge` limits the length of edges inside, so a small value gives more tets.
  TetrahedralizeOptions fine;
  fine.interior_edge = 0.02;
  EXPECT_GT(run(sphere, fine).result.mesh.tets.rows(), 3 * full.result.mesh.tets.rows());
}

TEST_F(Cdt, TheSurfaceIsLeftForAnAngleThatItDoesNotAllow)
{
  // Two walls meet at an angle of 2.9 degrees.
  TriangleMesh wedge = test::cube(0.0, 1.0);
  for (Index v = 0; v < wedge.points.rows(); ++v)
  {
    wedge.points(v, 2) *= 0.05 * wedge.points(v, 0) + 1e-3;
  }
  TetrahedralizeOptions options;
  options.method = TetMethod::cdt;
  options.quality = 10.0;
  const Outcome kept = run(wedge, options);
  EXPECT_EQ(kept.status.code, StatusCode::not_converged);
  EXPECT_THAT(kept.status.message, testing::HasSubstr("smallest dihedral angle"));
  EXPECT_LT(kept.number("min_dihedral_angle"), 3.0);
  options.method = TetMethod::automatic;
  options.resolution = 200; // this resolution resolves the thin wedge
  const Outcome left = run(wedge, options);
  expect_valid(left, wedge);
  EXPECT_EQ(left.method(), "remesh");
  EXPECT_GE(left.number("min_dihedral_angle"), 10.0);
  ASSERT_FALSE(left.status.warnings.empty());
  EXPECT_THAT(left.status.warnings.back(), testing::HasSubstr("replaced method cdt"));
  // The result must contain no data of the tets of method cdt, which were rejected.
  options.handles = handle_elements_of({ Vec3(0.9, 0.5, 0.02) });
  const Outcome with_handle = run(wedge, options);
  EXPECT_EQ(with_handle.method(), "remesh");
  EXPECT_TRUE(with_handle.result.handle_vertices.empty());
  EXPECT_EQ(with_handle.number("counts.handle_vertices"), -1.0);
  EXPECT_EQ(with_handle.result.mesh.tets, left.result.mesh.tets);
  options.handles = HandleElements();
  // The result of method cdt is kept if its angles are large enough.
  const Outcome cube = run(test::cube(), options);
  expect_valid(cube, test::cube());
  EXPECT_EQ(cube.method(), "cdt");
  EXPECT_GE(cube.number("min_dihedral_angle"), 10.0);
}

TEST_F(Cdt, FlatTetsAreSwappedAndTheSurfaceStays)
{
  const TriangleMesh elephant = test::demo_mesh("elephant.off");
  const Outcome outcome = run(elephant, TetMethod::cdt);
  expect_valid(outcome, elephant);
  EXPECT_GE(outcome.number("min_dihedral_angle"), 5.0);
  EXPECT_NEAR(
    outcome.volume(), signed_volume(elephant.points, elephant.triangles), 1e-10 * outcome.volume());
  EXPECT_EQ(boundary_triangles(outcome.result.mesh.tets).rows(), elephant.triangles.rows());
}

TEST_F(Cdt, SameBitsForAnyNumberOfThreads)
{
  const TriangleMesh mesh =
    test::join(test::open_cube(), test::translated(test::sphere(2), Vec3(0.6, 0.5, 0.4)));
  const Outcome serial = run(mesh, {}, 1), parallel = run(mesh, {}, 4);
  ASSERT_TRUE(serial.status.ok()) << serial.status.message;
  EXPECT_EQ(serial.result.mesh.points, parallel.result.mesh.points);
  EXPECT_EQ(serial.result.mesh.tets, parallel.result.mesh.tets);
  EXPECT_EQ(serial.result.winding_numbers, parallel.result.winding_numbers);
}

// ---- Unclean -----------------------------------------------------------------------------------

TEST_F(Cdt, UncleanCubesHoldTheirVolume)
{
  TriangleMesh gap = test::cube(); // the top is a separate square, 1e-3 above the cube
  gap.points.conservativeResize(12, 3);
  for (int v = 0; v < 4; ++v)
  {
    gap.points.row(8 + v) = gap.points.row(4 + v) + Vec3(0, 0, 1e-3).transpose();
  }
  gap.triangles.row(10) << 8, 9, 11;
  gap.triangles.row(11) << 8, 11, 10;
  TriangleMesh flipped_top = test::cube();
  flipped_top.triangles.bottomRows(2).col(1).swap(flipped_top.triangles.bottomRows(2).col(2));
  struct Case
  {
    const char* name;
    TriangleMesh mesh;
    double volume, tolerance;
  };
  for (const Case& c : { Case{ "open top", test::open_cube(), 8.0, 1e-9 },
         Case{ "inner wall", with_inner_wall(), 8.0, 1e-9 },
         Case{ "two cubes, overlapping by half",
           test::join(test::cube(), test::translated(test::cube(), Vec3(1, 0, 0))), 12.0, 1e-9 },
         Case{ "two cubes, in general position",
           test::join(test::cube(), test::translated(test::cube(), Vec3(1.03, 0.9, 0.85))),
           16.0 - 0.97 * 1.1 * 1.15, 1e-9 },
         Case{ "doubled faces", doubled(test::cube()), 8.0, 1e-9 },
         Case{ "a gap under the top", gap, 8.002, 0.003 },
         Case{ "top turned over", flipped_top, 8.0, 1e-9 },
         Case{ "inside out", test::flipped(test::cube()), 8.0, 1e-9 },
         Case{ "loose triangles", test::unwelded(test::cube()), 8.0, 1e-9 },
         Case{ "a fin outside",
           test::join(test::cube(), test::translated(test::grid(1, 1, 2, 2), Vec3(0.5, -0.9, 0.3))),
           8.0, 1e-6 } })
  {
    SCOPED_TRACE(c.name);
    const Outcome outcome = run(c.mesh);
    expect_valid(outcome, c.mesh);
    EXPECT_EQ(outcome.method(), "cdt");
    EXPECT_NEAR(outcome.volume(), c.volume, c.tolerance);
  }
  // The reversed top is detected and flipped. Without the flip, the winding number would be 0 next
  // to the top and 2/3 at the center.
  const Outcome outcome = run(flipped_top);
  EXPECT_EQ(outcome.number("counts.turned_triangles"), 2);
  ASSERT_EQ(outcome.status.warnings.size(), 1u);
  EXPECT_THAT(outcome.status.warnings[0], HasSubstr("2 triangles were flipped"));
  EXPECT_EQ(run(test::flipped(test::cube())).number("counts.turned_components"), 1);
}

TEST_F(Cdt, ManyPartsMostlyInsideOutOthersTouchOneIsOpen)
{
  // The first part consists of every second cube of a 4 x 4 x 4 lattice. These cubes touch at edges
  // and vertices. Below them are 16 separate cubes, most of them inside out. Next to them is a cube
  // without a top.
  TriangleMesh mesh = test::translated(test::open_cube(), Vec3(8.0, 0.0, 0.0));
  Index turned = 0;
  for (int k = 0; k < 64; ++k)
  {
    const Vec3 at(k % 4, k / 4 % 4, k / 16);
    if (static_cast<int>(at.sum()) % 2 == 0)
    {
      mesh = test::join(mesh, test::translated(test::cube(0.0, 1.0), at));
    }
    if (k < 16)
    {
      const TriangleMesh apart = test::translated(test::cube(0.0, 1.0), 1.5 * at + Vec3(0, 0, -3));
      const bool inside_out = k % 5 != 0;
      turned += inside_out ? 1 : 0;
      mesh = test::join(mesh, inside_out ? test::flipped(apart) : apart);
    }
  }
  const Outcome outcome = run(mesh);
  expect_valid(outcome, mesh);
  EXPECT_EQ(outcome.method(), "cdt");
  EXPECT_NEAR(outcome.volume(), 32.0 + 16.0 + 8.0, 1e-9);
  EXPECT_GT(outcome.number("counts.nonmanifold_edges"), 0.0);
  EXPECT_EQ(outcome.number("counts.boundary_edges"), 4.0);
  EXPECT_EQ(outcome.number("counts.turned_components"), turned);
  EXPECT_FALSE(outcome.status.warnings.empty());
}

TEST_F(Cdt, CrossingSurfacesKeepTheirVerticesAndTriangles)
{
  const TriangleMesh spheres =
    test::join(test::sphere(3), test::sphere(3, 1.0, Vec3(0.7, 0.31, 0.17)));
  const Outcome outcome = run(spheres);
  expect_valid(outcome, spheres);
  EXPECT_EQ(outcome.method(), "cdt");
  EXPECT_GT(outcome.number("counts.self_intersections"), 0);
  EXPECT_LT(boundary_distance(outcome.result.mesh, spheres), 1e-9);
  // The union of two balls of radius 1 at distance d has the volume 8/3 pi - pi (4 + d) (2 - d)^2 /
  // 12. The subdivided spheres are a little smaller than the balls.
  const double d = Vec3(0.7, 0.31, 0.17).norm();
  const double pi = 3.14159265358979;
  const double balls = 8.0 / 3.0 * pi - pi * (4.0 + d) * (2.0 - d) * (2.0 - d) / 12.0;
  const double shrink = signed_volume(spheres.points, spheres.triangles) / (8.0 / 3.0 * pi);
  EXPECT_NEAR(outcome.volume(), balls * shrink, 0.003 * balls);
  EXPECT_EQ(test::euler_characteristic(outcome.result.mesh), 1);
  // The winding number is 2 where the balls overlap. A threshold of 1.5 therefore keeps only this
  // region, which has the shape of a lens.
  EXPECT_NEAR(outcome.result.winding_numbers.maxCoeff(), 2.0, 1e-9);
  TetrahedralizeOptions lens;
  lens.winding_threshold = 1.5;
  const Outcome inner = run(spheres, lens);
  expect_valid(inner, spheres);
  EXPECT_NEAR(
    inner.volume() + outcome.volume(), signed_volume(spheres.points, spheres.triangles), 1e-9);
}

TEST_F(Cdt, NearlyCoincidentCopiesAreOneSolid)
{
  const TriangleMesh mesh =
    test::join(test::sphere(3), test::translated(test::sphere(3), Vec3(1e-9, -2e-9, 1e-9)));
  const Outcome outcome = run(mesh);
  expect_valid(outcome, mesh);
  const double volume = signed_volume(test::sphere(3).points, test::sphere(3).triangles);
  EXPECT_NEAR(outcome.volume(), volume, 1e-3 * volume);
}

TEST_F(Cdt, TwentyPercentTurnedOrMissing)
{
  TriangleMesh turned = test::torus(32, 16, 1.0, 0.4);
  const double volume = signed_volume(turned.points, turned.triangles);
  test::Random random(19);
  std::vector<Index> kept;
  for (Index t = 0; t < turned.triangles.rows(); ++t)
  {
    if (random.uniform() < 0.2)
    {
      std::swap(turned.triangles(t, 0), turned.triangles(t, 1));
    }
    else
    {
      kept.push_back(t);
    }
  }
  const Outcome repaired = run(turned);
  expect_valid(repaired, turned);
  EXPECT_NEAR(repaired.volume(), volume, 1e-10 * volume);
  TriangleMesh holes = test::torus(32, 16, 1.0, 0.4);
  Triangles rest(static_cast<Index>(kept.size()), 3);
  for (Index t = 0; t < rest.rows(); ++t)
  {
    rest.row(t) = holes.triangles.row(kept[t]);
  }
  holes.triangles = rest;
  const Outcome filled = run(holes);
  expect_valid(filled, holes);
  EXPECT_NEAR(filled.volume(), volume, 0.05 * volume);
}

TEST_F(Cdt, ElephantWithHoles)
{
  const TriangleMesh elephant = test::demo_mesh("elephant-with-holes.off");
  ASSERT_GT(elephant.triangles.rows(), 0);
  const Outcome outcome = run(elephant);
  expect_valid(outcome, elephant);
  EXPECT_EQ(outcome.method(), "cdt");
  EXPECT_GT(outcome.number("counts.boundary_edges"), 0);
  EXPECT_GT(outcome.result.mesh.tets.rows(), 5000);
  EXPECT_LT(outcome.result.mesh.tets.rows(), 40000);
  EXPECT_GT(outcome.number("min_dihedral_angle"), 2.0);
  EXPECT_NEAR(outcome.volume() / outcome.number("winding_volume"), 1.0, 0.05);
  EXPECT_GT(outcome.number("counts.kept_vertices"), 0.97 * elephant.points.rows());
  EXPECT_GE(outcome.result.winding_numbers.minCoeff(), 0.3);
  // Compare the volume with that of the original elephant, from which no triangles were removed.
  const TriangleMesh whole = test::demo_mesh("elephant.off");
  EXPECT_NEAR(
    outcome.volume(), signed_volume(whole.points, whole.triangles), 0.02 * outcome.volume());
}

TEST_F(Cdt, TooManyCrossingsAreLeftAtOnce)
{
  // All bars cross each other. Refinement would cut them into several hundred thousand triangles.
  constexpr int bars = 100;
  TriangleMesh mesh;
  for (int i = 0; i < 2 * bars; ++i)
  {
    TriangleMesh bar = test::cube(0.0, 1.0);
    const bool along_x = i < bars;
    const double at = along_x ? i : i - bars;
    bar.points.col(along_x ? 0 : 1) *= bars;
    bar.points.col(along_x ? 1 : 0) *= 0.5;
    bar.points.col(2) *= 0.5;
    bar.points.col(along_x ? 1 : 0).array() += at;
    bar.points.col(2).array() += along_x ? 0.0 : 0.25;
    mesh = mesh.points.rows() == 0 ? bar : test::join(mesh, bar);
  }
  const Outcome outcome = run(mesh);
  const auto* attempt_outcomes =
    std::get_if<std::vector<std::string>>(outcome.status.report.find("rungs[].outcome"));
  ASSERT_NE(attempt_outcomes, nullptr);
  EXPECT_THAT(
    attempt_outcomes->front(), HasSubstr("pairs of triangles cross, too many to split them"));
  const auto* names =
    std::get_if<std::vector<std::string>>(outcome.status.report.find("rungs[].name"));
  ASSERT_NE(names, nullptr);
  EXPECT_EQ(std::count_if(names->begin(), names->end(),
              [](const std::string& name) { return name.rfind("refine", 0) == 0; }),
    1)
    << "vertices moved a little make no fewer crossings";
  if (outcome.status.ok())
  {
    expect_valid(outcome, mesh);
  }
  else
  {
    EXPECT_THAT(outcome.status.message, HasSubstr("the tets have volume"));
  }
}

TEST_F(Cdt, RealSurfacesThatCross)
{
  for (const char* name : { "cow.off", "bones.off", "elk.off", "mpi.off" })
  {
    SCOPED_TRACE(name);
    TriangleMesh mesh = test::demo_mesh(name);
    mesh.points /= bounding_box(mesh.points).diagonal();
    const Outcome outcome = run(mesh);
    expect_valid(outcome, mesh);
    EXPECT_GT(outcome.number("counts.self_intersections"), 0);
    EXPECT_NEAR(outcome.volume() / outcome.number("winding_volume"), 1.0, 0.1);
  }
}

TEST_F(Cdt, RandomSoupsGiveTetsOrASentence)
{
  // Each damaged surface gives a valid mesh of its inside, or an error message.
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
  {
    SCOPED_TRACE(seed);
    test::Random random(seed);
    TriangleMesh mesh = seed % 2 ? test::sphere(2) : test::torus(14, 8, 1.0, 0.5);
    if (seed % 3 == 0)
    {
      mesh = test::join(mesh, test::sphere(1, 0.8, random.in_box(Vec3::Zero(), Vec3::Ones())));
    }
    const double noise = 0.2 * random.uniform();
    for (Index k = 0; k < mesh.points.size(); ++k)
    {
      mesh.points.data()[k] += noise * random.uniform(-1.0, 1.0);
    }
    for (Index t = 0; t < mesh.triangles.rows() / 10; ++t)
    {
      const Index a = random.below(mesh.triangles.rows());
      mesh.triangles(a, random.below(3)) = random.below(mesh.points.rows());
    }
    const Outcome outcome = run(mesh);
    if (outcome.status.ok())
    {
      EXPECT_TRUE(check_tets(outcome.result.mesh.points, outcome.result.mesh.tets).ok());
      EXPECT_NEAR(outcome.volume() / outcome.number("winding_volume"), 1.0, 0.25);
    }
    else
    {
      EXPECT_EQ(outcome.status.code, StatusCode::invalid_input) << outcome.status.message;
      EXPECT_FALSE(outcome.status.message.empty());
    }
  }
}
