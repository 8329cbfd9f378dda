#ifndef picture_dialog_h
#define picture_dialog_h

#include <QDialog>

class QCheckBox;
class QComboBox;
class QLabel;
class QPushButton;
class Viewport;

/// Asks how the picture is to be saved: so many times as large as it is seen, with a transparent
/// background or not; tells its size in pixels. What was chosen is there again the next time.
class PictureDialog : public QDialog
{
  Q_OBJECT

public:
  PictureDialog(Viewport* viewport, QWidget* parent);

  int scale() const;
  bool is_transparent() const;
  /// What is said about the size: pixels, or why there can be no picture of it.
  QString size_note() const;
  void accept() override;

private:
  void update_size();

  Viewport* viewport_;
  QComboBox* scale_;
  QCheckBox* transparent_;
  QLabel* size_;
  QPushButton* save_;
};

#endif
