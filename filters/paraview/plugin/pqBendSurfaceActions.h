#ifndef pqBendSurfaceActions_h
#define pqBendSurfaceActions_h

#include <QActionGroup>

class QAction;
class pqOutputPort;

/// The action "Bend This Surface" of the menu Tools. As one undo step, it adds a chain of filters
/// to the active output: Automatic Handles, Bounded Biharmonic Weights, Pose Handles and Reduced
/// ARAP. Afterward Pose Handles is the active source, so that its panel is open and the handles can
/// be dragged.
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
