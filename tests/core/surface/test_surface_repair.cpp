// Repair of surfaces: welding, orientation, duplicates and crossings. The exact predicates that the
// repair uses are tested too.
#include "surface/surface_repair.h"

#include "surface/triangle_predicates.h"
#include "surface/triangle_tree.h"

#include "support/demo_meshes.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace bindpose;

namespace
{
RepairedSurface repair(const TriangleMesh& mesh, const RepairOptions& options = {})
{
  ExecutionContext context;
  RepairedSurface repaired;
  const Status status = repair_surface(context, mesh.points, mesh.triangles, options, repaired);
  EXPECT_TRUE(status.ok()) << status.message;
  return repaired;
}

SurfaceDiagnosis diagnose(const TriangleMesh& mesh)
{
  RepairOptions options;
  options.orient = false;
  return repair(mesh, options).found;
}
} // namespace

TEST(SurfaceRepair, CleanSurfacesAreClean)
{
  for (const TriangleMesh& mesh :
    { test::cube(), test::sphere(2), test::torus(16, 8, 1.0, 0.4), test::grid(1, 1) })
  {
    const SurfaceDiagnosis found = diagnose(mesh);
    EXPECT_EQ(found.vertices, mesh.points.rows());
    EXPECT_EQ(found.triangles, mesh.triangles.rows());
    EXPECT_EQ(found.duplicate_vertices + found.unreferenced_vertices + found.degenerate_triangles +
        found.duplicate_triangles + found.nonmanifold_edges + found.misoriented_edges +
        found.inward_components + found.self_intersections,
      0);
    EXPECT_EQ(found.components, 1);
  }
  EXPECT_TRUE(repair(test::cube()).is_clean());
  EXPECT_FALSE(repair(test::grid(2, 2)).is_clean());
  EXPECT_TRUE(diagnose(test::grid(2, 2)).flat);
  EXPECT_FALSE(diagnose(test::cube()).flat);
}

TEST(SurfaceRepair, WeldsEqualVerticesAndRemembersThem)
{
  const TriangleMesh cube = test::cube();
  const RepairedSurface repaired = repair(test::unwelded(cube));
  EXPECT_EQ(repaired.points.rows(), 8);
  EXPECT_EQ(repaired.found.duplicate_vertices, 36 - 8);
  EXPECT_EQ(repaired.found.boundary_edges, 0);
  EXPECT_TRUE(repaired.is_clean());
  const TriangleMesh soup = test::unwelded(cube);
  for (Index v = 0; v < 8; ++v)
  {
    EXPECT_EQ(repaired.points.row(v), soup.points.row(repaired.original_vertices[v]));
  }
  EXPECT_NEAR(signed_volume(repaired.points, repaired.triangles), 8.0, 1e-14);
  // Coordinates of -0 and 0 are equal.
  TriangleMesh signs = test::cube(0.0, 1.0);
  signs = test::unwelded(signs);
  signs.points.row(0) *= -1.0;
  EXPECT_EQ(repair(signs).points.rows(), 8);
}

TEST(SurfaceRepair, DropsWhatHasNoAreaAndStrayVertices)
{
  TriangleMesh mesh = test::cube();
  mesh.points.conservativeResize(10, 3);
  mesh.points.row(8) << 0.0, 0.0, -1.0; // on the diagonal of a face, between vertices 0 and 3
  // No triangle uses this vertex.
  mesh.points.row(9).setConstant(std::numeric_limits<double>::quiet_NaN());
  mesh.triangles.conservativeResize(14, 3);
  mesh.triangles.row(12) << 0, 8, 3;
  mesh.triangles.row(13) << 5, 5, 7;
  const RepairedSurface repaired = repair(mesh);
  EXPECT_EQ(repaired.found.degenerate_triangles, 2);
  EXPECT_EQ(repaired.found.unreferenced_vertices, 1);
  EXPECT_EQ(repaired.points.rows(), 8);
  EXPECT_EQ(repaired.triangles.rows(), 12);
  EXPECT_TRUE(repaired.is_clean());
}

TEST(SurfaceRepair, CountsOpenDoubledAndNonManifold)
{
  const SurfaceDiagnosis open = diagnose(test::open_cube());
  EXPECT_EQ(open.boundary_edges, 4);
  EXPECT_FALSE(open.closed);
  const TriangleMesh cube = test::cube();
  TriangleMesh doubled = cube;
  doubled.triangles.resize(24, 3);
  doubled.triangles << cube.triangles, cube.triangles;
  const SurfaceDiagnosis twice = diagnose(doubled);
  EXPECT_EQ(twice.duplicate_triangles, 12);
  EXPECT_EQ(twice.nonmanifold_edges, 18);
  EXPECT_TRUE(twice.closed);
  EXPECT_EQ(twice.self_intersections, 0) << "a duplicate is not a crossing";
}

