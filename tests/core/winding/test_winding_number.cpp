// Generalized winding numbers of surfaces with known values: closed forms, symmetries and
// identities.
#include "winding/winding_number.h"

#include "base/constants.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace bindpose;

namespace
{
constexpr WindingMethod methods[] = { WindingMethod::exact, WindingMethod::direct,
  WindingMethod::hierarchical, WindingMethod::crossings };

/// Return one WindingNumber of the mesh per method. Leaves are small, so that the trees have
/// several levels.
std::vector<WindingNumber> build_all_methods(const TriangleMesh& mesh)
{
  std::vector<WindingNumber> windings;
  for (const WindingMethod method : methods)
  {
    ExecutionContext context;
    WindingNumber::Options options;
    options.method = method;
    options.max_leaf_size = 4;
    windings.emplace_back();
    const Status status = windings.back().build(context, mesh.points, mesh.triangles, options);
    EXPECT_TRUE(status.ok()) << status.message;
  }
  return windings;
}

void expect_winding(const TriangleMesh& mesh, const Vec3& p, double expected, double tolerance)
{
  EXPECT_NEAR(winding_number_direct(mesh.points, mesh.triangles, p), expected, tolerance)
    << "reference at " << p.transpose();
  for (const WindingNumber& method_winding : build_all_methods(mesh))
  {
    EXPECT_NEAR(method_winding.evaluate_at(p), expected, tolerance)
      << to_string(method_winding.method()) << " at " << p.transpose();
  }
}

/// Return the mesh with only the given triangles.
TriangleMesh part(const TriangleMesh& mesh, const std::vector<Index>& triangles)
{
  TriangleMesh result;
  result.points = mesh.points;
  result.triangles.resize(static_cast<Index>(triangles.size()), 3);
  for (Index t = 0; t < result.triangles.rows(); ++t)
  {
    result.triangles.row(t) = mesh.triangles.row(triangles[t]);
  }
  return result;
}

TriangleMesh triangles_of(const std::vector<Vec3>& corners)
{
  TriangleMesh mesh;
  mesh.points.resize(static_cast<Index>(corners.size()), 3);
  mesh.triangles.resize(mesh.points.rows() / 3, 3);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    mesh.points.row(v) = corners[v].transpose();
    mesh.triangles(v / 3, v % 3) = v;
  }
  return mesh;
}

/// Return a regular n-gon of radius 1 at height 1 with an upward normal.
TriangleMesh disc(int n)
{
  std::vector<Vec3> corners;
  for (int i = 0; i < n; ++i)
  {
    const double s = 2.0 * pi * i / n;
    const double e = 2.0 * pi * (i + 1) / n;
    corners.insert(corners.end(),
      { Vec3(0, 0, 1), Vec3(std::cos(s), std::sin(s), 1), Vec3(std::cos(e), std::sin(e), 1) });
  }
  return triangles_of(corners);
}

/// Return the box [-1,1]^2 x [-1,0] without its face at z = 0.
TriangleMesh open_half_cube()
{
  TriangleMesh mesh = test::open_cube();
  mesh.points.col(2) = mesh.points.col(2).cwiseMin(0.0);
  return mesh;
}
} // namespace

TEST(WindingNumber, GradientIsTheKnownOneAndThatOfTheField)
{
  const TriangleMesh mesh = test::open_cube();
  const Vec3 point(0.3, 0.2, 0.4);
  for (const WindingMethod method : { WindingMethod::direct, WindingMethod::crossings,
         WindingMethod::hierarchical, WindingMethod::fast })
  {
    SCOPED_TRACE(to_string(method));
    WindingNumber::Options options;
    options.method = method;
    options.tolerance = 1e-6;
    ExecutionContext context;
    WindingNumber winding;
    ASSERT_TRUE(winding.build(context, mesh.points, mesh.triangles, options).ok());
    Points query(1, 3);
    query.row(0) = point.transpose();
    Vec3 gradient;
    ASSERT_TRUE(winding.evaluate_gradient(context, query, gradient.data()).ok());
    const double error = method == WindingMethod::fast ? 1e-5 : 5e-9;
    EXPECT_NEAR(gradient.x(), 0.05503676, error);
    EXPECT_NEAR(gradient.y(), 0.03449705, error);
    EXPECT_NEAR(gradient.z(), -0.30037298, error);
  }
  // If all lengths are multiplied by 1000, the gradient is divided by 1000.
  const WindingNumber large(Points(1000.0 * mesh.points), mesh.triangles);
  ExecutionContext context;
  Points query(1, 3);
  query.row(0) = 1000.0 * point.transpose();
  Vec3 gradient;
  ASSERT_TRUE(large.evaluate_gradient(context, query, gradient.data()).ok());
  EXPECT_NEAR(1000.0 * gradient.z(), -0.30037298, 5e-9);
}

