#include "inside/tetrahedralize.h"

#include "inside/mesher_process.h"
#include "inside/tet_quality.h"
#include "inside/triangle_tree.h"
#include "io/medit.h"
#include "winding/winding_number.h"

#include "support/demo_meshes.h"
#include "support/environment.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/needs_mesher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <thread>

#include <sys/stat.h>

using namespace bindpose;
using test::Environment;
using testing::HasSubstr;

namespace
{
struct Outcome
{
  TetrahedralizeResult result;
  Status status;
  double number(const char* key) const { return this->status.report.number(key, -1.0); }
  std::string method() const { return this->status.report.text("method"); }
  double volume() const
  {
    return tet_volumes(this->result.mesh.points, this->result.mesh.tets).sum();
  }
};

Outcome run(const TriangleMesh& mesh, TetrahedralizeOptions options = {}, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  Outcome outcome;
  outcome.status = tetrahedralize(mesh.points, mesh.triangles, options, outcome.result, context);
  return outcome;
}

Outcome run(const TriangleMesh& mesh, TetMethod method)
{
  TetrahedralizeOptions options;
  options.method = method;
  return run(mesh, options);
}

/// What every result promises, whatever the method.
void expect_valid(const Outcome& outcome, const TriangleMesh& surface)
{
  ASSERT_TRUE(outcome.status.ok()) << outcome.status.message;
  const TetMesh& mesh = outcome.result.mesh;
  ASSERT_GT(mesh.tets.rows(), 0);
  ASSERT_TRUE(check_mesh(mesh.points, mesh.tets).ok());
  const bool branches = outcome.number("counts.branching_facets") > 0.0;
  EXPECT_TRUE(check_tets(mesh.points, mesh.tets, branches).ok());
  EXPECT_GT(tet_volumes(mesh.points, mesh.tets).minCoeff(), 0.0);
  if (!branches)
  {
    EXPECT_TRUE(count_edges(boundary_triangles(mesh.tets)).closed);
  }
  const Components components = connected_components(mesh.points.rows(), mesh.tets);
  EXPECT_EQ(std::count(components.of_vertex.begin(), components.of_vertex.end(), -1), 0)
    << "a stray vertex";
  const auto& ids = outcome.result.original_vertices;
  ASSERT_EQ(static_cast<Index>(ids.size()), mesh.points.rows());
  const auto first_new = std::find(ids.begin(), ids.end(), -1);
  EXPECT_TRUE(std::is_sorted(ids.begin(), first_new));
  EXPECT_TRUE(std::all_of(first_new, ids.end(), [](Index id) { return id == -1; }));
  for (auto id = ids.begin(); id != first_new; ++id)
  {
    const Index v = id - ids.begin();
    EXPECT_LT((mesh.points.row(v) - surface.points.row(*id)).norm(), 1e-3) << v;
  }
  ASSERT_EQ(outcome.result.winding_numbers.size(), mesh.tets.rows());
  EXPECT_TRUE(outcome.result.winding_numbers.allFinite());
  EXPECT_EQ(outcome.number("counts.tets"), mesh.tets.rows());
  EXPECT_DOUBLE_EQ(outcome.number("volume"), outcome.volume());
  EXPECT_GT(outcome.number("min_dihedral_angle"), 0.0);
  const auto column = [&](const char* key) { return outcome.status.report.find(key); };
  ASSERT_NE(column("quality[].tets"), nullptr);
  const auto& histogram = std::get<std::vector<std::int64_t>>(*column("quality[].tets"));
  EXPECT_EQ(std::accumulate(histogram.begin(), histogram.end(), std::int64_t(0)), mesh.tets.rows());
  EXPECT_EQ(histogram[0], outcome.number("counts.tets_below_5_degrees"));
}

/// Vertices - edges + triangles; half of it is the characteristic of what a closed surface bounds.
Index surface_characteristic(const TriangleMesh& mesh)
{
  return mesh.points.rows() - count_edges(mesh.triangles).edges + mesh.triangles.rows();
}

/// Largest distance of the tets' boundary (vertices and middles of facets) from the surface.
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

TriangleMesh unwelded(const TriangleMesh& mesh)
{
  TriangleMesh soup;
  soup.points.resize(mesh.triangles.size(), 3);
  soup.triangles.resize(mesh.triangles.rows(), 3);
  for (Index k = 0; k < mesh.triangles.size(); ++k)
  {
    soup.points.row(k) = mesh.points.row(mesh.triangles.data()[k]);
    soup.triangles.data()[k] = k;
  }
  return soup;
}

/// Tests of method cdt, which needs the helper.
class Cdt : public test::NeedsMesher
{
};
} // namespace

// ---- Closed and clean
// ----------------------------------------------------------------------------

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
         Case{ "elephant", elephant, surface_characteristic(elephant) / 2 } })
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
  none.quality = 0.0;
  none.interior_edge = 0.0;
  const Outcome bare = run(sphere, none);
  const Outcome full = run(sphere);
  expect_valid(bare, sphere);
  EXPECT_EQ(bare.result.mesh.points.rows(), sphere.points.rows());
  EXPECT_GT(full.result.mesh.points.rows(), 2 * sphere.points.rows());
  EXPECT_GT(full.number("min_dihedral_angle"), 4.0);
  // No edge inside is much longer than asked for.
  TetrahedralizeOptions fine;
  fine.interior_edge = 0.02;
  EXPECT_GT(run(sphere, fine).result.mesh.tets.rows(), 3 * full.result.mesh.tets.rows());
}

