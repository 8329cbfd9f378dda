// Implements bindpose handles MESH, which creates automatic handles: bones along the curve
// skeleton, or points.
#include "cli/session.h"
#include "cli/set_options.h"
#include "cli/verbs/verbs.h"
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
  set_automatic_handles_options(arguments, handles.Get());
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