TEST(WindingNumber, FlagsTellWhatTouchesTheSurface)
{
  // Some samples of the grid are on faces of the cube. Others are on, above and below the missing
  // face of the open cube.
  for (const TriangleMesh& mesh : { test::cube(), test::open_cube() })
  {
    for (const WindingMethod method : { WindingMethod::direct, WindingMethod::crossings,
           WindingMethod::hierarchical, WindingMethod::fast })
    {
      SCOPED_TRACE(to_string(method));
      WindingNumber::Options options;
      options.method = method;
      ExecutionContext context;
      WindingNumber winding;
      ASSERT_TRUE(winding.build(context, mesh.points, mesh.triangles, options).ok());
      SampleGrid grid;
      grid.origin = Vec3::Constant(-1.5);
      grid.spacing = Vec3::Constant(0.5);
      grid.extent = { 0, 6, 0, 6, 0, 6 };
      std::vector<double> values(static_cast<std::size_t>(grid.count()));
      std::vector<unsigned char> flags(values.size(), 7);
      ASSERT_TRUE(winding.evaluate(context, grid, values.data(), flags.data()).ok());
      for (Index i = 0; i < grid.count(); ++i)
      {
        const Vec3 p = grid.point(i % 7, i / 7 % 7, i / 49);
        bool touches = false;
        const double exact = winding_number_direct(mesh.points, mesh.triangles, p, &touches);
        EXPECT_EQ(flags[i], touches) << p.transpose();
        EXPECT_NEAR(values[i], exact, winding.method() == WindingMethod::fast ? 1e-3 : 1e-12);
      }
    }
  }
}

TEST(WindingNumber, ClosedSurfacesGiveWholeNumbers)
{
  const TriangleMesh cube = test::cube();
  expect_winding(cube, Vec3::Zero(), 1.0, 1e-15);
  expect_winding(cube, Vec3(10, 20, 30), 0.0, 1e-15);
  expect_winding(test::flipped(cube), Vec3::Zero(), -1.0, 1e-15);
  const auto windings = build_all_methods(cube);
  test::Random random(7);
  for (int i = 0; i < 2000; ++i)
  {
    const Vec3 p = random.in_box(Vec3::Constant(-2.0), Vec3::Constant(2.0));
    const double expected = p.cwiseAbs().maxCoeff() < 1.0 ? 1.0 : 0.0;
    for (const WindingNumber& method_winding : windings)
    {
      ASSERT_NEAR(method_winding.evaluate_at(p), expected, 1e-12)
        << to_string(method_winding.method());
    }
  }
}

TEST(WindingNumber, TorusHasAHole)
{
  const TriangleMesh torus = test::torus(40, 20, 1.0, 0.4);
  expect_winding(torus, Vec3(1, 0, 0), 1.0, 1e-12);
  expect_winding(torus, Vec3::Zero(), 0.0, 1e-12);
  expect_winding(torus, Vec3(0, -1.2, 0.1), 1.0, 1e-12);
  expect_winding(torus, Vec3(0, 0, 5), 0.0, 1e-12);
}