TEST(SurfaceRepair, TurnsTheSmallerPartOfAPatch)
{
  TriangleMesh mesh = test::sphere(3);
  test::Random random(7);
  Index turned = 0;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    if (random.uniform() < 0.2)
    {
      std::swap(mesh.triangles(t, 1), mesh.triangles(t, 2));
      ++turned;
    }
  }
  const double volume = signed_volume(test::sphere(3).points, test::sphere(3).triangles);
  const RepairedSurface repaired = repair(mesh);
  EXPECT_EQ(repaired.flipped_triangles, turned);
  EXPECT_GT(repaired.found.misoriented_edges, 0);
  EXPECT_TRUE(repaired.is_clean());
  EXPECT_NEAR(signed_volume(repaired.points, repaired.triangles), volume, 1e-12);
  RepairOptions as_it_is;
  as_it_is.orient = false;
  EXPECT_EQ(repair(mesh, as_it_is).triangles, mesh.triangles);
}

TEST(SurfaceRepair, OneSidedPatchesStay)
{
  // The surface is a Moebius strip of 12 squares.
  TriangleMesh strip;
  const int n = 12;
  strip.points.resize(2 * n, 3);
  strip.triangles.resize(2 * n, 3);
  for (int i = 0; i < n; ++i)
  {
    const double angle = 2.0 * 3.14159265358979 * i / n;
    const Vec3 around(std::cos(angle), std::sin(angle), 0.0);
    const Vec3 across = std::cos(angle / 2) * around + std::sin(angle / 2) * Vec3(0, 0, 1);
    strip.points.row(2 * i) = (around - 0.2 * across).transpose();
    strip.points.row(2 * i + 1) = (around + 0.2 * across).transpose();
    const Index a = 2 * i, b = 2 * i + 1;
    const Index c = i + 1 < n ? 2 * i + 2 : 1, d = i + 1 < n ? 2 * i + 3 : 0;
    strip.triangles.row(2 * i) << a, c, b;
    strip.triangles.row(2 * i + 1) << b, c, d;
  }
  const RepairedSurface repaired = repair(strip);
  EXPECT_EQ(repaired.flipped_triangles, 0);
  EXPECT_EQ(repaired.triangles, strip.triangles);
}

TEST(SurfaceRepair, InsideOutComponentsAreTurnedWithWhatLiesInThem)
{
  const TriangleMesh outer = test::sphere(2, 2.0);
  const TriangleMesh inner = test::sphere(2, 1.0);
  const double shell =
    signed_volume(outer.points, outer.triangles) - signed_volume(inner.points, inner.triangles);
  const TriangleMesh cavity = test::join(outer, test::flipped(inner));
  EXPECT_EQ(diagnose(cavity).inward_components, 0) << "a cavity is not a mistake";
  EXPECT_EQ(repair(cavity).flipped_components, 0);
  const RepairedSurface repaired = repair(test::flipped(cavity));
  EXPECT_EQ(repaired.found.inward_components, 1);
  EXPECT_EQ(repaired.flipped_components, 1);
  EXPECT_NEAR(signed_volume(repaired.points, repaired.triangles), shell, 1e-12);
  // There are two separate solids. One of them is inside out.
  const TriangleMesh far = test::translated(inner, Vec3(9, 0, 0));
  const RepairedSurface two = repair(test::join(outer, test::flipped(far)));
  EXPECT_EQ(two.flipped_components, 1);
  EXPECT_NEAR(signed_volume(two.points, two.triangles),
    signed_volume(outer.points, outer.triangles) + signed_volume(inner.points, inner.triangles),
    1e-12);
}

