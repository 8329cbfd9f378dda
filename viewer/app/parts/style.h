#ifndef app_parts_style_h
#define app_parts_style_h

#include <QColor>

class QApplication;

namespace app::parts
{

/// Apply the look of the window: a light or dark palette with one accent color, and the matching
/// style sheet. All colors of the window, apart from the 3D view, are defined here.
void apply_style(QApplication& application);

/// Return the current color for a purpose ("ink", "panel", "accent", ...).
QColor theme_color(const char* name);
bool is_dark();

/// The appearance of the window: light, dark, or the same as the desktop. The user's choice is
/// stored and also used in later runs of the program.
enum class Appearance
{
  system,
  light,
  dark
};
Appearance chosen_appearance();
void choose_appearance(QApplication& application, Appearance appearance);

} // namespace app::parts

#endif
