#ifndef app_window_empty_state_h
#define app_window_empty_state_h

#include <QWidget>

namespace app::window
{

/// A widget with instructions for the first step. It is shown in the middle of the 3D view while no
/// file is open.
class EmptyState : public QWidget
{
  Q_OBJECT

public:
  explicit EmptyState(QWidget* parent);

Q_SIGNALS:
  /// Emitted when the user wants to open a mesh for which handles are then created automatically.
  void open_and_rig_requested();
};

} // namespace app::window

#endif
