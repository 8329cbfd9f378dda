#ifndef app_handles_start_card_h
#define app_handles_start_card_h

#include <QFrame>

class QAction;

namespace app::handles
{

/// A card over the 3D view while a mesh has no handles. It has a button that creates handles
/// automatically, and shows the keys to add handles manually.
class StartCard : public QFrame
{
  Q_OBJECT

public:
  StartCard(QAction* auto_rig, QWidget* parent);
};

} // namespace app::handles

#endif
