#ifndef bindpose_pictures_display_h
#define bindpose_pictures_display_h

namespace bindpose
{

/// Report whether this process can draw. Call it before any rendering: without an X server, VTK 9.1
/// on X11 terminates the process, even for offscreen pictures, and no handler can catch that. The
/// function connects to $DISPLAY, which takes about 1 millisecond, or up to 1 second if no server
/// answers. A successful connection stays open, so later calls cost nothing. Not thread-safe.
bool can_render();

/// Return one sentence for users that says what to do when can_render() is false.
const char* no_display_message();

} // namespace bindpose

#endif
