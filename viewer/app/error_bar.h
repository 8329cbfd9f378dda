#ifndef error_bar_h
#define error_bar_h

#include <QFrame>

class QLabel;

/// A sentence above the picture about what went wrong, until it is closed.
class ErrorBar : public QFrame
{
public:
  explicit ErrorBar(QWidget* parent);

  /// Replaces the sentence that is there.
  void show_sentence(const QString& sentence, const QString& tool_tip = QString());
  /// Empty when the bar is hidden.
  QString sentence() const;

private:
  QLabel* text_;
};

#endif
