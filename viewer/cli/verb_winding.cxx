// bindpose winding SURFACE: the winding number on a grid (.vti) or at the points of a dataset.
#include "cli/session.h"
#include "cli/verbs.h"

#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkWindingNumberField.h"

namespace bindpose::cli
{

namespace
{
/// The file endings that hold a dataset of this kind.
std::string endings_for(vtkDataSet* data)
{
  if (data->IsA("vtkPolyData"))
  {
    return "vtp vtk";
  }
  if (data->IsA("vtkUnstructuredGrid"))
  {
    return "vtu vtk";
  }
  return data->IsA("vtkImageData") ? "vti vtk" : "vtk";
}
} // namespace

void run_winding(Session& session)
{
  const Arguments& arguments = session.arguments();
  const std::string output = arguments.text("output");
  if (!session.check_output(output, arguments.has("points") ? "vtp vtu vti vtk" : "vti vtk"))
  {
    return;
  }
  const auto surface = session.read(arguments.text("SURFACE"));
  vtkNew<vtkWindingNumberField> field;
  if (!surface)
  {
    return;
  }
  field->SetInputData(0, surface);
  field->SetMethod(arguments.text("method") == "exact" ? vtkWindingNumberField::EXACT
                                                       : vtkWindingNumberField::AUTO);
  field->SetSamplesAlongLongestSide(arguments.integer("grid"));
  if (arguments.has("points"))
  {
    const auto points = session.read(arguments.text("points"));
    if (!points || !session.check_output(output, endings_for(points)))
    {
      return;
    }
    field->SetInputData(1, points);
  }
  if (session.run(field, "winding", 0.0, 1.0, Merge::all))
  {
    session.write(field->GetOutput(), output);
  }
}

} // namespace bindpose::cli
