// Implements bindpose winding SURFACE, which computes the winding number on a grid (.vti, .vdb) or
// at the points of a dataset.
#include "cli/session.h"
#include "cli/set_options.h"
#include "cli/verbs/verbs.h"
#include "file_kind.h"
#include "io/vdb.h"

#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkVDBWriter.h"
#include "vtkWindingNumberField.h"

namespace bindpose::cli
{

namespace
{
/// Return the file name extensions for a dataset of this type.
std::string extensions_for(vtkDataSet* data)
{
  if (data->IsA("vtkPolyData"))
  {
    return "vtp vtk";
  }
  if (data->IsA("vtkUnstructuredGrid"))
  {
    return "vtu vtk";
  }
  return data->IsA("vtkImageData") ? "vti vtk vdb" : "vtk";
}

bool write_field(Session& session, vtkDataSet* field, const std::string& path)
{
  if (file_extension(path) != "vdb")
  {
    return session.write(field, path);
  }
  const Arguments& arguments = session.arguments();
  vtkNew<vtkVDBWriter> writer;
  writer->SetInputData(field);
  writer->SetFileName(path.c_str());
  writer->SetOverwrite(arguments.has("overwrite"));
  writer->SetBand(
    arguments.text("vdb-band") == "narrow" ? vtkVDBWriter::NARROW : vtkVDBWriter::FULL);
  writer->SetBandWidth(arguments.integer("vdb-band-width"));
  writer->SetBackground(arguments.number("vdb-background"));
  return session.run(writer, "write", 1.0, 1.0, Merge::nothing);
}
} // namespace

void run_winding(Session& session)
{
  const Arguments& arguments = session.arguments();
  const std::string output = arguments.text("output");
  if (!session.check_output(
        output, arguments.has("points") ? "vtp vtu vti vtk vdb" : "vti vtk vdb"))
  {
    return;
  }
  const std::string boundary = arguments.text("boundary");
  if (!boundary.empty() && !session.check_output(boundary, "vtp vtk"))
  {
    return;
  }
  if (const Status status = check_vdb_available(); file_extension(output) == "vdb" && !status.ok())
  {
    session.fail(status); // fail now, before the expensive work
    return;
  }
  const auto surface = session.read(arguments.text("SURFACE"));
  vtkNew<vtkWindingNumberField> field;
  if (!surface)
  {
    return;
  }
  field->SetInputData(0, surface);
  set_winding_number_options(arguments, field.Get());
  if (arguments.has("points"))
  {
    const auto points = session.read(arguments.text("points"));
    if (!points || !session.check_output(output, extensions_for(points)))
    {
      return;
    }
    field->SetInputData(1, points);
  }
  if (session.run(field, "winding", 0.0, 1.0, Merge::all) &&
    write_field(session, field->GetOutput(), output) && !boundary.empty())
  {
    session.write(field->GetBoundaryOutput(), boundary);
  }
}

} // namespace bindpose::cli
