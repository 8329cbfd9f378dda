// The process of the helper program bindpose-mesher: its results, and the cleanup after a failure.
#include "helper/mesher_process.h"

#include "surface/triangle_tree.h"
#include "tets/tet_quality.h"

#include "support/cancel_later.h"
#include "support/environment.h"
#include "support/meshes.h"
#include "support/needs_mesher.h"
#include "support/sanitized.h"
#include "support/watched_stand_in.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include <sys/mman.h>
#include <unistd.h>

using namespace bindpose;
using test::Environment;
using testing::HasSubstr;

namespace
{
/// Replaces the helper program by a shell script.
class FakeHelper : public test::WatchedFakeProgram
{
public:
  explicit FakeHelper(const std::string& script) : WatchedFakeProgram("BINDPOSE_MESHER", script) {}

  Status run(double time_limit = 10.0, ExecutionContext* context = nullptr)
  {
    ExecutionContext own;
    MesherRequest request{ { "refine" }, time_limit, 0 };
    MesherData input;
    input.points = test::cube().points;
    input.triangles = test::cube().triangles;
    return run_mesher(context ? *context : own, request, input, this->answer);
  }

  MesherResult answer;
};

constexpr const char* write_process = "echo $$ > \"$(dirname \"$0\")/pid\"\n";

double seconds_since(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Status run_real(
  const std::vector<std::string>& arguments, const TriangleMesh& mesh, MesherResult& answer)
{
  ExecutionContext context;
  MesherData input;
  input.points = mesh.points;
  input.triangles = mesh.triangles;
  return run_mesher(context, { arguments, 60.0, 0 }, input, answer);
}
} // namespace

TEST(MesherProcess, MissingHelperNamesItsPackages)
{
  ExecutionContext context;
  MesherResult answer;
  {
    const Environment helper("BINDPOSE_MESHER", "/nowhere/bindpose-mesher");
    EXPECT_TRUE(find_mesher().empty());
    const Status status = run_mesher(context, { { "refine" }, 1.0, 0 }, {}, answer);
    EXPECT_EQ(status.code, StatusCode::unavailable);
    EXPECT_THAT(status.message, HasSubstr("/nowhere/bindpose-mesher"));
  }
  if (find_mesher().empty())
  {
    const Status status = run_mesher(context, { { "refine" }, 1.0, 0 }, {}, answer);
    EXPECT_EQ(status.code, StatusCode::unavailable);
    EXPECT_THAT(status.message, HasSubstr("libcgal-dev"));
    EXPECT_THAT(status.message, HasSubstr("libtet1.5-dev"));
  }
}

TEST(MesherProcess, CopiesThroughAnHonestHelper)
{
  // This fake helper returns its input record unchanged.
  FakeHelper helper("echo progress 0.5 >&2; echo report rounds 3 >&2; cat");
  const Status status = helper.run();
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(helper.answer.data.points, test::cube().points);
  EXPECT_EQ(helper.answer.data.triangles, test::cube().triangles);
  EXPECT_EQ(helper.answer.report.number("rounds", 0), 3.0);
}

TEST(MesherProcess, ProgressReachesTheContext)
{
  std::vector<double> seen;
  ExecutionContext context(
    [&](double fraction, const std::string&) { seen.push_back(fraction); }, {});
  FakeHelper helper("sleep 0.1; echo progress 0.25 >&2; sleep 0.1; echo progress 0.75 >&2; cat");
  EXPECT_TRUE(helper.run(10.0, &context).ok());
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_DOUBLE_EQ(seen[0], 0.25);
  EXPECT_DOUBLE_EQ(seen[1], 0.75);
}

TEST(MesherProcess, DeathIsAStatus)
{
  FakeHelper helper("echo 'last words' >&2; kill -SEGV $$");
  const Status status = helper.run();
  EXPECT_EQ(status.code, StatusCode::internal_error);
  EXPECT_THAT(status.message, HasSubstr("signal 11"));
  EXPECT_THAT(status.message, HasSubstr("last words"));
  FakeHelper killed("kill -KILL $$");
  EXPECT_THAT(killed.run().message, HasSubstr("signal 9"));
}

TEST(MesherProcess, ErrorsAreTheHelpersOwnWords)
{
  FakeHelper helper("echo 'error too many pieces' >&2; exit 1");
  EXPECT_THAT(helper.run().message, HasSubstr("too many pieces"));
  FakeHelper silent("exit 7");
  EXPECT_THAT(silent.run().message, HasSubstr("code 7"));
}

TEST(MesherProcess, GarbageIsNoMesh)
{
  for (const char* script : { "echo garbage", "true", "head -c 40", "cat; echo more",
         "head -c 100; head -c 100000 /dev/zero" })
  {
    FakeHelper helper(script);
    const Status status = helper.run();
    EXPECT_EQ(status.code, StatusCode::internal_error) << script;
    EXPECT_THAT(status.message, HasSubstr("did not write a valid mesh")) << script;
  }
}

TEST(MesherProcess, RecordsAreChecked)
{
  const auto round_trips = [](const MesherData& data)
  {
    const int file = ::memfd_create("test", 0);
    EXPECT_TRUE(write_mesher_data(file, data));
    ::lseek(file, 0, SEEK_SET);
    MesherData back;
    const bool whole = read_mesher_data(file, back);
    ::close(file);
    return whole && back.points == data.points && back.tets == data.tets &&
      back.regions == data.regions;
  };
  MesherData data;
  EXPECT_TRUE(round_trips(data));
  const TetMesh box = test::tet_box(2, 2, 2);
  data.points = box.points;
  data.tets = box.tets;
  data.regions.assign(static_cast<std::size_t>(box.tets.rows()), 4);
  EXPECT_TRUE(round_trips(data));
  data.tets(3, 2) = box.points.rows();
  EXPECT_FALSE(round_trips(data)) << "an id out of range";
  data.tets = box.tets;
  data.points(5, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(round_trips(data)) << "not a number";
  data.points = box.points;
  data.regions.pop_back();
  EXPECT_FALSE(round_trips(data)) << "one region too few";
}

TEST(MesherProcess, TimeLimitKillsTheHelper)
{
  FakeHelper helper(std::string(write_process) + "exec sleep 60");
  const auto start = std::chrono::steady_clock::now();
  const Status status = helper.run(0.3);
  EXPECT_LT(seconds_since(start), 5.0);
  EXPECT_EQ(status.code, StatusCode::internal_error);
  EXPECT_THAT(status.message, HasSubstr("time limit of 0.3 s"));
  ASSERT_GT(helper.process(), 0);
  EXPECT_NE(::kill(helper.process(), 0), 0) << "still running";
}

TEST(MesherProcess, CancelKillsTheHelperAtOnce)
{
  FakeHelper helper(std::string(write_process) + "exec sleep 60");
  ExecutionContext context;
  test::DelayedCancel canceler(context, 300);
  const Status status = helper.run(60.0, &context);
  const double seconds_since_cancel = canceler.seconds_since_cancel();
  EXPECT_EQ(status.code, StatusCode::canceled);
  EXPECT_LT(seconds_since_cancel, 0.2);
  ASSERT_GT(helper.process(), 0);
  EXPECT_NE(::kill(helper.process(), 0), 0) << "still running";
  // A run that is canceled before it starts does not start the helper.
  EXPECT_EQ(helper.run(60.0, &context).code, StatusCode::canceled);
}

TEST(MesherProcess, ADetachedGrandchildDoesNotHang)
{
  FakeHelper helper("(sleep 3) & cat");
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(helper.run().ok());
  EXPECT_LT(seconds_since(start), 2.5);
}

// ---- The real helper program ------------------------------------------------------------------

class RealHelper : public test::MesherTest
{
};

TEST_F(RealHelper, RefinesUntilNothingCrosses)
{
  const TriangleMesh two = test::join(test::sphere(2), test::sphere(2, 1.0, Vec3(0.7, 0.31, 0.17)));
  const TriangleMesh open =
    test::join(test::open_cube(), test::translated(test::open_cube(), Vec3(0.5, 0.25, 0.125)));
  const TriangleMesh coplanar =
    test::join(test::cube(), test::translated(test::cube(), Vec3(1, 1, 0)));
  for (const TriangleMesh& mesh : { two, open, coplanar })
  {
    MesherResult answer;
    const Status status = run_real({ "refine" }, mesh, answer);
    ASSERT_TRUE(status.ok()) << status.message;
    const MesherData& refined = answer.data;
    EXPECT_GT(refined.triangles.rows(), mesh.triangles.rows());
    EXPECT_EQ(refined.points.topRows(mesh.points.rows()), mesh.points) << "vertices keep their ids";
    // Check the results with the exact predicates of Bindpose. Before the refinement, the number of
    // crossing pairs of triangles equals the number that CGAL reports. After the refinement no
    // triangles cross.
    ExecutionContext context;
    std::vector<std::pair<Index, Index>> pairs;
    ASSERT_TRUE(crossing_pairs(context, refined.points, refined.triangles, pairs));
    EXPECT_EQ(pairs.size(), 0u);
    ASSERT_TRUE(crossing_pairs(context, mesh.points, mesh.triangles, pairs));
    EXPECT_EQ(answer.report.number("counts.self_intersections", -1), pairs.size());
    EXPECT_FALSE(
      count_edges(refined.triangles).boundary > count_edges(mesh.triangles).boundary + 60);
  }
  MesherResult answer;
  ASSERT_TRUE(run_real({ "refine" }, two, answer).ok());
  // No triangles overlap in one plane, so refinement only cuts triangles. The area and the volume
  // must not change.
  EXPECT_NEAR(surface_area(answer.data.points, answer.data.triangles),
    surface_area(two.points, two.triangles), 1e-12);
  EXPECT_NEAR(signed_volume(answer.data.points, answer.data.triangles),
    signed_volume(two.points, two.triangles), 1e-12);
}

TEST_F(RealHelper, AFewTrianglesMayFallIntoManyPieces)
{
  // There are 14 squares perpendicular to each axis. Each square is cut into 15 x 15 parts by the
  // squares perpendicular to the other axes.
  constexpr int count = 14;
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int k = 0; k < count; ++k)
    {
      TriangleMesh square = test::grid(1, 1);
      square.points.col(2).setConstant((k + 1.0) / 32.0);
      for (Index v = 0; v < 4; ++v)
      {
        const Vec3 p = square.points.row(v);
        square.points.row(v) << p[(axis + 2) % 3], p[axis], p[(axis + 1) % 3];
      }
      mesh = test::join(mesh, square);
    }
  }
  MesherResult answer;
  const Status status = run_real({ "refine" }, mesh, answer);
  ASSERT_TRUE(status.ok()) << status.message;
  const MesherData& refined = answer.data;
  EXPECT_GE(refined.triangles.rows(), 3 * count * 2 * (count + 1) * (count + 1));
  EXPECT_NEAR(surface_area(refined.points, refined.triangles), 3.0 * count, 1e-9);
  ExecutionContext context;
  std::vector<std::pair<Index, Index>> pairs;
  ASSERT_TRUE(crossing_pairs(context, refined.points, refined.triangles, pairs));
  EXPECT_EQ(pairs.size(), 0u);
}

