#ifndef empty_state_h
#define empty_state_h

#include <QWidget>

/// In the middle of the picture as long as nothing is open: what to do first.
class EmptyState : public QWidget
{
  Q_OBJECT

public:
  explicit EmptyState(QWidget* parent);

Q_SIGNALS:
  /// A mesh is to be chosen, opened and rigged.
  void open_and_rig_wanted();
};

#endif
