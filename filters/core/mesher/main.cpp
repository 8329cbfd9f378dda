// bindpose-mesher JOB [options] < mesh > mesh
// runs one job of CGAL or TetGen in a separate process, because CGAL and TetGen may crash, hang or
// take all memory on bad input. Bindpose starts this program; users do not call it.
#include "mesher/jobs.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <new>

#include <csignal>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace bindpose
{

void report_progress(double fraction)
{
  std::fprintf(stderr, "progress %.4f\n", fraction);
}

void report_value(const char* key, double number)
{
  std::fprintf(stderr, "report %s %.17g\n", key, number);
}

} // namespace bindpose

namespace
{
[[noreturn]] void fail(const std::string& reason)
{
  std::fprintf(stderr, "error %s\n", reason.c_str());
  std::fflush(stderr);
  std::_Exit(1);
}

/// Make this process end when its parent ends. If the parent ended before this request, the parent
/// id is different and the job fails.
void exit_with_parent(pid_t parent)
{
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (parent > 0 && ::getppid() != parent)
  {
    fail("the parent process has ended");
  }
}

void set_limits(double memory_mib)
{
  // Crashes are expected in this process, so no core files are written.
  const rlimit none{ 0, 0 };
  ::setrlimit(RLIMIT_CORE, &none);
  if (memory_mib > 0.0)
  {
    const auto bytes = static_cast<rlim_t>(memory_mib * 1048576.0);
    const rlimit memory{ bytes, bytes };
    ::setrlimit(RLIMIT_AS, &memory);
  }
  std::set_new_handler([] { fail("out of memory"); });
}

/// Change to a folder in which no file can be created. CGAL writes input that it cannot mesh to the
/// working folder ("dump-bug.mesh"), and the working folder may belong to the user.
void leave_working_folder()
{
  if (::chdir("/proc") != 0 && ::chdir("/") != 0)
  {
    fail("cannot change the working folder");
  }
}

double number(const std::map<std::string, std::string>& options, const char* key, double fallback)
{
  const auto entry = options.find(key);
  return entry == options.end() ? fallback : std::atof(entry->second.c_str());
}

std::string run(const std::string& job, const std::map<std::string, std::string>& options,
  bindpose::MesherData& data)
{
  if (job == "refine")
  {
    bindpose::RefineOptions refine;
    refine.time_limit = number(options, "--time", refine.time_limit);
    refine.growth_limit = number(options, "--growth", refine.growth_limit);
    return bindpose::refine(data, refine);
  }
  if (job == "tetgen")
  {
    bindpose::TetgenOptions tetgen;
    const auto entry = options.find("--switches");
    tetgen.switches = entry == options.end() ? "p" : entry->second;
    tetgen.box = number(options, "--box", 0.0) > 0.0;
    return bindpose::tetgen(data, tetgen);
  }
  if (job == "delaunay")
  {
    return bindpose::delaunay(data);
  }
  if (job == "arrange")
  {
    return bindpose::arrange(data, number(options, "--grid", 0.0));
  }
  if (job == "fill-plane")
  {
    bindpose::FillOptions fill;
    fill.min_angle = number(options, "--min-angle", fill.min_angle);
    fill.longest_edge = number(options, "--edge", fill.longest_edge);
    fill.smallest_side = number(options, "--floor", fill.smallest_side);
    fill.time_limit = number(options, "--time", fill.time_limit);
    return bindpose::fill_plane(data, fill);
  }
  if (job == "remesh")
  {
    bindpose::RemeshJobOptions remesh;
    remesh.winding_threshold = number(options, "--threshold", remesh.winding_threshold);
    remesh.smallest_edge = number(options, "--smallest", remesh.smallest_edge);
    remesh.largest_edge = number(options, "--largest", remesh.largest_edge);
    remesh.tet_limit = number(options, "--tets", remesh.tet_limit);
    return bindpose::remesh(data, remesh);
  }
  if (job == "wrap")
  {
    return bindpose::wrap(
      data, { number(options, "--alpha", 0.0), number(options, "--offset", 0.0) });
  }
  if (job == "skeleton")
  {
    bindpose::SkeletonJobOptions skeleton;
    skeleton.triangles = number(options, "--triangles", skeleton.triangles);
    skeleton.smallest_part = number(options, "--smallest-part", skeleton.smallest_part);
    return bindpose::skeleton(data, skeleton);
  }
  return "unknown job '" + job +
    "'; expected refine, tetgen, delaunay, arrange, fill-plane, remesh, skeleton or wrap";
}
} // namespace

int main(int argc, char* argv[])
{
  std::map<std::string, std::string> options;
  for (int i = 2; i + 1 < argc; i += 2)
  {
    options[argv[i]] = argv[i + 1];
  }
  exit_with_parent(static_cast<pid_t>(number(options, "--parent", 0.0)));
  set_limits(number(options, "--memory", 0.0));
  leave_working_folder();
  // Libraries print to standard output. It is redirected to standard error, so that only the result
  // is written to the original standard output.
  const int result = ::dup(1);
  ::dup2(2, 1);
  try
  {
    bindpose::MesherData data;
    if (!bindpose::read_mesher_data(0, data))
    {
      fail("standard input contains no valid mesh");
    }
    const std::string error = run(argc > 1 ? argv[1] : "", options, data);
    if (!error.empty())
    {
      fail(error);
    }
    if (!bindpose::write_mesher_data(result, data))
    {
      fail("cannot write the result");
    }
  }
  catch (const std::exception& error)
  {
    std::string text = error.what();
    for (char& c : text)
    {
      c = c == '\n' ? ' ' : c; // join the lines of CGAL's messages
    }
    fail(text);
  }
  catch (int code) // TetGen throws its exit code as an int
  {
    fail(code == 1  ? "TetGen ran out of memory"
        : code == 3 ? "TetGen found intersecting triangles"
        : code == 4 ? "TetGen found a feature too small for its precision"
        : code == 5 ? "TetGen found two facets that nearly coincide"
                    : "TetGen failed with code " + std::to_string(code));
  }
  // Exit without calling destructors, because TetGen's destructors are unreliable after an error.
  std::fflush(stderr);
  std::_Exit(0);
}
