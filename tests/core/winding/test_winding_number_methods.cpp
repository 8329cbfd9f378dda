// All methods for winding numbers agree with each other and with independent references on
// difficult triangle soups. Threads, extents and cancel requests are tested too.
#include "winding/winding_number.h"

#include "support/meshes.h"
#include "support/sanitized.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <thread>

using namespace bindpose;

namespace
{
constexpr WindingMethod tested_methods[] = { WindingMethod::direct, WindingMethod::hierarchical,
  WindingMethod::crossings };

WindingNumber winding_by_method(const TriangleMesh& mesh, WindingMethod method, Index leaf = 64)
{
  ExecutionContext context;
  WindingNumber::Options options;
  options.method = method;
  options.max_leaf_size = leaf;
  WindingNumber winding;
  const Status status = winding.build(context, mesh.points, mesh.triangles, options);
  EXPECT_TRUE(status.ok()) << status.message;
  return winding;
}

using LatticeVector = Eigen::Matrix<std::int64_t, 3, 1>;

/// Return the winding number at a point on the lattice of spacing 1/8. Integer arithmetic decides
/// exactly on which side of each triangle's plane the point is. A triangle whose plane contains the
/// point contributes nothing. The other contributions are added in long double.
double lattice_winding_number(const TriangleMesh& mesh, const Vec3& p)
{
  using Long3 = Eigen::Matrix<long double, 3, 1>;
  long double sum = 0.0L;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    std::array<LatticeVector, 3> v;
    std::array<Long3, 3> x;
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 d = mesh.points.row(mesh.triangles(t, k)).transpose() - p;
      v[k] = (d * 8.0).cast<std::int64_t>();
      x[k] = d.cast<long double>();
    }
    const std::int64_t side = v[0].dot(v[1].cross(v[2]));
    if (side == 0)
    {
      continue; // the point is in the triangle's plane, so the triangle contributes nothing
    }
    const long double la = x[0].norm(), lb = x[1].norm(), lc = x[2].norm();
    sum += std::atan2(x[0].dot(x[1].cross(x[2])),
      la * lb * lc + x[0].dot(x[1]) * lc + x[1].dot(x[2]) * la + x[2].dot(x[0]) * lb);
  }
  return static_cast<double>(sum / 6.283185307179586476925286766559L);
}

/// Return random triangles with corners on a lattice of spacing 1/4 in a box of side 2. They are
/// coplanar, crossing, touching, degenerate, repeated and flipped.
TriangleMesh lattice_soup(test::Random& random, Index triangles)
{
  TriangleMesh mesh;
  const Index vertices = 4 + random.below(triangles);
  mesh.points.resize(vertices, 3);
  for (Index v = 0; v < vertices; ++v)
  {
    for (int k = 0; k < 3; ++k)
    {
      mesh.points(v, k) = static_cast<double>(random.below(9)) / 4.0 - 1.0;
    }
  }
  mesh.triangles.resize(triangles, 3);
  for (Index t = 0; t < triangles; ++t)
  {
    const double kind = random.uniform();
    if (t > 0 && kind < 0.1)
    {
      mesh.triangles.row(t) = mesh.triangles.row(random.below(t));
    }
    else if (t > 0 && kind < 0.2)
    {
      const Index other = random.below(t);
      mesh.triangles.row(t) << mesh.triangles(other, 1), mesh.triangles(other, 0),
        mesh.triangles(other, 2);
    }
    else
    {
      for (int k = 0; k < 3; ++k)
      {
        mesh.triangles(t, k) = random.below(vertices);
      }
    }
  }
  return mesh;
}

/// Return a point on the lattice of spacing 1/8. Many points are at, below or above vertices, edges
/// and faces.
Vec3 lattice_point(test::Random& random)
{
  return Vec3(static_cast<double>(random.below(21)), static_cast<double>(random.below(21)),
           static_cast<double>(random.below(21))) /
    8.0 -
    Vec3::Constant(1.25);
}

