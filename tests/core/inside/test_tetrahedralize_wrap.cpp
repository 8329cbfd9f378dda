// Method wrap: tets that fill an alpha wrap. They contain the surface, even if the surface is open
// or crosses itself.
#include "inside/tetrahedralize.h"

#include "base/number_text.h"
#include "surface/triangle_tree.h"
#include "winding/winding_number.h"

#include "core/inside/tet_outcome.h"
#include "support/environment.h"
#include "support/meshes.h"
#include "support/needs_mesher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace bindpose;
using test::Environment;
using test::expect_valid;
using test::handle_elements_of;
using test::run;
using Outcome = test::TetOutcome;
using testing::HasSubstr;

namespace
{
class Wrap : public test::MesherTest
{
};

/// Expect that every vertex and triangle center of the surface is in a tet or on the boundary of
/// the tets.
void expect_wrap_contains(const TetMesh& mesh, const TriangleMesh& surface)
{
  ExecutionContext context;
  WindingNumber winding;
  const Triangles skin = boundary_triangles(mesh.tets);
  ASSERT_TRUE(winding.build(context, mesh.points, skin).ok());
  const TriangleTree tree(mesh.points, skin);
  const double near = 1e-14 * bounding_box(surface.points, surface.triangles).diagonal();
  const auto is_contained = [&](const Vec3& p)
  { return std::abs(winding.evaluate_exactly_at(p) - 1.0) < 1e-6 || tree.distance(p, 1e9) < near; };
  for (Index f = 0; f < surface.triangles.rows(); ++f)
  {
    Vec3 center = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 p = surface.points.row(surface.triangles(f, k));
      EXPECT_TRUE(is_contained(p)) << f;
      center += p / 3.0;
    }
    EXPECT_TRUE(is_contained(center)) << f;
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
    double enclosed; ///< volume where the winding number is at least 0.5
    const char* warning; ///< empty if no warning is expected
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
         Case{ "doubled both ways", test::join(test::cube(), test::flipped(test::cube())), 1, 8.0,
           "the back sides of other triangles" },
         Case{ "unwelded", test::unwelded(test::cube()), 1, 8.0, "" } })
  {
    SCOPED_TRACE(c.name);
    const Outcome outcome = run(c.mesh, options);
    expect_valid(outcome, c.mesh);
    EXPECT_EQ(outcome.method(), "wrap");
    expect_wrap_contains(outcome.result.mesh, c.mesh);
    EXPECT_EQ(test::euler_characteristic(outcome.result.mesh), c.characteristic);
    EXPECT_EQ(outcome.number("counts.kept_vertices"), 0.0);
    EXPECT_EQ(outcome.result.original_vertices.front(), -1);
    EXPECT_NEAR(outcome.number("winding_volume"), c.enclosed, 0.01 * c.enclosed);
    // The distance of the tets' boundary from the surface is about `wrap_offset`. In concave
    // corners it is larger, because the alpha ball does not fit into the corner.
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

TEST_F(Wrap, AnOpenSurfaceIsWarnedOfWithItsVolume)
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
  EXPECT_NEAR(outcome.number("winding_volume"), 8.0, 0.08);
  EXPECT_THAT(warning,
    HasSubstr("the volume of the tets is " +
      short_number(100.0 * outcome.volume() / outcome.number("winding_volume"), 3) + " % of"));
  // The tets fill a shell around the five faces of the open cube. Each face has the area 4, and the
  // thickness of the shell is twice the offset. Fillets are added along the eight inner edges of
  // length 2, because the alpha ball does not fit into these edges. The cross section of a fillet
  // has less area than a square of side alpha + offset.
  const double diagonal = std::sqrt(12.0);
  const double shell = 20.0 * 2.0 * options.wrap_offset * diagonal;
  const double fillets = 16.0 * std::pow((options.wrap_alpha + options.wrap_offset) * diagonal, 2);
  EXPECT_GT(outcome.volume(), 0.97 * shell);
  EXPECT_LT(outcome.volume(), 1.1 * shell + fillets);
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
  options.bare = true;
  const Outcome none = run(test::sphere(2), options);
  options.bare = false;
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
  options.handles = handle_elements_of({ Vec3(0.1, 0.2, 0.3), Vec3(2, 0, 0) });
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