TEST_F(Cdt, SameBitsForAnyNumberOfThreads)
{
  const TriangleMesh mesh =
    test::join(test::open_cube(), test::translated(test::sphere(2), Vec3(0.6, 0.5, 0.4)));
  const Outcome one = run(mesh, {}, 1), many = run(mesh, {}, 4);
  ASSERT_TRUE(one.status.ok()) << one.status.message;
  EXPECT_EQ(one.result.mesh.points, many.result.mesh.points);
  EXPECT_EQ(one.result.mesh.tets, many.result.mesh.tets);
  EXPECT_EQ(one.result.winding_numbers, many.result.winding_numbers);
}

// ---- Unclean
// -------------------------------------------------------------------------------------

TEST_F(Cdt, UncleanCubesHoldTheirVolume)
{
  TriangleMesh gap = test::cube(); // the top is loose, 1e-3 above
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
         Case{ "loose triangles", unwelded(test::cube()), 8.0, 1e-9 },
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
  // The turned top is found and turned back: without that, w = 0 next to it and 2/3 at the centre.
  const Outcome outcome = run(flipped_top);
  EXPECT_EQ(outcome.number("counts.turned_triangles"), 2);
  ASSERT_EQ(outcome.status.warnings.size(), 1u);
  EXPECT_THAT(outcome.status.warnings[0], HasSubstr("2 triangles were turned"));
  EXPECT_EQ(run(test::flipped(test::cube())).number("counts.turned_components"), 1);
}

TEST_F(Cdt, ManyPartsMostlyInsideOutOthersTouchOneIsOpen)
{
  // Every second cube of 4 x 4 x 4: they touch in edges and vertices. Below them 16 cubes apart
  // from each other, most of them inside out, and beside them one without a top.
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
  // Two balls of radius 1 at distance d: 8/3 pi - pi (4 + d) (2 - d)^2 / 12; the subdivided spheres
  // are a little smaller.
  const double d = Vec3(0.7, 0.31, 0.17).norm();
  const double pi = 3.14159265358979;
  const double balls = 8.0 / 3.0 * pi - pi * (4.0 + d) * (2.0 - d) * (2.0 - d) / 12.0;
  const double shrink = signed_volume(spheres.points, spheres.triangles) / (8.0 / 3.0 * pi);
  EXPECT_NEAR(outcome.volume(), balls * shrink, 0.003 * balls);
  EXPECT_EQ(test::euler_characteristic(outcome.result.mesh), 1);
  // Inside twice: w = 2 there, and with a threshold of 1.5 only the lens is kept.
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
  // The elephant it was made from.
  const TriangleMesh whole = test::demo_mesh("elephant.off");
  EXPECT_NEAR(
    outcome.volume(), signed_volume(whole.points, whole.triangles), 0.02 * outcome.volume());
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

// ---- Lattices: no helper
// -------------------------------------------------------------------------

TEST(Tetrahedralize, RemeshNeedsNoHelper)
{
  const Environment no_helper("BINDPOSE_MESHER", "/nowhere");
  TetrahedralizeOptions options;
  options.resolution = 20;
  for (const TriangleMesh& mesh : { test::sphere(3), test::open_cube(),
         test::join(test::cube(), test::translated(test::cube(), Vec3(1, 0.3, 0.2))) })
  {
    const Outcome automatic = run(mesh, options);
    expect_valid(automatic, mesh);
    EXPECT_EQ(automatic.method(), "remesh");
    EXPECT_NEAR(automatic.volume() / automatic.number("winding_volume"), 1.0, 0.1);
    EXPECT_GE(automatic.number("min_dihedral_angle"), 10.7);
    ASSERT_FALSE(automatic.status.warnings.empty());
    EXPECT_THAT(automatic.status.warnings.back(), HasSubstr("cdt was left"));
    options.method = TetMethod::cdt;
    EXPECT_EQ(run(mesh, options).status.code, StatusCode::unavailable);
    options.method = TetMethod::automatic;
  }
}

TEST(Tetrahedralize, EmbedHoldsAnySurface)
{
  const Environment no_helper("BINDPOSE_MESHER", "/nowhere");
  TetrahedralizeOptions options;
  options.method = TetMethod::embed;
  options.resolution = 12;
  TriangleMesh triangle = test::grid(1, 1);
  triangle.triangles.conservativeResize(1, 3);
  for (const TriangleMesh& mesh : { test::sphere(2), test::grid(3, 2), triangle })
  {
    const Outcome outcome = run(mesh, options);
    expect_valid(outcome, mesh);
    EXPECT_EQ(outcome.method(), "embed");
    EXPECT_NEAR(outcome.number("min_dihedral_angle"), 60.0, 1e-6);
    EXPECT_EQ(outcome.result.inside_fractions.size(), outcome.result.mesh.tets.rows());
    EXPECT_EQ(static_cast<Index>(outcome.result.binding.tets.size()), mesh.points.rows());
    EXPECT_GT(outcome.number("spacing"), 0.0);
    EXPECT_EQ(outcome.number("counts.duplicated_nodes"), 0.0);
    EXPECT_EQ(outcome.number("counts.tet_components"), 1.0);
  }
}

TEST(Tetrahedralize, EmbedBindsEveryPointOfAnUncleanSurface)
{
  // Two spheres a hair apart, one inside out, with doubled vertices and a triangle of no area.
  TriangleMesh mesh = unwelded(
    test::join(test::sphere(2), test::flipped(test::sphere(2, 1.0, Vec3(2.0001, 0.0, 0.0)))));
  mesh.triangles.row(0) << 0, 0, 1;
  const Outcome outcome = run(mesh, TetMethod::embed);
  expect_valid(outcome, mesh);
  EXPECT_EQ(outcome.number("counts.tet_components"), 2.0);
  EXPECT_GT(outcome.number("counts.lattice_tets"), 15000.0);
  EXPECT_LT(outcome.number("counts.lattice_tets"), 60000.0);
  for (Index i = 0; i < mesh.points.rows(); ++i)
  {
    ASSERT_GE(outcome.result.binding.tets[i], 0);
  }
  EXPECT_NEAR(outcome.result.inside_fractions.dot(
                tet_volumes(outcome.result.mesh.points, outcome.result.mesh.tets)),
    2.0 * signed_volume(test::sphere(2).points, test::sphere(2).triangles), 0.1);
  EXPECT_EQ(run(test::sphere(2), TetMethod::remesh).result.binding.tets.size(), 0u);
}

TEST(Tetrahedralize, ABrokenHelperIsLeft)
{
  test::Folder folder;
  const std::string path = folder.write("bindpose-mesher", "#!/bin/sh\nkill -SEGV $$\n");
  ::chmod(path.c_str(), 0755);
  const Environment helper("BINDPOSE_MESHER", path);
  const Outcome outcome = run(test::sphere(2));
  expect_valid(outcome, test::sphere(2));
  EXPECT_EQ(outcome.method(), "remesh");
  const auto* outcomes = outcome.status.report.find("rungs[].outcome");
  ASSERT_NE(outcomes, nullptr);
  const auto& texts = std::get<std::vector<std::string>>(*outcomes);
  EXPECT_GE(texts.size(), 5u) << "tetgen, four refinements, the lattice";
  EXPECT_THAT(texts.front(), HasSubstr("signal 11"));
  EXPECT_EQ(texts.back(), "ok");
  TetrahedralizeOptions cdt;
  cdt.method = TetMethod::cdt;
  const Outcome failed = run(test::sphere(2), cdt);
  EXPECT_EQ(failed.status.code, StatusCode::internal_error);
  EXPECT_THAT(failed.status.message, HasSubstr("signal 11"));
  EXPECT_EQ(failed.result.mesh.tets.rows(), 0);
}

TEST(Tetrahedralize, ASlowHelperIsLeftInTime)
{
  test::Folder folder;
  const std::string path = folder.write("bindpose-mesher", "#!/bin/sh\nexec sleep 60\n");
  ::chmod(path.c_str(), 0755);
  const Environment helper("BINDPOSE_MESHER", path);
  TetrahedralizeOptions options;
  options.time_limit = 0.4;
  options.resolution = 10;
  const Outcome outcome = run(test::sphere(2), options);
  expect_valid(outcome, test::sphere(2));
  EXPECT_EQ(outcome.method(), "remesh");
  EXPECT_THAT(outcome.status.warnings.back(), HasSubstr("time limit"));
}

TEST(Tetrahedralize, CancelEndsAtOnce)
{
  test::Folder folder;
  const std::string path = folder.write("bindpose-mesher", "#!/bin/sh\nexec sleep 60\n");
  ::chmod(path.c_str(), 0755);
  const Environment helper("BINDPOSE_MESHER", path);
  const TriangleMesh mesh = test::sphere(2);
  ExecutionContext context;
  std::chrono::steady_clock::time_point asked;
  std::thread user(
    [&]
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
      asked = std::chrono::steady_clock::now();
      context.request_cancel();
    });
  TetrahedralizeResult result;
  const Status status = tetrahedralize(mesh.points, mesh.triangles, {}, result, context);
  const double waited =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - asked).count();
  user.join();
  EXPECT_EQ(status.code, StatusCode::cancelled);
  EXPECT_LT(waited, 0.2);
  EXPECT_EQ(result.mesh.tets.rows(), 0);
}

