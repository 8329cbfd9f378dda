// Method remesh: well-shaped, graded tets of the region that the winding number defines.
#include "inside/remesh_tets.h"

#include "base/constants.h"
#include "helper/mesher_process.h"
#include "inside/tetrahedralize.h"
#include "surface/triangle_tree.h"
#include "tets/tet_quality.h"

#include "support/cancel_later.h"
#include "support/environment.h"
#include "support/meshes.h"
#include "support/needs_mesher.h"
#include "support/stand_in.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <set>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
struct RemeshOutcome
{
  RemeshResult result;
  Status status;
  double volume() const
  {
    return tet_volumes(this->result.mesh.points, this->result.mesh.tets).sum();
  }
  Index kept_vertices() const
  {
    const auto& ids = this->result.original_vertices;
    return std::count_if(ids.begin(), ids.end(), [](Index id) { return id >= 0; });
  }
  double angle() const
  {
    return measure_tets(this->result.mesh.points, this->result.mesh.tets).min_dihedral_angle;
  }
};

RemeshOutcome run_remesh(
  const TriangleMesh& mesh, const RemeshOptions& options = {}, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  const WindingNumber winding(mesh.points, mesh.triangles);
  RemeshOutcome outcome;
  outcome.status =
    remesh_tets(context, mesh.points, mesh.triangles, winding, options, outcome.result);
  return outcome;
}

/// Report whether the triangles form one ring around every vertex of a closed surface.
bool is_manifold(const Triangles& skin)
{
  for (const Edge& edge : mesh_edges(skin))
  {
    if (edge.triangle_count != 2 || edge.net_direction != 0)
    {
      return false;
    }
  }
  // `next[v][a] == b` means that b follows a in the ring of neighbors around vertex v.
  std::map<Index, std::map<Index, Index>> next;
  for (Index t = 0; t < skin.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      next[skin(t, k)][skin(t, (k + 1) % 3)] = skin(t, (k + 2) % 3);
    }
  }
  for (const auto& [vertex, around] : next)
  {
    std::size_t steps = 0;
    Index at = around.begin()->first;
    do
    {
      at = around.at(at);
      ++steps;
    } while (at != around.begin()->first && steps <= around.size());
    if (steps != around.size())
    {
      return false;
    }
  }
  return true;
}

/// Expect the invariants that every result has.
void expect_valid_remesh(
  const RemeshOutcome& outcome, const TriangleMesh& surface, double angle = 8.0)
{
  ASSERT_TRUE(outcome.status.ok()) << outcome.status.message;
  const TetMesh& mesh = outcome.result.mesh;
  ASSERT_GT(mesh.tets.rows(), 0);
  ASSERT_TRUE(check_mesh(mesh.points, mesh.tets).ok());
  EXPECT_TRUE(check_tets(mesh.points, mesh.tets).ok());
  EXPECT_GE(outcome.angle(), angle);
  EXPECT_TRUE(is_manifold(boundary_triangles(mesh.tets)));
  const Components components = connected_components(mesh.points.rows(), mesh.tets);
  EXPECT_EQ(
    std::count(components.component_of_vertex.begin(), components.component_of_vertex.end(), -1),
    0);
  const auto& ids = outcome.result.original_vertices;
  ASSERT_EQ(static_cast<Index>(ids.size()), mesh.points.rows());
  const auto fresh = std::find(ids.begin(), ids.end(), -1);
  EXPECT_TRUE(std::is_sorted(ids.begin(), fresh));
  EXPECT_TRUE(std::all_of(fresh, ids.end(), [](Index id) { return id == -1; }));
  for (auto id = ids.begin(); id != fresh; ++id)
  {
    ASSERT_EQ(mesh.points.row(id - ids.begin()), surface.points.row(*id));
  }
}

/// Return the mean edge length of the tets whose first corner is at most `reach` away from p.
double edge_length_near(const TetMesh& mesh, const Vec3& p, double reach)
{
  double sum = 0.0;
  double count = 0.0;
  for (Index t = 0; t < mesh.tets.rows(); ++t)
  {
    if ((mesh.points.row(mesh.tets(t, 0)).transpose() - p).norm() > reach)
    {
      continue;
    }
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        sum += (mesh.points.row(mesh.tets(t, i)) - mesh.points.row(mesh.tets(t, j))).norm();
        count += 1.0;
      }
    }
  }
  return sum / count;
}