TEST(SurfaceRepair, SolidsThatTouchAreTurnedOneByOne)
{
  // A chain of cubes in which each cube shares an edge or a vertex with the next one. Every second
  // cube is inside out.
  TriangleMesh chain;
  const int count = 9;
  for (int i = 0; i < count; ++i)
  {
    const int z = i / 2; // cubes 2k and 2k + 1 share an edge, cubes 2k - 1 and 2k a vertex
    const TriangleMesh cube = test::translated(test::cube(0.0, 1.0), Vec3(i, i, z));
    chain = i == 0 ? cube : test::join(chain, i % 2 ? test::flipped(cube) : cube);
  }
  const RepairedSurface repaired = repair(chain);
  EXPECT_EQ(repaired.found.components, 1);
  EXPECT_EQ(repaired.found.inward_components, count / 2);
  EXPECT_EQ(repaired.flipped_components, count / 2);
  EXPECT_NEAR(signed_volume(repaired.points, repaired.triangles), count, 1e-12);
}

TEST(SurfaceRepair, ACavityThatTouchesStaysACavity)
{
  // A tet inside of a cube touches the surface of the cube. In the first case it touches at a
  // vertex, in the second case at an edge.
  for (const double top : { 0.0, 1.0 })
  {
    TriangleMesh tet;
    tet.points.resize(4, 3);
    tet.points << -1, -1, -1, 0.5, -0.5, 0, -0.5, 0.5, 0, -1 + 0.5 * (1 - top),
      -1 + 0.5 * (1 - top), top;
    tet.triangles.resize(4, 3);
    tet.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
    const double inner = signed_volume(tet.points, tet.triangles);
    ASSERT_GT(inner, 0.1);
    for (const bool inward : { false, true })
    {
      const TriangleMesh hollow = test::join(test::cube(), test::flipped(tet));
      const RepairedSurface repaired = repair(inward ? test::flipped(hollow) : hollow);
      EXPECT_EQ(repaired.found.components, 1);
      EXPECT_EQ(repaired.flipped_components, inward ? 1 : 0);
      EXPECT_NEAR(signed_volume(repaired.points, repaired.triangles), 8.0 - inner, 1e-12);
    }
  }
}

TEST(SurfaceRepair, SnappingWeldsWhatNearlyCoincides)
{
  TriangleMesh mesh = test::unwelded(test::sphere(2));
  test::Random random(3);
  for (Index k = 0; k < mesh.points.size(); ++k)
  {
    mesh.points.data()[k] += 1e-9 * random.uniform(-1.0, 1.0);
  }
  EXPECT_EQ(repair(mesh).found.boundary_edges, mesh.triangles.size());
  RepairOptions options;
  options.snap = 0x1p-20;
  const RepairedSurface repaired = repair(mesh, options);
  EXPECT_EQ(repaired.points.rows(), test::sphere(2).points.rows());
  EXPECT_TRUE(repaired.is_clean());
}

TEST(SurfaceRepair, CountsCrossingsOfCubes)
{
  // A corner of each cube is inside of the other cube. Three faces of each cube therefore cross
  // faces of the other cube, in at least six pairs of triangles. Brute force over all pairs of
  // triangles finds the same crossings.
  const TriangleMesh two =
    test::join(test::cube(), test::translated(test::cube(), Vec3(1.03, 0.9, 0.85)));
  Index pairs = 0;
  for (Index f = 0; f < 24; ++f)
  {
    for (Index g = f + 1; g < 24; ++g)
    {
      pairs += triangles_cross(two.points, two.triangles, f, g);
    }
  }
  EXPECT_GE(pairs, 6);
  EXPECT_EQ(diagnose(two).self_intersections, pairs);
  // The cubes touch: a face of one cube overlaps a face of the other cube, without shared vertices.
  // Each triangle of one face touches both triangles of the other face.
  TriangleMesh touching =
    test::join(test::cube(), test::translated(test::cube(), Vec3(2.0, 0.25, 0.25)));
  EXPECT_GE(diagnose(touching).self_intersections, 4);
  touching = test::join(test::cube(), test::translated(test::cube(), Vec3(2.0 + 1e-15, 3.0, 0.0)));
  EXPECT_EQ(diagnose(touching).self_intersections, 0);
}

