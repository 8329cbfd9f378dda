// bindpose tetrahedralize SURFACE: the inside as tets.
#include "cli/session.h"
#include "cli/verbs.h"

#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTetrahedralizeSurface.h"

namespace bindpose::cli
{

namespace
{
int method_of(const std::string& word)
{
  return word == "cdt"   ? vtkTetrahedralizeSurface::CDT
    : word == "remesh"   ? vtkTetrahedralizeSurface::REMESH
    : word == "embed"    ? vtkTetrahedralizeSurface::EMBED
    : word == "wrap"     ? vtkTetrahedralizeSurface::WRAP
    : word == "ftetwild" ? vtkTetrahedralizeSurface::FTETWILD
                         : vtkTetrahedralizeSurface::AUTO;
}
} // namespace

void run_tetrahedralize(Session& session)
{
  const Arguments& arguments = session.arguments();
  const std::string output = arguments.text("output");
  if (!session.check_output(output, "vtu vtk mesh"))
  {
    return;
  }
  const auto surface = session.read(arguments.text("SURFACE"));
  if (!surface)
  {
    return;
  }
  vtkNew<vtkTetrahedralizeSurface> tets;
  tets->SetInputData(0, surface);
  if (arguments.has("handles"))
  {
    const auto handles = session.read_handles(arguments.text("handles"), nullptr);
    if (!handles)
    {
      return;
    }
    tets->SetInputData(1, handles);
  }
  tets->SetMethod(method_of(arguments.text("method")));
  tets->SetWindingThreshold(arguments.number("winding-threshold"));
  tets->SetSegmentation(arguments.text("segmentation") == "threshold"
      ? vtkTetrahedralizeSurface::THRESHOLD
      : vtkTetrahedralizeSurface::GRAPH_CUT);
  tets->SetCutSmoothness(arguments.number("cut-smoothness"));
  tets->SetCutSigma(arguments.number("cut-sigma"));
  tets->SetQuality(arguments.number("quality"));
  tets->SetBare(arguments.has("bare"));
  tets->SetInteriorEdge(arguments.number("interior-edge"));
  tets->SetKeepOutside(arguments.has("keep-outside"));
  tets->SetResolution(arguments.integer("resolution"));
  tets->SetWrapAlpha(arguments.number("wrap-alpha"));
  tets->SetWrapOffset(arguments.number("wrap-offset"));
  tets->SetFtetwildEpsilon(arguments.number("ftetwild-epsilon"));
  tets->SetTimeLimit(arguments.number("time-limit"));
  tets->SetMemoryLimit(arguments.integer("memory-limit"));
  if (session.run(tets, "tetrahedralize", 0.0, 1.0, Merge::all))
  {
    session.write(tets->GetOutput(), output);
  }
}

} // namespace bindpose::cli
