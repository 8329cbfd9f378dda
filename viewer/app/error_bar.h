#ifndef error_bar_h
#define error_bar_h

#include <QFrame>

class QLabel;

/// What was tried when something went wrong.
enum class ErrorKind
{
  other,
  edit_handles,
  pose,
  tets,
  weights,
  volume,
  save_session,
  export_file
};

/// A sentence over the picture about what went wrong, until it is closed or no longer true.
class ErrorBar : public QFrame
{
public:
  explicit ErrorBar(QWidget* parent);

  /// Replaces the sentence that is there.
  void show_sentence(const QString& sentence, ErrorKind kind = ErrorKind::other,
    const QString& tool_tip = QString());
  /// Something of this kind has succeeded: an error of the same kind is out of date, and is hidden.
  void succeeded(ErrorKind kind);
  /// Empty when the bar is hidden.
  QString sentence() const;

private:
  QLabel* text_;
  ErrorKind kind_ = ErrorKind::other;
};

#endif
