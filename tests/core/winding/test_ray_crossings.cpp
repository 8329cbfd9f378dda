// Integer winding numbers of closed surfaces, computed by ray crossings and compared with known
// values. In some tests, vertices, edges and faces are on the rays. The winding numbers must not
// depend on the expected number of query points.
#include "winding/ray_crossings.h"

#include "winding/exact_frame.h"
#include "winding/winding_number.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>

using namespace bindpose;
using test::random_points;

namespace
{
/// Return tetrahedra whose corners are on a lattice of spacing 1/4 in a box of side 2. The surface
/// is closed, and some tetrahedra are inside out.
TriangleMesh lattice_tets(test::Random& random, Index tets)
{
  TriangleMesh mesh{ Points(4 * tets, 3), Triangles(4 * tets, 3) };
  for (Index t = 0; t < tets; ++t)
  {
    const Index v = 4 * t;
    for (int k = 0; k < 12; ++k)
    {
      mesh.points(v + k / 3, k % 3) = static_cast<double>(random.below(9)) / 4.0 - 1.0;
    }
    mesh.triangles.row(v) << v, v + 2, v + 1;
    mesh.triangles.row(v + 1) << v, v + 1, v + 3;
    mesh.triangles.row(v + 2) << v + 1, v + 2, v + 3;
    mesh.triangles.row(v + 3) << v + 2, v, v + 3;
  }
  return mesh;
}

/// Return a grid of spacing 1/8 around the box of lattice_tets(). The rays along its rows pass
/// through vertices, along edges and in faces of the tetrahedra.
SampleGrid lattice_grid()
{
  SampleGrid grid;
  grid.origin = Vec3::Constant(-1.25);
  grid.spacing = Vec3::Constant(0.125);
  grid.extent = { 0, 20, 0, 20, 0, 20 };
  return grid;
}

/// Return a sphere without every n-th triangle.
TriangleMesh with_holes(int levels, Index n)
{
  TriangleMesh mesh = test::sphere(levels);
  Index kept = 0;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    if (t % n != 0)
    {
      mesh.triangles.row(kept++) = mesh.triangles.row(t);
    }
  }
  mesh.triangles.conservativeResize(kept, 3);
  return mesh;
}

WindingNumber winding_for_queries(
  const TriangleMesh& mesh, WindingMethod method, Index expected, const Box& region = {})
{
  ExecutionContext context;
  WindingNumber::Options options;
  options.method = method;
  options.expected_queries = expected;
  options.query_region = region;
  WindingNumber winding;
  EXPECT_TRUE(winding.build(context, mesh.points, mesh.triangles, options).ok());
  return winding;
}
} // namespace

