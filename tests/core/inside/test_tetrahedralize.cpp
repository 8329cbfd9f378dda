// tetrahedralize() tries several meshing methods, one after the other. The tests cover a missing
// helper program, helper programs that fail or are slow, cancel requests, and bad input.
#include "inside/tetrahedralize.h"

#include "base/number_text.h"

#include "helper/mesher_process.h"
#include "io/medit.h"
#include "tets/tet_quality.h"

#include "core/inside/tet_outcome.h"
#include "support/cancel_later.h"
#include "support/environment.h"
#include "support/meshes.h"
#include "support/stand_in.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

using namespace bindpose;
using test::Environment;
using test::expect_valid;
using test::run;
using Outcome = test::TetOutcome;
using testing::HasSubstr;

// ---- Lattices: no helper -----------------------------------------------------------------------

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
    EXPECT_THAT(automatic.status.warnings.back(), HasSubstr("replaced method cdt"));
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
  // Two spheres at a tiny distance, one of them inside out. Their triangles are unwelded, and one
  // triangle has no area.
  TriangleMesh mesh = test::unwelded(
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

// ---- Programs that fail ------------------------------------------------------------------------

TEST(Tetrahedralize, ABrokenHelperIsLeft)
{
  const test::FakeProgram helper("BINDPOSE_MESHER", "kill -SEGV $$\n");
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
  const test::FakeProgram helper("BINDPOSE_MESHER", "exec sleep 60\n");
  TetrahedralizeOptions options;
  options.time_limit = 0.4;
  options.resolution = 10;
  const Outcome outcome = run(test::sphere(2), options);
  expect_valid(outcome, test::sphere(2));
  EXPECT_EQ(outcome.method(), "remesh");
  EXPECT_THAT(outcome.status.warnings.back(), HasSubstr("time limit"));
  // The distance of the tets' boundary from the surface is less than the side of a lattice cube.
  // Distances are in percent of the bounding-box diagonal.
  EXPECT_GT(outcome.number("distance_max"), 0.0);
  EXPECT_LT(outcome.number("distance_max"), 100.0 / std::sqrt(3.0) / options.resolution);
}

TEST(Tetrahedralize, CancelEndsAtOnce)
{
  const test::FakeProgram helper("BINDPOSE_MESHER", "exec sleep 60\n");
  const TriangleMesh mesh = test::sphere(2);
  ExecutionContext context;
  test::DelayedCancel canceler(context, 500);
  TetrahedralizeResult result;
  const Status status = tetrahedralize(context, mesh.points, mesh.triangles, {}, result);
  const double seconds_since_cancel = canceler.seconds_since_cancel();
  EXPECT_EQ(status.code, StatusCode::canceled);
  EXPECT_LT(seconds_since_cancel, 0.2);
  EXPECT_EQ(result.mesh.tets.rows(), 0);
}

TEST(Tetrahedralize, FtetwildIsJudgedLikeAnyOther)
{
  // The script returns the cube in fTetWild's frame for every input.
  const test::FakeProgram program("BINDPOSE_FTETWILD",
    "while [ \"$1\" != --output ]; do shift; done\ncp \"$(dirname \"$0\")/tets.mesh\" \"$2\"\n");
  const TetMesh box = test::tet_box(2, 2, 2, Vec3::Constant(-0.5), Vec3::Constant(0.5));
  ASSERT_TRUE(
    write_medit(program.folder() / "tets.mesh", box.points, Triangles(0, 3), box.tets).ok());
  const Outcome right = run(test::cube(), TetMethod::ftetwild);
  expect_valid(right, test::cube());
  EXPECT_EQ(right.method(), "ftetwild");
  EXPECT_NEAR(right.volume(), 8.0, 1e-12);
  EXPECT_NEAR(right.number("distance_max"), 0.0, 1e-12);
  EXPECT_EQ(right.number("counts.kept_vertices"), 0.0);
  EXPECT_TRUE(right.status.warnings.empty());
  // The returned cube has 1.4 times the volume of this box. The cube is accepted with a warning,
  // and its distance from the box is reported.
  TriangleMesh longer = test::cube();
  longer.points.col(0) *= 1.0 / 1.4;
  const Outcome off = run(longer, TetMethod::ftetwild);
  expect_valid(off, longer);
  ASSERT_EQ(off.status.warnings.size(), 1u);
  EXPECT_THAT(
    off.status.warnings[0], HasSubstr("is 140 % of the enclosed volume by winding number"));
  EXPECT_GT(off.number("distance_max"), 5.0);
  // The returned cube has five times the volume of this box. There is no result, because only a
  // factor of up to 2 is accepted.
  TriangleMesh thin = test::cube();
  thin.points.col(0) *= 0.2;
  const Outcome wrong = run(thin, TetMethod::ftetwild);
  EXPECT_EQ(wrong.status.code, StatusCode::internal_error);
  EXPECT_EQ(wrong.result.mesh.tets.rows(), 0);
  // fTetWild uses its own criterion for inside and outside, so the threshold cannot be set.
  TetrahedralizeOptions options;
  options.method = TetMethod::ftetwild;
  options.winding_threshold = 0.7;
  EXPECT_THAT(run(test::cube(), options).status.message, HasSubstr("winding_threshold"));
  const Environment none("BINDPOSE_FTETWILD", "/nowhere");
  EXPECT_EQ(run(test::cube(), TetMethod::ftetwild).status.code, StatusCode::unavailable);
}

// ---- Bad input ---------------------------------------------------------------------------------

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
  TriangleMesh far_apart = triangle; // two distant triangles
  far_apart = test::join(far_apart, test::translated(triangle, Vec3(0.1, 0.2, 9.0)));
  const TriangleMesh both_ways = test::join(test::grid(1, 1), test::flipped(test::grid(1, 1)));
  struct Case
  {
    TriangleMesh mesh;
    const char* words;
  };
  for (const Case& c :
    { Case{ { Points(0, 3), Triangles(0, 3) }, "no triangles" }, Case{ nan, "vertex 4" },
      Case{ ids, "triangle 5" }, Case{ triangle, "flat" }, Case{ test::grid(4, 3), "flat" },
      Case{ needle, "all triangles of the surface have area 0" },
      Case{ far_apart, "encloses nothing" }, Case{ both_ways, "flat" } })
  {
    SCOPED_TRACE(c.words);
    const Outcome outcome = run(c.mesh);
    EXPECT_EQ(outcome.status.code, StatusCode::invalid_input);
    EXPECT_THAT(outcome.status.message, HasSubstr(c.words));
    EXPECT_EQ(outcome.status.message.find('\n'), std::string::npos);
    EXPECT_EQ(outcome.result.mesh.tets.rows(), 0);
  }
}