TEST(WindingNumber, CubeWithoutTop)
{
  const TriangleMesh mesh = test::open_cube();
  expect_winding(mesh, Vec3(0, 0, 0), 5.0 / 6.0, 1e-12);
  expect_winding(mesh, Vec3(0, 0, 0.5), 0.704832764699, 1e-12);
  expect_winding(mesh, Vec3(0, 0, -0.5), 0.900443260337, 1e-12);
  expect_winding(mesh, Vec3(0.5, 0.5, 0.5), 0.752195976723, 1e-12);
  expect_winding(mesh, Vec3(0, 0, 1.5), 0.295167235301, 1e-12);
  expect_winding(mesh, Vec3(0, 0, 1 - 1e-6), 0.50000045, 1e-8);
  expect_winding(mesh, Vec3(0, 0, 1 + 1e-6), 0.49999955, 1e-8);
  expect_winding(mesh, Vec3(0.9, 0.9, 0.9), 0.714469470243, 1e-12);
  for (const double z : { -0.7, 0.1, 0.6, 0.999 })
  {
    const double below = winding_number_direct(mesh.points, mesh.triangles, Vec3(0, 0, z));
    expect_winding(mesh, Vec3(0, 0, 2 - z), 1.0 - below, 1e-12);
  }
}

TEST(WindingNumber, ShareOfTheFullSphere)
{
  const TriangleMesh half = open_half_cube();
  for (const Vec3& p : { Vec3(0, 0, 0), Vec3(0.3, -0.7, 0), Vec3(-0.99, 0.99, 0) })
  {
    expect_winding(half, p, 0.5, 1e-12);
  }
  expect_winding(half, Vec3(0, 0, -0.5), 0.704832764699, 1e-12);
  const TriangleMesh three_faces = part(test::cube(), { 2, 3, 6, 7, 10, 11 });
  expect_winding(three_faces, Vec3::Zero(), 0.5, 1e-14);
  const TriangleMesh octant = triangles_of({ Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ() });
  expect_winding(octant, Vec3::Zero(), 0.125, 1e-15);
  expect_winding(part(test::cube(), { 10, 11 }), Vec3::Zero(), 1.0 / 6.0, 1e-15);
}

TEST(WindingNumber, DiscsConvergeToTheirCap)
{
  const double cap = 0.5 * (1.0 - std::sqrt(0.5));
  EXPECT_NEAR(cap, 0.146446609407, 1e-12);
  expect_winding(disc(32), Vec3::Zero(), cap - 5.685e-4, 5e-8);
  expect_winding(disc(64), Vec3::Zero(), cap - 1.420e-4, 5e-8);
  // The origin is on the axis of the disc. For a disc, dw/dz is 1/4 sqrt(1/2) there. The polygon
  // differs from the disc by less than 1e-5.
  const TriangleMesh fine = disc(512);
  const double h = 1e-5;
  const double up = winding_number_direct(fine.points, fine.triangles, Vec3(0, 0, h));
  const double down = winding_number_direct(fine.points, fine.triangles, Vec3(0, 0, -h));
  EXPECT_NEAR((up - down) / (2.0 * h), 0.176777, 1e-5);
}

TEST(WindingNumber, PartsAddUp)
{
  const TriangleMesh outer = test::cube();
  const TriangleMesh inner = test::cube(-0.5, 0.5);
  expect_winding(test::join(outer, inner), Vec3::Zero(), 2.0, 1e-14);
  const TriangleMesh shell = test::join(outer, test::flipped(inner));
  expect_winding(shell, Vec3::Zero(), 0.0, 1e-14);
  expect_winding(shell, Vec3(0.75, 0, 0), 1.0, 1e-14);
  const TriangleMesh overlapping = test::join(outer, test::translated(outer, Vec3(1, 0, 0)));
  expect_winding(overlapping, Vec3(0.5, 0.1, 0.2), 2.0, 1e-14);
  expect_winding(overlapping, Vec3(-0.5, 0.1, 0.2), 1.0, 1e-14);
  const TriangleMesh top = part(outer, { 10, 11 });
  expect_winding(test::join(outer, top), Vec3::Zero(), 7.0 / 6.0, 1e-14);
  expect_winding(test::join(test::open_cube(), test::flipped(top)), Vec3::Zero(), 2.0 / 3.0, 1e-14);
}

