#ifndef notice_bar_h
#define notice_bar_h

#include <QFrame>
#include <QList>

#include <functional>

class QHBoxLayout;
class QLabel;
class QPushButton;

/// A sentence over the picture with something to do about it, until that is done or it is closed.
/// It never stops the work.
class NoticeBar : public QFrame
{
  Q_OBJECT

public:
  struct Choice
  {
    QString text;
    std::function<void()> action; ///< the bar is hidden before
  };

  explicit NoticeBar(QWidget* parent);

  /// Replaces what is there. `close` names the button that only hides the bar; empty: none.
  void offer(const QString& sentence, const QList<Choice>& choices, const QString& close);
  /// Another sentence for the same offer.
  void set_sentence(const QString& sentence, const QString& tool_tip = QString());
  /// Empty when the bar is hidden.
  QString sentence() const;

Q_SIGNALS:
  void closed();

private:
  QPushButton* add_button(const QString& text);

  QLabel* text_;
  QHBoxLayout* row_;
  QList<QPushButton*> buttons_;
};

#endif
