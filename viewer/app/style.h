#ifndef style_h
#define style_h

class QApplication;

/// The look of the window: a light, restrained palette with one accent, and the sheet that
/// goes with it. Everything that has a colour in the shell has it from here.
void apply_style(QApplication& application);

#endif
