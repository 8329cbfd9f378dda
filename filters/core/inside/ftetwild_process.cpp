// Runs the program fTetWild.
//
// The surface is written as OFF. The tets are read as MEDIT, which fTetWild writes if the name of
// the output file ends in .mesh. Progress is derived from the lines that fTetWild prints at the end
// of each of its five stages, with an estimated duration per stage.
#include "inside/ftetwild_process.h"

#include "base/number_text.h"
#include "helper/child_process.h"
#include "helper/scratch_folder.h"
#include "io/medit.h"
#include "io/off.h"
#include "surface/unit_frame.h"
#include "tets/tet_quality.h"

#include <cstdlib>

namespace bindpose
{

namespace
{
constexpr const char* environment_variable = "BINDPOSE_FTETWILD";
constexpr const char* missing_message =
  "the executable FloatTetwild_bin (or ftetwild) of fTetWild was not found; add it to PATH or name "
  "it in the environment variable BINDPOSE_FTETWILD; the source code is at "
  "https://github.com/wildmeshing/fTetWild";

Status check_options(const FtetwildOptions& options)
{
  constexpr double minimum = 1e-5;
  constexpr double maximum = 0.1;
  if (!(options.epsilon >= minimum && options.epsilon <= maximum))
  {
    return Status::invalid_input(
      "ftetwild_epsilon must be from 0.00001 to 0.1, not " + short_number(options.epsilon));
  }
  if (!(options.edge >= 0.0 && options.edge <= 1.0))
  {
    return Status::invalid_input(
      "the edge length must be from 0 to 1, not " + short_number(options.edge));
  }
  return check_limits(options.time_limit, options.memory_limit);
}

/// Parses the output of fTetWild: updates the progress and stores the last line.
class OutputLines
{
public:
  void parse_line(ExecutionContext& context, const std::string& line)
  {
    struct Stage
    {
      const char* prefix;
      double completed_fraction;
    };
    for (const Stage& stage :
      { Stage{ "preprocessing ", 0.1 }, Stage{ "tetrahedralizing ", 0.2 }, Stage{ "cutting ", 0.4 },
        Stage{ "mesh optimization ", 0.9 }, Stage{ "winding number ", 0.95 } })
    {
      if (line.find(stage.prefix) != std::string::npos)
      {
        context.progress(stage.completed_fraction);
      }
    }
    if (!line.empty())
    {
      constexpr std::size_t maximum_message_length = 200;
      this->last_line_ = line.substr(0, maximum_message_length);
    }
  }
  const std::string& last_line() const { return this->last_line_; }

private:
  std::string last_line_;
};

/// Return the tets, oriented positively and without unused vertices.
TetMesh clean_up(const MeditMesh& medit_mesh)
{
  TetMesh mesh{ Points(0, 3), medit_mesh.tets };
  if (tet_volumes(medit_mesh.points, mesh.tets).sum() < 0.0)
  {
    mesh.tets.col(0).swap(mesh.tets.col(1)); // if one tet is negative, all are negative
  }
  std::vector<Index> number(static_cast<std::size_t>(medit_mesh.points.rows()), -1);
  std::vector<Index> used;
  for (Index k = 0; k < mesh.tets.size(); ++k)
  {
    Index& v = mesh.tets.data()[k];
    if (number[v] < 0)
    {
      number[v] = static_cast<Index>(used.size());
      used.push_back(v);
    }
    v = number[v];
  }
  mesh.points.resize(static_cast<Index>(used.size()), 3);
  for (std::size_t v = 0; v < used.size(); ++v)
  {
    mesh.points.row(static_cast<Index>(v)) = medit_mesh.points.row(used[v]);
  }
  return mesh;
}
} // namespace

std::string find_ftetwild()
{
  if (const char* configured_path = std::getenv(environment_variable))
  {
    return is_executable_file(configured_path) ? std::string(configured_path) : std::string();
  }
  const std::string installed = find_on_path("FloatTetwild_bin");
  return installed.empty() ? find_on_path("ftetwild") : installed;
}

Status run_ftetwild(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const FtetwildOptions& options, TetMesh& mesh)
{
  mesh = TetMesh();
  Status status = check_options(options);
  if (status.ok())
  {
    status = check_frame(points, triangles);
  }
  if (!status.ok())
  {
    return status;
  }
  ChildRequest request;
  request.name = "fTetWild";
  request.path = find_ftetwild();
  if (request.path.empty())
  {
    const char* configured_path = std::getenv(environment_variable);
    return Status::failure(StatusCode::unavailable,
      configured_path ? "the environment variable " + std::string(environment_variable) +
          " must name an executable file, but is set to " + configured_path
                      : std::string(missing_message));
  }
  ScratchFolder folder("ftetwild");
  if (folder.path().empty())
  {
    return Status::failure(StatusCode::internal_error, folder.error());
  }
  // Some absolute lengths in fTetWild do not scale with the input, so the input is scaled to unit
  // size.
  const UnitFrame frame(bounding_box(points, triangles));
  const std::string surface = folder.path() + "/surface.off";
  const std::string tets = folder.path() + "/tets.mesh";
  status = write_off(surface, to_polygons(frame.to_frame(points), triangles));
  if (!status.ok())
  {
    return Status::failure(StatusCode::internal_error, status.message);
  }
  request.arguments = { "--input", surface, "--output", tets, "--epsr",
    exact_number(options.epsilon), "--level", "2", "--no-binary", "--no-color" };
  if (options.edge > 0.0)
  {
    request.arguments.insert(request.arguments.end(), { "--lr", exact_number(options.edge) });
  }
  if (context.threads() > 0)
  {
    request.arguments.insert(
      request.arguments.end(), { "--max-threads", std::to_string(context.threads()) });
  }
  request.folder = folder.path();
  request.time_limit = options.time_limit;
  request.memory_limit = options.memory_limit;
  request.started = [&](int group) { folder.guard_group(group); };
  OutputLines lines;
  ChildEnd end;
  status = run_child(
    context, request, [&](const std::string& line) { lines.parse_line(context, line); }, end);
  if (!status.ok())
  {
    return status;
  }
  if (!end.failure.empty())
  {
    return Status::failure(StatusCode::internal_error,
      request.name + " " + end.failure + memory_limit_phrase(options.memory_limit) +
        (lines.last_line().empty() ? "" : "; last output: " + lines.last_line()));
  }
  MeditMesh medit_mesh;
  status = read_medit(tets, medit_mesh);
  if (!status.ok())
  {
    return Status::failure(
      StatusCode::internal_error, request.name + " did not write a valid mesh: " + status.message);
  }
  mesh = clean_up(medit_mesh);
  mesh.points = frame.from_frame(mesh.points);
  status = check_tets(mesh.points, mesh.tets);
  if (!status.ok())
  {
    mesh = TetMesh();
  }
  return status;
}

} // namespace bindpose
