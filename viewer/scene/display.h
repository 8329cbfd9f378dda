#ifndef bindpose_scene_display_h
#define bindpose_scene_display_h

namespace bindpose
{

/// Whether this process can draw. VTK 9.1 on X11 ends the process, uncatchably, when no X server
/// answers, even for offscreen pictures; ask first. Connects to $DISPLAY, about a millisecond, and
/// up to a second when nobody answers; a connection that was made stays open, and later calls
/// cost nothing. Not thread-safe.
bool can_render();

/// One sentence for users that says what to do when can_render() is false.
const char* no_display_message();

} // namespace bindpose

#endif
