// The program bindpose: parses by the option table, runs the verb, ends with its exit code:
// 0 done, 1 usage, 2 bad input, 3 not converged, 4 cancelled, 5 internal.
#include "cli/arguments.h"
#include "cli/interrupt.h"
#include "cli/key_table.h"
#include "cli/option_table.h"
#include "cli/session.h"
#include "cli/verbs.h"

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

/// VTK prints many lines where the program promises one; what matters is in the status.
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
    { "smooth", run_smooth }, { "deform", run_deform }, { "render", run_render },
    { "view", run_view } };
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
  session.fail(Status::failure(StatusCode::internal_error, "the verb has no function"));
}
} // namespace

int main(int argc, char** argv)
{
  catch_interrupts();
  // A file that may not grow further is a write that fails, not the end. The helper inherits this.
  std::signal(SIGXFSZ, SIG_IGN);
  vtkNew<SilentOutputWindow> silent;
  vtkOutputWindow::SetInstance(silent);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF); // it has a way of its own
  Arguments arguments;
  const int early = parse_arguments(argc, argv, arguments);
  if (early >= 0)
  {
    return early;
  }
  if (arguments.verb == "option-table")
  {
    std::cout << option_table_markdown();
    return 0;
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
  // No clean-up of libraries: OpenBLAS waits for ever for threads that found no memory (ulimit -v).
  std::cout.flush();
  std::fflush(nullptr);
  std::_Exit(code);
}