TEST(WindingNumber, JumpsByOneAcrossTheSurface)
{
  const TriangleMesh mesh = test::open_cube();
  for (const WindingNumber& method_winding : build_all_methods(mesh))
  {
    const auto jump = [&](double e)
    {
      return method_winding.evaluate_at(Vec3(.3, .1, -1 + e)) -
        method_winding.evaluate_at(Vec3(.3, .1, -1 - e));
    };
    EXPECT_NEAR(jump(1e-3), 0.9999000826, 1e-10) << to_string(method_winding.method());
    EXPECT_NEAR(jump(1e-6), 0.9999999001, 1e-10) << to_string(method_winding.method());
    EXPECT_NEAR(jump(1e-9), 0.9999999999, 1e-10) << to_string(method_winding.method());
    // Even for points that are only 1e-14 away from the surface, the jump is accurate.
    EXPECT_NEAR(jump(1e-14), 1.0, 1e-12) << to_string(method_winding.method());
  }
}

TEST(WindingNumber, HarmonicOffTheSurface)
{
  const TriangleMesh mesh = test::open_cube();
  const auto w = [&](const Vec3& p)
  { return winding_number_direct(mesh.points, mesh.triangles, p); };
  const Vec3 p(0.3, 0.2, 0.4);
  const double h = 0.01;
  double laplacian = -6.0 * w(p);
  Vec3 gradient;
  for (int k = 0; k < 3; ++k)
  {
    laplacian += w(p + h * Vec3::Unit(k)) + w(p - h * Vec3::Unit(k));
    gradient[k] = (w(p + 1e-5 * Vec3::Unit(k)) - w(p - 1e-5 * Vec3::Unit(k))) / 2e-5;
  }
  EXPECT_NEAR(laplacian / (h * h), 0.0, 1e-4); // the error is O(h^2)
  EXPECT_LT((gradient - Vec3(0.05503676, 0.03449705, -0.30037298)).norm(), 1e-7);
}

TEST(WindingNumber, PrincipalValueOnTheSurface)
{
  const TriangleMesh cube = test::cube();
  const std::vector<std::pair<Vec3, double>> cases{ { Vec3(0.2, 0.3, 1), 0.5 },
    { Vec3(0, 0, 1), 0.5 }, // this point is on the diagonal of the face
    { Vec3(1, 0.25, -0.5), 0.5 }, { Vec3(1, 1, 0.1), 0.25 }, { Vec3(-1, 0.7, -1), 0.25 },
    { Vec3(1, 1, 1), 0.125 }, { Vec3(-1, 1, -1), 0.125 } };
  for (const auto& [p, expected] : cases)
  {
    expect_winding(cube, p, expected, 1e-14);
    for (const WindingNumber& method_winding : build_all_methods(cube))
    {
      bool on_surface = false;
      method_winding.evaluate_at(p, &on_surface);
      EXPECT_TRUE(on_surface) << to_string(method_winding.method()) << " at " << p.transpose();
      method_winding.evaluate_at(p + Vec3(1e-6, 2e-6, 3e-6), &on_surface);
      EXPECT_FALSE(on_surface);
    }
  }
}

