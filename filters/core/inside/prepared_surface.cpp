// Preparation of a surface for tetrahedralize(): repair, removal of back-side triangles, and
// construction of the winding number. Each modification adds a warning.
#include "inside/prepared_surface.h"

#include "surface/back_sides.h"

namespace bindpose
{

namespace
{
/// Return a phrase such as "1 triangle was" or "2 triangles were".
std::string count_phrase(Index count, const char* singular, const char* plural)
{
  return std::to_string(count) + " " + (count == 1 ? singular : plural) +
    (count == 1 ? " was" : " were");
}

void report_flipped(PreparedSurface& prepared)
{
  const RepairedSurface& surface = prepared.surface;
  if (surface.flipped_triangles > 0)
  {
    prepared.report.set("counts.turned_triangles", Report::Value(surface.flipped_triangles));
    prepared.warnings.push_back(count_phrase(surface.flipped_triangles, "triangle", "triangles") +
      " flipped to match the orientation of the neighbors");
  }
  if (surface.flipped_components > 0)
  {
    prepared.report.set("counts.turned_components", Report::Value(surface.flipped_components));
    prepared.warnings.push_back(
      count_phrase(surface.flipped_components, "closed component", "closed components") +
      " flipped because the normals pointed inward");
  }
}

/// If there are back-side triangles, repair the surface again without them. The diagnosis in the
/// report remains that of the whole surface.
Status remove_back_triangles(
  ExecutionContext& context, PointsView points, TrianglesView triangles, PreparedSurface& prepared)
{
  const std::vector<Index> backs = back_sides(prepared.surface.points, prepared.surface.triangles);
  if (backs.empty())
  {
    return {};
  }
  const auto count = static_cast<Index>(backs.size());
  std::vector<char> is_back_side(static_cast<std::size_t>(triangles.rows()), 0);
  for (const Index back : backs)
  {
    is_back_side[prepared.surface.original_triangles[back]] = 1;
  }
  std::vector<Index> ids;
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    if (!is_back_side[t])
    {
      ids.push_back(t);
    }
  }
  const Triangles fronts = triangles(ids, Eigen::all);
  const Status status = repair_surface(context, points, fronts, RepairOptions(), prepared.surface);
  for (Index& id : prepared.surface.original_triangles)
  {
    id = ids[id];
  }
  prepared.report.set("counts.back_triangles", Report::Value(count));
  prepared.warnings.push_back(
    count_phrase(count, "triangle that is the back side of another triangle",
      "triangles that are the back sides of other triangles") +
    " ignored; otherwise the surface would enclose nothing there");
  return status;
}
} // namespace

Status prepare_surface(ExecutionContext& context, PointsView points, TrianglesView triangles,
  double winding_threshold, PreparedSurface& prepared)
{
  prepared = PreparedSurface();
  prepared.winding_threshold = winding_threshold;
  {
    const Phase phase(context, "repair", 0.0, 0.2);
    const Status status =
      repair_surface(context, points, triangles, RepairOptions(), prepared.surface);
    if (!status.ok())
    {
      return status;
    }
  }
  prepared.defects = list_defects(points, triangles, prepared.surface);
  add_to_report(prepared.surface.found, prepared.report);
  if (prepared.surface.triangles.rows() == 0)
  {
    return Status::invalid_input(triangles.rows() == 0
        ? "the surface has no triangles"
        : "all triangles of the surface have area 0, so the surface has no inside");
  }
  {
    const Phase phase(context, "repair", 0.2, 0.3);
    const Status status = remove_back_triangles(context, points, triangles, prepared);
    if (!status.ok())
    {
      return status;
    }
  }
  report_flipped(prepared);
  const Phase phase(context, "winding", 0.3, 1.0);
  bool flipped = false;
  const Status status =
    prepared.inside.build(context, prepared.surface, winding_threshold, flipped);
  if (flipped)
  {
    prepared.warnings.emplace_back("the surface was flipped because its normals pointed inward");
  }
  return status;
}

} // namespace bindpose
