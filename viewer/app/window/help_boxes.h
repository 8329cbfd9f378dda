#ifndef app_window_help_boxes_h
#define app_window_help_boxes_h

class QWidget;

// Show the dialogs of the menu Help.

void show_about(QWidget* window);

#endif
