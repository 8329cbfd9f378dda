#ifndef app_window_picture_dialog_h
#define app_window_picture_dialog_h

#include <QDialog>

class QCheckBox;
class QComboBox;
class QLabel;
class QPushButton;

namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::window
{

/// A dialog that asks for the size of an image of the 3D view, as a multiple of the size on the
/// screen, and for a transparent background. It shows the size in pixels. The next dialog begins
/// with the same choices.
class PictureDialog : public QDialog
{
  Q_OBJECT

public:
  PictureDialog(view::Viewport* viewport, QWidget* parent);

  int scale() const;
  bool is_transparent() const;
  /// Return the text about the size: pixels, or the reason why an image of this size is impossible.
  QString size_note() const;
  void accept() override;

private:
  void update_size();

  view::Viewport* viewport_;
  QComboBox* scale_;
  QCheckBox* transparent_;
  QLabel* size_;
  QPushButton* save_;
};

} // namespace app::window

#endif