// ---- No answer: one sentence
// ---------------------------------------------------------------------

TEST(Tetrahedralize, BadInputIsOneSentence)
{
  TriangleMesh nan = test::cube();
  nan.points(4, 2) = std::numeric_limits<double>::quiet_NaN();
  TriangleMesh ids = test::cube();
  ids.triangles(5, 1) = 77;
  TriangleMesh triangle = test::grid(1, 1);
  triangle.triangles.conservativeResize(1, 3);
  TriangleMesh needle = triangle;
  needle.points.col(1).setZero();
  TriangleMesh far_apart = triangle; // two that see little of each other
  far_apart = test::join(far_apart, test::translated(triangle, Vec3(0.1, 0.2, 9.0)));
  const TriangleMesh both_ways = test::join(test::cube(), test::flipped(test::cube()));
  struct Case
  {
    TriangleMesh mesh;
    const char* words;
  };
  for (const Case& c : { Case{ { Points(0, 3), Triangles(0, 3) }, "no triangles" },
         Case{ nan, "vertex 4" }, Case{ ids, "triangle 5" }, Case{ triangle, "flat" },
         Case{ test::grid(4, 3), "flat" }, Case{ needle, "no triangle of the surface has an area" },
         Case{ far_apart, "encloses nothing" }, Case{ both_ways, "encloses nothing" } })
  {
    SCOPED_TRACE(c.words);
    const Outcome outcome = run(c.mesh);
    EXPECT_EQ(outcome.status.code, StatusCode::invalid_input);
    EXPECT_THAT(outcome.status.message, HasSubstr(c.words));
    EXPECT_EQ(outcome.status.message.find('\n'), std::string::npos);
    EXPECT_EQ(outcome.result.mesh.tets.rows(), 0);
  }
}

