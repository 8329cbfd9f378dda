// bindpose handles MESH: handles without a hand, bones along the curve skeleton or points.
#include "cli/session.h"
#include "cli/verbs.h"
#include "conversion.h"
#include "file_kind.h"
#include "handle_tgf.h"

#include "vtkAutomaticHandles.h"
#include "vtkNew.h"

namespace bindpose::cli
{

namespace
{
bool write_tgf_file(Session& session, vtkDataSet* data, const std::string& path)
{
  Handles handles;
  Tgf graph;
  Status status = to_handles(vtkPolyData::SafeDownCast(data), handles);
  if (status.ok())
  {
    status = to_tgf(handles, graph);
    for (const std::string& warning : status.warnings)
    {
      session.warn(warning);
    }
  }
  AtomicFile file;
  if (status.ok())
  {
    status = file.open(path, session.arguments().has("overwrite"));
  }
  if (status.ok())
  {
    status = write_tgf(file.temporary(), graph);
  }
  return status.ok() ? session.commit(file) : session.fail(status);
}
} // namespace

void run_handles(Session& session)
{
  const Arguments& arguments = session.arguments();
  const std::string output = arguments.text("output");
  if (!session.check_output(output, "vtp vtk tgf"))
  {
    return;
  }
  const auto mesh = session.read(arguments.text("MESH"));
  if (!mesh)
  {
    return;
  }
  vtkNew<vtkAutomaticHandles> handles;
  handles->SetInputData(0, mesh);
  if (arguments.has("points"))
  {
    handles->SetMethodToPoints();
    handles->SetNumberOfPoints(arguments.integer("points"));
  }
  handles->SetDistance(arguments.text("distance") == "straight" ? vtkAutomaticHandles::STRAIGHT
                                                                : vtkAutomaticHandles::ALONG_EDGES);
  handles->SetPlaceInside(!arguments.has("on-surface"));
  handles->SetMostBones(arguments.integer("bones"));
  handles->SetBoneTolerance(arguments.number("bone-tolerance"));
  handles->SetLongestBone(arguments.number("longest-bone"));
  handles->SetPrune(arguments.number("prune"));
  handles->SetSkeletonTriangles(arguments.integer("skeleton-triangles"));
  handles->SetWindingThreshold(arguments.number("winding-threshold"));
  handles->SetTimeLimit(arguments.number("time-limit"));
  handles->SetMemoryLimit(arguments.integer("memory-limit"));
  if (!session.run(handles, "handles", 0.0, 1.0, Merge::all))
  {
    return;
  }
  if (file_extension(output) == "tgf")
  {
    write_tgf_file(session, handles->GetOutput(), output);
  }
  else
  {
    session.write(handles->GetOutput(), output);
  }
}

} // namespace bindpose::cli
