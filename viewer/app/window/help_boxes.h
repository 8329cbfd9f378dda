#ifndef app_window_help_boxes_h
#define app_window_help_boxes_h

class QWidget;

namespace app::window
{

// Show the dialogs of the menu Help.

void show_about(QWidget* window);

} // namespace app::window

#endif