TEST(Tetrahedralize, AThresholdNothingReachesIsSaidAtOnce)
{
  // A cube winds once around its inside; asked for is more. No rung may try again and again.
  TetrahedralizeOptions options;
  options.winding_threshold = 1.5;
  for (const TetMethod method : { TetMethod::cdt, TetMethod::automatic, TetMethod::remesh })
  {
    SCOPED_TRACE(to_string(method));
    if (method == TetMethod::cdt && find_mesher().empty())
    {
      continue; // method cdt is not there
    }
    options.method = method;
    const Outcome outcome = run(test::cube(), options);
    EXPECT_EQ(outcome.status.code, StatusCode::invalid_input);
    EXPECT_THAT(outcome.status.message, HasSubstr("reaches 1, below the threshold of 1.5"));
    const Report::Value* rungs = outcome.status.report.find("rungs[].name");
    if (method == TetMethod::cdt)
    {
      ASSERT_NE(rungs, nullptr);
      EXPECT_EQ(std::get<std::vector<std::string>>(*rungs).size(), 1U);
    }
  }
  if (find_mesher().empty())
  {
    return;
  }
  // Two cubes of side 2 that overlap do wind twice, in a cube of side 1.
  const TriangleMesh two = test::join(test::cube(), test::translated(test::cube(), Vec3(1, 1, 1)));
  options.method = TetMethod::cdt;
  const Outcome overlap = run(two, options);
  EXPECT_TRUE(overlap.status.usable()) << overlap.status.message;
  EXPECT_NEAR(overlap.volume(), 1.0, 1e-12);
}

TEST(Tetrahedralize, OptionsAreChecked)
{
  const auto message = [](const std::function<void(TetrahedralizeOptions&)>& change)
  {
    TetrahedralizeOptions options;
    change(options);
    const Outcome outcome = run(test::cube(), options);
    EXPECT_EQ(outcome.status.code, StatusCode::invalid_input);
    return outcome.status.message;
  };
  EXPECT_THAT(message([](auto& o) { o.winding_threshold = 0.0; }), HasSubstr("winding_threshold"));
  EXPECT_THAT(message([](auto& o) { o.resolution = 2; }), HasSubstr("resolution"));
  EXPECT_THAT(message([](auto& o) { o.time_limit = -1.0; }), HasSubstr("time_limit"));
  EXPECT_THAT(message([](auto& o) { o.memory_limit = -1; }), HasSubstr("memory_limit"));
  EXPECT_THAT(message([](auto& o) { o.quality = 1.0; }), HasSubstr("quality"));
  EXPECT_THAT(message([](auto& o) { o.interior_edge = -0.1; }), HasSubstr("interior_edge"));
  EXPECT_THAT(message([](auto& o) { o.cut_smoothness = -1.0; }), HasSubstr("cut_smoothness"));
  EXPECT_THAT(message([](auto& o) { o.cut_sigma = 0.0; }), HasSubstr("cut_sigma"));
}

/// Without every fifth triangle.
TriangleMesh ragged(TriangleMesh mesh)
{
  Index kept = 0;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    if (t % 5 != 0)
    {
      mesh.triangles.row(kept++) = mesh.triangles.row(t).eval();
    }
  }
  mesh.triangles.conservativeResize(kept, 3);
  return mesh;
}

TEST_F(Cdt, AnOpenSurfaceIsCutWithLessEnergy)
{
  const TriangleMesh closed = test::sphere(3);
  const TriangleMesh mesh = ragged(closed);
  TetrahedralizeOptions options;
  options.method = TetMethod::cdt;
  const Outcome cut = run(mesh, options);
  ASSERT_TRUE(cut.status.ok()) << cut.status.message;
  EXPECT_EQ(cut.status.report.text("segmentation"), "graph-cut");
  EXPECT_GT(cut.number("counts.changed_by_cut"), 0.0);
  EXPECT_LT(cut.number("energy"), cut.number("threshold_energy"));
  EXPECT_TRUE(check_tets(cut.result.mesh.points, cut.result.mesh.tets).ok());
  const double whole = signed_volume(closed.points, closed.triangles);
  EXPECT_NEAR(cut.volume(), whole, 0.02 * whole);

  options.segmentation = SegmentationMethod::threshold;
  const Outcome plain = run(mesh, options);
  ASSERT_TRUE(plain.status.ok()) << plain.status.message;
  EXPECT_EQ(plain.status.report.text("segmentation"), "threshold");
  EXPECT_EQ(plain.status.report.find("energy"), nullptr);
  // The cut's skin is smaller: no ragged border across the holes.
  const auto skin = [](const Outcome& outcome) {
    return surface_area(outcome.result.mesh.points, boundary_triangles(outcome.result.mesh.tets));
  };
  EXPECT_LT(skin(cut), skin(plain));
}

