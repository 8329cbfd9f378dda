#ifndef elided_label_h
#define elided_label_h

#include <QLabel>

/// One line that never widens its window: what has no room ends in "…", and the tooltip says all.
class ElidedLabel : public QLabel
{
  Q_OBJECT

public:
  using QLabel::QLabel;

  /// What is seen of the text.
  QString shown() const;
  QSize minimumSizeHint() const override;

protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
};

#endif