TEST(RayCrossings, RaysThroughVerticesEdgesAndFaces)
{
  test::Random random(3);
  const SampleGrid grid = lattice_grid();
  std::vector<Vec3> points;
  for (Index i = 0; i < grid.count(); ++i)
  {
    points.push_back(grid.point(i));
  }
  const Triangles no_caps(0, 3);
  for (const Index tets : { 1, 3, 12, 40 })
  {
    SCOPED_TRACE(tets);
    const TriangleMesh mesh = lattice_tets(random, tets);
    const ExactFrame frame(bounding_box(mesh.points, mesh.triangles));
    // The frame scales by a power of two and does not translate the box. The coordinates therefore
    // remain exact.
    Points framed = mesh.points;
    for (Index v = 0; v < framed.rows(); ++v)
    {
      framed.row(v) = frame(framed.row(v)).transpose();
    }
    std::vector<Vec3> framed_points;
    for (const Vec3& p : points)
    {
      framed_points.push_back(frame(p));
    }
    const RayCrossings rays(framed, mesh.triangles, no_caps, frame.tolerance);
    std::vector<int> counts(points.size());
    std::vector<unsigned char> resolved(points.size());
    ExecutionContext context;
    ASSERT_TRUE(rays.count(context, framed_points.data(), static_cast<Index>(points.size()),
      counts.data(), resolved.data()));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      bool touches = false;
      const double sum = winding_number_direct(mesh.points, mesh.triangles, points[i], &touches);
      // The plain sum may also report contact with degenerate triangles. These triangles do not
      // contribute to the surface, and the rays may ignore them.
      if (touches)
      {
        EXPECT_FALSE(resolved[i]) << points[i].transpose();
      }
      else if (resolved[i])
      {
        EXPECT_NEAR(counts[i], sum, 1e-9) << points[i].transpose();
      }
    }
    // Evaluation by rows of the grid gives the same counts.
    RayCrossings::Grid rows;
    for (Index i = 0; i < 21; ++i)
    {
      const Vec3 p = frame(grid.point(i, i, i));
      for (int k = 0; k < 3; ++k)
      {
        rows.at[k].push_back(p[k]);
      }
    }
    const RayCrossings::Layers layers = rays.find_layers(rows);
    const Index slabs = static_cast<Index>(layers.begin.size()) - 1;
    std::vector<double> values(points.size());
    std::set<Index> unresolved;
    for (Index slab = 0; slab < slabs; ++slab)
    {
      const Index first = slab * layers.layers_per_slab * 21 * 21;
      std::vector<Index> here;
      rays.count_slab(rows, layers, slab, values.data() + first, here);
      for (const Index i : here)
      {
        unresolved.insert(first + i);
      }
    }
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      EXPECT_EQ(unresolved.count(static_cast<Index>(i)) == 0, resolved[i] != 0);
      if (resolved[i])
      {
        EXPECT_EQ(values[i], counts[i]);
      }
    }
  }
}

TEST(RayCrossings, FewAndManyPointsOfACurvedSurface)
{
  const TriangleMesh mesh =
    test::join(test::torus(60, 30, 1.0, 0.3), test::translated(test::sphere(4), Vec3(1, 0.1, 0)));
  const Triangles no_caps(0, 3);
  const ExactFrame frame(bounding_box(mesh.points, mesh.triangles));
  Points framed = mesh.points;
  for (Index v = 0; v < framed.rows(); ++v)
  {
    framed.row(v) = frame(framed.row(v)).transpose();
  }
  const RayCrossings rays(framed, mesh.triangles, no_caps, frame.tolerance);
  for (const Index count : { 1, 10, 1000, 200000 })
  {
    const Points points = random_points(count, 1.5, 5);
    std::vector<Vec3> queries;
    for (Index i = 0; i < count; ++i)
    {
      queries.push_back(frame(points.row(i)));
    }
    std::vector<int> counts(queries.size());
    std::vector<unsigned char> resolved(queries.size());
    ExecutionContext context;
    ASSERT_TRUE(rays.count(context, queries.data(), count, counts.data(), resolved.data()));
    const Index step = std::max<Index>(1, count / 200);
    for (Index i = 0; i < count; i += step)
    {
      EXPECT_TRUE(resolved[i]);
      EXPECT_NEAR(
        counts[i], winding_number_direct(mesh.points, mesh.triangles, points.row(i)), 1e-9);
    }
  }
}

TEST(RayCrossings, TrianglesAsLargeAsTheSurfaceAreNotListedInEveryLayer)
{
  // Each tet spans the whole box, so each face crosses about half of the grid's layers. Lists of
  // faces per layer would be too large.
  test::Random random(19);
  constexpr Index tets = 3000;
  TriangleMesh heap = lattice_tets(random, tets);
  for (Index v = 0; v < heap.points.rows(); ++v)
  {
    heap.points.row(v) = random.in_box(Vec3::Constant(-1.0), Vec3::Ones()).transpose();
  }
  const RayCrossings rays(heap.points, heap.triangles, Triangles(0, 3), 1e-15);
  RayCrossings::Grid grid;
  for (int k = 0; k < 3; ++k)
  {
    for (int i = 0; i < (k < 2 ? 256 : 1200); ++i)
    {
      grid.at[k].push_back(-1.0 + 2.0 * i / (k < 2 ? 255 : 1199));
    }
  }
  const RayCrossings::Layers layers = rays.find_layers(grid);
  EXPECT_TRUE(layers.faces.empty());
  EXPECT_TRUE(std::isinf(layers.nanoseconds));
}

