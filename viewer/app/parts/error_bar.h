#ifndef app_parts_error_bar_h
#define app_parts_error_bar_h

#include <QFrame>

class QLabel;

namespace app::parts
{

/// The type of the operation that failed.
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

/// Shows an error as one sentence over the 3D view. The bar is hidden when the user closes it or
/// the error is out of date.
class ErrorBar : public QFrame
{
  Q_OBJECT

public:
  explicit ErrorBar(QWidget* parent);

  /// Replace the current sentence.
  void show_message(
    const QString& message, ErrorKind kind = ErrorKind::other, const QString& tool_tip = QString());
  /// Hide the bar if it shows an error of this kind. Call this function when an operation of the
  /// same kind has succeeded.
  void succeeded(ErrorKind kind);
  /// Return the sentence; empty if the bar is hidden.
  QString message() const;

private:
  QLabel* text_;
  ErrorKind kind_ = ErrorKind::other;
};

} // namespace app::parts

#endif