/// Return a bumpy sphere around the origin and a torus that crosses the sphere. The part of the
/// sphere beyond a plane is removed. The distance of the plane from the origin is 1 - `hole`.
TriangleMesh unclean_surface(int levels, double hole)
{
  TriangleMesh mesh = test::sphere(levels);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    const Vec3 p = mesh.points.row(v);
    mesh.points.row(v) *= 1.0 + 0.2 * std::sin(7.0 * p.x()) * std::cos(5.0 * p.y() + p.z());
  }
  Index kept = 0;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    if (mesh.points.row(mesh.triangles(t, 0)).dot(Vec3(0.6, 0.0, 0.8)) < 1.0 - hole)
    {
      mesh.triangles.row(kept++) = mesh.triangles.row(t).eval();
    }
  }
  mesh.triangles.conservativeResize(kept, 3);
  return test::join(mesh, test::translated(test::torus(30, 15, 0.7, 0.3), Vec3(0.6, 0.1, 0.2)));
}

double worst_difference(
  const TriangleMesh& mesh, const WindingNumber& winding, const std::vector<Vec3>& points)
{
  double worst = 0.0;
  for (const Vec3& p : points)
  {
    worst = std::max(worst,
      std::abs(winding.evaluate_at(p) - winding_number_direct(mesh.points, mesh.triangles, p)));
  }
  return worst;
}
} // namespace

TEST(WindingMethods, AgreeWithWholeNumbersOnLatticeSoups)
{
  test::Random random(2024);
  for (int round = 0; round < 150; ++round)
  {
    const TriangleMesh mesh = lattice_soup(random, 1 + random.below(60));
    std::vector<WindingNumber> windings;
    for (const WindingMethod method : tested_methods)
    {
      windings.push_back(winding_by_method(mesh, method, 1 + random.below(6)));
    }
    for (int q = 0; q < 60; ++q)
    {
      const Vec3 p = lattice_point(random);
      const double expected = lattice_winding_number(mesh, p);
      for (const WindingNumber& winding : windings)
      {
        ASSERT_NEAR(winding.evaluate_at(p), expected, 1e-12)
          << to_string(winding.method()) << ", round " << round << ", at " << p.transpose();
      }
    }
  }
}

TEST(WindingMethods, AgreeOnRandomSoups)
{
  test::Random random(99);
  for (const Index triangles : { 3, 40, 400 })
  {
    TriangleMesh mesh{ Points(3 * triangles, 3), Triangles(triangles, 3) };
    for (Index t = 0; t < triangles; ++t)
    {
      const Vec3 center = random.in_box(Vec3::Constant(-1), Vec3::Constant(1));
      for (int k = 0; k < 3; ++k)
      {
        mesh.points.row(3 * t + k) =
          (center + 0.3 * random.in_box(Vec3::Constant(-1), Vec3::Constant(1))).transpose();
        mesh.triangles(t, k) = 3 * t + k;
      }
    }
    std::vector<Vec3> points;
    for (int i = 0; i < 100; ++i)
    {
      const Index t = random.below(triangles);
      const Vec3 a = mesh.points.row(3 * t);
      const Vec3 b = mesh.points.row(3 * t + 1);
      const Vec3 c = mesh.points.row(3 * t + 2);
      points.insert(points.end(),
        { random.in_box(Vec3::Constant(-2), Vec3::Constant(2)), a, 0.5 * (a + b), (a + b + c) / 3.0,
          0.5 * (a + b) + Vec3(1e-10, 0, 0), a - Vec3(0, 0, 0.25), 0.5 * (b + c) - Vec3(0, 0, 1e-7),
          a + Vec3(0, 1e-9, -1e-9) });
    }
    for (const WindingMethod method : tested_methods)
    {
      EXPECT_LE(worst_difference(mesh, winding_by_method(mesh, method, 8), points), 1e-12)
        << to_string(method) << ", " << triangles;
    }
  }
}

TEST(WindingMethods, AgreeOnUncleanSurfaces)
{
  test::Random random(5);
  for (const double hole : { -1.0, 0.1, 0.6 }) // -1 means no hole
  {
    const TriangleMesh mesh = unclean_surface(4, hole);
    std::vector<Vec3> points;
    for (int i = 0; i < 60; ++i)
    {
      const Index t = random.below(mesh.triangles.rows());
      const Vec3 a = mesh.points.row(mesh.triangles(t, 0));
      const Vec3 b = mesh.points.row(mesh.triangles(t, 1));
      const Vec3 c = mesh.points.row(mesh.triangles(t, 2));
      const Vec3 m = (a + b + c) / 3.0;
      const Vec3 n = (b - a).cross(c - a).normalized();
      points.insert(points.end(),
        { random.in_box(Vec3::Constant(-1.5), Vec3::Constant(1.5)), a, m, 0.5 * (a + b),
          m + 1e-4 * n, m - 1e-4 * n, m + 1e-9 * n, m - 1e-9 * n });
    }
    for (const WindingMethod method : tested_methods)
    {
      EXPECT_LE(worst_difference(mesh, winding_by_method(mesh, method), points), 1e-12)
        << to_string(method) << ", hole " << hole;
    }
  }
}