TEST_F(Cdt, TheWholeHullCanBeKept)
{
  // Two boxes with a gap: a fifth of their hull is outside.
  const TriangleMesh closed =
    test::join(test::cube(0.0, 1.0), test::translated(test::cube(0.0, 1.0), Vec3(1.5, 0, 0)));
  TriangleMesh open = closed;
  open.triangles.conservativeResize(open.triangles.rows() - 2, 3);
  for (const TriangleMesh& mesh : { closed, open })
  {
    TetrahedralizeOptions options;
    options.method = TetMethod::cdt;
    const Outcome kept = run(mesh, options);
    ASSERT_TRUE(kept.status.ok()) << kept.status.message;
    options.keep_outside = true;
    const Outcome outcome = run(mesh, options);
    ASSERT_TRUE(outcome.status.ok()) << outcome.status.message;
    const TetrahedralizeResult& result = outcome.result;
    EXPECT_NEAR(outcome.volume(), 2.5, 1e-9) << "the hull";
    const Eigen::VectorXd volumes = tet_volumes(result.mesh.points, result.mesh.tets);
    ASSERT_EQ(static_cast<Index>(result.labels.size()), volumes.size());
    double inside = 0.0;
    Index count = 0;
    for (Index t = 0; t < volumes.size(); ++t)
    {
      const bool above = result.winding_numbers[t] >= options.winding_threshold;
      const int label = static_cast<int>(result.labels[t]);
      EXPECT_EQ(above, label == 1 || label == -1) << t;
      inside += label > 0 ? volumes[t] : 0.0;
      count += label > 0;
    }
    EXPECT_NEAR(inside, kept.volume(), 1e-9) << "what is inside is what is kept else";
    EXPECT_NEAR(outcome.number("volume"), inside, 1e-12);
    EXPECT_EQ(outcome.number("counts.tets_inside"), count);
    EXPECT_EQ(outcome.number("counts.tets"), volumes.size());
    // Of all corners of the boxes; no vertex is added.
    EXPECT_EQ(result.mesh.points.rows(), mesh.points.rows());
  }
  TetrahedralizeOptions options;
  options.keep_outside = true;
  EXPECT_EQ(run(closed, options).status.code, StatusCode::invalid_input);
}

TEST_F(Cdt, ACutThatLosesTheVolumeIsLeftForTheThreshold)
{
  const TriangleMesh mesh = ragged(test::torus(40, 20, 1.0, 0.4));
  TetrahedralizeOptions options;
  options.method = TetMethod::cdt;
  options.segmentation = SegmentationMethod::threshold;
  const Outcome plain = run(mesh, options);
  ASSERT_TRUE(plain.status.ok()) << plain.status.message;
  options.segmentation = SegmentationMethod::graph_cut;
  options.cut_smoothness = 1e6; // smoothness at any price: all of the hull or nothing
  options.cut_sigma = 10.0;
  const Outcome smooth = run(mesh, options);
  ASSERT_TRUE(smooth.status.ok()) << smooth.status.message;
  EXPECT_EQ(smooth.status.report.text("segmentation"), "threshold");
  EXPECT_EQ(smooth.volume(), plain.volume());
}

TEST_F(Cdt, AClosedSurfaceNeedsNoCut)
{
  const Outcome outcome = run(test::sphere(2), TetMethod::cdt);
  ASSERT_TRUE(outcome.status.ok()) << outcome.status.message;
  EXPECT_EQ(outcome.status.report.text("segmentation"), "threshold");
  EXPECT_EQ(outcome.status.report.find("counts.changed_by_cut"), nullptr);
}

TEST(Tetrahedralize, TinyAndHugeCoordinates)
{
  for (const double scale : { 1e-9, 1e9 })
  {
    TriangleMesh mesh = test::torus(20, 10, 1.0, 0.4);
    const double volume = signed_volume(mesh.points, mesh.triangles) * scale * scale * scale;
    mesh.points *= scale;
    const Outcome outcome = run(mesh, TetMethod::automatic);
    ASSERT_TRUE(outcome.status.ok()) << outcome.status.message;
    EXPECT_NEAR(outcome.volume(), volume, 0.1 * volume);
    EXPECT_TRUE(check_tets(outcome.result.mesh.points, outcome.result.mesh.tets).ok());
  }
}

