#ifndef help_boxes_h
#define help_boxes_h

class QWidget;

// Show the dialogs of the menu Help.

void show_about(QWidget* window);

#endif