TEST(Tetrahedralize, TheBacksOfTrianglesAreLeftOut)
{
  // Every triangle occurs once in each orientation. In one case the inward triangles are first.
  const TriangleMesh ball = test::sphere(3);
  for (const TriangleMesh& mesh :
    { test::join(ball, test::flipped(ball)), test::join(test::flipped(ball), ball),
      test::join(ball, test::flipped(test::unwelded(ball))) })
  {
    const Outcome one_sided = run(ball);
    const Outcome two_sided = run(mesh);
    expect_valid(two_sided, mesh);
    EXPECT_EQ(two_sided.method(), one_sided.method());
    EXPECT_NEAR(two_sided.volume(), one_sided.volume(), 0.02 * one_sided.volume());
    EXPECT_EQ(two_sided.number("counts.back_triangles"), ball.triangles.rows());
    EXPECT_EQ(two_sided.number("counts.duplicate_triangles"), ball.triangles.rows());
    EXPECT_THAT(
      two_sided.status.warnings, testing::Contains(HasSubstr("the back sides of other triangles")));
  }
}

TEST(Tetrahedralize, LooseTrianglesThatEncloseOnlySpecksAreNamed)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> along(0.0, 1.0);
  std::normal_distribution<double> beside(0.0, 0.01);
  TriangleMesh loose{ Points(36000, 3), Triangles(12000, 3) };
  for (Index t = 0; t < loose.triangles.rows(); ++t)
  {
    const Vec3 center(along(random), along(random), along(random));
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 offset(beside(random), beside(random), beside(random));
      loose.points.row(3 * t + k) = center + offset;
      loose.triangles(t, k) = 3 * t + k;
    }
  }
  const Outcome outcome = run(loose);
  EXPECT_EQ(outcome.status.code, StatusCode::invalid_input);
  EXPECT_THAT(outcome.status.message,
    HasSubstr("12000 mostly disconnected triangles that enclose only about"));
  EXPECT_THAT(outcome.status.message, HasSubstr("--method embed"));
  // A sphere whose triangles are separated by tiny gaps still encloses a ball.
  TriangleMesh ball = test::unwelded(test::sphere(5));
  ASSERT_GT(ball.triangles.rows(), 10000);
  for (double& x : ball.points.reshaped())
  {
    x += 1e-6 * beside(random);
  }
  TetrahedralizeOptions options;
  options.method = TetMethod::automatic;
  options.resolution = 20;
  const Environment no_helper("BINDPOSE_MESHER", "/nowhere");
  EXPECT_TRUE(run(ball, options).status.usable());
}