TEST_F(Cdt, RandomSoupsGiveTetsOrASentence)
{
  // Whatever it is: a valid mesh that holds what the winding number encloses, or one sentence.
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

// ---- Handles
// -------------------------------------------------------------------------------------

namespace
{
HandlePlaces places_of(const std::vector<Vec3>& points)
{
  HandlePlaces places;
  places.points.resize(static_cast<Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    places.points.row(static_cast<Index>(i)) = points[i];
  }
  return places;
}

/// Vertices on the segment between two points, ordered along it, as fractions.
std::vector<double> vertices_on(const Points& points, const Vec3& a, const Vec3& b)
{
  std::vector<double> at;
  for (Index v = 0; v < points.rows(); ++v)
  {
    const Vec3 d = points.row(v).transpose() - a;
    const double t = d.dot(b - a) / (b - a).squaredNorm();
    if (t > -1e-9 && t < 1.0 + 1e-9 && (d - t * (b - a)).norm() < 1e-9)
    {
      at.push_back(t);
    }
  }
  std::sort(at.begin(), at.end());
  return at;
}
} // namespace

TEST_F(Cdt, PointsOfHandlesBecomeVertices)
{
  const TriangleMesh ball = test::sphere(3);
  TetrahedralizeOptions options;
  options.method = TetMethod::cdt;
  // Inside, at a vertex of the surface, outside, and on the middle of a triangle.
  const Vec3 vertex = ball.points.row(7);
  const Vec3 middle =
    (ball.points.row(ball.triangles(5, 0)) + ball.points.row(ball.triangles(5, 1)) +
      ball.points.row(ball.triangles(5, 2)))
      .transpose() /
    3.0;
  options.handles = places_of({ Vec3(0.1, 0.2, 0.3), vertex, Vec3(2, 0, 0), middle });
  const Outcome outcome = run(ball, options);
  expect_valid(outcome, ball);
  const auto& found = outcome.result.handle_vertices;
  ASSERT_EQ(found.size(), 4u);
  ASSERT_GE(found[0], 0);
  EXPECT_EQ(Vec3(outcome.result.mesh.points.row(found[0])), Vec3(0.1, 0.2, 0.3));
  ASSERT_GE(found[1], 0);
  EXPECT_EQ(outcome.result.original_vertices[found[1]], 7);
  EXPECT_EQ(found[2], -1);
  EXPECT_EQ(found[3], -1) << "the surface's triangles stay as they are";
  EXPECT_EQ(outcome.number("counts.handle_points"), 4);
  EXPECT_EQ(outcome.number("counts.handle_vertices"), 2);
  EXPECT_NEAR(outcome.volume(), signed_volume(ball.points, ball.triangles), 1e-12);
  EXPECT_EQ(boundary_triangles(outcome.result.mesh.tets).rows(), ball.triangles.rows());
}

TEST_F(Cdt, BonesAndCagesGetVerticesAtTheLocalEdgeLength)
{
  const TriangleMesh ball = test::sphere(4);
  const Vec3 head(-0.6, 0.05, 0.02), tail(0.6, -0.03, 0.01);
  const Vec3 a(-0.3, 0.3, 0.2), b(0.4, 0.35, 0.25), c(0.1, -0.1, 0.5);
  TetrahedralizeOptions options;
  options.method = TetMethod::cdt;
  options.handles = places_of({ head, tail, a, b, c });
  options.handles.segments.resize(1, 2);
  options.handles.segments << 0, 1;
  options.handles.triangles.resize(1, 3);
  options.handles.triangles << 2, 3, 4;
  const Outcome outcome = run(ball, options);
  expect_valid(outcome, ball);
  const TetMesh& mesh = outcome.result.mesh;
  const std::vector<double> on = vertices_on(mesh.points, head, tail);
  ASSERT_GE(on.size(), 8u);
  EXPECT_NEAR(on.front(), 0.0, 1e-12);
  EXPECT_NEAR(on.back(), 1.0, 1e-12);
  const double largest = 0.04 * bounding_box(ball.points).diagonal();
  for (std::size_t i = 1; i < on.size(); ++i)
  {
    EXPECT_LT((on[i] - on[i - 1]) * (tail - head).norm(), 1.01 * largest);
  }
  // On the cage's face: no point of it is far from a vertex on it.
  std::vector<Vec3> face;
  const Vec3 normal = (b - a).cross(c - a).normalized();
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    const Vec3 p = mesh.points.row(v);
    if (std::abs((p - a).dot(normal)) < 1e-9)
    {
      face.push_back(p);
    }
  }
  for (int i = 0; i <= 10; ++i)
  {
    for (int j = 0; i + j <= 10; ++j)
    {
      const Vec3 p = a + 0.1 * i * (b - a) + 0.1 * j * (c - a);
      double nearest = 1e9;
      for (const Vec3& q : face)
      {
        nearest = std::min(nearest, (p - q).norm());
      }
      EXPECT_LT(nearest, largest);
    }
  }
}

TEST_F(Cdt, HandlesNeedNoRefinement)
{
  TetrahedralizeOptions options;
  options.method = TetMethod::cdt;
  options.quality = 0.0;
  options.interior_edge = 0.0;
  options.handles = places_of({ Vec3(0.1, 0.0, 0.2) });
  const Outcome outcome = run(test::cube(), options);
  expect_valid(outcome, test::cube());
  EXPECT_EQ(outcome.result.mesh.points.rows(), 9);
  EXPECT_EQ(outcome.result.handle_vertices, std::vector<Index>{ 8 });
  EXPECT_NEAR(outcome.volume(), 8.0, 1e-12);
}

TEST(Tetrahedralize, BadHandlesAreRefused)
{
  TetrahedralizeOptions options;
  options.handles = places_of({ Vec3(0, 0, std::numeric_limits<double>::quiet_NaN()) });
  EXPECT_THAT(run(test::cube(), options).status.message, HasSubstr("not finite"));
  options.handles = places_of({ Vec3::Zero() });
  options.handles.segments.resize(1, 2);
  options.handles.segments << 0, 1;
  const Outcome outcome = run(test::cube(), options);
  EXPECT_EQ(outcome.status.code, StatusCode::invalid_input);
  EXPECT_THAT(outcome.status.message, HasSubstr("handle segment 0 has point 1"));
}

// ---- Nothing to fill
// -----------------------------------------------------------------------------

TEST(Tetrahedralize, WhereNothingFitsEmbedIsNamed)
{
  TetrahedralizeOptions options;
  options.winding_threshold = 1.5;
  const Outcome outcome = run(test::cube(), options);
  EXPECT_EQ(outcome.status.code, StatusCode::invalid_input);
  EXPECT_THAT(outcome.status.message, HasSubstr("--method embed"));
  EXPECT_EQ(outcome.result.mesh.tets.rows(), 0);
  options.method = TetMethod::embed;
  expect_valid(run(test::cube(), options), test::cube());
}

TEST_F(Cdt, FlatTetsAreSwappedAndTheSurfaceStays)
{
  const TriangleMesh elephant = test::demo_mesh("elephant.off");
  const Outcome outcome = run(elephant, TetMethod::cdt);
  expect_valid(outcome, elephant);
  EXPECT_GE(outcome.number("min_dihedral_angle"), 8.0);
  EXPECT_NEAR(
    outcome.volume(), signed_volume(elephant.points, elephant.triangles), 1e-10 * outcome.volume());
  EXPECT_EQ(boundary_triangles(outcome.result.mesh.tets).rows(), elephant.triangles.rows());
}

// ---- wrap and ftetwild -------------------------------------------------------------------------

