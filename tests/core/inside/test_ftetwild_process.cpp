// The adapter to the program fTetWild. The tests replace fTetWild by a script that takes the same
// arguments. If fTetWild is installed, one test runs it.
#include "inside/ftetwild_process.h"

#include "helper/child_process.h"
#include "helper/scratch_folder.h"
#include "io/off.h"
#include "tets/tet_quality.h"

#include "support/cancel_later.h"
#include "support/environment.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/processes.h"
#include "support/watched_stand_in.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <limits>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace bindpose;
using test::Environment;
using test::has_exited;
using test::open_descriptors;
using test::wait_until;
using testing::HasSubstr;

namespace
{
/// Parses the options in the same way as fTetWild.
constexpr const char* parse_arguments = R"(
here=$(dirname "$0")
printf '%s\n' "$*" > "$here/arguments"
echo $$ > "$here/pid"
while [ $# -gt 0 ]; do
  case "$1" in
    -i|--input) input=$2; shift 2;;
    -o|--output) output=$2; shift 2;;
    -e|--epsr|-l|--lr|--level|--max-threads) shift 2;;
    -q|--no-binary|--no-color) shift;;
    *) echo "The following argument was not expected: $1" >&2; exit 109;;
  esac
done
[ -f "$input" ] || { echo "--input: File does not exist: $input" >&2; exit 105; }
cp "$input" "$here/input.off"
echo scratch > "${output}_sf.obj"
)";

/// Return the tets of the cube in the normalized frame of fTetWild, in the format of its
/// MeshIO.cpp, with an unused vertex.
std::string cube_in_medit_format()
{
  const TetMesh box = test::tet_box(2, 2, 2, Vec3::Constant(-0.5), Vec3::Constant(0.5));
  std::ostringstream text;
  text.precision(16);
  text << "MeshVersionFormatted 1\nDimension 3\nVertices\n" << box.points.rows() + 1 << "\n";
  for (Index v = 0; v < box.points.rows(); ++v)
  {
    text << box.points(v, 0) << " " << box.points(v, 1) << " " << box.points(v, 2) << " 0\n";
  }
  text << "3 3 3 0\nTriangles\n0\nTetrahedra\n" << box.tets.rows() << "\n";
  for (Index t = 0; t < box.tets.rows(); ++t)
  {
    for (const int k : { 0, 1, 3, 2 })
    {
      text << box.tets(t, k) + 1 << " ";
    }
    text << "0\n";
  }
  text << "End";
  return text.str();
}

/// Replaces fTetWild by a script.
class FakeFtetwild : public test::WatchedFakeProgram
{
public:
  explicit FakeFtetwild(const std::string& script)
    : WatchedFakeProgram("BINDPOSE_FTETWILD", parse_arguments + script)
  {
    this->folder().write("tets.mesh", cube_in_medit_format());
  }

  Status run(const TriangleMesh& surface, const FtetwildOptions& options = {},
    ExecutionContext* context = nullptr)
  {
    ExecutionContext own;
    return run_ftetwild(
      context ? *context : own, surface.points, surface.triangles, options, this->mesh);
  }
  std::string file(const std::string& name) const { return this->folder() / name; }
  std::string arguments() const { return this->folder().read("arguments"); }

  TetMesh mesh;
};

constexpr const char* copy_cube_script = "cp \"$here/tets.mesh\" \"$output\"\n";
} // namespace

TEST(Ftetwild, SurfacesGoAndTetsComeInTheirOwnPlace)
{
  FakeFtetwild fake(copy_cube_script);
  const Vec3 at(1000.0, -20.0, 3.0);
  const TriangleMesh cube = test::translated(test::cube(), at);
  const Status status = fake.run(cube, { 0.001953125, 0.03125, 10.0, 0 });
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(fake.mesh.points.rows(), 27) << "without the stray vertex";
  EXPECT_EQ(fake.mesh.tets.rows(), 48);
  EXPECT_TRUE(check_tets(fake.mesh.points, fake.mesh.tets).ok());
  EXPECT_NEAR(tet_volumes(fake.mesh.points, fake.mesh.tets).sum(), 8.0, 1e-12);
  EXPECT_EQ(bounding_box(fake.mesh.points).lower, Vec3(at - Vec3::Ones()));
  EXPECT_EQ(bounding_box(fake.mesh.points).upper, Vec3(at + Vec3::Ones()));
  // The script gets the same triangles, translated to the origin.
  PolygonMesh given;
  ASSERT_TRUE(read_off(fake.file("input.off"), given).ok());
  EXPECT_EQ(given.points, test::cube(-0.5, 0.5).points);
  EXPECT_EQ(fan_triangles(given), cube.triangles);
  const std::string arguments = fake.arguments();
  EXPECT_THAT(arguments, HasSubstr("--epsr 0.001953125"));
  EXPECT_THAT(arguments, HasSubstr("--lr 0.03125"));
  EXPECT_THAT(arguments, Not(HasSubstr("--max-threads")));
  EXPECT_THAT(arguments, HasSubstr("tets.mesh"));
  ExecutionContext context;
  context.set_threads(3);
  ASSERT_TRUE(fake.run(cube, {}, &context).ok());
  EXPECT_THAT(fake.arguments(), HasSubstr("--max-threads 3"));
  EXPECT_THAT(fake.arguments(), Not(HasSubstr("--lr"))) << "its own edge length";
}

