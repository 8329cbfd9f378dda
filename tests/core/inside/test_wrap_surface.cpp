// Alpha wraps (CGAL) of any triangles are closed, contain the whole surface, and are close to it.
#include "inside/wrap_surface.h"

#include "surface/triangle_tree.h"
#include "winding/winding_number.h"

#include "support/environment.h"
#include "support/meshes.h"
#include "support/sanitized.h"
#include "support/needs_mesher.h"
#include "support/stand_in.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

using namespace bindpose;
using test::Environment;
using testing::HasSubstr;

namespace
{
Status run_wrap(const TriangleMesh& mesh, const WrapOptions& options, TriangleMesh& wrap)
{
  ExecutionContext context;
  return wrap_surface(context, mesh.points, mesh.triangles, options, wrap.points, wrap.triangles);
}

TriangleMesh one_triangle()
{
  TriangleMesh triangle = test::grid(1, 1);
  triangle.triangles.conservativeResize(1, 3);
  return triangle;
}

TriangleMesh loose_triangles(int count)
{
  test::Random random(7);
  TriangleMesh soup;
  soup.points.resize(3 * count, 3);
  soup.triangles.resize(count, 3);
  for (Index f = 0; f < count; ++f)
  {
    const Vec3 center = random.in_box(Vec3::Zero(), Vec3::Ones());
    for (Index k = 0; k < 3; ++k)
    {
      soup.points.row(3 * f + k) =
        center + random.in_box(Vec3::Constant(-0.1), Vec3::Constant(0.1));
      soup.triangles(f, k) = 3 * f + k;
    }
  }
  return soup;
}

/// Expect that the wrap is closed and oriented outwards, that each edge has two triangles, and that
/// no triangles cross.
void expect_clean(const TriangleMesh& wrap)
{
  ASSERT_GT(wrap.triangles.rows(), 0);
  ASSERT_TRUE(check_mesh(wrap.points, wrap.triangles).ok());
  for (const Edge& edge : mesh_edges(wrap.triangles))
  {
    ASSERT_EQ(edge.triangle_count, 2);
    ASSERT_EQ(edge.net_direction, 0);
  }
  ExecutionContext context;
  std::vector<std::pair<Index, Index>> pairs;
  ASSERT_TRUE(crossing_pairs(context, wrap.points, wrap.triangles, pairs));
  EXPECT_EQ(pairs.size(), 0u);
  EXPECT_GT(signed_volume(wrap.points, wrap.triangles), 0.0);
}

/// Expect that every vertex and triangle center of the surface is inside of the wrap or, at
/// corners, on it. Expect that the distance of the wrap's vertices from the surface is the
/// offset.
void expect_around(const TriangleMesh& wrap, const TriangleMesh& mesh, double offset)
{
  ExecutionContext context;
  WindingNumber winding;
  ASSERT_TRUE(winding.build(context, wrap.points, wrap.triangles).ok());
  const double diagonal = bounding_box(mesh.points, mesh.triangles).diagonal();
  const TriangleTree wrap_tree(wrap.points, wrap.triangles);
  const auto is_contained = [&](const Vec3& p)
  {
    return std::abs(winding.evaluate_exactly_at(p) - 1.0) < 1e-6 ||
      wrap_tree.distance(p, 1e9) < 1e-14 * diagonal;
  };
  for (Index f = 0; f < mesh.triangles.rows(); ++f)
  {
    Vec3 center = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 p = mesh.points.row(mesh.triangles(f, k));
      EXPECT_TRUE(is_contained(p)) << f;
      center += p / 3.0;
    }
    EXPECT_TRUE(is_contained(center)) << f;
  }
  const TriangleTree tree(mesh.points, mesh.triangles);
  const double length = offset * diagonal;
  for (Index v = 0; v < wrap.points.rows(); ++v)
  {
    const double distance = tree.distance(wrap.points.row(v), 1e9);
    EXPECT_NEAR(distance, length, 0.01 * length) << v;
  }
}

class WrapSurface : public test::MesherTest
{
};
} // namespace