namespace
{
class Wrap : public test::NeedsMesher
{
};

/// Every vertex and centre of the surface lies in a tet or on their boundary.
void expect_to_hold(const TetMesh& mesh, const TriangleMesh& surface)
{
  ExecutionContext context;
  WindingNumber winding;
  const Triangles skin = boundary_triangles(mesh.tets);
  ASSERT_TRUE(winding.build(mesh.points, skin, context).ok());
  const TriangleTree tree(mesh.points, skin);
  const double near = 1e-14 * bounding_box(surface.points, surface.triangles).diagonal();
  const auto held = [&](const Vec3& p)
  { return std::abs(winding.evaluate_exactly_at(p) - 1.0) < 1e-6 || tree.distance(p, 1e9) < near; };
  for (Index f = 0; f < surface.triangles.rows(); ++f)
  {
    Vec3 center = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 p = surface.points.row(surface.triangles(f, k));
      EXPECT_TRUE(held(p)) << f;
      center += p / 3.0;
    }
    EXPECT_TRUE(held(center)) << f;
  }
}
} // namespace

TEST_F(Wrap, HoldsAnySurface)
{
  TriangleMesh triangle = test::grid(1, 1);
  triangle.triangles.conservativeResize(1, 3);
  struct Case
  {
    const char* name;
    TriangleMesh mesh;
    Index characteristic;
    double enclosed; ///< by winding numbers of at least 0.5
    const char* warning; ///< empty: none
  };
  const TriangleMesh torus = test::torus(24, 12, 1.0, 0.4);
  const TriangleMesh far_apart =
    test::join(triangle, test::translated(triangle, Vec3(0.1, 0.2, 3.0)));
  TetrahedralizeOptions options;
  options.method = TetMethod::wrap;
  options.wrap_alpha = 0.08;
  options.wrap_offset = 0.004;
  for (const Case& c : { Case{ "cube", test::cube(), 1, 8.0, "" },
         Case{ "torus", torus, 0, signed_volume(torus.points, torus.triangles), "" },
         Case{ "open cube", test::open_cube(), 1, 8.0, "thin shell" },
         Case{ "triangle", triangle, 1, 0.0, "thin shell" },
         Case{ "sheet", test::grid(3, 2), 1, 0.0, "10 boundary edges" },
         Case{ "soup", far_apart, 2, 0.0, "6 boundary edges" },
         Case{
           "doubled both ways", test::join(test::cube(), test::flipped(test::cube())), 1, 0.0, "" },
         Case{ "unwelded", unwelded(test::cube()), 1, 8.0, "" } })
  {
    SCOPED_TRACE(c.name);
    const Outcome outcome = run(c.mesh, options);
    expect_valid(outcome, c.mesh);
    EXPECT_EQ(outcome.method(), "wrap");
    expect_to_hold(outcome.result.mesh, c.mesh);
    EXPECT_EQ(test::euler_characteristic(outcome.result.mesh), c.characteristic);
    EXPECT_EQ(outcome.number("counts.kept_vertices"), 0.0);
    EXPECT_EQ(outcome.result.original_vertices.front(), -1);
    EXPECT_NEAR(outcome.number("winding_volume"), c.enclosed, 0.01 * c.enclosed);
    // No nearer than the offset anywhere, and that near at least somewhere; concave corners are
    // farther, by what the ball leaves in them.
    EXPECT_GE(outcome.number("distance_max"), 100.0 * options.wrap_offset * 0.99);
    EXPECT_LE(outcome.number("distance_max"), 100.0 * (options.wrap_alpha + options.wrap_offset));
    const auto& warnings = outcome.status.warnings;
    const std::string all = warnings.empty() ? "" : warnings.back();
    EXPECT_THAT(all, HasSubstr(c.warning));
    if (*c.warning == 0)
    {
      EXPECT_THAT(all, Not(HasSubstr("thin shell")));
    }
  }
}

TEST_F(Wrap, AnOpenSurfaceIsWarnedOfWithBothVolumes)
{
  TetrahedralizeOptions options;
  options.method = TetMethod::wrap;
  options.wrap_alpha = 0.05;
  options.wrap_offset = 0.002;
  const Outcome outcome = run(test::open_cube(), options);
  expect_valid(outcome, test::open_cube());
  ASSERT_FALSE(outcome.status.warnings.empty());
  const std::string& warning = outcome.status.warnings.back();
  EXPECT_THAT(warning, HasSubstr("4 boundary edges"));
  EXPECT_THAT(warning, HasSubstr("the winding number encloses 8"));
  // Five sides of 4, two offsets thick, and in each of the eight inner edges of length 2 what the
  // ball leaves, less than the square of its radius.
  const double diagonal = std::sqrt(12.0);
  const double shell = 20.0 * 2.0 * options.wrap_offset * diagonal;
  const double fillets = 16.0 * std::pow((options.wrap_alpha + options.wrap_offset) * diagonal, 2);
  EXPECT_GT(outcome.volume(), 0.97 * shell);
  EXPECT_LT(outcome.volume(), 1.1 * shell + fillets);
  EXPECT_THAT(warning, HasSubstr("it holds 0."));
}

TEST_F(Wrap, ThresholdsAndThreadsDoNotMatter)
{
  TetrahedralizeOptions options;
  options.method = TetMethod::wrap;
  options.wrap_alpha = 0.1;
  const TriangleMesh mesh = test::torus(20, 10, 1.0, 0.4);
  const Outcome one = run(mesh, options, 1);
  options.winding_threshold = 1.5;
  const Outcome two = run(mesh, options, 2);
  expect_valid(one, mesh);
  expect_valid(two, mesh);
  EXPECT_EQ(one.result.mesh.points, two.result.mesh.points);
  EXPECT_EQ(one.result.mesh.tets, two.result.mesh.tets);
  EXPECT_EQ(two.number("winding_volume"), 0.0);
}

