#ifndef viewer_h
#define viewer_h

#include "document/opened_file.h"
#include "tour_player.h"

#include <optional>

#include <string>
#include <vector>

class MainWindow;

/// What the window begins with. A file without data and error is read by the window.
struct FirstFile
{
  std::string path;
  std::optional<OpenedFile> data;
  std::string error; ///< why it could not be read: one sentence, or empty
};

/// `bindpose view`: opens the window with these files (meshes, meshes with weights, handles).
/// Returns the program's exit code. Needs a display.
/// @param auto_rig  makes bones along the mesh and binds it
int run_viewer(const std::vector<FirstFile>& files, bool auto_rig);

/// Opens all files that can be opened; the error bar lists the errors of all others.
void open_first_files(MainWindow& window, const std::vector<FirstFile>& files);

/// The same with a tour in place of a person. Recent files and recovered work of whoever runs it
/// are neither looked at nor changed.
bindpose::Status play_tour(
  const std::vector<FirstFile>& files, bool auto_rig, const TourRequest& request);

#endif