TEST_F(WrapSurface, IsClosedAndAroundWhateverItIsGiven)
{
  TriangleMesh flipped_half = test::sphere(2);
  for (Index f = 0; f < flipped_half.triangles.rows(); f += 2)
  {
    std::swap(flipped_half.triangles(f, 0), flipped_half.triangles(f, 1));
  }
  struct Case
  {
    const char* name;
    TriangleMesh mesh;
    Index characteristic; ///< Euler characteristic: 2 per ball, 0 per torus, -1 if unknown
  };
  const WrapOptions options{ 0.05, 0.002, 60.0, 0 };
  for (const Case& c :
    { Case{ "sphere", test::sphere(2), 2 }, Case{ "torus", test::torus(24, 12, 1.0, 0.4), 0 },
      Case{ "open cube", test::open_cube(), 2 }, Case{ "half turned", flipped_half, 2 },
      Case{ "triangle", one_triangle(), 2 }, Case{ "sheet", test::grid(3, 2), 2 },
      Case{ "soup", loose_triangles(30), -1 },
      Case{ "crossing", test::join(test::cube(), test::sphere(2, 1.2, Vec3(1, 0.1, 0.2))), 2 },
      Case{ "two", test::join(test::cube(), test::translated(test::cube(), Vec3(5, 0, 0))), 4 },
      Case{ "one in the other", test::join(test::cube(), test::sphere(2, 0.5)), 2 } })
  {
    SCOPED_TRACE(c.name);
    TriangleMesh wrap;
    const Status status = run_wrap(c.mesh, options, wrap);
    ASSERT_TRUE(status.ok()) << status.message;
    expect_clean(wrap);
    expect_around(wrap, c.mesh, options.offset);
    if (c.characteristic >= 0)
    {
      EXPECT_EQ(test::euler_characteristic(wrap), c.characteristic);
    }
  }
}

TEST_F(WrapSurface, VolumesAreWhatAlphaAndOffsetSay)
{
  // The wrap of a convex body is larger than the body, and smaller than the region of all points
  // whose distance from the body is at most the offset.
  const WrapOptions options{ 0.05, 0.004, 60.0, 0 };
  TriangleMesh wrap;
  ASSERT_TRUE(run_wrap(test::cube(), options, wrap).ok());
  const double offset = options.offset * std::sqrt(12.0);
  const double volume = signed_volume(wrap.points, wrap.triangles);
  EXPECT_GT(volume, 8.0);
  EXPECT_LT(volume, 8.0 + 24.0 * offset + 6.0 * M_PI * offset * offset + 5.0 * std::pow(offset, 3));
  // The wrap of a flat sheet is a slab whose thickness is twice the offset. The rounded rim of the
  // slab changes the volume only a little.
  ASSERT_TRUE(run_wrap(test::grid(4, 4), options, wrap).ok());
  const TriangleMesh sheet = test::grid(4, 4);
  const double thickness = 2.0 * options.offset * bounding_box(sheet.points).diagonal();
  const double ratio = signed_volume(wrap.points, wrap.triangles) /
    (surface_area(sheet.points, sheet.triangles) * thickness);
  EXPECT_GT(ratio, 0.95);
  EXPECT_LT(ratio, 1.1);
  // The wrap enters a hole only if the alpha ball fits through it.
  TriangleMesh holed = test::sphere(2);
  holed.triangles.conservativeResize(holed.triangles.rows() - 1, 3);
  ASSERT_TRUE(run_wrap(holed, { 0.1, 0.002, 60.0, 0 }, wrap).ok());
  EXPECT_GT(signed_volume(wrap.points, wrap.triangles), 4.0);
  ASSERT_TRUE(run_wrap(holed, { 0.015, 0.002, 60.0, 0 }, wrap).ok());
  EXPECT_LT(signed_volume(wrap.points, wrap.triangles), 0.6);
}

TEST_F(WrapSurface, PlaceAndScaleDoNotMatter)
{
  const WrapOptions options{ 0.1, 0.005, 60.0, 0 };
  TriangleMesh here, there;
  ASSERT_TRUE(run_wrap(test::torus(12, 8, 1.0, 0.4), options, here).ok());
  TriangleMesh moved = test::torus(12, 8, 1.0, 0.4);
  constexpr double scale = 0x1p-30;
  moved.points *= scale;
  ASSERT_TRUE(run_wrap(moved, options, there).ok());
  EXPECT_EQ(there.triangles, here.triangles);
  EXPECT_EQ(there.points, here.points * scale) << "a power of two changes no digit";
  moved = test::translated(test::torus(12, 8, 1.0, 0.4), Vec3(1e7, -1e7, 1e7));
  ASSERT_TRUE(run_wrap(moved, options, there).ok());
  expect_clean(there);
  EXPECT_NEAR(
    signed_volume(there.points, there.triangles) / signed_volume(here.points, here.triangles), 1.0,
    1e-3);
}

