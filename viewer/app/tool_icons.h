#ifndef tool_icons_h
#define tool_icons_h

#include <QIcon>

/// The icon of a tool or edit mode, by its action's name in window_keys.h: drawn, so that it is
/// sharp on every screen, in the colours of the buttons it stands on.
QIcon tool_icon(const char* action);

#endif
