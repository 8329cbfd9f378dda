#ifndef app_parts_panel_parts_h
#define app_parts_panel_parts_h

#include <QString>
#include <QStringList>

class QBoxLayout;
class QButtonGroup;
class QComboBox;
class QLabel;
class QPushButton;
class QWidget;

namespace app::parts
{

// Functions that create the widgets and texts of the panels to the right of the 3D view.

QLabel* heading(const QString& text, QWidget* parent);
/// Return a button that does not take the keyboard focus when it is clicked.
QPushButton* button(const QString& text, QWidget* parent);
/// Add a row of buttons of which exactly one is pressed, initially the first. Ids count from 0.
QButtonGroup* add_segments(
  QBoxLayout* column, QWidget* parent, const QStringList& names, const QStringList& tips);
/// Disable one item of a list (-1: none), and show the reason as its tooltip. Enable all other
/// items.
void enable_all_but(QComboBox* list, int item, const QString& reason);
/// Return the text with a capital first letter.
QString capitalized(const QString& text);
/// Return the text shortened to `maximum_length` characters: the middle of a longer text is left
/// out.
QString shortened(const QString& text, int maximum_length);
/// Return a line of text about a running job: the phase in words, and the percentage.
QString progress_note(double fraction, const QString& phase);
/// Return a text for users that describes a phase of a kernel.
QString phase_description(const QString& phase);

} // namespace app::parts

#endif
