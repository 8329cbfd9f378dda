#ifndef viewer_h
#define viewer_h

#include "tour_player.h"

#include <string>
#include <vector>

/// `bindpose view`: opens the window with these files (meshes, meshes with weights, handles).
/// Returns the program's exit code. Needs a display.
int run_viewer(const std::vector<std::string>& files);

/// The same with a tour in place of a person. Recent files and recovered work of whoever runs it
/// are neither looked at nor changed.
bindpose::Status play_tour(const std::vector<std::string>& files, const TourRequest& request);

#endif