TEST(SurfaceRepair, CrossingsAreThoseOfThePlaneEquations)
{
  // Two triangles in general position cross if an edge of one passes through the other. The
  // reference computes the intersection point in double precision.
  test::Random random(11);
  const auto passes = [](const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c)
  {
    Eigen::Matrix3d m;
    m << b - a, c - a, p - q;
    const Vec3 x = m.inverse() * (p - a);
    return x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1 && x[2] >= 0 && x[2] <= 1;
  };
  TriangleMesh mesh;
  mesh.points.resize(6, 3);
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 3, 4, 5;
  int crossed = 0;
  for (int round = 0; round < 2000; ++round)
  {
    std::array<Vec3, 6> p;
    for (int v = 0; v < 6; ++v)
    {
      p[v] = random.in_box(Vec3::Zero(), Vec3::Ones());
      mesh.points.row(v) = p[v];
    }
    bool expected = false;
    for (int k = 0; k < 3; ++k)
    {
      expected = expected || passes(p[k], p[(k + 1) % 3], p[3], p[4], p[5]) ||
        passes(p[3 + k], p[3 + (k + 1) % 3], p[0], p[1], p[2]);
    }
    EXPECT_EQ(triangles_cross(mesh.points, mesh.triangles, 0, 1), expected) << round;
    crossed += expected;
  }
  EXPECT_GT(crossed, 100);
}

TEST(SurfaceRepair, SharedVerticesAndEdgesAreNoCrossing)
{
  TriangleMesh mesh;
  mesh.points.resize(6, 3);
  mesh.points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.3, 0.3, 0, 0.3, 0.3, 1;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 1, 3; // two triangles with a common edge
  EXPECT_FALSE(triangles_cross(mesh.points, mesh.triangles, 0, 1));
  mesh.triangles << 0, 1, 2, 0, 1, 4; // the triangles are folded onto each other
  EXPECT_TRUE(triangles_cross(mesh.points, mesh.triangles, 0, 1));
  // The only contact is the common vertex. The second triangle is perpendicular to the first one.
  mesh.triangles << 0, 1, 2, 0, 3, 5;
  EXPECT_FALSE(triangles_cross(mesh.points, mesh.triangles, 0, 1));
  // The triangles touch along a segment that begins at the vertex.
  mesh.triangles << 0, 1, 2, 0, 4, 5;
  EXPECT_TRUE(triangles_cross(mesh.points, mesh.triangles, 0, 1));
  mesh.triangles << 0, 1, 2, 3, 4, 5; // a vertex of one triangle is inside of the other
  EXPECT_TRUE(triangles_cross(mesh.points, mesh.triangles, 0, 1));
}

TEST(SurfaceRepair, ExactSigns)
{
  // The fourth point is in the plane of a, b and c, or the last bit of a coordinate moves it out of
  // the plane.
  const Vec3 a(0.1, 0.2, 0.3), b(1.1, 0.2, 0.3), c(0.1, 1.2, 0.3);
  const double z = 0.3;
  EXPECT_EQ(orientation_3d(a, b, c, Vec3(0.7, 0.6, z)), 0);
  EXPECT_EQ(orientation_3d(a, b, c, Vec3(0.7, 0.6, std::nextafter(z, 1.0))), 1);
  EXPECT_EQ(orientation_3d(a, b, c, Vec3(0.7, 0.6, std::nextafter(z, 0.0))), -1);
  const double tiny = 0x1p-60;
  EXPECT_EQ(orientation_3d(Vec3(1, 1, 1), Vec3(2, 2, 2), Vec3(3, 3, 3), Vec3(5, 4, 3)), 0);
  EXPECT_TRUE(collinear(Vec3(1, 1, 1), Vec3(2, 2, 2), Vec3(3, 3, 3)));
  EXPECT_FALSE(collinear(Vec3(1, 1, 1), Vec3(2, 2, 2), Vec3(3, 3, std::nextafter(3.0, 4.0))));
  EXPECT_EQ(orientation_3d(Vec3(0, 0, 0), Vec3(tiny, 0, 0), Vec3(0, tiny, 0), Vec3(0, 0, tiny)), 1);
  // Even permutations keep the sign, and odd permutations change it.
  test::Random random(5);
  for (int round = 0; round < 200; ++round)
  {
    std::array<Vec3, 4> p;
    for (Vec3& q : p)
    {
      q = random.in_box(Vec3::Zero(), Vec3::Ones());
    }
    // Move the fourth point close to the plane of the first three points.
    p[3] = p[0] + (p[1] - p[0]) * 0.25 + (p[2] - p[0]) * 0.5;
    const int sign = orientation_3d(p[0], p[1], p[2], p[3]);
    EXPECT_EQ(orientation_3d(p[1], p[2], p[0], p[3]), sign);
    EXPECT_EQ(orientation_3d(p[1], p[0], p[3], p[2]), sign);
    EXPECT_EQ(orientation_3d(p[1], p[0], p[2], p[3]), -sign);
    EXPECT_EQ(orientation_3d(p[0], p[1], p[3], p[2]), -sign);
  }
}