TEST(WindingMethods, RaysThroughVerticesAndEdgesOfClosedSurfaces)
{
  // The points are directly above and below vertices and midpoints of edges, along every axis.
  TriangleMesh mesh = test::sphere(2);
  for (int turn = 0; turn < 3; ++turn)
  {
    mesh.points.col(turn) *= 0.5; // flatten the sphere along one axis
    const WindingNumber winding = winding_by_method(mesh, WindingMethod::crossings);
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        for (const double factor : { -2.0, -0.3, 0.2, 3.0 })
        {
          const Vec3 a = mesh.points.row(mesh.triangles(t, 0));
          const Vec3 b = mesh.points.row(mesh.triangles(t, 1));
          for (Vec3 p : { a, Vec3(0.5 * (a + b)) })
          {
            p[axis] *= factor;
            const double w = winding_number_direct(mesh.points, mesh.triangles, p);
            ASSERT_NEAR(winding.evaluate_at(p), w, 1e-12) << p.transpose();
          }
        }
      }
    }
    mesh.points.col(turn) *= 2.0;
  }
}

TEST(WindingMethods, ThinTrianglesDoNotFlip)
{
  // The shape is a box of thickness 1e-7. Its long, narrow faces consist of slivers. The distance
  // of the points from a sliver is less than the width of the sliver.
  TriangleMesh mesh = test::cube();
  mesh.points.col(0) *= 1e-7;
  mesh.points.col(1) *= 1e-4;
  for (const WindingMethod method : tested_methods)
  {
    const WindingNumber winding = winding_by_method(mesh, method, 2);
    for (const double z : { -1.0 + 1e-12, -0.4, 0.3, 1.0 - 1e-12 })
    {
      for (const double x : { -0.99999, 0.0, 0.5 })
      {
        EXPECT_NEAR(winding.evaluate_at(Vec3(x * 1e-7, 0.9e-4, z)), 1.0, 1e-12);
        EXPECT_NEAR(winding.evaluate_at(Vec3(x * 1e-7, 1.000001e-4, z)), 0.0, 1e-12);
      }
      EXPECT_NEAR(winding.evaluate_at(Vec3(1.00001e-7, 0.9e-4, z)), 0.0, 1e-12);
    }
  }
}

TEST(WindingMethods, SliversAreSeenUnderTheAngleOfTheirRectangle)
{
  // A rectangle with sides x and y subtends the solid angle atan(x y / (h sqrt(x^2 + y^2 + h^2)))
  // at a point at height h above one of its corners. The query point is above the interior of the
  // sliver, so the reference adds the angles of four rectangles that meet below the point. The
  // height is about the width of the sliver, so the angle is large even if the sliver is extremely
  // narrow. The smallest width, 1e-14, is about five times the tolerance for touching.
  const double xs[2] = { -0.7, 1.3 };
  for (const double width : { 1e-3, 1e-8, 1e-12, 1e-13, 1e-14 })
  {
    const double ys[2] = { -0.6 * width, 1.1 * width };
    for (const double h : { width, 0.7 * width, -3.0 * width })
    {
      TriangleMesh mesh{ Points(4, 3), Triangles(2, 3) };
      mesh.points << xs[0], ys[0], 0, xs[1], ys[0], 0, xs[1], ys[1], 0, xs[0], ys[1], 0;
      mesh.triangles << 0, 2, 1, 0, 3, 2;
      double expected = 0.0;
      for (int i = 0; i < 2; ++i)
      {
        for (int k = 0; k < 2; ++k)
        {
          const double x = std::abs(xs[i]), y = std::abs(ys[k]);
          expected += std::atan(x * y / (h * std::sqrt(x * x + y * y + h * h)));
        }
      }
      expected /= 12.56637061435917295;
      for (const WindingMethod method : tested_methods)
      {
        EXPECT_NEAR(winding_by_method(mesh, method, 1).evaluate_at(Vec3(0, 0, h)), expected, 1e-15)
          << to_string(method) << ", " << width << ", " << h;
      }
    }
  }
}