TEST(RayCrossings, CancelStopsThem)
{
  const TriangleMesh mesh = test::sphere(4);
  const RayCrossings rays(mesh.points, mesh.triangles, Triangles(0, 3), 1e-15);
  const std::vector<Vec3> points(1000, Vec3::Zero());
  std::vector<int> counts(points.size());
  std::vector<unsigned char> resolved(points.size());
  ExecutionContext context;
  context.request_cancel();
  EXPECT_FALSE(rays.count(context, points.data(), 1000, counts.data(), resolved.data()));
}

TEST(WindingExpectedQueries, ExactValuesDoNotDependOnThem)
{
  SampleGrid grid;
  grid.origin = Vec3::Constant(-1.3);
  grid.spacing = Vec3::Constant(0.13);
  grid.extent = { 0, 20, 0, 20, 0, 20 };
  const Points points = random_points(3000, 1.4, 7);
  for (const TriangleMesh& mesh : { test::sphere(4), with_holes(4, 50), test::cube() })
  {
    ExecutionContext context;
    const WindingNumber many = winding_for_queries(mesh, WindingMethod::exact, 0);
    Eigen::VectorXd on_grid, at_points;
    ASSERT_TRUE(many.evaluate(context, grid, on_grid).ok());
    ASSERT_TRUE(many.evaluate(context, points, at_points).ok());
    for (const Index expected : { 1, 1000, 100000, 100000000 })
    {
      const WindingNumber few = winding_for_queries(mesh, WindingMethod::exact, expected);
      Eigen::VectorXd values;
      ASSERT_TRUE(few.evaluate(context, points, values).ok());
      EXPECT_EQ(values, at_points);
      ASSERT_TRUE(few.evaluate(context, grid, values).ok());
      EXPECT_EQ(values, on_grid);
      EXPECT_EQ(few.evaluate_at(points.row(5)), at_points[5]);
    }
  }
}

TEST(WindingExpectedQueries, FastKeepsItsToleranceForAnyNumber)
{
  const TriangleMesh mesh = test::join(with_holes(3, 7), test::open_cube());
  const Points points = random_points(1000, 2.0, 9);
  for (const double tolerance : { 1e-2, 1e-3, 1e-5 })
  {
    for (const Index expected : { 1, 3000, 30000, 3000000 })
    {
      SCOPED_TRACE(expected);
      ExecutionContext context;
      WindingNumber::Options options;
      options.method = WindingMethod::fast;
      options.tolerance = tolerance;
      options.expected_queries = expected;
      WindingNumber winding;
      const Status status = winding.build(context, mesh.points, mesh.triangles, options);
      ASSERT_TRUE(status.ok());
      EXPECT_EQ(status.report.number("error_bound", -1.0), tolerance);
      EXPECT_LE(status.report.number("measured_error", 1.0), tolerance);
      Eigen::VectorXd values;
      ASSERT_TRUE(winding.evaluate(context, points, values).ok());
      double worst = 0.0;
      for (Index i = 0; i < points.rows(); ++i)
      {
        worst = std::max(worst,
          std::abs(values[i] - winding_number_direct(mesh.points, mesh.triangles, points.row(i))));
      }
      EXPECT_LE(worst, tolerance);
      // Single points give the same bits as batches, on any number of threads.
      EXPECT_EQ(winding.evaluate_at(points.row(3)), values[3]);
      ExecutionContext one;
      one.set_threads(1);
      WindingNumber again;
      ASSERT_TRUE(again.build(one, mesh.points, mesh.triangles, options).ok());
      Eigen::VectorXd other;
      ASSERT_TRUE(again.evaluate(one, points, other).ok());
      EXPECT_EQ(std::memcmp(other.data(), values.data(), sizeof(double) * values.size()), 0);
    }
  }
}

