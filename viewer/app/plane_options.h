#ifndef plane_options_h
#define plane_options_h

#include <QString>

class Document;
class OptionLinks;
class PlaneHandle;

/// Ties a plane to the options NAME.orientation, NAME.place and NAME.normal: a drag of it is one
/// step, and undo during the drag takes it back.
void tie_plane(OptionLinks* links, Document* document, const QString& name, PlaneHandle* plane);

#endif
