#ifndef pqBendSurfaceActions_h
#define pqBendSurfaceActions_h

#include <QActionGroup>

class QAction;
class pqOutputPort;

/// The action "Bend This Surface" of the menu Tools. It connects the active output with a chain of
/// filters, as one undo step: Automatic Handles, Bounded Biharmonic Weights, Pose Handles and
/// Reduced ARAP. Then the panel of Pose Handles is active, so that the handles can be dragged.
class pqBendSurfaceActions : public QActionGroup
{
  Q_OBJECT

public:
  explicit pqBendSurfaceActions(QObject* parent);

private Q_SLOTS:
  void bend();

private:
  Q_DISABLE_COPY(pqBendSurfaceActions)

  static QString refusal(pqOutputPort* port);
};

#endif