TEST(SurfaceRepair, TreeDistancesAreBruteForce)
{
  const TriangleMesh mesh = test::torus(20, 10, 1.0, 0.4);
  const TriangleTree tree(mesh.points, mesh.triangles);
  test::Random random(13);
  for (int round = 0; round < 200; ++round)
  {
    const Vec3 p = random.in_box(Vec3::Constant(-2.0), Vec3::Constant(2.0));
    double nearest = 1e300;
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
    {
      const Vec3 a = mesh.points.row(mesh.triangles(t, 0));
      const Vec3 b = mesh.points.row(mesh.triangles(t, 1));
      const Vec3 c = mesh.points.row(mesh.triangles(t, 2));
      nearest = std::min(nearest, (closest_point(p, a, b, c) - p).norm());
      // No sample of the triangle is nearer to the point than the closest point that the function
      // returned.
      const double s = random.uniform(), r = random.uniform();
      const Vec3 q = s + r < 1 ? Vec3(a + s * (b - a) + r * (c - a)) : a;
      EXPECT_GE((q - p).norm() + 1e-12, (closest_point(p, a, b, c) - p).norm());
    }
    EXPECT_DOUBLE_EQ(tree.distance(p, 10.0), nearest);
    EXPECT_TRUE(std::isinf(tree.distance(p, 0.5 * nearest)));
    EXPECT_TRUE(tree.is_within(p, 1.0001 * nearest));
    EXPECT_FALSE(tree.is_within(p, 0.9999 * nearest));
  }
}

TEST(SurfaceRepair, SegmentsMeetTrianglesAsBruteForceSays)
{
  const TriangleMesh mesh = test::torus(30, 14, 1.0, 0.4);
  const TriangleTree tree(mesh.points, mesh.triangles);
  test::Random random(11);
  int met = 0;
  for (int i = 0; i < 2000; ++i)
  {
    // Segments of various lengths. Every fourth one is parallel to an axis, and every eighth one
    // connects two vertices.
    const Vec3 a = i % 8 == 7 ? Vec3(mesh.points.row(random.below(mesh.points.rows())))
                              : random.in_box(Vec3(-1.6, -1.6, -0.6), Vec3(1.6, 1.6, 0.6));
    Vec3 b = i % 8 == 7
      ? Vec3(mesh.points.row(random.below(mesh.points.rows())))
      : Vec3(a + std::pow(random.uniform(), 3.0) * random.in_box(-Vec3::Ones(), Vec3::Ones()));
    if (i % 4 == 0)
    {
      b[1] = a[1];
      b[2] = a[2];
    }
    const Index without = random.below(mesh.triangles.rows());
    const auto counts = [&](Index f) { return f != without; };
    bool brute = false;
    for (Index f = 0; f < mesh.triangles.rows() && !brute; ++f)
    {
      brute = counts(f) &&
        segment_meets_triangle(a, b, mesh.points.row(mesh.triangles(f, 0)),
          mesh.points.row(mesh.triangles(f, 1)), mesh.points.row(mesh.triangles(f, 2)));
    }
    EXPECT_EQ(tree.segment_meets(a, b, counts), brute) << i;
    met += brute;
  }
  EXPECT_GT(met, 400);
  EXPECT_LT(met, 1600);
  // A segment that only touches a triangle intersects the triangle. A segment that passes the
  // triangle at a distance of one ulp does not intersect it. Triangles without area intersect no
  // segment.
  const Vec3 p(0, 0, 0), q(1, 0, 0), r(0, 1, 0);
  EXPECT_TRUE(segment_meets_triangle(Vec3(0.25, 0.25, 1), Vec3(0.25, 0.25, 0), p, q, r));
  EXPECT_TRUE(segment_meets_triangle(Vec3(0.5, 0.5, 1), Vec3(0.5, 0.5, -1), p, q, r));
  EXPECT_FALSE(segment_meets_triangle(
    Vec3(0.5, std::nextafter(0.5, 1.0), 1), Vec3(0.5, std::nextafter(0.5, 1.0), -1), p, q, r));
  EXPECT_TRUE(segment_meets_triangle(Vec3(-1, 0.25, 0), Vec3(2, 0.25, 0), p, q, r))
    << "in its plane";
  EXPECT_FALSE(
    segment_meets_triangle(Vec3(0.25, 0.0, 1), Vec3(0.25, 0.0, -1), p, q, Vec3(2, 0, 0)));
}