TEST(WindingNumber, PrincipalValueOnSlantedSurfacesFarFromTheOrigin)
{
  // At vertices, edges and faces of a regular tetrahedron, the winding numbers are known. The
  // tetrahedron is rotated, so rounding moves the query points slightly off its edges and faces.
  TriangleMesh mesh = triangles_of({ Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(1, 1, 1),
    Vec3(-1, 1, -1), Vec3(-1, -1, 1), Vec3(1, 1, 1), Vec3(-1, -1, 1), Vec3(1, -1, -1),
    Vec3(1, -1, -1), Vec3(-1, -1, 1), Vec3(-1, 1, -1) });
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (const double shift : { 0.0, 1000.0 })
  {
    TriangleMesh moved = mesh;
    moved.points = mesh.points * turn.transpose();
    moved = test::translated(moved, Vec3(shift, -2.0 * shift, 0.5 * shift));
    // The larger tolerance allows for the rounding of the translated corners.
    const double far = shift == 0.0 ? 1e-14 : 1e-10;
    const auto v = [&](int i) -> Vec3 { return moved.points.row(i); };
    expect_winding(moved, v(0), std::acos(23.0 / 27.0) / (4.0 * pi), far);
    expect_winding(moved, 0.5 * (v(0) + v(1)), std::acos(1.0 / 3.0) / (2.0 * pi), far);
    expect_winding(moved, (0.3 * v(1) + 0.7 * v(2)), std::acos(1.0 / 3.0) / (2.0 * pi), far);
    expect_winding(moved, (v(0) + v(1) + v(2)) / 3.0, 0.5, far);
    expect_winding(moved, 0.25 * (v(0) + v(1) + v(2) + v(5)), 1.0, 1e-12);
  }
}

TEST(WindingNumber, ShiftsScalesAndOrderDoNotMatter)
{
  TriangleMesh mesh = test::join(test::torus(24, 12, 1.0, 0.4), test::open_cube(-0.3, 0.4));
  const auto snap = [](double x) { return std::round(x * 0x1p20) * 0x1p-20; };
  mesh.points = mesh.points.unaryExpr(snap);
  test::Random random(3);
  Points queries(200, 3);
  for (Index i = 0; i < queries.rows(); ++i)
  {
    queries.row(i) = random.in_box(Vec3::Constant(-1.5), Vec3::Constant(1.5)).transpose();
  }
  queries = queries.unaryExpr(snap);
  const auto values = [](const TriangleMesh& m, const Points& at)
  {
    Eigen::VectorXd w;
    ExecutionContext context;
    EXPECT_TRUE(WindingNumber(m.points, m.triangles).evaluate(context, at, w).ok());
    return w;
  };
  const Eigen::VectorXd expected = values(mesh, queries);

  for (const double shift : { 0x1p10, -0x1p26 })
  {
    const Vec3 by(shift, shift, -shift);
    Points moved = queries;
    moved.rowwise() += by.transpose();
    EXPECT_LE(
      (values(test::translated(mesh, by), moved) - expected).lpNorm<Eigen::Infinity>(), 1e-12)
      << shift;
  }
  for (const double scale : { 0x1p-30, 0x1p17, 0x1p100 })
  {
    TriangleMesh scaled = mesh;
    scaled.points *= scale;
    EXPECT_EQ(values(scaled, scale * queries), expected) << scale;
  }

  TriangleMesh shuffled = mesh;
  std::vector<Index> to(static_cast<std::size_t>(mesh.points.rows()));
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    to[v] = (v * 101) % mesh.points.rows(); // #V is not divisible by 101, so this is a permutation
    shuffled.points.row(to[v]) = mesh.points.row(v);
  }
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      shuffled.triangles(mesh.triangles.rows() - 1 - t, k) = to[mesh.triangles(t, (k + t) % 3)];
    }
  }
  EXPECT_LE((values(shuffled, queries) - expected).lpNorm<Eigen::Infinity>(), 1e-12);
}

TEST(WindingNumber, FlatTrianglesCountNothing)
{
  TriangleMesh mesh = test::cube();
  const Index n = mesh.points.rows();
  mesh.points.conservativeResize(n + 3, 3);
  mesh.points.row(n) = mesh.points.row(0); // coincides with another vertex
  mesh.points.row(n + 1) << 0, 0, 0; // the midpoint of vertices 0 and 7
  mesh.points.row(n + 2) << 5, 5, 5; // no triangle uses this vertex
  mesh.triangles.conservativeResize(15, 3);
  mesh.triangles.row(12) << 0, 0, 1;
  mesh.triangles.row(13) << 0, n, 3;
  mesh.triangles.row(14) << 0, n + 1, 7;
  for (const WindingNumber& method_winding : build_all_methods(mesh))
  {
    const Report& report = method_winding.status().report;
    EXPECT_EQ(report.number("counts.degenerate_triangles", -1), 3);
    EXPECT_EQ(report.number("counts.merged_vertices", -1), 1);
    EXPECT_EQ(report.number("counts.triangles", -1), 15);
    EXPECT_EQ(report.number("counts.vertices", -1), 11);
  }
  expect_winding(mesh, Vec3(0.1, 0.2, 0.3), 1.0, 1e-14);
  expect_winding(mesh, Vec3(0.5, 0.5, 0.5), 1.0, 1e-14); // the point is on a degenerate triangle
  expect_winding(mesh, Vec3(1.5, 0.2, 0.3), 0.0, 1e-14);
  const TriangleMesh flat = part(mesh, { 12, 13, 14 });
  expect_winding(flat, Vec3(0.5, 0.25, 0.125), 0.0, 1e-15);
  expect_winding(flat, Vec3(0.5, 0.5, 0.5), 0.0, 1e-15);
}

