#ifndef start_card_h
#define start_card_h

#include <QFrame>

class QAction;

/// A card over the picture while a mesh has no handles: a button for the action that makes them,
/// and the keys to make them manually.
class StartCard : public QFrame
{
  Q_OBJECT

public:
  StartCard(QAction* auto_rig, QWidget* parent);
};

#endif