TEST_F(RealHelper, SheetsThatNearlyCoincideAreRounded)
{
  // The second surface is a copy of the sphere that was rotated and then rotated back. Some
  // vertices differ from the original by one ulp, so triangles cross at tiny angles.
  const TriangleMesh sphere = test::sphere(4);
  TriangleMesh twin = sphere;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).matrix();
  twin.points = (twin.points * turn) * turn.transpose();
  const TriangleMesh both = test::join(sphere, twin);
  MesherResult answer;
  const Status status = run_real({ "refine" }, both, answer);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(answer.report.number("rounded", 0.0), 1.0);
  ASSERT_GE(answer.data.points.rows(), both.points.rows());
  EXPECT_LT(
    (answer.data.points.topRows(both.points.rows()) - both.points).cwiseAbs().maxCoeff(), 1e-12);
  ExecutionContext context;
  std::vector<std::pair<Index, Index>> pairs;
  ASSERT_TRUE(crossing_pairs(context, answer.data.points, answer.data.triangles, pairs));
  EXPECT_TRUE(pairs.empty());
}

TEST_F(RealHelper, CleanSurfacesAreLeftAlone)
{
  MesherResult answer;
  ASSERT_TRUE(run_real({ "refine" }, test::torus(12, 8, 1.0, 0.4), answer).ok());
  EXPECT_EQ(answer.data.points, test::torus(12, 8, 1.0, 0.4).points);
  EXPECT_EQ(answer.data.triangles, test::torus(12, 8, 1.0, 0.4).triangles);
}