TEST(WindingNumber, ReportTellsWhatTheSurfaceIs)
{
  // Each triangle of the cube has its own vertices. Before equal vertices are merged, there are
  // twelve components.
  const TriangleMesh cube = test::cube();
  std::vector<Vec3> corners;
  for (Index t = 0; t < 12; ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      corners.emplace_back(cube.points.row(cube.triangles(t, k)));
    }
  }
  const TriangleMesh soup = triangles_of(corners);
  ExecutionContext context;
  WindingNumber winding;
  Report report = winding.build(context, soup.points, soup.triangles).report;
  EXPECT_EQ(report.number("counts.boundary_edges", -1), 0);
  EXPECT_EQ(report.number("counts.open_edges", -1), 0);
  EXPECT_EQ(report.number("counts.components", -1), 1);
  EXPECT_EQ(report.number("counts.merged_vertices", -1), 28);
  EXPECT_DOUBLE_EQ(report.number("volume", -1), 8.0);
  EXPECT_FALSE(report.text("method").empty());
  EXPECT_FALSE(report.text("method_reason").empty());

  const TriangleMesh doubled = test::join(test::open_cube(), test::open_cube());
  report = winding.build(context, doubled.points, doubled.triangles).report;
  EXPECT_EQ(report.number("counts.duplicate_triangles", -1), 10);
  EXPECT_EQ(report.number("counts.boundary_edges", -1), 0);
  EXPECT_EQ(report.number("counts.open_edges", -1), 4);
  EXPECT_EQ(report.number("counts.nonmanifold_edges", -1), 13);
}

TEST(WindingNumber, BoundaryTellsEdgesAndComponents)
{
  // The mesh consists of a cube without its top, a flipped copy of it far away, a closed cube that
  // is inside out, and two copies of one triangle. The edges of these copies have multiplicity 2.
  TriangleMesh twice;
  twice.points.resize(3, 3);
  twice.points << 0, 0, 50, 1, 0, 50, 0, 1, 50;
  twice.triangles.resize(2, 3);
  twice.triangles << 0, 1, 2, 1, 2, 0;
  const Vec3 far_away(1e6, 0, 0);
  TriangleMesh mesh = test::join(test::open_cube(),
    test::join(test::translated(test::flipped(test::open_cube()), far_away),
      test::join(test::flipped(test::cube(10.0, 13.0)), twice)));
  const WindingNumber winding(mesh.points, mesh.triangles);
  const SurfaceBoundary& boundary = winding.boundary();
  ASSERT_EQ(boundary.components.size(), 4u);
  ASSERT_EQ(boundary.edges.size(), 4u + 4u + 3u);
  // The position of an edge shows to which component the edge must belong.
  std::vector<int> seen(4, 0);
  for (const SurfaceBoundary::BoundaryEdge& edge : boundary.edges)
  {
    const SurfaceBoundary::Component& part = boundary.components[edge.component];
    const Vec3 from = mesh.points.row(edge.from);
    const Vec3 to = mesh.points.row(edge.to);
    seen[edge.component] += 1;
    if (from[2] == 50.0)
    {
      EXPECT_EQ(edge.multiplicity, 2);
      EXPECT_EQ(part.triangles, 2);
      EXPECT_EQ(part.open_edges, 6);
      EXPECT_EQ(part.volume, 0.0);
      continue;
    }
    EXPECT_EQ(edge.multiplicity, 1);
    EXPECT_EQ(part.triangles, 10);
    EXPECT_EQ(part.open_edges, 4);
    const bool flipped = from[0] > 1e5;
    EXPECT_NEAR(part.volume, flipped ? -8.0 : 8.0, 1e-9);
    // Viewed from above, the directed boundary edges of the walls run clockwise around the hole.
    // The edges of triangles that close the hole would run counter-clockwise.
    const Vec3 middle = flipped ? far_away : Vec3::Zero();
    EXPECT_EQ(from[2], 1.0);
    EXPECT_NEAR((from - middle).cross(to - middle)[2], flipped ? 2.0 : -2.0, 1e-9);
  }
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(seen, (std::vector<int>{ 0, 3, 4, 4 }));
  double closed_volume = 0.0;
  for (const SurfaceBoundary::Component& part : boundary.components)
  {
    closed_volume += part.open_edges == 0 ? part.volume : 0.0;
  }
  EXPECT_NEAR(closed_volume, -27.0, 1e-9);
  EXPECT_NEAR(winding.status().report.number("volume", 0.0), -27.0, 1e-9);
}

