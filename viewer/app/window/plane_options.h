#ifndef app_window_plane_options_h
#define app_window_plane_options_h

#include <QString>

class Document;
class OptionLinks;
class PlaneHandle;

/// Connect a plane with the options NAME.orientation, NAME.place and NAME.normal, where NAME is the
/// parameter `name`. A drag is one undo step; undo during a drag cancels the drag.
void link_plane(OptionLinks* links, Document* document, const QString& name, PlaneHandle* plane);

#endif
