#ifndef help_boxes_h
#define help_boxes_h

class QWidget;

// What the menu Help shows.

void show_about(QWidget* window);

#endif