/// Give every triangle its own vertices and move each vertex by up to `by` along each axis. The
/// triangles then cross.
TriangleMesh shaken_soup(const TriangleMesh& mesh, double by)
{
  test::Random random(5);
  TriangleMesh soup;
  soup.points.resize(mesh.triangles.size(), 3);
  soup.triangles.resize(mesh.triangles.rows(), 3);
  for (Index k = 0; k < mesh.triangles.size(); ++k)
  {
    soup.points.row(k) = mesh.points.row(mesh.triangles.data()[k]) +
      random.in_box(Vec3::Constant(-by), Vec3::Constant(by)).transpose();
    soup.triangles.data()[k] = k;
  }
  return soup;
}

constexpr const char* sleep_script = "exec sleep 60\n";

class Remesh : public test::MesherTest
{
};
} // namespace

// ---- Results ---------------------------------------------------------------------------------

TEST_F(Remesh, ClosedSurfacesKeepVolumeVerticesAndShape)
{
  struct Case
  {
    const char* name;
    TriangleMesh mesh;
    double kept_fraction; ///< fraction of the input vertices that must be kept
  };
  const TriangleMesh shell = test::join(test::sphere(3), test::flipped(test::sphere(2, 0.5)));
  for (const Case& c : { Case{ "cube", test::cube(), 1.0 }, Case{ "sphere", test::sphere(3), 0.99 },
         Case{ "torus", test::torus(60, 30, 1.0, 0.4), 0.97 }, Case{ "shell", shell, 0.99 },
         Case{ "far away", test::translated(test::sphere(3), Vec3(500, -300, 90)), 0.99 } })
  {
    SCOPED_TRACE(c.name);
    const RemeshOutcome outcome = run_remesh(c.mesh);
    expect_valid_remesh(outcome, c.mesh, 11.0);
    const double volume = signed_volume(c.mesh.points, c.mesh.triangles);
    EXPECT_NEAR(outcome.volume(), volume, 0.004 * volume);
    EXPECT_GE(outcome.kept_vertices(), static_cast<Index>(c.kept_fraction * c.mesh.points.rows()));
    EXPECT_EQ(outcome.result.boundary_vertices, c.mesh.points.rows());
    EXPECT_LT(outcome.status.report.number("distance_max", 100.0), 0.5);
    EXPECT_LT(outcome.status.report.number("distance_mean", 100.0), 0.03);
  }
  EXPECT_NEAR(run_remesh(test::cube()).volume(), 8.0, 1e-6) << "creases are found again";
}

TEST_F(Remesh, OpenCubeGetsALid)
{
  const TriangleMesh cube = test::open_cube();
  const RemeshOutcome outcome = run_remesh(cube);
  expect_valid_remesh(outcome, cube, 11.0);
  // The winding number exceeds 0.5 up to the rim of the opening and also above it. The region of
  // the tets is therefore cut off at the bounding box.
  EXPECT_NEAR(outcome.volume(), 8.0, 0.01);
  EXPECT_EQ(outcome.kept_vertices(), 8);
  EXPECT_LT(outcome.status.report.number("distance_max", 100.0), 0.5) << "the lid does not count";
  // With a higher threshold, the boundary of the tets across the opening is farther inside.
  RemeshOptions high;
  high.winding_threshold = 0.9;
  const RemeshOutcome lower = run_remesh(cube, high);
  expect_valid_remesh(lower, cube, 6.0);
  EXPECT_LT(lower.volume(), 0.9 * outcome.volume());
}

TEST_F(Remesh, CrossingSolidsAreOne)
{
  const double d = 0.9;
  const TriangleMesh spheres = test::join(test::sphere(3), test::sphere(3, 1.0, Vec3(d, 0, 0)));
  const RemeshOutcome outcome = run_remesh(spheres);
  expect_valid_remesh(outcome, spheres);
  const double balls = 8.0 / 3.0 * pi - pi * (4.0 + d) * (2.0 - d) * (2.0 - d) / 12.0;
  EXPECT_NEAR(outcome.volume(), balls, 0.01 * balls);
  // A vertex of one sphere is on the boundary only if it is outside of the other sphere.
  Index outside = 0;
  for (Index v = 0; v < spheres.points.rows(); ++v)
  {
    const Vec3 p = spheres.points.row(v);
    const Vec3 other = 2 * v < spheres.points.rows() ? Vec3(d, 0, 0) : Vec3(0, 0, 0);
    outside += (p - other).norm() > 1.0;
  }
  EXPECT_NEAR(outcome.result.boundary_vertices, outside, 0.02 * outside);
  EXPECT_GT(outcome.kept_vertices(), 0.95 * outside);
  EXPECT_LE(outcome.kept_vertices(), outcome.result.boundary_vertices);
}

