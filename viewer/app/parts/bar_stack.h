#ifndef app_parts_bar_stack_h
#define app_parts_bar_stack_h

#include <QWidget>

class QVBoxLayout;

namespace app::parts
{

/// A stack of bars over the upper edge of the 3D view. The view keeps its position and size when a
/// bar appears or disappears, so that nothing moves under the mouse.
class BarStack : public QWidget
{
public:
  explicit BarStack(QWidget* view_widget);

  /// Add a bar below the existing ones. A hidden bar takes no space.
  void add(QWidget* bar);
  /// Let the stack begin below a child widget of the 3D view while the child is visible.
  void begin_below(QWidget* widget);

protected:
  bool event(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void arrange();

  QVBoxLayout* column_;
  QWidget* widget_above_ = nullptr;
};

} // namespace app::parts

#endif
