#ifndef style_h
#define style_h

#include <QColor>

class QApplication;

/// The look of the window: a restrained palette with one accent, light or dark, and the sheet that
/// goes with it. Everything that has a colour in the shell has it from here.
void apply_style(QApplication& application);

/// A colour by what it is for ("ink", "panel", "accent", ...), as the window has it now.
QColor shade(const char* name);
bool is_dark();

/// Light, dark, or as the desktop is; kept over the program's runs.
enum class Appearance
{
  system,
  light,
  dark
};
Appearance chosen_appearance();
void choose_appearance(QApplication& application, Appearance appearance);

#endif