TEST_F(Remesh, ASoupThatCrosses)
{
  const TriangleMesh soup = shaken_soup(test::sphere(3), 0.01);
  const RemeshOutcome outcome = run_remesh(soup);
  expect_valid_remesh(outcome, soup);
  EXPECT_NEAR(outcome.volume(), 4.0 / 3.0 * pi, 0.04 * 4.0 / 3.0 * pi);
}

TEST_F(Remesh, SquaresOfFourPointsOnACircleLeaveNoClusters)
{
  // The four corners of a square are on a circle, so a tet with these corners is flat. Rounding can
  // move the circumcenter of a flat tet anywhere. Without special treatment the refinement would
  // not end near such tets.
  const TriangleMesh torus = test::torus(48, 24, 1.0, 0.4);
  const TriangleMesh loose = test::unwelded(torus);
  TriangleMesh turned = torus;
  for (Index t = 0; t < turned.triangles.rows(); t += 5)
  {
    turned.triangles.row(t).tail<2>().reverseInPlace();
  }
  for (const TriangleMesh& mesh : { torus, loose })
  {
    const RemeshOutcome outcome = run_remesh(mesh);
    expect_valid_remesh(outcome, mesh, 11.0);
    EXPECT_EQ(outcome.kept_vertices(), torus.points.rows());
  }
  for (const TriangleMesh& mesh : { turned, loose, test::flipped(torus) })
  {
    ExecutionContext context;
    TetrahedralizeOptions options;
    options.method = TetMethod::remesh;
    TetrahedralizeResult result;
    const Status status = tetrahedralize(context, mesh.points, mesh.triangles, options, result);
    ASSERT_TRUE(status.ok()) << status.message;
    EXPECT_GE(status.report.number("min_dihedral_angle", 0.0), 8.0);
    const double volume = signed_volume(torus.points, torus.triangles);
    EXPECT_NEAR(status.report.number("volume", 0.0), volume, 0.004 * volume);
  }
}

TEST_F(Remesh, TetsAreSmallWhereTheSurfaceIsFine)
{
  const TriangleMesh mesh =
    test::join(test::sphere(2), test::sphere(4, 0.25, Vec3(1.05, 0.0, 0.0)));
  RemeshOptions options;
  options.largest_edge = 0.1;
  const RemeshOutcome outcome = run_remesh(mesh, options);
  expect_valid_remesh(outcome, mesh);
  const double fine = edge_length_near(outcome.result.mesh, Vec3(1.3, 0, 0), 0.08);
  const double coarse = edge_length_near(outcome.result.mesh, Vec3(-0.3, 0, 0), 0.4);
  EXPECT_GT(coarse, 4.0 * fine);
}

TEST_F(Remesh, ThinPlatesAreKept)
{
  TriangleMesh plate = test::cube(0.0, 1.0);
  plate.points.col(2) *= 0.02; // the triangle edges are as long as the plate is wide
  RemeshOptions options;
  options.largest_edge = 0.1;
  const RemeshOutcome outcome = run_remesh(plate, options);
  expect_valid_remesh(outcome, plate);
  EXPECT_NEAR(outcome.volume(), 0.02, 0.001);
}

TEST_F(Remesh, ABoundaryThatIsTooThinIsRefusedBeforeTheRefinement)
{
  // The two large faces of the plate are thin: 2 of the whole area, 8.
  TriangleMesh plate = test::cube(0.0, 1.0);
  plate.points.col(2) *= 0.002;
  const TriangleMesh mesh =
    test::join(test::cube(0.0, 1.0), test::translated(plate, Vec3(2, 0, 0)));
  RemeshOptions options;
  options.maximum_thin_fraction = 0.2;
  const RemeshOutcome refused = run_remesh(mesh, options);
  EXPECT_EQ(refused.status.code, StatusCode::internal_error);
  EXPECT_THAT(refused.status.message, HasSubstr("thinner than the smallest edge (at most 20 %"));
  EXPECT_NEAR(refused.status.report.number("thin_fraction", -1.0), 0.25, 0.02);
  EXPECT_EQ(refused.result.mesh.tets.rows(), 0);
  options.maximum_thin_fraction = 0.3;
  const RemeshOutcome outcome = run_remesh(mesh, options);
  EXPECT_TRUE(outcome.status.ok()) << outcome.status.message;
  EXPECT_NEAR(outcome.status.report.number("thin_fraction", -1.0), 0.25, 0.02);
}

