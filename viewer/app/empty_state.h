#ifndef empty_state_h
#define empty_state_h

#include <QWidget>

/// Instructions for the first step, in the middle of the picture while nothing is open.
class EmptyState : public QWidget
{
  Q_OBJECT

public:
  explicit EmptyState(QWidget* parent);

Q_SIGNALS:
  /// The user wants to choose a mesh, open it and rig it.
  void open_and_rig_wanted();
};

#endif