TEST(Ftetwild, ItsStagesAreProgress)
{
  std::vector<double> reported_fractions;
  ExecutionContext context(
    [&](double fraction, const std::string&) { reported_fractions.push_back(fraction); }, {});
  FakeFtetwild fake(std::string("sleep 0.1; echo '[float-tetwild] [info] preprocessing 0.1s'; "
                                "sleep 0.1; echo '[float-tetwild] [info] mesh optimization 2s'\n") +
    copy_cube_script);
  ASSERT_TRUE(fake.run(test::cube(), {}, &context).ok());
  EXPECT_THAT(reported_fractions, testing::ElementsAre(0.1, 0.9));
}

TEST(Ftetwild, IsFoundOnThePath)
{
  test::Folder folder;
  const Environment none("BINDPOSE_FTETWILD", std::nullopt);
  const Environment path("PATH", "/nowhere:" + folder.path());
  ExecutionContext context;
  TetMesh mesh;
  const TriangleMesh cube = test::cube();
  std::filesystem::create_directory(folder / "FloatTetwild_bin"); // a folder is not a program
  EXPECT_EQ(find_ftetwild(), "");
  const Status status = run_ftetwild(context, cube.points, cube.triangles, {}, mesh);
  EXPECT_EQ(status.code, StatusCode::unavailable);
  EXPECT_THAT(status.message, HasSubstr("FloatTetwild_bin"));
  EXPECT_THAT(status.message, HasSubstr("https://github.com/wildmeshing/fTetWild"));
  folder.write("ftetwild", "#!/bin/sh\n");
  EXPECT_EQ(find_ftetwild(), "") << "may not be executed";
  ::chmod((folder / "ftetwild").c_str(), 0755);
  EXPECT_EQ(find_ftetwild(), folder / "ftetwild");
  const Environment chosen("BINDPOSE_FTETWILD", "/nowhere/ftetwild");
  EXPECT_EQ(find_ftetwild(), "") << "the variable alone counts";
  EXPECT_THAT(run_ftetwild(context, cube.points, cube.triangles, {}, mesh).message,
    HasSubstr("/nowhere/ftetwild"));
}

TEST(Ftetwild, WhateverItDoesIsAStatusAndNothingIsLeft)
{
  struct Case
  {
    const char* script;
    const char* words;
  };
  for (const Case& c :
    { Case{ "echo last words; kill -SEGV $$", "signal 11" },
      Case{ "echo last words; kill -SEGV $$", "last words" },
      Case{ "echo 'terminate called: std::bad_alloc' >&2; kill -ABRT $$", "bad_alloc" },
      Case{ "exit 1", "failed with exit code 1" }, Case{ "exit 0", "did not write a valid mesh" },
      Case{ "echo garbage > \"$output\"", "did not write a valid mesh" },
      Case{ "head -c 700 \"$here/tets.mesh\" > \"$output\"", "did not write a valid mesh" },
      Case{ "sed 's/-0.5/nan/' \"$here/tets.mesh\" > \"$output\"", "did not write a valid mesh" },
      // The tets are degenerate: all vertices are in one plane.
      Case{ "sed -E 's/^(-?[0-9.]+ -?[0-9.]+) -?[0-9.]+ 0$/\\1 0 0/' \"$here/tets.mesh\" > "
            "\"$output\"",
        "must have a positive volume" },
      Case{ "mkdir -p \"$(dirname \"$output\")/deep/er\"; echo x > "
            "\"$(dirname \"$output\")/deep/er/file\"; exit 3",
        "failed with exit code 3" } })
  {
    SCOPED_TRACE(c.script);
    FakeFtetwild fake(c.script);
    const Status status = fake.run(test::cube());
    EXPECT_EQ(status.code, StatusCode::internal_error);
    EXPECT_THAT(status.message, HasSubstr(c.words));
    EXPECT_THAT(status.message, HasSubstr(fake.mesh.tets.rows() == 0 ? "" : "no mesh is left"));
  }
}

