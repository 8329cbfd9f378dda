#ifndef panel_parts_h
#define panel_parts_h

#include <QString>
#include <QStringList>

class QBoxLayout;
class QButtonGroup;
class QComboBox;
class QLabel;
class QPushButton;
class QWidget;

// What the panels right of the picture are made of.

QLabel* heading(const QString& text, QWidget* parent);
/// A button that the mouse presses without taking the keyboard to it.
QPushButton* button(const QString& text, QWidget* parent);
/// A row of buttons of which one is pressed, the first to begin with; ids count from 0.
QButtonGroup* add_segments(
  QBoxLayout* column, QWidget* parent, const QStringList& names, const QStringList& tips);
/// A row of buttons X, Y, Z and Free, whose ids are PlaneHandle's orientations; Z is pressed.
QButtonGroup* add_orientations(QBoxLayout* column, QWidget* parent);
/// Disable one item of a list (-1: none), enable all others, and say why at the disabled one.
void enable_all_but(QComboBox* list, int item, const QString& reason);
/// With a capital letter, as a sentence or a heading begins.
QString capital(const QString& text);
/// Return a text for one line: a longer one without its middle.
QString shortened(const QString& text, int longest);
/// Return a line about a running job: its phase in words, and percent.
QString progress_note(double fraction, const QString& phase);
/// What a phase of the kernels does, in words.
QString sentence_of(const QString& phase);

#endif
