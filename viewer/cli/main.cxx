// The program bindpose: parses the command line, runs the verb (subcommand), and returns the exit
// code: 0 success, 1 usage error, 2 invalid input, 3 not converged, 4 canceled, 5 internal error.
#include "cli/arguments.h"
#include "cli/interrupt.h"
#include "cli/key_table.h"
#include "cli/session.h"
#include "cli/verbs/verbs.h"

#include "vtkLogger.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>

namespace
{
using namespace bindpose;
using namespace bindpose::cli;

/// Suppresses VTK's messages. The program itself prints one line per error.
class SilentOutputWindow : public vtkOutputWindow
{
public:
  static SilentOutputWindow* New();
  vtkTypeMacro(SilentOutputWindow, vtkOutputWindow);
  void DisplayText(const char*) override {}
};
vtkStandardNewMacro(SilentOutputWindow);

void run(Session& session)
{
  const std::pair<const char*, void (*)(Session&)> functions[] = { { "info", run_info },
    { "winding", run_winding }, { "tetrahedralize", run_tetrahedralize },
    { "outline", run_outline }, { "handles", run_handles }, { "weights", run_weights },
    { "smooth", run_smooth }, { "deform", run_deform }, { "rig", run_rig },
    { "transfer", run_transfer }, { "render", run_render }, { "view", run_view } };
  for (const auto& [name, function] : functions)
  {
    if (session.arguments().verb == name)
    {
      if (session.check_report())
      {
        function(session);
      }
      return;
    }
  }
  session.fail(
    Status::failure(StatusCode::internal_error, "no function is registered for the verb"));
}
} // namespace

int main(int argc, char** argv)
{
  catch_interrupts();
  // Ignore the signal SIGXFSZ: if the file size limit is exceeded, writing returns an error instead
  // of ending the program. The helper program bindpose-mesher inherits this setting.
  std::signal(SIGXFSZ, SIG_IGN);
  vtkNew<SilentOutputWindow> silent;
  vtkOutputWindow::SetInstance(silent);
  // disable the logger separately, because it does not use the output window
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  Arguments arguments;
  const int early_exit_code = parse_arguments(argc, argv, arguments);
  if (early_exit_code >= 0)
  {
    return early_exit_code;
  }
  if (arguments.verb == "key-table")
  {
    std::cout << key_table_markdown();
    return 0;
  }
  Session session(arguments);
  try
  {
    run(session);
  }
  catch (const std::bad_alloc&)
  {
    session.fail(Status::failure(StatusCode::internal_error, "out of memory"));
  }
  catch (const std::exception& error)
  {
    session.fail(Status::failure(StatusCode::internal_error, error.what()));
  }
  const int code = session.finish();
  // Exit without the clean-up of libraries: OpenBLAS would wait forever for threads that could not
  // be started (ulimit -v).
  std::cout.flush();
  std::fflush(nullptr);
  std::_Exit(code);
}
