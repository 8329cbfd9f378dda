#ifndef app_parts_elided_label_h
#define app_parts_elided_label_h

#include <QLabel>

namespace app::parts
{

/// A line of text that never makes its window wider. Text that does not fit ends in "…", and the
/// tooltip shows all of it.
class ElidedLabel : public QLabel
{
  Q_OBJECT

public:
  using QLabel::QLabel;

  /// Return the text as displayed, possibly shortened.
  QString shown() const;
  QSize minimumSizeHint() const override;

protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
};

} // namespace app::parts

#endif