TEST_F(RealHelper, FillsACube)
{
  for (const std::vector<std::string>& job :
    { std::vector<std::string>{ "tetgen", "--switches", "pYA" },
      std::vector<std::string>{ "delaunay" } })
  {
    MesherResult answer;
    const Status status = run_real(job, test::cube(), answer);
    ASSERT_TRUE(status.ok()) << status.message;
    EXPECT_NEAR(tet_volumes(answer.data.points, answer.data.tets).sum(), 8.0, 1e-14);
    EXPECT_TRUE(check_tets(answer.data.points, answer.data.tets).ok());
  }
}

TEST_F(RealHelper, WhatCrashesTetgenIsAStatus)
{
  // These two surfaces cross and were not refined.
  TriangleMesh mesh = test::join(test::sphere(2), test::sphere(2, 1.0, Vec3(0.7, 0.31, 0.17)));
  MesherResult answer;
  EXPECT_EQ(
    run_real({ "tetgen", "--switches", "pY" }, mesh, answer).code, StatusCode::internal_error);
  // An open surface has no tets.
  EXPECT_FALSE(run_real({ "tetgen", "--switches", "pY" }, test::open_cube(), answer).ok());
  EXPECT_FALSE(run_real({ "delaunay" }, test::grid(2, 2), answer).ok());
  EXPECT_THAT(run_real({ "dance" }, mesh, answer).message, HasSubstr("unknown job"));
}