TEST_F(WrapSurface, TimeMemoryAndCancelEndIt)
{
  // The complete wrap would have about a million triangles.
  WrapOptions options{ 0.0005, 0.0001, 0.5, 0 };
  TriangleMesh wrap;
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&]
  { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  Status status = run_wrap(test::sphere(3), options, wrap);
  EXPECT_EQ(status.code, StatusCode::internal_error);
  EXPECT_THAT(status.message, HasSubstr("wrap was stopped at its time limit of 0.5 s"));
  EXPECT_EQ(wrap.triangles.rows(), 0);
  EXPECT_LT(seconds(), 30.0);
  if (!test::sanitized) // the sanitizers themselves fail without memory
  {
    options.time_limit = 60.0;
    options.memory_limit = 60;
    status = run_wrap(test::sphere(3), options, wrap);
    EXPECT_EQ(status.code, StatusCode::internal_error);
    EXPECT_THAT(status.message, HasSubstr("memory limit of 60 MiB"));
  }

  options = { 0.004, 0.0004, 60.0, 0 };
  std::vector<double> reported_fractions;
  ExecutionContext context([&](double fraction, const std::string&)
    { reported_fractions.push_back(fraction); },
    [&] { return !reported_fractions.empty() && reported_fractions.back() > 0.0; });
  const TriangleMesh sphere = test::sphere(3);
  status =
    wrap_surface(context, sphere.points, sphere.triangles, options, wrap.points, wrap.triangles);
  EXPECT_EQ(status.code, StatusCode::canceled) << "at the first sign of progress";
  EXPECT_FALSE(reported_fractions.empty());
  EXPECT_LT(seconds(), 120.0);
}

TEST(WrapSurfaceInput, BadInputIsOneSentence)
{
  TriangleMesh wrap;
  const auto message = [&](const TriangleMesh& mesh, const WrapOptions& options = {})
  {
    const Status status = run_wrap(mesh, options, wrap);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    EXPECT_EQ(wrap.triangles.rows(), 0);
    return status.message;
  };
  TriangleMesh mesh = test::cube();
  mesh.points(4, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message(mesh), HasSubstr("vertex 4"));
  mesh = test::cube();
  mesh.triangles(5, 1) = 77;
  EXPECT_THAT(message(mesh), HasSubstr("triangle 5"));
  EXPECT_THAT(message({ Points(0, 3), Triangles(0, 3) }), HasSubstr("no triangles"));
  mesh = test::cube();
  mesh.points.setZero();
  EXPECT_THAT(message(mesh), HasSubstr("points of the surface coincide"));
  mesh = test::cube();
  mesh.points *= 1e120;
  EXPECT_THAT(message(mesh), HasSubstr("1e100"));
  EXPECT_THAT(message(test::cube(), { 0.0, 0.001, 1.0, 0 }), HasSubstr("wrap_alpha"));
  EXPECT_THAT(message(test::cube(), { 2.0, 0.001, 1.0, 0 }), HasSubstr("wrap_alpha"));
  EXPECT_THAT(message(test::cube(), { 0.1, 0.0, 1.0, 0 }), HasSubstr("wrap_offset"));
  EXPECT_THAT(message(test::cube(), { 0.1, std::nan(""), 1.0, 0 }), HasSubstr("wrap_offset"));
  EXPECT_THAT(message(test::cube(), { 0.1, 0.001, 0.0, 0 }), HasSubstr("time_limit"));
  EXPECT_THAT(message(test::cube(), { 0.1, 0.001, 1.0, -1 }), HasSubstr("memory_limit"));
}

TEST(WrapSurfaceInput, NeedsTheHelper)
{
  TriangleMesh wrap;
  const Environment none("BINDPOSE_MESHER", "/nowhere");
  EXPECT_EQ(run_wrap(test::cube(), {}, wrap).code, StatusCode::unavailable);
}

TEST(WrapSurfaceInput, AHelperThatGivesTheSurfaceBackIsNotBelieved)
{
  const test::FakeProgram helper("BINDPOSE_MESHER", "cat\n");
  TriangleMesh wrap;
  const Status status = run_wrap(test::open_cube(), {}, wrap);
  EXPECT_EQ(status.code, StatusCode::internal_error);
  EXPECT_THAT(status.message, HasSubstr("not closed"));
  EXPECT_EQ(wrap.triangles.rows(), 0);
}