TEST_F(Remesh, LengthsAreFractions)
{
  // Scaling by a power of two does not round, so the tets are the same.
  const TriangleMesh mesh = test::torus(24, 12, 1.0, 0.4);
  const RemeshOutcome reference = run_remesh(mesh);
  for (const double scale : { 9.313225746154785e-10, 1073741824.0 })
  {
    TriangleMesh scaled = mesh;
    scaled.points *= scale;
    const RemeshOutcome outcome = run_remesh(scaled);
    expect_valid_remesh(outcome, scaled);
    EXPECT_NEAR(
      outcome.volume() / (scale * scale * scale), reference.volume(), 0.002 * reference.volume());
    EXPECT_NEAR(outcome.status.report.number("distance_mean", -1.0),
      reference.status.report.number("distance_mean", -2.0), 0.005);
  }
}

TEST_F(Remesh, SameBitsEveryTimeAndForAnyNumberOfThreads)
{
  const TriangleMesh mesh =
    test::join(test::open_cube(), test::translated(test::sphere(2), Vec3(0.6, 0.5, 0.4)));
  const RemeshOutcome reference = run_remesh(mesh, {}, 1);
  ASSERT_TRUE(reference.status.ok()) << reference.status.message;
  for (const int threads : { 1, 2 })
  {
    const RemeshOutcome again = run_remesh(mesh, {}, threads);
    ASSERT_EQ(reference.result.mesh.points, again.result.mesh.points);
    ASSERT_EQ(reference.result.mesh.tets, again.result.mesh.tets);
    EXPECT_EQ(reference.result.distance.mean, again.result.distance.mean);
  }
}

TEST_F(Remesh, TetLimitHolds)
{
  RemeshOptions options;
  options.smallest_edge = options.largest_edge = 0.002;
  options.tet_limit = 20000;
  const RemeshOutcome outcome = run_remesh(test::sphere(3), options);
  expect_valid_remesh(outcome, test::sphere(3));
  EXPECT_LT(outcome.result.mesh.tets.rows(), 60000);
}

// ---- Difficult input -------------------------------------------------------------------------

TEST_F(Remesh, ASheetBesideASolidEnds)
{
  const TriangleMesh mesh =
    test::join(test::sphere(3), test::translated(test::grid(8, 8, 2.0, 2.0), Vec3(1.2, -1, 0)));
  RemeshOptions options;
  options.time_limit = 20.0;
  const auto start = std::chrono::steady_clock::now();
  const RemeshOutcome outcome = run_remesh(mesh, options);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_LT(seconds.count(), 60.0);
  if (outcome.status.ok())
  {
    EXPECT_NEAR(outcome.volume(), 4.0 / 3.0 * pi, 0.05 * 4.0 / 3.0 * pi);
  }
  // The method must also succeed when tetrahedralize() calls it.
  ExecutionContext context;
  TetrahedralizeOptions tet_options;
  tet_options.method = TetMethod::remesh;
  tet_options.time_limit = 20.0;
  TetrahedralizeResult result;
  const Status status = tetrahedralize(context, mesh.points, mesh.triangles, tet_options, result);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(status.report.text("method"), "remesh");
  EXPECT_NEAR(
    tet_volumes(result.mesh.points, result.mesh.tets).sum(), 4.0 / 3.0 * pi, 0.1 * 4.0 / 3.0 * pi);
}

TEST_F(Remesh, TheLadderKeepsVerticesAndReportsDistances)
{
  TriangleMesh mesh = test::sphere(3);
  ExecutionContext context;
  TetrahedralizeOptions options;
  options.method = TetMethod::remesh;
  TetrahedralizeResult result;
  const Status status = tetrahedralize(context, mesh.points, mesh.triangles, options, result);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_GT(status.report.number("counts.kept_vertices", 0.0), 0.99 * mesh.points.rows());
  EXPECT_GE(status.report.number("min_dihedral_angle", 0.0), 8.0);
  EXPECT_LT(status.report.number("distance_max", 100.0), 0.5);
  EXPECT_LE(
    status.report.number("distance_mean", 100.0), status.report.number("distance_max", -1.0));
}