TEST(WindingMethods, WhatIsNoTriangleCannotBeTouched)
{
  TriangleMesh mesh = test::cube();
  mesh.triangles.conservativeResize(13, 3);
  mesh.triangles.row(12) << 0, 7, 0; // this triangle is a segment between opposite corners
  for (const WindingMethod method : tested_methods)
  {
    bool touches = true;
    EXPECT_NEAR(winding_by_method(mesh, method).evaluate_at(Vec3::Zero(), &touches), 1.0, 1e-15);
    EXPECT_FALSE(touches) << to_string(method);
  }
  bool touches = true;
  EXPECT_NEAR(
    winding_number_direct(mesh.points, mesh.triangles, Vec3::Zero(), &touches), 1.0, 1e-15);
  EXPECT_FALSE(touches);
}

TEST(WindingMethods, FarFromTheOriginTouchingReachesAsFar)
{
  // A point touches a triangle if their distance is at most 2^-49 times the largest coordinate. A
  // unit sphere is moved far from the origin. At 1e6 the distance for touching is 2e-9, which is
  // below the resolution 1e-7 of single precision on a unit sphere. At 1e9 the distance for
  // touching is 2e-6, which is above this resolution. The closed sphere tests WindingCells, and the
  // loose triangles test DipoleField.
  const TriangleMesh sphere = test::sphere(2);
  TriangleMesh loose{ Points(3 * sphere.triangles.rows(), 3), sphere.triangles };
  for (Index t = 0; t < sphere.triangles.rows(); ++t)
  {
    const auto corner = [&](int k) { return sphere.points.row(sphere.triangles(t, k)); };
    for (int k = 0; k < 3; ++k)
    {
      loose.points.row(3 * t + k) =
        0.9 * corner(k) + 0.05 * (corner((k + 1) % 3) + corner((k + 2) % 3));
      loose.triangles(t, k) = 3 * t + k;
    }
  }
  for (const double magnitude : { 1e6, 1e9, 1e11 })
  {
    const double reach = std::ldexp(magnitude, -49);
    for (const bool closed : { true, false })
    {
      const TriangleMesh mesh = test::translated(closed ? sphere : loose, Vec3(magnitude, 0, 0));
      const WindingNumber winding =
        winding_by_method(mesh, closed ? WindingMethod::crossings : WindingMethod::fast);
      for (Index t = 0; t < mesh.triangles.rows(); ++t)
      {
        const auto corner = [&](int k) { return Vec3(mesh.points.row(mesh.triangles(t, k))); };
        const Vec3 center = corner(0) + ((corner(1) - corner(0)) + (corner(2) - corner(0))) / 3.0;
        const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
        for (const double height : { 0.6, -0.6, 2.0, -2.0 })
        {
          bool touches = false;
          winding.evaluate_at(center + height * reach * normal, &touches);
          EXPECT_EQ(touches, std::abs(height) < 1.0) << magnitude << ", " << closed << ", " << t;
        }
      }
    }
  }
}

TEST(WindingMethods, AsSmallAsDoublesGet)
{
  // The vertices of a sphere have integer coordinates. Multiplying them by the smallest positive
  // double must not change the results. The methods scale the tiny sphere up, but by at most
  // 2^1023. Products of three of the scaled lengths can therefore still underflow to 0 in single
  // precision.
  constexpr double unit = std::numeric_limits<double>::denorm_min();
  const TriangleMesh sphere = test::sphere(2);
  TriangleMesh mesh = sphere, tiny = sphere;
  for (const int radius : { 20, 50, 200, 1000, 30000 })
  {
    mesh.points = (radius * sphere.points).array().round();
    tiny.points = unit * mesh.points;
    for (const WindingMethod method : tested_methods)
    {
      const WindingNumber winding = winding_by_method(mesh, method, 4),
                          of_tiny = winding_by_method(tiny, method, 4);
      test::Random random(4);
      for (int i = 0; i < 3000; ++i)
      {
        const Vec3 p = random.in_box(Vec3::Constant(-1.1 * radius), Vec3::Constant(1.1 * radius))
                         .array()
                         .round();
        bool touches = false, touches_tiny = false;
        const double expected = winding.evaluate_at(p, &touches);
        const double value = of_tiny.evaluate_at(unit * p, &touches_tiny);
        ASSERT_NEAR(value, expected, 1e-14) << radius << " at " << p.transpose();
        ASSERT_EQ(touches, touches_tiny) << radius << " at " << p.transpose();
      }
    }
  }
}

