#ifndef app_window_plane_options_h
#define app_window_plane_options_h

#include <QString>

class Document;

namespace app::view
{
class PlaneHandle;
} // namespace app::view

namespace app::window
{

class OptionLinks;

/// Connect a plane with the options NAME.orientation, NAME.place and NAME.normal, where NAME is the
/// parameter `name`. A drag is one undo step; undo during a drag cancels the drag.
void link_plane(
  OptionLinks* links, Document* document, const QString& name, view::PlaneHandle* plane);

} // namespace app::window

#endif