TEST(WindingExpectedQueries, FastKeepsItsToleranceInAndAroundTheRegion)
{
  const TriangleMesh mesh = test::join(with_holes(3, 7), test::open_cube());
  const Points points = random_points(1000, 2.0, 9);
  const Box corner{ Vec3::Constant(0.5), Vec3::Constant(0.9) };
  const Box sheet{ Vec3(-1, -1, 0.2), Vec3(1, 1, 0.2) };
  const Box around{ Vec3::Constant(-50), Vec3::Constant(50) };
  const Box elsewhere{ Vec3::Constant(40), Vec3::Constant(50) };
  for (const Box& region : { corner, sheet, around, elsewhere })
  {
    SCOPED_TRACE(region.lower[2]);
    const WindingNumber winding = winding_for_queries(mesh, WindingMethod::fast, 3000000, region);
    ASSERT_TRUE(winding.status().ok());
    const double tolerance = WindingNumber::Options().tolerance;
    EXPECT_LE(winding.status().report.number("measured_error", 1.0), tolerance);
    ExecutionContext context;
    Eigen::VectorXd values;
    ASSERT_TRUE(winding.evaluate(context, points, values).ok());
    for (Index i = 0; i < points.rows(); ++i)
    {
      EXPECT_NEAR(
        values[i], winding_number_direct(mesh.points, mesh.triangles, points.row(i)), tolerance);
    }
  }
}

TEST(WindingExpectedQueries, ASmallRegionPaysForNoLargeStructure)
{
  const TriangleMesh mesh = with_holes(5, 100);
  const auto memory = [&](const Box& region)
  { return winding_for_queries(mesh, WindingMethod::fast, 100000, region).memory(); };
  // The fast method refines its cells only in the region of the query points. This region is
  // outside of the sphere, so fewer cells are refined.
  const Index everywhere = memory({});
  const Index corner = memory({ Vec3::Constant(1.1), Vec3::Constant(1.3) });
  EXPECT_LT(corner, everywhere);
}

TEST(WindingExpectedQueries, FewPointsPayForNoLargeStructure)
{
  const TriangleMesh closed = test::sphere(5);
  const TriangleMesh open = with_holes(5, 20);
  for (const TriangleMesh* mesh : { &closed, &open })
  {
    const WindingNumber few = winding_for_queries(*mesh, WindingMethod::automatic, 100);
    const WindingNumber many = winding_for_queries(*mesh, WindingMethod::automatic, 0);
    EXPECT_LT(3 * few.memory(), many.memory());
  }
}

TEST(WindingExpectedQueries, ManySmallEvaluationsBuildCellsInTheEnd)
{
  const TriangleMesh mesh = test::sphere(4);
  const WindingNumber winding = winding_for_queries(mesh, WindingMethod::exact, 10);
  const Index before = winding.memory();
  const Points points = random_points(10, 1.2, 11);
  ExecutionContext context;
  Eigen::VectorXd first;
  ASSERT_TRUE(winding.evaluate(context, points, first).ok());
  EXPECT_EQ(winding.memory(), before);
  for (int i = 0; i < 1000; ++i)
  {
    Eigen::VectorXd values;
    ASSERT_TRUE(winding.evaluate(context, points, values).ok());
    ASSERT_EQ(values, first);
  }
  EXPECT_GT(winding.memory(), before);
}

TEST(WindingExpectedQueries, NegativeNumbersAreRefused)
{
  const TriangleMesh mesh = test::cube();
  ExecutionContext context;
  WindingNumber::Options options;
  options.expected_queries = -1;
  WindingNumber winding;
  const Status status = winding.build(context, mesh.points, mesh.triangles, options);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_NE(status.message.find("expected_queries"), std::string::npos);
}

TEST(WindingExpectedQueries, ARegionThatIsNotFiniteIsRefused)
{
  const TriangleMesh mesh = test::cube();
  ExecutionContext context;
  WindingNumber::Options options;
  options.query_region = { Vec3::Zero(), Vec3::Constant(std::numeric_limits<double>::infinity()) };
  WindingNumber winding;
  const Status status = winding.build(context, mesh.points, mesh.triangles, options);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_NE(status.message.find("query_region"), std::string::npos);
}