TEST(SurfaceRepair, BadInputIsNamed)
{
  ExecutionContext context;
  RepairedSurface repaired;
  TriangleMesh mesh = test::cube();
  mesh.points(3, 1) = std::numeric_limits<double>::infinity();
  Status status = repair_surface(context, mesh.points, mesh.triangles, {}, repaired);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_NE(status.message.find("vertex 3"), std::string::npos) << status.message;
  const SurfaceDiagnosis empty = diagnose(TriangleMesh{ Points(0, 3), Triangles(0, 3) });
  EXPECT_EQ(empty.components, 0);
  EXPECT_FALSE(empty.closed);
}

TEST(SurfaceRepair, ElephantAndCow)
{
  const TriangleMesh elephant = test::demo_mesh("elephant-with-holes.off");
  const SurfaceDiagnosis open = diagnose(elephant);
  EXPECT_FALSE(open.closed);
  EXPECT_EQ(open.boundary_edges, count_edges(elephant.triangles).boundary);
  EXPECT_EQ(open.self_intersections, 0);
  const SurfaceDiagnosis cow = diagnose(test::demo_mesh("cow.off"));
  EXPECT_TRUE(cow.closed);
  EXPECT_EQ(cow.self_intersections, 89) << "as CGAL counts with exact predicates";
}

TEST(SurfaceRepair, SameForAnyNumberOfThreads)
{
  const TriangleMesh mesh = test::join(test::sphere(3), test::torus(24, 12, 0.8, 0.5));
  ExecutionContext one, many;
  one.set_threads(1);
  many.set_threads(4);
  RepairedSurface a, b;
  ASSERT_TRUE(repair_surface(one, mesh.points, mesh.triangles, {}, a).ok());
  ASSERT_TRUE(repair_surface(many, mesh.points, mesh.triangles, {}, b).ok());
  EXPECT_EQ(a.crossings, b.crossings);
  EXPECT_GT(a.crossings.size(), 0u);
}

TEST(SurfaceRepair, ClosestPointOfTrianglesThatAreLines)
{
  // The three corners are on a line in any order, and two or three of them may be equal. The
  // longest edge contains all corners, so the expected result is the nearest point of this edge.
  test::Random random(11);
  const auto anywhere = [&] { return random.in_box(Vec3::Constant(-1.0), Vec3::Constant(1.0)); };
  for (int round = 0; round < 3000; ++round)
  {
    const Vec3 from = anywhere(), along = anywhere(), p = 3.0 * anywhere();
    std::array<double, 3> places{ 0.0, 1.0, random.uniform(-1.0, 2.0) };
    if (round % 5 == 0)
    {
      places[2] = places[round % 2];
    }
    const auto corner = [&](std::size_t k) { return Vec3(from + places[k] * along); };
    const double low = *std::min_element(places.begin(), places.end());
    const double high = *std::max_element(places.begin(), places.end());
    const double t = std::clamp((p - from).dot(along) / along.squaredNorm(), low, high);
    const Vec3 expected = from + t * along;
    ASSERT_LE((closest_point(p, corner(0), corner(1), corner(2)) - expected).norm(), 1e-13);
    ASSERT_LE((closest_point(p, corner(2), corner(0), corner(1)) - expected).norm(), 1e-13);
  }
  EXPECT_EQ(closest_point(Vec3(1, 2, 3), Vec3::Ones(), Vec3::Ones(), Vec3::Ones()), Vec3::Ones());
}

TEST(SurfaceRepair, SelfIntersectionsCanBeCountedLater)
{
  const TriangleMesh mesh =
    test::join(test::sphere(2), test::translated(test::sphere(2), Vec3(1, 0, 0)));
  const RepairedSurface whole = repair(mesh);
  EXPECT_GT(whole.found.self_intersections, 0);
  RepairOptions options;
  options.count_self_intersections = false;
  RepairedSurface later = repair(mesh, options);
  EXPECT_EQ(later.found.self_intersections, 0);
  ExecutionContext canceled;
  canceled.request_cancel();
  EXPECT_EQ(find_self_intersections(canceled, later).code, StatusCode::canceled);
  EXPECT_EQ(later.found.self_intersections, 0);
  ExecutionContext context;
  EXPECT_TRUE(find_self_intersections(context, later).ok());
  EXPECT_EQ(later.found.self_intersections, whole.found.self_intersections);
  EXPECT_EQ(later.found.crossing_triangles, whole.found.crossing_triangles);
  EXPECT_EQ(later.crossings, whole.crossings);
}