TEST(RemeshTets, WithoutHelperTheLadderCutsALattice)
{
  const test::Environment no_helper("BINDPOSE_MESHER", "/nowhere");
  const TriangleMesh mesh = test::sphere(2);
  EXPECT_EQ(run_remesh(mesh).status.code, StatusCode::unavailable);
  EXPECT_EQ(run_remesh(mesh).result.mesh.tets.rows(), 0);
  ExecutionContext context;
  TetrahedralizeOptions options;
  options.method = TetMethod::remesh;
  options.resolution = 16;
  TetrahedralizeResult result;
  const Status status = tetrahedralize(context, mesh.points, mesh.triangles, options, result);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(status.report.number("counts.kept_vertices", -1.0), 0.0);
  EXPECT_GE(status.report.number("min_dihedral_angle", 0.0), 10.7);
  const auto* outcomes = status.report.find("rungs[].outcome");
  ASSERT_NE(outcomes, nullptr);
  const auto& texts = std::get<std::vector<std::string>>(*outcomes);
  ASSERT_EQ(texts.size(), 2u);
  EXPECT_THAT(texts[0], HasSubstr("BINDPOSE_MESHER"));
  EXPECT_EQ(texts[1], "ok");
}

TEST(RemeshTets, ASlowHelperIsStoppedAtTheLimit)
{
  const test::FakeProgram helper("BINDPOSE_MESHER", sleep_script);
  RemeshOptions options;
  options.time_limit = 0.3;
  const RemeshOutcome outcome = run_remesh(test::sphere(2), options);
  EXPECT_EQ(outcome.status.code, StatusCode::internal_error);
  EXPECT_THAT(outcome.status.message, HasSubstr("time limit"));
  EXPECT_EQ(outcome.result.mesh.tets.rows(), 0);
}

TEST(RemeshTets, CancelKillsTheHelper)
{
  const test::FakeProgram helper("BINDPOSE_MESHER", sleep_script);
  const TriangleMesh mesh = test::sphere(2);
  const WindingNumber winding(mesh.points, mesh.triangles);
  ExecutionContext context;
  test::DelayedCancel canceler(context, 300);
  RemeshResult result;
  const Status status = remesh_tets(context, mesh.points, mesh.triangles, winding, {}, result);
  const double seconds_since_cancel = canceler.seconds_since_cancel();
  EXPECT_EQ(status.code, StatusCode::canceled);
  EXPECT_LT(seconds_since_cancel, 0.2);
  EXPECT_EQ(result.mesh.tets.rows(), 0);
}

TEST(RemeshTets, BadInputIsNamed)
{
  const TriangleMesh good = test::cube();
  TriangleMesh not_finite = good;
  not_finite.points(3, 1) = std::numeric_limits<double>::quiet_NaN();
  TriangleMesh out_of_range = good;
  out_of_range.triangles(5, 2) = 99;
  TriangleMesh none = good;
  none.triangles.resize(0, 3);
  TriangleMesh point = good;
  point.points.setOnes();
  const auto refused = [](const TriangleMesh& mesh, const RemeshOptions& options)
  {
    const RemeshOutcome outcome = run_remesh(mesh, options);
    EXPECT_EQ(outcome.status.code, StatusCode::invalid_input);
    EXPECT_EQ(outcome.result.mesh.tets.rows(), 0);
    return outcome.status.message;
  };
  EXPECT_THAT(refused(not_finite, {}), HasSubstr("3"));
  EXPECT_THAT(refused(out_of_range, {}), HasSubstr("99"));
  EXPECT_THAT(refused(none, {}), HasSubstr("no triangles"));
  EXPECT_THAT(refused(point, {}), HasSubstr("points of the surface coincide"));
  RemeshOptions options;
  options.winding_threshold = 0.0;
  EXPECT_THAT(refused(good, options), HasSubstr("winding_threshold"));
  options = {};
  options.smallest_edge = 0.0;
  EXPECT_THAT(refused(good, options), HasSubstr("smallest_edge"));
  options = {};
  options.largest_edge = 0.001;
  EXPECT_THAT(refused(good, options), HasSubstr("largest_edge"));
  options = {};
  options.time_limit = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refused(good, options), HasSubstr("time_limit"));
  options = {};
  options.memory_limit = -1;
  EXPECT_THAT(refused(good, options), HasSubstr("memory_limit"));
}

TEST_F(Remesh, WhatEnclosesNothingSaysSo)
{
  const RemeshOutcome outcome = run_remesh(test::grid(4, 4));
  EXPECT_EQ(outcome.status.code, StatusCode::invalid_input);
  EXPECT_THAT(outcome.status.message, HasSubstr("nothing"));
}