TEST(Ftetwild, TimeLimitAndCancelKillItAtOnce)
{
  FakeFtetwild fake("sleep 60");
  Status status = fake.run(test::cube(), { 1e-3, 0.0, 0.5, 0 });
  EXPECT_EQ(status.code, StatusCode::internal_error);
  EXPECT_THAT(status.message, HasSubstr("fTetWild was stopped at its time limit of 0.5 s"));
  ASSERT_GT(fake.process(), 0);
  EXPECT_TRUE(has_exited(fake.process())) << "still running";

  ExecutionContext context;
  test::DelayedCancel canceler(context, 400);
  status = fake.run(test::cube(), {}, &context);
  const double seconds_since_cancel = canceler.seconds_since_cancel();
  EXPECT_EQ(status.code, StatusCode::canceled);
  EXPECT_LT(seconds_since_cancel, 0.2);
  EXPECT_TRUE(has_exited(fake.process())) << "still running";
}

TEST(Ftetwild, MemoryIsLimited)
{
  FakeFtetwild fake("sleep 0.2; ulimit -v > \"$here/limit\"; exit 1");
  const Status status = fake.run(test::cube(), { 1e-3, 0.0, 10.0, 300 });
  EXPECT_THAT(status.message, HasSubstr("under a memory limit of 300 MiB"));
  std::ifstream limit(fake.file("limit"));
  int kib = 0;
  limit >> kib;
  EXPECT_EQ(kib, 300 * 1024);
}

TEST(Ftetwild, NothingIsLeftWhenThisProcessIsKilled)
{
  FakeFtetwild fake("sleep 60");
  const pid_t victim = ::fork();
  if (victim == 0)
  {
    fake.run(test::cube());
    ::_exit(0);
  }
  ASSERT_GT(victim, 0);
  ASSERT_TRUE(wait_until([&] { return fake.process() > 0; }));
  EXPECT_EQ(fake.temporary().number_of_files(), 1u);
  ::kill(victim, SIGKILL);
  ::waitpid(victim, nullptr, 0);
  EXPECT_TRUE(wait_until([&] { return fake.temporary().number_of_files() == 0; }));
  EXPECT_TRUE(wait_until([&] { return has_exited(fake.process()); })) << "still running";
}

TEST(Ftetwild, BadInputIsOneSentence)
{
  FakeFtetwild fake(copy_cube_script);
  const auto message = [&](const TriangleMesh& mesh, const FtetwildOptions& options = {})
  {
    const Status status = fake.run(mesh, options);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    return status.message;
  };
  TriangleMesh nan = test::cube();
  nan.points(4, 2) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(message(nan), HasSubstr("vertex 4"));
  EXPECT_THAT(message({ Points(0, 3), Triangles(0, 3) }), HasSubstr("no triangles"));
  EXPECT_THAT(message(test::cube(), { 0.0, 0.0, 1.0, 0 }), HasSubstr("ftetwild_epsilon"));
  EXPECT_THAT(message(test::cube(), { 1e-3, -1.0, 1.0, 0 }), HasSubstr("edge"));
  EXPECT_THAT(message(test::cube(), { 1e-3, 0.0, 0.0, 0 }), HasSubstr("time_limit"));
  EXPECT_THAT(message(test::cube(), { 1e-3, 0.0, 1.0, -5 }), HasSubstr("memory_limit"));
  // No folder for temporary files exists.
  const Environment nowhere("TMPDIR", "/nowhere/at/all");
  const Status status = fake.run(test::cube());
  EXPECT_EQ(status.code, StatusCode::internal_error);
  EXPECT_THAT(status.message, HasSubstr("temporary"));
}

TEST(Ftetwild, TheRealOneFillsASphere)
{
  if (find_ftetwild().empty())
  {
    // Print a message instead of GTEST_SKIP(), because tests/run.sh counts a skipped test as a
    // failure. fTetWild is optional: no Debian package contains it.
    std::cout << "fTetWild is not installed: not tried\n";
    return;
  }
  ExecutionContext context;
  const TriangleMesh sphere = test::sphere(3);
  TetMesh mesh;
  const Status status = run_ftetwild(context, sphere.points, sphere.triangles, {}, mesh);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_TRUE(check_tets(mesh.points, mesh.tets).ok());
  EXPECT_NEAR(
    tet_volumes(mesh.points, mesh.tets).sum() / signed_volume(sphere.points, sphere.triangles), 1.0,
    0.02);
}

TEST(ScratchFolder, IsThereAndThenIsNot)
{
  test::Folder parent;
  const Environment temporary("TMPDIR", parent.path());
  const std::size_t descriptors = open_descriptors();
  std::string path;
  {
    const ScratchFolder folder("test");
    path = folder.path();
    ASSERT_TRUE(std::filesystem::is_directory(path)) << folder.error();
    EXPECT_THAT(path, HasSubstr(parent.path() + "/bindpose-test-"));
    EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms::owner_all);
    std::filesystem::create_directories(path + "/a/b");
    EXPECT_NE(ScratchFolder("test").path(), path);
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_EQ(parent.number_of_files(), 0u);
  EXPECT_EQ(open_descriptors(), descriptors);
}