TEST(Tetrahedralize, AThresholdNothingReachesIsSaidAtOnce)
{
  // The winding number in the cube is 1, below the threshold. No attempt can succeed, so the error
  // must be reported after the first attempt.
  TetrahedralizeOptions options;
  options.winding_threshold = 1.5;
  for (const TetMethod method : { TetMethod::cdt, TetMethod::automatic, TetMethod::remesh })
  {
    SCOPED_TRACE(to_string(method));
    if (method == TetMethod::cdt && find_mesher().empty())
    {
      continue; // method cdt is not available
    }
    options.method = method;
    const Outcome outcome = run(test::cube(), options);
    EXPECT_EQ(outcome.status.code, StatusCode::invalid_input);
    EXPECT_THAT(
      outcome.status.message, HasSubstr("largest winding number is 1, below the threshold of 1.5"));
    const Report::Value* attempt_names = outcome.status.report.find("rungs[].name");
    if (method == TetMethod::cdt)
    {
      ASSERT_NE(attempt_names, nullptr);
      EXPECT_EQ(std::get<std::vector<std::string>>(*attempt_names).size(), 1U);
    }
  }
  if (find_mesher().empty())
  {
    return;
  }
  // The two cubes of side 2 overlap in a cube of side 1. The winding number is 2 in this overlap,
  // above the threshold 1.5, and at most 1 elsewhere.
  const TriangleMesh two = test::join(test::cube(), test::translated(test::cube(), Vec3(1, 1, 1)));
  options.method = TetMethod::cdt;
  const Outcome overlap = run(two, options);
  EXPECT_TRUE(overlap.status.usable()) << overlap.status.message;
  EXPECT_NEAR(overlap.volume(), 1.0, 1e-12);
}

TEST(Tetrahedralize, WhatIsTooThinForRemeshIsSaid)
{
  TriangleMesh needle = test::sphere(2);
  needle.points.col(2) *= 1e4; // the volume is 52 % of the bounding box's
  TetrahedralizeOptions options;
  options.method = TetMethod::remesh;
  const Outcome outcome = run(needle, options);
  EXPECT_EQ(outcome.status.code, StatusCode::unavailable);
  const double percentage = 100.0 * signed_volume(needle.points, needle.triangles) /
    bounding_box(needle.points).size().prod();
  EXPECT_THAT(outcome.status.message,
    HasSubstr("encloses about " + short_number(percentage, 3) +
      " % of its bounding box, but this region is too thin"));
  EXPECT_THAT(outcome.status.message, HasSubstr("--method cdt"));
  EXPECT_THAT(outcome.status.message, HasSubstr("above 40 (--resolution)"));
  if (!find_mesher().empty())
  {
    options.method = TetMethod::automatic;
    EXPECT_TRUE(run(needle, options).status.ok());
  }
}

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
  EXPECT_THAT(message([](auto& o) { o.quality = 21.0; }), HasSubstr("quality"));
  EXPECT_THAT(message([](auto& o) { o.bare = true, o.quality = 5.0; }), HasSubstr("bare"));
  EXPECT_THAT(message([](auto& o) { o.bare = true, o.interior_edge = 0.1; }), HasSubstr("bare"));
  EXPECT_THAT(message([](auto& o) { o.interior_edge = -0.1; }), HasSubstr("interior_edge"));
  EXPECT_THAT(message([](auto& o) { o.cut_smoothness = -1.0; }), HasSubstr("cut_smoothness"));
  EXPECT_THAT(message([](auto& o) { o.cut_sigma = 0.0; }), HasSubstr("cut_sigma"));
}