TEST(WindingMethods, FastNextToALongTriangleThatIsCut)
{
  // One triangle is as long as the box, and the others are small. The method bisects the long
  // triangle until its parts are small too. The new vertices have rounding errors of up to 1e-16.
  // Some query points are only about 1e-15 away from an edge of the long triangle. There, such an
  // error changes the winding number by more than the tolerance.
  TriangleMesh mesh;
  test::Random random(3);
  for (int i = 0; i < 80; ++i)
  {
    TriangleMesh small{ Points(3, 3), Triangles(1, 3) };
    const Vec3 at = random.in_box(Vec3::Constant(-1), Vec3::Constant(1));
    for (int k = 0; k < 3; ++k)
    {
      small.points.row(k) =
        (at + random.in_box(Vec3::Constant(-0.01), Vec3::Constant(0.01))).transpose();
    }
    small.triangles << 0, 1, 2;
    mesh = test::join(mesh, small);
  }
  const Vec3 a(-0.9137, -0.8719, -0.7731), b(0.8317, 0.9173, 0.6597), c(0.8317, 0.9173, 0.66);
  TriangleMesh large{ Points(3, 3), Triangles(1, 3) };
  large.points << a.transpose(), b.transpose(), c.transpose();
  large.triangles << 0, 1, 2;
  mesh = test::join(mesh, large);
  WindingNumber::Options options;
  options.method = WindingMethod::fast;
  options.tolerance = 1e-5;
  ExecutionContext context;
  WindingNumber winding;
  ASSERT_TRUE(winding.build(context, mesh.points, mesh.triangles, options).ok());
  for (int i = 0; i < 2000; ++i)
  {
    const Vec3 foot = a + random.uniform(0.1, 0.9) * (b - a);
    const Vec3 p = foot +
      std::pow(10.0, random.uniform(-14.5, -10.0)) *
        random.in_box(Vec3::Constant(-1), Vec3::Constant(1));
    ASSERT_NEAR(
      winding.evaluate_at(p), winding_number_direct(mesh.points, mesh.triangles, p), 1e-5);
  }
}

TEST(WindingMethods, AutomaticChoosesByCounts)
{
  EXPECT_EQ(
    winding_by_method(test::cube(), WindingMethod::automatic).method(), WindingMethod::crossings);
  EXPECT_EQ(
    winding_by_method(test::open_cube(), WindingMethod::automatic).method(), WindingMethod::direct);
  EXPECT_EQ(winding_by_method(test::sphere(3), WindingMethod::automatic).method(),
    WindingMethod::crossings);
  EXPECT_EQ(
    winding_by_method(test::sphere(3), WindingMethod::fast).method(), WindingMethod::crossings);
  // Divide the triangles into groups of `group` triangles with separate vertices. Group number k is
  // scaled by 1 + 1e-9 k, so that groups share no edges. Groups of one triangle form a triangle
  // soup, and groups of 256 triangles form a set of patches.
  for (const Index group : { 1, 256 })
  {
    const TriangleMesh sphere = test::sphere(group == 1 ? 5 : 6);
    const Index count = sphere.triangles.rows();
    TriangleMesh apart{ Points(3 * count, 3), sphere.triangles };
    std::map<std::pair<Index, Index>, Index> ids;
    for (Index t = 0; t < count; ++t)
    {
      for (int k = 0; k < 3; ++k)
      {
        const Index v = sphere.triangles(t, k);
        const Index id =
          ids.insert({ { t / group, v }, static_cast<Index>(ids.size()) }).first->second;
        apart.points.row(id) = sphere.points.row(v) * (1.0 + 1e-9 * static_cast<double>(t / group));
        apart.triangles(t, k) = id;
      }
    }
    apart.points.conservativeResize(static_cast<Index>(ids.size()), 3);
    const WindingNumber winding = winding_by_method(apart, WindingMethod::exact);
    EXPECT_EQ(winding.method(), group == 1 ? WindingMethod::direct : WindingMethod::hierarchical);
    EXPECT_EQ(winding_by_method(apart, WindingMethod::automatic).method(), WindingMethod::fast);
    EXPECT_NEAR(winding.evaluate_at(Vec3(0.1, 0.2, 0.3)), 1.0, 1e-4);
  }
}