TEST_F(Wrap, SizesInsideAreKept)
{
  TetrahedralizeOptions options;
  options.method = TetMethod::wrap;
  options.quality = 0.0;
  options.interior_edge = 0.0;
  const Outcome none = run(test::sphere(2), options);
  options.interior_edge = 0.03;
  const Outcome many = run(test::sphere(2), options);
  EXPECT_GT(many.number("counts.tet_vertices"), 1.5 * none.number("counts.tet_vertices"));
  EXPECT_EQ(many.number("counts.wrap_triangles"), none.number("counts.wrap_triangles"));
}

TEST_F(Wrap, PointsOfHandlesBecomeVertices)
{
  TetrahedralizeOptions options;
  options.method = TetMethod::wrap;
  options.wrap_alpha = 0.1;
  options.handles = places_of({ Vec3(0.1, 0.2, 0.3), Vec3(2, 0, 0) });
  const Outcome outcome = run(test::sphere(2), options);
  expect_valid(outcome, test::sphere(2));
  const auto& found = outcome.result.handle_vertices;
  ASSERT_EQ(found.size(), 2u);
  ASSERT_GE(found[0], 0);
  EXPECT_EQ(Vec3(outcome.result.mesh.points.row(found[0])), Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(found[1], -1);
}

TEST_F(Wrap, IsOneSentenceWhereThereIsNone)
{
  TriangleMesh nan = test::cube();
  nan.points(4, 2) = std::numeric_limits<double>::quiet_NaN();
  TriangleMesh needle = test::grid(1, 1);
  needle.points.col(1).setZero();
  TetrahedralizeOptions options;
  options.method = TetMethod::wrap;
  EXPECT_THAT(run(nan, options).status.message, HasSubstr("vertex 4"));
  EXPECT_THAT(
    run({ Points(0, 3), Triangles(0, 3) }, options).status.message, HasSubstr("no triangles"));
  EXPECT_THAT(run(needle, options).status.message, HasSubstr("area"));
  options.wrap_alpha = 0.0;
  EXPECT_THAT(run(test::cube(), options).status.message, HasSubstr("wrap_alpha"));
  options.wrap_alpha = 0.0005;
  options.time_limit = 0.5;
  const Outcome late = run(test::cube(), options);
  EXPECT_EQ(late.status.code, StatusCode::internal_error);
  EXPECT_THAT(late.status.message, HasSubstr("time limit"));
  EXPECT_EQ(late.result.mesh.tets.rows(), 0);
}

TEST(Tetrahedralize, WrapNeedsTheHelper)
{
  const Environment no_helper("BINDPOSE_MESHER", "/nowhere");
  EXPECT_EQ(run(test::cube(), TetMethod::wrap).status.code, StatusCode::unavailable);
}

TEST(Tetrahedralize, FtetwildIsJudgedLikeAnyOther)
{
  // In its place a script that gives the cube in its own frame, whatever it is asked.
  test::Folder folder;
  const TetMesh box = test::tet_box(2, 2, 2, Vec3::Constant(-0.5), Vec3::Constant(0.5));
  ASSERT_TRUE(write_medit(folder / "tets.mesh", box.points, Triangles(0, 3), box.tets).ok());
  const std::string path = folder.write("ftetwild",
    "#!/bin/sh\nwhile [ \"$1\" != --output ]; do shift; done\ncp \"$(dirname "
    "\"$0\")/tets.mesh\" \"$2\"\n");
  ::chmod(path.c_str(), 0755);
  const Environment program("BINDPOSE_FTETWILD", path);
  const Outcome right = run(test::cube(), TetMethod::ftetwild);
  expect_valid(right, test::cube());
  EXPECT_EQ(right.method(), "ftetwild");
  EXPECT_NEAR(right.volume(), 8.0, 1e-12);
  EXPECT_NEAR(right.number("distance_max"), 0.0, 1e-12);
  EXPECT_EQ(right.number("counts.kept_vertices"), 0.0);
  EXPECT_TRUE(right.status.warnings.empty());
  // A box of 1.4 times the volume: taken with a warning, and as far off as it is.
  TriangleMesh longer = test::cube();
  longer.points.col(0) *= 1.0 / 1.4;
  const Outcome off = run(longer, TetMethod::ftetwild);
  expect_valid(off, longer);
  ASSERT_EQ(off.status.warnings.size(), 1u);
  EXPECT_THAT(off.status.warnings[0], HasSubstr("but the winding number encloses"));
  EXPECT_GT(off.number("distance_max"), 5.0);
  // More than twice: no result.
  TriangleMesh thin = test::cube();
  thin.points.col(0) *= 0.2;
  const Outcome wrong = run(thin, TetMethod::ftetwild);
  EXPECT_EQ(wrong.status.code, StatusCode::internal_error);
  EXPECT_EQ(wrong.result.mesh.tets.rows(), 0);
  // It has its own idea of inside.
  TetrahedralizeOptions options;
  options.method = TetMethod::ftetwild;
  options.winding_threshold = 0.7;
  EXPECT_THAT(run(test::cube(), options).status.message, HasSubstr("winding_threshold"));
  const Environment none("BINDPOSE_FTETWILD", "/nowhere");
  EXPECT_EQ(run(test::cube(), TetMethod::ftetwild).status.code, StatusCode::unavailable);
}
