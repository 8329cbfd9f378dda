// Implements bindpose view FILE…, which opens the window of viewer/app. In a build without Qt, this
// verb only reports an error. With --play the window runs a tour, a scripted demonstration, without
// a user and without a visible display.
#include "cli/interrupt.h"
#include "cli/session.h"
#include "cli/under_xvfb.h"
#include "cli/verbs/verbs.h"

#include "file_kind.h"
#include "pictures/display.h"
#include "pictures/picture_file.h"

#ifdef BINDPOSE_HAS_QT
#include "app/tour/viewer.h"
#endif

namespace bindpose::cli
{

#ifdef BINDPOSE_HAS_QT
namespace
{
/// Read the option --play, and --screenshot-dir and --time-limit, which are only allowed with
/// --play.
bool tour_request(Session& session, app::tour::TourRequest& request)
{
  const Arguments& arguments = session.arguments();
  request.path = arguments.text("play");
  request.folder = arguments.text("screenshot-dir");
  request.seconds = arguments.number("time-limit");
  request.overwrite = arguments.has("overwrite");
  if (!(request.seconds >= 0.0))
  {
    return session.invalid("--time-limit must be 0 or more seconds");
  }
  return !request.path.empty() || request.folder.empty() ||
    session.invalid("--screenshot-dir needs --play TOUR");
}

/// Read the files before the window opens, with progress on a terminal. Errors are printed to the
/// standard error. The window shows them too, because a program that is started from a desktop has
/// no visible terminal. A tour has no user, so an error ends the program.
bool read_files(Session& session, std::vector<app::tour::InitialFile>& files)
{
  const bool is_tour = session.arguments().has("play");
  for (const std::string& path : session.arguments().list("FILE"))
  {
    files.push_back({ path, std::nullopt, {} });
    // The window itself reads these files and reports their errors.
    if (is_picture_file(path) || is_listed(file_extension(path), "dmat bindpose"))
    {
      continue;
    }
    const Status status = read_file(path, files.back().data.emplace(),
      [&session](vtkBindposeAlgorithm* reader)
      { return session.try_run(reader, "read", 0.0, 0.0, Merge::nothing); });
    if (status.ok())
    {
      continue;
    }
    if (is_tour || session.failed()) // session.failed() is also true after an interrupt
    {
      return session.fail(status);
    }
    files.back().data.reset();
    files.back().error = status.message;
    session.warn(status.message);
  }
  return true;
}
} // namespace
#endif

void run_view(Session& session)
{
#ifdef BINDPOSE_HAS_QT
  app::tour::TourRequest request;
  if (!tour_request(session, request))
  {
    return;
  }
  if (!can_render())
  {
    if (!request.path.empty())
    {
      run_again_under_xvfb(session.arguments().command_line);
    }
    session.fail(Status::failure(StatusCode::unavailable,
      "cannot open a window without a display: DISPLAY is not set or its X server does not answer; "
      "use bindpose render to draw pictures without a window"));
    return;
  }
  std::vector<app::tour::InitialFile> files;
  if (!read_files(session, files))
  {
    return;
  }
  const bool auto_rig = session.arguments().has("auto-rig");
  release_interrupts();
  if (!request.path.empty())
  {
    session.fail(app::tour::play_tour(files, auto_rig, request));
  }
  else if (app::tour::run_viewer(files, auto_rig) != 0)
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
