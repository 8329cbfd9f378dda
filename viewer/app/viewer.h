#ifndef viewer_h
#define viewer_h

#include <string>
#include <vector>

/// `bindpose view`: opens the window with these files (meshes, meshes with weights, handles).
/// Returns the program's exit code. Needs a display.
int run_viewer(const std::vector<std::string>& files);

#endif
