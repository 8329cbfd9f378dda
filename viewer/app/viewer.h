#ifndef viewer_h
#define viewer_h

#include "document/opened_file.h"
#include "tour_player.h"

#include <optional>

#include <string>
#include <vector>

/// What the window begins with. A file that is not read yet the window reads.
struct FirstFile
{
  std::string path;
  std::optional<OpenedFile> data;
};

/// `bindpose view`: opens the window with these files (meshes, meshes with weights, handles).
/// Returns the program's exit code. Needs a display.
int run_viewer(const std::vector<FirstFile>& files);

/// The same with a tour in place of a person. Recent files and recovered work of whoever runs it
/// are neither looked at nor changed.
bindpose::Status play_tour(const std::vector<FirstFile>& files, const TourRequest& request);

#endif
