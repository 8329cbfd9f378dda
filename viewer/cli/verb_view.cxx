// bindpose view FILE…: the window of viewer/app, when it was built.
#include "cli/interrupt.h"
#include "cli/session.h"
#include "cli/verbs.h"

#include "file_kind.h"
#include "scene/display.h"
#include "scene/picture_file.h"

#include "vtkDataSet.h"

#ifdef BINDPOSE_HAS_QT
#include "viewer.h"
#endif

namespace bindpose::cli
{

void run_view(Session& session)
{
#ifdef BINDPOSE_HAS_QT
  if (!can_render())
  {
    session.fail(Status::failure(StatusCode::unavailable,
      "there is no display to open a window on: DISPLAY is not set or its X server does not "
      "answer; for pictures without one there is: bindpose render"));
    return;
  }
  for (const std::string& file : session.arguments().list("FILE"))
  {
    // What only the window reads it speaks about itself.
    const bool of_window =
      is_picture_file(file) || is_listed(file_extension(file), "dmat bindpose");
    if (!of_window &&
      !session.read_any(file)) // said here, in the words of all verbs, before a window opens
    {
      return;
    }
  }
  release_interrupts();
  if (run_viewer(session.arguments().list("FILE")) != 0)
  {
    session.fail(Status::failure(StatusCode::internal_error, "the window ended with an error"));
  }
#else
  session.fail(Status::failure(StatusCode::unavailable,
    "this program was built without the window; install qtbase5-dev and libvtk9-qt-dev and build "
    "it again"));
#endif
}

} // namespace bindpose::cli