TEST(WindingMethods, TrianglesAsLargeAsTheSurfaceTakeLittleMemory)
{
  // The surface consists of the faces of tets that are almost as large as the whole box. Each face
  // overlaps hundreds of small cells. WindingCells must therefore use larger cells, which limit the
  // number of pairs of a cell and a face.
  test::Random random(19);
  constexpr Index tets = 3000;
  TriangleMesh heap{ Points(4 * tets, 3), Triangles(4 * tets, 3) };
  for (Index t = 0; t < tets; ++t)
  {
    const Index v = 4 * t;
    for (int k = 0; k < 4; ++k)
    {
      heap.points.row(v + k) = random.in_box(Vec3::Constant(-1.0), Vec3::Ones()).transpose();
    }
    heap.triangles.row(v) << v, v + 2, v + 1;
    heap.triangles.row(v + 1) << v, v + 1, v + 3;
    heap.triangles.row(v + 2) << v + 1, v + 2, v + 3;
    heap.triangles.row(v + 3) << v + 2, v, v + 3;
  }
  const WindingNumber winding = winding_by_method(heap, WindingMethod::automatic);
  EXPECT_EQ(winding.method(), WindingMethod::crossings);
  // For n triangles, WindingCells stores at most 16 n + 100,000 pairs of a cell and a face. A pair
  // has 30 bytes. The pairs are stored in blocks that may be half empty.
  EXPECT_LT(static_cast<double>(winding.memory()), 64.0 * (16.0 * 4 * tets + 1e5));
  for (int i = 0; i < 20; ++i)
  {
    const Vec3 p = random.in_box(Vec3::Constant(-1.0), Vec3::Ones());
    const double expected = winding_number_direct(heap.points, heap.triangles, p);
    EXPECT_NEAR(winding.evaluate_at(p), expected, 1e-9);
  }
}

TEST(WindingMethods, FastKeepsItsTolerance)
{
  // The first surface is a sphere with holes. The second surface also has two nested open cubes,
  // one of them flipped. The random query points are inside and around the surfaces.
  const TriangleMesh sphere = test::sphere(4);
  TriangleMesh holes = sphere;
  Index kept = 0;
  for (Index t = 0; t < sphere.triangles.rows(); ++t)
  {
    if (t % 7 != 0)
    {
      holes.triangles.row(kept++) = sphere.triangles.row(t);
    }
  }
  holes.triangles.conservativeResize(kept, 3);
  const TriangleMesh several = test::join(test::translated(holes, Vec3(0.3, 0.2, 0.1)),
    test::join(test::open_cube(), test::flipped(test::open_cube(-0.5, 0.5))));
  for (const TriangleMesh& mesh : { holes, several })
  {
    for (const double tolerance : { 1e-2, 1e-3, 1e-5 })
    {
      SCOPED_TRACE(tolerance);
      WindingNumber::Options options;
      options.method = WindingMethod::fast;
      options.tolerance = tolerance;
      ExecutionContext context;
      WindingNumber winding;
      const Status status = winding.build(context, mesh.points, mesh.triangles, options);
      ASSERT_TRUE(status.ok());
      EXPECT_EQ(winding.method(), WindingMethod::fast);
      EXPECT_EQ(status.report.number("error_bound", -1.0), tolerance);
      EXPECT_LE(status.report.number("measured_error", 1.0), tolerance);
      Points queries(2000, 3);
      test::Random random(7);
      std::generate_n(queries.data(), queries.size(), [&] { return 5.0 * random.uniform() - 2.5; });
      Eigen::VectorXd values;
      ASSERT_TRUE(winding.evaluate(context, queries, values).ok());
      double worst = 0.0;
      for (Index i = 0; i < queries.rows(); ++i)
      {
        const double exact = winding_number_direct(mesh.points, mesh.triangles, queries.row(i));
        worst = std::max(worst, std::abs(values[i] - exact));
        EXPECT_NEAR(winding.evaluate_exactly_at(queries.row(i)), exact, 1e-11);
      }
      EXPECT_LE(worst, tolerance);
      // On the surface, the value is the exact principal value (the mean of both sides).
      bool on_surface = false;
      const Vec3 vertex = mesh.points.row(mesh.triangles(5, 1));
      EXPECT_NEAR(winding.evaluate_at(vertex, &on_surface),
        winding_number_direct(mesh.points, mesh.triangles, vertex), 1e-11);
      EXPECT_TRUE(on_surface);
    }
  }
}