TEST(WindingNumber, EmptyMeshWindsAroundNothing)
{
  const TriangleMesh nothing{ Points(0, 3), Triangles(0, 3) };
  for (const WindingNumber& method_winding : build_all_methods(nothing))
  {
    EXPECT_EQ(method_winding.evaluate_at(Vec3(1, 2, 3)), 0.0);
    ASSERT_EQ(method_winding.status().warnings.size(), 1u);
  }
  EXPECT_EQ(winding_number_direct(nothing.points, nothing.triangles, Vec3::Zero()), 0.0);
  // Before a build, the winding number is 0 everywhere.
  EXPECT_EQ(WindingNumber().evaluate_at(Vec3(1, 2, 3)), 0.0);
}

TEST(WindingNumber, BadInputIsNamed)
{
  ExecutionContext context;
  WindingNumber winding;
  TriangleMesh mesh = test::cube();
  mesh.triangles(3, 1) = 8;
  Status status = winding.build(context, mesh.points, mesh.triangles);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_NE(status.message.find("vertex 8"), std::string::npos);
  Eigen::VectorXd w;
  EXPECT_EQ(winding.evaluate(context, mesh.points, w).code, StatusCode::invalid_input);

  mesh = test::cube();
  mesh.points(5, 2) = std::numeric_limits<double>::quiet_NaN();
  status = winding.build(context, mesh.points, mesh.triangles);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_NE(status.message.find("vertex 5"), std::string::npos);

  WindingNumber::Options options;
  options.max_leaf_size = 0;
  status = winding.build(context, test::cube().points, test::cube().triangles, options);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_NE(status.message.find("max_leaf_size"), std::string::npos);
}

TEST(WindingNumber, PointsThatAreNoneGiveNaN)
{
  const TriangleMesh cube = test::cube();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Points queries(5, 3);
  queries << 0, 0, 0, nan, 0, 0, 0, 0, infinity, 1e200, 0, 0, 1, 1, 1;
  for (const WindingNumber& method_winding : build_all_methods(cube))
  {
    ExecutionContext context;
    Eigen::VectorXd w;
    const Status status = method_winding.evaluate(context, queries, w);
    EXPECT_TRUE(status.ok());
    EXPECT_EQ(status.report.number("counts.not_finite", -1), 2);
    EXPECT_EQ(status.report.number("counts.on_surface", -1), 1);
    EXPECT_EQ(status.report.number("counts.queries", -1), 5);
    EXPECT_EQ(status.warnings.size(), 1u);
    EXPECT_NEAR(w[0], 1.0, 1e-15);
    EXPECT_TRUE(std::isnan(w[1]));
    EXPECT_TRUE(std::isnan(w[2]));
    EXPECT_EQ(w[3], 0.0);
  }
}
