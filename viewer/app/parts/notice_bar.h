#ifndef app_parts_notice_bar_h
#define app_parts_notice_bar_h

#include <QFrame>
#include <QList>

#include <functional>

class QHBoxLayout;
class QLabel;
class QPushButton;

namespace app::parts
{

/// A sentence over the 3D view with buttons for actions. It is shown until an action is chosen or
/// the bar is closed. It never blocks the window.
class NoticeBar : public QFrame
{
  Q_OBJECT

public:
  struct Choice
  {
    QString text;
    std::function<void()> action; ///< called after the bar was hidden
  };

  explicit NoticeBar(QWidget* parent);

  /// Replace the sentence and all buttons, and show the bar. `close` is the text of an additional
  /// button that only hides the bar; empty: no such button.
  void offer(const QString& message, const QList<Choice>& choices, const QString& close);
  /// Replace the sentence and keep the buttons.
  void set_message(const QString& message, const QString& tool_tip = QString());
  /// Return the sentence; empty if the bar is hidden.
  QString message() const;

Q_SIGNALS:
  void closed();

private:
  QPushButton* add_button(const QString& text);

  QLabel* text_;
  QHBoxLayout* row_;
  QList<QPushButton*> buttons_;
};

} // namespace app::parts

#endif