TEST(WindingMethods, SameBitsForAnyThreadsAndExtent)
{
  const TriangleMesh mesh = unclean_surface(3, 0.3);
  SampleGrid grid;
  grid.origin = Vec3(-1.3, -1.2, -1.1);
  grid.spacing = Vec3(0.13, 0.12, 0.11);
  grid.extent = { -2, 20, 0, 19, 1, 18 };
  SampleGrid part = grid;
  part.extent = { 3, 11, 2, 19, 7, 8 };
  for (const WindingMethod method : { WindingMethod::direct, WindingMethod::hierarchical,
         WindingMethod::crossings, WindingMethod::fast })
  {
    const WindingNumber winding = winding_by_method(mesh, method);
    ExecutionContext one;
    one.set_threads(1);
    Eigen::VectorXd expected;
    ASSERT_TRUE(winding.evaluate(one, grid, expected).ok());
    ASSERT_EQ(expected.size(), 23 * 20 * 18);
    for (const int threads : { 0, 2, 5 })
    {
      ExecutionContext many;
      many.set_threads(threads);
      Eigen::VectorXd values;
      ASSERT_TRUE(winding.evaluate(many, grid, values).ok());
      EXPECT_EQ(std::memcmp(values.data(), expected.data(), sizeof(double) * values.size()), 0);
      // A build with another number of threads gives the same structure.
      ExecutionContext again;
      again.set_threads(threads);
      WindingNumber::Options options;
      options.method = method;
      WindingNumber rebuilt;
      ASSERT_TRUE(rebuilt.build(again, mesh.points, mesh.triangles, options).ok());
      ASSERT_TRUE(rebuilt.evaluate(again, grid, values).ok());
      EXPECT_EQ(std::memcmp(values.data(), expected.data(), sizeof(double) * values.size()), 0);
    }
    ExecutionContext context;
    Eigen::VectorXd values;
    ASSERT_TRUE(winding.evaluate(context, part, values).ok());
    Index at = 0;
    for (Index k = 7; k <= 8; ++k)
    {
      for (Index j = 2; j <= 19; ++j)
      {
        for (Index i = 3; i <= 11; ++i)
        {
          const double whole = expected[((k - 1) * 20 + j) * 23 + i + 2];
          ASSERT_EQ(values[at], whole);
          ASSERT_EQ(winding.evaluate_at(part.point(i, j, k)), whole);
          ++at;
        }
      }
    }
    EXPECT_EQ(at, values.size());
  }
}

TEST(WindingMethods, FineSurfacesOnRowsAndAtPoints)
{
  // The mesh has 164,000 triangles of very different sizes, so that cells are subdivided several
  // times. It is a torus that is thin at one end, around a small sphere that is inside out.
  TriangleMesh ring = test::torus(320, 128, 1.0, 0.45);
  for (Index v = 0; v < ring.points.rows(); ++v)
  {
    Vec3 p = ring.points.row(v);
    const double angle = std::atan2(p.y(), p.x());
    const Vec3 middle(std::cos(angle), std::sin(angle), 0.0);
    p = middle + (0.02 + 0.98 * std::pow(0.5 + 0.5 * std::cos(angle), 4)) * (p - middle);
    ring.points.row(v) = p;
  }
  const TriangleMesh ball = test::sphere(6, 0.02, Vec3(1.0, 0.0, 0.2));
  const TriangleMesh mesh = test::join(ring, test::flipped(ball));
  const WindingNumber winding = winding_by_method(mesh, WindingMethod::crossings);

  // Inside of the small sphere, the torus contributes 1 and the sphere -1.
  EXPECT_EQ(winding.evaluate_at(Vec3(1.0, 0.0, 0.2)), 0.0);
  EXPECT_EQ(winding.evaluate_at(Vec3(1.0, 0.0, -0.2)), 1.0);
  EXPECT_EQ(winding.evaluate_at(Vec3(-1.0, 0.001, 0.0003)), 1.0);
  EXPECT_EQ(winding.evaluate_at(Vec3(-1.0, 0.001, 0.02)), 0.0);

  SampleGrid grid;
  grid.origin = Vec3(-1.6, -1.6, -0.6);
  grid.spacing = Vec3(0.0401, 0.0403, 0.0397);
  grid.extent = { 0, 79, 0, 79, 0, 30 };
  ExecutionContext context;
  Eigen::VectorXd rows;
  ASSERT_TRUE(winding.evaluate(context, grid, rows).ok());
  for (Index i = 0; i < grid.count(); ++i)
  {
    const Vec3 p = grid.point(i % 80, i / 80 % 80, i / 6400);
    ASSERT_EQ(rows[i], winding.evaluate_at(p)) << p.transpose();
    ASSERT_EQ(rows[i], std::round(rows[i]));
  }
  // Compare with the plain sum at points that are mostly very close to the surface.
  test::Random random(7);
  for (int i = 0; i < 300; ++i)
  {
    const Index t = random.below(mesh.triangles.rows());
    const Vec3 a = mesh.points.row(mesh.triangles(t, 0));
    const Vec3 b = mesh.points.row(mesh.triangles(t, 1));
    const Vec3 c = mesh.points.row(mesh.triangles(t, 2));
    const Vec3 off = random.in_box(Vec3::Constant(-1.0), Vec3::Constant(1.0));
    const Vec3 p = (a + b + c) / 3.0 + std::pow(10.0, -random.uniform(1.0, 9.0)) * off;
    ASSERT_NEAR(
      winding.evaluate_at(p), winding_number_direct(mesh.points, mesh.triangles, p), 1e-9);
  }
}

