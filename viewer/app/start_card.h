#ifndef start_card_h
#define start_card_h

#include <QFrame>

class QAction;

/// Over the picture as long as a mesh has no handles: a button for the action that makes them, and
/// the keys by which they are made by hand.
class StartCard : public QFrame
{
  Q_OBJECT

public:
  StartCard(QAction* auto_rig, QWidget* parent);
};

#endif
