// Detects whether an X server accepts connections. libX11 is looked up at run time, because nothing
// else in this library uses it; VTK loads it if necessary.
//
// Xvfb restarts when its last client disconnects, and refuses connections meanwhile. Therefore a
// successful connection is kept open until the process ends. A refused connection is retried for
// one second.
#include "pictures/display.h"

#include "vtkRenderingOpenGLConfigure.h"

#include <dlfcn.h>

#include <chrono>
#include <cstdlib>
#include <thread>

namespace bindpose
{

bool can_render()
{
#if defined(VTK_USE_X) && !defined(VTK_OPENGL_HAS_OSMESA) && !defined(VTK_OPENGL_HAS_EGL)
  static void* display = nullptr;
  if (display)
  {
    return true;
  }
  void* library = dlopen("libX11.so.6", RTLD_NOW | RTLD_LOCAL);
  using OpenDisplay = void* (*)(const char*);
  const auto open_display =
    library ? reinterpret_cast<OpenDisplay>(dlsym(library, "XOpenDisplay")) : nullptr;
  const char* name = std::getenv("DISPLAY");
  if (!open_display || !name || !*name)
  {
    return false;
  }
  for (int attempt = 0; attempt < 10 && !display; ++attempt)
  {
    if (attempt > 0)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    display = open_display(nullptr);
  }
  return display != nullptr;
#else
  return true;
#endif
}

const char* no_display_message()
{
  return "no X display is available for drawing; run the command under xvfb-run (Debian package "
         "xvfb)";
}

} // namespace bindpose