TEST(WindingMethods, OnePointMayBeAskedFromManyThreads)
{
  const TriangleMesh mesh = unclean_surface(3, 0.3);
  const WindingNumber winding = winding_by_method(mesh, WindingMethod::automatic);
  const Vec3 p(0.1, 0.2, 0.3);
  const double expected = winding.evaluate_at(p);
  std::vector<std::thread> threads;
  std::atomic<int> wrong{ 0 };
  for (int i = 0; i < 4; ++i)
  {
    threads.emplace_back(
      [&]
      {
        for (int k = 0; k < 500; ++k)
        {
          wrong += winding.evaluate_at(p) != expected;
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(wrong, 0);
}

TEST(WindingMethods, ProgressGoesForwardAndCancelStops)
{
  const TriangleMesh mesh = unclean_surface(6, 0.3);
  Points queries(1000000, 3);
  queries.setConstant(0.01);
  for (const WindingMethod method : tested_methods)
  {
    std::vector<double> fractions;
    ExecutionContext watched(
      [&](double fraction, const std::string&) { fractions.push_back(fraction); }, nullptr);
    WindingNumber::Options options;
    options.method = method;
    WindingNumber winding;
    ASSERT_TRUE(winding.build(watched, mesh.points, mesh.triangles, options).ok());
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));

    using Clock = std::chrono::steady_clock;
    Clock::time_point asked{};
    ExecutionContext context(
      [&](double fraction, const std::string&)
      {
        if (fraction > 0.0 && asked == Clock::time_point())
        {
          asked = Clock::now();
          context.request_cancel();
        }
      },
      nullptr);
    Eigen::VectorXd w;
    const Status status = winding.evaluate(context, queries, w);
    EXPECT_EQ(status.code, StatusCode::canceled) << to_string(method);
    ASSERT_NE(asked, Clock::time_point());
    EXPECT_LT(
      std::chrono::duration<double>(Clock::now() - asked).count(), test::sanitized ? 2.0 : 0.2);
  }
}

TEST(WindingMethods, BuildCanBeCanceledAnywhere)
{
  const TriangleMesh mesh = unclean_surface(5, 0.3);
  int total_checks = 0;
  {
    ExecutionContext context(nullptr, [&] { return ++total_checks < 0; });
    context.set_threads(1);
    WindingNumber winding;
    ASSERT_TRUE(winding.build(context, mesh.points, mesh.triangles).ok());
  }
  ASSERT_GT(total_checks, 10);
  for (int stop = 1; stop <= total_checks; stop += 1 + total_checks / 20)
  {
    int asked = 0;
    ExecutionContext context(nullptr, [&] { return ++asked >= stop; });
    context.set_threads(1);
    WindingNumber winding;
    EXPECT_EQ(winding.build(context, mesh.points, mesh.triangles).code, StatusCode::canceled);
    EXPECT_EQ(winding.evaluate_at(Vec3::Zero()), 0.0);
    Eigen::VectorXd w;
    ExecutionContext fresh;
    EXPECT_EQ(winding.evaluate(fresh, mesh.points, w).code, StatusCode::canceled);
  }
}