// TetGen is stopped after a given amount of work, not after a given time. The result therefore does
// not depend on the speed of the machine.
TEST_F(RealHelper, WorkLimitStopsTetgen)
{
  const TriangleMesh mesh = test::sphere(3);
  const std::vector<std::string> job = { "tetgen", "--switches", "pYA" };
  MesherResult first, second, limited, enough;
  ASSERT_TRUE(run_real(job, mesh, first).ok());
  ASSERT_TRUE(run_real(job, mesh, second).ok());
  const double work = first.report.number("work", 0.0);
  if (work == 0.0)
  {
    GTEST_SKIP() << "TetGen is a static library, whose work is not counted";
  }
  EXPECT_GT(work, mesh.triangles.rows());
  EXPECT_EQ(second.report.number("work", 0.0), work);

  const auto with_limit = [&](double limit)
  {
    std::vector<std::string> arguments = job;
    arguments.insert(arguments.end(), { "--work", std::to_string(limit) });
    return arguments;
  };
  const Status stopped = run_real(with_limit(work - 1.0), mesh, limited);
  EXPECT_EQ(stopped.code, StatusCode::internal_error);
  EXPECT_THAT(stopped.message, HasSubstr("evaluations of its predicates"));
  EXPECT_EQ(limited.report.number("work_limit_reached", 0.0), 1.0);

  ASSERT_TRUE(run_real(with_limit(work), mesh, enough).ok());
  EXPECT_EQ(enough.data.tets, first.data.tets);
}

TEST_F(RealHelper, MemoryLimitIsKept)
{
  if (test::sanitized)
  {
    return; // the address sanitizer reserves more memory than the limit
  }
  ExecutionContext context;
  MesherData input;
  const TriangleMesh mesh = test::sphere(6);
  input.points = mesh.points;
  input.triangles = mesh.triangles;
  MesherResult answer;
  const Status status = run_mesher(context, { { "refine" }, 60.0, 24 }, input, answer);
  EXPECT_EQ(status.code, StatusCode::internal_error);
  EXPECT_THAT(status.message, HasSubstr("memory limit of 24 MiB"));
}
