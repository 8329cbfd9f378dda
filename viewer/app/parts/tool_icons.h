#ifndef app_parts_tool_icons_h
#define app_parts_tool_icons_h

#include <QIcon>

namespace app::parts
{

/// Return the icon of a tool or edit mode. `action` is the name of its action in window_keys.h. The
/// icon is drawn in the colors of its button, and is sharp on every screen.
QIcon tool_icon(const char* action);

} // namespace app::parts

#endif
