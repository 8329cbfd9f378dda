#ifndef bar_stack_h
#define bar_stack_h

#include <QWidget>

class QVBoxLayout;

/// Bars one below the other, over the upper edge of a picture. The picture keeps its place and
/// size when a bar appears or leaves, so that nothing moves under the mouse.
class BarStack : public QWidget
{
public:
  explicit BarStack(QWidget* picture);

  /// Below those that were added before; seen as long as it is not hidden.
  void add(QWidget* bar);
  /// Bars begin below this child of the picture while it is seen.
  void begin_below(QWidget* widget);

protected:
  bool event(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void arrange();

  QVBoxLayout* column_;
  QWidget* above_ = nullptr;
};

#endif
