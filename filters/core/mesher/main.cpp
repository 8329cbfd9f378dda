// bindpose-mesher JOB [options] < mesh > mesh
// runs one job of CGAL or TetGen in a separate process, because CGAL and TetGen may crash, hang or
// take all memory on bad input. Bindpose starts this program; users do not call it.
#include "helper/helper_start.h"
#include "mesher/jobs.h"
#include "mesher/tetgen_work.h"

#include <cstdio>
#include <exception>

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
std::string run(
  const std::string& job, const bindpose::HelperOptions& options, bindpose::MesherData& data)
{
  using bindpose::helper_number;
  if (job == "refine")
  {
    bindpose::RefineOptions refine;
    refine.time_limit = helper_number(options, "--time", refine.time_limit);
    refine.growth_limit = helper_number(options, "--growth", refine.growth_limit);
    return bindpose::refine(data, refine);
  }
  if (job == "tetgen")
  {
    bindpose::TetgenOptions tetgen;
    const auto entry = options.find("--switches");
    tetgen.switches = entry == options.end() ? "p" : entry->second;
    tetgen.box = helper_number(options, "--box", 0.0) > 0.0;
    bindpose::limit_tetgen_work(helper_number(options, "--work", 1e18));
    std::string error = bindpose::tetgen(data, tetgen);
    bindpose::report_tetgen_work();
    return error;
  }
  if (job == "delaunay")
  {
    return bindpose::delaunay(data);
  }
  if (job == "arrange")
  {
    return bindpose::arrange(data, helper_number(options, "--grid", 0.0));
  }
  if (job == "fill-plane")
  {
    bindpose::FillOptions fill;
    fill.min_angle = helper_number(options, "--min-angle", fill.min_angle);
    fill.longest_edge = helper_number(options, "--edge", fill.longest_edge);
    fill.smallest_side = helper_number(options, "--floor", fill.smallest_side);
    fill.time_limit = helper_number(options, "--time", fill.time_limit);
    return bindpose::fill_plane(data, fill);
  }
  if (job == "remesh")
  {
    bindpose::RemeshJobOptions remesh;
    remesh.winding_threshold = helper_number(options, "--threshold", remesh.winding_threshold);
    remesh.smallest_edge = helper_number(options, "--smallest", remesh.smallest_edge);
    remesh.largest_edge = helper_number(options, "--largest", remesh.largest_edge);
    remesh.tet_limit = helper_number(options, "--tets", remesh.tet_limit);
    remesh.maximum_thin_fraction = helper_number(options, "--thin", remesh.maximum_thin_fraction);
    return bindpose::remesh(data, remesh);
  }
  if (job == "wrap")
  {
    return bindpose::wrap(
      data, { helper_number(options, "--alpha", 0.0), helper_number(options, "--offset", 0.0) });
  }
  if (job == "skeleton")
  {
    bindpose::SkeletonJobOptions skeleton;
    skeleton.triangles = helper_number(options, "--triangles", skeleton.triangles);
    skeleton.smallest_part = helper_number(options, "--smallest-part", skeleton.smallest_part);
    return bindpose::skeleton(data, skeleton);
  }
  return "unknown job '" + job +
    "'; expected refine, tetgen, delaunay, arrange, fill-plane, remesh, skeleton or wrap";
}
} // namespace

int main(int argc, char* argv[])
{
  using bindpose::helper_fail;
  const bindpose::HelperOptions options = bindpose::helper_options(argc, argv, 1);
  const int result = bindpose::start_helper(options);
  try
  {
    bindpose::MesherData data;
    if (!bindpose::read_mesher_data(0, data))
    {
      helper_fail("standard input contains no valid mesh");
    }
    const std::string error = run(argc > 1 ? argv[1] : "", options, data);
    if (!error.empty())
    {
      helper_fail(error);
    }
    if (!bindpose::write_mesher_data(result, data))
    {
      helper_fail("cannot write the result");
    }
  }
  catch (const std::exception& error)
  {
    std::string text = error.what();
    for (char& c : text)
    {
      c = c == '\n' ? ' ' : c; // join the lines of CGAL's messages
    }
    helper_fail(text);
  }
  catch (int code) // TetGen throws its exit code as an int
  {
    bindpose::report_tetgen_work();
    helper_fail(code == 1 ? "TetGen ran out of memory"
        : code == 3       ? "TetGen found intersecting triangles"
        : code == 4       ? "TetGen found a feature too small for its precision"
        : code == 5       ? "TetGen found two facets that nearly coincide"
                          : "TetGen failed with code " + std::to_string(code));
  }
  bindpose::end_helper(); // TetGen's destructors are unreliable after an error
}
