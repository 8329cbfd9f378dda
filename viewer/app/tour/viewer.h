#ifndef app_tour_viewer_h
#define app_tour_viewer_h

#include "app/tour/tour_player.h"
#include "document/opened_file.h"

#include <optional>

#include <string>
#include <vector>

namespace app::window
{
class MainWindow;
} // namespace app::window

namespace app::tour
{

/// A file to open when the program starts. If this struct has neither data nor an error, the window
/// reads the file.
struct InitialFile
{
  std::string path;
  std::optional<OpenedFile> data;
  std::string error; ///< reason why the file could not be read: one sentence, or empty
};

/// Run `bindpose view`: open a window with these files (meshes, meshes with weights, handles), and
/// return the program's exit code. An X server is required.
/// @param auto_rig  create bones along the mesh and bind it
int run_viewer(const std::vector<InitialFile>& files, bool auto_rig);

/// Open all files that can be opened. The error bar shows the errors of the other files.
void open_initial_files(window::MainWindow& window, const std::vector<InitialFile>& files);

/// Run `bindpose view --play`: like run_viewer(), but a tour replaces the user's input. The user's
/// list of recent files and recovery files are neither read nor changed.
bindpose::Status play_tour(
  const std::vector<InitialFile>& files, bool auto_rig, const TourRequest& request);

} // namespace app::tour

#endif
