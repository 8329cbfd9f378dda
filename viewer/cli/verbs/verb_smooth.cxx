// Implements bindpose smooth MESH --array NAME, which smooths data on a mesh. The result has only
// selected local extrema: those in the array of --extrema, or the most persistent extrema of the
// data.
#include "cli/session.h"
#include "cli/set_options.h"
#include "cli/verbs/verbs.h"

#include "file_kind.h"
#include "vtkMonotoneSmoothing.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

namespace bindpose::cli
{

void run_smooth(Session& session)
{
  const Arguments& arguments = session.arguments();
  const std::string output = arguments.text("output");
  const std::string extrema = arguments.text("extrema-output");
  if (!session.check_output(output, "vtp vtu vtk") ||
    (!extrema.empty() && !session.check_output(extrema, "vtp")))
  {
    return;
  }
  const auto mesh = session.read(arguments.text("MESH"));
  if (!mesh)
  {
    return;
  }
  if (!mesh->IsA("vtkPointSet"))
  {
    session.invalid(arguments.text("MESH") + " must contain a surface or tets");
    return;
  }
  const std::string extension = file_extension(output);
  if (extension != "vtk" && (extension == "vtp") != bool(mesh->IsA("vtkPolyData")))
  {
    session.invalid(arguments.text("MESH") + " is " +
      (extension == "vtp" ? "not a polygon dataset; the output must be .vtu"
                          : "a polygon dataset; the output must be .vtp") +
      " or .vtk");
    return;
  }
  vtkNew<vtkMonotoneSmoothing> smoothing;
  smoothing->SetInputData(0, mesh);
  const std::string array = arguments.text("array");
  if (!array.empty())
  {
    smoothing->SetInputArrayToProcess(
      0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, array.c_str());
  }
  const std::string extrema_array = arguments.text("extrema");
  if (arguments.is_typed("extrema") && !mesh->GetPointData()->GetArray(extrema_array.c_str()))
  {
    session.invalid("--extrema: the mesh has no point array '" + extrema_array + "'");
    return;
  }
  if (arguments.is_typed("number-of-extrema") || arguments.is_typed("persistence"))
  {
    // select the extrema from the data, unless --extrema names an array
    smoothing->SetExtremaArrayName("");
  }
  set_monotone_smoothing_options(arguments, smoothing.Get());
  if (session.run(smoothing, "smooth", 0.0, 1.0, Merge::all) &&
    session.write(smoothing->GetOutput(), output) && !extrema.empty())
  {
    session.write(smoothing->GetOutput(1), extrema);
  }
}

} // namespace bindpose::cli
