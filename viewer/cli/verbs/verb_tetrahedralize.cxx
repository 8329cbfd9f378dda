// Implements bindpose tetrahedralize SURFACE, which fills the inside of a surface with tets.
#include "cli/session.h"
#include "cli/set_options.h"
#include "cli/verbs/verbs.h"

#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTetrahedralizeSurface.h"

namespace bindpose::cli
{

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
  set_tetrahedralize_options(arguments, tets.Get());
  if (session.run(tets, "tetrahedralize", 0.0, 1.0, Merge::all))
  {
    session.write(tets->GetOutput(), output);
  }
}

} // namespace bindpose::cli
